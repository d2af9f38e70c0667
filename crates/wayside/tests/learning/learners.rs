//! `train`: what each learner of signatures writes, and that it classifies.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::{Workplace, crops};

/// Trains with these options; the curve begins with `rounds`, and `inspect` says `kind` of the model.
fn trains(options: &str, rounds: &str, kind: &str) {
    let place = Workplace::new();
    crops::write(&place.path("a"), 5);
    place.run(&format!("train a {options} --quiet --out m"));
    let curve = String::from_utf8(place.bytes("m/curves.csv")).unwrap();
    assert!(curve.starts_with(&format!("{rounds},log_loss_on_unseen_vehicles\n1,")), "{options}: {curve}");
    let said = place.run("inspect m/weights.model");
    assert!(said.contains(kind) && said.contains(", complete and finite"), "{options}: {said}");
    assert_eq!(place.run("classify m a").lines().count(), 20, "{options}");
}

#[test]
fn without_a_learner_trees_are_trained() {
    trains("", "trees", "trees        of ");
}

#[test]
fn networks_over_range_cells_are_trained_where_they_are_asked_for() {
    trains("--learner profile", "epochs", "networks     over ");
}

#[test]
fn both_are_trained_where_they_are_asked_for() {
    trains("--learner both", "trainings", "of the whole, and trees of ");
}
