//! `[radar.array]`.

use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Choice, Number, Pair, Pairs, PerElement, Text};
use crate::wording::allowed_range::AllowedRange::{self, Above, Between};
use artifact::radar::{Multiplexing, Polarization};
use radar::aperture::Preset;

/// Form in which an element's pattern is given.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum PatternForm {
    Isotropic,
    Cosine,
    Table,
}

/// Offsets in half wavelengths: at 77 GHz up to 20 m, more than any array.
const OFFSETS: AllowedRange = Between(-1e4, 1e4);

/// Elements in a row: more than any radar on one or a few chips has.
const ELEMENTS: Pairs =
    Pairs { length: Between(1.0, 256.0), pair: Pair { any: OFFSETS, each: [OFFSETS, OFFSETS] } };

/// Gain errors up to a decade of amplitude, beyond which an element is dead or wrongly built; delays up to a
/// nanosecond (30 cm) of line.
const GAINS_DB: AllowedRange = Between(-20.0, 20.0);
const PHASES_DEG: AllowedRange = Between(-360.0, 360.0);
const DELAYS_PS: AllowedRange = Between(0.0, 1000.0);

pub(crate) const ARRAY: Table = Table {
    name: "radar.array",
    heading: "[radar.array]",
    about: "Antenna elements: where they are, how they share the air, their pattern and their errors.",
    keys: &[
        &PRESET,
        &TX,
        &RX,
        &MULTIPLEXING,
        &POLARIZATION,
        &PATTERN,
        &COSINE_EXPONENT,
        &PATTERN_FILE,
        &TX_GAIN_ERRORS,
        &TX_PHASE_ERRORS,
        &TX_DELAYS,
        &RX_GAIN_ERRORS,
        &RX_PHASE_ERRORS,
        &RX_DELAYS,
        &GAIN_SPREAD,
        &PHASE_SPREAD,
    ],
};

pub(crate) const PRESET: Key<Choice<Preset>, DefaultValue<Preset>> =
    Key::new("preset", Choice(|| Preset::ALL.to_vec()), "a named array; excludes the next two")
        .with_default(Preset::ThreeByFour)
        .allowed("the table below");

pub(crate) const TX: Key<Pairs> = Key::new(
    "tx_half_wavelengths",
    ELEMENTS,
    "transmit elements [horizontal, vertical] in half wavelengths of the sweep's centre: + is to the \
     right looking along the boresight, and up; the row's mean is put at `position_m`",
);

pub(crate) const RX: Key<Pairs> =
    Key::new("rx_half_wavelengths", ELEMENTS, "receive elements; both lists or neither").allowed("likewise");

pub(crate) const MULTIPLEXING: Key<Choice<Multiplexing>, DefaultValue<Multiplexing>> = Key::new(
    "multiplexing",
    Choice(|| {
        vec![
            ("simultaneous", Multiplexing::Simultaneous),
            ("tdm", Multiplexing::Tdm),
            ("ddm", Multiplexing::Ddm),
            ("bpm", Multiplexing::Bpm),
        ]
    }),
    "how the transmitters share the air: ideally orthogonal (the paper's), one after the other, told \
     apart by Doppler, or by binary codes (below). With \"tdm\" and \"bpm\" the phases between their \
     chirps tell the folds of their longer repetition, as far as the array can \
     ([validation/transmitters-in-turn.md](validation/transmitters-in-turn.md)): points then have \
     velocities within ±λ/4T of one chirp interval, and `velocity_resolved` where no other up to 33.4 m/s \
     looks alike",
)
.with_default(Multiplexing::Simultaneous);

pub(crate) const POLARIZATION: Key<Choice<Polarization>, DefaultValue<Polarization>> = Key::new(
    "polarization",
    Choice(|| {
        vec![
            ("vv", Polarization::Vv),
            ("hh", Polarization::Hh),
            ("vh", Polarization::Vh),
            ("hv", Polarization::Hv),
        ]
    }),
    "received, then transmitted: \"vh\" sends h and receives v; a point target answers in vv and hh \
     alike, not in vh",
)
.with_default(Polarization::Vv);

pub(crate) const PATTERN: Key<Choice<PatternForm>, DefaultValue<PatternForm>> = Key::new(
    "pattern",
    Choice(|| {
        vec![
            ("isotropic", PatternForm::Isotropic),
            ("cosine", PatternForm::Cosine),
            ("table", PatternForm::Table),
        ]
    }),
    "gain over direction: everywhere that of [radar.link], falling off the boresight, or from a file. \
     Bodies wholly behind an array that hears nothing there are not traced \
     ([behind_array.rs](../crates/bart-rcs/src/bodies/behind_array.rs))",
)
.with_default(PatternForm::Isotropic);

pub(crate) const COSINE_EXPONENT: Key<Number> = Key::new(
    "cosine_exponent",
    Number(Above(0.0, 100.0)),
    "required with \"cosine\": amplitude cosⁿ of the angle off boresight, nothing behind",
);

pub(crate) const PATTERN_FILE: Key<Text> = Key::new(
    "pattern_file",
    Text("a file"),
    "required with \"table\": gain over azimuth and elevation, as below",
);

pub(crate) const TX_GAIN_ERRORS: Key<PerElement> =
    Key::new("tx_gain_errors_db", PerElement(GAINS_DB), "dB: of its amplitude")
        .allowed("one value for each transmit element, {}");

pub(crate) const TX_PHASE_ERRORS: Key<PerElement> = Key::new(
    "tx_phase_errors_deg",
    PerElement(PHASES_DEG),
    "degrees by which the IF value of its echoes is turned",
)
.allowed("likewise, {}");

pub(crate) const TX_DELAYS: Key<PerElement> =
    Key::new("tx_delays_ps", PerElement(DELAYS_PS), "ps of its line: adds to the delay of every echo")
        .allowed("likewise, {}");

pub(crate) const RX_GAIN_ERRORS: Key<PerElement> =
    Key::new("rx_gain_errors_db", PerElement(GAINS_DB), "dB, likewise")
        .allowed("one value for each receive element, {}");

pub(crate) const RX_PHASE_ERRORS: Key<PerElement> =
    Key::new("rx_phase_errors_deg", PerElement(PHASES_DEG), "degrees, likewise").allowed("likewise, {}");

pub(crate) const RX_DELAYS: Key<PerElement> =
    Key::new("rx_delays_ps", PerElement(DELAYS_PS), "ps, likewise").allowed("likewise, {}");

pub(crate) const GAIN_SPREAD: Key<Number, DefaultValue<f64>> = Key::new(
    "gain_spread_db",
    Number(Between(0.0, 10.0)),
    "dB: standard deviation of what comes to the gain of every element, normal, drawn from the seed",
)
.with_default(0.0);

pub(crate) const PHASE_SPREAD: Key<Number, DefaultValue<f64>> =
    Key::new("phase_spread_deg", Number(Between(0.0, 180.0)), "degrees, likewise").with_default(0.0);
