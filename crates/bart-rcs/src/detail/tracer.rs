//! Processing stage of one scene: constructed from a header, it turns frames into paths or tables, and
//! predicts their cost.

use crate::bodies::models::Models;
use crate::bodies::separate_wheels::SeparateWheels;
use crate::detail::level::reduce_detail;
use crate::frame::expected_work::{ExpectedWork, expected_work};
use crate::frame::left_out::echo_parts::{EchoParts, echo_parts};
use crate::frame::path::{FrameContext, trace_frame};
use crate::frame::rcs_frame::rcs_frame;
use crate::run_control::error::BartError;
use crate::run_control::memory::MemoryLimit;
use crate::run_control::progress::Progress;
use artifact::paths::PathsFrame;
use artifact::rcs::RcsFrame;
use artifact::scene::{SceneFrame, SceneHeader};

/// Tracer of a scene's frames: its meshes, each with its hierarchy, and a memory limit per frame. A `view` is
/// the scene with the bodies that one frame has in view, using the meshes of the scene; of a radar with
/// sub-frames each method takes the one of its frame.
#[derive(Clone)]
pub struct Tracer {
    models: Models,
}

impl Tracer {
    /// Constructs the tracer for all meshes of a scene, with the requested skin and without a memory limit.
    ///
    /// # Errors
    /// Unusable meshes and materials.
    pub fn new(header: &SceneHeader) -> Result<Self, BartError> {
        Ok(Self { models: Models::build(header)? })
    }

    /// This tracer with a limit on the memory of a frame's bodies and beams.
    pub fn within(self, limit: MemoryLimit) -> Self {
        Self { models: self.models.within(limit) }
    }

    /// Paths of one frame, reduced to the detail that the scene requests.
    ///
    /// # Errors
    /// Those of [`Self::all_paths`].
    pub fn paths(
        &self,
        view: &SceneHeader,
        frame: &SceneFrame,
        context: &FrameContext<'_>,
    ) -> Result<PathsFrame, BartError> {
        let view = &view.in_frame(frame.index);
        Ok(reduce_detail(view, self.all_paths(view, frame, context)?))
    }

    /// Paths of one frame from the radar's position and back, referred to the frame's first sample, in full
    /// detail.
    ///
    /// The world is frozen at the frame's middle, and what is lit then is lit throughout. If that errs by
    /// more than the requested accuracy, the sequences of bodies that change most are traced at several
    /// moments of the frame and blended ([`artifact::paths::Span`]). Amplitudes are fitted over the sampled
    /// sweep. A point target is a path of order 0 with +√σ in vv and hh; bodies do not hide it. Cells are as
    /// large as the requested accuracy permits, by measurement: paths are compared with the bodies traced and
    /// integrated anew at another moment of the frame and from another element of the array, which yields the
    /// returned error: shadows move with both, and the paths of one tree do not follow ("freezing").
    /// `error.tessellation` is the bound to which a smooth surface was subdivided; `None` if facets are the
    /// surface itself.
    ///
    /// # Errors
    /// Bodies that do not fit into the memory of a frame, and poses that do not match the view.
    pub fn all_paths(
        &self,
        view: &SceneHeader,
        frame: &SceneFrame,
        context: &FrameContext<'_>,
    ) -> Result<PathsFrame, BartError> {
        let view = &view.in_frame(frame.index);
        let apart = SeparateWheels::of(&self.models, view, frame);
        Ok(apart.joined(trace_frame(&self.models, &apart.view, &apart.frame, context)?))
    }

    /// Far-field tables of one frame, one per target.
    ///
    /// The tree is traced at the frame's middle; over the milliradians of a frame the same facets stay lit.
    /// Axes are fine enough for linear interpolation to meet the requested accuracy, up to 9 azimuths, 5
    /// elevations and 256 frequencies. Bodies do not hide one another, and the wave is not spherical:
    /// `model_error.far_field` compares each table's middle with the spherical wave. A point target has a
    /// table of one value, +√σ.
    ///
    /// # Errors
    /// Those of [`Self::all_paths`]; a scene with rotating wheels, or points on wheels, since tables hold
    /// bodies that are rigid during a frame.
    pub fn tables(
        &self,
        view: &SceneHeader,
        frame: &SceneFrame,
        progress: &dyn Progress,
    ) -> Result<RcsFrame, BartError> {
        rcs_frame(&self.models, &view.in_frame(frame.index), frame, progress)
    }

    /// Predicted work for the beams and integrals of one moment of a frame.
    ///
    /// A sample of beams is traced like all beams in [`crate::BeamTree::trace`], and each counts for those
    /// that it represents: with 256 facets a count errs by some 10 %.
    ///
    /// # Errors
    /// Those of [`Self::all_paths`].
    pub fn expected_work(&self, view: &SceneHeader, frame: &SceneFrame) -> Result<ExpectedWork, BartError> {
        let view = &view.in_frame(frame.index);
        let apart = SeparateWheels::of(&self.models, view, frame);
        expected_work(&self.models, &apart.view, &apart.frame)
    }

    /// Shares of a frame's echo by a coarse computation: orders of reflection, paths between bodies and via
    /// the road, edges and sheets, whichever of these the scene requests.
    ///
    /// Integrals are taken to a quarter, mirrors smaller than five wavelengths are not followed: results are
    /// good to a few decibels. `None` if nothing scatters, or if the beams would exceed the memory of a
    /// frame.
    ///
    /// # Errors
    /// Those of [`Self::all_paths`].
    pub fn echo_parts(
        &self,
        view: &SceneHeader,
        frame: &SceneFrame,
        progress: &dyn Progress,
    ) -> Result<Option<EchoParts>, BartError> {
        let view = &view.in_frame(frame.index);
        let apart = SeparateWheels::of(&self.models, view, frame);
        echo_parts(&self.models, &apart.view, &apart.frame, progress)
    }
}
