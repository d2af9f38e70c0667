//! Results of the study `chart` for one case.

use crate::study::chart::cost::Cost;
use serde::{Deserialize, Serialize};

/// One setting of one method on one piece of work.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::study) struct SettingRow {
    pub(in crate::study) stage: String,
    pub(in crate::study) scene: String,
    pub(in crate::study) method: String,
    pub(in crate::study) setting: String,
    pub(in crate::study) cost: Cost,
    /// Relative amplitude.
    pub(in crate::study) error: f64,
    /// Reference for the error.
    pub(in crate::study) reference: String,
    /// Number and bytes of the method's output; empty if it is one amplitude.
    pub(in crate::study) size: String,
}
