//! Studies that are refused: each broken rule with file, place and sentence, before a run is made.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{Workplace, bounded};

/// A study that is carried out.
const WHOLE: &str = "scene = \"small.toml\"\n[[vary]]\nkey = \"radar.array.preset\"\nvalues = [\"1x4\", \"3x4\"]\n\
                     [goal]\nmetric = \"coverage\"\n";

/// What the program says of a study, and its exit code.
fn said_of(place: &Workplace, study: &str) -> (String, Option<i32>) {
    std::fs::write(place.path("study.toml"), study).unwrap();
    let output = place.try_run("sweep study.toml --out out --no-cache --quiet");
    (String::from_utf8(output.stderr).unwrap(), output.status.code())
}

/// A study with other words in the place of some is refused with a sentence and its place.
fn refused(place: &Workplace, (found, instead): (&str, &str), expected: &str) {
    assert!(WHOLE.contains(found), "{found}");
    let (said, code) = said_of(place, &WHOLE.replace(found, instead));
    assert!(said.contains(expected) && said.contains("study.toml:"), "{instead}: {said}");
    assert_eq!(code, Some(1), "{said}");
}

#[test]
fn every_broken_rule_of_a_study_is_told_with_its_place() {
    let place = Workplace::new();
    let goal = "[goal]\nmetric = \"coverage\"";
    for (found, instead, expected) in [
        ("scene =", "scnee =", "study.toml:1:1: unknown key `scnee`; the nearest is `scene`"),
        ("values =", "vlaues =", "study.toml:4:1: [[vary]]: unknown key `vlaues`; the nearest is `values`"),
        (
            "\"coverage\"",
            "\"coverge\"",
            "[goal]: `metric`: there is no metric `coverge`; the nearest is `coverage`",
        ),
        ("scene = \"small.toml\"\n", "", "`scene` is missing"),
        (goal, "", "`goal` is missing"),
        ("metric = \"coverage\"", "better = \"lower\"", "[goal]: `metric` is missing"),
        (
            goal,
            "[goal]\nmetric = \"coverage\"\nbetter = \"best\"",
            "`better` has to be \"lower\" or \"higher\"",
        ),
        ("key = \"radar.array.preset\"\n", "", "one of `key` and `keys` has to be given"),
        ("values = [\"1x4\", \"3x4\"]\n", "", "one of `values` and `draw` has to be given"),
        (
            "values = [\"1x4\", \"3x4\"]",
            "values = []",
            "`values` has to be a list of 1 to 10000 values, has 0",
        ),
        ("values = [\"1x4\", \"3x4\"]", "values = 3", "`values` has to be a list, is 3"),
        ("values = [\"1x4\", \"3x4\"]", "draw = { uniform = [1, 2] }", "asks for [sample]"),
        ("values = [\"1x4\", \"3x4\"]", "draw = { uniform = [2, 1] }", "`draw` has to be one of"),
        ("values = [\"1x4\", \"3x4\"]", "draw = { whole = [1, 2.5] }", "`draw` has to be one of"),
        ("[goal]", "labels = [\"small\"]\n[goal]", "`labels` has to have one for each of 2 `values`, has 1"),
        ("key = \"radar.array.preset\"", "keys = [\"seed\", \"frames\"]", "has to be a list of 2 values"),
        (
            "[goal]",
            "[[condition]]\nkey = \"radar.array.preset\"\nvalues = [\"1x4\"]\n[goal]",
            "is changed by two of",
        ),
        ("[goal]", "[sample]\n[goal]", "[sample]: `count` is missing"),
        ("[goal]", "[sample]\ncount = 0\n[goal]", "`count` has to be a whole number from 1 to 100000, is 0"),
        (
            "[goal]",
            "[stop]\nconfidence = 1\n[goal]",
            "`confidence` has to be a number from 0.5 to 0.9999, is 1",
        ),
        ("[[vary]]", "repeats = 0\n[[vary]]", "`repeats` has to be a whole number from 1 to 10000, is 0"),
        ("[[vary]]", "range_bands_m = [30, 20]\n[[vary]]", "`range_bands_m` has to be"),
        ("[[vary]]", "[vary]", "`vary` has to be a list, is"),
        ("[goal]", "[goal", "not valid TOML"),
    ] {
        refused(&place, (found, instead), expected);
    }
    let unvaried = "scene = \"small.toml\"\n[goal]\nmetric = \"coverage\"\n";
    assert!(said_of(&place, unvaried).0.contains("`vary` is missing"));
    assert!(!place.path("out").join("runs").exists(), "nothing is computed before all is read");
}

#[test]
fn what_changes_nothing_is_refused() {
    let place = Workplace::new();
    for (found, instead, expected) in [
        ("radar.array.preset", "name", "study.toml:4:11: `name` changes nothing"),
        (
            "radar.array.preset",
            "fidelity.measured_every",
            "study.toml:4:11: `fidelity.measured_every` changes",
        ),
        (
            "[goal]",
            "[[condition]]\nkey = \"seed\"\nvalues = [1, 2]\n[goal]",
            "study.toml:7:11: `seed` changes nothing: every situation has a seed of its own",
        ),
        ("radar.array.preset", "fidelity.plan", "study.toml:4:11: `fidelity.plan` changes nothing"),
        (
            "\"3x4\"",
            "'1x4'",
            "study.toml:4:18: designs 0 and 1 are one scene: with radar.array.preset = \"1x4\" it is",
        ),
        (
            "key = \"radar.array.preset\"\nvalues = [\"1x4\", \"3x4\"]",
            "key = \"frame_interval_s\"\nvalues = [0.1, 0.10]",
            "study.toml:4:16: designs 0 and 1 are one scene: with frame_interval_s = 0.10 it is what it is with \
             frame_interval_s = 0.1",
        ),
    ] {
        refused(&place, (found, instead), expected);
    }
}

#[test]
fn keys_of_which_one_holds_the_other_are_refused() {
    let place = Workplace::new();
    let condition = |key: &str, value: &str| format!("[[condition]]\nkey = \"{key}\"\nvalues = [{value}]\n");
    let whole = condition("radar.array", "{ preset = \"1x4\" }");
    let one_place = condition("target.0.id", "\"a\"") + &condition("target.00.id", "\"b\"");
    for (conditions, expected) in [
        (whole, "`radar.array` and `radar.array.preset`, of which one holds the other,"),
        (one_place, "`target.00.id` and `target.0.id`"),
    ] {
        let (said, code) = said_of(&place, &WHOLE.replace("[goal]", &format!("{conditions}[goal]")));
        assert!(said.contains(expected) && code == Some(1), "{said}");
    }
}

#[test]
fn what_the_scene_refuses_is_told_with_the_line_that_changes_it_and_the_scenes_own_sentence() {
    let place = Workplace::new();
    for (found, instead, expected) in [
        (
            "key = \"radar.array.preset\"\nvalues = [\"1x4\", \"3x4\"]",
            "key = \"radar.hight_m\"\nvalues = [5.0]",
            "study.toml:4:11: with radar.hight_m = 5.0 the scene says:\nsmall.toml:6:2: [radar]: unknown key `hight_m`",
        ),
        (
            "\"3x4\"",
            "\"3x5\"",
            "study.toml:4:18: with radar.array.preset = \"3x5\" the scene says:\nsmall.toml:11:",
        ),
        // What stands in no table of the scene has no place there.
        (
            "key = \"radar.array.preset\"\nvalues = [\"1x4\", \"3x4\"]",
            "key = \"fidelity.bounces\"\nvalues = [1,\n  99]",
            "study.toml:5:3: with fidelity.bounces = 99 the scene says:\n\
             small.toml: [fidelity]: `bounces` must be a number from 1 to 5",
        ),
        (
            "radar.array.preset",
            "target.7.id",
            "`target.7.id`: `7` is no entry of a list of 2, counted from 0",
        ),
        (
            "radar.array.preset",
            "seed.of.noise",
            "`seed.of.noise`: `of` is asked of what is neither table nor list",
        ),
        ("radar.array.preset", "radar..preset", "`radar..preset`: a key between two points is empty"),
    ] {
        assert!(WHOLE.contains(found), "{found}");
        let (said, code) = said_of(&place, &WHOLE.replace(found, instead));
        assert!(said.contains(expected), "{instead}: {said}");
        assert_eq!(code, Some(1), "{said}");
    }
    for gone in ["gone.toml", "/gone/scene.toml"] {
        let (said, code) = said_of(&place, &WHOLE.replace("small.toml", gone));
        assert!(said.contains(&format!("study.toml: {gone}: ")) && code == Some(2), "{code:?} {said}");
    }
}

#[test]
fn what_a_design_and_a_situation_ask_for_together_is_told_with_both() {
    let place = Workplace::new();
    let study = WHOLE
        .replace("radar.array.preset", "frame_interval_s")
        .replace("[\"1x4\", \"3x4\"]", "[0.1, 0.05]")
        .replace("[goal]", "[[condition]]\nkey = \"radar.waveform.chirps\"\nvalues = [16, 4000]\n[goal]");
    let (said, code) = said_of(&place, &study);
    let expected = "study.toml:4:16: with frame_interval_s = 0.05, radar.waveform.chirps = 4000 the scene \
                    says:\nsmall.toml:";
    assert!(said.contains(expected) && code == Some(1), "{said}");
}

#[test]
fn a_study_deeper_than_any_scene_is_refused_and_does_not_end_the_program() {
    let place = Workplace::new();
    let names = |count: usize| vec!["a"; count].join(".");
    let tables = format!("{{ {} = ", names(79)).repeat(79);
    let levels = format!("{tables}1{}", " }".repeat(79));
    let values = "values = [\"1x4\", \"3x4\"]";
    for (found, instead, line) in [
        ("radar.array.preset", names(1 << 18), "study.toml:4:11: with a.a."),
        (values, format!("values = [{levels}]"), "study.toml:4:"),
        ("[goal]", format!("[goal]\ncost = {levels}"), "study.toml:6:"),
    ] {
        let (said, code) = said_of(&place, &WHOLE.replace(found, &instead));
        let rule = "a value lies within more than 64 tables and lists";
        assert!(said.contains(rule) && said.contains(line) && code == Some(1), "{code:?} {line} {said}");
    }
}

/// Address space in which the program reads a study, KiB; 10¹² conditions have no place there.
#[cfg(unix)]
const MOST_KIB: u64 = 2 << 20;

#[cfg(unix)]
#[test]
fn too_many_conditions_are_refused_by_their_number_before_they_are_made() {
    let place = Workplace::new();
    let condition = |axis: usize| {
        let values: Vec<String> = (0..100).map(|value| format!("{value}.0")).collect();
        format!("[[condition]]\nkey = \"target[1].position_m[{axis}]\"\nvalues = [{}]\n", values.join(", "))
    };
    let conditions: String = (0..6).map(condition).collect();
    std::fs::write(place.path("study.toml"), WHOLE.replace("[goal]", &format!("{conditions}[goal]")))
        .unwrap();
    let words = "sweep study.toml --out out --no-cache --quiet --threads 1";
    let ended = bounded::run_within(MOST_KIB, place.root(), words.split_whitespace());
    assert_eq!(ended.status.code(), Some(1), "{}", ended.said);
    assert!(
        ended.said.contains("study.toml:1:1: the study has 2000000000000 runs, more than 10000000"),
        "{}",
        ended.said
    );
}

#[test]
fn a_study_whose_result_would_replace_its_scene_is_refused_before_a_run_is_made() {
    let place = Workplace::new();
    std::fs::create_dir(place.path("out")).unwrap();
    for result in ["designs.csv", "report.md"] {
        std::fs::copy(place.path("small.toml"), place.path("out").join(result)).unwrap();
        std::fs::copy(place.path("corner.obj"), place.path("out/corner.obj")).unwrap();
        let (said, code) = said_of(&place, &WHOLE.replace("small.toml", &format!("out/{result}")));
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(&format!("out/{result}: cannot be written: it is an input")), "{said}");
        assert_eq!(place.bytes(&format!("out/{result}")), place.bytes("small.toml"));
        assert!(!place.path("out/runs").exists(), "{result}: runs were made for nothing");
        std::fs::remove_file(place.path("out").join(result)).unwrap();
    }
}
