//! `[radar.array]`: antenna elements, from half wavelengths along the boresight's right and up to world
//! metres.

use crate::document::errors::Rule;
use crate::document::keys::array::{
    COSINE_EXPONENT, Form, MULTIPLEXING, PATTERN, PATTERN_FILE, POLARIZATION, PRESET, Preset, RX, TX,
};
use crate::document::section::Section;
use crate::measured::pattern_table::read_pattern_table;
use crate::models::library::Models;
use artifact::radar::{Array, Pattern, PatternTable, Radar};
use glam::DVec3;

/// Where the elements are mounted.
pub(crate) struct Mount {
    /// Centre of the transmit row and of the receive row.
    pub position_m: [f64; 3],
    /// From +y towards +x.
    pub boresight_az_rad: f64,
    /// Above the horizon.
    pub boresight_el_rad: f64,
    /// Of the sampled sweep's centre.
    pub half_wavelength_m: f64,
}

/// Elements in half wavelengths, [right, up].
type Elements = Vec<[f64; 2]>;

/// The array of a scene, 3x4 where it says nothing.
pub(crate) fn read_array(section: &Section<'_>, mount: &Mount, models: &mut Models) -> Array {
    let (tx_half_wavelengths, rx_half_wavelengths) = read_elements(section);
    Array {
        tx_m: mount.world_positions_m(&tx_half_wavelengths),
        rx_m: mount.world_positions_m(&rx_half_wavelengths),
        tx_half_wavelengths,
        rx_half_wavelengths,
        multiplexing: section.or_default(&MULTIPLEXING),
        polarization: section.or_default(&POLARIZATION),
        pattern: read_pattern(section, models),
    }
}

impl Mount {
    /// World metres of elements centred on the mount: their mean, the row's phase centre, lies at its
    /// position.
    pub(crate) fn world_positions_m(&self, elements: &[[f64; 2]]) -> Vec<[f64; 3]> {
        let (right, up) = self.right_and_up();
        let count = elements.len().max(1) as f64;
        let mean = |axis: usize| elements.iter().map(|element| element[axis]).sum::<f64>() / count;
        let centre = [mean(0), mean(1)];
        let in_plane = |e: &[f64; 2]| right * (e[0] - centre[0]) + up * (e[1] - centre[1]);
        elements
            .iter()
            .map(|e| (DVec3::from(self.position_m) + in_plane(e) * self.half_wavelength_m).into())
            .collect()
    }

    /// Unit vectors to the right, horizontal, and up, both across the boresight, as seen when looking along
    /// it.
    fn right_and_up(&self) -> (DVec3, DVec3) {
        let (sin_az, cos_az) = self.boresight_az_rad.sin_cos();
        let (sin_el, cos_el) = self.boresight_el_rad.sin_cos();
        let boresight = DVec3::new(cos_el * sin_az, cos_el * cos_az, sin_el);
        let right = DVec3::new(cos_az, -sin_az, 0.0);
        (right, right.cross(boresight))
    }
}

/// The same radar at another height and tilt, its elements where they then are.
pub fn remounted(radar: &Radar, height_m: f64, boresight_el_rad: f64) -> Radar {
    let [x_m, y_m, _] = radar.position_m;
    let position_m = [x_m, y_m, height_m];
    let half_wavelength_m = 0.5 * radar.waveform.wavelength_m();
    let mount =
        Mount { position_m, boresight_az_rad: radar.boresight_az_rad, boresight_el_rad, half_wavelength_m };
    let array = Array {
        tx_m: mount.world_positions_m(&radar.array.tx_half_wavelengths),
        rx_m: mount.world_positions_m(&radar.array.rx_half_wavelengths),
        ..radar.array.clone()
    };
    Radar { position_m, boresight_el_rad, array, ..radar.clone() }
}

fn read_elements(section: &Section<'_>) -> (Elements, Elements) {
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
    tx.zip(rx).unwrap_or_else(|| elements_of(section.or_default(&PRESET)))
}

/// Transmit and receive elements of the presets (table of `docs/scenes.md`); the last has 192 virtual
/// elements.
fn elements_of(preset: Preset) -> (Elements, Elements) {
    match preset {
        Preset::OneByOne => (row(1, 1.0), row(1, 1.0)),
        Preset::OneByFour => (row(1, 1.0), row(4, 1.0)),
        Preset::ThreeByFour => (row(3, 4.0), row(4, 1.0)),
        Preset::SixByEight => (row(6, 2.0), golomb_rows()),
        Preset::TwelveBySixteen => (row(12, 16.0), row(16, 1.0)),
    }
}

fn row(count: u8, spacing: f64) -> Elements {
    (0..count).map(|i| [f64::from(i) * spacing, 0.0]).collect()
}

/// Two columns by four rows at 0, 1, 4, 6 half wavelengths: a Golomb ruler, all differences from 1 to 6.
fn golomb_rows() -> Elements {
    [0.0, 1.0, 4.0, 6.0].iter().flat_map(|up| [[0.0, *up], [1.0, *up]]).collect()
}

fn read_pattern(section: &Section<'_>, models: &mut Models) -> Pattern {
    let exponent = section.read(&COSINE_EXPONENT);
    let form = section.or_default(&PATTERN);
    for (key, of) in [(COSINE_EXPONENT.name, Form::Cosine), (PATTERN_FILE.name, Form::Table)] {
        if form == of {
            section.require(key);
        } else if section.has(key) {
            section.note(key, Rule::Misplaced { key, owner: owner(form) });
        }
    }
    match form {
        Form::Isotropic => Pattern::Isotropic,
        Form::Cosine => Pattern::Cosine { exponent: exponent.unwrap_or(1.0) },
        Form::Table => read_table(section, models).map_or(Pattern::Isotropic, Pattern::Table),
    }
}

fn owner(form: Form) -> &'static str {
    match form {
        Form::Isotropic => "an isotropic pattern",
        Form::Cosine => "a cosine pattern",
        Form::Table => "a pattern from a table",
    }
}

fn read_table(section: &Section<'_>, models: &mut Models) -> Option<PatternTable> {
    let file = models.file_beside(section.read(&PATTERN_FILE)?);
    read_pattern_table(&file).map_err(|error| section.note(PATTERN_FILE.name, Rule::Pattern(error))).ok()
}
