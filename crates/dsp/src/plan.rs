//! Values worked out once for all frames of a radar: of its windows and settings, and of each sub-frame.

use crate::detection::censored::Censoring;
use crate::detection::cfar::Cfar;
use crate::detection::cfar_threshold::threshold_factor;
use crate::detection::peaks::PeakFinder;
use crate::detection::range_doppler::Floor;
use crate::direction::angle::VirtualArray;
use crate::error::DspError;
use crate::spectrum::map_transform::RangeDoppler;
use crate::spectrum::noncoherent::Levels;
use crate::spectrum::window::{noise_bandwidth_bins, taper};
use artifact::Radar;
use artifact::cube::CubeHeader;
use artifact::rdm::RdmFrame;
use artifact::settings::{DspSettings, Lanes};
use radar::lattice::tells_azimuth;
use std::sync::Arc;

/// Lanes that places may be told to lie in: those of the road. An array without extent along the row tells
/// no azimuth, and no lane.
pub(crate) fn told_lanes(header: &CubeHeader) -> Lanes {
    let road = header.dsp.road.clone();
    if tells_azimuth(&header.radar) { road } else { Lanes { lanes: vec![], courses: vec![], ..road } }
}

/// Values that follow from windows, settings and numbers of cells, whatever the chirp interval.
pub(crate) struct Thresholds {
    /// Detector of cells.
    pub(crate) detector: Cfar,
    /// Finder of the cells that stronger echoes hide from the detector.
    pub(crate) censoring: Censoring,
    /// Finder of the places of peaks between cells, and of what leaks from them.
    pub(crate) finder: PeakFinder,
    /// Noise bandwidth of a cell by its two windows, in cells.
    pub(crate) bandwidth_cells: f64,
    /// Threshold over noise that is known: that of infinitely many training cells.
    pub(crate) of_known_noise: f64,
}

impl Thresholds {
    fn new(header: &CubeHeader) -> Result<Self, DspError> {
        let (settings, waveform) = (&header.dsp, &header.radar.waveform);
        let detector = Cfar::new(header)?;
        let doppler = taper(settings.doppler_window, waveform.chirps as usize)?;
        let range = taper(settings.range_window, waveform.samples as usize)?;
        let bandwidth_cells = noise_bandwidth_bins(&doppler) * noise_bandwidth_bins(&range);
        Ok(Self {
            detector,
            censoring: Censoring::new(header, bandwidth_cells),
            finder: PeakFinder::new(&header.radar, &doppler, &range),
            bandwidth_cells,
            // At 1e9 cells the factor is within 1e-8 of its limit.
            of_known_noise: threshold_factor(1e9, header.radar.map_channels(), settings.false_alarm_rate),
        })
    }
}

/// Values that the frames of one sub-frame share.
pub(crate) struct Plan {
    /// The radar as it is in this sub-frame.
    pub(crate) radar: Radar,
    /// Settings of detection.
    pub(crate) settings: DspSettings,
    /// Origin of the noise that thresholds stand on.
    pub(crate) floor: Floor,
    /// Samples to maps.
    pub(crate) transform: RangeDoppler,
    /// Shared with the other sub-frames.
    pub(crate) thresholds: Arc<Thresholds>,
    /// Channels to directions.
    pub(crate) array: VirtualArray,
    /// Lanes that objects may be in.
    pub(crate) lanes: Lanes,
}

impl Plan {
    /// Plans of every sub-frame of a cycle, at least one.
    ///
    /// # Errors
    /// What of the radar or its settings no map or no threshold can be made of.
    pub(crate) fn of_cycle(header: &CubeHeader) -> Result<Vec<Self>, DspError> {
        let sub_frames = 0..header.radar.schedule.sub_frames();
        let own: Vec<CubeHeader> = sub_frames.map(|index| header.in_frame(index)).collect();
        let transforms: Vec<RangeDoppler> = own.iter().map(RangeDoppler::new).collect::<Result<_, _>>()?;
        let thresholds = Arc::new(Thresholds::new(&own[0])?);
        let plan = |(header, transform): (CubeHeader, RangeDoppler)| Self {
            array: VirtualArray::new(&header),
            lanes: told_lanes(&header),
            floor: Floor::of(&header),
            radar: header.radar,
            settings: header.dsp,
            transform,
            thresholds: Arc::clone(&thresholds),
        };
        Ok(own.into_iter().zip(transforms).map(plan).collect())
    }

    /// Powers of a map of this sub-frame.
    ///
    /// # Errors
    /// The map has another shape, or holds values that are no numbers.
    pub(crate) fn levels(&self, map: &RdmFrame) -> Result<Levels, DspError> {
        Levels::of(self.transform.shapes(), map)
    }
}
