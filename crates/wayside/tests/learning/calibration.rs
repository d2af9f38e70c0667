//! An array whose elements err by what the seed draws, measured on a reflector, and right once its file is
//! named.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::Workplace;

const REFLECTOR: &str = r#"
name = "reflector"
seed = 5
frames = 2
[radar.waveform]
samples = 128
chirps = 16
[radar.array]
preset = "3x4"
multiplexing = "bpm"
gain_spread_db = 3.0
phase_spread_deg = 30.0
[noise]
noise_figure_db = 12.0
[dsp]
training_cells = [3, 6]
[[target]]
kind = "point"
id = "corner"
rcs_m2 = 1000.0
position_m = [2.0, 25.0, 1.0]
"#;

/// Azimuth of the strongest point, degrees.
fn azimuth_deg(place: &Workplace, cube: &str, scene: &str) -> f64 {
    place.run(&format!("dsp {cube}.cube --scene {scene} --out {cube} --quiet"));
    place.run(&format!("export {cube}/{cube}.points --to csv --out {cube}.csv --quiet"));
    let table = String::from_utf8(place.bytes(&format!("{cube}.csv"))).unwrap();
    let mut lines = table.lines();
    let column = lines.next().unwrap().split(',').position(|name| name == "az_deg").unwrap();
    lines.next().unwrap().split(',').nth(column).unwrap().parse().unwrap()
}

#[test]
fn a_seed_draws_the_elements_errors_and_a_measured_calibration_undoes_them() {
    let place = Workplace::new();
    let elsewhere = REFLECTOR.replace("[2.0, 25.0, 1.0]", "[-8.0, 30.0, 0.75]").replace("1000.0", "100.0");
    std::fs::write(place.path("corner.toml"), REFLECTOR).unwrap();
    std::fs::write(place.path("target.toml"), &elsewhere).unwrap();
    let known = elsewhere.replace("[dsp]\n", "[dsp]\ncalibration = \"errors.csv\"\n");
    place.run("echo corner.toml --out corner.cube --quiet");
    let said = place.run("calibrate corner.cube --at-m 2,25,1 --out errors.csv");
    println!("{said}");
    assert!(said.starts_with("12 channels of 2 frames"));
    std::fs::write(place.path("known.toml"), &known).unwrap();
    place.run("echo target.toml --out target.cube --quiet");
    let [before, after] = ["target.toml", "known.toml"].map(|scene| azimuth_deg(&place, "target", scene));
    let truth = (-8.0_f64).atan2(30.0).to_degrees();
    println!("azimuth {truth:.3}°: {before:.3}° before, {after:.3}° after");
    // 40 dB and more over the noise of the virtual array's channels: 0.1° of a beam of 10°, and the assumed
    // height's 0.1°.
    assert!((after - truth).abs() < 0.2 && (before - truth).abs() > 3.0 * (after - truth).abs());

    // Another seed has another array, which the summary tells; without spread there is none to tell.
    let other = |seed: u32| {
        place.run(&format!("run target.toml --out out-{seed} --seed {seed} --quiet"));
        place.summary(&format!("out-{seed}/summary.json"))["radar"]["element_errors"]["tx"][2]["phase_deg"]
            .clone()
    };
    assert!(other(5).is_f64() && other(5) == other(5) && other(5) != other(6));
    std::fs::write(place.path("small.csv"), "tx,rx,gain_db,phase_deg\n0,0,0,0\n").unwrap();
    std::fs::write(place.path("short.toml"), known.replace("errors.csv", "small.csv")).unwrap();
    let refused = place.try_run("dsp target.cube --scene short.toml --out x --quiet");
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(1) && said.contains("the pair 0,1 is missing"), "{said}");
}
