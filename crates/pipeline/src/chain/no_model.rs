//! In place of the classifier where the program is built without it: there is no model, points keep null
//! probabilities.

use crate::chain::class_rule::ClassRule;
use crate::host::failure::Failure;
use artifact::classes::ClassesHeader;
use artifact::points::PointsFrame;
use artifact::rdm::RdmFrame;
use std::path::Path;

/// A model, of which there is none.
pub enum LoadedModel {}

impl LoadedModel {
    /// Refuses every model.
    pub(crate) fn read(place: &Path) -> Result<Self, Failure> {
        let place = place.display();
        Err(Failure::refused(format!("{place}: the program was built without its feature `classifier`")))
    }

    /// Key of a cache; never asked.
    pub fn hash(&self) -> &str {
        match *self {}
    }

    /// Header of classes; never asked.
    pub(crate) fn classes_header(&self) -> ClassesHeader {
        match *self {}
    }

    /// Rule of classes; never asked.
    pub fn rule(&self) -> ClassRule {
        match *self {}
    }

    /// Probabilities of objects; never asked.
    pub fn classify(
        &self,
        _: &dsp::Receiver,
        _: &RdmFrame,
        _: &PointsFrame,
    ) -> Result<Vec<[f32; 4]>, Failure> {
        match *self {}
    }
}
