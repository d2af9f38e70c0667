//! Bounding box of a tracked body: the extent of its points along its heading, over frames.
//!
//! The bright parts of a body change from frame to frame, so the box reflects recent observations: an end
//! moves outwards to a point quickly and returns slowly. Across, points are little evidence: a beam of 8.5°
//! is 6 m wide at 40 m.

use crate::tracking::kalman::Estimate;
use crate::tracking::measurement::turned;
use artifact::tracks::Footprint;
use glam::DVec2;
use std::f64::consts::FRAC_PI_2;

/// Extent of a body before and behind the mean position of its reflecting parts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Body {
    heading_rad: f64,
    ends_m: [f64; 2],
    is_seen: bool,
}

/// Share of the distance moved per frame towards an end seen beyond the present one, and towards one seen
/// short of it.
const OUTWARDS: f64 = 0.5;
const INWARDS: f64 = 0.05;
/// Speed below which a body keeps its heading, since velocity then gives none.
const SLOWEST_MPS: f64 = 1.0;
/// Length of the shortest cars, m; which end is visible is unknown, so half of the unseen part is allowed for
/// on either side.
const SHORTEST_M: f64 = 4.0;
/// Standard deviations from zero at which a velocity determines the heading.
const SURE: f64 = 3.0;

impl Body {
    /// Body of zero extent with a heading.
    pub(super) fn new(heading_rad: f64) -> Self {
        Self { heading_rad, ends_m: [0.0; 2], is_seen: false }
    }

    /// Turns towards the velocity, if there is any.
    pub(super) fn update_heading(&mut self, state: &Estimate) {
        let velocity = DVec2::new(state.mean.z, state.mean.w);
        let [xx, yy] = [state.covariance.col(2).z, state.covariance.col(3).w];
        if velocity.length() < SLOWEST_MPS.max(SURE * (xx + yy).max(0.0).sqrt()) {
            return;
        }
        let heading_rad = velocity.y.atan2(velocity.x);
        if turned(heading_rad - self.heading_rad).abs() > FRAC_PI_2 {
            self.ends_m = [-self.ends_m[1], -self.ends_m[0]];
        }
        self.heading_rad = heading_rad;
    }

    /// Updates the extent with this frame's points; the outermost lie a cell beyond the body.
    pub(super) fn update_extent(
        &mut self,
        state: &Estimate,
        points: impl Iterator<Item = DVec2>,
        cell_m: f64,
    ) {
        let middle = DVec2::new(state.mean.x, state.mean.y);
        let along = points.map(|p| (p - middle).dot(self.forward()));
        let [back, front] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)]);
        if back > front {
            return;
        }
        let trim_m = cell_m.min(0.5 * (front - back));
        let seen = [back + trim_m, front - trim_m];
        let toward = |end: f64, seen: f64, is_beyond: bool| {
            let share = if is_beyond { OUTWARDS } else { INWARDS };
            end + share * (seen - end)
        };
        let [old_back, old_front] = self.ends_m;
        self.ends_m = if self.is_seen {
            [toward(old_back, seen[0], seen[0] < old_back), toward(old_front, seen[1], seen[1] > old_front)]
        } else {
            seen
        };
        self.is_seen = true;
    }

    /// Whether a position lies in the box, widened by `margin_m` on all sides; a box of which little was seen
    /// extends as far as the shortest car.
    pub(super) fn contains(&self, state: &Estimate, place: DVec2, width_m: f64, margin_m: f64) -> bool {
        let away = place - DVec2::new(state.mean.x, state.mean.y);
        let (along, across) = (away.dot(self.forward()), away.perp_dot(self.forward()));
        let unseen_m = 0.5 * (SHORTEST_M - (self.ends_m[1] - self.ends_m[0])).max(0.0);
        let [back, front] = [self.ends_m[0] - unseen_m, self.ends_m[1] + unseen_m];
        (back - margin_m..=front + margin_m).contains(&along) && across.abs() <= 0.5 * width_m + margin_m
    }

    /// Box as seen from a radar's position: no shorter than a car. The unseen part of a car lies behind the
    /// seen part, the more so the more the radar looks along the body.
    pub(super) fn footprint(&self, state: &Estimate, width_m: f64, radar_m: DVec2) -> Footprint {
        let middle = DVec2::new(state.mean.x, state.mean.y);
        let away = (middle - radar_m).normalize_or_zero().dot(self.forward());
        let unseen_m = (SHORTEST_M - (self.ends_m[1] - self.ends_m[0])).max(0.0);
        let back = self.ends_m[0] - 0.5 * (1.0 - away) * unseen_m;
        let front = self.ends_m[1] + 0.5 * (1.0 + away) * unseen_m;
        let centre = middle + self.forward() * (0.5 * (back + front));
        Footprint {
            centre_m: centre.to_array(),
            length_m: front - back,
            width_m,
            heading_rad: self.heading_rad,
        }
    }

    fn forward(&self) -> DVec2 {
        DVec2::from_angle(self.heading_rad)
    }
}
