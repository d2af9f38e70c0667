//! A tourer: fairing, screen, cases.

use crate::vehicles::dimensions::ParameterSampler;
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::rider::Rider;
use crate::vehicles::drawing::solids::{
    ellipsoid, limb, pitched, rounded_box, section, sharp_box, smoothed, tube,
};
use crate::vehicles::drawing::stencil::{CutTreatment, cut, rounded_rectangle};
use crate::vehicles::drawing::surface::Material;
use crate::vehicles::motorcycle::nominal::NominalMotorcycle;
use crate::vehicles::motorcycle::parts::{CycleWheel, foot_rest, forks, handlebar, mudguard, tail};
use glam::DVec3;

const HALF_WHEELBASE_M: f64 = 0.77;

pub(crate) fn nominal(sampler: &ParameterSampler) -> NominalMotorcycle {
    let radius_m = sampler.value("wheel radius", 0.315, 0.305..=0.325);
    let wheel = |axle_x: f64, tyre_width_m: f64, brake_radius_m: f64| CycleWheel {
        axle_x,
        radius_m,
        tyre_width_m,
        rim_radius_m: 0.225,
        spokes: 5,
        brake_radius_m,
    };
    let mut parts = Assembly::default();
    fairing(&mut parts);
    front(radius_m, &mut parts);
    body(&mut parts);
    cases(&mut parts);
    engine(radius_m, &mut parts);
    rider(sampler).add(&mut parts);
    NominalMotorcycle {
        parts,
        front: wheel(HALF_WHEELBASE_M, 0.13, 0.155),
        rear: wheel(-HALF_WHEELBASE_M, 0.18, 0.14),
    }
}

/// Rider in an upright position, arms wide and relaxed.
fn rider(sampler: &ParameterSampler) -> Rider {
    let lean = sampler.value("rider lean", 0.0, -0.04..=0.05);
    Rider {
        hip_m: [-0.28, 0.91],
        shoulder_m: [-0.14 + lean, 1.41],
        head_m: [-0.06 + lean, 1.615],
        elbow_m: [0.02, 0.34, 1.16],
        hand_m: [0.24, 0.36, 1.08],
        knee_m: [0.14, 0.24, 0.79],
        ankle_m: [-0.12, 0.23, 0.42],
    }
}

fn fairing(parts: &mut Assembly) {
    let upper = [
        section([0.84, 0.0, 0.86], 0.09, 0.07),
        section([0.76, 0.0, 0.89], 0.20, 0.15),
        section([0.62, 0.0, 0.92], 0.31, 0.20),
        section([0.46, 0.0, 0.92], 0.37, 0.21),
        section([0.32, 0.0, 0.90], 0.33, 0.17),
    ];
    let band = |p: DVec3| rounded_rectangle(p.y, p.z, [-0.19, 0.19], [0.83, 0.925], 0.04).min(p.x - 0.6);
    let lens = CutTreatment::Inset { material: Material::Lamp, rim: Material::Plastic, depth_m: 0.008 };
    parts.add(cut(limb(&smoothed(&upper, 1), 28, Material::Paint), band, lens));
    let lower = [
        section([0.58, 0.24, 0.74], 0.05, 0.10),
        section([0.42, 0.29, 0.62], 0.06, 0.17),
        section([0.22, 0.28, 0.54], 0.055, 0.18),
        section([0.04, 0.25, 0.50], 0.04, 0.12),
    ];
    parts.add_pair(limb(&smoothed(&lower, 1), 16, Material::Paint));
    let screen = [
        section([0.66, 0.0, 1.06], 0.20, 0.010),
        section([0.56, 0.0, 1.22], 0.25, 0.010),
        section([0.46, 0.0, 1.37], 0.23, 0.010),
        section([0.41, 0.0, 1.45], 0.15, 0.010),
    ];
    parts.add(limb(&smoothed(&screen, 1), 24, Material::Glass));
    parts.add_pair(ellipsoid([0.07, 0.085, 0.055], 14, Material::Paint).moved(0.52, 0.405, 0.99));
    parts.add_pair(ellipsoid([0.012, 0.07, 0.042], 12, Material::Glass).moved(0.458, 0.405, 0.99));
    parts.add(pitched(rounded_box([0.06, 0.34, 0.16], 0.03, Material::Plastic), 0.5).moved(0.40, 0.0, 1.10));
}

fn front(radius_m: f64, parts: &mut Assembly) {
    forks([HALF_WHEELBASE_M, radius_m], [0.46, 0.98], 0.11, parts);
    parts.add(mudguard([HALF_WHEELBASE_M, radius_m], radius_m + 0.028, 0.08, [15.0, 155.0]));
    handlebar([0.32, 0.0, 1.09], [0.22, 0.42, 1.08], parts);
}

fn body(parts: &mut Assembly) {
    let tank = [
        section([0.34, 0.0, 0.92], 0.16, 0.10),
        section([0.20, 0.0, 0.93], 0.19, 0.12),
        section([0.04, 0.0, 0.90], 0.185, 0.115),
        section([-0.12, 0.0, 0.84], 0.12, 0.08),
    ];
    parts.add(limb(&smoothed(&tank, 1), 22, Material::Paint));
    let seat = [
        section([-0.08, 0.0, 0.81], 0.11, 0.045),
        section([-0.24, 0.0, 0.805], 0.165, 0.05),
        section([-0.42, 0.0, 0.82], 0.175, 0.06),
        section([-0.50, 0.0, 0.89], 0.17, 0.06),
        section([-0.80, 0.0, 0.91], 0.15, 0.055),
    ];
    parts.add(limb(&smoothed(&seat, 1), 20, Material::Leather));
    let rear = [
        section([-0.20, 0.0, 0.70], 0.16, 0.09),
        section([-0.60, 0.0, 0.76], 0.17, 0.09),
        section([-1.02, 0.0, 0.82], 0.12, 0.05),
    ];
    parts.add(limb(&smoothed(&rear, 1), 20, Material::Paint));
    tail(-1.10, 0.80, 0.58, parts);
    parts.add(mudguard([-HALF_WHEELBASE_M, 0.315], 0.35, 0.10, [60.0, 170.0]));
}

fn cases(parts: &mut Assembly) {
    parts.add_pair(rounded_box([0.56, 0.24, 0.40], 0.075, Material::Paint).moved(-0.68, 0.345, 0.66));
    parts.add_pair(sharp_box([0.04, 0.16, 0.08], Material::TailLamp).moved(-0.955, 0.345, 0.74));
    parts.add(rounded_box([0.40, 0.54, 0.30], 0.09, Material::Paint).moved(-0.95, 0.0, 1.08));
    parts.add(rounded_box([0.10, 0.40, 0.16], 0.045, Material::Leather).moved(-0.73, 0.0, 1.08));
    parts.add_pair(tube(&[[-0.70, 0.14, 0.88], [-1.05, 0.14, 0.94]], 0.016, 8, Material::Steel));
}

/// A flat twin: cylinders out to both sides; shaft drive on the right.
fn engine(radius_m: f64, parts: &mut Assembly) {
    parts.add(rounded_box([0.46, 0.34, 0.34], 0.07, Material::Aluminium).moved(0.06, 0.0, 0.44));
    parts.add_pair(rounded_box([0.20, 0.22, 0.17], 0.05, Material::Aluminium).moved(0.20, 0.27, 0.42));
    parts.add_pair(tube(
        &[[0.28, 0.30, 0.40], [0.26, 0.24, 0.27], [0.0, 0.16, 0.24], [-0.35, 0.17, 0.28]],
        0.024,
        10,
        Material::Chrome,
    ));
    let silencer = [
        section([-0.34, 0.18, 0.28], 0.035, 0.035),
        section([-0.44, 0.19, 0.30], 0.05, 0.06),
        section([-0.92, 0.215, 0.37], 0.048, 0.058),
    ];
    parts.add_pair(limb(&smoothed(&silencer, 1), 16, Material::Chrome));
    let arm = [
        section([-0.20, -0.14, 0.42], 0.04, 0.05),
        section([-HALF_WHEELBASE_M, -0.13, radius_m], 0.045, 0.06),
    ];
    parts.add(limb(&arm, 12, Material::Aluminium));
    parts.add(tube(
        &[[-HALF_WHEELBASE_M, -0.12, radius_m], [-HALF_WHEELBASE_M, 0.10, radius_m]],
        0.02,
        8,
        Material::Steel,
    ));
    parts.add_pair(tube(
        &[[0.45, 0.10, 0.86], [0.10, 0.18, 0.66], [-0.24, 0.16, 0.42]],
        0.024,
        8,
        Material::Steel,
    ));
    foot_rest([-0.08, 0.27, 0.36], 0.15, parts);
}
