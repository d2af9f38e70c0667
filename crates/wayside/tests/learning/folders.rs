//! Folders of datasets as inputs: whole or refused, each taken once, and none of their files replaced by a
//! page.

#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{Workplace, crops};
use std::process::Output;

/// The dataset `a` of four shards, each with a scene in `scenes.jsonl`, and the model `m`.
fn prepared() -> Workplace {
    let place = Workplace::new();
    crops::write(&place.path("a"), 5);
    let scene = |number| format!("{{\"file\":\"shard-000{number}.dataset\",\"scene\":{number}}}\n");
    std::fs::write(place.path("a/scenes.jsonl"), (0..4).map(scene).collect::<String>()).unwrap();
    std::fs::write(place.path("a/manifest.jsonl"), "{}\n").unwrap();
    std::fs::create_dir(place.path("m")).unwrap();
    let model = Workplace::project_file("fixtures/classifier.model");
    std::fs::copy(model, place.path("m/weights.model")).unwrap();
    std::fs::write(place.path("m/metrics.json"), "{}\n").unwrap();
    place
}

fn refused(output: &Output, word: &str, what: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{what}: {said}");
    assert!(said.contains(word), "{what}: `{word}` is not in: {said}");
}

#[test]
fn a_dataset_of_which_a_shard_lacks_is_refused_by_every_command_that_takes_one() {
    let place = prepared();
    std::fs::remove_file(place.path("a/shard-0002.dataset")).unwrap();
    for words in ["train a --out new", "classify m a", "evaluate m a", "protocols a --seeds 1"] {
        refused(&place.try_run(words), "a/shard-0002.dataset: is not there", words);
    }
    std::fs::remove_file(place.path("a/scenes.jsonl")).unwrap();
    let output = place.try_run("evaluate m a");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("a: has no scenes.jsonl") && said.contains("the 3 here are taken"), "{said}");
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn shards_that_a_recipe_of_more_scenes_has_left_are_told() {
    let place = prepared();
    let told =
        "{\"file\":\"shard-0000.dataset\",\"scene\":0}\n{\"file\":\"shard-0001.dataset\",\"scene\":1}\n";
    let said = || String::from_utf8(place.try_run("evaluate m a").stderr).unwrap();
    assert!(!said().contains("does not tell"), "{}", said());
    std::fs::write(place.path("a/scenes.jsonl"), told).unwrap();
    let said = said();
    assert!(said.contains("a/shard-0002.dataset: scenes.jsonl does not tell of it"), "{said}");
    assert!(said.contains("2 of the 4 shards"), "{said}");
}

#[test]
fn a_line_of_a_scene_that_is_damaged_is_named_by_its_place() {
    let place = prepared();
    std::fs::write(place.path("a/shard-0001.jsonl"), "{\"scene\":1,\"frames\":[]}\n{\"scene\":2,\n").unwrap();
    let output = place.try_run("protocols a --seeds 1");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("a/shard-0001.jsonl:2: is no line of a scene"), "{said}");
    std::fs::write(place.path("a/scenes.jsonl"), "{\"file\":\"shard-0000.dataset\"}\n[\n").unwrap();
    let output = place.try_run("evaluate m a");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("a/scenes.jsonl:2: is no line of a scene"), "{said}");
}

#[test]
fn samples_are_taken_once_however_their_folder_is_named_and_where_it_was_copied_to() {
    let place = prepared();
    std::fs::create_dir(place.path("copy")).unwrap();
    std::fs::copy(place.path("a/shard-0003.dataset"), place.path("copy/other.dataset")).unwrap();
    for (words, one) in [
        ("evaluate m a a", "a/shard-0003.dataset"),
        ("classify m a a", "a/shard-0003.dataset"),
        ("classify m a copy", "copy/other.dataset"),
        ("classify m copy/other.dataset a", "copy/other.dataset"),
        ("classify m a/shard-0003.dataset copy/other.dataset", "copy/other.dataset"),
        ("train a copy/../a --out new", "copy/../a/shard-0003.dataset"),
        ("protocols a --seeds 1 --test copy", "copy/other.dataset"),
    ] {
        refused(&place.try_run(words), &format!("{one}: has the samples of a/shard-0003.dataset"), words);
    }
    assert!(!place.path("new").exists());
    let some = place.run("classify m a/shard-0001.dataset a/shard-0003.dataset");
    assert_eq!(some.lines().count(), 2 * 5);
}

#[test]
fn shards_without_samples_are_taken_and_a_folder_without_any_has_nothing_to_tell() {
    let place = prepared();
    for empty in ["shard-0004.dataset", "shard-0005.dataset"] {
        crops::write(&place.path("none"), 0);
        std::fs::copy(place.path("none/shard-0000.dataset"), place.path(&format!("a/{empty}"))).unwrap();
    }
    assert_eq!(place.try_run("evaluate m a").status.code(), Some(0));
    let output = place.try_run("evaluate m none");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("none: no sample that tells its class"), "{said}");
}

#[test]
fn a_folder_that_has_grown_neither_counts_twice_nor_tests_what_trained() {
    let place = prepared();
    crops::write(&place.path("grown"), 6);
    for words in ["train a grown --out new", "evaluate m a grown", "protocols a --seeds 1 --test grown"] {
        let output = place.try_run(words);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{words}: {said}");
        assert!(said.contains("` is in another of the folders too; each is taken once"), "{words}: {said}");
    }
    crops::write_some(&place.path("others"), 5..9);
    assert_eq!(place.try_run("evaluate m a others").status.code(), Some(0));
}

#[test]
fn no_page_replaces_a_file_of_a_dataset_or_of_a_model() {
    let place = prepared();
    std::fs::write(place.path("a/shard-0000.jsonl"), "{\"scene\":0,\"frames\":[]}\n").unwrap();
    for (words, input) in [
        ("evaluate m a --out a/manifest.jsonl", "a/manifest.jsonl"),
        ("evaluate m/weights.model a --out a/manifest.jsonl", "a/manifest.jsonl"),
        ("protocols a --seeds 1 --out a/shard-0000.jsonl", "a/shard-0000.jsonl"),
        ("protocols a --seeds 1 --out a/scenes.jsonl", "a/scenes.jsonl"),
    ] {
        let before = place.bytes(input);
        refused(&place.try_run(words), "is an input of this command", words);
        assert_eq!(place.bytes(input), before, "{words}");
    }
    for (words, of_another) in [
        ("evaluate m a --out a/shard-0003.dataset", "a/shard-0003.dataset"),
        ("evaluate m a --out m/metrics.json", "m/metrics.json"),
        ("protocols a --seeds 1 --out recipe.toml", "recipe.toml"),
    ] {
        std::fs::write(place.path("recipe.toml"), "mine").unwrap();
        let before = place.bytes(of_another);
        refused(&place.try_run(words), "writes a page of text (.md, .txt)", words);
        assert_eq!(place.bytes(of_another), before, "{words}");
    }
}

/// What `classify` tells is what `evaluate` counts.
#[test]
fn answers_that_the_model_does_not_tell_are_counted_as_unknown() {
    let place = prepared();
    let told = place.run("classify m a");
    let unknown = told.lines().filter(|line| line.contains("\"unknown\"")).count();
    let answers = told.lines().count();
    let page = place.run("evaluate m a");
    let row = page.lines().find(|line| line.starts_with("| by frame ")).unwrap();
    let cell = row.split('|').rev().nth(1).unwrap();
    let share = cell.split('/').next_back().unwrap().trim().parse::<f64>().unwrap();
    assert!((share - 100.0 * unknown as f64 / answers as f64).abs() <= 0.5, "{unknown} of {answers}: {page}");
    let table = page.split("By frame, rows true, columns told").nth(1).unwrap();
    assert!(table.lines().nth(2).unwrap().ends_with("| unknown |"), "{page}");
    let rows = table.lines().skip(4).take(4);
    let counted: usize =
        rows.map(|row| row.split('|').rev().nth(1).unwrap().trim().parse::<usize>().unwrap()).sum();
    assert_eq!(counted, unknown, "{page}");
}
