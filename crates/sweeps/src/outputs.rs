//! Results of a study: tables, a picture and a report.

pub(crate) mod accuracy;
pub(crate) mod gaps;
pub(crate) mod tables;
pub(crate) mod picture;
pub(crate) mod blocks;
pub(crate) mod report;
pub(crate) mod earlier_study;
pub(crate) mod view;
