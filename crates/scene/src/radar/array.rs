//! `[radar.array]`: antenna elements, converted from half wavelengths right and up of the boresight to world
//! metres.

use crate::document::errors::Rule;
use crate::document::keys::array::{
    COSINE_EXPONENT, MULTIPLEXING, PATTERN, PATTERN_FILE, POLARIZATION, PRESET, PatternForm, RX, TX,
};
use crate::document::section::Section;
use crate::measured::pattern_table::read_pattern_table;
use crate::models::library::Models;
use artifact::radar::{Array, Pattern, PatternTable};
use radar::aperture::Elements;

/// Reads the array of a scene, 3x4 by default, not yet mounted: its elements have no world positions.
pub(crate) fn read_array(section: &Section<'_>, models: &mut Models) -> Array {
    let [tx_half_wavelengths, rx_half_wavelengths] = read_elements(section);
    Array {
        tx_m: vec![],
        rx_m: vec![],
        tx_half_wavelengths,
        rx_half_wavelengths,
        multiplexing: section.or_default(&MULTIPLEXING),
        polarization: section.or_default(&POLARIZATION),
        pattern: read_pattern(section, models),
    }
}

fn read_elements(section: &Section<'_>) -> [Elements; 2] {
    let (tx, rx) = (section.read(&TX), section.read(&RX));
    let (has_tx, has_rx) = (section.has(TX.name), section.has(RX.name));
    if section.has(PRESET.name) && (has_tx || has_rx) {
        let other = if has_tx { TX.name } else { RX.name };
        section.note(PRESET.name, Rule::Contradiction { key: PRESET.name, other });
    }
    match (has_tx, has_rx) {
        (true, false) => section.note(TX.name, Rule::Alone { key: TX.name, companion: RX.name }),
        (false, true) => section.note(RX.name, Rule::Alone { key: RX.name, companion: TX.name }),
        _ => {}
    }
    tx.zip(rx).map(|(tx, rx)| [tx, rx]).unwrap_or_else(|| section.or_default(&PRESET).elements())
}

fn read_pattern(section: &Section<'_>, models: &mut Models) -> Pattern {
    let exponent = section.read(&COSINE_EXPONENT);
    let form = section.or_default(&PATTERN);
    for (key, of) in [(COSINE_EXPONENT.name, PatternForm::Cosine), (PATTERN_FILE.name, PatternForm::Table)] {
        if form == of {
            section.require(key);
        } else if section.has(key) {
            section.note(key, Rule::Misplaced { key, owner: owner(form) });
        }
    }
    match form {
        PatternForm::Isotropic => Pattern::Isotropic,
        PatternForm::Cosine => Pattern::Cosine { exponent: exponent.unwrap_or(1.0) },
        PatternForm::Table => read_table(section, models).map_or(Pattern::Isotropic, Pattern::Table),
    }
}

fn owner(form: PatternForm) -> &'static str {
    match form {
        PatternForm::Isotropic => "an isotropic pattern",
        PatternForm::Cosine => "a cosine pattern",
        PatternForm::Table => "a pattern from a table",
    }
}

fn read_table(section: &Section<'_>, models: &mut Models) -> Option<PatternTable> {
    let file = models.add_input(section.read(&PATTERN_FILE)?);
    read_pattern_table(&file).map_err(|error| section.note(PATTERN_FILE.name, Rule::Pattern(error))).ok()
}
