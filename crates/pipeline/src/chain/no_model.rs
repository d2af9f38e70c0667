//! Stand-in for the classifier in programs built without it: there is no model, and points keep null
//! probabilities.

use crate::chain::class_rule::ClassRule;
use crate::host::failure::Failure;
use artifact::classes::ClassesHeader;
use artifact::points::PointsFrame;
use artifact::rdm::RdmFrame;
use std::path::Path;

/// A model; this program has none.
pub enum LoadedModel {}

impl LoadedModel {
    /// Refuses every model.
    pub(crate) fn read(place: &Path) -> Result<Self, Failure> {
        let place = place.display();
        Err(Failure::refused(format!("{place}: the program was built without its feature `classifier`")))
    }

    /// Key of a cache; never called.
    pub fn hash(&self) -> &str {
        match *self {}
    }

    /// Header of classes; never called.
    pub(crate) fn classes_header(&self) -> ClassesHeader {
        match *self {}
    }

    /// Rule of classes; never called.
    pub fn rule(&self) -> ClassRule {
        match *self {}
    }

    /// Probabilities of objects; never called.
    pub fn classify(
        &self,
        _: &dsp::Receiver,
        _: &RdmFrame,
        _: &PointsFrame,
    ) -> Result<Vec<[f32; 4]>, Failure> {
        match *self {}
    }
}
