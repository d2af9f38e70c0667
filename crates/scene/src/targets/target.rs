//! `[[target]]`: vehicles and points, where they are and how they move.

use crate::document::errors::Rule;
use crate::document::ids::read_ids;
use crate::document::keys::bodies::{
    ACCELERATION, Body, CLASS, CLUTTER, KIND, LANE, MODEL, POSITION, RCS, TARGET, UNIT_SCALE, VEHICLE_SEED,
    VELOCITY, WHEEL_ANGLE, WHEEL_RADIUS, Y, YAW, YAW_RATE,
};
use crate::document::section::Section;
use crate::models::library::Models;
use crate::targets::clutter::read_clutter;
use artifact::radar::Radar;
use artifact::scene::{Pose, Role, Target, TargetKind, Wheel};
use artifact::settings::{EchoMode, Lanes};
use glam::DVec3;

/// The scene's targets, then its clutter; those that break a rule are noted and left out.
pub(crate) fn read_targets(
    root: &Section<'_>,
    radar: &Radar,
    (road, echo): (&Lanes, EchoMode),
    models: &mut Models,
) -> Vec<Target> {
    let (sections, clutter) = (root.sections(&TARGET), root.sections(&CLUTTER));
    let ids = read_ids(&[&sections[..], &clutter[..]].concat());
    let (ids, ids_of_clutter) = ids.split_at(sections.len());
    let targets = sections.iter().zip(ids).filter_map(|(section, id)| {
        let target = read_target(section, *id, road, models)?;
        check_distance(section, radar, &target);
        check_wheel(section, echo);
        Some(target)
    });
    let mut targets: Vec<Target> = targets.collect();
    targets.extend(read_clutter(&clutter, ids_of_clutter, models));
    targets
}

fn read_target(section: &Section<'_>, id: Option<&str>, road: &Lanes, models: &mut Models) -> Option<Target> {
    section.require(KIND.name);
    let kind = section.read(&KIND);
    let start = read_pose(section, road);
    let kind = match kind? {
        Body::Mesh => read_mesh_target(section, models),
        Body::Point => read_point_target(section),
    };
    Some(Target { id: id?.to_owned(), role: Role::Target, kind: kind?, start: start? })
}

/// A point within a wavelength of an element has no far field there: its echo means nothing.
fn check_distance(section: &Section<'_>, radar: &Radar, target: &Target) {
    if !matches!(target.kind, TargetKind::Point { wheel: None, .. }) {
        return;
    }
    let place_m = DVec3::from(target.start.position_m);
    let elements = radar.array.tx_m.iter().chain(&radar.array.rx_m);
    let distance_m =
        elements.map(|element| place_m.distance((*element).into())).fold(f64::INFINITY, f64::min);
    let wavelength_m = radar.waveform.wavelength_m();
    if distance_m < wavelength_m {
        let key = if section.has(POSITION.name) { POSITION.name } else { Y.name };
        section.note(key, Rule::AtTheAntenna { distance_m, wavelength_m });
    }
}

/// A table answers from the place that a body's pose tells, the hub of a wheel: nothing in it goes round.
fn check_wheel(section: &Section<'_>, echo: EchoMode) {
    if section.has(WHEEL_RADIUS.name) && echo == EchoMode::RcsTable {
        let (key, other) = (WHEEL_RADIUS.name, "echo = \"rcs-table\"");
        section.note(key, Rule::Contradiction { key, other });
    }
}

fn read_mesh_target(section: &Section<'_>, models: &mut Models) -> Option<TargetKind> {
    misplaced(section, &[RCS.name, WHEEL_RADIUS.name, WHEEL_ANGLE.name], "a mesh target");
    let class = section.read(&CLASS);
    let chosen = models.choose(section)?;
    Some(TargetKind::Mesh { class: class.or(chosen.class), model: chosen.name, mesh: chosen.mesh })
}

fn read_point_target(section: &Section<'_>) -> Option<TargetKind> {
    misplaced(
        section,
        &[CLASS.name, MODEL.name, VEHICLE_SEED.name, UNIT_SCALE.name, YAW_RATE.name],
        "a point target",
    );
    if !section.has(WHEEL_RADIUS.name) {
        misplaced(section, &[YAW.name], "a point target that is on no wheel");
    }
    section.require(RCS.name);
    let wheel = read_wheel(section);
    let rcs_m2 = section.read(&RCS)?;
    Some(TargetKind::Point { rcs_m2, wheel })
}

/// A point on the rim of a wheel, whose hub the target's position is.
fn read_wheel(section: &Section<'_>) -> Option<Wheel> {
    let (key, companion) = (WHEEL_ANGLE.name, WHEEL_RADIUS.name);
    if section.has(key) && !section.has(companion) {
        section.note(key, Rule::Alone { key, companion });
    }
    let angle_deg = section.or_default(&WHEEL_ANGLE);
    let radius_m = section.read(&WHEEL_RADIUS)?;
    Some(Wheel { radius_m, angle_rad: angle_deg.to_radians() })
}

fn misplaced(section: &Section<'_>, keys: &[&'static str], owner: &'static str) {
    for key in keys.iter().filter(|key| section.has(key)) {
        section.note(key, Rule::Misplaced { key, owner });
    }
}

fn read_pose(section: &Section<'_>, road: &Lanes) -> Option<Pose> {
    let position_m = read_position(section, road);
    let velocity_mps = section.or_default(&VELOCITY);
    let acceleration_mps2 = section.or_default(&ACCELERATION);
    let yaw = section.read(&YAW).map(f64::to_radians);
    let yaw_rad = yaw.unwrap_or(yaw_along(velocity_mps));
    let yaw_radps = section.or_default(&YAW_RATE).to_radians();
    Some(Pose { position_m: position_m?, yaw_rad, yaw_radps, velocity_mps, acceleration_mps2 })
}

/// Yaw of a body that faces the way it moves; at rest it faces the radar, down the lane.
fn yaw_along([vx, vy, _]: [f64; 3]) -> f64 {
    if vx == 0.0 && vy == 0.0 { -std::f64::consts::FRAC_PI_2 } else { vy.atan2(vx) }
}

/// `position_m`, or `lane` with `y_m` along it.
fn read_position(section: &Section<'_>, road: &Lanes) -> Option<[f64; 3]> {
    let position_m = section.read(&POSITION);
    let lane = section.read(&LANE);
    let y_m = section.read(&Y);
    let other = [LANE.name, Y.name].into_iter().find(|key| section.has(key));
    if let Some(key) = other.filter(|_| section.has(POSITION.name)) {
        section.note(key, Rule::Contradiction { key, other: POSITION.name });
        return None;
    }
    match (section.has(LANE.name), section.has(Y.name)) {
        (true, false) => section.note(LANE.name, Rule::Alone { key: LANE.name, companion: Y.name }),
        (false, true) => section.note(Y.name, Rule::Alone { key: Y.name, companion: LANE.name }),
        (false, false) => section.require(POSITION.name),
        (true, true) => {}
    }
    position_m.or_else(|| {
        let [x_m, y_m] = road.world_m([lane_centre_m(section, road, lane?)?, y_m?]);
        Some([x_m, y_m, 0.0])
    })
}

fn lane_centre_m(section: &Section<'_>, road: &Lanes, lane: u64) -> Option<f64> {
    let found = road.lanes.iter().find(|known| u64::from(known.number) == lane);
    match (found, road.lanes.len()) {
        (Some(_), _) => {}
        (None, 0) => section.note(LANE.name, Rule::NoLanes(lane)),
        (None, lanes) => section.note(LANE.name, Rule::UnknownLane { lane, lanes }),
    }
    found.map(|lane| lane.centre_m)
}
