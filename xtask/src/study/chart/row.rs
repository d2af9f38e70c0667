//! Results of the study `chart` for one case.

use crate::study::chart::work::Cost;
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
    /// Reference that the error is against.
    pub(in crate::study) reference: String,
    /// Number and bytes of what the method makes; empty where they are one amplitude.
    pub(in crate::study) size: String,
}
