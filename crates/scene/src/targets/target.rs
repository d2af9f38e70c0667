//! `[[target]]`: vehicles and points, where they are and how they move.

use crate::document::errors::Rule;
use crate::document::ids::read_ids;
use crate::document::keys;
use crate::document::ranges::{COORDINATES_M, VELOCITIES_MPS};
use crate::document::section::Section;
use crate::models::library::Models;
use crate::targets::clutter::read_clutter;
use crate::wording::allowed::Allowed;
use artifact::radar::Radar;
use artifact::scene::{Pose, Role, Target, TargetKind, Wheel};
use artifact::settings::{Class, Lanes};
use glam::DVec3;

/// Ten times what brakes and falls.
const ACCELERATIONS_MPS2: Allowed = Allowed::Between(-100.0, 100.0);

#[derive(Clone, Copy)]
enum Kind {
    Mesh,
    Point,
}

/// The scene's targets, then its clutter; those that break a rule are noted and left out.
pub(crate) fn read_targets(
    root: &Section<'_>,
    radar: &Radar,
    road: &Lanes,
    models: &mut Models,
) -> Vec<Target> {
    let (sections, clutter) = (root.sections(&keys::TARGET), root.sections(&keys::CLUTTER));
    let ids = read_ids(&[&sections[..], &clutter[..]].concat());
    let (ids, ids_of_clutter) = ids.split_at(sections.len());
    let targets = sections.iter().zip(ids).filter_map(|(section, id)| {
        let target = read_target(section, *id, road, models)?;
        check_distance(section, radar, &target);
        Some(target)
    });
    let mut targets: Vec<Target> = targets.collect();
    targets.extend(read_clutter(&clutter, ids_of_clutter, models));
    targets
}

fn read_target(section: &Section<'_>, id: Option<&str>, road: &Lanes, models: &mut Models) -> Option<Target> {
    section.require("kind");
    let kind = section.word("kind", &[("mesh", Kind::Mesh), ("point", Kind::Point)]);
    let start = read_pose(section, road);
    let kind = match kind? {
        Kind::Mesh => read_mesh_target(section, models),
        Kind::Point => read_point_target(section),
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
        let key = if section.has("position_m") { "position_m" } else { "y_m" };
        section.note(key, Rule::AtTheAntenna { distance_m, wavelength_m });
    }
}

fn read_mesh_target(section: &Section<'_>, models: &mut Models) -> Option<TargetKind> {
    misplaced(section, &["rcs_m2", "wheel_radius_m", "wheel_angle_deg"], "a mesh target");
    let class = section.word("class", &Class::ALL.map(|class| (class.name(), class)));
    let chosen = models.choose(section)?;
    Some(TargetKind::Mesh { class: class.or(chosen.class), model: chosen.name, mesh: chosen.mesh })
}

fn read_point_target(section: &Section<'_>) -> Option<TargetKind> {
    misplaced(section, &["class", "model", "vehicle_seed", "unit_scale"], "a point target");
    if section.has("yaw_deg") && !section.has("wheel_radius_m") {
        section
            .note("yaw_deg", Rule::Misplaced { key: "yaw_deg", owner: "a point target that is on no wheel" });
    }
    section.require("rcs_m2");
    let wheel = read_wheel(section);
    // Sixty dB beyond the largest ship; zero scatters nothing and is allowed.
    let rcs_m2 = section.number("rcs_m2", Allowed::Between(0.0, 1e12))?;
    Some(TargetKind::Point { rcs_m2, wheel })
}

/// A point on the rim of a wheel, whose hub the target's position is.
fn read_wheel(section: &Section<'_>) -> Option<Wheel> {
    if section.has("wheel_angle_deg") && !section.has("wheel_radius_m") {
        section.note("wheel_angle_deg", Rule::Alone { key: "wheel_angle_deg", companion: "wheel_radius_m" });
    }
    let angle_deg = section.number("wheel_angle_deg", Allowed::Between(-360.0, 360.0)).unwrap_or(0.0);
    let radius_m = section.number("wheel_radius_m", Allowed::Between(0.01, 10.0))?;
    Some(Wheel { radius_m, angle_rad: angle_deg.to_radians() })
}

fn misplaced(section: &Section<'_>, keys: &[&'static str], owner: &'static str) {
    for key in keys.iter().filter(|key| section.has(key)) {
        section.note(key, Rule::Misplaced { key, owner });
    }
}

fn read_pose(section: &Section<'_>, road: &Lanes) -> Option<Pose> {
    let position_m = read_position(section, road);
    let velocity_mps = section.vector("velocity_mps", VELOCITIES_MPS).unwrap_or([0.0; 3]);
    let acceleration_mps2 = section.vector("acceleration_mps2", ACCELERATIONS_MPS2).unwrap_or([0.0; 3]);
    let yaw = section.number("yaw_deg", Allowed::Between(-360.0, 360.0)).map(f64::to_radians);
    let yaw_rad = yaw.unwrap_or(yaw_along(velocity_mps));
    Some(Pose { position_m: position_m?, yaw_rad, velocity_mps, acceleration_mps2 })
}

/// At rest towards the radar, down the lane.
fn yaw_along([vx, vy, _]: [f64; 3]) -> f64 {
    if vx == 0.0 && vy == 0.0 { -std::f64::consts::FRAC_PI_2 } else { vy.atan2(vx) }
}

/// `position_m`, or `lane` with `y_m` along it.
fn read_position(section: &Section<'_>, road: &Lanes) -> Option<[f64; 3]> {
    let position_m = section.vector("position_m", COORDINATES_M);
    let lane = section.integer("lane", Allowed::Between(1.0, 255.0));
    let y_m = section.number("y_m", COORDINATES_M);
    let other = ["lane", "y_m"].into_iter().find(|key| section.has(key));
    if let Some(key) = other.filter(|_| section.has("position_m")) {
        section.note(key, Rule::Contradiction { key, other: "position_m" });
        return None;
    }
    match (section.has("lane"), section.has("y_m")) {
        (true, false) => section.note("lane", Rule::Alone { key: "lane", companion: "y_m" }),
        (false, true) => section.note("y_m", Rule::Alone { key: "y_m", companion: "lane" }),
        (false, false) => section.require("position_m"),
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
        (None, 0) => section.note("lane", Rule::NoLanes(lane)),
        (None, lanes) => section.note("lane", Rule::UnknownLane { lane, lanes }),
    }
    found.map(|lane| lane.centre_m)
}
