//! Range-Doppler maps of all channels, and the detector's result on them.

use crate::files::envelope::Schema;
use crate::schemas::cube::{CubeHeader, least_bytes, wrong_count};
use num_complex::Complex32;
use serde::{Deserialize, Serialize};

/// The `.rdm` artifact.
pub struct Rdm;

impl Schema for Rdm {
    const NAME: &'static str = "rdm";
    const VERSION: u32 = 9;
    type Header = CubeHeader;
    type Frame = RdmFrame;

    fn contradiction(header: &CubeHeader, frame: &RdmFrame) -> Option<String> {
        let [channels, rows, columns] = shape(header);
        wrong_count("values", [channels, rows, columns], frame.values.len())
            .or_else(|| wrong_count("mask cells", [1, rows, columns], frame.mask.len()))
    }

    fn least_frame_bytes(header: &CubeHeader) -> u64 {
        let [_, rows, columns] = shape(header);
        least_bytes(shape(header), 8).saturating_add(least_bytes([1, rows, columns], 1))
    }
}

/// Map of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RdmFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Map values, row-major `[channel, doppler, range]`; zero velocity at N/2, for real samples only the
    /// first half of the range cells; channels are those of [`Radar::map_channels`](crate::Radar).
    pub values: Vec<Complex32>,
    /// State of each cell, row-major `[doppler, range]`: 0 untested, 1 tested, 2 above the detector's
    /// threshold.
    pub mask: Vec<u8>,
    /// Number of cells above the threshold, before any grouping.
    pub detections: u64,
    /// Number of tested cells.
    pub cells: u64,
    /// Power of the floor assumed in place of noise in a noise-free map; `None` where noise was estimated.
    pub assumed_floor: Option<f64>,
}

/// Shape `[channel, doppler, range]` of a map.
pub fn shape(header: &CubeHeader) -> [usize; 3] {
    let waveform = &header.radar.waveform;
    [header.radar.map_channels(), waveform.chirps as usize, waveform.range_cells()]
}
