//! Nothing of the user's is destroyed by where a result is put: no input, no device, no file that belongs to
//! another one.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{BOARD, SMALL_SCENE, Workplace};
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::Path;
use std::process::Output;

/// Exit code 2 and a word of why.
fn refused(output: &Output, word: &str, what: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{what}: {said}");
    assert!(said.contains(word), "{what}: `{word}` is not in: {said}");
}

/// A cube, maps, paths and a model of the small scene.
fn filled() -> Workplace {
    let place = Workplace::new();
    place.run("run small.toml --out a --no-cache --quiet");
    for kind in ["cube", "rdm", "points", "tracks", "paths"] {
        std::fs::copy(place.path(&format!("a/frames.{kind}")), place.path(&format!("f.{kind}"))).unwrap();
    }
    place
}

const RCS: &str = "--freq-ghz 77 --az-deg 0 --quiet";

#[test]
fn no_command_replaces_what_it_reads() {
    let place = filled();
    place.run("export f.cube --to npy --out f.npy");
    place.run("rcs corner.obj --freq-ghz 77 --az-deg 0:90:5 --quiet --out s.npy");
    std::fs::write(place.path("board.cfg"), BOARD).unwrap();
    // A cube under the name of a description is an input under that name.
    std::fs::copy(place.path("f.cube"), place.path("f.sigmf-meta")).unwrap();
    std::fs::write(place.path("skin.npy"), "[materials]\nskin = { substance = \"metal\" }\n").unwrap();
    // Every input under a name that its command's result may have.
    for (kind, names) in [
        ("cube", &["c.npy", "c.bin", "c.csv"][..]),
        ("rdm", &["r.npy", "r.png", "r.exr"]),
        ("points", &["p.csv", "p.pcd", "p.ply"]),
        ("tracks", &["t.json"]),
        ("paths", &["w.csv", "w.cube"]),
        ("npy", &["n.cube"]),
    ] {
        names.iter().for_each(|name| {
            std::fs::copy(place.path(&format!("f.{kind}")), place.path(name)).unwrap();
        });
    }
    std::fs::copy(place.path("small.toml"), place.path("scene.cube")).unwrap();
    for (words, input) in [
        ("echo scene.cube --quiet --out scene.cube", "scene.cube"),
        ("echo small.toml --quiet --out corner.obj", "corner.obj"),
        ("echo small.toml --paths w.cube --quiet --out w.cube", "w.cube"),
        ("paths small.toml --quiet --out ./corner.obj", "corner.obj"),
        ("export c.npy --to npy --out c.npy", "c.npy"),
        ("export r.npy --to npy --out a/../r.npy", "r.npy"),
        ("export r.png --to png --out r.png", "r.png"),
        ("export p.csv --to csv --out p.csv", "p.csv"),
        ("export t.json --to json --out t.json", "t.json"),
        ("export w.csv --to csv --out w.csv", "w.csv"),
        ("export f.sigmf-meta --to sigmf --out f", "f.sigmf-meta"),
        ("export c.bin --to dca1000 --out c.bin", "c.bin"),
        ("export r.exr --to exr --out r.exr", "r.exr"),
        ("export p.pcd --to pcd --out p.pcd", "p.pcd"),
        ("export p.ply --to ply --out p.ply", "p.ply"),
        ("scene-from board.cfg --device xwr1443 --out board.cfg", "board.cfg"),
        ("import n.cube --scene small.toml --quiet --out n.cube", "n.cube"),
        ("import f.npy --scene scene.cube --quiet --out scene.cube", "scene.cube"),
        ("calibrate c.csv --at-m 2,30,1 --out c.csv", "c.csv"),
        (&format!("rcs corner.obj {RCS} --out corner.obj"), "corner.obj"),
        (&format!("rcs corner.obj {RCS} --materials skin.npy --out skin.npy"), "skin.npy"),
    ] {
        let before = place.bytes(input);
        refused(&place.try_run(words), "is an input of this command", words);
        assert_eq!(place.bytes(input), before, "{words}");
    }
}

/// An array's name for a cube made a file that no reader of arrays takes, and a scene's name lost the scene.
#[test]
fn a_result_is_not_written_under_the_ending_of_another_format() {
    let place = filled();
    place.run("export f.cube --to npy --out f.npy");
    std::fs::write(place.path("board.cfg"), BOARD).unwrap();
    std::fs::write(place.path("kept.toml"), "kept").unwrap();
    for (words, out, told) in [
        ("import f.npy --scene small.toml", "x.npy", "`wayside export FILE --to npy`"),
        ("import f.npy --scene small.toml", "x.paths", "`wayside paths`"),
        ("echo small.toml", "kept.toml", "echo writes radar cubes (.cube)"),
        ("echo small.toml", "x.bin", "`wayside export FILE --to dca1000`"),
        ("paths small.toml", "x.CSV", "`wayside export FILE --to csv`"),
        ("dsp f.cube", "x.points", "dsp writes a folder"),
        ("run small.toml --no-cache", "x.json", "run writes a folder"),
        ("calibrate f.cube --at-m 2,30,1", "x.npy", "calibrate writes a table (.csv)"),
        ("scene-from board.cfg --device xwr1443", "x.cube", "`wayside echo`"),
        ("export f.points --to csv", "x.pcd", "export writes .csv with --to csv"),
        ("export f.points --to foxglove", "x.osi", "export writes .mcap with --to foxglove"),
        ("export f.cube --to dca1000", "x.cube", "export writes .bin with --to dca1000"),
        (&format!("rcs corner.obj {RCS}"), "x.csv", "rcs writes an array of NumPy (.npy)"),
        ("vehicles", "x.glb", "vehicles writes a folder"),
        // Before a model or a dataset is looked for.
        ("evaluate none.model none", "kept.toml", "evaluate writes a page of text"),
        ("protocols none", "kept.toml", "protocols writes a page of text"),
        ("evaluate none.model none", "x.model", "`wayside train`"),
    ] {
        refused(&place.try_run(&format!("{words} --out {out}")), told, words);
        assert!(out == "kept.toml" || !place.path(out).exists(), "{words}");
    }
    assert_eq!(place.bytes("kept.toml"), b"kept");
    place.run("export f.points --to csv --out table.1");
    std::fs::create_dir(place.path("maps.rdm")).unwrap();
    place.run("dsp f.cube --quiet --out maps.rdm");
}

#[test]
fn no_sidecar_replaces_what_its_command_reads() {
    let place = filled();
    let copy = |from: &str, to: &str| std::fs::copy(place.path(from), place.path(to)).unwrap();
    copy("f.cube", "x.npy.json");
    copy("f.rdm", "y.mask.npy");
    copy("corner.obj", "z-facets.obj");
    copy("f.cube", "w.sigmf-meta");
    copy("f.cube", "d.rdm");
    copy("small.toml", "report.html");
    symlink(place.path("z-facets.obj"), place.path("z-facets.glb")).unwrap();
    for (words, input, unwritten) in [
        ("export x.npy.json --to npy --out x.npy", "x.npy.json", "x.npy"),
        ("export y.mask.npy --to npy --out y.npy", "y.mask.npy", "y.npy"),
        ("dsp d.rdm --quiet --out .", "d.rdm", "d.points"),
        ("run report.html --no-cache --quiet --out .", "report.html", "summary.json"),
        (&format!("rcs z-facets.obj {RCS} --pictures --out z.npy"), "z-facets.obj", "z.npy"),
    ] {
        let before = place.bytes(input);
        refused(&place.try_run(words), "is an input of this command", words);
        assert_eq!(place.bytes(input), before, "{words}");
        assert!(!place.path(unwritten).exists(), "{words}: refused after it had begun to write");
    }
}

#[test]
fn the_mask_of_a_map_replaces_a_mask_alone() {
    let place = filled();
    place.run("export f.cube --to npy --out n.mask.npy");
    std::fs::write(place.path("t.mask.npy"), "a table of mine").unwrap();
    place.run("export f.rdm --to npy --out own.npy");
    // An array of bytes with three axes is anybody's.
    std::fs::copy(place.path("own.mask.npy"), place.path("u.mask.npy")).unwrap();
    for (out, kept) in [("n.npy", "n.mask.npy"), ("t.npy", "t.mask.npy"), ("u.npy", "u.mask.npy")] {
        let before = place.bytes(kept);
        let words = format!("export f.rdm --to npy --out {out}");
        refused(&place.try_run(&words), "is no mask of", &words);
        assert!(place.bytes(kept) == before && !place.path(out).exists(), "{words}");
    }
    place.run("export f.rdm --to npy --out m.npy");
    // As of a command that was killed before it wrote the mask.
    std::fs::write(place.path("m.npy.json"), "{\"of\": \"m.npy\", \"mask\": {}}").unwrap();
    place.run("export f.rdm --to npy --out m.npy");
}

#[test]
fn hard_and_symbolic_links_to_an_input_are_that_input() {
    let place = filled();
    std::fs::hard_link(place.path("f.cube"), place.path("hard.npy")).unwrap();
    symlink(place.path("f.cube"), place.path("soft.npy")).unwrap();
    let before = place.bytes("f.cube");
    for out in ["hard.npy", "soft.npy"] {
        refused(&place.try_run(&format!("export f.cube --to npy --out {out}")), "is an input", out);
    }
    assert_eq!((place.bytes("f.cube"), place.bytes("hard.npy")), (before.clone(), before));
}

#[test]
fn every_file_that_a_scene_refers_to_is_an_input() {
    let place = Workplace::new();
    let gltf = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"uri":"corner.bytes","byteLength":36}]}"#;
    std::fs::write(place.path("corner.gltf"), gltf).unwrap();
    let corners: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let bytes: Vec<u8> = corners.iter().flat_map(|x| x.to_le_bytes()).collect();
    std::fs::write(place.path("corner.bytes"), &bytes).unwrap();
    std::fs::write(place.path("errors.txt"), "tx,rx,gain_db,phase_deg\n0,0,0,0\n0,1,0,0\n0,2,0,0\n0,3,0,0\n")
        .unwrap();
    std::fs::write(place.path("gain.txt"), "az_deg,el_deg,gain_db\n-90,0,-20\n0,0,0\n90,0,-20\n").unwrap();
    let scene = SMALL_SCENE
        .replace("corner.obj", "corner.gltf")
        .replace("[dsp]", "[dsp]\ncalibration = \"errors.txt\"")
        .replace("preset = \"1x4\"", "preset = \"1x4\"\npattern = \"table\"\npattern_file = \"gain.txt\"");
    std::fs::write(place.path("small.toml"), scene).unwrap();
    place.run("paths small.toml --quiet --out good.paths");
    for input in ["corner.gltf", "corner.bytes", "errors.txt", "gain.txt"] {
        let before = place.bytes(input);
        refused(&place.try_run(&format!("echo small.toml --quiet --out {input}")), "is an input", input);
        refused(&place.try_run(&format!("paths small.toml --quiet --out {input}")), "is an input", input);
        assert_eq!(place.bytes(input), before);
    }
}

#[test]
fn what_is_no_plain_file_is_refused_by_every_command_and_stays() {
    let place = filled();
    let fifo = place.path("fifo");
    assert!(std::process::Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    let _socket = std::os::unix::net::UnixListener::bind(place.path("socket")).unwrap();
    symlink("fifo", place.path("link")).unwrap();
    symlink("nowhere", place.path("dangling")).unwrap();
    place.run("export f.cube --to npy --out f.npy");
    for (out, word) in [
        ("fifo", "FIFO"),
        ("link", "FIFO"),
        ("socket", "socket"),
        ("a", "folder"),
        ("dangling", "link to nothing"),
    ] {
        for words in [
            "echo small.toml --quiet",
            "paths small.toml --quiet",
            "export f.cube --to npy",
            "export f.points --to csv",
            "import f.npy --scene small.toml --quiet",
            "calibrate f.cube --at-m 2,30,1",
            &format!("rcs corner.obj {RCS}"),
        ] {
            refused(&place.try_run(&format!("{words} --out {out}")), word, &format!("{words} to {out}"));
        }
    }
    let kind = |name: &str| std::fs::symlink_metadata(place.path(name)).unwrap().file_type();
    assert!(kind("fifo").is_fifo() && kind("socket").is_socket());
    assert!(kind("link").is_symlink() && kind("dangling").is_symlink());
    assert!(!place.path("nowhere").exists());
}

#[test]
fn a_symbolic_link_to_a_plain_file_stays_a_link() {
    let place = filled();
    std::fs::create_dir(place.path("there")).unwrap();
    std::fs::write(place.path("there/table.csv"), "old").unwrap();
    symlink("there/table.csv", place.path("table.csv")).unwrap();
    place.run("export f.points --to csv --out table.csv");
    assert!(std::fs::symlink_metadata(place.path("table.csv")).unwrap().is_symlink());
    assert!(place.bytes("there/table.csv").starts_with(b"frame,"));
    assert_eq!(std::fs::read_dir(place.path("there")).unwrap().count(), 1);
}

#[test]
fn work_that_could_not_be_written_is_not_begun() {
    let place = filled();
    std::fs::write(place.path("file"), "").unwrap();
    std::fs::create_dir(place.path("full")).unwrap();
    std::fs::create_dir(place.path("full/s.json")).unwrap();
    std::fs::create_dir(place.path("full/report.html")).unwrap();
    std::fs::create_dir(place.path("full/weights.model")).unwrap();
    std::fs::create_dir(place.path("full/manifest.json")).unwrap();
    std::fs::write(place.path("spec.toml"), RECIPE.replace("SCENES", "1")).unwrap();
    std::fs::write(place.path("base.toml"), BASE).unwrap();
    std::fs::create_dir(place.path("full/detection.md")).unwrap();
    place.run("dataset spec.toml --out d --quiet");
    for words in [
        "run small.toml --no-cache --quiet --out full",
        "run small.toml --no-cache --quiet --out file",
        "dataset spec.toml --quiet --out full",
        "dataset spec.toml --quiet --out file/d",
        "train d --quiet --out full",
        "train d --quiet --out file",
        "dsp f.cube --quiet --out file",
        "vehicles --quiet --out file",
        "vehicles --quiet --out full",
        &format!("rcs corner.obj {RCS} --out full/s.npy"),
        &format!("rcs corner.obj {RCS} --out file/s.npy"),
    ] {
        refused(&place.try_run(words), "cannot", words);
    }
    let left: Vec<_> = std::fs::read_dir(place.path("full")).unwrap().map(|e| e.unwrap().path()).collect();
    assert!(left.iter().all(|path| path.is_dir()), "{left:?}");
}

/// A dataset of one class on the small radar.
const RECIPE: &str = "scene = \"base.toml\"\nseed = 1\nscenes_per_class = SCENES\nrange_m = [25.0, 45.0]\n\
speed_mps = [1.0, 5.0]\nlanes = [1, 2]\nvehicle_seeds = 2\nscenes_per_shard = 8\n[models]\nmotorcycle = [\"motorcycle-street\"]\n";

const BASE: &str = "name = \"base\"\n[radar.waveform]\nsamples = 64\nchirps = 16\n[radar.array]\npreset = \"1x4\"\n\
[dsp]\ntraining_cells = [3, 6]\n[fidelity]\nbounces = 1\n";

#[test]
fn a_dataset_goes_on_with_its_own_whole_shards_alone() {
    let place = Workplace::new();
    std::fs::write(place.path("base.toml"), BASE).unwrap();
    let recipe = |text: String| std::fs::write(place.path("spec.toml"), text).unwrap();
    recipe(RECIPE.replace("SCENES", "9"));
    place.run("dataset spec.toml --out whole --quiet");
    place.run("dataset spec.toml --out d --quiet");
    // A damaged shard is named and made anew, and so is one whose lines are of other scenes.
    let mut bytes = place.bytes("d/shard-0000.dataset");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(place.path("d/shard-0000.dataset"), bytes).unwrap();
    std::fs::write(place.path("d/shard-0001.jsonl"), "{\"base\":\"base.toml\",\"ch").unwrap();
    let output = place.try_run("dataset spec.toml --out d");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success() && said.contains("shard-0000.dataset") && said.contains("shard-0001.jsonl"),
        "{said}"
    );
    for shard in ["shard-0000.dataset", "shard-0001.dataset"] {
        assert_eq!(place.bytes(&format!("d/{shard}")), place.bytes(&format!("whole/{shard}")), "{shard}");
    }
    // More scenes leave the first ones as they are; other scenes do not belong into the folder.
    recipe(RECIPE.replace("SCENES", "10"));
    place.run("dataset spec.toml --out d --quiet");
    recipe(RECIPE.replace("SCENES", "10").replace("45.0", "44.0"));
    refused(&place.try_run("dataset spec.toml --out d --quiet"), "another recipe", "other ranges");
    recipe(RECIPE.replace("SCENES", "10"));
    refused(&place.try_run("dataset spec.toml --seed 2 --out d --quiet"), "another recipe", "another seed");
    std::fs::write(place.path("base.toml"), BASE.replace("bounces = 1", "bounces = 2")).unwrap();
    refused(&place.try_run("dataset spec.toml --out d --quiet"), "another recipe", "another scene");
}

#[test]
fn names_in_artifacts_lead_into_no_other_folder() {
    use artifact::dataset::{Crop, Dataset, Sample, Split};
    let place = Workplace::new();
    let mut writer = artifact::Writer::<Dataset>::create(
        &place.path("x.dataset"),
        &artifact::Provenance::default(),
        &artifact::dataset::CropFormat {
            side: 2,
            range_span_m: 24.0,
            velocity_span_mps: 8.0,
            floor_db: 0.0,
            ceiling_db: 40.0,
        },
    )
    .unwrap();
    for id in ["../outside", "/outside", ".hidden"] {
        let crop = Crop { pixels: vec![0; 4], range_m: 1.0, radial_velocity_mps: 0.0 };
        let sample = Sample {
            id: id.to_owned(),
            signature: artifact::signature::Signature::default(),
            crop: Some(crop),
            class: None,
            model: String::new(),
            variant: 0,
            scene: 0,
            target: 0,
            frame: 0,
            split: Split::Test,
            range_m: 1.0,
            radial_velocity_mps: 0.0,
            lane: None,
            seed: 0,
        };
        writer.write(&sample).unwrap();
    }
    writer.finish().unwrap();
    place.run("export x.dataset --to png --out pictures");
    assert!(!place.path("outside.png").exists() && !Path::new("/outside.png").exists());
    assert_eq!(std::fs::read_dir(place.path("pictures")).unwrap().count(), 3);
}

#[test]
fn a_table_is_not_described_over_another_files_sidecar() {
    let place = Workplace::new();
    std::fs::write(place.path("s.json"), "{\"sqrt_w_per_step\": 1e-9}").unwrap();
    let words = format!("rcs corner.obj {RCS} --out s.npy");
    refused(&place.try_run(&words), "does not belong to s.npy", "a foreign sidecar");
    assert_eq!(place.bytes("s.json"), b"{\"sqrt_w_per_step\": 1e-9}");
    assert!(!place.path("s.npy").exists(), "refused before the work");
    std::fs::remove_file(place.path("s.json")).unwrap();
    place.run(&words);
    place.run(&words);
}

/// Files of more than a kibibyte end the program: the table of one value has less, its description more.
#[cfg(unix)]
#[test]
fn a_table_is_never_described_by_that_of_an_earlier_one() {
    let place = Workplace::new();
    let rcs = |az_deg: &str| format!("rcs corner.obj --freq-ghz 77 --az-deg {az_deg} --quiet --out s.npy");
    place.run(&rcs("0"));
    let [first, described] = ["s.npy", "s.json"].map(|name| place.bytes(name));
    assert!(first.len() < 1024 && described.len() > 1024);
    let script = format!("ulimit -c 0; ulimit -f 1; exec {} {}", crate::common::PROGRAM, rcs("10"));
    let killed =
        std::process::Command::new("bash").args(["-c", &script]).current_dir(place.root()).output().unwrap();
    assert!(!killed.status.success());
    assert_ne!(place.bytes("s.npy"), first, "it was not killed behind the table");
    assert!(!place.path("s.json").exists(), "a table of 10° is described as one of 0°");
    place.run(&rcs("10"));
    assert!(String::from_utf8(place.bytes("s.json")).unwrap().contains("10.0"));
}

#[test]
fn a_scene_that_was_edited_since_it_was_made_is_not_made_anew() {
    let place = Workplace::new();
    std::fs::write(place.path("b.cfg"), BOARD).unwrap();
    let words = "scene-from b.cfg --device xwr1443 --out b.toml";
    place.run(words);
    place.run(words);
    let edited = String::from_utf8(place.bytes("b.toml")).unwrap() + "# my remark\n";
    std::fs::write(place.path("b.toml"), &edited).unwrap();
    let output = place.try_run(words);
    refused(&output, "b.toml: is not what scene-from would write, and would be replaced", words);
    refused(&output, "choose another --out", words);
    assert_eq!(place.bytes("b.toml"), edited.as_bytes());
    place.run("scene-from b.cfg --device xwr1443 --out other.toml");
}

/// Models of one's own beside those that are asked for.
#[test]
fn a_model_of_another_program_is_not_replaced_by_a_vehicle() {
    let place = Workplace::new();
    place.run("vehicles car-suv car-hatchback --quiet --out v");
    let own = String::from_utf8_lossy(&place.bytes("v/car-suv.glb")).replacen("wayside", "blender", 1);
    std::fs::write(place.path("v/car-suv.glb"), &own).unwrap();
    let [before, manifest] = ["v/car-hatchback.glb", "v/manifest.json"].map(|name| place.bytes(name));
    let words = "vehicles car-suv car-hatchback --seed 2 --quiet --out v";
    refused(&place.try_run(words), "car-suv.glb: was not written by this program", words);
    assert_eq!([place.bytes("v/car-hatchback.glb"), place.bytes("v/manifest.json")], [before, manifest]);
    assert_eq!(place.bytes("v/car-suv.glb"), own.as_bytes());
}

#[test]
fn a_run_replaces_results_of_runs_and_nothing_of_these_names_that_is_the_users() {
    let place = Workplace::new();
    let run = "run small.toml --no-cache --quiet --out a";
    std::fs::create_dir_all(place.path("a/pictures")).unwrap();
    for (name, text) in [
        ("report.html", "<!DOCTYPE html><html><head><title>My thesis</title></head></html>"),
        ("summary.json", "{\"frames\": 3, \"mine\": true}"),
        ("pictures/scene-0000.png", "a photo of mine"),
        ("pictures/rdm-0001.exr", "a map of mine"),
    ] {
        let place_of = place.path("a").join(name);
        std::fs::write(&place_of, text).unwrap();
        refused(&place.try_run(run), &format!("{name}: was not written by this program"), name);
        assert_eq!(place.bytes(&format!("a/{name}")), text.as_bytes());
        std::fs::remove_file(place_of).unwrap();
    }
    place.run(run);
    assert!(!place.path("a/.wayside-unfinished.txt").exists());
    // A report of an earlier version has a title alone.
    let page = String::from_utf8(place.bytes("a/report.html")).unwrap();
    let mark = "<meta name=\"generator\" content=\"wayside\">";
    assert!(page.contains(mark));
    std::fs::write(place.path("a/report.html"), page.replace(mark, "")).unwrap();
    place.run(run);
    for name in ["report.html", "summary.json"] {
        std::fs::remove_file(place.path("a").join(name)).unwrap();
    }
    place.run(run); // of a run that was ended before these
}

#[test]
fn results_that_nobody_named_replace_no_files_of_others() {
    let place = filled();
    let kept = |command: &str, name: &str| {
        let _ = std::fs::create_dir_all(place.path(name).parent().unwrap());
        std::fs::write(place.path(name), "the user's").unwrap();
        refused(&place.try_run(command), "was not written by this program", command);
        assert_eq!(place.bytes(name), b"the user's", "{command}");
        std::fs::remove_file(place.path(name)).unwrap();
    };
    for name in ["d/f.rdm", "d/f.points", "d/f.tracks", "d/pictures/rdm-0000.png", "d/pictures/rdm-0001.exr"]
    {
        kept("dsp f.cube --out d --pictures --quiet", name);
    }
    (0..2).for_each(|_| drop(place.run("dsp f.cube --out d --pictures --quiet"))); // its own, once more
    kept("run small.toml --out r --no-cache", "r/frames.points");
    let table = "rcs corner.obj --freq-ghz 77 --az-deg 0:20:9 --bounces 1 --pictures --out S.npy --quiet";
    let of_table = ["S-polar.png", "S-azimuth.png", "S-facets.glb", "S-view.html"];
    of_table.into_iter().for_each(|name| kept(table, name));
    (0..2).for_each(|_| drop(place.run(table)));
}

#[test]
fn a_study_replaces_results_of_studies_alone() {
    let place = Workplace::new();
    let study = "scene = \"small.toml\"\nrepeats = 1\n[[vary]]\nname = \"chirps\"\n\
                 key = \"radar.waveform.chirps\"\nvalues = [16, 32]\n[goal]\nmetric = \"coverage\"\n";
    std::fs::write(place.path("study.toml"), study).unwrap();
    let words = "sweep study.toml --no-cache --quiet --out u";
    std::fs::create_dir(place.path("u")).unwrap();
    for (name, text) in
        [("report.md", "# My thesis\n"), ("sweep.csv", "frequency,level\n1,2\n"), ("pareto.svg", "<svg/>")]
    {
        std::fs::write(place.path("u").join(name), text).unwrap();
        refused(&place.try_run(words), &format!("{name}: was not written by this program"), name);
        assert_eq!(place.bytes(&format!("u/{name}")), text.as_bytes());
        std::fs::remove_file(place.path("u").join(name)).unwrap();
    }
    place.run(words);
    place.run(words);
}

/// A folder that another process has locked, as a run of it does.
#[test]
fn a_folder_that_another_run_fills_is_refused() {
    let place = Workplace::new();
    place.run("run small.toml --out a --no-cache --quiet");
    let vehicles = "vehicles car-suv --quiet --out v";
    place.run(vehicles);
    for (folder, words) in [("a", "run small.toml --out a --no-cache --quiet"), ("v", vehicles)] {
        let lock = std::fs::File::open(place.path(folder)).unwrap();
        lock.lock().unwrap();
        refused(&place.try_run(words), &format!("{folder}: is being written by another run"), words);
        drop(lock);
        place.run(words);
    }
}

#[test]
fn vehicles_are_not_written_where_a_manifest_of_another_program_lies() {
    let place = Workplace::new();
    std::fs::create_dir(place.path("v")).unwrap();
    for foreign in ["{\"name\": \"my page\"}", "[]", "[{\"name\": \"a\"}]", "no JSON"] {
        std::fs::write(place.path("v/manifest.json"), foreign).unwrap();
        let output = place.try_run("vehicles car-suv --quiet --out v");
        refused(&output, "manifest.json: was not written by this program", foreign);
        assert_eq!(place.bytes("v/manifest.json"), foreign.as_bytes());
        assert_eq!(std::fs::read_dir(place.path("v")).unwrap().count(), 1, "refused before the work");
    }
    std::fs::remove_file(place.path("v/manifest.json")).unwrap();
    place.run("vehicles car-suv --quiet --out v");
    let manifest = place.bytes("v/manifest.json");
    place.run("vehicles car-suv --quiet --out v");
    assert_eq!(place.bytes("v/manifest.json"), manifest, "its own is replaced");
}

#[test]
fn named_vehicles_are_written_alone_and_an_unknown_name_gets_the_nearest() {
    let place = Workplace::new();
    place.run("vehicles car-suv bus-city --quiet --out v");
    let names = ["bus-city.glb", "car-suv.glb", "manifest.json"];
    let mut written: Vec<String> = std::fs::read_dir(place.path("v"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    written.sort();
    assert_eq!(written, names);
    let output = place.try_run("vehicles car-suvv --quiet --out w");
    refused(&output, "car-suv", "a misspelt name");
    assert!(!place.path("w").exists());
}
