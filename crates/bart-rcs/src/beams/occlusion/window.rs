//! Clipping of a facet to the window of a view.

use crate::beams::occlusion::shadow::{LitSide, Shadow};
use crate::beams::occlusion::view::View;
use crate::geometry::border::{Border, BorderLine};
use crate::geometry::clip::{Corner, Split, split};
use artifact::settings::Sides;
use std::ops::Range;

impl View<'_> {
    /// Appends the part of a facet inside the window to `corners` and returns its range; `None` if there is
    /// none.
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
        // A facet that crosses the mirror's plane ends at the same plane as its shadow.
        let beyond = target.beyond_mirror.map(|plane| (plane, Border::Tied.into()));
        self.window.iter().copied().chain(beyond).try_fold(0..3, |polygon, (plane, border)| {
            match split(corners, polygon.clone(), &plane, border, self.tolerance_m(), distances_m) {
                Split::Inside => {
                    meet(&mut corners[polygon.clone()], distances_m, border);
                    Some(polygon)
                }
                Split::Outside => None,
                Split::Cut { inside, .. } => Some(inside),
            }
        })
    }
}

/// Marks edges that lie on a plane of the window, given the corners' distances from it.
fn meet(corners: &mut [Corner], distances_m: &[f64], window: BorderLine) {
    let n = corners.len();
    for i in (0..n).filter(|&i| distances_m[i] == 0.0 && distances_m[(i + 1) % n] == 0.0) {
        corners[i].border = corners[i].border.met_by(window);
    }
}
