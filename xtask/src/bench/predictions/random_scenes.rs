//! Scenes drawn from a seed: what a radar at a junction may be asked, from one car at rest to a queue under
//! the mast.

use crate::bench::predictions::timed_scene::{Text, TimedScene};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::fmt::Write as _;
use std::path::Path;

const VEHICLES: [(&str, &str); 12] = [
    ("car-suv", "car"),
    ("car-sedan", "car"),
    ("car-hatchback", "car"),
    ("bus-city", "bus"),
    ("bus-coach", "bus"),
    ("bus-mini", "bus"),
    ("truck-box", "truck"),
    ("truck-tanker", "truck"),
    ("truck-semi", "truck"),
    ("motorcycle-street", "motorcycle"),
    ("motorcycle-scooter", "motorcycle"),
    ("motorcycle-touring", "motorcycle"),
];

/// Scene `number` of a seed; `root` holds `scenes` and `fixtures`.
pub(super) fn scene(seed: u64, number: u64, root: &Path) -> TimedScene {
    let mut draw = Draw(ChaCha8Rng::from_seed(artifact::seed::key(seed, "xtask/predictions", &[number])));
    let name = format!("random-{seed}-{number:03}");
    let mut text = format!("name = \"{name}\"\nseed = {}\n", number + 1);
    if draw.chance(0.1) {
        traffic(&mut draw, root, &mut text);
    } else {
        bodies(&mut draw, root, &mut text);
    }
    let threads = draw.chance(0.5).then_some(1);
    TimedScene { name, text: Text::Drawn(text), threads }
}

/// The tables that every scene has. What costs little is drawn more often, here and below.
fn radar(draw: &mut Draw, text: &mut String) {
    let preset = draw.one_of(&["1x1", "1x1", "3x4", "3x4", "3x4", "3x4", "12x16"]);
    let chirps = draw.one_of(&[32, 64, 128, 128]);
    let samples =
        if preset == "12x16" { draw.one_of(&[128, 256]) } else { draw.one_of(&[128, 256, 256, 512]) };
    let multiplexing = draw.one_of(&["simultaneous", "simultaneous", "tdm"]);
    // Twelve transmitters in turn take longer than from one frame to the next.
    let multiplexing = if preset == "12x16" { "simultaneous" } else { multiplexing };
    let _ = write!(
        text,
        "[radar]\nboresight_el_deg = -8.0\n[radar.waveform]\nchirps = {chirps}\nsamples = {samples}\n[radar.array]\n\
         preset = \"{preset}\"\nmultiplexing = \"{multiplexing}\"\n[noise]\nnoise_figure_db = 12.0\n"
    );
    let detector = draw.one_of(&["ca-cfar", "ca-cfar", "os-cfar"]);
    let angle = draw.one_of(&["fft", "fft", "fft", "max-likelihood"]);
    let _ = write!(text, "[dsp]\ndetector = \"{detector}\"\nangle = \"{angle}\"\n");
}

fn bodies(draw: &mut Draw, root: &Path, text: &mut String) {
    let count = draw.one_of(&[1, 1, 1, 1, 1, 2, 2, 2, 3, 4, 6]);
    // Many vehicles stand in few frames, and are asked for less.
    let frames =
        if count < 3 { draw.one_of(&[1, 1, 1, 1, 1, 1, 2, 3, 5]) } else { draw.one_of(&[1, 1, 1, 2]) };
    let _ = writeln!(text, "frames = {frames}");
    radar(draw, text);
    let bounces = if count < 4 { draw.one_of(&[1, 1, 2, 3]) } else { draw.one_of(&[1, 1, 2]) };
    let finest_db = [-30.0, -24.0, -18.0][(count - 1).min(2)];
    let accuracy_db =
        (10.0 * draw.between(finest_db, -10.0).max(draw.between(finest_db, -10.0))).round() / 10.0;
    let measured_every = draw.one_of(&[1, 2, 5]);
    let _ = write!(
        text,
        "[fidelity]\naccuracy_db = {accuracy_db}\nbounces = {bounces}\nmeasured_every = {measured_every}\n"
    );
    variants(draw, root, text);
    let mut lanes_m = [0.0; 3];
    for number in 0..count {
        vehicle(draw, number, &mut lanes_m, text);
    }
    if draw.chance(0.2) {
        clutter(draw, text);
    }
}

/// Settings beside the usual ones, and the road.
fn variants(draw: &mut Draw, root: &Path, text: &mut String) {
    if draw.chance(0.15) {
        let _ = writeln!(text, "materials = {:?}", root.join("scenes/vehicles.materials.toml"));
    }
    if draw.chance(0.06) {
        text.push_str("edges = \"on\"\n");
    }
    if draw.chance(0.06) {
        text.push_str("surface = \"smooth\"\n");
    }
    // A table knows neither paths nor the road nor its floor.
    if draw.chance(0.05) {
        text.push_str("echo = \"rcs-table\"\n");
        return;
    }
    if draw.chance(0.06) {
        text.push_str("detail = \"auto\"\n");
    }
    match draw.0.random_range(0..20) {
        0 => text.push_str("[road]\n"),
        1..=3 => text.push_str("[road]\nmirror = \"off\"\nbackscatter = \"floor\"\n"),
        _ => {}
    }
}

/// Adds a vehicle in a lane, mostly 12 to 80 m away; now and then right under the mast. `lanes_m` holds where
/// each lane's first vehicle stands.
fn vehicle(draw: &mut Draw, number: usize, lanes_m: &mut [f64; 3], text: &mut String) {
    let (model, class) = draw.one_of(&VEHICLES);
    let first_m = &mut lanes_m[number % 3];
    let y_m = match number {
        // 20 m and more before or behind the first of its lane.
        3.. if *first_m < 46.0 => draw.between(*first_m + 20.0, 80.0),
        3.. => draw.between(12.0, *first_m - 20.0),
        _ if draw.chance(0.05) => draw.between(-2.0, 8.0),
        _ => draw.between(12.0, 80.0),
    };
    *first_m = y_m;
    let velocity_mps = if draw.chance(0.25) { 0.0 } else { draw.between(-15.0, 5.0) };
    let _ = write!(
        text,
        "[[target]]\nkind = \"mesh\"\nid = \"body-{number}\"\nclass = \"{class}\"\nmodel = \"{model}\"\nlane = {}\n\
         y_m = {y_m:.2}\nvelocity_mps = [0.0, {velocity_mps:.2}, 0.0]\nyaw_deg = -90.0\n",
        number % 3 + 1
    );
}

fn clutter(draw: &mut Draw, text: &mut String) {
    let y_m = draw.between(15.0, 50.0);
    let kind = draw.one_of(&["kerb", "guard-rail", "pole", "sign"]);
    let size = match kind {
        "kerb" => format!("length_m = {:.1}\n", draw.between(3.0, 15.0)),
        "guard-rail" => format!("length_m = {:.1}\n", draw.between(2.0, 8.0)),
        _ => String::new(),
    };
    let _ = write!(
        text,
        "[[clutter]]\nid = \"piece\"\nmodel = \"{kind}\"\nposition_m = [13.0, {y_m:.2}, 0.0]\n{size}"
    );
}

/// Some tenths of a second of the project's own junction.
fn traffic(draw: &mut Draw, root: &Path, text: &mut String) {
    let begin_s = draw.0.random_range(0..580) as f64 / 10.0;
    let frames = draw.one_of(&[1, 1, 1, 2]);
    radar(draw, text);
    let view_range_m = draw.between(28.0, 40.0);
    let _ = write!(
        text,
        "[fidelity]\naccuracy_db = -10.0\nbounces = 1\nmeasured_every = {}\n[traffic]\nfcd = {:?}\nbegin_s = {begin_s:.1}\n\
         end_s = {:.1}\nview_nearest_m = 12.0\nview_range_m = {view_range_m:.1}\nview_half_angle_deg = 30.0\n\
         models = {{ car = [\"car-sedan\", \"car-hatchback\"], bus = \"bus-city\", truck = \"truck-box\", motorcycle = \
         \"motorcycle-street\" }}\n",
        draw.one_of(&[1, 10]),
        root.join("fixtures/junction.fcd.xml.gz"),
        begin_s + 0.1 * f64::from(frames - 1),
    );
}

struct Draw(ChaCha8Rng);

impl Draw {
    fn chance(&mut self, share: f64) -> bool {
        self.0.random_bool(share)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.0.random_range(0..choices.len())]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{Meshes, ReadOptions};

    #[test]
    fn scenes_drawn_are_scenes_that_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        for number in 0..60 {
            let drawn = scene(9, number, root);
            let file = folder.path().join("random.toml");
            let Text::Drawn(text) = &drawn.text else { panic!("{} is no file", drawn.name) };
            std::fs::write(&file, text).unwrap();
            let options = ReadOptions { model: None, radar: None, meshes: Meshes::NamesOnly };
            let read = scene::read(&file, &options).unwrap_or_else(|e| panic!("{}: {e}\n{text}", drawn.name));
            assert_eq!(read.name, drawn.name);
        }
    }
}
