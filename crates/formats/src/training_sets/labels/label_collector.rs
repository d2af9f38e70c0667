//! Bodies of labels while they are read, with the faults of all files and the labels that are left out.

use crate::levelled_axes::LevelledAxes;
use crate::training_sets::labels::label_error::{BODY_LIMIT, LabelError};
use crate::training_sets::labels::sensor_box::SensorBox;
use evaluation::LabelledBox;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::path::Path;

/// Number of faults that are told; more are counted.
const MOST_FAULTS: usize = 100;

/// A label of a body.
pub(super) struct Label {
    /// File and line or row.
    pub(super) place: String,
    /// Number of the body over all frames, if the set tells it.
    pub(super) number: Option<u32>,
    pub(super) seen: SensorBox,
}

/// Labels read so far.
pub(super) struct LabelCollector {
    axes: LevelledAxes,
    /// Number of labels of each class that is left out.
    left_out: BTreeMap<String, usize>,
    faults: Vec<String>,
    /// Number of faults beyond those.
    more_faults: usize,
    /// Whether each body so far has a number that no other of its frame has.
    tells_bodies: bool,
}

impl LabelCollector {
    /// Nothing read yet, of a sensor with these axes.
    pub(super) fn of(axes: LevelledAxes) -> Self {
        Self { axes, left_out: BTreeMap::new(), faults: vec![], more_faults: 0, tells_bodies: true }
    }

    /// Counts a label of a class that is no body to be found.
    pub(super) fn leave_out(&mut self, class: &str) {
        *self.left_out.entry(class.to_owned()).or_default() += 1;
    }

    /// Records a fault with its place.
    pub(super) fn fault(&mut self, place: impl Display, error: &LabelError) {
        if self.faults.len() < MOST_FAULTS {
            self.faults.push(format!("{place}: {error}"));
        } else {
            self.more_faults += 1;
        }
    }

    /// Bodies of a frame in the world; `place` is that of its labels.
    pub(super) fn frame(&mut self, place: impl Display, labels: &[Label]) -> Vec<LabelledBox> {
        if labels.len() > BODY_LIMIT {
            self.fault(place, &LabelError::Bodies);
            return vec![];
        }
        let numbers: BTreeSet<u32> = labels.iter().filter_map(|label| label.number).collect();
        self.tells_bodies &= numbers.len() == labels.len();
        let mut bodies = Vec::with_capacity(labels.len());
        for (label, order) in labels.iter().zip(0..) {
            match label.seen.in_world(&self.axes, label.number.unwrap_or(order)) {
                Ok(body) => bodies.push(body),
                Err(error) => self.fault(&label.place, &error),
            }
        }
        bodies
    }

    /// Notes what was left out of the labels at `place`, and returns whether they tell which body of a frame
    /// is which of another.
    ///
    /// # Errors
    /// Faults were recorded: a line for each.
    pub(super) fn finish(self, place: &Path) -> Result<bool, Failure> {
        if !self.faults.is_empty() {
            let more = (self.more_faults > 0).then(|| format!("and {} more faults", self.more_faults));
            let lines: Vec<String> = self.faults.into_iter().chain(more).collect();
            return Err(Failure::Refused(lines.join("\n")));
        }
        if !self.left_out.is_empty() {
            let told = self.left_out.iter().map(|(class, count)| format!("{count} {class}"));
            let told = told.collect::<Vec<_>>().join(", ");
            progress::note(format!("note: {}: not counted as bodies: {told}", place.display()));
        }
        Ok(self.tells_bodies)
    }
}
