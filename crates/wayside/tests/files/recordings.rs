//! Samples of other units and other radars: what they were stays, what contradicts the scene is refused.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::{SMALL_SCENE, Workplace};
use ndarray::Array4;
use ndarray_npy::WriteNpyExt;
use num_complex::Complex32;

/// The small scene, and samples of it with these parts, over and over, as `x.npy`.
fn with_parts(parts: &[f32]) -> Workplace {
    let place = Workplace::new();
    let mut parts = parts.iter().copied().cycle();
    let mut part = || parts.next().unwrap();
    let samples = Array4::from_shape_simple_fn((1, 4, 16, 64), || Complex32::new(part(), part()));
    samples.write_npy(std::fs::File::create(place.path("x.npy")).unwrap()).unwrap();
    place
}

fn floats(place: &Workplace, name: &str) -> Vec<f32> {
    let bytes = place.bytes(name);
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    bytes[start..].as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect()
}

#[test]
fn samples_that_were_no_steps_take_most_of_the_converters_range_and_come_back_in_their_full_scale() {
    let place = with_parts(&[0.7, -0.1, 0.33, 0.0, -0.65]);
    place.run("import x.npy --scene small.toml --full-scale 1 --out a.cube --quiet");
    place.run("export a.cube --to dca1000 --out x.bin --quiet");
    let bytes = place.bytes("x.bin");
    let most = bytes.as_chunks::<2>().0.iter().map(|b| i16::from_le_bytes(*b)).max();
    assert_eq!(most, Some(32_000));
    let told = place.summary("x.bin.json");
    assert!(told["sqrt_w_per_step"].is_null() && told["full_scale"] == 1.0, "{told}");
    let step = told["adc_steps_per_step"].as_f64().unwrap();
    assert!((step - 0.7 / 32e3).abs() < 1e-11, "{step}");
    place.run("import x.bin --scene small.toml --out b.cube");
    place.run("export b.cube --to npy --out b.npy --quiet");
    assert_eq!(place.summary("b.npy.json")["full_scale"], 1.0);
    let pairs = floats(&place, "x.npy").into_iter().zip(floats(&place, "b.npy"));
    let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(f64::from(worst) <= 0.505 * step, "{worst}");
    let output = place.try_run("import x.bin --scene small.toml --full-scale 2 --out c.cube");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && said.contains("x.bin.json has a full scale of 1 steps"), "{said}");
}

#[test]
fn samples_that_were_steps_stay_what_they_were_up_to_the_least_integer_of_16_bits() {
    let place = with_parts(&[-32768.0, 32767.0, 5.0]);
    for words in ["", "--full-scale 32768"] {
        place.run(&format!("import x.npy --scene small.toml {words} --out a.cube --quiet"));
        place.run("export a.cube --to dca1000 --out x.bin --quiet");
        assert_eq!(place.summary("x.bin.json")["adc_steps_per_step"], 1.0);
        place.run("import x.bin --scene small.toml --out b.cube --quiet");
        place.run("export b.cube --to npy --out b.npy --quiet");
        assert_eq!(floats(&place, "x.npy"), floats(&place, "b.npy"));
    }
}

/// Whole numbers would be steps of a converter if nothing told of them.
#[test]
fn arrays_and_recordings_of_our_own_come_back_in_the_unit_that_stands_beside_them() {
    let place = with_parts(&[-3.0, 700.0, 5.0]);
    let other = SMALL_SCENE.replace("samples = 64", "samples = 64\nslope_mhz_per_us = 6.25");
    std::fs::write(place.path("other.toml"), other).unwrap();
    for (words, unit) in [("--full-scale 1024", "dBFS"), ("", "dB of ADC steps")] {
        place.run(&format!("import x.npy --scene small.toml {words} --out a.cube --quiet"));
        for (to, out, from) in [
            ("npy", "y.npy", "y.npy"),
            ("sigmf", "y", "y.sigmf-meta"),
            ("uwcr", "set", "set/radar_raw_frame/000000.mat"),
        ] {
            place.run(&format!("export a.cube --to {to} --out {out} --quiet"));
            let output = place.try_run(&format!("import {from} --scene small.toml --out b.cube"));
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.success() && !said.contains("whole numbers"), "{from}: {said}");
            let told = place.run("inspect b.cube");
            let units = ["dB of ADC steps", "dBFS", "dBW"].into_iter().filter(|unit| told.contains(unit));
            assert_eq!(units.collect::<Vec<_>>(), [unit], "{from}: {told}");
            refused(
                &place,
                &format!("import {from} --scene other.toml --out z.cube"),
                "the scene's radar has 6",
            );
        }
        std::fs::remove_dir_all(place.path("set")).unwrap();
    }
    place.run("import x.npy --scene small.toml --full-scale 1024 --out a.cube --quiet");
    place.run("export a.cube --to npy --out y.npy --quiet");
    refused(
        &place,
        "import y.npy --scene small.toml --full-scale 2048 --out z.cube",
        "y.npy.json has a full scale of 1024 steps",
    );
}

#[test]
fn floats_are_said_to_be_taken_for_steps_where_nobody_tells_their_unit_alone() {
    let place = with_parts(&[-3.0, 700.0, 5.0]);
    for (words, is_said) in [("", true), ("--full-scale 1024", false)] {
        let output = place.try_run(&format!("import x.npy --scene small.toml {words} --out a.cube"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.success() && said.contains("all samples are whole numbers") == is_said,
            "{said}"
        );
    }
}

fn refused(place: &Workplace, command: &str, told: &str) {
    let output = place.try_run(command);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && said.contains(told), "{command}: {said}");
    assert!(!place.path("z.cube").exists(), "{command}");
}

#[test]
fn descriptions_that_contradict_the_scene_are_refused_by_key_with_both_values() {
    let place = with_parts(&[0.5, -0.25]);
    place.run("import x.npy --scene small.toml --out a.cube --quiet");
    place.run("export a.cube --to dca1000 --out x.bin --quiet");
    let other = SMALL_SCENE.replace("samples = 64", "samples = 64\nsample_rate_msps = 2.5");
    std::fs::write(place.path("other.toml"), other).unwrap();
    refused(&place, "import x.bin --scene other.toml --out z.cube", "x.bin.json: sample_rate_hz is");
    place.run("export a.cube --to sigmf --out x --quiet");
    refused(
        &place,
        "import x.sigmf-meta --scene other.toml --out z.cube",
        "x.sigmf-meta: core:sample_rate is",
    );
    let meta = String::from_utf8(place.bytes("x.sigmf-meta")).unwrap();
    for (key, value, told) in [
        ("core:sample_rate", "2.5e6", "core:sample_rate is 2500000.0, the scene's radar has"),
        ("wayside:slope_hz_per_s", "1e12", "wayside:slope_hz_per_s is 1000000000000.0"),
        ("wayside:start_frequency_hz", "60e9", "wayside:start_frequency_hz is"),
        ("wayside:chirps", "32", "wayside:chirps is 32.0, the scene's radar has 16.0"),
        ("wayside:samples", "32", "wayside:samples is 32.0, the scene's radar has 64.0"),
        ("core:metadata_only", "true", "core:metadata_only is true"),
        ("core:dataset", "\"y.bin\"", "core:dataset is \"y.bin\""),
        ("core:trailing_bytes", "64", "core:trailing_bytes is 64"),
    ] {
        let mut told_of: serde_json::Value = serde_json::from_str(&meta).unwrap();
        told_of["global"][key] = serde_json::from_str(value).unwrap();
        std::fs::write(place.path("x.sigmf-meta"), told_of.to_string()).unwrap();
        refused(&place, "import x.sigmf-meta --scene small.toml --out z.cube", told);
    }
    let mut told_of: serde_json::Value = serde_json::from_str(&meta).unwrap();
    told_of["captures"][0]["core:header_bytes"] = 64.into();
    std::fs::write(place.path("x.sigmf-meta"), told_of.to_string()).unwrap();
    refused(&place, "import x.sigmf-meta --scene small.toml --out z.cube", "core:header_bytes is 64");
}

#[test]
fn complex_samples_of_a_radar_that_samples_the_in_phase_part_alone_are_refused() {
    let place = with_parts(&[0.5, -0.25]);
    let real = format!("{SMALL_SCENE}\n[radar.receiver]\nsampling = \"real\"\n");
    std::fs::write(place.path("real.toml"), real).unwrap();
    refused(&place, "import x.npy --scene real.toml --out z.cube", "x.npy: 0.5-0.25i at [frame");
    refused(&place, "import x.npy --scene real.toml --out z.cube", "sampling = \"real\"");
}
