//! The paper's network: its answers to the splits of its dataset, and among other vehicles.

use super::run_folder::RunFolder;
use super::scene_files::text_of;
use crate::project::project_root;
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{CHAIN, RUN, SourcePaths};
use artifact::dataset::Split;
use artifact::settings::Class;
use classifier::Evaluation;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use wayside::Summary;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use wayside::outcome::summary::{Predicted, TargetSummary};

/// Sources of the answers to the splits.
pub(crate) const SOURCES: SourcePaths = &[&["fixtures/paper-network.metrics.json", file!()]];

/// Sources of the answers among other vehicles.
pub(crate) const SOURCES_OF_SCENES: SourcePaths = &[
    CHAIN,
    RUN,
    &["crates/classifier", "fixtures/paper-network.model", file!()],
    &["scenes/intersection.toml", "scenes/four-directions.toml", "scenes/street.toml"],
];

/// Part of `metrics.json` that the page tells of.
#[derive(Deserialize)]
struct Metrics {
    splits: BTreeMap<Split, Evaluation>,
}

/// Accuracy of each split, and the confusion of the test split; what training has left, whatever the extent.
pub(crate) fn section(_: Extent) -> Result<PageSection, Failure> {
    let file = project_root().join("fixtures/paper-network.metrics.json");
    let text = std::fs::read(&file).map_err(|e| Failure::system(&file, "read", e))?;
    let Metrics { splits } = serde_json::from_slice(&text).map_err(|e| Failure::refused(e).about(&file))?;
    let mut part = PageSection::default();
    part.head(&["split", "scenes", "accuracy", "95 % interval", "log loss", "calibration error"]);
    for (split, answers) in &splits {
        part.row(&cells(*split, answers));
    }
    if let Some(test) = splits.get(&Split::Test) {
        part.line("\nTest, rows true, columns predicted:\n");
        confusion(&mut part, test);
    }
    Ok(part)
}

fn cells(split: Split, answers: &Evaluation) -> [String; 6] {
    let name = match split {
        Split::Train => "train",
        Split::Validation => "validation",
        Split::Test => "test",
    };
    let [low, high] = answers.accuracy_interval;
    [
        name.to_owned(),
        answers.samples.to_string(),
        format!("{:.1} %", 100.0 * answers.accuracy),
        format!("{:.1} … {:.1} %", 100.0 * low, 100.0 * high),
        format!("{:.3}", answers.log_loss),
        format!("{:.3}", answers.calibration.expected_error),
    ]
}

fn confusion(part: &mut PageSection, answers: &Evaluation) {
    let names = Class::ALL.map(Class::name);
    part.head(&[&[""][..], &names].concat());
    for (name, counts) in names.iter().zip(answers.confusion) {
        part.named_row(name, counts.map(|count| count.to_string()));
    }
}

const SCENES: [&str; 3] = ["intersection", "four-directions", "street"];

/// Answers among other vehicles, radar by radar; for a quick study those of the first scene.
pub(crate) fn scenes_section(extent: Extent) -> Result<PageSection, Failure> {
    let scenes = if extent == Extent::Quick { &SCENES[..1] } else { &SCENES[..] };
    let (runs, work) = (RunFolder::new()?, Work::begin("scenes"));
    let mut part = PageSection::default();
    part.head(&["scene", "correct", "taken for another class"]);
    for (number, scene) in scenes.iter().enumerate() {
        work.at(number, scenes.len());
        let model = project_root().join("fixtures/paper-network.model");
        let (_, outcome) = runs.outcome(scene, &text_of(scene)?, |run| run.classifier = Some(model))?;
        let mut score = ClassScore::default();
        outcome.radars().iter().for_each(|radar| score.add(radar.folder(), radar.summary()));
        let correct = format!("{} of {}", score.right, score.right + score.wrong.len());
        part.named_row(&format!("`{scene}.toml`"), [correct, score.wrong.join("; ")]);
    }
    Ok(part)
}

/// Answers about the vehicles that were found.
#[derive(Default)]
struct ClassScore {
    right: usize,
    wrong: Vec<String>,
}

impl ClassScore {
    /// Adds those of a radar, whose folder has its name.
    fn add(&mut self, folder: &Path, summary: &Summary) {
        let found = summary.frames.iter().flat_map(|frame| &frame.targets);
        for target in found.filter(|target| target.found == Some(true)) {
            let (Some(class), Some(predicted)) = (target.class, target.predicted_class) else { continue };
            if predicted == Predicted::Class(class) {
                self.right += 1;
            } else {
                let radar = folder.file_name().map(|name| name.to_string_lossy());
                let radar = radar.filter(|radar| summary.scene.ends_with(&format!("/{radar}")));
                self.wrong.push(sentence(target, predicted, radar.as_deref()));
            }
        }
    }
}

/// Words for a wrong answer, by one of several radars or by the only one.
fn sentence(target: &TargetSummary, predicted: Predicted, radar: Option<&str>) -> String {
    let probability = target.probabilities.likeliest().map_or(0.0, |(_, probability)| probability);
    let by = radar.map_or(String::new(), |radar| format!(", by `{radar}`"));
    format!("`{}` for {} ({probability:.2}{by})", target.id, predicted.name())
}

#[cfg(test)]
mod tests {
    use super::*;
    use wayside::outcome::summary::Probabilities;

    #[test]
    fn what_training_has_left_is_read_and_a_wrong_answer_is_told_with_its_probability() {
        let (text, _) = section(Extent::Full).unwrap().finished();
        assert!(text.contains("| train | 142 | 94.4 % | 89.3 … 97.1 % | 0.226 | 0.096 |\n"), "{text}");
        assert!(text.contains("| truck | 1 | 7 | 7 | 0 |\n"), "{text}");
        let probabilities = Probabilities::of(Some(&[0.25, 0.5, 0.125, 0.125]));
        let target = TargetSummary { id: "truck-1".into(), probabilities, ..TargetSummary::default() };
        let told = sentence(&target, Predicted::Class(Class::Bus), Some("south"));
        assert_eq!(told, "`truck-1` for bus (0.50, by `south`)");
    }
}
