//! A street motorcycle without fairing.

use crate::vehicles::dimensions::ParameterSampler;
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::rider::Rider;
use crate::vehicles::drawing::solids::{
    bent, disc, ellipsoid, limb, pitched, rounded_box, section, sharp_box, smoothed, tube,
};
use crate::vehicles::drawing::surface::Material;
use crate::vehicles::motorcycle::nominal::NominalMotorcycle;
use crate::vehicles::motorcycle::parts::{CycleWheel, foot_rest, forks, handlebar, mirror, mudguard, tail};
use glam::DVec3;

pub(crate) fn nominal(sampler: &ParameterSampler) -> NominalMotorcycle {
    let radius_m = sampler.value("wheel radius", 0.305, 0.295..=0.315);
    let half_wheelbase = 0.715;
    let wheel = |axle_x: f64, tyre_width_m: f64, brake_radius_m: f64| CycleWheel {
        axle_x,
        radius_m,
        tyre_width_m,
        rim_radius_m: 0.225,
        spokes: 5,
        brake_radius_m,
    };
    let mut parts = Assembly::default();
    front(half_wheelbase, radius_m, &mut parts);
    body(&mut parts);
    frame(half_wheelbase, radius_m, &mut parts);
    engine(&mut parts);
    exhaust(&mut parts);
    rider(sampler).add(&mut parts);
    NominalMotorcycle {
        parts,
        front: wheel(half_wheelbase, 0.12, 0.15),
        rear: wheel(-half_wheelbase, 0.17, 0.11),
    }
}

/// Rider who leans forward slightly, more on sportier machines.
fn rider(sampler: &ParameterSampler) -> Rider {
    let lean = sampler.value("rider lean", 0.0, -0.05..=0.08);
    Rider {
        hip_m: [-0.24, 0.88],
        shoulder_m: [0.01 + lean, 1.32 - 0.3 * lean],
        head_m: [0.12 + lean, 1.515 - 0.4 * lean],
        elbow_m: [0.10, 0.33, 1.09],
        hand_m: [0.31, 0.335, 1.05],
        knee_m: [0.18, 0.215, 0.78],
        ankle_m: [-0.16, 0.19, 0.42],
    }
}

fn front(axle_x: f64, radius_m: f64, parts: &mut Assembly) {
    forks([axle_x, radius_m], [0.40, 1.0], 0.10, parts);
    parts.add(mudguard([axle_x, radius_m], radius_m + 0.025, 0.07, [30.0, 150.0]));
    handlebar([0.37, 0.0, 1.03], [0.29, 0.395, 1.05], parts);
    mirror([0.34, 0.25, 1.05], [0.37, 0.335, 1.22], parts);
    let lamp = ellipsoid([0.10, 0.095, 0.095], 18, Material::Paint);
    parts.add(lamp.moved(0.545, 0.0, 0.90));
    let lens = disc(0.082, 0.02, 18, Material::Lamp).map(|p| DVec3::new(p.y, -p.x, p.z)).outward();
    parts.add(lens.moved(0.638, 0.0, 0.90));
    parts.add(pitched(rounded_box([0.05, 0.20, 0.10], 0.02, Material::Plastic), 0.5).moved(0.46, 0.0, 1.05));
    for side in [-1.0, 1.0] {
        parts.add(ellipsoid([0.03, 0.035, 0.022], 10, Material::Lamp).moved(0.50, 0.19 * side, 0.88));
        parts.add(tube(&[[0.47, 0.08 * side, 0.88], [0.50, 0.17 * side, 0.88]], 0.007, 6, Material::Plastic));
    }
}

fn body(parts: &mut Assembly) {
    let tank = [
        section([0.33, 0.0, 0.88], 0.10, 0.07),
        section([0.24, 0.0, 0.89], 0.155, 0.10),
        section([0.10, 0.0, 0.88], 0.165, 0.105),
        section([-0.05, 0.0, 0.84], 0.115, 0.085),
        section([-0.13, 0.0, 0.81], 0.085, 0.06),
    ];
    parts.add(limb(&smoothed(&tank, 1), 22, Material::Paint));
    let seat = [
        section([-0.10, 0.0, 0.79], 0.085, 0.04),
        section([-0.25, 0.0, 0.785], 0.135, 0.045),
        section([-0.42, 0.0, 0.80], 0.145, 0.05),
        section([-0.55, 0.0, 0.85], 0.12, 0.045),
        section([-0.74, 0.0, 0.89], 0.095, 0.04),
    ];
    parts.add(limb(&smoothed(&seat, 1), 18, Material::Leather));
    let hump = [
        section([-0.30, 0.0, 0.72], 0.10, 0.06),
        section([-0.60, 0.0, 0.79], 0.105, 0.055),
        section([-0.86, 0.0, 0.87], 0.06, 0.03),
    ];
    parts.add(limb(&smoothed(&hump, 1), 16, Material::Paint));
    tail(-0.93, 0.86, 0.66, parts);
    parts.add(mudguard([-0.715, 0.305], 0.345, 0.08, [75.0, 160.0]));
    parts.add(rounded_box([0.30, 0.22, 0.20], 0.04, Material::Plastic).moved(-0.22, 0.0, 0.65));
}

fn frame(half_wheelbase: f64, radius_m: f64, parts: &mut Assembly) {
    let spar = [[0.37, 0.045, 0.90], [0.20, 0.14, 0.74], [-0.18, 0.15, 0.62], [-0.24, 0.13, 0.40]];
    parts.add_pair(tube(&bent(&spar, 0.3), 0.026, 8, Material::Steel));
    let cradle = [
        [0.38, 0.04, 0.84],
        [0.30, 0.12, 0.45],
        [0.20, 0.13, 0.26],
        [-0.20, 0.13, 0.26],
        [-0.24, 0.13, 0.40],
    ];
    parts.add_pair(tube(&bent(&cradle, 0.3), 0.018, 8, Material::Steel));
    parts.add_pair(tube(&[[-0.18, 0.12, 0.62], [-0.75, 0.09, 0.80]], 0.014, 8, Material::Steel));
    let arm = [
        section([-0.22, 0.13, 0.41], 0.03, 0.045),
        section([-half_wheelbase - 0.03, 0.125, radius_m], 0.022, 0.03),
    ];
    parts.add_pair(limb(&arm, 8, Material::Aluminium));
    parts.add(tube(
        &[[-half_wheelbase, -0.15, radius_m], [-half_wheelbase, 0.15, radius_m]],
        0.014,
        8,
        Material::Steel,
    ));
    parts.add(disc(0.105, 0.012, 24, Material::Steel).moved(-half_wheelbase, 0.095, radius_m));
    parts.add(tube(&[[-0.30, 0.09, 0.62], [-0.34, 0.09, 0.42]], 0.035, 10, Material::Steel));
    foot_rest([-0.12, 0.23, 0.36], 0.13, parts);
    foot_rest([-0.42, 0.22, 0.44], 0.10, parts);
    // The side stand, folded up.
    parts.add(tube(&[[-0.02, 0.15, 0.28], [-0.30, 0.18, 0.21]], 0.012, 8, Material::Steel));
}

fn engine(parts: &mut Assembly) {
    parts.add(rounded_box([0.44, 0.34, 0.24], 0.06, Material::Aluminium).moved(0.0, 0.0, 0.41));
    parts.add_pair(disc(0.10, 0.05, 18, Material::Aluminium).moved(-0.06, 0.185, 0.42));
    let block = pitched(rounded_box([0.20, 0.33, 0.26], 0.03, Material::Steel), 0.35);
    parts.add(block.moved(0.16, 0.0, 0.58));
    let head = pitched(rounded_box([0.22, 0.36, 0.08], 0.025, Material::Aluminium), 0.35);
    parts.add(head.moved(0.21, 0.0, 0.715));
    parts.add(pitched(sharp_box([0.045, 0.36, 0.26], Material::Steel), -0.15).moved(0.375, 0.0, 0.57));
}

fn exhaust(parts: &mut Assembly) {
    for y in [-0.10, -0.03, 0.03, 0.10] {
        let pipe = [[0.27, y, 0.60], [0.36, y, 0.42], [0.30, 0.8 * y, 0.24], [0.02, 0.5 * y, 0.215]];
        parts.add(tube(&bent(&pipe, 0.35), 0.019, 8, Material::Chrome));
    }
    let link = [[0.04, 0.0, 0.215], [-0.18, -0.05, 0.22], [-0.34, -0.19, 0.29]];
    parts.add(tube(&bent(&link, 0.35), 0.027, 10, Material::Chrome));
    let silencer = [
        section([-0.32, -0.195, 0.29], 0.032, 0.032),
        section([-0.40, -0.205, 0.325], 0.055, 0.065),
        section([-0.78, -0.215, 0.47], 0.052, 0.062),
    ];
    parts.add(limb(&smoothed(&silencer, 1), 16, Material::Chrome));
}
