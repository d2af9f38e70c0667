//! Raw data of devices: written, read back, and processed as before.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::{BOARD, Workplace};

/// The small scene with transmitters that take turns.
fn tdm() -> Workplace {
    let place = Workplace::new();
    let of = |array: &str| crate::common::SMALL_SCENE.replace("preset = \"1x4\"", array);
    std::fs::write(place.path("ideal.toml"), of("preset = \"3x4\"")).unwrap();
    let scene = of("preset = \"3x4\"\nmultiplexing = \"tdm\"");
    std::fs::write(place.path("tdm.toml"), scene).unwrap();
    place.run("echo tdm.toml --out a.cube --quiet");
    place
}

#[test]
fn a_cube_through_sigmf_is_the_same_samples() {
    let place = tdm();
    place.run("export a.cube --to sigmf --out raw --quiet");
    place.run("import raw.sigmf-meta --scene tdm.toml --out b.cube --quiet");
    place.run("export a.cube --to npy --out a.npy --quiet");
    place.run("export b.cube --to npy --out b.npy --quiet");
    assert_eq!(place.bytes("a.npy"), place.bytes("b.npy"));
}

/// The files that `inspect` tells an artifact to be made of.
fn inputs(place: &Workplace, name: &str) -> Vec<String> {
    let told = place.run(&format!("inspect {name}"));
    let input = |line: &str| Some(line.strip_prefix("input")?.split_whitespace().next()?.to_owned());
    told.lines().filter_map(input).collect()
}

#[test]
fn a_cube_names_every_file_that_it_was_imported_from() {
    let place = tdm();
    place.run("export a.cube --to sigmf --out raw --quiet");
    for (asked, other) in [("meta", "data"), ("data", "meta")] {
        place.run(&format!("import raw.sigmf-{asked} --scene tdm.toml --out b.cube --quiet"));
        let expected = [format!("raw.sigmf-{asked}"), format!("raw.sigmf-{other}"), "tdm.toml".to_owned()];
        assert_eq!(inputs(&place, "b.cube"), expected);
    }
    place.run("export a.cube --to dca1000 --out raw.bin --quiet");
    place.run("import raw.bin --scene tdm.toml --out b.cube --quiet");
    assert_eq!(inputs(&place, "b.cube"), ["raw.bin", "tdm.toml", "raw.bin.json"]);
    // A step that the command tells is not that of the file beside it.
    place.run("import raw.bin --scene tdm.toml --step 1e-9 --out b.cube --quiet");
    assert_eq!(inputs(&place, "b.cube"), ["raw.bin", "tdm.toml"]);
}

/// A pattern and a calibration are in what the samples are taken as, and in what is made of them.
#[test]
fn patterns_and_calibrations_are_among_the_inputs_of_what_is_made_by_them() {
    let place = tdm();
    let calibration: String = (0..12).map(|i| format!("{},{},0.1,2\n", i / 4, i % 4)).collect();
    std::fs::write(place.path("errors.csv"), format!("tx,rx,gain_db,phase_deg\n{calibration}")).unwrap();
    std::fs::write(place.path("beam.csv"), "az_deg,el_deg,gain_db\n-90,0,-3\n0,0,0\n90,0,-3\n").unwrap();
    let scene = String::from_utf8(place.bytes("tdm.toml")).unwrap();
    let scene =
        scene.replace("[radar.array]\n", "[radar.array]\npattern = \"table\"\npattern_file = \"beam.csv\"\n");
    let scene = scene.replace("[dsp]\n", "[dsp]\ncalibration = \"errors.csv\"\n");
    std::fs::write(place.path("mine.toml"), scene).unwrap();
    let files = ["mine.toml", "beam.csv", "errors.csv"].map(str::to_owned);
    place.run("export a.cube --to npy --out a.npy --quiet");
    place.run("import a.npy --scene mine.toml --out b.cube --quiet");
    let [array, sidecar] = ["a.npy", "a.npy.json"].map(|name| vec![name.to_owned()]);
    assert_eq!(inputs(&place, "b.cube"), [array, files.to_vec(), sidecar].concat());
    // A model that the scene names is not read.
    let with_body = "\n[[target]]\nkind = \"mesh\"\nid = \"m\"\nmodel = \"none.glb\"\nlane = 2\ny_m = 30.0\n";
    std::fs::write(place.path("mine.toml"), [place.bytes("mine.toml"), with_body.into()].concat()).unwrap();
    place.run("dsp a.cube --scene mine.toml --out seen --quiet");
    let of_cube = inputs(&place, "a.cube");
    assert_eq!(inputs(&place, "seen/a.points"), [of_cube.clone(), files.to_vec()].concat());
    place.run("dsp a.cube --scene tdm.toml --out seen --quiet");
    assert_eq!(inputs(&place, "seen/a.points"), of_cube, "a file of the cube's own is named once");
}

#[test]
fn recordings_whose_names_have_a_dot_are_two_and_anothers_recording_stays() {
    let place = tdm();
    place.run("export a.cube --to sigmf --out x.1 --quiet");
    place.run("export a.cube --to sigmf --out x.2 --quiet");
    place.run("export a.cube --to sigmf --out x.2.sigmf-meta --quiet"); // its own, once more
    for name in ["x.1", "x.2"] {
        assert!(["data", "meta"].iter().all(|part| place.path(&format!("{name}.sigmf-{part}")).is_file()));
    }
    let foreign = r#"{ "global": { "core:recorder": "another" } }"#;
    std::fs::write(place.path("y.sigmf-meta"), foreign).unwrap();
    let output = place.try_run("export a.cube --to sigmf --out y");
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("y.sigmf-meta") && told.contains("not written by this program"), "{told}");
    assert!(place.bytes("y.sigmf-meta") == foreign.as_bytes() && !place.path("y.sigmf-data").exists());
    std::fs::write(place.path("z.sigmf-data"), "another's samples").unwrap();
    let output = place.try_run("export a.cube --to sigmf --out z");
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("z.sigmf-data: has no description of this program's"), "{told}");
    assert_eq!(place.bytes("z.sigmf-data"), b"another's samples");
    place.run("export a.cube --to sigmf --out z.sigmf-data --quiet"); // named itself
}

#[test]
fn a_cube_through_a_capture_card_errs_by_half_a_step_and_shows_the_same_cells() {
    let place = tdm();
    place.run("export a.cube --to dca1000 --out raw.bin --quiet");
    place.run("import raw.bin --scene tdm.toml --out b.cube --quiet");
    place.run("export a.cube --to npy --out a.npy --quiet");
    place.run("export b.cube --to npy --out b.npy --quiet");
    let floats = |name: &str| -> Vec<f32> {
        let bytes = place.bytes(name);
        // Version 1.0 of .npy tells the header's length in bytes 8 and 9.
        let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        bytes[start..].as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect()
    };
    let (exact, stepped) = (floats("a.npy"), floats("b.npy"));
    let step = exact.iter().fold(0.0_f32, |peak, x| peak.max(x.abs())) / 32_000.0;
    let worst = exact.iter().zip(&stepped).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    println!("worst {worst:.2e} of a step {step:.2e}");
    // And what single precision rounds of 32,000 steps: 0.004.
    assert!(worst <= 0.505 * step && exact != stepped);
    let masks = ["a", "b"].map(|name| {
        place.run(&format!("dsp {name}.cube --out {name} --quiet"));
        place.run(&format!("export {name}/{name}.rdm --to npy --out map-{name}.npy --quiet"));
        place.bytes(&format!("map-{name}.mask.npy"))
    });
    let different = masks[0].iter().zip(&masks[1]).filter(|(a, b)| a != b).count();
    // 2048 cells; a cell that lies on its threshold may fall either way.
    assert!(masks[0].len() == masks[1].len() && different <= 2, "{different} cells");
}

#[test]
fn recordings_that_do_not_fit_are_refused_by_name_and_rule() {
    let place = tdm();
    place.run("export a.cube --to dca1000 --out raw.bin --quiet");
    let whole = place.bytes("raw.bin");
    std::fs::write(place.path("cut.bin"), &whole[..whole.len() - 8]).unwrap();
    std::fs::write(place.path("odd.bin"), &whole[..whole.len() - 3]).unwrap();
    std::fs::write(place.path("empty.bin"), []).unwrap();
    place.run("echo ideal.toml --out ideal.cube --quiet");
    for (command, told) in [
        ("import cut.bin --scene tdm.toml --out b.cube", "no whole number of frames"),
        ("import odd.bin --scene tdm.toml --out b.cube", "take 8"),
        ("import empty.bin --scene tdm.toml --out b.cube", "no whole number of frames"),
        ("import raw.bin --scene tdm.toml --out b.cube --step 0", "must be from 1e-30 to 1e30"),
        ("import none.sigmf-meta --scene tdm.toml --out b.cube", "none.sigmf-meta"),
        ("export ideal.cube --to dca1000 --out c.bin", "orthogonal"),
    ] {
        let output = place.try_run(command);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success(), "{command}");
        assert!(error.contains(told), "{command}: {error}");
        assert!(!place.path("b.cube").exists() && !place.path("c.bin").exists(), "{command}");
    }
}

/// A chirp of four receivers as a device with four lanes records it, sent as a board's `.cfg` says.
#[test]
fn a_recording_is_read_by_the_boards_configuration_where_the_scene_says_nothing() {
    let place = Workplace::new();
    std::fs::write(place.path("b.cfg"), BOARD).unwrap();
    std::fs::write(place.path("few.cfg"), BOARD.replace(" 64 ", " 3 ")).unwrap();
    std::fs::write(place.path("bare.toml"), "name = \"bare\"\n").unwrap();
    let count = 8 * 64 * 4;
    let parts = (0..count).flat_map(|i| {
        let (sample, rx) = (i / 4, i % 4);
        [(sample, rx, 0), (sample, rx, 1)]
    });
    let mut numbers: Vec<(usize, usize, usize)> = parts.collect();
    // Of each sample the four in-phase parts, then the four others.
    numbers.sort_by_key(|(sample, rx, part)| (*sample, *part, *rx));
    let bytes =
        numbers.iter().flat_map(|(n, rx, part)| (((n % 50) * 10 + rx + 1000 * part) as i16).to_le_bytes());
    std::fs::write(place.path("x.bin"), bytes.collect::<Vec<u8>>()).unwrap();
    place.run("import x.bin --scene bare.toml --config b.cfg --device xwr1443 --out x.cube --quiet");
    place.run("export x.cube --to npy --out x.npy --quiet");
    let values = place.bytes("x.npy");
    let start = 10 + usize::from(u16::from_le_bytes([values[8], values[9]]));
    let floats: Vec<f32> =
        values[start..].as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
    // [channel][chirp][sample]: receiver 2, chirp 3, sample 5 of 64.
    let at = 2 * ((2 * 8 + 3) * 64 + 5);
    assert_eq!(
        [floats[at], floats[at + 1]],
        [((3 * 64 + 5) % 50 * 10 + 2) as f32, ((3 * 64 + 5) % 50 * 10 + 1002) as f32]
    );
    place.run("scene-from b.cfg --device iwr1443 --out b.toml");
    place.run("import x.bin --scene b.toml --layout four-lanes --out y.cube --quiet");
    let shown = place.run("inspect y.cube");
    assert!(shown.contains("[4, 8, 64]"), "{shown}");
    for (command, told) in [
        ("import x.bin --scene small.toml --config b.cfg --device xwr1443 --out z.cube", "b.cfg:"),
        ("import x.bin --scene bare.toml --device xwr1443 --out z.cube", "--config"),
        (
            "import x.bin --scene bare.toml --config few.cfg --device xwr1443 --out z.cube",
            "few.cfg: bare.toml: [radar.waveform]: `samples` must be a number from 8",
        ),
        ("scene-from b.cfg --out z.toml", "--device"),
        ("scene-from b.cfg --device xwr6843 --out z.toml", "b.cfg:3: profileCfg: chirps begin at 77 GHz"),
        ("scene-from small.toml --device xwr1443 --out z.toml", "small.toml: there is no frameCfg"),
        (
            "scene-from few.cfg --device xwr1443 --out z.toml",
            "few.cfg:3: profileCfg: [radar.waveform]: `samples` must",
        ),
    ] {
        let output = place.try_run(command);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && error.contains(told), "{command}: {error}");
        assert!(!place.path("z.cube").exists() && !place.path("z.toml").exists(), "{command}");
    }
}

#[test]
fn every_export_has_a_sidecar_of_its_own() {
    let place = tdm();
    place.run("export a.cube --to dca1000 --out x.bin --quiet");
    let told = place.summary("x.bin.json");
    assert_eq!((told["of"].as_str(), told["sqrt_w_per_step"].is_f64()), (Some("x.bin"), true));
    place.run("export a.cube --to npy --out x.npy --quiet");
    place.run("paths tdm.toml --out x.paths --quiet");
    place.run("export x.paths --to csv --out x.csv --quiet");
    assert_eq!(place.summary("x.bin.json"), told, "the other exports leave it");
    assert_eq!(place.summary("x.npy.json")["of"], "x.npy");
    assert!(place.summary("x.csv.json")["f_c_hz"].is_f64());
    assert!(!place.path("x.json").exists());
    // What is not this file's own is not written over, and the export is refused before it writes.
    std::fs::write(place.path("y.npy.json"), "{\"of\": \"another\"}").unwrap();
    let output = place.try_run("export a.cube --to npy --out y.npy");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("does not belong to y.npy"));
    assert!(!place.path("y.npy").exists() && place.bytes("y.npy.json") == b"{\"of\": \"another\"}");
}

#[test]
fn a_step_is_taken_from_the_file_that_tells_of_these_samples_or_said_to_be_missing() {
    let place = tdm();
    place.run("export a.cube --to dca1000 --out x.bin --quiet");
    let imported = |file: &str, words: &str| {
        let output = place.try_run(&format!("import {file} --scene tdm.toml --out b.cube {words}"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{said}");
        place.run("export b.cube --to npy --out b.npy");
        (place.bytes("b.npy"), said, place.run("inspect b.cube"))
    };
    let (right, said, about) = imported("x.bin", "");
    assert!(said.is_empty(), "{said}");
    let step = place.summary("x.bin.json")["sqrt_w_per_step"].as_f64().unwrap();
    assert!(about.contains("x.bin.json") && about.contains("sqrt_w_per_step"), "{about}");
    let (again, said, _) = imported("x.bin", &format!("--step {step}"));
    assert!(again == right && said.is_empty(), "{said}");
    // As an earlier version wrote it: `x.json` without a hash, of the same shape.
    let mut old = place.summary("x.bin.json");
    let map = old.as_object_mut().unwrap();
    map.retain(|key, _| key != "of" && key != "blake3");
    std::fs::write(place.path("x.json"), old.to_string()).unwrap();
    std::fs::rename(place.path("x.bin.json"), place.path("kept.json")).unwrap();
    assert_eq!(imported("x.bin", "").0, right);
    // The sidecar of another file: an earlier version's of an array, and that of other samples.
    std::fs::write(place.path("x.json"), "{\"shape\": [\"frame\", \"channel\", \"chirp\", \"sample\"]}")
        .unwrap();
    let (unit, said, about) = imported("x.bin", "");
    assert!(said.contains("no step is told") && about.contains("not told"), "{said}{about}");
    assert!(said.contains("nothing beside it tells the shape of a frame: 2 frames are assumed"), "{said}");
    assert!(
        said.contains("x.bin: two lanes and I before Q are assumed; the board's configuration"),
        "{said}"
    );
    let (_, said, _) = imported("x.bin", "--layout two-lanes");
    assert!(said.contains("x.bin: I before Q is assumed"), "{said}");
    let (_, said, _) = imported("x.bin", "--layout two-lanes --iq-order iq");
    assert!(!said.contains("before Q"), "{said}");
    assert_ne!(unit, right);
    let mut samples = place.bytes("x.bin");
    samples[0] ^= 1;
    std::fs::write(place.path("x.bin"), samples).unwrap();
    std::fs::rename(place.path("kept.json"), place.path("x.bin.json")).unwrap();
    let (_, said, _) = imported("x.bin", "");
    assert!(said.contains("other samples") && said.contains("no step is told"), "{said}");
}

/// Samples of a radar with twice as many samples a chirp make whole frames too, and a carrier is no part of
/// their count.
#[test]
fn recordings_of_another_radar_are_refused_where_what_stands_beside_them_tells() {
    let place = tdm();
    let scene = String::from_utf8(place.bytes("tdm.toml")).unwrap();
    let other = |name: &str, from: &str, to: &str| {
        assert!(scene.contains(from), "{from}");
        std::fs::write(place.path(name), scene.replace(from, to)).unwrap();
    };
    other("short.toml", "samples = 64", "samples = 32");
    other("x-band.toml", "samples = 64", "samples = 64\nstart_frequency_ghz = 10.0");
    place.run("export a.cube --to dca1000 --out raw.bin --quiet");
    place.run("export a.cube --to sigmf --out raw --quiet");
    let mut foreign = place.summary("raw.sigmf-meta");
    foreign["global"].as_object_mut().unwrap().retain(|key, _| !key.starts_with("wayside:"));
    std::fs::write(place.path("foreign.sigmf-meta"), foreign.to_string()).unwrap();
    std::fs::write(place.path("foreign.sigmf-data"), place.bytes("raw.sigmf-data")).unwrap();
    for (command, told) in [
        (
            "import raw.bin --scene short.toml",
            "raw.bin.json: sizes tells 64 samples, the scene's radar has 32",
        ),
        ("import raw.sigmf-meta --scene short.toml", "raw.sigmf-meta: wayside:samples is 64"),
        ("import foreign.sigmf-meta --scene x-band.toml", "core:frequency of capture 0 is 77"),
    ] {
        let output = place.try_run(&format!("{command} --out b.cube"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{command}: {said}");
        assert!(said.contains(told) && !place.path("b.cube").exists(), "{command}: {said}");
    }
    let output = place.try_run("import foreign.sigmf-meta --scene short.toml --out b.cube");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    assert!(said.contains("4 frames are assumed of 48 chirps × 4 receivers × 32 samples"), "{said}");
}

#[test]
fn the_mask_of_a_map_is_named_by_the_whole_name_of_the_map() {
    let place = tdm();
    place.run("dsp a.cube --out a --quiet");
    place.run("export a/a.rdm --to npy --out map.1");
    place.run("export a/a.rdm --to npy --out map.2");
    place.run("export a/a.rdm --to npy --out map.npy");
    assert!(
        ["map.1.mask.npy", "map.2.mask.npy", "map.mask.npy"].iter().all(|name| place.path(name).is_file())
    );
}

/// Where the values of an `.npy` begin: version 1.0 tells the head's length in bytes 8 and 9.
fn head_of(bytes: &[u8]) -> usize {
    10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]))
}

/// The values of `a.npy` under another name, each part of them changed.
fn changed(place: &Workplace, name: &str, part: impl Fn(usize, f32) -> f32) {
    let bytes = place.bytes("a.npy");
    let (head, values) = bytes.split_at(head_of(&bytes));
    let parts = values.as_chunks::<4>().0.iter().map(|part| f32::from_le_bytes(*part));
    let values = parts.enumerate().flat_map(|(index, value)| part(index, value).to_le_bytes());
    std::fs::write(place.path(name), [head.to_vec(), values.collect()].concat()).unwrap();
}

/// The small scene's cube and its array, and the factor by which the largest part of a value is 900.
fn in_steps() -> (Workplace, f32) {
    let place = Workplace::new();
    place.run("echo small.toml --out a.cube --quiet");
    place.run("export a.cube --to npy --out a.npy --quiet");
    let bytes = place.bytes("a.npy");
    let parts = bytes[head_of(&bytes)..].as_chunks::<4>().0.iter().map(|part| f32::from_le_bytes(*part));
    let peak = parts.fold(0.0_f32, |peak, part| peak.max(part.abs()));
    (place, 900.0 / peak)
}

#[test]
fn levels_of_steps_are_in_decibels_of_steps_or_of_full_scale_and_never_in_watts() {
    let (place, steps) = in_steps();
    changed(&place, "steps.npy", |_, part| (part * steps).trunc());
    for (samples, words, unit) in [
        ("steps.npy", "", "dB of ADC steps"),
        ("steps.npy", "--full-scale 2048", "dBFS"),
        ("a.npy", "", "dBW"),
    ] {
        place.run(&format!("import {samples} --scene small.toml {words} --out b.cube --quiet"));
        place.run("dsp b.cube --out d --quiet");
        for told in ["b.cube", "d/b.rdm"].map(|file| place.run(&format!("inspect {file}"))) {
            let units = ["dB of ADC steps", "dBFS", "dBW"].into_iter().filter(|unit| told.contains(unit));
            assert_eq!(units.collect::<Vec<_>>(), [unit], "{told}");
        }
    }
}

#[test]
fn samples_that_no_converter_of_the_radar_gives_are_refused_with_what_is_to_be_done() {
    let (place, steps) = in_steps();
    let word = |part: f32| (part * steps) as i16;
    changed(&place, "words.npy", |_, part| f32::from(word(part).cast_unsigned()));
    changed(&place, "signed.npy", |_, part| f32::from(word(part)));
    changed(&place, "real.npy", |index, part| if index % 2 == 0 { part } else { 0.0 });
    for (command, told) in [
        ("import words.npy", "words.npy: samples are whole numbers from 0 to 65"),
        ("import words.npy", "are these words without sign? cast them to int16"),
        ("import words.npy --full-scale 32768", "(0, 0, 0, "),
        ("import words.npy --full-scale 32768", "a part is beyond the full scale of 32768"),
        ("import signed.npy --full-scale 100", "a part is beyond the full scale of 100"),
        ("import real.npy", "real samples are those of a scene with sampling = \"real\" in [radar.receiver]"),
    ] {
        let output = place.try_run(&format!("{command} --scene small.toml --out b.cube"));
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{command}: {error}");
        assert!(error.contains(told) && !place.path("b.cube").exists(), "{command}: {error}");
    }
    place.run("import signed.npy --full-scale 900 --scene small.toml --out b.cube --quiet");
    let real =
        crate::common::SMALL_SCENE.replace("[noise]", "[radar.receiver]\nsampling = \"real\"\n\n[noise]");
    std::fs::write(place.path("real.toml"), real).unwrap();
    place.run("import real.npy --scene real.toml --out b.cube --quiet");
}

#[test]
fn a_recording_by_a_scene_without_noise_has_its_level_taken_from_the_map_and_an_echo_says_what_it_lacks() {
    let place = Workplace::new();
    let quiet = crate::common::SMALL_SCENE.replace("[noise]\nnoise_figure_db = 12.0\n", "");
    std::fs::write(place.path("quiet.toml"), quiet).unwrap();
    place.run("echo small.toml --out a.cube --quiet");
    place.run("export a.cube --to dca1000 --out a.bin --quiet");
    std::fs::remove_file(place.path("a.bin.json")).unwrap();
    let told = "there is no noise: a floor 60 dB below the map's peak stands for it";
    let found = |scene: &str, step: &str| {
        place.run(&format!("import a.bin --scene {scene} {step} --out b.cube --quiet"));
        place.run("dsp b.cube --out d --quiet")
    };
    assert_eq!(found("quiet.toml", ""), found("small.toml", ""));
    assert!(!found("quiet.toml", "").contains(told));
    // Of powers nobody knows whether they were recorded.
    assert!(found("quiet.toml", "--step 1e-9").contains(told));
    assert!(place.run("inspect d/b.rdm").contains(told));
    place.run("echo quiet.toml --out q.cube --quiet");
    assert!(place.run("dsp q.cube --out d --quiet").contains(told));
    assert!(place.run("run quiet.toml --out out --quiet").contains(told));
    assert_eq!(place.summary("out/summary.json")["radar"]["has_noise"], false);
    assert!(!place.run("run small.toml --out out --quiet").contains(told));
    // Settings of another scene leave a cube's noise as it is.
    for (cube, scene, is_passed_over) in [("q", "small", true), ("q", "quiet", false), ("a", "small", false)]
    {
        let output = place.try_run(&format!("dsp {cube}.cube --scene {scene}.toml --out d"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let passed_over = format!("{scene}.toml: [noise] is passed over");
        assert_eq!(said.contains(&passed_over), is_passed_over, "{cube}.cube, {scene}.toml: {said}");
    }
}

#[test]
fn a_recording_with_other_words_between_its_samples_is_refused_by_the_command_that_had_them_sent() {
    let place = Workplace::new();
    std::fs::write(place.path("b.cfg"), format!("{BOARD}lvdsStreamCfg -1 1 1 0\n")).unwrap();
    std::fs::write(place.path("bare.toml"), "name = \"bare\"\n").unwrap();
    std::fs::write(place.path("x.bin"), vec![1; 4 * 8 * 64 * 4]).unwrap();
    let output = place.try_run("import x.bin --scene bare.toml --config b.cfg --device xwr1443 --out x.cube");
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    let told = "b.cfg:6: lvdsStreamCfg: a recording has a header for each chirp between its samples";
    assert!(output.status.code() == Some(1) && error.contains(told), "{error}");
    assert!(!place.path("x.cube").exists());
    // The radar is as it says all the same.
    place.run("scene-from b.cfg --device xwr1443 --out b.toml --quiet");
    std::fs::write(place.path("b.cfg"), BOARD).unwrap();
    let output = place.try_run("import x.bin --scene bare.toml --config b.cfg --device xwr1443 --out x.cube");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && !said.contains("tells the shape of a frame"), "{said}");
}
