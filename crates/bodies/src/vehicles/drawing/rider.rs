//! A motorcycle's rider: torso, helmet, arms and legs, as limbs between joints.

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::solids::{ellipsoid, limb, rounded_box, section, smoothed};
use crate::vehicles::drawing::stencil::{CutTreatment, cut, soft_minimum};
use crate::vehicles::drawing::surface::Material;
use glam::DVec3;

/// Joints of the left half in body axes, metres; the right half mirrors them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rider {
    /// Middle of the hips.
    pub(crate) hip_m: [f64; 2],
    /// Middle between the shoulders.
    pub(crate) shoulder_m: [f64; 2],
    /// Middle of the helmet.
    pub(crate) head_m: [f64; 2],
    pub(crate) elbow_m: [f64; 3],
    pub(crate) hand_m: [f64; 3],
    pub(crate) knee_m: [f64; 3],
    pub(crate) ankle_m: [f64; 3],
}

/// Half the breadth of shoulders and hips of an adult in riding clothes.
const SHOULDER_Y: f64 = 0.19;
const HIP_Y: f64 = 0.10;

impl Rider {
    /// Adds torso, head and both pairs of limbs.
    pub(crate) fn add(&self, to: &mut Assembly) {
        self.torso(to);
        self.helmet(to);
        self.arms(to);
        self.legs(to);
    }

    fn torso(&self, to: &mut Assembly) {
        let ([hx, hz], [sx, sz]) = (self.hip_m, self.shoulder_m);
        let between = |t: f64, bow: f64| [hx + (sx - hx) * t - bow, 0.0, hz + (sz - hz) * t];
        // Widest at the shoulders, narrow at the waist, the back bowed.
        let sections = [
            section(between(-0.12, 0.0), 0.150, 0.10),
            section(between(0.08, 0.01), 0.185, 0.13),
            section(between(0.38, 0.03), 0.160, 0.115),
            section(between(0.70, 0.035), 0.195, 0.13),
            section(between(0.92, 0.02), 0.205, 0.11),
            section(between(1.06, 0.0), 0.120, 0.075),
        ];
        to.add(limb(&smoothed(&sections, 1), 20, Material::Fabric));
        let chin = [self.head_m[0] - 0.01, 0.0, self.head_m[1] - 0.05];
        to.add(limb(
            &[section([sx, 0.0, sz], 0.065, 0.065), section(chin, 0.06, 0.06)],
            12,
            Material::Fabric,
        ));
    }

    /// A full-face helmet: shell with chin bar and visor.
    fn helmet(&self, to: &mut Assembly) {
        let [x, z] = self.head_m;
        let shell = ellipsoid([0.145, 0.125, 0.135], 22, Material::Paint);
        // The chin reaches forward and down.
        let chin = |p: DVec3| if p.z < 0.0 && p.x > 0.0 { p * DVec3::new(1.06, 0.95, 1.05) } else { p };
        let eyes = |p: DVec3| soft_minimum(&[p.z + 0.045, 0.055 - p.z, p.x - 0.015], 0.03);
        let visor = CutTreatment::Inset { material: Material::Glass, rim: Material::Plastic, depth_m: 0.004 };
        to.add(cut(shell.map(chin), eyes, visor).moved(x, 0.0, z));
    }

    fn arms(&self, to: &mut Assembly) {
        let [sx, sz] = self.shoulder_m;
        let (root, shoulder) =
            ([sx, SHOULDER_Y - 0.05, sz - 0.015], [sx + 0.005, SHOULDER_Y + 0.015, sz - 0.04]);
        let arm = [
            section(root, 0.065, 0.065),
            section(shoulder, 0.072, 0.072),
            section(middle(shoulder, self.elbow_m), 0.060, 0.062),
            section(self.elbow_m, 0.052, 0.054),
            section(middle(self.elbow_m, self.hand_m), 0.048, 0.048),
            section(self.hand_m, 0.034, 0.034),
        ];
        to.add_pair(limb(&smoothed(&arm, 1), 14, Material::Fabric));
        let [x, y, z] = self.hand_m;
        to.add_pair(rounded_box([0.09, 0.10, 0.075], 0.03, Material::Leather).moved(x + 0.02, y + 0.02, z));
    }

    fn legs(&self, to: &mut Assembly) {
        let hip = [self.hip_m[0], HIP_Y, self.hip_m[1] - 0.02];
        let leg = [
            section(hip, 0.095, 0.10),
            section(middle(hip, self.knee_m), 0.085, 0.09),
            section(self.knee_m, 0.068, 0.072),
            section(middle(self.knee_m, self.ankle_m), 0.062, 0.066),
            section(self.ankle_m, 0.046, 0.048),
        ];
        to.add_pair(limb(&smoothed(&leg, 1), 16, Material::Fabric));
        let [x, y, z] = self.ankle_m;
        let boot = [
            section([x - 0.05, y, z - 0.05], 0.042, 0.05),
            section([x + 0.06, y, z - 0.055], 0.05, 0.05),
            section([x + 0.19, y, z - 0.07], 0.045, 0.034),
        ];
        to.add_pair(limb(&smoothed(&boot, 1), 12, Material::Leather));
    }
}

fn middle(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]))
}
