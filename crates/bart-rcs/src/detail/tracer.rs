//! The stage of one scene: made once of a header, it takes frames to paths, tables, and what they will cost.

use crate::bodies::models::Models;
use crate::bodies::rolling::WheelsApart;
use crate::detail::level::reduced;
use crate::frame::expected_work::{ExpectedWork, expected_work};
use crate::frame::left_out::echo_parts::{EchoParts, echo_parts};
use crate::frame::path::{FrameSurroundings, trace_frame};
use crate::frame::rcs_frame::rcs_frame;
use crate::oversight::error::BartError;
use crate::oversight::memory::MemoryLimit;
use crate::oversight::progress::Progress;
use artifact::paths::PathsFrame;
use artifact::rcs::RcsFrame;
use artifact::scene::{SceneFrame, SceneHeader};

/// What traces the frames of a scene: its meshes, each with its hierarchy, and a limit of what a frame may
/// hold. A `view` is the scene with the bodies that one frame has in view, their meshes those of the scene.
#[derive(Clone)]
pub struct Tracer {
    models: Models,
}

impl Tracer {
    /// Makes the tracer of all meshes of a scene, with the skin that it asks for, and without a limit.
    ///
    /// # Errors
    /// Meshes and materials that nothing can be computed of.
    pub fn new(header: &SceneHeader) -> Result<Self, BartError> {
        Ok(Self { models: Models::build(header)? })
    }

    /// This tracer with a limit of what the bodies and beams of a frame may hold.
    pub fn within(self, limit: MemoryLimit) -> Self {
        Self { models: self.models.within(limit) }
    }

    /// Paths of one frame with no more detail than the scene asks for.
    ///
    /// # Errors
    /// Those of [`Self::all_paths`].
    pub fn paths(
        &self,
        view: &SceneHeader,
        frame: &SceneFrame,
        surroundings: &FrameSurroundings<'_>,
    ) -> Result<PathsFrame, BartError> {
        Ok(reduced(view, self.all_paths(view, frame, surroundings)?))
    }

    /// Paths of one frame from the radar's position and back, referred to the frame's first sample, in all
    /// detail.
    ///
    /// The world is frozen at the frame's middle; what is lit then is lit all through. Where that errs by
    /// more than the accuracy asked for, the ways that change most are traced at several moments of the frame
    /// and blended ([`artifact::paths::Span`]). Amplitudes are fitted over the sampled sweep. A point target
    /// is a path of order 0 with +√σ in vv and hh; bodies do not hide it. Cells are as large as the accuracy
    /// asked for lets them be, by measurement: paths are compared with the bodies traced and integrated anew
    /// at another moment of the frame and from another element of the array, and that is the error that is
    /// returned: shadows move with both, and the paths of one tree do not follow ("freezing").
    /// `error.tessellation` is the bound that a smooth surface was cut to; `None` where facets are the
    /// surface itself.
    ///
    /// # Errors
    /// Bodies that do not fit into the memory that a frame may hold, and poses that are not those of the
    /// view.
    pub fn all_paths(
        &self,
        view: &SceneHeader,
        frame: &SceneFrame,
        surroundings: &FrameSurroundings<'_>,
    ) -> Result<PathsFrame, BartError> {
        let apart = WheelsApart::of(&self.models, view, frame);
        Ok(apart.joined(trace_frame(&self.models, &apart.view, &apart.frame, surroundings)?))
    }

    /// Far-field tables of one frame, one per target.
    ///
    /// The tree is traced at the frame's middle; over the milliradians of a frame the same facets stay lit.
    /// Axes are so fine that linear interpolation meets the accuracy asked, up to 9 azimuths, 5 elevations
    /// and 256 frequencies. Bodies neither hide one another nor is the wave spherical:
    /// `model_error.far_field` compares each table's middle with the spherical wave. A point target has a
    /// table of one value, +√σ.
    ///
    /// # Errors
    /// Those of [`Self::all_paths`]; a scene with wheels that turn, or points on wheels: tables hold bodies
    /// that are rigid while a frame lasts.
    pub fn tables(
        &self,
        view: &SceneHeader,
        frame: &SceneFrame,
        progress: &dyn Progress,
    ) -> Result<RcsFrame, BartError> {
        rcs_frame(&self.models, view, frame, progress)
    }

    /// The work of the beams and integrals of one moment of a frame.
    ///
    /// A sample of beams is traced as [`crate::BeamTree::trace`] traces all, and each counts for those that
    /// it stands for: of 256 facets a count errs by some 10 %.
    ///
    /// # Errors
    /// Those of [`Self::all_paths`].
    pub fn expected_work(&self, view: &SceneHeader, frame: &SceneFrame) -> Result<ExpectedWork, BartError> {
        let apart = WheelsApart::of(&self.models, view, frame);
        expected_work(&self.models, &apart.view, &apart.frame)
    }

    /// What the parts of a frame's echo are to all of it, by a coarse look: orders of reflection, ways
    /// between bodies and by the road, edges, sheets, whatever of it the scene asks for.
    ///
    /// Integrals are taken to a quarter, mirrors smaller than five wavelengths are not followed: a figure is
    /// good to a few decibels. `None` where nothing scatters, and where the beams would take more memory than
    /// the frame may.
    ///
    /// # Errors
    /// Those of [`Self::all_paths`].
    pub fn parts(
        &self,
        view: &SceneHeader,
        frame: &SceneFrame,
        progress: &dyn Progress,
    ) -> Result<Option<EchoParts>, BartError> {
        let apart = WheelsApart::of(&self.models, view, frame);
        echo_parts(&self.models, &apart.view, &apart.frame, progress)
    }
}
