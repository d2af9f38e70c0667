//! `[noise]`, `[dsp]`, `[fidelity]` and `[intersection]`.

pub(crate) mod physics_keys; // physics that a file specifies

use crate::document::errors::{MapAxis, Rule};
use crate::document::keys::fidelity::{
    ACCURACY, BETWEEN_BODIES, BOUNCES, DETAIL, ECHO, EDGES, FOR, MEASURED_EVERY, NODES, PLAN, SIDES,
    SMALL_PARTS, SURFACE, WHEELS,
};
use crate::document::keys::key::{DefaultValue, Key};
use crate::document::keys::kinds::IntegerVector;
use crate::document::keys::lanes::{
    CROSSING_WIDTH, INTERSECTION, LANE_AZIMUTH, LANE_CENTRES, LANE_ORIGIN, LANE_WIDTH, RADAR_INTERSECTION,
};
use crate::document::keys::processing::{
    ANGLE, ASSUMED_HEIGHT, CALIBRATION, CLUSTER, CLUSTER_CROSS, CLUSTER_RANGE, CLUSTER_VELOCITY, DETECTOR,
    DOPPLER_WINDOW, DSP, FALSE_ALARM_RATE, GUARD_CELLS, NEAREST, NOISE, NOISE_FIGURE, RANGE_WINDOW, REFINE,
    SNR, STATIC, TEMPERATURE, TRAINING_CELLS,
};
use crate::document::keys::scene::TRAFFIC_KEY;
use crate::document::section::Section;
use crate::measured::calibration::read_calibration;
use crate::models::library::Models;
use artifact::Accuracy;
use artifact::goal::Goal;
use artifact::radar::{Radar, Sampling};
use artifact::scene::Intersection;
use artifact::settings::{
    DspSettings, EchoMode, Fidelity, Lane, Lanes, Noise, Refine, Sides, SmallParts, Wheels,
};
use num_complex::Complex64;

/// The receiver's noise; absent without `[noise]`.
pub(crate) fn read_noise(root: &Section<'_>) -> Noise {
    let section = root.section(&NOISE);
    if !section.exists() {
        return Noise::Absent;
    }
    let (figure_db, snr_db) = (section.read(&NOISE_FIGURE), section.read(&SNR));
    let temperature_k = section.or_default(&TEMPERATURE);
    for key in [NOISE_FIGURE.name, TEMPERATURE.name] {
        if section.has(SNR.name) && section.has(key) {
            section.note(key, Rule::Contradiction { key, other: SNR.name });
        }
    }
    if !section.has(SNR.name) {
        section.require(NOISE_FIGURE.name);
    }
    match (figure_db, snr_db) {
        (Some(noise_figure_db), _) => Noise::Figure { noise_figure_db, temperature_k },
        (None, Some(snr_db)) => Noise::SnrDb(snr_db),
        (None, None) => Noise::Absent,
    }
}

/// Reads the signal processing for a map of this waveform.
pub(crate) fn read_dsp(root: &Section<'_>, radar: &Radar, road: Lanes, models: &mut Models) -> DspSettings {
    let (section, waveform) = (root.section(&DSP), &radar.waveform);
    let map = [waveform.chirps, waveform.range_cells() as u32];
    let refine = section.or_default(&REFINE);
    if waveform.sampling == Sampling::Real && refine == Refine::Isolated {
        section.note(REFINE.name, Rule::Contradiction { key: REFINE.name, other: "sampling = \"real\"" });
    }
    let [guard_cells, training_cells] = read_window(&section, map);
    check_window(&section, map, guard_cells, training_cells);
    let reach = section.or_default(&CLUSTER);
    DspSettings {
        range_window: section.or_default(&RANGE_WINDOW),
        doppler_window: section.or_default(&DOPPLER_WINDOW),
        detector: section.or_default(&DETECTOR),
        false_alarm_rate: section.or_default(&FALSE_ALARM_RATE),
        guard_cells,
        training_cells,
        angle: section.or_default(&ANGLE),
        refine,
        calibration: read_factors(&section, radar, models).unwrap_or_default(),
        static_echoes: section.or_default(&STATIC),
        nearest_m: section.or_default(&NEAREST),
        assumed_height_m: section.or_default(&ASSUMED_HEIGHT),
        cluster_range_m: section.read(&CLUSTER_RANGE).unwrap_or(reach.range_m),
        cluster_velocity_mps: section.or_default(&CLUSTER_VELOCITY),
        cluster_cross_m: section.read(&CLUSTER_CROSS).unwrap_or(reach.cross_m),
        road,
    }
}

fn read_factors(section: &Section<'_>, radar: &Radar, models: &mut Models) -> Option<Vec<Complex64>> {
    let file = models.add_input(section.read(&CALIBRATION)?);
    let elements = [radar.array.tx_m.len(), radar.array.rx_m.len()];
    read_calibration(&file, elements)
        .map_err(|error| section.note(CALIBRATION.name, Rule::Calibration(error)))
        .ok()
}

/// Guard and training cells, each [doppler, range]; defaults as far as the map can hold them: a map of few
/// chirps is no error, and if it holds only the guard, one cell of it becomes a training cell.
fn read_window(section: &Section<'_>, map: [u32; 2]) -> [[u32; 2]; 2] {
    let read = |key: &Key<IntegerVector<2>, DefaultValue<[u64; 2]>>| {
        section.read(key).map(|cells| cells.map(|n| n as u32))
    };
    let (guard, training) = (read(&GUARD_CELLS), read(&TRAINING_CELLS));
    let fitting = |default: [u64; 2], inner: [u32; 2]| -> [u32; 2] {
        let room = |axis: usize| (map[axis].saturating_sub(1) / 2).saturating_sub(inner[axis]);
        std::array::from_fn(|axis| room(axis).min(default[axis] as u32))
    };
    let beyond = |guard: [u32; 2]| training.unwrap_or(fitting(TRAINING_CELLS.absent.0, guard));
    let [doppler, range] = fitting(GUARD_CELLS.absent.0, [0, 0]);
    let is_all = beyond([doppler, range]) == [0, 0];
    let guard = guard.unwrap_or([doppler, if is_all { range.saturating_sub(1) } else { range }]);
    [guard, beyond(guard)]
}

fn check_window(section: &Section<'_>, map: [u32; 2], guard: [u32; 2], training: [u32; 2]) {
    let key = if section.has(TRAINING_CELLS.name) { TRAINING_CELLS.name } else { GUARD_CELLS.name };
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

/// Reads accuracy and physics from the sections `[fidelity]` and `[model]`.
pub(crate) fn read_fidelity(section: &Section<'_>, model: &Section<'_>) -> Fidelity {
    let (accuracy, goal) = read_accuracy(section);
    let (echo, wheels) = (section.or_default(&ECHO), section.or_default(&WHEELS));
    check_wheels(section, wheels, echo);
    // Checked here; `physics_keys.rs` reads from the file itself, before the choice, who chooses.
    let _ = section.or_default(&PLAN);
    Fidelity {
        accuracy,
        goal,
        bounces: section.or_default(&BOUNCES) as u8,
        edges: section.or_default(&EDGES),
        surface: section.or_default(&SURFACE),
        sides: section.or_default(&SIDES),
        nodes: section.or_default(&NODES),
        echo,
        detail: section.or_default(&DETAIL),
        small_parts: read_small_parts(model, echo),
        between_bodies: section.or_default(&BETWEEN_BODIES),
        wheels,
        measured_every: section.or_default(&MEASURED_EVERY) as u32,
    }
}

/// Reads the source of small parts; they are drawn for paths alone.
fn read_small_parts(model: &Section<'_>, echo: EchoMode) -> SmallParts {
    let small_parts = model.or_default(&SMALL_PARTS);
    if (small_parts, echo) == (SmallParts::Statistical, EchoMode::RcsTable) {
        model.note(
            SMALL_PARTS.name,
            Rule::Contradiction { key: SMALL_PARTS.name, other: "echo = \"rcs-table\"" },
        );
    }
    small_parts
}

/// Refuses turning wheels with tables, for which a body must be rigid during a frame.
fn check_wheels(section: &Section<'_>, wheels: Wheels, echo: EchoMode) {
    if (wheels, echo) == (Wheels::Turning, EchoMode::RcsTable) {
        section.note(WHEELS.name, Rule::Contradiction { key: WHEELS.name, other: "echo = \"rcs-table\"" });
    }
}

/// Refuses settings that do not go with a reflecting road: its images light both sides of facets, and tables
/// treat bodies alone.
pub(crate) fn check_with_road(section: &Section<'_>, fidelity: &Fidelity) {
    let excluded = |key: &'static str| section.note(key, Rule::Contradiction { key, other: "[road]" });
    if fidelity.sides == Sides::One {
        excluded(SIDES.name);
    }
    if fidelity.echo == EchoMode::RcsTable {
        excluded(ECHO.name);
    }
}

/// Accuracy as a number, or as the need of a result; not both.
fn read_accuracy(section: &Section<'_>) -> (Accuracy, Option<Goal>) {
    let (asked, goal) = (Accuracy::from_db(section.or_default(&ACCURACY)), section.read(&FOR));
    if section.has(FOR.name) && section.has(ACCURACY.name) {
        section.note(FOR.name, Rule::Contradiction { key: FOR.name, other: ACCURACY.name });
    }
    (goal.map_or(asked, Goal::accuracy), goal)
}

/// Lanes of a scene or of one of its radars, and the width of lanes that set none.
pub(crate) struct RoadLanes {
    pub(crate) lanes: Lanes,
    lane_width_m: f64,
}

/// Reads the crossing and its lanes: by default those of the paper's Table 1, but none with recorded traffic,
/// which has its own road. Without lanes the road runs along the radar's boresight.
pub(crate) fn read_intersection(root: &Section<'_>, radar: &Radar) -> (Intersection, RoadLanes) {
    let section = root.section(&INTERSECTION);
    let is_table_1 = section.exists() || !root.has(TRAFFIC_KEY.name);
    let lane_width_m = LANE_WIDTH.absent.0;
    let lane = |(centre_m, number): (&f64, u8)| Lane { number, centre_m: *centre_m, width_m: lane_width_m };
    let table_1 = LANE_CENTRES.absent.0.iter().zip(1..).map(lane);
    let lanes = if is_table_1 {
        Lanes { lanes: table_1.collect(), ..Lanes::default() }
    } else {
        along_boresight(radar)
    };
    let default_m = if is_table_1 { CROSSING_WIDTH.absent.0 } else { 0.0 };
    let width_m = section.read(&CROSSING_WIDTH).unwrap_or(default_m);
    (Intersection { width_m }, read_road(&section, radar, &RoadLanes { lanes, lane_width_m }))
}

/// The lanes that one radar uses, if they differ from the scene's.
pub(crate) fn read_own_road(radar_section: &Section<'_>, radar: &Radar, scenes: &RoadLanes) -> Lanes {
    read_road(&radar_section.section(&RADAR_INTERSECTION), radar, scenes).lanes
}

/// A road without lanes, from the radar along its boresight.
fn along_boresight(radar: &Radar) -> Lanes {
    let [x_m, y_m, _] = radar.position_m;
    Lanes { origin_m: [x_m, y_m], azimuth_rad: radar.boresight_az_rad, ..Lanes::default() }
}

/// Lanes of a section, where it sets them; a section that takes all lanes away leaves a road along the
/// boresight.
fn read_road(section: &Section<'_>, radar: &Radar, default: &RoadLanes) -> RoadLanes {
    let RoadLanes { lanes: default, lane_width_m } = default;
    let width_m = section.read(&LANE_WIDTH).unwrap_or(*lane_width_m);
    let centres = section.read(&LANE_CENTRES);
    let centres = centres.unwrap_or(default.lanes.iter().map(|lane| lane.centre_m).collect());
    if section.exists() {
        check_lanes(section, &centres, width_m);
    }
    let lanes: Vec<Lane> =
        centres.iter().zip(1..).map(|(m, number)| Lane { number, centre_m: *m, width_m }).collect();
    let are_taken_away = lanes.is_empty() && !default.lanes.is_empty();
    let road = if are_taken_away { along_boresight(radar) } else { default.clone() };
    let azimuth_deg = section.read(&LANE_AZIMUTH);
    let lanes = Lanes {
        origin_m: section.read(&LANE_ORIGIN).unwrap_or(road.origin_m),
        azimuth_rad: azimuth_deg.map_or(road.azimuth_rad, f64::to_radians),
        lanes,
        courses: vec![],
    };
    RoadLanes { lanes, lane_width_m: width_m }
}

fn check_lanes(section: &Section<'_>, centres: &[f64], width_m: f64) {
    // Adjacent lanes, like the paper's, may overlap by the rounding of their decimals.
    let rounding_m = 1e-9;
    for (i, x) in centres.iter().enumerate() {
        for (j, y) in centres.iter().enumerate().skip(i + 1) {
            let distance_m = (x - y).abs();
            if distance_m < width_m - rounding_m {
                section.note(
                    LANE_CENTRES.name,
                    Rule::LanesOverlap { first: i + 1, second: j + 1, distance_m, width_m },
                );
            }
        }
    }
}
