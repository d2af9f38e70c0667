//! `protocols`: what several trainings say where they never looked.

use crate::common::{Workplace, crops};

#[test]
fn scenes_vehicles_and_other_datasets_are_rows_of_one_table_and_two_runs_say_the_same() {
    let place = Workplace::new();
    crops::write(&place.path("a"), 20);
    crops::write_some(&place.path("b"), 20..30);
    let vehicle =
        r#"{"target":0,"estimate":{"snr_db":12.0},"range_m":40.0,"x_m":0.0,"y_m":40.0,"yaw_deg":0.0}"#;
    let scene = format!(r#"{{"scene":0,"is_queue":false,"frames":[{{"vehicles":[{vehicle}]}}]}}"#);
    std::fs::write(place.path("a/shard-0000.jsonl"), scene + "\n").unwrap();
    let words = "protocols a --test b --learner trees --seeds 2 --curves --quiet";
    let said = place.run(&format!("{words} --out p.md"));
    assert_eq!(place.bytes("p.md"), said.as_bytes());
    for row in [
        "| S: scenes of the test split | all |",
        "| T: b never seen | all |",
        "| T: b never seen | without rows |",
    ] {
        assert!(said.contains(row), "{row}: {said}");
    }
    assert!(!said.contains("with rows | 4"), "no array has rows: {said}");
    // One vehicle of each class is all there is, told by its length: known ones are told, held-out ones
    // cannot be.
    let right = |row: &str| -> f64 {
        let line = said.lines().find(|line| line.starts_with(row)).unwrap();
        line.split('|').nth(4).unwrap().split('%').next().unwrap().trim().parse().unwrap()
    };
    assert!(right("| S: ") > 80.0 && right("| T: ") > 80.0, "{said}");
    assert!(right("| V: ") < 26.0, "{said}");
    // Where vehicles held out are told by chance alone, no answer is sure; half of the scenes tell as much as
    // all of them.
    assert!(said.contains("| T: b never seen | 0 / 0 / 100 |"), "{said}");
    assert!(
        said.contains("Learning curve over scenes") && said.contains("| 1 | 68 | 4 | 100.0 % |"),
        "{said}"
    );
    // The one vehicle whose scene is told of beside its shard.
    assert!(
        said.contains("| range, m | 30 to 40 | 1 | 0.0 % |")
            || said.contains("| range, m | 30 to 40 | 1 | 100.0 % |"),
        "{said}"
    );
    assert!(said.contains("| aspect, ° | to 20 | 1 |"), "{said}");
    assert!(said.contains("Learning curve over vehicles"), "{said}");
    assert!(said.contains("| car | 0.50 | 0.50 | 0.50 | – |"), "{said}");
    place.run(&format!("{words} --out q.md"));
    assert_eq!(place.bytes("p.md"), place.bytes("q.md"));
}

#[test]
fn a_folder_s_name_neither_ends_a_cell_of_the_page_nor_moves_a_cursor() {
    let place = Workplace::new();
    crops::write(&place.path("a"), 5);
    crops::write_some(&place.path("b|\u{1b}[31m"), 5..11);
    let said = place.run("protocols a --test b|\u{1b}[31m --seeds 1 --quiet");
    assert!(said.contains("| T: b\\|\\u{1b}[31m never seen | all |"), "{said:?}");
    assert!(!said.contains('\u{1b}'), "{said:?}");
}

#[test]
fn a_folder_without_shards_is_refused_by_its_name() {
    let place = Workplace::new();
    crops::write(&place.path("a"), 5);
    for words in ["protocols nothing", "protocols a --test nothing --seeds 1"] {
        let output = place.try_run(words);
        assert_eq!(output.status.code(), Some(2), "{words}");
        assert!(
            String::from_utf8_lossy(&output.stderr).contains("nothing: no shards of a dataset here"),
            "{words}"
        );
    }
}

#[test]
fn what_is_asked_of_models_of_signatures_is_refused_of_the_papers_network() {
    let place = Workplace::new();
    crops::write(&place.path("a"), 5);
    let output = place.try_run("protocols a --learner paper --curves");
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("--test and --curves are for --learner trees, profile and both"), "{said}");
}
