//! `[radar.array]`: antenna elements, from half wavelengths along the boresight's right and up to world
//! metres.

use crate::document::errors::Rule;
use crate::document::section::Section;
use crate::measured::pattern_table::read_pattern_table;
use crate::models::library::Models;
use crate::wording::allowed::Allowed;
use artifact::radar::{Array, Multiplexing, Pattern, PatternTable, Polarization, Radar};
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

/// Name and maker of transmit and receive elements.
type Preset = (&'static str, fn() -> (Elements, Elements));

/// Transmit and receive elements of the presets (table of `docs/scenes.md`); the last has 192 virtual
/// elements.
const PRESETS: [Preset; 5] = [
    ("1x1", || (row(1, 1.0), row(1, 1.0))),
    ("1x4", || (row(1, 1.0), row(4, 1.0))),
    ("3x4", || (row(3, 4.0), row(4, 1.0))),
    ("6x8", || (row(6, 2.0), golomb_rows())),
    ("12x16", || (row(12, 16.0), row(16, 1.0))),
];

/// A row of more elements than any radar on a chip or a few of them has.
const ELEMENTS: Allowed = Allowed::Between(1.0, 256.0);
/// Half wavelengths: at 77 GHz 20 m, beyond which no array is one.
const OFFSETS: Allowed = Allowed::Between(-1e4, 1e4);

/// The array of a scene, 3x4 where it says nothing.
pub(crate) fn read_array(section: &Section<'_>, mount: &Mount, models: &mut Models) -> Array {
    let (tx_half_wavelengths, rx_half_wavelengths) = read_elements(section);
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
        tx_m: mount.world_positions_m(&tx_half_wavelengths),
        rx_m: mount.world_positions_m(&rx_half_wavelengths),
        tx_half_wavelengths,
        rx_half_wavelengths,
        multiplexing: section.word("multiplexing", &multiplexing).unwrap_or(Multiplexing::Simultaneous),
        polarization: section.word("polarization", &polarization).unwrap_or(Polarization::Vv),
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
    tx.zip(rx)
        .unwrap_or_else(|| section.word("preset", &PRESETS).map_or_else(default_elements, |preset| preset()))
}

fn default_elements() -> (Elements, Elements) {
    (row(3, 4.0), row(4, 1.0))
}

fn row(count: u8, spacing: f64) -> Elements {
    (0..count).map(|i| [f64::from(i) * spacing, 0.0]).collect()
}

/// Two columns by four rows at 0, 1, 4, 6 half wavelengths: a Golomb ruler, all differences from 1 to 6.
fn golomb_rows() -> Elements {
    [0.0, 1.0, 4.0, 6.0].iter().flat_map(|up| [[0.0, *up], [1.0, *up]]).collect()
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
