//! Scenes with random radars, vehicles, clutter and traffic, drawn from a seed, for studies and benchmarks
//! over many scenes.

use artifact::settings::Class;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scene::vehicles;
use std::fmt::Write as _;
use std::path::Path;

/// A vehicle's model as named in a scene, and its class.
pub(crate) type VehicleModel<'a> = (&'a str, &'a str);

/// Adds the tables of every scene. Cheap choices are drawn more often, here and below.
pub(crate) fn radar(rng: &mut SceneRng, text: &mut String) {
    let preset = rng.choose(&["1x1", "1x1", "3x4", "3x4", "3x4", "3x4", "12x16"]);
    let chirps = rng.choose(&[32, 64, 128, 128]);
    let samples = if preset == "12x16" { rng.choose(&[128, 256]) } else { rng.choose(&[128, 256, 256, 512]) };
    let multiplexing = rng.choose(&["simultaneous", "simultaneous", "tdm"]);
    // Twelve transmitters in turn take longer than the frame interval.
    let multiplexing = if preset == "12x16" { "simultaneous" } else { multiplexing };
    let _ = write!(
        text,
        "[radar]\nboresight_el_deg = -8.0\n[radar.waveform]\nchirps = {chirps}\nsamples = {samples}\n[radar.array]\n\
         preset = \"{preset}\"\nmultiplexing = \"{multiplexing}\"\n[noise]\nnoise_figure_db = 12.0\n"
    );
    let detector = rng.choose(&["ca-cfar", "ca-cfar", "os-cfar"]);
    let angle = rng.choose(&["fft", "fft", "fft", "max-likelihood"]);
    let _ = write!(text, "[dsp]\ndetector = \"{detector}\"\nangle = \"{angle}\"\n");
}

/// Adds a kerb, a guard rail, a pole or a sign.
pub(crate) fn clutter(rng: &mut SceneRng, text: &mut String) {
    let y_m = rng.between(15.0, 50.0);
    let kind = rng.choose(&["kerb", "guard-rail", "pole", "sign"]);
    let size = match kind {
        "kerb" => format!("length_m = {:.1}\n", rng.between(3.0, 15.0)),
        "guard-rail" => format!("length_m = {:.1}\n", rng.between(2.0, 8.0)),
        _ => String::new(),
    };
    let _ = write!(
        text,
        "[[clutter]]\nid = \"piece\"\nmodel = \"{kind}\"\nposition_m = [13.0, {y_m:.2}, 0.0]\n{size}"
    );
}

/// Adds some tenths of a second of the project's own junction, with these lines of `[fidelity]`.
pub(crate) fn traffic(rng: &mut SceneRng, root: &Path, fidelity: &str, text: &mut String) {
    let begin_s = f64::from(rng.below(580)) / 10.0;
    let frames = rng.choose(&[1, 1, 1, 2]);
    radar(rng, text);
    let view_range_m = rng.between(28.0, 40.0);
    let _ = write!(
        text,
        "[fidelity]\n{fidelity}measured_every = {}\n[traffic]\nfcd = {:?}\nbegin_s = {begin_s:.1}\n\
         end_s = {:.1}\nview_nearest_m = 12.0\nview_range_m = {view_range_m:.1}\nview_half_angle_deg = 30.0\n\
         models = {{ car = [\"car-sedan\", \"car-hatchback\"], bus = \"bus-city\", truck = \"truck-box\", motorcycle = \
         \"motorcycle-street\" }}\n",
        rng.choose(&[1, 10]),
        root.join("fixtures/junction.fcd.xml.gz"),
        begin_s + 0.1 * f64::from(frames - 1),
    );
}

/// Random numbers of a seed.
pub(crate) struct SceneRng(ChaCha8Rng);

impl SceneRng {
    /// Random numbers for a purpose and a case of a seed.
    pub(crate) fn new(seed: u64, purpose: &str, number: u64) -> Self {
        Self(ChaCha8Rng::from_seed(artifact::seed::key(seed, purpose, &[number])))
    }

    pub(crate) fn chance(&mut self, share: f64) -> bool {
        self.0.random_bool(share)
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    /// A whole number from 0 to `end` − 1.
    pub(crate) fn below(&mut self, end: u32) -> u32 {
        self.0.random_range(0..end)
    }

    /// One of the project's own vehicles.
    pub(crate) fn own_vehicle(&mut self) -> VehicleModel<'static> {
        let name = self.choose(&vehicles::NAMES);
        (name, vehicles::class_of(name).map_or("", Class::name))
    }

    pub(crate) fn choose<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.0.random_range(0..choices.len())]
    }
}
