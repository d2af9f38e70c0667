//! Range–azimuth–Doppler tensors in the layout of RADDet become samples whose map is the tensor's.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::{SMALL_SCENE, Workplace};
use ndarray::{Array3, Array4, ArrayD};
use ndarray_npy::{ReadNpyExt, WriteNpyExt};
use num_complex::Complex32;
use std::f32::consts::PI;
use std::fs::File;

/// The small scene before another array, and the same with rectangular windows as `rect.toml`.
fn before(array: &str) -> Workplace {
    let place = Workplace::new();
    let scene = SMALL_SCENE.replace("preset = \"1x4\"", array);
    std::fs::write(place.path("small.toml"), &scene).unwrap();
    let windows = "[dsp]\nrange_window = \"rect\"\ndoppler_window = \"rect\"";
    std::fs::write(place.path("rect.toml"), scene.replace("[dsp]", windows)).unwrap();
    place
}

fn array(place: &Workplace, name: &str) -> ArrayD<Complex32> {
    ArrayD::read_npy(File::open(place.path(name)).unwrap()).unwrap()
}

/// Largest difference of two arrays that are alike up to a factor, relative to the largest value.
fn difference(a: &ArrayD<Complex32>, b: &ArrayD<Complex32>) -> f32 {
    assert_eq!(a.shape(), b.shape());
    let size = |values: &ArrayD<Complex32>| values.iter().map(|x| x.norm()).fold(0.0, f32::max);
    let (of_a, of_b) = (size(a), size(b));
    a.iter().zip(b).map(|(x, y)| (x / of_a - y / of_b).norm()).fold(0.0, f32::max)
}

#[test]
fn maps_through_tensors_are_the_same_maps() {
    let in_turn = "multiplexing = \"tdm\"\ntx_half_wavelengths = [[0, 0], [4, 0]]\n\
                   rx_half_wavelengths = [[0, 0], [1, 0], [2, 0], [3, 0]]";
    for layout in ["preset = \"1x4\"", in_turn] {
        let place = before(layout);
        place.run("run small.toml --out run --no-cache --quiet");
        place.run("export run/frames.rdm --to npy --out a.npy --quiet");
        place.run("export run/frames.rdm --to raddet --out set --quiet");
        place.run("import set/RAD/part1 --scene rect.toml --out b.cube --quiet");
        place.run("dsp b.cube --out again --quiet");
        place.run("export again/b.rdm --to npy --out b.npy --quiet");
        let worst = difference(&array(&place, "a.npy"), &array(&place, "b.npy"));
        assert!(worst < 1e-5, "{layout}: {worst}");
    }
}

/// One echo among noise, in the cells that the set's description gives it.
#[test]
fn an_echo_of_a_tensor_is_a_point_in_its_cells() {
    let place = before("preset = \"1x4\"");
    let noise = |i: usize| 0.01 * Complex32::from_polar(1.0, (i * i % 1009) as f32);
    let (far_first, sine, doppler) = (63 - 20, 0.25, 11);
    let tensor = Array3::from_shape_fn((64, 256, 16), |(range, azimuth, row)| {
        let is_echo = (range, row) == (far_first, doppler);
        let channel = |place: usize| {
            let own = noise(((range * 16 + row) * 4 + place) * 7 + 1);
            own + if is_echo {
                Complex32::from_polar(1.0, -PI * place as f32 * sine)
            } else {
                Complex32::ZERO
            }
        };
        let u = 2.0 * azimuth as f32 / 256.0 - 1.0;
        (0..4)
            .map(|place| channel(place) * Complex32::from_polar(1.0, PI * place as f32 * u))
            .sum::<Complex32>()
    });
    tensor.write_npy(File::create(place.path("t.npy")).unwrap()).unwrap();
    let output = place.try_run("import t.npy --scene rect.toml --out t.cube");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && said.contains("a tensor tells no factor"), "{said}");
    place.run("dsp t.cube --out seen --quiet");
    place.run("export seen/t.points --to csv --out p.csv --quiet");
    place.run("export seen/t.rdm --to raddet --out set --quiet");
    let worst = difference(&array(&place, "set/RAD/part1/000000.npy"), &tensor.into_dyn());
    assert!(worst < 1e-5, "{worst}");
    let text = String::from_utf8(place.bytes("p.csv")).unwrap();
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let strongest = text.lines().nth(1).unwrap();
    let value = |name: &str| {
        let at = names.iter().position(|column| *column == name).unwrap();
        strongest.split(',').nth(at).unwrap().parse::<f64>().unwrap()
    };
    let told = place.summary("set/set.json");
    let axis = |name: &str, at: usize| told["axes"][name][at].as_f64().unwrap();
    // The range is free of its coupling with Doppler, 0.1 m here.
    assert!((value("range_m") - axis("range_m", far_first)).abs() < 0.15, "{strongest}");
    assert!((value("radial_velocity_mps") - axis("velocity_mps", doppler)).abs() < 0.05, "{strongest}");
    // The row tells the cone's angle; the azimuth is that at the assumed height.
    let [az, el] = ["az_deg", "el_deg"].map(|name| value(name).to_radians());
    assert!((az.sin() * el.cos() - f64::from(sine)).abs() < 0.01, "{strongest}");
}

#[test]
fn tensors_of_other_sizes_arrays_and_kinds_are_refused() {
    let place = before("preset = \"1x4\"");
    let write = |name: &str, shape: (usize, usize, usize)| {
        Array3::<Complex32>::zeros(shape).write_npy(File::create(place.path(name)).unwrap()).unwrap();
    };
    write("t.npy", (64, 256, 16));
    write("small.npy", (32, 256, 16));
    std::fs::create_dir(place.path("mixed")).unwrap();
    write("mixed/a.npy", (64, 256, 16));
    let samples = Array4::<Complex32>::zeros((1, 4, 16, 64));
    samples.write_npy(File::create(place.path("mixed/b.npy")).unwrap()).unwrap();
    let scene = |name: &str, of: &str, to: &str| {
        std::fs::write(place.path(name), SMALL_SCENE.replace(of, to)).unwrap();
    };
    scene("rows.toml", "preset = \"1x4\"", "preset = \"6x8\"");
    scene("codes.toml", "preset = \"1x4\"", "preset = \"3x4\"\nmultiplexing = \"ddm\"");
    let real = "[radar.receiver]\nsampling = \"real\"\n[radar.waveform]\nsamples = 128";
    scene("real.toml", "[radar.waveform]\nsamples = 64", real);
    for (words, told) in [
        ("small.npy --scene small.toml", "small.npy: [range, azimuth, Doppler] is [32, 256, 16]"),
        ("t.npy --scene rows.toml", "t.npy: an angle spectrum tells the channels of one row alone"),
        ("t.npy --scene codes.toml", "multiplexing tdm"),
        ("t.npy --scene real.toml", "t.npy: samples follow from maps of complex samples"),
        ("t.npy --scene small.toml --full-scale 3", "--full-scale is for samples in steps"),
        ("mixed --scene small.toml", "b.npy: has 4 axes"),
    ] {
        let output = place.try_run(&format!("import {words} --out x.cube"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && said.contains(told), "{words}: {said}");
        assert!(!place.path("x.cube").exists(), "{words}");
    }
}
