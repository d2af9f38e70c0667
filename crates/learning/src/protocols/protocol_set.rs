//! Protocols that evaluate a training: the sightings of each, and its answers to them.

use artifact::dataset::Split;
use classifier::{
    ClassificationMetrics, Logits, Sighting, Sightings, TrainedModel, answer, metrics_by_frame_and_track,
};
use pipeline::host::safe_text::in_markdown;
use std::path::{Path, PathBuf};

/// Protocol that evaluates every training: a name, and its sightings with the sources of their answers.
pub(super) struct Protocol<'a> {
    pub(super) name: String,
    pub(super) seen: Vec<(&'a Sighting, AnswerSource)>,
}

/// Source of the answer to a sighting.
#[derive(Clone, Copy)]
pub(super) enum AnswerSource {
    /// Answer from the training, with this number.
    Trained(usize),
    /// Answer by the finished model.
    Test,
}

/// Filter of the sightings in a row.
pub(super) type SightingFilter = fn(&Sighting) -> bool;

/// Name of the protocol of all held-out vehicles.
pub(super) const HELD_OUT: &str = "V: vehicles held out in turn";

/// Name of a folder on the page.
pub(super) fn name_of(folder: &Path) -> String {
    in_markdown(&folder.display().to_string()).into_owned()
}

pub(super) fn of_training<'a>(learned: &'a Sightings, folders: &[PathBuf]) -> Vec<Protocol<'a>> {
    let those = |name: String, filter: &dyn Fn(&Sighting) -> bool| {
        let all = learned.all.iter().enumerate().filter(|(_, seen)| filter(seen));
        Protocol { name, seen: all.map(|(number, seen)| (seen, AnswerSource::Trained(number))).collect() }
    };
    let held_out = |seen: &Sighting| seen.split != Split::Test && !seen.is_cross();
    let mut all = vec![
        those("S: scenes of the test split".into(), &|seen| seen.split == Split::Test),
        those(HELD_OUT.into(), &held_out),
    ];
    let name = |folder: &Path| format!("V: of {}", name_of(folder));
    if folders.len() > 1 {
        let one =
            |(n, folder): (usize, &PathBuf)| those(name(folder), &|seen| held_out(seen) && seen.track.0 == n);
        all.extend(folders.iter().enumerate().map(one));
    }
    all.retain(|protocol| !protocol.seen.is_empty());
    all
}

pub(super) fn of_test(name: String, test: &Sightings) -> Protocol<'_> {
    Protocol { name, seen: test.all.iter().map(|seen| (seen, AnswerSource::Test)).collect() }
}

/// Metrics of a training on those of a protocol's sightings that pass `filter`, by frame and by track; `None`
/// without any.
pub(super) fn evaluate(
    protocol: &Protocol<'_>,
    trained: &TrainedModel,
    filter: SightingFilter,
) -> Option<[ClassificationMetrics; 2]> {
    let (seen, logits): (Vec<&Sighting>, Vec<Logits>) =
        answers(protocol, trained, filter).into_iter().unzip();
    (!seen.is_empty()).then(|| metrics_by_frame_and_track(&seen, &logits, trained.metrics.frame_correlation))
}

pub(super) fn answers<'a>(
    protocol: &Protocol<'a>,
    trained: &TrainedModel,
    filter: SightingFilter,
) -> Vec<(&'a Sighting, Logits)> {
    let answered = |&(seen, source): &(&'a Sighting, AnswerSource)| match source {
        AnswerSource::Trained(number) => (seen, trained.held_out_logits[number]),
        AnswerSource::Test => (seen, answer(&trained.weights, seen)),
    };
    protocol.seen.iter().filter(|(seen, _)| filter(seen)).map(answered).collect()
}
