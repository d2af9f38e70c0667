//! Every number of a scene: where it stands, and what has to stand beside it.

/// A key that holds numbers.
pub(crate) struct Number {
    pub(crate) table: &'static str,
    pub(crate) key: &'static str,
    /// Value as the scene file has it, `@` for the number.
    pub(crate) written: &'static str,
    pub(crate) beside: Setting,
}

/// Settings that the scene needs beside the number.
#[derive(Clone, Copy)]
pub(crate) enum Setting {
    /// Nothing that it has not anyway.
    Usual,
    /// More keys: table, key, value; an empty value takes a key away.
    With(&'static [(&'static str, &'static str, &'static str)]),
}

use Setting::{Usual, With};

const fn number(table: &'static str, key: &'static str, written: &'static str, beside: Setting) -> Number {
    Number { table, key, written, beside }
}

const WAVE: &str = "radar.waveform";
const ARRAY: &str = "radar.array";
const BODY: &str = "[target]";
const PIECE: &str = "[clutter]";
const OTHER: &str = "[radar.interferer]";

/// The small scene that all are tried in: a point before a small radar.
pub(crate) const SCENE: [(&str, &str, &str); 8] = [
    ("", "name", "\"m\""),
    (WAVE, "samples", "32"),
    (WAVE, "chirps", "16"),
    (ARRAY, "preset", "\"1x4\""),
    ("noise", "noise_figure_db", "12.0"),
    (BODY, "kind", "\"point\""),
    (BODY, "id", "\"p\""),
    (BODY, "position_m", "[2.0, 20.0, 1.0]"),
];

/// The point's own key, which bodies have not.
pub(crate) const POINT: (&str, &str, &str) = (BODY, "rcs_m2", "10.0");

const MESH: Setting =
    With(&[(BODY, "kind", "\"mesh\""), (BODY, "model", "\"sheet.obj\""), (BODY, "rcs_m2", "")]);
const VEHICLE: Setting =
    With(&[(BODY, "kind", "\"mesh\""), (BODY, "model", "\"car-suv\""), (BODY, "rcs_m2", "")]);
const LANE: Setting = With(&[
    (BODY, "position_m", ""),
    (BODY, "lane", "2"),
    (BODY, "y_m", "20"),
    (INTERSECTION, "lane_centres_m", "[2, 5.75]"),
]);
const WHEEL: Setting = With(&[(BODY, "wheel_radius_m", "0.3")]);
const ROD: Setting =
    With(&[(PIECE, "id", "\"k\""), (PIECE, "model", "\"pole\""), (PIECE, "position_m", "[5, 20, 0]")]);
const KERB: Setting = With(&[
    (PIECE, "id", "\"k\""),
    (PIECE, "model", "\"kerb\""),
    (PIECE, "position_m", "[5, 20, 0]"),
    (PIECE, "length_m", "1"),
]);
const FILE: Setting =
    With(&[(PIECE, "id", "\"k\""), (PIECE, "model", "\"sheet.obj\""), (PIECE, "position_m", "[5, 20, 0]")]);
const HEARD: Setting = With(&[(OTHER, "position_m", "[0, 80, 1]"), (OTHER, "eirp_dbm", "30")]);
const SNR: Setting = With(&[("noise", "noise_figure_db", "")]);
const TRAFFIC: Setting = With(&[
    ("traffic", "fcd", "\"t.fcd.xml\""),
    ("traffic", "models", "{ car = \"sheet.obj\" }"),
    ("", "frame_interval_s", "0.1"),
]);
const FEW: Setting = With(&[
    ("traffic", "fcd", "\"t.fcd.xml\""),
    ("traffic", "models", "{ car = \"sheet.obj\" }"),
    ("", "frames", "1"),
]);
const LIST: Setting = With(&[
    (ARRAY, "preset", ""),
    (ARRAY, "rx_half_wavelengths", "[[0, 0]]"),
    (ARRAY, "tx_half_wavelengths", "[[0, 0]]"),
]);
const FLOOR: Setting = With(&[("road", "backscatter", "\"floor\"")]);
const ROAD: Setting = With(&[("road", "mirror", "\"on\"")]);
const SKIN: Setting = With(&[
    (BODY, "kind", "\"mesh\""),
    (BODY, "model", "\"sheet.obj\""),
    (BODY, "rcs_m2", ""),
    ("fidelity", "transmission", "\"on\""),
]);
const RANKED: Setting = With(&[("dsp", "detector", "\"os-cfar\"")]);
const GREATEST: Setting = With(&[("dsp", "detector", "\"go-cfar\"")]);
const COSINE: Setting = With(&[(ARRAY, "pattern", "\"cosine\"")]);
const CODES: Setting =
    With(&[("radar.receiver", "full_scale_dbm", "-40"), ("radar.receiver", "adc_bits", "12")]);
const INTERSECTION: &str = "intersection";
const SEEN: &str = "radar.intersection";

pub(crate) const NUMBERS: &[Number] = &[
    number("", "seed", "@", Usual),
    number("", "frames", "@", Usual),
    number("", "frame_interval_s", "@", With(&[("", "frames", "2")])),
    number("", "frame_interval_s", "@", TRAFFIC),
    number("radar", "position_m", "[@, 0, 6]", Usual),
    number("radar", "position_m", "[0, 0, @]", ROAD),
    number("radar", "boresight_az_deg", "@", Usual),
    number("radar", "boresight_el_deg", "@", Usual),
    number(WAVE, "start_frequency_ghz", "@", MESH),
    number(WAVE, "slope_mhz_per_us", "@", MESH),
    number(WAVE, "sample_rate_msps", "@", MESH),
    number(WAVE, "samples", "@", Usual),
    number(WAVE, "idle_us", "@", Usual),
    number(WAVE, "chirps", "@", Usual),
    number(WAVE, "sub_frame_idle_us", "[10, @]", Usual),
    number(WAVE, "stagger_us", "[0, @]", Usual),
    number(ARRAY, "tx_half_wavelengths", "[[0, 0], [@, 0]]", LIST),
    number(ARRAY, "rx_half_wavelengths", "[[0, 0], [0, @]]", LIST),
    number(ARRAY, "cosine_exponent", "@", COSINE),
    number(ARRAY, "tx_gain_errors_db", "[@]", Usual),
    number(ARRAY, "tx_phase_errors_deg", "[@]", Usual),
    number(ARRAY, "tx_delays_ps", "[@]", Usual),
    number(ARRAY, "rx_gain_errors_db", "[0, 0, 0, @]", Usual),
    number(ARRAY, "rx_phase_errors_deg", "[0, @, 0, 0]", Usual),
    number(ARRAY, "rx_delays_ps", "[@, 0, 0, 0]", Usual),
    number(ARRAY, "gain_spread_db", "@", Usual),
    number(ARRAY, "phase_spread_deg", "@", Usual),
    number("radar.link", "transmit_power_dbm", "@", Usual),
    number("radar.link", "antenna_gain_dbi", "@", Usual),
    number("radar.receiver", "adc_bits", "@", CODES),
    number("radar.receiver", "full_scale_dbm", "@", CODES),
    number("radar.receiver", "phase_noise_dbc_hz", "[[@, -80]]", Usual),
    number("radar.receiver", "phase_noise_dbc_hz", "[[1e4, @], [1e6, -90]]", Usual),
    number(OTHER, "position_m", "[0, @, 1]", HEARD),
    number(OTHER, "velocity_mps", "[@, 0, 0]", HEARD),
    number(OTHER, "eirp_dbm", "@", HEARD),
    number(OTHER, "start_frequency_ghz", "@", HEARD),
    number(OTHER, "slope_mhz_per_us", "@", HEARD),
    number(OTHER, "sweep_us", "@", HEARD),
    number(OTHER, "chirp_interval_us", "@", HEARD),
    number(OTHER, "offset_us", "@", HEARD),
    number("noise", "noise_figure_db", "@", Usual),
    number("noise", "temperature_k", "@", Usual),
    number("noise", "snr_db", "@", SNR),
    number("dsp", "range_window", "\"chebyshev-@\"", Usual),
    number("dsp", "false_alarm_rate", "@", Usual),
    number("dsp", "false_alarm_rate", "@", RANKED),
    number("dsp", "false_alarm_rate", "@", GREATEST),
    number("dsp", "guard_cells", "[@, 1]", Usual),
    number("dsp", "training_cells", "[1, @]", Usual),
    number("dsp", "assumed_height_m", "@", Usual),
    number("dsp", "nearest_m", "@", Usual),
    number("dsp", "cluster_range_m", "@", Usual),
    number("dsp", "cluster_velocity_mps", "@", Usual),
    number("dsp", "cluster_cross_m", "@", Usual),
    number("fidelity", "accuracy_db", "@", MESH),
    number("fidelity", "bounces", "@", MESH),
    number("fidelity", "measured_every", "@", MESH),
    number("materials", "paint", "{ permittivity = [@, 0.1], thickness_mm = 1 }", SKIN),
    number("materials", "paint", "{ permittivity = [3, @] }", SKIN),
    number("materials", "paint", "{ substance = \"glass\", thickness_mm = @ }", SKIN),
    number(
        "materials",
        "paint",
        "{ layers = [{ substance = \"glass\", thickness_mm = @ }], coherent = false }",
        SKIN,
    ),
    number("materials", "paint", "{ layers = [{ permittivity = [2, @], thickness_mm = 1 }] }", SKIN),
    number(INTERSECTION, "lane_centres_m", "[2, @]", LANE),
    number(INTERSECTION, "lane_width_m", "@", LANE),
    number(INTERSECTION, "lane_origin_m", "[@, 0]", LANE),
    number(INTERSECTION, "lane_azimuth_deg", "@", LANE),
    number(INTERSECTION, "crossing_width_m", "@", Usual),
    number(SEEN, "lane_centres_m", "[@]", Usual),
    number(SEEN, "lane_width_m", "@", LANE),
    number(SEEN, "lane_origin_m", "[0, @]", Usual),
    number(SEEN, "lane_azimuth_deg", "@", Usual),
    number("road", "permittivity", "[@, 0.3]", MESH),
    number("road", "rms_height_mm", "@", MESH),
    number("road", "backscatter_gamma_db", "@", FLOOR),
    number(BODY, "position_m", "[@, 20, 1]", Usual),
    number(BODY, "position_m", "[2, @, 1]", MESH),
    number(BODY, "position_m", "[2, 20, @]", MESH),
    number(BODY, "lane", "@", LANE),
    number(BODY, "y_m", "@", LANE),
    number(BODY, "velocity_mps", "[0, @, 0]", Usual),
    number(BODY, "velocity_mps", "[@, -3, 0]", MESH),
    number(BODY, "acceleration_mps2", "[@, 0, 0]", Usual),
    number(BODY, "yaw_deg", "@", MESH),
    number(BODY, "yaw_rate_dps", "@", MESH),
    number(BODY, "vehicle_seed", "@", VEHICLE),
    number(BODY, "unit_scale", "@", MESH),
    number(BODY, "rcs_m2", "@", Usual),
    number(BODY, "wheel_radius_m", "@", WHEEL),
    number(BODY, "wheel_angle_deg", "@", WHEEL),
    number(PIECE, "position_m", "[@, 20, 0]", ROD),
    number(PIECE, "yaw_deg", "@", ROD),
    number(PIECE, "height_m", "@", ROD),
    number(PIECE, "diameter_m", "@", ROD),
    number(PIECE, "length_m", "@", KERB),
    number(PIECE, "unit_scale", "@", FILE),
    number("traffic", "begin_s", "@", TRAFFIC),
    number("traffic", "end_s", "@", TRAFFIC),
    number("traffic", "begin_s", "@", FEW),
    number("traffic", "view_range_m", "@", TRAFFIC),
    number("traffic", "view_nearest_m", "@", TRAFFIC),
    number("traffic", "view_half_angle_deg", "@", TRAFFIC),
    number("traffic", "models", "{ car = { model = \"car-suv\", vehicle_seed = @ } }", FEW),
    number("traffic", "models", "{ car = { model = \"sheet.obj\", unit_scale = @ } }", FEW),
];

/// Text of a scene file with that number set to `value`.
pub(crate) fn scene_with(number: &Number, value: &str) -> String {
    let mut keys: Vec<(&str, &str, String)> = vec![];
    let mut set = |table, key, value: String| {
        keys.retain(|(t, k, _): &(&str, &str, String)| (*t, *k) != (table, key));
        if !value.is_empty() {
            keys.push((table, key, value));
        }
    };
    for (table, key, value) in SCENE.into_iter().chain([POINT]) {
        set(table, key, value.to_owned());
    }
    if let With(beside) = number.beside {
        beside.iter().for_each(|(table, key, value)| set(table, key, (*value).to_owned()));
    }
    set(number.table, number.key, number.written.replace('@', value));
    let mut tables: Vec<&str> = vec![];
    for (table, ..) in &keys {
        if !tables.contains(table) {
            tables.push(table);
        }
    }
    // What stands in no table comes first; a table stands before those within it.
    tables.sort_by_key(|table| table.trim_start_matches('[').to_owned());
    let of = |table: &&str| {
        keys.iter().filter(|(t, ..)| t == table).map(|(_, k, v)| format!("{k} = {v}\n")).collect::<String>()
    };
    let heading = |table: &&str| if table.is_empty() { String::new() } else { format!("[{table}]\n") };
    tables.iter().map(|table| heading(table) + &of(table)).collect()
}
