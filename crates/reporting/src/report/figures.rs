//! Pictures and names of artifacts for a run's report.

use crate::pictures::FrameFigures;
use crate::pictures::radar_view::Seen;
use crate::report::viewer::Viewed;
use plotting::form::Figure;

/// Pictures for the report.
#[derive(Default)]
pub struct Figures {
    /// Names of the artifacts that the run writes beside its report.
    pub artifacts: Vec<&'static str>,
    /// Pictures of the first frames, in order.
    pub frames: Vec<FrameFigures>,
    /// Number and view from above of every n-th frame of a long scene.
    pub strip: Vec<(u32, Figure)>,
    /// Points and scenes of the first frames, for comparison with other radars.
    pub seen: Vec<Seen>,
    /// Numbers of the interactive view.
    pub viewed: Viewed,
}
