//! `[radar.waveform]`.

use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Integer, Number, Numbers};
use crate::wording::allowed_range::AllowedRange::Between;

pub(crate) const WAVEFORM: Table = Table {
    name: "radar.waveform",
    heading: "[radar.waveform]",
    about: "Linear chirps: bandwidth is slope · samples / sample rate.",
    keys: &[&START_FREQUENCY, &SLOPE, &SAMPLE_RATE, &SAMPLES, &IDLE, &CHIRPS, &SUB_FRAME_IDLE, &STAGGER],
};

pub(crate) const START_FREQUENCY: Key<Number, DefaultValue<f64>> =
    Key::new("start_frequency_ghz", Number(Between(0.1, 1000.0)), "GHz at the first sample")
        .with_default(77.0);

pub(crate) const SLOPE: Key<Number, DefaultValue<f64>> = Key::new(
    "slope_mhz_per_us",
    Number(Between(-1e4, 1e4)),
    "MHz/µs; negative for falling chirps, whose beat frequencies are negative: their maps are turned round",
)
.with_default(12.5)
.allowed("{}, not 0; the sweep ends from 0.1 to 2000 GHz");

pub(crate) const SAMPLE_RATE: Key<Number, DefaultValue<f64>> = Key::new(
    "sample_rate_msps",
    Number(Between(1e-3, 1e5)),
    "million samples a second, complex or real ([radar.receiver])",
)
.with_default(5.12);

/// Samples per chirp: fewer than 8 leave no range cells for guard and training; 2^16 is beyond any radar's
/// chirp.
pub(crate) const SAMPLES: Key<Integer, DefaultValue<u64>> =
    Key::new("samples", Integer(Between(8.0, 65536.0)), "of a chirp").with_default(256);

pub(crate) const IDLE: Key<Number, DefaultValue<f64>> = Key::new(
    "idle_us",
    Number(Between(0.0, 1e6)),
    "µs between chirps: chirp interval = samples / sample rate + idle",
)
.with_default(10.0);

pub(crate) const CHIRPS: Key<Integer, DefaultValue<u64>> = Key::new(
    "chirps",
    Integer(Between(1.0, 65536.0)),
    "that each transmitter sends in a frame; with \"bpm\" blocks of chirps",
)
.with_default(128);

/// Sub-frames: two resolve a velocity; no radar sends more than eight.
pub(crate) const SUB_FRAME_IDLE: Key<Numbers> = Key::new(
    "sub_frame_idle_us",
    Numbers { length: Between(2.0, 8.0), each: Between(0.0, 1e6) },
    "µs between the chirps of each sub-frame, instead of `idle_us`: a frame is that many bursts of \
     `chirps` chirps, one after the other without a pause; each is a frame record of its own in every \
     artifact, and `run` and `dsp` tell velocities beyond a record's span from the next sub-frame's (not \
     where both \"tdm\" and `stagger_us` are set: nothing tells a transmitter's folds then)",
);

pub(crate) const STAGGER: Key<Numbers> = Key::new(
    "stagger_us",
    Numbers { length: Between(2.0, 64.0), each: Between(0.0, 1e6) },
    "µs added to the interval after one chirp and the next, whichever transmitter sends them, over and over",
);
