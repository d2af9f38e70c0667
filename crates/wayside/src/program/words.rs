//! Words that options take, each one of a few.

use clap::ValueEnum;
use formats::devices::{Board, IqOrder, Lanes};
use formats::training_sets::Set;

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum PolarizationWord {
    Vv,
    Hh,
    Vh,
    Hv,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodWord {
    Bart,
    Sbr,
    Po,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum EdgesWord {
    On,
    Off,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TransmissionWord {
    On,
    Off,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum NodesWord {
    Middle,
    Exit,
    OwnEdge,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SurfaceWord {
    Flat,
    Smooth,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SidesWord {
    Two,
    One,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum AxesWord {
    On,
    Off,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FormatWord {
    /// An array of NumPy, its axes in a .json beside it; of a dataset its crops.
    Npy,
    /// Maps as floats, a layer a frame.
    Exr,
    /// Maps or crops as pictures.
    Png,
    /// A table, a row a path, point, track or sample.
    Csv,
    /// Points as a cloud of PCL.
    Pcd,
    /// Points as a cloud of Stanford's format.
    Ply,
    /// All of it as JSON.
    Json,
    /// Weights of a network.
    Safetensors,
    /// The .bin of a DCA1000EVM.
    Dca1000,
    /// .sigmf-data and .sigmf-meta.
    Sigmf,
    /// Messages of ASAM OSI, in a file that ends in .osi or .mcap.
    Osi,
    /// Messages of ROS 2: PointCloud2 and RadarScan, RadarTracks.
    Mcap,
    /// A folder as RADDet's: range-azimuth-Doppler tensors and boxes.
    Raddet,
    /// A folder as CARRADA's: range-Doppler and range-angle maps and annotations.
    Carrada,
    /// A folder as the University of Washington's raw data: samples and labels.
    Uwcr,
    /// A folder as View-of-Delft's and KITTI's: clouds, boxes, a camera.
    Kitti,
    /// A folder as nuScenes': clouds and the tables of its database.
    Nuscenes,
    /// One table of Apache Parquet.
    Parquet,
}

impl FormatWord {
    /// The set whose layout it is; `None` of a format that is a file, or a pair of them.
    pub(crate) fn set(self) -> Option<Set> {
        match self {
            Self::Raddet => Some(Set::Raddet),
            Self::Carrada => Some(Set::Carrada),
            Self::Uwcr => Some(Set::Uwcr),
            Self::Kitti => Some(Set::Kitti),
            Self::Nuscenes => Some(Set::Nuscenes),
            _ => None,
        }
    }
}

/// Evaluation board of a family of devices, automotive and industrial alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum BoardWord {
    /// AWR1243BOOST.
    #[value(alias("awr1243"), alias("iwr1243"))]
    Xwr1243,
    /// AWR1443BOOST and IWR1443BOOST.
    #[value(alias("awr1443"), alias("iwr1443"))]
    Xwr1443,
    /// AWR1642BOOST and IWR1642BOOST.
    #[value(alias("awr1642"), alias("iwr1642"))]
    Xwr1642,
    /// AWR1843BOOST and IWR1843BOOST.
    #[value(alias("awr1843"), alias("iwr1843"))]
    Xwr1843,
    /// IWR6843ISK; boards with the antenna in or on the package have other antennas.
    #[value(alias("awr6843"), alias("iwr6843"))]
    Xwr6843,
    /// AWR2243BOOST.
    #[value(alias("xwr2243"))]
    Awr2243,
}

/// Lanes between a device and its capture card.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum LanesWord {
    /// Receiver after receiver, each by twos where samples are complex.
    #[value(name = "two-lanes")]
    Two,
    /// A lane for each receiver, sample after sample.
    #[value(name = "four-lanes")]
    Four,
}

/// The part of a complex sample that comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum IqOrderWord {
    /// I before Q.
    #[value(name = "iq")]
    InPhaseFirst,
    /// Q before I.
    #[value(name = "qi")]
    QuadratureFirst,
}

impl From<BoardWord> for Board {
    fn from(word: BoardWord) -> Self {
        match word {
            BoardWord::Xwr1243 => Self::Xwr1243,
            BoardWord::Xwr1443 => Self::Xwr1443,
            BoardWord::Xwr1642 => Self::Xwr1642,
            BoardWord::Xwr1843 => Self::Xwr1843,
            BoardWord::Xwr6843 => Self::Xwr6843,
            BoardWord::Awr2243 => Self::Awr2243,
        }
    }
}

impl From<LanesWord> for Lanes {
    fn from(word: LanesWord) -> Self {
        match word {
            LanesWord::Two => Self::Two,
            LanesWord::Four => Self::Four,
        }
    }
}

impl From<IqOrderWord> for IqOrder {
    fn from(word: IqOrderWord) -> Self {
        match word {
            IqOrderWord::InPhaseFirst => Self::InPhaseFirst,
            IqOrderWord::QuadratureFirst => Self::QuadratureFirst,
        }
    }
}
