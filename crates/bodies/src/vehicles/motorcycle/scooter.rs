//! A scooter: leg shield, flat floor, the engine under the seat.

use crate::vehicles::dimensions::ParameterSampler;
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::rider::Rider;
use crate::vehicles::drawing::solids::{ellipsoid, limb, rounded_box, section, sharp_box, smoothed, tube};
use crate::vehicles::drawing::surface::Material;
use crate::vehicles::motorcycle::nominal::NominalMotorcycle;
use crate::vehicles::motorcycle::parts::{CycleWheel, forks, handlebar, mirror, mudguard, tail};

const HALF_WHEELBASE_M: f64 = 0.665;

pub(crate) fn nominal(sampler: &ParameterSampler) -> NominalMotorcycle {
    let radius_m = sampler.value("wheel radius", 0.265, 0.25..=0.30);
    let wheel = |axle_x: f64, tyre_width_m: f64, brake_radius_m: f64| CycleWheel {
        axle_x,
        radius_m,
        tyre_width_m,
        rim_radius_m: 0.70 * radius_m,
        spokes: 6,
        brake_radius_m,
    };
    let mut parts = Assembly::default();
    front(radius_m, &mut parts);
    floor(&mut parts);
    rear_body(&mut parts);
    engine(radius_m, &mut parts);
    rider(sampler).add(&mut parts);
    NominalMotorcycle {
        parts,
        front: wheel(HALF_WHEELBASE_M, 0.11, 0.11),
        rear: wheel(-HALF_WHEELBASE_M, 0.13, 0.09),
    }
}

/// Rider in an upright position, feet together on the floor.
fn rider(sampler: &ParameterSampler) -> Rider {
    let lean = sampler.value("rider lean", 0.0, -0.03..=0.05);
    Rider {
        hip_m: [-0.30, 0.87],
        shoulder_m: [-0.20 + lean, 1.36],
        head_m: [-0.14 + lean, 1.565],
        elbow_m: [-0.02, 0.30, 1.12],
        hand_m: [0.26, 0.305, 1.03],
        knee_m: [0.13, 0.155, 0.78],
        ankle_m: [0.10, 0.135, 0.42],
    }
}

fn front(radius_m: f64, parts: &mut Assembly) {
    forks([HALF_WHEELBASE_M, radius_m], [0.44, 0.78], 0.075, parts);
    parts.add(mudguard([HALF_WHEELBASE_M, radius_m], radius_m + 0.03, 0.085, [25.0, 165.0]));
    // The shield in front of the legs, narrow above the wheel, wide at the knees.
    let shield = [
        section([0.33, 0.0, 0.30], 0.16, 0.05),
        section([0.38, 0.0, 0.45], 0.22, 0.055),
        section([0.42, 0.0, 0.62], 0.25, 0.06),
        section([0.43, 0.0, 0.78], 0.23, 0.06),
        section([0.39, 0.0, 0.92], 0.13, 0.05),
    ];
    parts.add(limb(&smoothed(&shield, 1), 24, Material::Paint));
    let nose = [
        section([0.60, 0.0, 0.66], 0.06, 0.07),
        section([0.53, 0.0, 0.70], 0.13, 0.12),
        section([0.42, 0.0, 0.74], 0.16, 0.15),
    ];
    parts.add(limb(&smoothed(&nose, 1), 20, Material::Paint));
    let headset = [
        section([0.44, 0.0, 0.99], 0.09, 0.06),
        section([0.38, 0.0, 1.00], 0.13, 0.07),
        section([0.28, 0.0, 1.0], 0.11, 0.05),
    ];
    parts.add(limb(&smoothed(&headset, 1), 18, Material::Paint));
    parts.add(ellipsoid([0.05, 0.08, 0.055], 16, Material::Lamp).moved(0.455, 0.0, 0.985));
    parts.add_pair(ellipsoid([0.03, 0.05, 0.03], 12, Material::Lamp).moved(0.53, 0.13, 0.74));
    handlebar([0.33, 0.0, 1.02], [0.24, 0.37, 1.03], parts);
    mirror([0.29, 0.22, 1.03], [0.33, 0.31, 1.20], parts);
    let screen = [
        section([0.44, 0.0, 1.04], 0.14, 0.008),
        section([0.38, 0.0, 1.18], 0.16, 0.008),
        section([0.33, 0.0, 1.26], 0.11, 0.008),
    ];
    parts.add(limb(&smoothed(&screen, 1), 18, Material::Glass));
}

fn floor(parts: &mut Assembly) {
    parts.add(rounded_box([0.55, 0.38, 0.10], 0.035, Material::Plastic).moved(0.12, 0.0, 0.29));
    parts.add(sharp_box([0.48, 0.30, 0.012], Material::Rubber).moved(0.12, 0.0, 0.345));
    parts.add(tube(&[[0.40, 0.0, 0.75], [0.34, 0.0, 0.30], [-0.20, 0.0, 0.27]], 0.035, 10, Material::Steel));
}

fn rear_body(parts: &mut Assembly) {
    let cowl = [
        section([-0.10, 0.0, 0.48], 0.15, 0.16),
        section([-0.20, 0.0, 0.54], 0.19, 0.19),
        section([-0.40, 0.0, 0.60], 0.21, 0.16),
        section([-0.65, 0.0, 0.67], 0.18, 0.11),
        section([-0.86, 0.0, 0.73], 0.10, 0.06),
    ];
    parts.add(limb(&smoothed(&cowl, 1), 24, Material::Paint));
    let seat = [
        section([-0.06, 0.0, 0.755], 0.10, 0.04),
        section([-0.22, 0.0, 0.765], 0.155, 0.05),
        section([-0.45, 0.0, 0.785], 0.165, 0.055),
        section([-0.62, 0.0, 0.83], 0.14, 0.05),
        section([-0.80, 0.0, 0.84], 0.10, 0.04),
    ];
    parts.add(limb(&smoothed(&seat, 1), 20, Material::Leather));
    tail(-0.93, 0.75, 0.52, parts);
    let grab = [
        [-0.62, 0.15, 0.79],
        [-0.82, 0.13, 0.86],
        [-0.93, 0.05, 0.88],
        [-0.93, -0.05, 0.88],
        [-0.82, -0.13, 0.86],
        [-0.62, -0.15, 0.79],
    ];
    parts.add(tube(&grab, 0.012, 8, Material::Aluminium));
}

/// Engine and gearbox, which swing with the rear wheel.
fn engine(radius_m: f64, parts: &mut Assembly) {
    parts.add(rounded_box([0.62, 0.10, 0.17], 0.045, Material::Aluminium).moved(
        -0.46,
        0.14,
        radius_m + 0.02,
    ));
    parts.add(rounded_box([0.34, 0.26, 0.20], 0.05, Material::Aluminium).moved(-0.25, 0.0, 0.31));
    let silencer = [
        section([-0.36, -0.17, 0.25], 0.035, 0.035),
        section([-0.46, -0.18, 0.27], 0.055, 0.065),
        section([-0.80, -0.18, 0.36], 0.05, 0.06),
    ];
    parts.add(limb(&smoothed(&silencer, 1), 14, Material::Steel));
    parts.add(tube(&[[-0.20, -0.10, 0.24], [-0.38, -0.17, 0.25]], 0.018, 8, Material::Steel));
    parts.add_pair(tube(&[[-0.60, 0.13, 0.62], [-0.66, 0.13, 0.30]], 0.025, 8, Material::Steel));
    parts.add(mudguard([-HALF_WHEELBASE_M, radius_m], radius_m + 0.03, 0.08, [60.0, 175.0]));
    parts.add(tube(
        &[[-HALF_WHEELBASE_M, -0.15, radius_m], [-HALF_WHEELBASE_M, 0.15, radius_m]],
        0.014,
        8,
        Material::Steel,
    ));
    parts.add(tube(
        &[[-0.18, -0.12, 0.20], [-0.42, -0.12, 0.12], [-0.42, 0.12, 0.12], [-0.18, 0.12, 0.20]],
        0.012,
        8,
        Material::Steel,
    ));
}
