//! Results of the study `levels` for one case.

use artifact::settings::Detail;

/// One level of detail of one frame, at one requested accuracy.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct LevelRow {
    pub(in crate::study) scene: &'static str,
    pub(in crate::study) asked_db: f64,
    pub(in crate::study) level: Detail,
    /// Level of each target, if chosen by the program.
    pub(in crate::study) chosen: String,
    pub(in crate::study) paths: usize,
    /// Reported error of the echo relative to that of all paths, over the whole cube. `None` for all paths.
    pub(in crate::study) told: Option<f64>,
    pub(in crate::study) error: Option<f64>,
    /// Root sum of squares of all errors that the run reports, without the echo's.
    pub(in crate::study) total: Option<f64>,
    /// Processor seconds of tracing, of reduction, of the echo.
    pub(in crate::study) seconds: [f64; 3],
}
