//! Values computed once for all frames of a radar: from its windows and settings, and for each sub-frame.

use crate::detection::censored::Censoring;
use crate::detection::cfar::Cfar;
use crate::detection::cfar_threshold::threshold_factor;
use crate::detection::peaks::PeakFinder;
use crate::detection::range_doppler::NoiseFloorOrigin;
use crate::direction::angle::VirtualArray;
use crate::error::DspError;
use crate::spectrum::map_transform::RangeDoppler;
use crate::spectrum::noncoherent::PowerLevels;
use crate::spectrum::window::{correlated_bins, noise_bandwidth_bins, taper};
use artifact::Radar;
use artifact::cube::CubeHeader;
use artifact::rdm::RdmFrame;
use artifact::settings::{DspSettings, Lanes};
use radar::lattice::resolves_azimuth;
use std::sync::Arc;

/// Lanes that positions can be assigned to: those of the road. An array without extent along the row measures
/// no azimuth, and so no lane.
pub(crate) fn measurable_lanes(header: &CubeHeader) -> Lanes {
    let road = header.dsp.road.clone();
    if resolves_azimuth(&header.radar) { road } else { Lanes { lanes: vec![], courses: vec![], ..road } }
}

/// Values that follow from windows, settings and numbers of cells, independent of the chirp interval.
pub(crate) struct Thresholds {
    /// Cell detector.
    pub(crate) detector: Cfar,
    /// Retesting of cells that stronger echoes hide from the detector.
    pub(crate) censoring: Censoring,
    /// Interpolation of peaks between cells, and their leakage.
    pub(crate) finder: PeakFinder,
    /// Noise bandwidth of a cell under both windows, in cells.
    pub(crate) bandwidth_cells: f64,
    /// Doppler window and range window.
    pub(crate) tapers: [Vec<f64>; 2],
    /// Threshold over known noise: that of infinitely many training cells.
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
            censoring: Censoring::new(header, correlated_bins(&doppler) * correlated_bins(&range)),
            finder: PeakFinder::new(&header.radar, &doppler, &range),
            bandwidth_cells,
            tapers: [doppler, range],
            // At 1e9 cells the factor is within 1e-8 of its limit.
            of_known_noise: threshold_factor(1e9, header.radar.map_channels(), settings.false_alarm_rate),
        })
    }
}

/// Values shared by the frames of one sub-frame.
pub(crate) struct Plan {
    /// Radar of this sub-frame.
    pub(crate) radar: Radar,
    /// Detection settings.
    pub(crate) settings: DspSettings,
    /// Origin of the noise level that thresholds are based on.
    pub(crate) floor: NoiseFloorOrigin,
    /// Transform from samples to maps.
    pub(crate) transform: RangeDoppler,
    /// Thresholds, shared with the other sub-frames.
    pub(crate) thresholds: Arc<Thresholds>,
    /// Array, which turns channels into directions.
    pub(crate) array: VirtualArray,
    /// Lanes that objects can be assigned to.
    pub(crate) lanes: Lanes,
}

impl Plan {
    /// Plans of all sub-frames of a cycle, at least one.
    ///
    /// # Errors
    /// Radar parameters or settings from which no map or no threshold can be computed.
    pub(crate) fn of_cycle(header: &CubeHeader) -> Result<Vec<Self>, DspError> {
        let sub_frames = 0..header.radar.schedule.sub_frames();
        let own: Vec<CubeHeader> = sub_frames.map(|index| header.in_frame(index)).collect();
        let transforms: Vec<RangeDoppler> = own.iter().map(RangeDoppler::new).collect::<Result<_, _>>()?;
        let thresholds = Arc::new(Thresholds::new(&own[0])?);
        let plan = |(header, transform): (CubeHeader, RangeDoppler)| Self {
            array: VirtualArray::new(&header),
            lanes: measurable_lanes(&header),
            floor: NoiseFloorOrigin::of(&header),
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
    /// The map has another shape, or contains non-finite values.
    pub(crate) fn levels(&self, map: &RdmFrame) -> Result<PowerLevels, DspError> {
        PowerLevels::of(self.transform.shapes(), map)
    }
}
