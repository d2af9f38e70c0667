//! A motorcycle's rider: torso, helmet, arms, legs, as limbs between joints.

use super::mesh_builder::Assembly;
use super::solids::{ellipsoid, limb, rounded_box, section};
use super::stencil::{Inside, cut, rounded_rectangle};
use super::surface::Material;
use glam::DVec3;

/// Joints of the left half in body axes, metres; the right half mirrors them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rider {
    /// Middle of the hips.
    pub(super) hip_m: [f64; 2],
    /// Middle between the shoulders.
    pub(super) shoulder_m: [f64; 2],
    /// Middle of the helmet.
    pub(super) head_m: [f64; 2],
    pub(super) elbow_m: [f64; 3],
    pub(super) hand_m: [f64; 3],
    pub(super) knee_m: [f64; 3],
    pub(super) ankle_m: [f64; 3],
}

/// Half the breadth of shoulders and hips of an adult in riding clothes.
const SHOULDER_Y: f64 = 0.19;
const HIP_Y: f64 = 0.10;

impl Rider {
    /// Torso, head and both pairs of limbs.
    pub(super) fn add(&self, to: &mut Assembly) {
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
            section(between(-0.10, 0.0), 0.155, 0.11),
            section(between(0.08, 0.01), 0.180, 0.13),
            section(between(0.35, 0.03), 0.160, 0.12),
            section(between(0.65, 0.035), 0.195, 0.135),
            section(between(0.90, 0.02), 0.215, 0.125),
            section(between(1.05, 0.0), 0.150, 0.09),
        ];
        to.add(limb(&sections, 20, Material::Fabric));
        let neck = [
            section([sx, 0.0, sz], 0.065, 0.065),
            section([self.head_m[0] - 0.01, 0.0, self.head_m[1] - 0.05], 0.06, 0.06),
        ];
        to.add(limb(&neck, 12, Material::Fabric));
    }

    /// A full-face helmet: shell with chin bar and visor.
    fn helmet(&self, to: &mut Assembly) {
        let [x, z] = self.head_m;
        let shell = ellipsoid([0.145, 0.125, 0.135], 24, Material::Paint);
        // The chin reaches forward and down.
        let shell =
            shell.map(|p| if p.z < 0.0 && p.x > 0.0 { DVec3::new(p.x * 1.06, p.y * 0.95, p.z * 1.05) } else { p });
        let eyes = |p: DVec3| rounded_rectangle(p.y, p.z, [-0.105, 0.105], [-0.045, 0.055], 0.03).min(p.x - 0.02);
        let visor = Inside::Inset { material: Material::Glass, rim: Material::Plastic, depth_m: 0.004 };
        to.add(cut(shell, eyes, visor).moved(x, 0.0, z));
    }

    fn arms(&self, to: &mut Assembly) {
        let shoulder = [self.shoulder_m[0], SHOULDER_Y, self.shoulder_m[1] - 0.02];
        let upper = [
            section(shoulder, 0.075, 0.08),
            section(middle(shoulder, self.elbow_m), 0.062, 0.065),
            section(self.elbow_m, 0.050, 0.052),
        ];
        let lower = [
            section(self.elbow_m, 0.052, 0.052),
            section(middle(self.elbow_m, self.hand_m), 0.05, 0.05),
            section(self.hand_m, 0.036, 0.036),
        ];
        to.add_pair(limb(&upper, 14, Material::Fabric));
        to.add_pair(limb(&lower, 14, Material::Fabric));
        to.add_pair(rounded_box([0.10, 0.10, 0.075], 0.03, Material::Leather).moved(
            self.hand_m[0] + 0.02,
            self.hand_m[1] + 0.02,
            self.hand_m[2],
        ));
    }

    fn legs(&self, to: &mut Assembly) {
        let hip = [self.hip_m[0], HIP_Y, self.hip_m[1] - 0.02];
        let thigh = [
            section(hip, 0.095, 0.10),
            section(middle(hip, self.knee_m), 0.085, 0.09),
            section(self.knee_m, 0.066, 0.07),
        ];
        let shin = [
            section(self.knee_m, 0.066, 0.068),
            section(middle(self.knee_m, self.ankle_m), 0.062, 0.064),
            section(self.ankle_m, 0.046, 0.048),
        ];
        to.add_pair(limb(&thigh, 16, Material::Fabric));
        to.add_pair(limb(&shin, 14, Material::Fabric));
        let [x, y, z] = self.ankle_m;
        let boot = [
            section([x - 0.05, y, z - 0.05], 0.045, 0.05),
            section([x + 0.06, y, z - 0.055], 0.05, 0.05),
            section([x + 0.19, y, z - 0.07], 0.045, 0.034),
        ];
        to.add_pair(limb(&boot, 12, Material::Leather));
    }
}

fn middle(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]))
}
