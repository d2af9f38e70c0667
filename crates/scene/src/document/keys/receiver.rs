//! `[radar.receiver]` and `[[radar.interferer]]`.

use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Choice, Integer, Number, Pair, Pairs, Vector};
use crate::document::ranges::{COORDINATES_M, VELOCITIES_MPS};
use crate::wording::allowed_range::AllowedRange::{Above, Between};
use artifact::radar::Sampling;

/// Phase-noise levels: offsets from the carrier up to a terahertz, levels below the carrier's.
const LEVELS: Pair = Pair { any: Between(-300.0, 1e12), each: [Above(0.0, 1e12), Between(-300.0, 0.0)] };

pub(crate) const RECEIVER: Table = Table {
    name: "radar.receiver",
    heading: "[radar.receiver]",
    about: "Mixer, converter and oscillator.",
    keys: &[&SAMPLING, &ADC_BITS, &FULL_SCALE, &PHASE_NOISE],
};

pub(crate) const SAMPLING: Key<Choice<Sampling>, DefaultValue<Sampling>> = Key::new(
    "sampling",
    Choice(|| vec![("complex", Sampling::Complex), ("real", Sampling::Real)]),
    "\"real\": a mixer without Q channel: imaginary parts of all samples are 0, signal to noise is 3 dB \
     less, and maps have the half of the range cells that is not the other's image",
)
.with_default(Sampling::Complex);

pub(crate) const ADC_BITS: Key<Integer> = Key::new(
    "adc_bits",
    Integer(Between(1.0, 24.0)),
    "with `full_scale_dbm`: each part of a complex sample is rounded to one of 2^bits codes, after the \
     noise; left out: samples are not rounded",
);

pub(crate) const FULL_SCALE: Key<Number> = Key::new(
    "full_scale_dbm",
    Number(Between(-300.0, 200.0)),
    "dBm: power of a sample whose real or imaginary part alone is at full scale; beyond it samples are \
     clipped",
);

pub(crate) const PHASE_NOISE: Key<Pairs> = Key::new(
    "phase_noise_dbc_hz",
    Pairs { length: Between(1.0, 64.0), pair: LEVELS },
    "[offset in Hz, dBc/Hz]: single-sideband phase noise L(f) of the oscillator, straight in dB over log \
     f between, constant before and behind; left out: none",
)
.allowed("{}, the first growing");

pub(crate) const INTERFERER: Table = Table {
    name: "radar.interferer",
    heading: "[[radar.interferer]]",
    about: "Another FMCW radar that is heard.",
    keys: &[&POSITION, &VELOCITY, &EIRP, &START_FREQUENCY, &SLOPE, &SWEEP, &CHIRP_INTERVAL, &OFFSET],
};

pub(crate) const POSITION: Key<Vector<3>> = Key::new(
    "position_m",
    Vector(COORDINATES_M),
    "m, world, at the first frame's first sample; not within a metre of the radar",
)
.required();

pub(crate) const VELOCITY: Key<Vector<3>, DefaultValue<[f64; 3]>> =
    Key::new("velocity_mps", Vector(VELOCITIES_MPS), "m/s, world, constant").with_default([0.0; 3]);

pub(crate) const EIRP: Key<Number> = Key::new(
    "eirp_dbm",
    Number(Between(-200.0, 200.0)),
    "dBm: transmit power times antenna gain towards this radar",
)
.required();

pub(crate) const START_FREQUENCY: Key<Number, DefaultValue<f64>> =
    Key::new("start_frequency_ghz", Number(Between(0.1, 1000.0)), "GHz at the beginning of its chirps")
        .with_default(77.0);

pub(crate) const SLOPE: Key<Number, DefaultValue<f64>> =
    Key::new("slope_mhz_per_us", Number(Between(-1e4, 1e4)), "MHz/µs; 0 is a tone").with_default(12.5);

/// Sweep duration of at least a tenth of a microsecond: no radar sends more chirps within one of ours.
pub(crate) const SWEEP: Key<Number, DefaultValue<f64>> =
    Key::new("sweep_us", Number(Between(0.1, 1e6)), "µs: length of its chirps").with_default(50.0);

pub(crate) const CHIRP_INTERVAL: Key<Number, DefaultValue<f64>> = Key::new(
    "chirp_interval_us",
    Number(Between(0.1, 1e6)),
    "µs from one chirp's beginning to the next's; not shorter than a chirp",
)
.with_default(60.0);

pub(crate) const OFFSET: Key<Number, DefaultValue<f64>> = Key::new(
    "offset_us",
    Number(Between(-1e9, 1e9)),
    "µs after the first frame's first sample at which one of its chirps begins",
)
.with_default(0.0);
