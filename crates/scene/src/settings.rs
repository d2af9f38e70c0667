//! `[noise]`, `[dsp]`, `[fidelity]` and `[intersection]`.

use crate::document::errors::{MapAxis, Rule};
use crate::document::keys;
use crate::document::ranges::COORDINATES_M;
use crate::document::section::Section;
use crate::measured::calibration::read_calibration;
use crate::models::library::Models;
use crate::wording::allowed::Allowed;
use artifact::Accuracy;
use artifact::paths::MAX_ORDER;
use artifact::radar::{Radar, Sampling};
use artifact::scene::Intersection;
use artifact::settings::{
    Angle, BetweenBodies, Detail, Detector, DspSettings, EchoMode, Edges, FALSE_ALARM_RATES, Fidelity, Lane,
    Lanes, NodeRule, Noise, Refine, Sides, StaticEchoes, Surface, Window,
};
use num_complex::Complex64;

/// Of Table 1.
const LANE_WIDTH_M: f64 = 3.75;

/// The receiver's noise; absent without `[noise]`.
pub(crate) fn read_noise(root: &Section<'_>) -> Noise {
    let section = root.section(&keys::NOISE);
    if !section.exists() {
        return Noise::Absent;
    }
    let figure_db = section.number("noise_figure_db", Allowed::Between(0.0, 100.0));
    let temperature_k = section.number("temperature_k", Allowed::Above(0.0, 1e6)).unwrap_or(290.0);
    let snr_db = section.number("snr_db", Allowed::Between(-200.0, 200.0));
    for key in ["noise_figure_db", "temperature_k"] {
        if section.has("snr_db") && section.has(key) {
            section.note(key, Rule::Contradiction { key, other: "snr_db" });
        }
    }
    if !section.has("snr_db") {
        section.require("noise_figure_db");
    }
    match (figure_db, snr_db) {
        (Some(noise_figure_db), _) => Noise::Figure { noise_figure_db, temperature_k },
        (None, Some(snr_db)) => Noise::SnrDb(snr_db),
        (None, None) => Noise::Absent,
    }
}

const ALARM_RATES: Allowed = Allowed::Between(*FALSE_ALARM_RATES.start(), *FALSE_ALARM_RATES.end());

const DETECTORS: [(&str, Detector); 4] = [
    ("ca-cfar", Detector::CaCfar),
    ("go-cfar", Detector::GoCfar),
    ("so-cfar", Detector::SoCfar),
    ("os-cfar", Detector::OsCfar),
];

/// Signal processing for a map of this waveform.
pub(crate) fn read_dsp(root: &Section<'_>, radar: &Radar, road: Lanes, models: &mut Models) -> DspSettings {
    let (section, waveform) = (root.section(&keys::DSP), &radar.waveform);
    let map = [waveform.chirps, waveform.range_cells() as u32];
    if waveform.sampling == Sampling::Real && section.text("refine") == Some("on") {
        section.note("refine", Rule::Contradiction { key: "refine", other: "sampling = \"real\"" });
    }
    let guard_cells = read_cells(&section, "guard_cells").unwrap_or(fitting(map, [0, 0], [2, 2]));
    // 13 × 21 cells less 5 × 5 of guard: 248 training cells, a CFAR loss of about 0.1 dB at 1e-5 (Richards
    // 2014).
    let training_cells = read_cells(&section, "training_cells").unwrap_or(fitting(map, guard_cells, [4, 8]));
    check_window(&section, map, guard_cells, training_cells);
    let distance = Allowed::Above(0.0, 1e3);
    DspSettings {
        range_window: read_window(&section, "range_window"),
        doppler_window: read_window(&section, "doppler_window"),
        detector: section.word("detector", &DETECTORS).unwrap_or(Detector::CaCfar),
        false_alarm_rate: section.number("false_alarm_rate", ALARM_RATES).unwrap_or(1e-5),
        guard_cells,
        training_cells,
        angle: section
            .word("angle", &[("fft", Angle::Fft), ("max-likelihood", Angle::MaximumLikelihood)])
            .unwrap_or(Angle::Fft),
        refine: section
            .word("refine", &[("off", Refine::Off), ("on", Refine::Isolated)])
            .unwrap_or(Refine::Off),
        calibration: read_factors(&section, radar, models).unwrap_or_default(),
        static_echoes: section
            .word(
                "static",
                &[StaticEchoes::Keep, StaticEchoes::Mark, StaticEchoes::Remove].map(|s| (s.name(), s)),
            )
            .unwrap_or(StaticEchoes::Keep),
        assumed_height_m: section.number("assumed_height_m", Allowed::Between(-100.0, 100.0)).unwrap_or(0.75),
        // Gaps between the glints of one long vehicle, against the gap that drivers keep (docs/scenes.md).
        cluster_range_m: section.number("cluster_range_m", distance).unwrap_or(2.5),
        cluster_velocity_mps: section.number("cluster_velocity_mps", distance).unwrap_or(1.0),
        cluster_cross_m: section.number("cluster_cross_m", distance).unwrap_or(2.5),
        road,
    }
}

fn read_factors(section: &Section<'_>, radar: &Radar, models: &mut Models) -> Option<Vec<Complex64>> {
    let file = models.file_beside(section.text("calibration")?);
    let elements = [radar.array.tx_m.len(), radar.array.rx_m.len()];
    read_calibration(&file, elements)
        .map_err(|error| section.note("calibration", Rule::Calibration(error)))
        .ok()
}

/// [doppler, range].
fn read_cells(section: &Section<'_>, key: &'static str) -> Option<[u32; 2]> {
    section.counts(key, Allowed::Between(0.0, 65536.0)).map(|cells: [u64; 2]| cells.map(|count| count as u32))
}

/// The defaults as far as the map holds them beside `inner` cells on each side: a map of few chirps is no
/// error.
fn fitting(map: [u32; 2], inner: [u32; 2], wanted: [u32; 2]) -> [u32; 2] {
    let room = |axis: usize| ((map[axis].saturating_sub(1)) / 2).saturating_sub(inner[axis]);
    [wanted[0].min(room(0)), wanted[1].min(room(1))]
}

fn check_window(section: &Section<'_>, map: [u32; 2], guard: [u32; 2], training: [u32; 2]) {
    let key = if section.has("training_cells") { "training_cells" } else { "guard_cells" };
    for (i, axis) in [MapAxis::Doppler, MapAxis::Range].into_iter().enumerate() {
        let needed = 2 * (u64::from(guard[i]) + u64::from(training[i])) + 1;
        let cells = u64::from(map[i]);
        if needed > cells {
            section.note(key, Rule::WindowTooLarge { axis, needed, cells });
        }
    }
    if training == [0, 0] {
        section.note(key, Rule::NoTrainingCells);
    }
}

fn read_window(section: &Section<'_>, key: &'static str) -> Window {
    const NAMES: [&str; 5] = ["rect", "hann", "hamming", "blackman", "chebyshev-80"];
    let Some(name) = section.text(key) else { return Window::Hann };
    let window = match name {
        "rect" => Some(Window::Rect),
        "hann" => Some(Window::Hann),
        "hamming" => Some(Window::Hamming),
        "blackman" => Some(Window::Blackman),
        other => chebyshev(other),
    };
    if window.is_none() {
        section.unknown_word(key, name, NAMES.to_vec());
    }
    window.unwrap_or(Window::Hann)
}

/// `chebyshev-80`: sidelobes from 20 dB down, where the taper is hardly one, to 200 dB, where f64 ends.
fn chebyshev(name: &str) -> Option<Window> {
    let level_db: f64 = name.strip_prefix("chebyshev-")?.parse().ok()?;
    (20.0..=200.0).contains(&level_db).then_some(Window::Chebyshev(level_db))
}

/// Accuracy and physics asked for.
pub(crate) fn read_fidelity(root: &Section<'_>) -> Fidelity {
    let section = root.section(&keys::FIDELITY);
    let accuracy_db = section.number("accuracy_db", Allowed::Below(-120.0, 0.0)).unwrap_or(-20.0);
    Fidelity {
        accuracy: Accuracy::from_db(accuracy_db),
        bounces: section.integer("bounces", Allowed::Between(1.0, MAX_ORDER as f64)).unwrap_or(3) as u8,
        edges: section
            .word("edges", &[("off", Edges::Ignored), ("on", Edges::FirstOrder)])
            .unwrap_or(Edges::Ignored),
        surface: section
            .word("surface", &[("flat", Surface::Flat), ("smooth", Surface::Smooth)])
            .unwrap_or(Surface::Flat),
        sides: section.word("sides", &[("two", Sides::Two), ("one", Sides::One)]).unwrap_or(Sides::Two),
        nodes: section
            .word(
                "nodes",
                &[("middle", NodeRule::Middle), ("exit", NodeRule::Exit), ("own-edge", NodeRule::OwnEdge)],
            )
            .unwrap_or(NodeRule::OwnEdge),
        echo: section
            .word("echo", &[("paths", EchoMode::Paths), ("rcs-table", EchoMode::RcsTable)])
            .unwrap_or(EchoMode::Paths),
        detail: section
            .word(
                "detail",
                &[Detail::Auto, Detail::Paths, Detail::Merged, Detail::Centres, Detail::Statistical]
                    .map(|d| (d.name(), d)),
            )
            .unwrap_or(Detail::Paths),
        between_bodies: section
            .word(
                "between_bodies",
                &[("traced", BetweenBodies::Traced), ("left-out", BetweenBodies::LeftOut)],
            )
            .unwrap_or_default(),
        measured_every: section.integer("measured_every", Allowed::Between(1.0, 1e6)).unwrap_or(1) as u32,
    }
}

/// The crossing and its lanes: the paper's Table 1 where the scene says nothing, but none beside recorded
/// traffic, which has a road of its own. Without lanes the road runs where the radar looks.
pub(crate) fn read_intersection(root: &Section<'_>, radar: &Radar) -> (Intersection, Lanes) {
    let section = root.section(&keys::INTERSECTION);
    let is_table_1 = section.exists() || !root.has("traffic");
    let lane = |(number, centre_m)| Lane { number, centre_m, width_m: LANE_WIDTH_M };
    let lanes = if is_table_1 { [(1, 2.0), (2, 5.75), (3, 9.5)].map(lane).to_vec() } else { vec![] };
    let default_m = if is_table_1 { 22.5 } else { 0.0 };
    let width_m = section.number("crossing_width_m", Allowed::Between(0.0, 1e3)).unwrap_or(default_m);
    (Intersection { width_m }, read_road(&section, radar, &Lanes { lanes, ..Lanes::default() }))
}

/// The lanes that one radar is to tell by, where they are others than the scene's.
pub(crate) fn read_own_road(radar_section: &Section<'_>, radar: &Radar, scenes: &Lanes) -> Lanes {
    read_road(&radar_section.section(&keys::RADAR_INTERSECTION), radar, scenes)
}

fn read_road(section: &Section<'_>, radar: &Radar, default: &Lanes) -> Lanes {
    let width_m = section.number("lane_width_m", Allowed::Above(0.0, 100.0));
    let width_m = width_m.unwrap_or(default.lanes.first().map_or(LANE_WIDTH_M, |lane| lane.width_m));
    let centres = section.numbers("lane_centres_m", Allowed::Between(0.0, 32.0), Allowed::Between(-1e3, 1e3));
    let centres = centres.unwrap_or(default.lanes.iter().map(|lane| lane.centre_m).collect());
    if section.exists() {
        check_lanes(section, &centres, width_m);
    }
    let lanes: Vec<Lane> =
        centres.iter().zip(1..).map(|(m, number)| Lane { number, centre_m: *m, width_m }).collect();
    let [x_m, y_m, _] = radar.position_m;
    let (origin_m, azimuth_rad) = match lanes[..] {
        [] => ([x_m, y_m], radar.boresight_az_rad),
        _ => (default.origin_m, default.azimuth_rad),
    };
    let azimuth_deg = section.number("lane_azimuth_deg", Allowed::Between(-360.0, 360.0));
    Lanes {
        origin_m: section.vector("lane_origin_m", COORDINATES_M).unwrap_or(origin_m),
        azimuth_rad: azimuth_deg.map_or(azimuth_rad, f64::to_radians),
        lanes,
        courses: vec![],
    }
}

fn check_lanes(section: &Section<'_>, centres: &[f64], width_m: f64) {
    // Lanes that touch, as the paper's do, may miss by the rounding of their decimals.
    let rounding_m = 1e-9;
    for (i, x) in centres.iter().enumerate() {
        for (j, y) in centres.iter().enumerate().skip(i + 1) {
            let distance_m = (x - y).abs();
            if distance_m < width_m - rounding_m {
                section.note(
                    "lane_centres_m",
                    Rule::LanesOverlap { first: i + 1, second: j + 1, distance_m, width_m },
                );
            }
        }
    }
}
