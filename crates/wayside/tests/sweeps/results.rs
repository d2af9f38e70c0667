//! Results of studies: designs and situations, and the same bytes however they were come by.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::killing::{files, killed_after};
use crate::common::{SMALL_SCENE, Workplace, asked, tell_cases};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

/// A scene of which a run takes some milliseconds: two points, the fainter one at the edge of what is heard.
const SCENE: &str = "name = \"points\"\n[radar]\nposition_m = [0.0, 0.0, 6.0]\n[radar.waveform]\nsamples = 64\nchirps = 16\n[radar.array]\npreset = \"1x4\"\n\
    [noise]\nnoise_figure_db = 12.0\n[dsp]\ntraining_cells = [3, 6]\n\
    [[target]]\nkind = \"point\"\nid = \"strong\"\nrcs_m2 = 10.0\nposition_m = [2.0, 30.0, 1.0]\nvelocity_mps = [0.0, -3.0, 0.0]\n\
    [[target]]\nkind = \"point\"\nid = \"faint\"\nrcs_m2 = 0.02\nposition_m = [5.0, 42.0, 1.0]\nvelocity_mps = [0.0, 3.0, 0.0]\n";

const STUDY: &str = "scene = \"scene.toml\"\nrepeats = 6\n[[vary]]\nname = \"array\"\nkey = \"radar.array.preset\"\n\
    values = [\"1x4\", \"6x8\"]\n[[vary]]\nname = \"height\"\nkey = \"radar.position_m.2\"\nvalues = [4.0, 6.0]\n\
    [[condition]]\nkey = \"noise.noise_figure_db\"\nvalues = [12.0, 40.0]\n\
    [[condition]]\nkey = \"target.1.position_m.1\"\ndraw = { uniform = [38.0, 44.0] }\n\
    [goal]\nmetric = \"coverage\"\n";

const TABLES: [&str; 4] = ["sweep.csv", "designs.csv", "pareto.svg", "pareto.png"];

fn prepared(study: &str) -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("scene.toml"), SCENE).unwrap();
    std::fs::write(place.path("study.toml"), study).unwrap();
    place
}

fn sweep(place: &Workplace, words: &str) -> String {
    place.run(&format!("sweep study.toml --no-cache --quiet {words}"))
}

/// Cells of a table without quoted commas, its head first.
fn table(place: &Workplace, name: &str) -> Vec<Vec<String>> {
    let text = String::from_utf8(place.bytes(name)).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn column(table: &[Vec<String>], name: &str) -> Vec<String> {
    let place = table[0].iter().position(|head| head == name).unwrap_or_else(|| panic!("no {name}"));
    table[1..].iter().map(|row| row[place].clone()).collect()
}

fn same_results(place: &Workplace, a: &str, b: &str) {
    for name in TABLES {
        assert!(
            place.bytes(&format!("{a}/{name}")) == place.bytes(&format!("{b}/{name}")),
            "{name}: {a}, {b}"
        );
    }
}

#[test]
fn every_combination_is_run_in_the_same_situations_with_the_same_seeds() {
    let place = prepared(STUDY);
    sweep(&place, "--out a");
    let runs = table(&place, "a/sweep.csv");
    assert_eq!(runs.len() - 1, 4 * 2 * 6);
    let pairs = |a: &str, b: &str| column(&runs, a).into_iter().zip(column(&runs, b)).collect::<Vec<_>>();
    let designs: BTreeSet<_> = pairs("radar.array.preset", "radar.position_m.2").into_iter().collect();
    assert_eq!(designs.len(), 4);
    let of_design = |design: &str, name: &str| {
        let all = pairs("design", name).into_iter().filter(|(number, _)| number == design);
        all.map(|(_, value)| value).collect::<Vec<_>>()
    };
    for name in ["seed", "noise.noise_figure_db", "target.1.position_m.1"] {
        for design in ["1", "2", "3"] {
            assert_eq!(of_design("0", name), of_design(design, name), "{name}");
        }
    }
    let distinct = |name: &str| of_design("0", name).into_iter().collect::<BTreeSet<_>>().len();
    assert_eq!((distinct("seed"), distinct("target.1.position_m.1")), (12, 12), "drawn anew each time");
    let designs = table(&place, "a/designs.csv");
    assert_eq!(column(&designs, "channels"), ["4", "4", "48", "48"]);
    assert!(column(&designs, "situations").iter().all(|seen| seen == "12"));
}

#[test]
fn a_drawn_sample_begins_with_the_smaller_one_and_another_seed_draws_others() {
    let drawn = |count: u32| {
        STUDY.replace("values = [4.0, 6.0]", "draw = { uniform = [4.0, 6.0] }")
            + &format!("[sample]\ncount = {count}\n")
    };
    let place = prepared(&drawn(3).replace("repeats = 6", "repeats = 1"));
    sweep(&place, "--out three");
    sweep(&place, "--out other --seed 2");
    std::fs::write(place.path("study.toml"), drawn(5).replace("repeats = 6", "repeats = 1")).unwrap();
    sweep(&place, "--out five");
    let heights = |out: &str| column(&table(&place, &format!("{out}/designs.csv")), "radar.position_m.2");
    let (three, five) = (heights("three"), heights("five"));
    assert_eq!((three.len(), five.len()), (3, 5));
    assert_eq!(three[..], five[..3]);
    assert!(three.iter().all(|height| (4.0..=6.0).contains(&height.parse::<f64>().unwrap())));
    assert_ne!(three, heights("other"));
}

#[test]
fn parts_and_threads_make_the_bytes_of_the_whole() {
    let place = prepared(STUDY);
    sweep(&place, "--out whole --threads 1");
    sweep(&place, "--out threads --threads 3");
    same_results(&place, "whole", "threads");
    for (part, is_last) in [("2/3", false), ("3/3", false), ("1/3", true)] {
        let said = sweep(&place, &format!("--out parts --shard {part}"));
        assert_eq!(said.contains("Answer"), is_last, "{said}");
        assert_eq!(said.contains("not made yet"), !is_last, "{said}");
    }
    same_results(&place, "whole", "parts");
}

#[test]
fn concluding_alone_says_how_many_runs_lack_makes_none_and_gives_the_same_report() {
    let place = prepared(STUDY);
    sweep(&place, "--out a --threads 1");
    let report = ["report.md", "report.html"].map(|name| place.bytes(&format!("a/{name}")));
    for name in ["report.md", "report.html", "sweep.csv"] {
        std::fs::remove_file(place.path(&format!("a/{name}"))).unwrap();
    }
    assert!(sweep(&place, "--out a --conclude").contains("Answer"));
    assert!(report == ["report.md", "report.html"].map(|name| place.bytes(&format!("a/{name}"))));
    sweep(&place, "--out parts --shard 2/2");
    let before = files(&place.path("parts"));
    let refused = place.try_run("sweep study.toml --no-cache --quiet --out parts --conclude");
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!((refused.status.code(), files(&place.path("parts"))), (Some(2), before));
    assert!(said.contains("parts: 24 runs are not made yet"), "{said}");
}

#[test]
fn runs_that_earlier_versions_kept_are_taken_up() {
    let place = prepared(STUDY);
    sweep(&place, "--out a");
    for file in files(&place.path("a/runs")) {
        let name = file.file_name().unwrap().to_str().unwrap();
        let earlier = place.path("a/runs").join(&name[..2]);
        std::fs::create_dir_all(&earlier).unwrap();
        std::fs::rename(&file, earlier.join(name)).unwrap();
    }
    let before = files(&place.path("a"));
    assert!(sweep(&place, "--out a --conclude").contains("Answer"));
    assert_eq!(files(&place.path("a")), before);
}

#[test]
fn parts_of_a_study_at_once_make_the_bytes_of_the_whole() {
    let place = prepared(STUDY);
    sweep(&place, "--out whole");
    let words = "sweep study.toml --no-cache --quiet --out parts --threads 1 --shard";
    let parts = ["1/3", "2/3", "3/3", "2/3"].map(|p| place.command(&format!("{words} {p}")).spawn().unwrap());
    let ended = parts.map(|mut part| part.wait().unwrap());
    assert!(ended.iter().all(std::process::ExitStatus::success));
    same_results(&place, "whole", "parts");
}

#[test]
fn a_study_goes_on_after_any_run_and_makes_a_damaged_one_anew() {
    let place = prepared(STUDY);
    sweep(&place, "--out whole");
    let kept = files(&place.path("whole/runs"));
    assert_eq!(kept.len(), 48);
    for left in [0, 1, 17, 47] {
        let out = place.path("part");
        let _ = std::fs::remove_dir_all(&out);
        for file in &kept[..left] {
            let copy = out.join(file.strip_prefix(place.path("whole")).unwrap());
            std::fs::create_dir_all(copy.parent().unwrap()).unwrap();
            std::fs::copy(file, &copy).unwrap();
            if left == 17 {
                std::fs::write(&copy, "{\"key\": \"").unwrap();
            }
        }
        sweep(&place, "--out part");
        same_results(&place, "whole", "part");
        assert_eq!(files(&place.path("part/runs")).len(), 48);
    }
}

#[test]
fn a_study_that_is_killed_goes_on_to_the_same_bytes() {
    let place = prepared(STUDY);
    let start = Instant::now();
    sweep(&place, "--out whole");
    let whole = start.elapsed();
    let words = "sweep study.toml --no-cache --quiet --out killed";
    let mut random = ChaCha8Rng::seed_from_u64(asked("WAYSIDE_SEED", 7));
    let (mut kills, asked_for) = (0, asked("WAYSIDE_KILLS", 3));
    while kills < asked_for {
        let share: f64 = random.random();
        match killed_after(&place, words, Duration::from_secs_f64(share * whole.as_secs_f64())) {
            true => kills += 1,
            false => std::fs::remove_dir_all(place.path("killed")).unwrap(),
        }
    }
    sweep(&place, "--out killed");
    same_results(&place, "whole", "killed");
    tell_cases(&format!("kills of sweep within {whole:.1?}"), kills, "the same results in the end");
}

#[test]
fn the_answer_is_the_cheapest_design_that_finds_all() {
    let place = prepared(&STUDY.replace("values = [12.0, 40.0]", "values = [12.0]"));
    let said = sweep(&place, "--out a");
    assert!(said.starts_with("Answer: design "), "{said}");
    let designs = table(&place, "a/designs.csv");
    let rows = column(&designs, "coverage").into_iter().zip(column(&designs, "candidate"));
    let best = column(&designs, "coverage").iter().map(|c| c.parse::<f64>().unwrap()).fold(0.0, f64::max);
    assert!(rows.clone().any(|(coverage, candidate)| candidate == "yes" && coverage == best.to_string()));
    let report = String::from_utf8(place.bytes("a/report.md")).unwrap();
    assert!(report.contains(said.lines().next().unwrap()), "{report}");
}

#[test]
fn what_is_worse_for_sure_is_repeated_no_further_and_parts_agree_on_it() {
    let stop = "[stop]\nleast = 4\n";
    let deaf = STUDY
        .replace("values = [12.0, 40.0]", "values = [12.0]")
        .replace("values = [4.0, 6.0]", "values = [4.0, 60.0]");
    // A difference that is the same in every situation is one for sure after some tens of them.
    let place = prepared(&(deaf.replace("repeats = 6", "repeats = 40") + stop));
    sweep(&place, "--out whole");
    let designs = table(&place, "whole/designs.csv");
    let seen: Vec<usize> = column(&designs, "situations").iter().map(|n| n.parse().unwrap()).collect();
    assert!(seen.contains(&40) && seen.iter().any(|n| *n < 40), "{seen:?}");
    let mut said = String::new();
    for _ in 0..40 {
        sweep(&place, "--out parts --shard 1/2");
        said = sweep(&place, "--out parts --shard 2/2");
        if said.contains("Answer") {
            break;
        }
    }
    assert!(said.contains("Answer"), "{said}");
    same_results(&place, "whole", "parts");
}

/// The first eight situations of a study are easier than the rest: design 1, left after them, has the better
/// mean of its own and is behind in each pair.
#[test]
fn a_design_that_was_left_is_on_the_front_by_pairs_and_not_by_a_mean_of_easier_situations() {
    let study = "scene = \"scene.toml\"\nseed = 1\nrepeats = 12\n[[vary]]\nkey = \"noise.noise_figure_db\"\n\
                 values = [12.0, 15.0, 25.0]\n[[condition]]\nkey = \"target.0.rcs_m2\"\ndraw = { uniform = [0.01, 3.0] }\n\
                 [goal]\nmetric = \"range_error_m\"\n[stop]\nleast = 3\nconfidence = 0.8\n";
    let place = prepared(study);
    let faint = SCENE.rfind("[[target]]").unwrap();
    let scene = SCENE[..faint].replace("[dsp]\ntraining_cells = [3, 6]\n", "");
    std::fs::write(place.path("scene.toml"), scene).unwrap();
    let said = sweep(&place, "--out a");
    assert!(said.starts_with("Answer: design 0"), "{said}");
    let designs = table(&place, "a/designs.csv");
    let [seen, errors] = ["situations", "range_error_m"].map(|name| column(&designs, name));
    assert!(seen[1].parse::<u32>().unwrap() < 12, "{seen:?}");
    assert!(errors[1].parse::<f64>().unwrap() < errors[0].parse().unwrap(), "{errors:?}");
    assert_eq!(column(&designs, "front")[..2], ["yes", "no"]);
}

#[test]
fn designs_that_cost_nothing_are_drawn() {
    let study = STUDY.replace("[goal]", "[goal]\ncost = \"ghosts\"").replace("repeats = 6", "repeats = 1");
    let place = prepared(&study);
    sweep(&place, "--out a");
    let picture = String::from_utf8(place.bytes("a/pareto.svg")).unwrap();
    // Four designs, and those of the legend.
    assert!(picture.matches("<circle").count() >= 6, "{picture}");
}

#[test]
fn a_text_is_the_same_in_whichever_quotes() {
    let one = STUDY.replace("repeats = 6", "repeats = 1");
    let place = prepared(&one);
    sweep(&place, "--out a");
    std::fs::write(place.path("study.toml"), one.replace("[\"1x4\", ", "['1x4', ")).unwrap();
    sweep(&place, "--out b");
    same_results(&place, "a", "b");
}

/// A scene of which drawn points stand for a corner reflector, at an error larger than the echo itself where
/// `detail` asks for it.
fn of_a_corner(detail: &str) -> Workplace {
    let place = Workplace::new();
    let scene = SMALL_SCENE.replace("frames = 2", "frames = 1");
    std::fs::write(place.path("scene.toml"), format!("{scene}\n[fidelity]\ndetail = \"{detail}\"\n"))
        .unwrap();
    let study = "scene = \"scene.toml\"\nrepeats = 2\n[[vary]]\nname = \"array\"\nkey = \"radar.array.preset\"\n\
                 values = [\"1x4\", \"3x4\"]\n[goal]\nmetric = \"coverage\"\n";
    std::fs::write(place.path("study.toml"), study).unwrap();
    place
}

#[test]
fn a_study_says_how_many_of_its_runs_did_not_reach_their_accuracy_and_which_candidates_rest_on_them() {
    let place = of_a_corner("statistical");
    let said = sweep(&place, "--out a");
    let sentence = "4 of 4 runs did NOT REACH the accuracy that they asked for, the worst, of design ";
    assert!(said.contains(sentence) && said.contains(" dB for −20.0 dB asked"), "{said}");
    let runs = table(&place, "a/sweep.csv");
    let reached: Vec<f64> =
        column(&runs, "accuracy_reached_db").iter().map(|level| level.parse().unwrap()).collect();
    let worst = reached.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!(reached.iter().all(|level| *level > -20.0), "{reached:?}");
    assert!(said.contains(&format!("{worst:.1} dB for").replace('-', "−")), "{worst}: {said}");
    let asked = column(&runs, "accuracy_asked_db");
    assert!(asked.iter().all(|asked| (asked.parse::<f64>().unwrap() + 20.0).abs() < 1e-9), "{asked:?}");
    assert_eq!(column(&runs, "accuracy_met"), ["no"; 4]);
    let designs = table(&place, "a/designs.csv");
    assert_eq!(column(&designs, "accuracy_missed"), ["2", "2"]);
    let candidates = column(&designs, "candidate");
    let resting: Vec<String> =
        (0..2).filter(|design| candidates[*design] == "yes").map(|design| design.to_string()).collect();
    assert!(said.contains(&format!("candidates rest on them: {}.", resting.join(", "))), "{said}");
    let unwrapped = |name: &str| {
        let text = String::from_utf8(place.bytes(name)).unwrap();
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    for name in ["a/report.md", "a/report.html"] {
        let report = unwrapped(name);
        assert!(report.contains(sentence) && report.contains("accuracy not reached"), "{name}: {report}");
    }
}

#[test]
fn a_study_whose_runs_all_reached_their_accuracy_says_that_too() {
    let place = of_a_corner("paths");
    let study = String::from_utf8(place.bytes("study.toml")).unwrap();
    // Chirps make another kind, which is measured for itself.
    let chirps = study.replace("radar.array.preset", "radar.waveform.chirps");
    std::fs::write(place.path("study.toml"), chirps.replace("[\"1x4\", \"3x4\"]", "[16, 18]")).unwrap();
    let said = sweep(&place, "--out a");
    assert!(said.contains("All 4 runs reached the accuracy that they asked for."), "{said}");
    let runs = table(&place, "a/sweep.csv");
    assert_eq!(column(&runs, "accuracy_met"), ["yes"; 4]);
    assert_eq!(column(&runs, "accuracy_taken_over"), ["no"; 4]);
    assert_eq!(column(&table(&place, "a/designs.csv"), "accuracy_missed"), ["0", "0"]);
}

#[test]
fn runs_that_take_over_their_errors_are_told_as_such_and_not_counted_as_reached() {
    let place = of_a_corner("paths");
    let said = sweep(&place, "--out a");
    assert!(said.contains("The 2 of 4 runs whose errors were measured all reached"), "{said}");
    assert!(said.contains("2 of 4 runs take over the errors of other designs' runs"), "{said}");
    let runs = table(&place, "a/sweep.csv");
    assert_eq!(column(&runs, "accuracy_met"), ["yes", "yes", "", ""]);
    assert_eq!(column(&runs, "accuracy_taken_over"), ["no", "no", "yes", "yes"]);
    assert_eq!(column(&table(&place, "a/designs.csv"), "accuracy_taken_over"), ["0", "2"]);
}

#[test]
fn of_runs_that_earlier_versions_kept_it_is_said_that_their_accuracy_is_not_known() {
    let place = of_a_corner("statistical");
    sweep(&place, "--out a");
    for file in &files(&place.path("a/runs"))[..3] {
        let mut run: serde_json::Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
        assert!(run.as_object_mut().unwrap().remove("accuracy").is_some(), "{run}");
        std::fs::write(file, run.to_string()).unwrap();
    }
    let said = sweep(&place, "--out a --conclude");
    assert!(
        said.contains("1 of 4 runs did NOT REACH") && said.contains("not known of 3 of 4 runs"),
        "{said}"
    );
    let runs = table(&place, "a/sweep.csv");
    for name in ["accuracy_asked_db", "accuracy_reached_db", "accuracy_met"] {
        assert_eq!(column(&runs, name).iter().filter(|cell| cell.is_empty()).count(), 3, "{name}");
    }
}

#[test]
fn a_scene_that_is_changed_while_its_study_runs_ends_it_and_no_run_of_the_other_scene_is_kept() {
    let place = prepared(&STUDY.replace("repeats = 6", "repeats = 12"));
    sweep(&place, "--out whole");
    let mut study = place.command("sweep study.toml --no-cache --quiet --threads 2 --out a").spawn().unwrap();
    let begun = Instant::now();
    while files(&place.path("a/runs")).is_empty() && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    // Half written, as an editor that truncates leaves it for a moment, then whole.
    std::fs::write(place.path("scene.toml"), "").unwrap();
    std::thread::sleep(Duration::from_millis(50));
    std::fs::write(place.path("scene.toml"), SCENE.replace("rcs_m2 = 0.02", "rcs_m2 = 2000.0")).unwrap();
    assert_eq!(study.wait().unwrap().code(), Some(2));
    let refused = place.try_run("sweep study.toml --no-cache --quiet --out a --conclude");
    assert_eq!(refused.status.code(), Some(2), "no run of the scene as it is now is there");
    std::fs::write(place.path("scene.toml"), SCENE).unwrap();
    sweep(&place, "--out a");
    same_results(&place, "whole", "a");
}
