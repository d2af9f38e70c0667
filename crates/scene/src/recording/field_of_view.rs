//! Recorded traffic in view of a radar: within range and on the side of its boresight.

use glam::DVec2;

/// A sector on the ground, its tip at the radar's foot.
pub(crate) struct FieldOfView {
    pub(crate) foot_m: DVec2,
    /// Unit vector of the boresight.
    pub(crate) boresight: DVec2,
    /// Nearest distance in view: anything nearer is below the beam.
    pub(crate) nearest_m: f64,
    pub(crate) range_m: f64,
    pub(crate) half_angle_rad: f64,
}

impl FieldOfView {
    /// Largest distance in view from the radar's foot.
    pub(crate) fn range_m(&self) -> f64 {
        self.range_m
    }

    /// Whether a straight part of a road is within range, on any side.
    pub(crate) fn reaches(&self, from_m: DVec2, to_m: DVec2) -> bool {
        let (along, to_foot) = (to_m - from_m, self.foot_m - from_m);
        let share = (to_foot.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (to_foot - share * along).length() <= self.range_m
    }

    /// Whether a disc on the ground intersects the sector, and no part of it is nearer than the nearest
    /// distance.
    pub(crate) fn touches(&self, centre_m: DVec2, radius_m: f64) -> bool {
        let away = centre_m - self.foot_m;
        let nearest_m = away.length() - radius_m;
        if nearest_m > self.range_m || (self.nearest_m > 0.0 && nearest_m < self.nearest_m) {
            return false;
        }
        // The half of the sector with the disc in it, boresight to the right.
        let at = DVec2::new(away.dot(self.boresight), away.perp_dot(self.boresight).abs());
        if at.y.atan2(at.x) <= self.half_angle_rad {
            return true;
        }
        let side = DVec2::from_angle(self.half_angle_rad);
        at.distance(side * at.dot(side).max(0.0)) <= radius_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(half_angle_deg: f64) -> FieldOfView {
        let half_angle_rad = f64::to_radians(half_angle_deg);
        FieldOfView {
            foot_m: DVec2::new(1.0, 0.0),
            boresight: DVec2::Y,
            nearest_m: 0.0,
            range_m: 50.0,
            half_angle_rad,
        }
    }

    #[test]
    fn a_disc_is_in_view_as_soon_as_its_rim_is() {
        let half_plane = view(90.0);
        for (centre, radius, expected) in [
            ([1.0, 52.0], 2.1, true),
            ([1.0, 52.0], 1.9, false),
            ([20.0, -2.0], 2.1, true),
            ([20.0, -2.0], 1.9, false),
            ([-20.0, 0.1], 0.0, true),
        ] {
            assert_eq!(half_plane.touches(DVec2::from(centre), radius), expected, "{centre:?} {radius}");
        }
        // 45° to either side: the disc at 10 m across and none ahead is 10/√2 m from the edge.
        for x in [11.0, -9.0] {
            assert!(!view(45.0).touches(DVec2::new(x, 0.0), 7.0));
            assert!(view(45.0).touches(DVec2::new(x, 0.0), 7.1));
        }
        assert!(view(45.0).touches(DVec2::new(1.0, -3.0), 3.1), "the foot is the sector's tip");
        assert!(!view(45.0).touches(DVec2::new(1.0, -3.0), 2.9));
        let above = FieldOfView { nearest_m: 12.0, ..view(90.0) };
        assert!(above.touches(DVec2::new(1.0, 16.1), 4.0));
        assert!(!above.touches(DVec2::new(1.0, 15.9), 4.0), "its near end stands below the beam");
    }
}
