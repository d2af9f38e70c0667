//! Every key of a scene, once: what the reader accepts, what an error suggests and what `docs/scenes.md` explains.

/// A table of a scene file and the keys it may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Table {
    /// Dotted name; empty for the keys before the first table.
    pub name: &'static str,
    /// As written in the file.
    pub heading: &'static str,
    /// Keys, tables below it included.
    pub keys: &'static [&'static str],
}

/// All tables, in the order of `docs/scenes.md`.
pub const TABLES: &[Table] =
    &[SCENE, RADAR, WAVEFORM, ARRAY, LINK, NOISE, DSP, FIDELITY, MATERIAL, LAYER, INTERSECTION, ROAD, TARGET];

pub(crate) const SCENE: Table = Table {
    name: "",
    heading: "the beginning of the file",
    keys: &[
        "name",
        "seed",
        "frames",
        "frame_interval_s",
        "radar",
        "noise",
        "dsp",
        "fidelity",
        "materials",
        "intersection",
        "road",
        "target",
    ],
};

pub(crate) const RADAR: Table = Table {
    name: "radar",
    heading: "[radar]",
    keys: &["position_m", "boresight_az_deg", "boresight_el_deg", "waveform", "array", "link"],
};

pub(crate) const WAVEFORM: Table = Table {
    name: "radar.waveform",
    heading: "[radar.waveform]",
    keys: &["start_frequency_ghz", "slope_mhz_per_us", "sample_rate_msps", "samples", "idle_us", "chirps"],
};

pub(crate) const ARRAY: Table = Table {
    name: "radar.array",
    heading: "[radar.array]",
    keys: &[
        "preset",
        "tx_half_wavelengths",
        "rx_half_wavelengths",
        "multiplexing",
        "polarization",
        "pattern",
        "cosine_exponent",
    ],
};

pub(crate) const LINK: Table =
    Table { name: "radar.link", heading: "[radar.link]", keys: &["transmit_power_dbm", "antenna_gain_dbi"] };

pub(crate) const NOISE: Table =
    Table { name: "noise", heading: "[noise]", keys: &["noise_figure_db", "temperature_k", "snr_db"] };

pub(crate) const DSP: Table = Table {
    name: "dsp",
    heading: "[dsp]",
    keys: &[
        "range_window",
        "doppler_window",
        "detector",
        "false_alarm_rate",
        "guard_cells",
        "training_cells",
        "assumed_height_m",
        "cluster_range_m",
        "cluster_velocity_mps",
        "cluster_cross_m",
    ],
};

pub(crate) const FIDELITY: Table = Table {
    name: "fidelity",
    heading: "[fidelity]",
    keys: &[
        "accuracy_db",
        "bounces",
        "edges",
        "surface",
        "sides",
        "nodes",
        "echo",
        "detail",
        "materials",
        "transmission",
    ],
};

/// Each entry of `[materials]`.
pub(crate) const MATERIAL: Table = Table {
    name: "materials",
    heading: "[materials]",
    keys: &["substance", "permittivity", "thickness_mm", "layers", "backing", "coherent"],
};

/// Each of the `layers` of an entry.
pub(crate) const LAYER: Table = Table {
    name: "materials.layers",
    heading: "layers of [materials]",
    keys: &["substance", "permittivity", "thickness_mm"],
};

/// A file of materials.
pub(crate) const MATERIAL_FILE: Table = Table { name: "", heading: "the beginning of the file", keys: &["materials"] };

pub(crate) const ROAD: Table =
    Table { name: "road", heading: "[road]", keys: &["substance", "permittivity", "rms_height_mm"] };

pub(crate) const INTERSECTION: Table = Table {
    name: "intersection",
    heading: "[intersection]",
    keys: &["lane_centres_m", "lane_width_m", "crossing_width_m"],
};

pub(crate) const TARGET: Table = Table {
    name: "target",
    heading: "[[target]]",
    keys: &[
        "kind",
        "id",
        "class",
        "model",
        "vehicle_seed",
        "unit_scale",
        "rcs_m2",
        "position_m",
        "lane",
        "y_m",
        "velocity_mps",
        "yaw_deg",
    ],
};

/// The heading of a table, other than `here`, that knows `key`.
pub(crate) fn home_of(key: &str, here: &Table) -> Option<&'static str> {
    TABLES.iter().find(|table| table.name != here.name && table.keys.contains(&key)).map(|table| table.heading)
}
