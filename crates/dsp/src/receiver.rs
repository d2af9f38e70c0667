//! The stage of one radar: made once of a header, it takes cubes to maps, points, velocities and crops.

use crate::ambiguity::velocity_folds;
use crate::crops::crop::Cropper;
use crate::crops::signature::Signatures;
use crate::detection::range_doppler::range_doppler;
use crate::direction::calibration;
use crate::error::DspError;
use crate::objects::points::located;
use crate::plan::Plan;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::dataset::CropFormat;
use artifact::points::PointsFrame;
use artifact::radar::Sampling;
use artifact::rdm::RdmFrame;
use artifact::settings::Refine;
use num_complex::Complex64;

/// A radar's receiver: its header checked, its windows, transforms, thresholds and array worked out once, for
/// each sub-frame. A frame belongs to the sub-frame that its index says.
pub struct Receiver {
    /// Plans by sub-frame, at least one.
    plans: Vec<Plan>,
}

impl Receiver {
    /// Makes the receiver of the cubes that this header describes.
    ///
    /// # Errors
    /// What of the radar or its settings no map or no threshold can be made of.
    pub fn new(header: &CubeHeader) -> Result<Self, DspError> {
        Ok(Self { plans: Plan::of_cycle(header)? })
    }

    /// Plan of the frame record `index`.
    fn plan(&self, index: u32) -> &Plan {
        &self.plans[index as usize % self.plans.len()]
    }

    /// Frame records that belong together: the sub-frames of a cycle.
    pub fn frames_in_cycle(&self) -> usize {
        self.plans.len()
    }

    /// The map and the points of one frame.
    ///
    /// # Errors
    /// Those of [`Self::range_doppler`] and [`Self::detect_refined`].
    pub fn process(&self, cube: &CubeFrame) -> Result<(RdmFrame, PointsFrame), DspError> {
        let map = self.range_doppler(cube)?;
        let points = self.detect_refined(&map, cube)?;
        Ok((map, points))
    }

    /// The map of one frame, with the cells that the header's detector tested and those it found.
    ///
    /// # Errors
    /// Samples of another number or sampling than the radar's, and values that are no numbers.
    pub fn range_doppler(&self, cube: &CubeFrame) -> Result<RdmFrame, DspError> {
        let plan = self.plan(cube.index);
        range_doppler(&plan.transform, &plan.thresholds.detector, plan.floor, cube)
    }

    /// Points of a map, strongest first, and objects in the order of their strongest peaks.
    ///
    /// # Errors
    /// The map has another shape, or holds values that are no numbers.
    pub fn detect(&self, map: &RdmFrame) -> Result<PointsFrame, DspError> {
        located(self.plan(map.index), map, None)
    }

    /// [`Self::detect`] with the samples that the map was made of: where the settings ask for it, peaks that
    /// stand alone are refined on them.
    ///
    /// # Errors
    /// Those of [`Self::detect`]; samples that are not the radar's, or are no single tone an echo where they
    /// are asked for.
    pub fn detect_refined(&self, map: &RdmFrame, cube: &CubeFrame) -> Result<PointsFrame, DspError> {
        let plan = self.plan(map.index);
        plan.transform.shapes().check_samples(&cube.samples)?;
        let refines = plan.settings.refine == Refine::Isolated;
        if refines && plan.radar.waveform.sampling != Sampling::Complex {
            return Err(DspError::Refinement);
        }
        located(plan, map, refines.then_some(cube.samples.as_slice()))
    }

    /// The points of a whole cycle with their velocities resolved, each sub-frame's by the next one's other
    /// chirp interval. Left as they are where there is one sub-frame, and under time division of chirps at
    /// changing intervals: there a velocity's fold would turn the directions too.
    pub fn resolved(&self, cycle: Vec<PointsFrame>) -> Vec<PointsFrame> {
        velocity_folds::resolved(|index| self.plan(index), cycle)
    }

    /// Crops of the objects of one map.
    ///
    /// # Errors
    /// A format without extent, a map of another shape, or values that are no numbers.
    pub fn cropper<'a>(&'a self, map: &'a RdmFrame, format: &CropFormat) -> Result<Cropper<'a>, DspError> {
        Cropper::new(self.plan(map.index), map, format)
    }

    /// Signatures of the objects of one map.
    ///
    /// # Errors
    /// The map has another shape, or holds values that are no numbers.
    pub fn signatures<'a>(&'a self, map: &'a RdmFrame) -> Result<Signatures<'a>, DspError> {
        Signatures::new(self.plan(map.index), map)
    }

    /// Gain and phase of each transmit–receive pair, tx·N_rx + rx, against an ideal one, from a reflector at
    /// rest at `position_m`, world metres; their mean power is 1, their sum real. The header's calibration is
    /// not used.
    ///
    /// # Errors
    /// The map has another shape, or the reflector is outside of it or too weak.
    pub fn channel_errors(&self, map: &RdmFrame, position_m: [f64; 3]) -> Result<Vec<Complex64>, DspError> {
        let plan = self.plan(map.index);
        calibration::channel_errors(&plan.array, &plan.levels(map)?, map, position_m)
    }
}
