//! `[radar.array]`: antenna elements, from half wavelengths along the boresight's right and up to world
//! metres.

use crate::document::errors::Rule;
use crate::document::section::Section;
use crate::measured::pattern_table::read_pattern_table;
use crate::models::library::Models;
use crate::wording::allowed::Allowed;
use artifact::radar::{Array, Multiplexing, Pattern, PatternTable, Polarization};
use radar::aperture::{Elements, PRESETS, row};

/// A row of more elements than any radar on a chip or a few of them has.
const ELEMENTS: Allowed = Allowed::Between(1.0, 256.0);
/// Half wavelengths: at 77 GHz 20 m, beyond which no array is one.
const OFFSETS: Allowed = Allowed::Between(-1e4, 1e4);

/// The array of a scene, 3x4 where it says nothing, not yet mounted anywhere: its elements have no world
/// positions.
pub(crate) fn read_array(section: &Section<'_>, models: &mut Models) -> Array {
    let [tx_half_wavelengths, rx_half_wavelengths] = read_elements(section);
    let multiplexing = [
        ("simultaneous", Multiplexing::Simultaneous),
        ("tdm", Multiplexing::Tdm),
        ("ddm", Multiplexing::Ddm),
        ("bpm", Multiplexing::Bpm),
    ];
    let polarization = [
        ("vv", Polarization::Vv),
        ("hh", Polarization::Hh),
        ("vh", Polarization::Vh),
        ("hv", Polarization::Hv),
    ];
    Array {
        tx_m: vec![],
        rx_m: vec![],
        tx_half_wavelengths,
        rx_half_wavelengths,
        multiplexing: section.word("multiplexing", &multiplexing).unwrap_or(Multiplexing::Simultaneous),
        polarization: section.word("polarization", &polarization).unwrap_or(Polarization::Vv),
        pattern: read_pattern(section, models),
    }
}

fn read_elements(section: &Section<'_>) -> [Elements; 2] {
    let tx = section.pairs("tx_half_wavelengths", ELEMENTS, OFFSETS);
    let rx = section.pairs("rx_half_wavelengths", ELEMENTS, OFFSETS);
    let (has_tx, has_rx) = (section.has("tx_half_wavelengths"), section.has("rx_half_wavelengths"));
    if section.has("preset") && (has_tx || has_rx) {
        let other = if has_tx { "tx_half_wavelengths" } else { "rx_half_wavelengths" };
        section.note("preset", Rule::Contradiction { key: "preset", other });
    }
    match (has_tx, has_rx) {
        (true, false) => section.note(
            "tx_half_wavelengths",
            Rule::Alone { key: "tx_half_wavelengths", companion: "rx_half_wavelengths" },
        ),
        (false, true) => section.note(
            "rx_half_wavelengths",
            Rule::Alone { key: "rx_half_wavelengths", companion: "tx_half_wavelengths" },
        ),
        _ => {}
    }
    let named = || section.word("preset", &PRESETS).map(|elements| elements());
    tx.zip(rx).map(|(tx, rx)| [tx, rx]).or_else(named).unwrap_or_else(|| [row(3, 4.0), row(4, 1.0)])
}

fn read_pattern(section: &Section<'_>, models: &mut Models) -> Pattern {
    let exponent = section.number("cosine_exponent", Allowed::Above(0.0, 100.0));
    let words = [("isotropic", Form::Isotropic), ("cosine", Form::Cosine), ("table", Form::Table)];
    let form = section.word("pattern", &words).unwrap_or(Form::Isotropic);
    for (key, of) in [("cosine_exponent", Form::Cosine), ("pattern_file", Form::Table)] {
        if form == of {
            section.require(key);
        } else if section.has(key) {
            section.note(key, Rule::Misplaced { key, owner: form.owner() });
        }
    }
    match form {
        Form::Isotropic => Pattern::Isotropic,
        Form::Cosine => Pattern::Cosine { exponent: exponent.unwrap_or(1.0) },
        Form::Table => read_table(section, models).map_or(Pattern::Isotropic, Pattern::Table),
    }
}

/// What tells a pattern.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Isotropic,
    Cosine,
    Table,
}

impl Form {
    fn owner(self) -> &'static str {
        match self {
            Self::Isotropic => "an isotropic pattern",
            Self::Cosine => "a cosine pattern",
            Self::Table => "a pattern from a table",
        }
    }
}

fn read_table(section: &Section<'_>, models: &mut Models) -> Option<PatternTable> {
    let file = models.file_beside(section.text("pattern_file")?);
    read_pattern_table(&file).map_err(|error| section.note("pattern_file", Rule::Pattern(error))).ok()
}
