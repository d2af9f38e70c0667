//! Results of the study `chart` for one case.

/// One setting of one method on one piece of work.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct SettingRow {
    pub(in crate::study) stage: &'static str,
    pub(in crate::study) scene: String,
    pub(in crate::study) method: &'static str,
    pub(in crate::study) setting: String,
    pub(in crate::study) seconds: f64,
    /// Largest resident size of the program while this ran, MiB.
    pub(in crate::study) peak_mib: Option<f64>,
    /// Relative amplitude.
    pub(in crate::study) error: f64,
    /// Reference that the error is against.
    pub(in crate::study) reference: String,
}
