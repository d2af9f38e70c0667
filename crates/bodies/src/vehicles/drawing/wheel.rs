//! Road wheels: tyre and rim with depth, axle along y, outer face towards +y.

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::solids::{disc, ellipsoid, lathe};
use crate::vehicles::drawing::stencil::{CutTreatment, cut, soft_minimum};
use crate::vehicles::drawing::surface::{Material, Surface};
use glam::DVec3;
use std::f64::consts::TAU;

/// Form of a rim.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rim {
    /// Cast spokes with deep gaps between.
    Spoked { spokes: u32 },
    /// Steel disc of a heavy vehicle, convex outwards, with hand holes.
    SteelConvex,
    /// The same disc reversed: the outer wheel of a twin pair.
    SteelConcave,
}

/// Size and kind of a wheel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wheel {
    pub(crate) radius_m: f64,
    pub(crate) width_m: f64,
    pub(crate) rim_radius_m: f64,
    pub(crate) rim: Rim,
    pub(crate) sectors: usize,
}

impl Wheel {
    /// Adds a wheel on the left, on the ground, with its outer face at `outer_y`, and its mirror image.
    pub(crate) fn add_pair(&self, to: &mut Assembly, axle_x: f64, outer_y: f64) {
        let at = [axle_x, outer_y - 0.5 * self.width_m, self.radius_m];
        for part in [self.tyre(), self.rim()] {
            to.add_pair_of_wheels(part.moved(at[0], at[1], at[2]));
        }
    }

    /// Adds the inner wheels of twins, of which only the tyres are visible.
    pub(crate) fn add_inner_pair(&self, to: &mut Assembly, axle_x: f64, outer_y: f64) {
        let half = 0.5 * self.width_m;
        let outer =
            [(self.rim_radius_m, 0.8 * half), (0.9 * self.radius_m, half), (self.radius_m, 0.6 * half)];
        let tyre = lathe(&mirrored_profile(&outer), self.sectors, Material::Rubber);
        to.add_pair_of_wheels(tyre.moved(axle_x, outer_y - half, self.radius_m));
    }

    /// A closed ring: bead, side wall, shoulder, tread and back through the bore.
    fn tyre(&self) -> Surface {
        let (r, bead, half) = (self.radius_m, self.rim_radius_m, 0.5 * self.width_m);
        let wall = r - bead;
        // A car's tread is crowned between round shoulders, a truck's is flat.
        let outer = match self.rim {
            Rim::Spoked { .. } => vec![
                (bead, 0.80 * half),
                (bead + 0.50 * wall, half),
                (r - 0.13 * wall, 0.90 * half),
                (r - 0.02 * wall, 0.68 * half),
                (r, 0.25 * half),
            ],
            Rim::SteelConvex | Rim::SteelConcave => {
                vec![
                    (bead, 0.80 * half),
                    (bead + 0.50 * wall, half),
                    (r - 0.09 * wall, 0.92 * half),
                    (r, 0.78 * half),
                ]
            }
        };
        lathe(&mirrored_profile(&outer), self.sectors, Material::Rubber)
    }

    fn rim(&self) -> Surface {
        match self.rim {
            Rim::Spoked { spokes } => self.spoked_rim(spokes),
            Rim::SteelConvex => self.steel_rim(0.75),
            Rim::SteelConcave => self.steel_rim(-0.2),
        }
    }

    fn spoked_rim(&self, spokes: u32) -> Surface {
        let (r, half) = (self.rim_radius_m, 0.5 * self.width_m);
        let face = 0.62 * half;
        let profile = [
            (0.0, face + 0.012),
            (0.20 * r, face - 0.008),
            (0.34 * r, face - 0.006),
            (0.76 * r, face + 0.004),
            (0.86 * r, face - 0.004),
            (0.92 * r, 0.84 * half),
            (1.01 * r, 0.86 * half),
            (0.95 * r, -0.5 * half),
            (0.0, -0.5 * half),
        ];
        let rim = lathe(&profile, self.sectors, Material::Aluminium);
        let gaps = |p: DVec3| {
            let radius = p.x.hypot(p.z);
            let turn = p.z.atan2(p.x) / TAU * f64::from(spokes);
            let from_spoke = 0.5 - (turn - turn.floor() - 0.5).abs();
            let across = from_spoke * TAU * radius / f64::from(spokes) - 0.10 * r;
            soft_minimum(&[across, radius - 0.28 * r, 0.84 * r - radius, p.y], 0.02)
        };
        let depth_m = 0.45 * half;
        cut(rim, gaps, CutTreatment::Inset { material: Material::Steel, rim: Material::Aluminium, depth_m })
    }

    /// Steel disc of a wheel; `bulge` is the position of its middle, as a share of the half width.
    fn steel_rim(&self, bulge: f64) -> Surface {
        let (r, half) = (self.rim_radius_m, 0.5 * self.width_m);
        let (hub, foot) = (bulge * half, bulge.min(0.45) * half);
        let profile = [
            (0.0, hub + 0.05),
            (0.20 * r, hub + 0.045),
            (0.26 * r, hub),
            (0.52 * r, hub),
            (0.66 * r, 0.5 * (hub + foot)),
            (0.84 * r, foot - 0.03),
            (0.91 * r, 0.80 * half),
            (1.02 * r, 0.86 * half),
            (0.95 * r, -0.5 * half),
            (0.0, -0.5 * half),
        ];
        let rim = lathe(&profile, self.sectors, Material::Steel);
        let holes = |p: DVec3| {
            let turn = p.z.atan2(p.x) / TAU * 8.0;
            let along = (turn - turn.floor() - 0.5).abs() * TAU * 0.67 * r / 8.0;
            let from_middle = (p.x.hypot(p.z) - 0.67 * r).hypot(along);
            (0.09 * r - from_middle).min(p.y - foot + 0.1)
        };
        cut(
            rim,
            holes,
            CutTreatment::Inset { material: Material::Plastic, rim: Material::Steel, depth_m: 0.03 },
        )
    }
}

/// The outer half of a ring's outline, its mirror image, and the first point again.
fn mirrored_profile(outer: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let inner = outer.iter().rev().map(|(radius, y)| (*radius, -y));
    outer.iter().copied().chain(inner).chain([outer[0]]).collect()
}

/// Geometry of a wheel-arch liner.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArchLiner {
    pub(crate) axle: [f64; 2],
    pub(crate) radius_m: f64,
    /// Height of its lower ends, level with the underside.
    pub(crate) low_z: f64,
    /// Positions of its inner wall and of its open side.
    pub(crate) inner_y: f64,
    pub(crate) outer_y: f64,
}

/// The liner of the wheel arch on the left: a half drum of sheet, open towards the wheel.
pub(crate) fn arch_liner(liner: &ArchLiner) -> Surface {
    let (steps, sheet) = (12, 0.012);
    let ArchLiner { axle, radius_m, low_z, inner_y, outer_y } = *liner;
    let dip = ((axle[1] - low_z) / radius_m).clamp(-0.9, 0.9).asin();
    let row = |k: usize| {
        let angle = -dip + (std::f64::consts::PI + 2.0 * dip) * k as f64 / steps as f64;
        let at = |radius: f64, y: f64| {
            DVec3::new(axle[0] + radius * angle.cos(), y, axle[1] + radius * angle.sin())
        };
        let (core, outside) = (0.3 * radius_m, radius_m + sheet);
        let section = [
            at(core, inner_y),
            at(radius_m, inner_y),
            at(radius_m, outer_y),
            at(outside, outer_y),
            at(outside, inner_y - sheet),
            at(core, inner_y - sheet),
        ];
        section.into_iter().chain([at(core, inner_y)]).collect::<Vec<_>>()
    };
    let rows: Vec<_> = (0..=steps).map(row).collect();
    let mut surface = Surface::from_rows(&rows, Material::Plastic);
    for (row, first) in [(&rows[0], true), (&rows[steps], false)] {
        // The section is an L of two rectangles.
        for quad in [[0, 1, 4, 5], [1, 2, 3, 4]] {
            let corners = quad.map(|k: usize| row[k]);
            surface.push_quad(
                if first { [corners[3], corners[2], corners[1], corners[0]] } else { corners },
                Material::Plastic,
            );
        }
    }
    surface.welded().outward()
}

/// A live axle with its differential, or a plain beam.
pub(crate) fn axle(axle_x: f64, axle_z: f64, half_track_m: f64, drive: Drive) -> Surface {
    let (tube_radius, casing) = match drive {
        Drive::Driven { casing_radius_m } => (0.35 * casing_radius_m, casing_radius_m),
        Drive::Plain { radius_m } => (radius_m, 0.0),
    };
    let mut axle = disc(tube_radius, 2.0 * half_track_m, 8, Material::Steel);
    if casing > 0.0 {
        axle.append(ellipsoid([casing, 0.8 * casing, casing], 10, Material::Steel));
    }
    axle.moved(axle_x, 0.0, axle_z)
}

/// Whether an axle carries a differential.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Drive {
    /// The axle has a casing in the middle.
    Driven { casing_radius_m: f64 },
    /// The axle is a beam.
    Plain { radius_m: f64 },
}
