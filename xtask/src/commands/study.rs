//! `chart`
use crate::{cli::StudyArguments, failure::Failure};
pub(crate) fn chart(_: &StudyArguments) -> Result<(), Failure> {
    Ok(())
}
pub(crate) fn atlas(_: &StudyArguments) -> Result<(), Failure> {
    Ok(())
}
