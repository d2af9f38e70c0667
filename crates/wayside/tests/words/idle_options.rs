//! An option that would mean nothing beside what else is said is refused, exit code 2, by its name and rule.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::{SMALL_SCENE, Workplace};

/// Refuses each of these commands by these words, and leaves nothing.
fn refuses(place: &Workplace, out: &str, commands: &[(&str, &[&str])]) {
    for (command, words) in commands {
        let output = place.try_run(&format!("{command} --out {out}"));
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{command}: {said}");
        words.iter().for_each(|word| assert!(said.contains(word), "{command}: `{word}` is not in {said}"));
        assert!(!place.path(out).exists(), "{command}");
    }
}

#[test]
fn an_option_that_means_nothing_of_what_is_imported_is_refused() {
    let place = Workplace::new();
    let real = SMALL_SCENE.replace("[noise]", "[radar.receiver]\nsampling = \"real\"\n\n[noise]");
    std::fs::write(place.path("real.toml"), real).unwrap();
    std::fs::write(place.path("real.bin"), vec![0; 2 * 4 * 16 * 64]).unwrap();
    place.run("echo small.toml --out a.cube --quiet");
    for (format, name) in [("npy", "a.npy"), ("sigmf", "a"), ("dca1000", "a.bin"), ("uwcr", "raw")] {
        place.run(&format!("export a.cube --to {format} --out {name} --quiet"));
    }
    let small = "--scene small.toml";
    for (file, options) in [
        ("a.npy", &["--step 5", "--layout four-lanes", "--iq-order qi"][..]),
        ("raw/radar_raw_frame", &["--step 5", "--layout four-lanes", "--iq-order qi"]),
        ("raw/radar_raw_frame/000000.mat", &["--step 5", "--layout two-lanes"]),
        ("a.sigmf-meta", &["--step 5", "--layout four-lanes", "--iq-order iq"]),
        ("a.bin", &["--full-scale 2048"]),
    ] {
        for option in options {
            let (name, command) =
                (option.split(' ').next().unwrap(), format!("import {file} {small} {option}"));
            refuses(&place, "b.cube", &[(&command, &[name, file, " is for "])]);
        }
    }
    refuses(
        &place,
        "b.cube",
        &[("import real.bin --scene real.toml --iq-order qi", &["real.bin", "--iq-order", "complex"])],
    );
    for option in ["--step 5", "--full-scale 5", "--layout two-lanes", "--iq-order iq"] {
        let (name, command) = (option.split(' ').next().unwrap(), format!("import a.bin {small} {option}"));
        refuses(&place, "b.points", &[(&command, &[name, "a.bin", " is for "])]);
    }
}

#[test]
fn an_option_that_means_nothing_to_the_learner_is_refused() {
    let place = Workplace::new();
    std::fs::write(place.path("who.txt"), "nobody").unwrap();
    refuses(
        &place,
        "m",
        &[
            ("train d --iterations 3", &["--iterations is for --learner paper"]),
            ("train d --learner trees --iterations 3", &["--iterations is for --learner paper"]),
            (
                "train d --learner paper --attributions who.txt",
                &["who.txt", "--attributions is for --learner trees, profile and both"],
            ),
            ("protocols d --iterations 3", &["--iterations is for --learner paper"]),
            ("protocols d --learner trees --iterations 3", &["--iterations is for --learner paper"]),
            ("dataset spec.toml --dry-run --shard 1/2", &["--dry-run", "--shard"]),
        ],
    );
}

#[test]
fn an_option_that_means_nothing_to_the_method_is_refused_or_remarked_on() {
    let place = Workplace::new();
    let rcs = "rcs corner.obj --freq-ghz 3 --az-deg 0";
    refuses(
        &place,
        "s.npy",
        &[
            (&format!("{rcs} --density 4"), &["corner.obj", "--density is for --method po and sbr"]),
            (
                &format!("{rcs} --method po --bounces 2"),
                &["corner.obj", "--bounces is for --method bart and sbr"],
            ),
        ],
    );
    let output = place.try_run(&format!("{rcs} --method po --bounces 1 --accuracy-db -60 --out s.npy"));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("--accuracy-db is for --method bart"), "{said}");
}

#[test]
fn an_option_that_means_nothing_to_the_body_or_the_scene_is_refused() {
    let place = Workplace::new();
    let points = SMALL_SCENE.split("[[target]]\nkind = \"mesh\"").next().unwrap().to_owned()
        + "[[target]]\nkind = \"point\"\nid = \"a\"\nrcs_m2 = 1.0\nposition_m = [2.0, 30.0, 1.0]\n";
    std::fs::write(place.path("points.toml"), points).unwrap();
    place.run("paths small.toml --out a.paths --quiet");
    let rcs = "--freq-ghz 3 --az-deg 0";
    let own_edge = format!("rcs corner.obj {rcs} --nodes own-edge --method");
    let own_edge_rule: &[&str] = &["corner.obj", "--nodes own-edge is for --method bart"];
    refuses(
        &place,
        "x",
        &[
            (&format!("rcs car-suv {rcs} --unit-scale 2"), &["car-suv", "--unit-scale is for mesh files"]),
            (&format!("{own_edge} po"), own_edge_rule),
            (&format!("{own_edge} sbr"), own_edge_rule),
            ("run points.toml --model corner.obj", &["points.toml", "--model", "none of them is a mesh"]),
            ("paths points.toml --model corner.obj", &["points.toml", "--model", "none of them is a mesh"]),
        ],
    );
    for nodes in ["middle", "exit"] {
        place.run(&format!("rcs corner.obj {rcs} --method po --nodes {nodes} --out {nodes}.npy --quiet"));
    }
}

#[test]
fn a_folder_or_a_size_of_a_cache_that_is_not_used_is_refused() {
    let place = Workplace::new();
    for option in ["--cache c", "--cache-limit-mib 5"] {
        for command in ["run small.toml", "sweep study.toml"] {
            let command = format!("{command} --no-cache {option}");
            refuses(&place, "x", &[(&command, &["--no-cache", option.split(' ').next().unwrap()])]);
        }
    }
}

/// Names that meet nothing do nothing, so they are told.
#[test]
fn names_and_units_that_meet_nothing_are_remarked_on() {
    let place = Workplace::new();
    let plate = "v 0 0 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\nusemtl Glass\nf 1 2 3 4\n";
    std::fs::write(place.path("corner.obj"), plate).unwrap();
    let materials = "[materials]\nglass = { substance = \"glass\", thickness_mm = 5.0 }\n";
    std::fs::write(place.path("glass.toml"), materials).unwrap();
    let scene = SMALL_SCENE.replace("model = \"corner.obj\"", "model = \"corner.obj\"\nunit_scale = 39.37");
    let scene = format!("{scene}\n{materials}[fidelity]\nwheels = \"turning\"\nbounces = 1\n");
    std::fs::write(place.path("small.toml"), scene).unwrap();
    let said = |words: &str| String::from_utf8(place.try_run(words).stderr).unwrap();
    let unknown = "note: corner.obj: materials without an entry in [materials] conduct perfectly: `Glass` (the \
                   entry is `glass`)";
    let told = said("run small.toml --dry-run --no-cache");
    for expected in [
        unknown,
        "note: corner.obj: 0.00 m long, 39.37 m wide and 39.37 m high, a car is in another unit than metres",
        "note: corner.obj: no wheel turns",
    ] {
        assert!(told.contains(expected), "{expected} is not in {told}");
    }
    let table = "rcs corner.obj --freq-ghz 77 --az-deg 0 --out s.npy";
    assert!(said(&format!("{table} --materials glass.toml")).contains(unknown));
    assert!(!said(table).contains("conduct"), "without a table everything does");
}
