//! Results of earlier commands: none is left beside new ones of a command that was ended, and those that a
//! command does not replace stay and are told.

#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{SMALL_SCENE, Workplace};

/// Files of more than so many blocks end the program: pictures of a run, models of vehicles.
#[cfg(unix)]
#[test]
fn a_command_that_is_killed_leaves_none_of_its_results_beside_those_of_an_earlier_one() {
    let place = Workplace::new();
    place.run("run small.toml --out a --no-cache --quiet");
    std::fs::copy(place.path("a/frames.cube"), place.path("frames.cube")).unwrap();
    place.run("dsp frames.cube --quiet --out d");
    place.run("dsp frames.cube --pictures --quiet --out p");
    place.run("vehicles car-suv bus-city --quiet --out v");
    let largest = |folder: &str| {
        let sizes = std::fs::read_dir(place.path(folder)).unwrap().map(|e| e.unwrap().metadata().unwrap());
        sizes.filter(std::fs::Metadata::is_file).map(|about| about.len()).max().unwrap()
    };
    for (words, largest, gone, left) in [
        (
            "run small.toml --seed 9 --out a --no-cache --quiet",
            place.bytes("a/frames.cube").len() as u64,
            &["summary.json", "report.html", "frames.cube", "frames.points", "pictures/scene-0001.png"][..],
            "a",
        ),
        ("vehicles car-suv bus-city --seed 9 --quiet --out v", largest("v"), &["manifest.json"], "v"),
        ("dsp frames.cube --quiet --out d", largest("d"), &["frames.rdm", "frames.points"], "d"),
        // It ends within the first picture.
        (
            "dsp frames.cube --pictures --quiet --out p",
            place.bytes("p/pictures/rdm-0000.png").len() as u64 / 2,
            &["frames.rdm", "frames.points", "pictures/points-0000.png", "pictures/rdm-0001.png"],
            "p",
        ),
    ] {
        let kib = largest / 1024 - 1;
        let script = format!("ulimit -c 0; ulimit -f {kib}; exec {} {words}", crate::common::PROGRAM);
        let mut bash = std::process::Command::new("bash");
        let killed = bash.args(["-c", &script]).current_dir(place.root()).output().unwrap();
        assert!(!killed.status.success(), "{words}");
        gone.iter().for_each(|name| assert!(!place.path(left).join(name).exists(), "{words}: {name}"));
    }
}

#[test]
fn results_that_an_earlier_run_left_stay_and_are_told() {
    let place = Workplace::new();
    let said = |words: &str| String::from_utf8(place.try_run(words).stderr).unwrap();
    let run = "run small.toml --out a --no-cache";
    assert!(!said(run).contains("earlier run"));
    let scene = SMALL_SCENE.replace("frames = 2", "frames = 1") + "[fidelity]\necho = \"rcs-table\"\n";
    std::fs::write(place.path("small.toml"), scene).unwrap();
    let told = said(run);
    assert!(told.contains("a: frames.paths to pictures/scene-0001.png (5 in all) were left"), "{told}");
    let page = String::from_utf8(place.bytes("a/report.html")).unwrap();
    assert!(page.contains("href=\"frames.rcs\"") && !page.contains("href=\"frames.paths\""));
    assert!(place.path("a/frames.paths").exists() && place.path("a/pictures/rdm-0001.png").exists());
    let table = "rcs corner.obj --az-deg 0:90:3 --out t/s.npy";
    said(&format!("{table} --pictures --freq-ghz 76:77:3"));
    let told = said(&format!("{table} --pictures --freq-ghz 77"));
    let [frequency, profile, isar] = ["frequency", "profile", "isar"].map(|name| format!("t/s-{name}.png"));
    assert!(told.contains(&format!("{frequency}, {profile}, {isar}: left by an earlier run")), "{told}");
    assert!(said(&format!("{table} --freq-ghz 77")).contains("t/s-polar.png"));
}

#[test]
fn pictures_that_earlier_processing_left_stay_and_are_told() {
    let place = Workplace::new();
    let said = |words: &str| {
        let output = place.try_run(words);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{words}: {said}");
        said
    };
    said("echo small.toml --out two.cube");
    std::fs::write(place.path("small.toml"), SMALL_SCENE.replace("frames = 2", "frames = 1")).unwrap();
    said("echo small.toml --out one.cube");
    for command in ["dsp two.cube --out d --pictures", "dsp two.cube --out d --pictures"] {
        assert!(!said(command).contains("were left"), "all are its own");
    }
    let fewer = said("dsp one.cube --out d --pictures");
    let frame = "d: pictures/points-0001.png to pictures/rdm-0001.png (3 in all) were left by an earlier run";
    assert!(fewer.contains(frame), "{fewer}");
    for command in ["dsp two.cube --out d", "dsp one.cube --out d"] {
        let none = said(command);
        assert!(none.contains("d: pictures/points-0000.png to pictures/rdm-0001.png (6 in all)"), "{none}");
    }
    assert_eq!(std::fs::read_dir(place.path("d/pictures")).unwrap().count(), 6, "they stay");
    // Beside what a run drew, its views from above are its own.
    said("run small.toml --out a --no-cache");
    let beside = said("dsp a/frames.cube --out a");
    assert!(beside.contains("a: pictures/points-0000.png to pictures/rdm-0000.png (3 in all)"), "{beside}");
}

#[test]
fn vehicles_that_an_earlier_manifest_lists_stay_and_are_told() {
    let place = Workplace::new();
    let said = |words: &str| String::from_utf8(place.try_run(words).stderr).unwrap();
    assert!(!said("vehicles car-suv bus-city --out v").contains("were left"));
    std::fs::write(place.path("v/mine.glb"), "of the user").unwrap();
    let told = said("vehicles car-suv --out v");
    assert!(told.contains("v: bus-city.glb (1 in all) were left by an earlier run"), "{told}");
    assert!(place.path("v/bus-city.glb").is_file());
    assert!(!said("vehicles car-suv --out v").contains("were left"), "the manifest lists what it wrote");
}
