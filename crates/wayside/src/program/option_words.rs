//! Options with a fixed set of words; those of the settings of a table of S are `stepwise::table_words`.

use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use formats::devices::{Board, IqOrder, Lanes};

/// Parser of an option with a fixed set of words, each given with its setting.
pub(crate) fn one_of<W: Into<PossibleValue>, T: Copy + Send + Sync + 'static>(
    words: impl IntoIterator<Item = (W, T)>,
) -> impl TypedValueParser<Value = T> {
    let words: Vec<(PossibleValue, T)> =
        words.into_iter().map(|(word, setting)| (word.into(), setting)).collect();
    PossibleValuesParser::new(words.iter().map(|(word, _)| word.clone())).try_map(move |typed| {
        let meant = words.iter().find(|(word, _)| word.matches(&typed, false));
        meant.map(|(_, setting)| *setting).ok_or("it is no word of this option")
    })
}

/// Evaluation boards of device families, automotive and industrial alike.
pub(crate) fn boards() -> impl TypedValueParser<Value = Board> {
    let of = |name, also: &'static [&'static str], help| PossibleValue::new(name).aliases(also).help(help);
    let isk = "IWR6843ISK; boards with the antenna in or on the package have other antennas";
    one_of([
        (of("xwr1243", &["awr1243", "iwr1243"], "AWR1243BOOST"), Board::Xwr1243),
        (of("xwr1443", &["awr1443", "iwr1443"], "AWR1443BOOST and IWR1443BOOST"), Board::Xwr1443),
        (of("xwr1642", &["awr1642", "iwr1642"], "AWR1642BOOST and IWR1642BOOST"), Board::Xwr1642),
        (of("xwr1843", &["awr1843", "iwr1843"], "AWR1843BOOST and IWR1843BOOST"), Board::Xwr1843),
        (of("xwr6843", &["awr6843", "iwr6843"], isk), Board::Xwr6843),
        (of("awr2243", &["xwr2243"], "AWR2243BOOST"), Board::Awr2243),
    ])
}

/// Lanes between a device and its capture card.
pub(crate) fn lanes() -> impl TypedValueParser<Value = Lanes> {
    let two = "Receiver after receiver, each by twos where samples are complex";
    one_of([
        (PossibleValue::new("two-lanes").help(two), Lanes::Two),
        (PossibleValue::new("four-lanes").help("A lane for each receiver, sample after sample"), Lanes::Four),
    ])
}

/// Orders of the parts of a complex sample, named by the first.
pub(crate) fn iq_orders() -> impl TypedValueParser<Value = IqOrder> {
    one_of([
        (PossibleValue::new("iq").help("I before Q"), IqOrder::InPhaseFirst),
        (PossibleValue::new("qi").help("Q before I"), IqOrder::QuadratureFirst),
    ])
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodWord {
    Bart,
    Sbr,
    Po,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum AxesWord {
    On,
    Off,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FormatWord {
    /// A NumPy array with its axes in a .json beside it; of a dataset its crops.
    Npy,
    /// Maps as floats, a file per frame: of several frames F-0000.exr, F-0001.exr and so on.
    Exr,
    /// Maps as pictures, numbered likewise, or crops, a picture per sample in a folder.
    Png,
    /// A table with one row per path, point, track or sample.
    Csv,
    /// Points as a cloud of PCL.
    Pcd,
    /// Points as a cloud in Stanford's format.
    Ply,
    /// All data as JSON.
    Json,
    /// Weights of a network.
    Safetensors,
    /// The .bin of a DCA1000EVM.
    Dca1000,
    /// .sigmf-data and .sigmf-meta.
    Sigmf,
    /// Messages of ASAM OSI, in a file ending in .osi or .mcap.
    Osi,
    /// Messages of ROS 2: PointCloud2 and RadarScan, RadarTracks.
    Mcap,
    /// Points as PointCloud of Foxglove, without ROS, in a file ending in .mcap.
    Foxglove,
    /// A folder in RADDet's layout: range-azimuth-Doppler tensors and boxes.
    Raddet,
    /// A folder in CARRADA's layout: range-Doppler and range-angle maps and annotations.
    Carrada,
    /// A folder in the layout of the University of Washington's raw data: samples and labels.
    Uwcr,
    /// A folder in the layout of View-of-Delft and KITTI: clouds, boxes, a camera.
    Kitti,
    /// A folder in nuScenes' layout: clouds and the tables of its database.
    Nuscenes,
    /// One table of Apache Parquet.
    Parquet,
}
