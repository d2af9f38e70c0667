//! Studies of small scenes by the library: which design is taken where some find less than others, what a
//! design costs, and what is remarked and refused.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use pipeline::host::cancellation::Cancellation;
use pipeline::host::memory::Allowance;
use std::path::Path;
use sweeps::{Outcome, Settings};
use tempfile::TempDir;

/// A point before a small radar.
const SCENE: &str = r#"
name = "base"
[radar.waveform]
samples = 64
chirps = 16
[radar.array]
preset = "3x4"
[noise]
noise_figure_db = 12.0
[dsp]
training_cells = [3, 6]
[[target]]
kind = "point"
id = "p"
rcs_m2 = 3.0
position_m = [5.75, 30.0, 1.0]
velocity_mps = [0.0, -5.0, 0.0]
"#;

fn prepared(scene: &str, study: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    std::fs::write(folder.path().join("study.toml"), format!("scene = \"scene.toml\"\n{study}")).unwrap();
    folder
}

/// Carries the study of a folder out: its outcome, or the sentence that refuses it.
fn carried_out(folder: &Path) -> Result<Outcome, String> {
    part(folder, Some([1, 1])).map(Option::unwrap)
}

/// Makes a part of a study, or none and concludes it.
fn part(folder: &Path, shard: Option<[u32; 2]>) -> Result<Option<Outcome>, String> {
    let settings = Settings {
        study: folder.join("study.toml"),
        out: folder.join("out"),
        shard,
        seed: None,
        classifier: None,
        cache: None,
        memory: Allowance::of(None),
        command: "sweep".into(),
        tell: &|_| {},
        cancellation: Cancellation::default(),
    };
    sweeps::run(&settings).map_err(|failure| failure.to_string())
}

/// A column of `designs.csv`, counted from the right: a value of an axis may hold commas.
fn column(folder: &Path, name: &str) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join("out/designs.csv")).unwrap();
    let mut rows = text.lines().map(|line| line.rsplit(',').map(str::to_owned).collect::<Vec<_>>());
    let at = rows.next().unwrap().iter().position(|head| head == name).unwrap_or_else(|| panic!("{name}"));
    rows.map(|row| row[at].clone()).collect()
}

fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A weak transmitter finds the strong target alone, and tells its velocity less exactly than the strong one
/// does; this finds the weak target too, which costs it the better mean.
const FINDS_LESS: &str = r#"
repeats = 8
[[vary]]
key = "radar.link.transmit_power_dbm"
values = [-3.0, 17.0]
[[condition]]
key = "target.0.rcs_m2"
values = [0.2, 300.0]
[goal]
metric = "velocity_error_mps"
"#;

#[test]
fn a_design_that_finds_less_is_not_taken_where_it_errs_by_more_in_every_situation_that_both_find() {
    let folder = prepared(SCENE, FINDS_LESS);
    let outcome = carried_out(folder.path()).unwrap();
    let number = |name: &str| -> Vec<f64> {
        column(folder.path(), name).iter().map(|cell| cell.parse().unwrap()).collect()
    };
    let [known, errors] = ["velocity_error_mps_situations", "velocity_error_mps"].map(number);
    assert!(known[0] < known[1] && errors[0] < errors[1], "the case: {known:?} {errors:?}");
    assert!(outcome.chosen == Some(1), "{}", outcome.answer);
    assert_eq!(column(folder.path(), "front"), ["no", "yes"]);
    assert_eq!(number("situations"), [16.0; 2]);
    assert_eq!(number("behind_situations")[0], known[0]);
    let told = unwrapped(&outcome.answer);
    let remark = format!(
        "1 of 2 designs knows velocity_error_mps in FEWER SITUATIONS than others, design 0 in {} of 16:",
        known[0]
    );
    assert!(told.contains(&remark) && told.contains("Look at a detection rate"), "{told}");
    for name in ["report.md", "report.html"] {
        let report = unwrapped(&std::fs::read_to_string(folder.path().join("out").join(name)).unwrap());
        assert!(report.contains(&remark), "{name}: {report}");
    }
}

#[test]
fn values_per_frame_are_the_samples_of_the_frames_cubes() {
    let study =
        of_axis("key = \"radar.array.multiplexing\"\nvalues = [\"simultaneous\", \"tdm\", \"ddm\", \"bpm\"]");
    let folder = prepared(SCENE, &study);
    carried_out(folder.path()).unwrap();
    // Pairs, pairs, receivers, and four slots for three transmitters.
    let expected = [12, 12, 4, 16].map(|channels: u32| (channels * 16 * 64).to_string());
    assert_eq!(column(folder.path(), "values_per_frame"), expected);
    let sub_frames = of_axis("key = \"radar.waveform.sub_frame_idle_us\"\nvalues = [[10.0, 20.0]]");
    let folder = prepared(SCENE, &sub_frames);
    carried_out(folder.path()).unwrap();
    assert_eq!(column(folder.path(), "values_per_frame"), [(2 * 12 * 16 * 64).to_string()]);
}

/// A study of one axis.
fn of_axis(axis: &str) -> String {
    format!("[[vary]]\n{axis}\n[goal]\nmetric = \"coverage\"\n")
}

#[test]
fn what_an_axis_may_not_say_is_refused_with_a_remedy() {
    for (axis, expected) in [
        (
            "key = \"radar.positon_m.2\"\nvalues = [4.0, 6.0]",
            "unknown key `positon_m`; the nearest is `position_m`",
        ),
        (
            "key = \"dsp.guard_cells.0\"\nvalues = [1, 2]",
            "`guard_cells` is a list that the scene leaves out: change all of it",
        ),
        (
            "key = \"radar.array.preset\"\nvalues = [\"1x4\", \"3x4\"]\nlabels = [\"small\", \"small\"]",
            "study.toml:5:20: [[vary]]: `labels` has `small` twice: the two could not be told apart",
        ),
        (
            "key = \"noise.snr_db\"\ndraw = { uniform = [2.0, 1.0] }",
            "{ whole = [least, greatest] }, with the least below the greatest",
        ),
    ] {
        let folder = prepared(SCENE, &of_axis(axis));
        let refused = carried_out(folder.path()).err().unwrap();
        assert!(refused.contains(expected), "{axis}: {refused}");
    }
}

#[test]
fn a_plan_of_the_scene_that_a_study_does_not_follow_is_told() {
    let study = of_axis("key = \"radar.array.preset\"\nvalues = [\"1x4\", \"3x4\"]");
    let remark = "`plan = \"accuracy\"` of [fidelity] is not followed";
    for (fidelity, is_told) in [("plan = \"accuracy\"", true), ("plan = \"as-said\"", false)] {
        let folder = prepared(&format!("{SCENE}[fidelity]\n{fidelity}\n"), &study);
        let told = unwrapped(&carried_out(folder.path()).unwrap().answer);
        assert_eq!(told.contains(remark), is_told, "{told}");
    }
}

/// Engines call all parts again as long as concluding says something new: the number of runs that lack is
/// that of a repeat and stays the same.
#[test]
fn concluding_a_stopped_study_says_another_sentence_after_every_round_of_its_parts() {
    let axis = "key = \"radar.link.transmit_power_dbm\"\nvalues = [-45.0, -20.0, 12.0]";
    let study = format!("repeats = 12\n{}[stop]\nleast = 2\n", of_axis(axis));
    let folder = prepared(SCENE, &study);
    let mut said: Vec<String> = vec![];
    let whole = loop {
        (1..=4).for_each(|number| drop(part(folder.path(), Some([number, 4])).unwrap()));
        match part(folder.path(), None) {
            Ok(whole) => break whole,
            Err(sentence) => {
                assert!(!said.contains(&sentence), "{sentence} again: {said:?}");
                assert!(sentence.contains(" runs are not made yet, "), "{sentence}");
                said.push(sentence);
            }
        }
    };
    assert!(whole.is_some() && said.len() > 4, "{said:?}");
}
