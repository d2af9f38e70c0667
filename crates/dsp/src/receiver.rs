//! Processing stage of one radar: constructed from a header, it turns cubes into maps, points, velocities and
//! crops.

use crate::ambiguity::velocity_folds;
use crate::crops::crop::Cropper;
use crate::crops::signature::Signatures;
use crate::detection::range_doppler::range_doppler;
use crate::direction::calibration;
use crate::error::DspError;
use crate::objects::points::locate_points;
use crate::plan::Plan;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::dataset::CropFormat;
use artifact::points::PointsFrame;
use artifact::radar::Sampling;
use artifact::rdm::RdmFrame;
use artifact::settings::Refine;
use num_complex::Complex64;

/// A radar's receiver: its header is checked, and its windows, transforms, thresholds and array are computed
/// once per sub-frame. The frame index determines the sub-frame.
pub struct Receiver {
    /// Plans by sub-frame, at least one.
    plans: Vec<Plan>,
}

impl Receiver {
    /// Constructs the receiver for cubes with this header.
    ///
    /// # Errors
    /// Radar parameters or settings from which no map or no threshold can be computed.
    pub fn new(header: &CubeHeader) -> Result<Self, DspError> {
        Ok(Self { plans: Plan::of_cycle(header)? })
    }

    /// Plan of the frame record `index`.
    fn plan(&self, index: u32) -> &Plan {
        &self.plans[index as usize % self.plans.len()]
    }

    /// Number of frame records that belong together: the sub-frames of a cycle.
    pub fn frames_in_cycle(&self) -> usize {
        self.plans.len()
    }

    /// Computes the map and the points of one frame.
    ///
    /// # Errors
    /// Those of [`Self::range_doppler`] and [`Self::detect_refined`].
    pub fn process(&self, cube: &CubeFrame) -> Result<(RdmFrame, PointsFrame), DspError> {
        let map = self.range_doppler(cube)?;
        let points = self.detect_refined(&map, cube)?;
        Ok((map, points))
    }

    /// Computes the map of one frame, with the cells tested and detected by the header's detector.
    ///
    /// # Errors
    /// Samples whose number or sampling is not the radar's, and non-finite values.
    pub fn range_doppler(&self, cube: &CubeFrame) -> Result<RdmFrame, DspError> {
        let plan = self.plan(cube.index);
        range_doppler(&plan.transform, &plan.thresholds.detector, plan.floor, cube)
    }

    /// Detects the points of a map, strongest first, and objects in the order of their strongest peaks.
    ///
    /// # Errors
    /// The map has another shape, or contains non-finite values.
    pub fn detect(&self, map: &RdmFrame) -> Result<PointsFrame, DspError> {
        locate_points(self.plan(map.index), map, None)
    }

    /// [`Self::detect`] with the samples of the map: if the settings request it, isolated peaks are refined
    /// on them.
    ///
    /// # Errors
    /// Those of [`Self::detect`]; samples that do not match the radar, or, if refinement is requested, in
    /// which an echo is not a single tone.
    pub fn detect_refined(&self, map: &RdmFrame, cube: &CubeFrame) -> Result<PointsFrame, DspError> {
        let plan = self.plan(map.index);
        plan.transform.shapes().check_samples(&cube.samples)?;
        let refines = plan.settings.refine == Refine::Isolated;
        if refines && plan.radar.waveform.sampling != Sampling::Complex {
            return Err(DspError::Refinement);
        }
        locate_points(plan, map, refines.then_some(cube.samples.as_slice()))
    }

    /// Points of a whole cycle with resolved velocities, each sub-frame's by the other chirp interval of the
    /// next. Unchanged if there is only one sub-frame, and under time division with varying chirp intervals,
    /// where a velocity's fold would also change the directions.
    pub fn resolved(&self, cycle: Vec<PointsFrame>) -> Vec<PointsFrame> {
        velocity_folds::resolved(|index| self.plan(index), cycle)
    }

    /// Crops of the objects of one map.
    ///
    /// # Errors
    /// A format without extent, a map of another shape, or non-finite values.
    pub fn cropper<'a>(&'a self, map: &'a RdmFrame, format: &CropFormat) -> Result<Cropper<'a>, DspError> {
        Cropper::new(self.plan(map.index), map, format)
    }

    /// Signatures of the objects of one map.
    ///
    /// # Errors
    /// The map has another shape, or contains non-finite values.
    pub fn signatures<'a>(&'a self, map: &'a RdmFrame) -> Result<Signatures<'a>, DspError> {
        Signatures::new(self.plan(map.index), map)
    }

    /// Gain and phase of each transmit–receive pair, tx·N_rx + rx, relative to an ideal one, from a reflector
    /// at rest at `position_m`, world metres; their mean power is 1, their sum is real. The header's
    /// calibration is not used.
    ///
    /// # Errors
    /// The map has another shape, or the reflector is outside it or too weak.
    pub fn channel_errors(&self, map: &RdmFrame, position_m: [f64; 3]) -> Result<Vec<Complex64>, DspError> {
        let plan = self.plan(map.index);
        calibration::channel_errors(&plan.array, &plan.levels(map)?, map, position_m)
    }
}
