//! Results of the study `levels` for one case.

use artifact::settings::Detail;

/// One level of detail of one frame, at one accuracy asked for.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct LevelRow {
    pub(in crate::study) scene: &'static str,
    pub(in crate::study) asked_db: f64,
    pub(in crate::study) level: Detail,
    /// Level that each target took, where the program chose.
    pub(in crate::study) chosen: String,
    pub(in crate::study) paths: usize,
    /// Error of the echo against that of all paths: as told by the run, over the whole cube. `None` of all
    /// paths.
    pub(in crate::study) told: Option<f64>,
    pub(in crate::study) error: Option<f64>,
    /// Root of the sum of squares of all that the run tells, the echo's apart.
    pub(in crate::study) total: Option<f64>,
    /// Processor seconds of tracing, of reducing, of the echo.
    pub(in crate::study) seconds: [f64; 3],
}
