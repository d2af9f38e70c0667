//! Parts common to all motorcycles: wheels, forks, handlebar, mudguards, plate.

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::solids::{bent, disc, ellipsoid, lathe, limb, section, sharp_box, tube};
use crate::vehicles::drawing::surface::{Material, Surface};
use glam::DVec3;
use std::f64::consts::TAU;

/// A wheel in the middle plane, on the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CycleWheel {
    pub(crate) axle_x: f64,
    pub(crate) radius_m: f64,
    pub(crate) tyre_width_m: f64,
    pub(crate) rim_radius_m: f64,
    pub(crate) spokes: u32,
    pub(crate) brake_radius_m: f64,
}

impl CycleWheel {
    /// Tyre, rim, spokes, hub and brake discs.
    pub(crate) fn add(&self, to: &mut Assembly) {
        let place = |part: Surface| part.moved(self.axle_x, 0.0, self.radius_m);
        to.add_of_wheel(place(self.tyre()));
        to.add_of_wheel(place(self.rim()));
        to.add_of_wheel(place(disc(0.045, 0.16, 14, Material::Aluminium)));
        for k in 0..self.spokes {
            to.add_of_wheel(place(self.spoke(TAU * f64::from(k) / f64::from(self.spokes))));
        }
        to.add_pair_of_wheels(place(self.brake().moved(0.0, 0.068, 0.0)));
    }

    fn tyre(&self) -> Surface {
        let (bead, half) = (self.rim_radius_m, 0.5 * self.tyre_width_m);
        let (middle, height) = (0.5 * (self.radius_m + bead), 0.5 * (self.radius_m - bead));
        let at = |k: usize| {
            let angle = TAU * (k % 12) as f64 / 12.0;
            (middle + height * angle.cos(), half * angle.sin())
        };
        lathe(&(0..=12).map(at).collect::<Vec<_>>(), 34, Material::Rubber)
    }

    fn rim(&self) -> Surface {
        let (outer, half) = (self.rim_radius_m + 0.012, 0.36 * self.tyre_width_m);
        let inner = outer - 0.035;
        lathe(
            &[(outer, half), (outer, -half), (inner, -0.6 * half), (inner, 0.6 * half), (outer, half)],
            36,
            Material::Aluminium,
        )
    }

    fn spoke(&self, angle: f64) -> Surface {
        let at = |radius: f64| [radius * angle.cos(), 0.0, radius * angle.sin()];
        limb(
            &[section(at(0.03), 0.022, 0.03), section(at(self.rim_radius_m - 0.015), 0.014, 0.018)],
            8,
            Material::Aluminium,
        )
    }

    fn brake(&self) -> Surface {
        let (outer, inner) = (self.brake_radius_m, 0.55 * self.brake_radius_m);
        lathe(
            &[(outer, 0.0025), (outer, -0.0025), (inner, -0.0025), (inner, 0.0025), (outer, 0.0025)],
            28,
            Material::Steel,
        )
    }
}

/// Two legs from the axle to the steering head, with their bridges.
pub(crate) fn forks(axle: [f64; 2], head: [f64; 2], half_gap_m: f64, to: &mut Assembly) {
    let at = |t: f64| [axle[0] + (head[0] - axle[0]) * t, half_gap_m, axle[1] + (head[1] - axle[1]) * t];
    to.add_pair(tube(&[at(-0.03), at(0.45)], 0.030, 10, Material::Aluminium));
    to.add_pair(tube(&[at(0.40), at(1.02)], 0.022, 10, Material::Chrome));
    for t in [0.78, 1.0] {
        let [x, _, z] = at(t);
        to.add(sharp_box([0.07, 2.0 * half_gap_m + 0.08, 0.035], Material::Aluminium).moved(x, 0.0, z));
    }
}

/// Bar, grips, levers and mirrors. `clamp` is its middle, `grip` the end of the left grip.
pub(crate) fn handlebar(clamp: [f64; 3], grip: [f64; 3], to: &mut Assembly) {
    let [gx, gy, gz] = grip;
    let bend = [clamp[0] + 0.02, 0.5 * gy, gz];
    let across = |p: [f64; 3]| [p[0], -p[1], p[2]];
    let path = [across(grip), across(bend), clamp, bend, grip];
    to.add(tube(&bent(&path, 0.35), 0.012, 8, Material::Steel));
    let inner = [gx + 0.025, gy - 0.13, gz];
    to.add_pair(tube(&[inner, grip], 0.019, 10, Material::Rubber));
    to.add_pair(tube(
        &[[inner[0] + 0.02, inner[1], gz], [gx + 0.075, gy - 0.02, gz - 0.01]],
        0.007,
        6,
        Material::Aluminium,
    ));
}

/// A mirror on its stalk.
pub(crate) fn mirror(root: [f64; 3], head: [f64; 3], to: &mut Assembly) {
    to.add_pair(tube(
        &bent(&[root, [root[0] + 0.03, 0.5 * (root[1] + head[1]), head[2] - 0.04], head], 0.4),
        0.006,
        6,
        Material::Plastic,
    ));
    to.add_pair(ellipsoid([0.025, 0.062, 0.04], 12, Material::Plastic).moved(head[0], head[1], head[2]));
    let glass = disc(0.033, 0.006, 12, Material::Glass).map(|p| DVec3::new(-p.y, 1.55 * p.x, p.z)).outward();
    to.add_pair(glass.moved(head[0] - 0.021, head[1], head[2]));
}

/// A mudguard over the sector of the wheel between two angles from +x towards +z.
pub(crate) fn mudguard(axle: [f64; 2], radius_m: f64, half_width_m: f64, [from, to]: [f64; 2]) -> Surface {
    let steps = 8;
    let row = |k: usize| {
        let angle = (from + (to - from) * k as f64 / steps as f64).to_radians();
        let at = |radius: f64, y: f64| {
            DVec3::new(axle[0] + radius * angle.cos(), y, axle[1] + radius * angle.sin())
        };
        let (top, side) = (radius_m, radius_m - 0.03);
        let outer = [(side, -1.0), (top - 0.008, -0.75), (top, 0.0), (top - 0.008, 0.75), (side, 1.0)];
        let inner = [
            (side - 0.002, 0.93),
            (top - 0.014, 0.7),
            (top - 0.006, 0.0),
            (top - 0.014, -0.7),
            (side - 0.002, -0.93),
        ];
        let mut points: Vec<DVec3> =
            outer.iter().chain(&inner).map(|(r, y)| at(*r, y * half_width_m)).collect();
        points.push(points[0]);
        points
    };
    let rows: Vec<_> = (0..=steps).map(row).collect();
    let mut guard = Surface::from_rows(&rows, Material::Paint);
    for (row, first) in [(&rows[0], true), (&rows[steps], false)] {
        for k in 0..4 {
            // Between the outer line, left to right, and the inner one.
            let quad = [row[k], row[k + 1], row[8 - k], row[9 - k]];
            guard.push_quad(if first { [quad[3], quad[2], quad[1], quad[0]] } else { quad }, Material::Paint);
        }
    }
    guard.welded().outward()
}

/// Rear plate (German single-line two-wheeler plate, 180 × 200 mm) and lamp.
pub(crate) fn tail(x: f64, lamp_z: f64, plate_z: f64, to: &mut Assembly) {
    to.add(sharp_box([0.05, 0.16, 0.05], Material::TailLamp).moved(x, 0.0, lamp_z));
    to.add(sharp_box([0.008, 0.18, 0.20], Material::Plate).moved(x - 0.02, 0.0, plate_z));
    to.add(tube(
        &[[x + 0.06, 0.0, lamp_z - 0.02], [x + 0.01, 0.0, plate_z + 0.04]],
        0.018,
        8,
        Material::Plastic,
    ));
    for k in [-1.0, 1.0] {
        to.add(ellipsoid([0.03, 0.035, 0.02], 10, Material::Lamp).moved(x, 0.14 * k, lamp_z - 0.01));
        to.add(tube(&[[x, 0.0, lamp_z - 0.01], [x, 0.12 * k, lamp_z - 0.01]], 0.006, 6, Material::Plastic));
    }
}

/// Foot rest with its hanger.
pub(crate) fn foot_rest(at: [f64; 3], inner_y: f64, to: &mut Assembly) {
    to.add_pair(tube(&[[at[0], inner_y, at[2]], at], 0.013, 8, Material::Aluminium));
}
