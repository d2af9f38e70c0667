//! Plans of scenes: what is modelled is chosen by the accuracy alone.

#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

mod common;

use common::{SMALL_SCENE, Workplace};

/// The small scene with a table of [fidelity], in a file of its own.
fn with_fidelity(place: &Workplace, name: &str, table: &str) {
    std::fs::write(place.path(name), format!("{SMALL_SCENE}\n[fidelity]\n{table}\n")).unwrap();
}

#[test]
fn a_plan_tells_each_part_with_its_share_and_what_it_leaves_out_keeps_the_budget() {
    let place = Workplace::new();
    let told = place.run("run small.toml --accuracy-db -20 --dry-run --no-cache");
    for part in ["reflections of order 2", "ways between bodies", "ways by the road", "diffraction by edges"]
    {
        assert!(told.contains(part), "{part}: {told}");
    }
    place.run("run small.toml --accuracy-db -20 --no-cache --out out");
    let plan = place.summary("out/summary.json")["plan"].clone();
    let of = |key: &str| plan[key].as_f64().unwrap();
    let power = |db: f64| 10.0_f64.powf(db / 10.0);
    assert_eq!(of("asked_db"), -20.0);
    assert!(of("spent_db") >= -20.0);
    let [left_out, numerical] = ["left_out_db", "numerical_db"].map(|key| power(of(key) - of("spent_db")));
    assert!((0.0..=0.7).contains(&left_out) && numerical <= 1.0 + 1e-9, "{plan}");
    // What is expected adds up, and the excesses of the bounds by their squares.
    let expected = [left_out / 1.96, numerical / 4.0];
    let excess = (left_out - expected[0]).hypot(numerical - expected[1]);
    assert!((expected[0] + expected[1] + excess - 1.0).abs() < 1e-9, "{plan}");
    assert!(of("bounces") >= 2.0, "a corner reflector needs its second and third order: {plan}");
}

#[test]
fn a_planned_run_says_what_was_asked_and_the_part_of_it_that_is_planned() {
    let place = Workplace::new();
    with_fidelity(&place, "planned.toml", "for = \"class\"\nplan = \"accuracy\"");
    let told = place.run("run planned.toml --no-cache --out out");
    let summary = place.summary("out/summary.json");
    let (accuracy, plan) = (&summary["frames"][0]["accuracy"], &summary["plan"]);
    let asked_db = artifact::goal::Goal::Class.accuracy().db();
    assert!((accuracy["asked_db"].as_f64().unwrap() - asked_db).abs() < 1e-9, "{accuracy}");
    let [planned_db, numerical_db] =
        [&accuracy["planned_db"], &plan["numerical_db"]].map(|db| db.as_f64().unwrap());
    assert!((planned_db - numerical_db).abs() < 1e-9, "{accuracy}, {plan}");
    let kept = accuracy["reached_db"].as_f64().unwrap() <= planned_db;
    assert_eq!(accuracy["met"] == true, kept && plan["limited_by"] == "asked", "{accuracy}, {plan}");
    assert!(told.contains(" dB planned for −20.0 dB asked for \"class\": "), "{told}");
    let report = std::fs::read_to_string(place.path("out/report.html")).unwrap();
    assert!(report.contains("Plan of the physics") && report.contains("ways by the road"));
}

#[test]
fn seconds_of_parts_are_told_where_somebody_reads_along_and_no_look_is_spent_on_them_else() {
    let place = Workplace::new();
    let told = place.run("run small.toml --accuracy-db -20 --dry-run --no-cache");
    let part = |told: &str, name: &str| told.lines().find(|line| line.contains(name)).unwrap().to_owned();
    let edges = part(&told, "diffraction by edges");
    assert!(edges.contains("takes") || edges.contains("would take"), "{told}");
    place.run("run small.toml --accuracy-db -20 --no-cache --out out");
    let plan = place.summary("out/summary.json")["plan"].clone();
    assert!(
        plan["processor_s"].as_f64().unwrap() > 0.0 && plan["as_said_processor_s"].as_f64().unwrap() > 0.0
    );
    assert!(plan["parts"].as_array().unwrap().iter().all(|part| part["processor_s"].is_null()), "{plan}");
}

/// The number before ` s` that follows a mark.
fn seconds_behind(told: &str, mark: &str) -> f64 {
    let behind = told.split_once(mark).unwrap().1;
    behind.split_once(" s").unwrap().0.trim().parse().unwrap()
}

#[test]
fn seconds_of_a_plan_are_those_of_this_machine_as_the_dry_run_tells_them() {
    let place = Workplace::new();
    let told = place.run("run small.toml --accuracy-db -30 --dry-run --no-cache");
    let (of_plan, of_run) = (seconds_behind(&told, "; about "), seconds_behind(&told, "frames: "));
    // Both are rounded, to a tenth and to two digits.
    assert!((of_plan - of_run).abs() <= 0.06 + 0.06 * of_run, "{of_plan} and {of_run}: {told}");
}

#[test]
fn a_planned_run_is_the_run_of_a_scene_that_says_the_same_to_the_byte() {
    let place = Workplace::new();
    with_fidelity(&place, "planned.toml", "accuracy_db = -25\nplan = \"accuracy\"");
    place.run("run planned.toml --no-cache --out planned");
    let plan = place.summary("planned/summary.json")["plan"].clone();
    let is_modelled = |name: &str| {
        let parts = plan["parts"].as_array().unwrap();
        parts.iter().find(|part| part["name"] == name).unwrap()["modelled"] == true
    };
    let between = if is_modelled("ways between bodies") { "traced" } else { "left-out" };
    let edges = if is_modelled("diffraction by edges") { "on" } else { "off" };
    let road = if is_modelled("ways by the road") { "\n[road]\n" } else { "" };
    let said = format!(
        "accuracy_db = {}\nbounces = {}\nnodes = {}\nmeasured_every = {}\nbetween_bodies = \"{between}\"\n\
         edges = \"{edges}\"{road}",
        plan["numerical_db"], plan["bounces"], plan["nodes"], plan["measured_every"],
    );
    with_fidelity(&place, "said.toml", &said);
    place.run("run said.toml --no-cache --out said");
    for (file, format) in [("frames.cube", "npy"), ("frames.points", "csv"), ("frames.paths", "csv")] {
        let exported = ["planned", "said"].map(|folder| {
            let out = format!("{folder}.{file}.{format}");
            place.run(&format!("export {folder}/{file} --to {format} --out {out}"));
            place.bytes(&out)
        });
        assert_eq!(exported[0], exported[1], "{file}: {said}");
    }
    assert!(place.summary("said/summary.json").get("plan").is_none(), "nothing was planned there");
}

#[test]
fn what_the_scene_says_itself_stays() {
    let place = Workplace::new();
    with_fidelity(&place, "own.toml", "bounces = 1\nedges = \"on\"\nplan = \"accuracy\"");
    place.run("run own.toml --no-cache --out own");
    let plan = place.summary("own/summary.json")["plan"].clone();
    assert_eq!(plan["bounces"], 1);
    let edges =
        plan["parts"].as_array().unwrap().iter().find(|p| p["name"] == "diffraction by edges").unwrap();
    assert_eq!((&edges["modelled"], &edges["said"]), (&true.into(), &true.into()));
}

#[test]
fn tables_have_nothing_to_choose_and_words_are_checked() {
    let place = Workplace::new();
    with_fidelity(&place, "table.toml", "echo = \"rcs-table\"\nplan = \"accuracy\"");
    let refused = place.try_run("run table.toml --no-cache --out out");
    assert_eq!(refused.status.code(), Some(1));
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.contains("table.toml") && said.contains("a plan needs echo = \"paths\""), "{said}");
    with_fidelity(&place, "word.toml", "plan = \"cheap\"");
    let refused = place.try_run("run word.toml --no-cache --out out");
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.contains("word.toml") && said.contains("plan") && said.contains("accuracy"), "{said}");
}
