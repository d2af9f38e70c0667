//! Two-wheelers of the families: wheels, fork and handlebar from numbers, everything else from solids of the
//! table, with or without a rider.

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::rider::Rider;
use crate::vehicles::drawing::solids::{ellipsoid, lathe};
use crate::vehicles::drawing::surface::Material;
use crate::vehicles::family::Parameters;
use crate::vehicles::motorcycle::parts::{CycleWheel, forks, handlebar, mirror, mudguard, tail};
use crate::vehicles::parts;
use glam::DVec3;

/// Makes a whole two-wheeler in its drawing's axes, in the given size.
pub(crate) fn draw(parameters: &Parameters<'_>, nominal_m: [f64; 3], size_m: [f64; 3]) -> Assembly {
    let stretch = DVec3::from_array(size_m) / DVec3::from_array(nominal_m);
    let mut made = Assembly::default();
    front(parameters, &mut made);
    let [x, lamp_z, plate_z] = parameters.numbers("tail");
    tail(x, lamp_z, plate_z, &mut made);
    if parameters.has("rider") {
        rider(parameters).add(&mut made);
    }
    let mut cycle = Assembly::default();
    cycle.add_all(made, |part| part.map(|p| p * stretch));
    parts::add(parameters, stretch, &mut cycle);
    for wheel in wheels(parameters) {
        // Wheels stay round when the axle moves.
        CycleWheel { axle_x: wheel.axle_x * stretch.x, ..wheel }.add(&mut cycle);
    }
    cycle
}

/// Front and rear wheel; the rear one alone if both axles coincide: the front ones are then among the solids.
fn wheels(parameters: &Parameters<'_>) -> Vec<CycleWheel> {
    let [front_x, rear_x] = parameters.numbers("axles");
    let wheel = |axle_x: f64, key: &str| {
        let [radius_m, tyre_width_m, rim] = parameters.numbers(key);
        let rim_radius_m = rim * radius_m;
        CycleWheel {
            axle_x,
            radius_m,
            tyre_width_m,
            rim_radius_m,
            spokes: parameters.number("spokes") as u32,
            brake_radius_m: parameters.number("brake") * rim_radius_m,
        }
    };
    let has_front = front_x != rear_x;
    let front = has_front.then(|| wheel(front_x, "front_wheel"));
    front.into_iter().chain([wheel(rear_x, "rear_wheel")]).collect()
}

fn front(parameters: &Parameters<'_>, to: &mut Assembly) {
    let [front_x, rear_x] = parameters.numbers("axles");
    let [front_m, rear_m] = ["front_wheel", "rear_wheel"].map(|key| parameters.numbers::<3>(key)[0]);
    forks([front_x, front_m], parameters.numbers("head"), parameters.number("fork_m"), to);
    let [clearance, half, from, until] = parameters.numbers("front_guard");
    to.add(mudguard([front_x, front_m], front_m + clearance, half, [from, until]));
    let [clearance, half, from, until] = parameters.numbers("rear_guard");
    to.add(mudguard([rear_x, rear_m], rear_m + clearance, half, [from, until]));
    let [clamp_x, clamp_z] = parameters.numbers("clamp");
    handlebar([clamp_x, 0.0, clamp_z], parameters.numbers("grip"), to);
    if !parameters.has("no_mirrors") {
        let [x, y, z] = parameters.numbers("mirror");
        mirror([clamp_x - 0.02, 0.6 * y, clamp_z + 0.02], [x, y, z], to);
    }
    lamp(parameters, to);
}

/// Adds a round lamp with a dished reflector, or an oblong one.
fn lamp(parameters: &Parameters<'_>, to: &mut Assembly) {
    let [x, z, radius] = parameters.numbers("lamp");
    if parameters.has("oblong_lamp") {
        let half_m = [0.4 * radius, 1.3 * radius, 0.7 * radius];
        return to.add(ellipsoid(half_m, 14, Material::Lamp).moved(x, 0.0, z));
    }
    let profile = [
        (0.0, 0.0),
        (0.6 * radius, 0.012),
        (radius, 0.04),
        (1.08 * radius, 0.03),
        (0.7 * radius, -0.10),
        (0.0, -0.12),
    ];
    let dish = lathe(&profile, 18, Material::Lamp).map(|p| DVec3::new(p.y, -p.x, p.z)).outward();
    to.add(dish.moved(x, 0.0, z));
}

/// Rider with joints as [x, z] of the middle and [x, y, z] of the left side; the lean moves shoulders, head
/// and elbows.
fn rider(parameters: &Parameters<'_>) -> Rider {
    let lean = parameters.number("lean_m");
    let moved = |[x, z]: [f64; 2]| [x + lean, z - 0.3 * lean.max(0.0)];
    let [elbow_x, elbow_y, elbow_z] = parameters.numbers("elbow");
    Rider {
        hip_m: parameters.numbers("hip"),
        shoulder_m: moved(parameters.numbers("shoulder")),
        head_m: moved(parameters.numbers("helmet")),
        elbow_m: [elbow_x + 0.5 * lean, elbow_y, elbow_z],
        hand_m: parameters.numbers("hand"),
        knee_m: parameters.numbers("knee"),
        ankle_m: parameters.numbers("ankle"),
    }
}
