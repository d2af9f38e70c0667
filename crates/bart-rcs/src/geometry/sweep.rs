//! Conservative test of boxes against the sweep of a beam behind its opening.
//!
//! A beam passes a small box like a ray: planes through its edges reject few of the boxes beside it, since
//! few of them face the box's corners. A box misses every ray that leaves its slabs in another order than it
//! entered them (Kay, Kajiya, SIGGRAPH (1986) 269), and with intervals for the rays' starts and directions it
//! misses all of them at once (Boulos, Wald, Shirley, Univ. of Utah UUCS-06-010 (2006)).

use crate::geometry::antenna::Antenna;
use glam::{DMat3, DVec3, Vec4};

/// The points x + s·d, s ≥ 0, with x and d in boxes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BeamSweep {
    /// Low and high corner of the box of starts.
    starts_m: [DVec3; 2],
    /// Low and high corner of the box of directions, of length about 1.
    directions: [DVec3; 2],
}

/// A sweep prepared for testing four single-precision boxes side by side.
pub(crate) struct SlabTest {
    /// Bounds of s, the lower ones first.
    bounds_of_s: [Slab; 6],
    entries: usize,
}

/// A bound of s: (coordinate − start)/direction.
#[derive(Clone, Copy)]
struct Slab {
    /// Index of the coordinate among low x, y, z, high x, y, z.
    coordinate: usize,
    start: Vec4,
    inverse: Vec4,
}

impl BeamSweep {
    /// Sweep of a wave from `antenna` behind an opening (convex; world), in a body's frame, widened by
    /// `slack_m`.
    pub(crate) fn behind(
        opening_m: &[DVec3],
        antenna: Antenna,
        body_from_world: &DMat3,
        position_m: DVec3,
        slack_m: f64,
    ) -> Self {
        // Directions of one scale, so that those between two corners lie between theirs.
        let scale = opening_m.first().map_or(1.0, |corner| antenna.towards(*corner).length());
        let start = |corner: &DVec3| *body_from_world * (*corner - position_m);
        let direction = |corner: &DVec3| *body_from_world * (-antenna.towards(*corner) / scale);
        let [low, high] = around(opening_m.iter().map(start));
        Self {
            starts_m: [low - slack_m, high + slack_m],
            directions: around(opening_m.iter().map(direction)),
        }
    }

    /// Test for boxes around `middle_m` that extend no farther than `reach_m` from it.
    ///
    /// Single-precision starts and bounds are off by ε/2 of their size; a bound of s by three roundings, for
    /// which the directions are widened. Widening holds more boxes, never fewer.
    pub(crate) fn slabs(&self, middle_m: DVec3, reach_m: f64) -> SlabTest {
        let [low, high] = self.starts_m.map(|start| start - middle_m);
        let far_m = reach_m + low.abs().max(high.abs()).max_element();
        let slack_m = 8.0 * f64::from(f32::EPSILON) * far_m;
        let mut test = SlabTest {
            bounds_of_s: [Slab { coordinate: 0, start: Vec4::ZERO, inverse: Vec4::ZERO }; 6],
            entries: 0,
        };
        let mut exits = 6;
        for coordinate in 0..6 {
            let (axis, is_low) = (coordinate % 3, coordinate < 3);
            let (start, direction) = if is_low {
                (high[axis] + slack_m, widened(self.directions[1][axis], 1.0))
            } else {
                (low[axis] - slack_m, widened(self.directions[0][axis], -1.0))
            };
            let slab = Slab {
                coordinate,
                start: Vec4::splat(start as f32),
                inverse: Vec4::splat((1.0 / direction) as f32),
            };
            if (direction > 0.0) == is_low {
                test.bounds_of_s[test.entries] = slab;
                test.entries += 1;
            } else {
                exits -= 1;
                test.bounds_of_s[exits] = slab;
            }
        }
        test
    }
}

impl SlabTest {
    /// Bit mask of the boxes that the sweep misses; `bounds` are low x, y, z, high x, y, z of four.
    #[inline]
    pub(crate) fn missed(&self, bounds: &[Vec4; 6]) -> u32 {
        let s = |slab: &Slab| (bounds[slab.coordinate] - slab.start) * slab.inverse;
        let (entries, exits) = self.bounds_of_s.split_at(self.entries);
        let entry = entries.iter().fold(Vec4::ZERO, |latest, slab| s(slab).max(latest));
        let exit = exits.iter().fold(Vec4::INFINITY, |first, slab| s(slab).min(first));
        // Overflow gives NaN, which misses nothing.
        entry.cmpgt(exit).bitmask()
    }
}

/// Smallest box around some points: its low and high corner.
fn around(points: impl Iterator<Item = DVec3>) -> [DVec3; 2] {
    points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// A bound of a direction moved outwards by the rounding of its inverse and the product, and away from zero.
fn widened(direction: f64, outwards: f64) -> f64 {
    let moved = direction + outwards * 4.0 * f64::from(f32::EPSILON) * direction.abs();
    if moved == 0.0 { outwards * f64::from(f32::MIN_POSITIVE) } else { moved }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fractional parts of multiples of irrational numbers, −½ … ½.
    fn at(i: usize, step: f64) -> f64 {
        ((i as f64 + 1.0) * step).fract() - 0.5
    }

    fn point(i: usize) -> DVec3 {
        DVec3::new(at(i, 0.618_034), at(i, 0.414_214), at(i, 0.732_051))
    }

    #[test]
    fn a_box_around_a_point_of_the_beam_is_never_missed_and_most_others_are() {
        let (mut missed, mut all) = (0, 0);
        for i in 0..2000 {
            let opening = [0, 1, 2].map(|k| point(i) + 0.02 * point(3 * i + k));
            let towards = point(i + 7) * if i % 5 == 0 { DVec3::new(1.0, 0.0, 0.0) } else { DVec3::ONE };
            let antenna = match i % 3 {
                0 => Antenna::Direction(towards / towards.length()),
                1 => Antenna::Point(point(i) + 40.0 * towards),
                _ => Antenna::Point(point(i) + 5e3 * towards),
            };
            let frame = DMat3::from_rotation_z(0.1 * i as f64);
            let (position_m, middle_m) = (DVec3::new(3.0, -2.0, 0.5), DVec3::new(0.1, 0.2, 0.3));
            let slabs = BeamSweep::behind(&opening, antenna, &frame, position_m, 1e-12).slabs(middle_m, 20.0);
            let corner = opening[0].lerp(opening[1], 0.3).lerp(opening[2], 0.4);
            let way = -antenna.towards(corner) / antenna.towards(corner).length();
            // Around points of the beam, and around points beside it.
            let lanes = [0.0, 0.7, 5.0, 9.0].map(|s| frame * (corner + s * way - position_m) - middle_m);
            let strewn = [1, 2, 3, 4].map(|k| 8.0 * point(11 * i + k));
            let half = 0.1 * (point(i + 3) + 0.5) + 1e-6;
            let bounds = |centres: [DVec3; 4]| -> [Vec4; 6] {
                std::array::from_fn(|b| {
                    let side = if b < 3 { -half } else { half };
                    Vec4::from_array(centres.map(|centre| (centre + side)[b % 3] as f32))
                })
            };
            assert_eq!(slabs.missed(&bounds(lanes)), 0, "case {i}");
            missed += slabs.missed(&bounds(strewn)).count_ones();
            all += 4;
        }
        println!("{missed} of {all} boxes beside the beams are told to be missed");
        assert!(missed > all * 9 / 10);
    }
}
