//! Pictures and names of artifacts for a run's report.

use crate::pictures::FrameFigures;
use crate::pictures::radar_frame::RadarFrame;
use crate::report::viewer::ViewerData;
use plotting::layout::Figure;

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
    pub radar_frames: Vec<RadarFrame>,
    /// Numbers of the interactive view.
    pub viewer: ViewerData,
}
