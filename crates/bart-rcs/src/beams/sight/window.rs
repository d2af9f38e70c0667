//! Clipping of a facet to the window of a view.

use crate::beams::sight::shadow::{LitSide, Shadow};
use crate::beams::sight::view::View;
use crate::geometry::border::Border;
use crate::geometry::clip::{Corner, Split, split};
use artifact::settings::Sides;
use glam::DVec3;
use std::ops::Range;

impl View<'_> {
    /// Puts the polygon that the window leaves of a facet into `corners` and gives its range; `None` where it
    /// leaves none.
    pub(crate) fn clip(
        &self,
        target: &Shadow,
        corners: &mut Vec<Corner>,
        distances_m: &mut Vec<f64>,
    ) -> Option<Range<usize>> {
        if self.sides == Sides::One && target.seen == LitSide::Back || !self.is_followed(target.facet) {
            return None;
        }
        corners.clear();
        corners.extend(target.polygon(self.world));
        // A facet that crosses the mirror's plane ends at the plane that also ends its shadow.
        let beyond = target.beyond_mirror.map(|plane| (plane, Border::Tied));
        self.window.iter().copied().chain(beyond).try_fold(0..3, |polygon, (plane, border)| {
            match split(corners, polygon.clone(), &plane, [border; 2], self.tolerance_m(), distances_m) {
                Split::Inside => {
                    self.meet(&mut corners[polygon.clone()], distances_m, border);
                    Some(polygon)
                }
                Split::Outside => None,
                Split::Cut { inside, .. } => Some(inside),
            }
        })
    }

    /// Marks edges that lie on a plane of the window, whose distances from the corners are given. An own edge
    /// is one line with the window's only at a fold, where it lies on the mirror: elsewhere a seam of the
    /// mirror's light may lie in one plane with it, as below a wall's upright edge, and it stays its own.
    fn meet(&self, corners: &mut [Corner], distances_m: &[f64], window: Border) {
        let n = corners.len();
        for i in (0..n).filter(|&i| distances_m[i] == 0.0 && distances_m[(i + 1) % n] == 0.0) {
            let is_at_fold = [i, (i + 1) % n].iter().all(|&end| self.is_on_mirror(corners[end].point_m));
            if is_at_fold || corners[i].border != Border::Own {
                corners[i].border = corners[i].border.met_by(window);
            }
        }
    }

    /// Whether a point lies on the mirror's plane; any does where nothing is mirrored.
    fn is_on_mirror(&self, point_m: DVec3) -> bool {
        self.mirror.is_none_or(|mirror| mirror.front.distance_m(point_m).abs() <= self.tolerance_m())
    }
}
