//! Every key of a scene, once: what the reader accepts, what an error suggests and what `docs/scenes.md`
//! explains.

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
pub const TABLES: &[Table] = &[
    SCENE,
    RADAR,
    WAVEFORM,
    ARRAY,
    LINK,
    RECEIVER,
    INTERFERER,
    RADAR_INTERSECTION,
    RADARS,
    NOISE,
    DSP,
    FIDELITY,
    MATERIAL,
    LAYER,
    INTERSECTION,
    ROAD,
    TARGET,
    CLUTTER,
    TRAFFIC,
    MODEL_OF_TYPE,
];

pub(crate) const SCENE: Table = Table {
    name: "",
    heading: "the beginning of the file",
    keys: &[
        "name",
        "seed",
        "frames",
        "frame_interval_s",
        "radar",
        "radars",
        "noise",
        "dsp",
        "fidelity",
        "materials",
        "intersection",
        "road",
        "target",
        "clutter",
        "traffic",
    ],
};

pub(crate) const RADAR: Table = Table {
    name: "radar",
    heading: "[radar]",
    keys: &[
        "position_m",
        "boresight_az_deg",
        "boresight_el_deg",
        "waveform",
        "array",
        "link",
        "receiver",
        "interferer",
        "intersection",
    ],
};

/// Each of the `[[radars]]`: what of `[radar]` is otherwise with it.
pub(crate) const RADARS: Table = Table {
    name: "radars",
    heading: "[[radars]]",
    keys: &[
        "id",
        "position_m",
        "boresight_az_deg",
        "boresight_el_deg",
        "waveform",
        "array",
        "link",
        "receiver",
        "interferer",
        "intersection",
    ],
};

pub(crate) const WAVEFORM: Table = Table {
    name: "radar.waveform",
    heading: "[radar.waveform]",
    keys: &[
        "start_frequency_ghz",
        "slope_mhz_per_us",
        "sample_rate_msps",
        "samples",
        "idle_us",
        "chirps",
        "sub_frame_idle_us",
        "stagger_us",
    ],
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
        "pattern_file",
        "tx_gain_errors_db",
        "tx_phase_errors_deg",
        "tx_delays_ps",
        "rx_gain_errors_db",
        "rx_phase_errors_deg",
        "rx_delays_ps",
        "gain_spread_db",
        "phase_spread_deg",
    ],
};

pub(crate) const LINK: Table =
    Table { name: "radar.link", heading: "[radar.link]", keys: &["transmit_power_dbm", "antenna_gain_dbi"] };

pub(crate) const RECEIVER: Table = Table {
    name: "radar.receiver",
    heading: "[radar.receiver]",
    keys: &["sampling", "adc_bits", "full_scale_dbm", "phase_noise_dbc_hz"],
};

/// Each of the `[[radar.interferer]]`.
pub(crate) const INTERFERER: Table = Table {
    name: "radar.interferer",
    heading: "[[radar.interferer]]",
    keys: &[
        "position_m",
        "velocity_mps",
        "eirp_dbm",
        "start_frequency_ghz",
        "slope_mhz_per_us",
        "sweep_us",
        "chirp_interval_us",
        "offset_us",
    ],
};

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
        "angle",
        "refine",
        "calibration",
        "static",
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
        "between_bodies",
        "measured_every",
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
pub(crate) const MATERIAL_FILE: Table =
    Table { name: "", heading: "the beginning of the file", keys: &["materials"] };

pub(crate) const ROAD: Table = Table {
    name: "road",
    heading: "[road]",
    keys: &["mirror", "substance", "permittivity", "rms_height_mm", "backscatter", "backscatter_gamma_db"],
};

pub(crate) const INTERSECTION: Table = Table {
    name: "intersection",
    heading: "[intersection]",
    keys: &["lane_centres_m", "lane_width_m", "lane_origin_m", "lane_azimuth_deg", "crossing_width_m"],
};

/// The lanes that one radar tells by.
pub(crate) const RADAR_INTERSECTION: Table = Table {
    name: "radar.intersection",
    heading: "[radar.intersection]",
    keys: &["lane_centres_m", "lane_width_m", "lane_origin_m", "lane_azimuth_deg"],
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
        "acceleration_mps2",
        "wheel_radius_m",
        "wheel_angle_deg",
        "yaw_deg",
    ],
};

pub(crate) const CLUTTER: Table = Table {
    name: "clutter",
    heading: "[[clutter]]",
    keys: &["id", "model", "position_m", "yaw_deg", "length_m", "height_m", "diameter_m", "unit_scale"],
};

pub(crate) const TRAFFIC: Table = Table {
    name: "traffic",
    heading: "[traffic]",
    keys: &[
        "fcd",
        "net",
        "begin_s",
        "end_s",
        "models",
        "view_nearest_m",
        "view_range_m",
        "view_half_angle_deg",
    ],
};

/// Each entry of `models` in `[traffic]` that is a table.
pub(crate) const MODEL_OF_TYPE: Table = Table {
    name: "traffic.models",
    heading: "models of [traffic]",
    keys: &["model", "class", "vehicle_seed", "unit_scale"],
};

/// The heading of a table, other than `here`, that knows `key`.
pub(crate) fn home_of(key: &str, here: &Table) -> Option<&'static str> {
    TABLES
        .iter()
        .find(|table| table.name != here.name && table.keys.contains(&key))
        .map(|table| table.heading)
}
