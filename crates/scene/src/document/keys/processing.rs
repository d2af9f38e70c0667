//! `[noise]` and `[dsp]`.

use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Choice, ChoiceOrPattern, IntegerVector, Number, Text};
use crate::wording::allowed_range::AllowedRange::{Above, Between};
use artifact::settings::{Angle, Detector, FALSE_ALARM_RATES, Refine, StaticEchoes, Window};

const CELLS: IntegerVector<2> = IntegerVector(Between(0.0, 65536.0));

const WINDOWS: ChoiceOrPattern<Window> = ChoiceOrPattern {
    words: Choice(|| {
        vec![
            ("rect", Window::Rect),
            ("hann", Window::Hann),
            ("hamming", Window::Hamming),
            ("blackman", Window::Blackman),
            ("chebyshev-80", Window::Chebyshev(80.0)),
        ]
    }),
    built: chebyshev,
    others: " or another level from 20 to 200 dB",
    pattern: "^chebyshev-",
};

/// Parses `chebyshev-80`: sidelobes from 20 dB down, hardly a taper, to 200 dB, the limit of f64.
fn chebyshev(name: &str) -> Option<Window> {
    let level_db: f64 = name.strip_prefix("chebyshev-")?.parse().ok()?;
    (20.0..=200.0).contains(&level_db).then_some(Window::Chebyshev(level_db))
}

pub(crate) const NOISE: Table = Table {
    name: "noise",
    heading: "[noise]",
    about: "The receiver's noise; left out, there is none.",
    keys: &[&NOISE_FIGURE, &TEMPERATURE, &SNR],
};

pub(crate) const NOISE_FIGURE: Key<Number> = Key::new(
    "noise_figure_db",
    Number(Between(0.0, 100.0)),
    "dB: complex white noise of power k·T·F·sample rate per sample",
);

pub(crate) const TEMPERATURE: Key<Number, DefaultValue<f64>> =
    Key::new("temperature_k", Number(Above(0.0, 1e6)), "K, with `noise_figure_db`").with_default(290.0);

pub(crate) const SNR: Key<Number> = Key::new(
    "snr_db",
    Number(Between(-200.0, 200.0)),
    "dB: noise-free peak cell over mean noise power, one channel, windows as set",
);

pub(crate) const DSP: Table = Table {
    name: "dsp",
    heading: "[dsp]",
    about: "Signal processing: maps, detection, directions, objects.",
    keys: &[
        &RANGE_WINDOW,
        &DOPPLER_WINDOW,
        &DETECTOR,
        &FALSE_ALARM_RATE,
        &GUARD_CELLS,
        &TRAINING_CELLS,
        &ANGLE,
        &REFINE,
        &CALIBRATION,
        &STATIC,
        &NEAREST,
        &ASSUMED_HEIGHT,
        &CLUSTER,
        &CLUSTER_RANGE,
        &CLUSTER_VELOCITY,
        &CLUSTER_CROSS,
    ],
};

pub(crate) const RANGE_WINDOW: Key<ChoiceOrPattern<Window>, DefaultValue<Window>> =
    Key::new("range_window", WINDOWS, "taper over the samples of a chirp").with_default(Window::Hann);

pub(crate) const DOPPLER_WINDOW: Key<ChoiceOrPattern<Window>, DefaultValue<Window>> =
    Key::new("doppler_window", WINDOWS, "taper over chirps").with_default(Window::Hann).allowed("the same");

pub(crate) const DETECTOR: Key<Choice<Detector>, DefaultValue<Detector>> = Key::new(
    "detector",
    Choice(|| {
        vec![
            ("ca-cfar", Detector::CaCfar),
            ("go-cfar", Detector::GoCfar),
            ("so-cfar", Detector::SoCfar),
            ("os-cfar", Detector::OsCfar),
        ]
    }),
    "noise from the mean of the training cells; from the greater or the smaller mean of the halves before \
     and behind in range (along Doppler where training is [n, 0]); from the training cell of rank ¾N. \
     Every range cell has its own threshold",
)
.with_default(Detector::CaCfar);

pub(crate) const FALSE_ALARM_RATE: Key<Number, DefaultValue<f64>> = Key::new(
    "false_alarm_rate",
    Number(Between(*FALSE_ALARM_RATES.start(), *FALSE_ALARM_RATES.end())),
    "asked of every tested cell",
)
.with_default(1e-5);

pub(crate) const GUARD_CELLS: Key<IntegerVector<2>, DefaultValue<[u64; 2]>> =
    Key::new("guard_cells", CELLS, "[Doppler, range] cells on each side that stay out of the noise estimate")
        .with_default([2, 2]);

/// Training cells: 13 × 21 cells less 5 × 5 of guard: 248, a CFAR loss of about 0.1 dB at 1e-5 (Richards
/// 2014).
pub(crate) const TRAINING_CELLS: Key<IntegerVector<2>, DefaultValue<[u64; 2]>> =
    Key::new("training_cells", CELLS, "[Doppler, range] cells on each side, beyond the guard, that make it")
        .with_default([4, 8]);

pub(crate) const ANGLE: Key<Choice<Angle>, DefaultValue<Angle>> = Key::new(
    "angle",
    Choice(|| vec![("fft", Angle::Fft), ("max-likelihood", Angle::MaximumLikelihood)]),
    "one direction a cell, the strongest beam; or up to three echoes a cell, told apart from about a \
     third of a beam on, by maximum likelihood on the one snapshot, any array with or without elevation \
     rows: each is a point of its own ([validation/super-resolution.md](validation/super-resolution.md))",
)
.with_default(Angle::Fft);

pub(crate) const REFINE: Key<Choice<Refine>, DefaultValue<Refine>> = Key::new(
    "refine",
    Choice(|| vec![("off", Refine::Off), ("on", Refine::Isolated)]),
    "\"on\": peaks that stand alone (what others add stays within 0.4 dB of the bound, and nothing like a \
     second echo is left beside the fitted one) get range, velocity and direction by maximum likelihood \
     on the unwindowed samples, within 1 dB of the Cramér–Rao bound \
     ([validation/estimates.md](validation/estimates.md)). Needs the cube: `classify`, which reads maps \
     alone, keeps their peaks",
)
.with_default(Refine::Off);

pub(crate) const CALIBRATION: Key<Text> = Key::new(
    "calibration",
    Text("a file"),
    "gain and phase of each channel as measured, as below: directions (and the folds that they tell) are \
     found on values that are freed of them; detection and maps stay as they are",
);

pub(crate) const STATIC: Key<Choice<StaticEchoes>, DefaultValue<StaticEchoes>> = Key::new(
    "static",
    Choice(|| [StaticEchoes::Keep, StaticEchoes::Mark, StaticEchoes::Remove].map(|s| (s.name(), s)).to_vec()),
    "echoes at rest (ground, kerbs, rails; vehicles that wait): points and objects like others; the same, \
     told to be at rest; or left out before objects are formed, and waiting vehicles with them. At rest \
     is what is slower than half a Doppler cell and what its estimate errs by: \
     [decisions/static-echoes.md](decisions/static-echoes.md)",
)
.with_default(StaticEchoes::Keep);

pub(crate) const NEAREST: Key<Number, DefaultValue<f64>> = Key::new(
    "nearest_m",
    Number(Between(0.0, 1e6)),
    "m: nothing nearer is detected; a real radar hears its own transmitters there, in its first range cells. \
     Cells stay in the map, and in the noise estimate of those behind",
)
.with_default(0.0);

pub(crate) const ASSUMED_HEIGHT: Key<Number, DefaultValue<f64>> = Key::new(
    "assumed_height_m",
    Number(Between(-100.0, 100.0)),
    "m: height of points where the array has no elevation rows",
)
.with_default(0.75);

/// Distances within which detections can join one object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClusterReach {
    pub(crate) range_m: f64,
    pub(crate) cross_m: f64,
}

/// Distances for vehicles. The one in range is a compromise between the gaps between glints of one long
/// vehicle and those that drivers keep; the one across is less than a lane.
const VEHICLES: ClusterReach = ClusterReach { range_m: 2.5, cross_m: 2.5 };

/// Distances for people. The one in range is the longer axis of a standing body, 50 × 60 cm; the one across
/// is less than the 0.87 m between two people who walk, each in a zone of 0.75 m² (Rouphail et al.,
/// FHWA-RD-98-107, 1998, §2.1).
const PEOPLE: ClusterReach = ClusterReach { range_m: 0.6, cross_m: 0.8 };

pub(crate) const CLUSTER: Key<Choice<ClusterReach>, DefaultValue<ClusterReach>> = Key::new(
    "cluster",
    Choice(|| vec![("vehicles", VEHICLES), ("people", PEOPLE)]),
    "whose detections are to form objects: the defaults of `cluster_range_m` and `cluster_cross_m`. People \
     are smaller and closer together; their limbs stay within the same `cluster_velocity_mps` of the trunk \
     as the parts of a vehicle",
)
.with_default(VEHICLES);

pub(crate) const CLUSTER_RANGE: Key<Number> = Key::new(
    "cluster_range_m",
    Number(Above(0.0, 1e3)),
    "m in range: detections closer than this can join one object",
)
.absent("2.5; of people 0.6");

pub(crate) const CLUSTER_VELOCITY: Key<Number, DefaultValue<f64>> =
    Key::new("cluster_velocity_mps", Number(Above(0.0, 1e3)), "m/s, likewise").with_default(1.0);

pub(crate) const CLUSTER_CROSS: Key<Number> =
    Key::new("cluster_cross_m", Number(Above(0.0, 1e3)), "m across the lanes, likewise")
        .absent("2.5; of people 0.8");
