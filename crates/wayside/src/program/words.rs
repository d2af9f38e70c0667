//! Words that options take, each one of a few.

use clap::ValueEnum;

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
    Npy,
    Exr,
    Png,
    Csv,
    Pcd,
    Ply,
    Json,
    Safetensors,
    /// The .bin of a DCA1000EVM.
    Dca1000,
    /// .sigmf-data and .sigmf-meta.
    Sigmf,
    /// Messages of ASAM OSI, in a file that ends in .osi or .mcap.
    Osi,
    /// Messages of ROS 2: PointCloud2 and RadarScan, RadarTracks.
    Mcap,
}
