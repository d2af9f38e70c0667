//! Closest approach of a path's moving apparent point to the antenna elements within a frame.

use artifact::Radar;
use artifact::paths::Path;
use glam::DVec3;

/// One of the two legs of a path: the elements at its end, its apparent point and the point's velocity.
pub(crate) struct MovingLeg<'a> {
    /// End of the path, "transmit" or "receive".
    pub(crate) element: &'static str,
    elements_m: &'a [[f64; 3]],
    point_m: DVec3,
    velocity_mps: DVec3,
    acceleration_mps2: f64,
    rim_radius_m: Option<f64>,
}

impl<'a> MovingLeg<'a> {
    /// Both legs of a path.
    pub(crate) fn of(radar: &'a Radar, path: &Path) -> [Self; 2] {
        let curve = &path.curve;
        let leg = |element, elements_m, point_m, velocity_mps, acceleration_mps2| MovingLeg {
            element,
            elements_m,
            point_m: DVec3::from_array(point_m),
            velocity_mps: DVec3::from_array(velocity_mps),
            acceleration_mps2: DVec3::from_array(acceleration_mps2).length(),
            rim_radius_m: curve.rim.map(|rim| rim.radius_m),
        };
        let (tx_m, rx_m) = (&radar.array.tx_m, &radar.array.rx_m);
        [
            leg("transmit", tx_m, path.apparent_tx_m, path.apparent_tx_mps, curve.apparent_tx_mps2),
            leg("receive", rx_m, path.apparent_rx_m, path.apparent_rx_mps, curve.apparent_rx_mps2),
        ]
    }

    /// Index of the element closest to the point within the frame, and the distance, m.
    pub(crate) fn nearest(&self, radar: &Radar) -> (usize, f64) {
        let mut nearest = (0, f64::INFINITY);
        for (index, &element_m) in self.elements_m.iter().enumerate() {
            let distance_m = self.closest_approach_m(radar, DVec3::from_array(element_m));
            if distance_m < nearest.1 {
                nearest = (index, distance_m);
            }
        }
        nearest
    }

    /// Maximum speed in a frame, m/s: the top of a rolling wheel is twice as fast as its hub.
    pub(crate) fn speed_mps(&self, radar: &Radar) -> f64 {
        let of_hub_mps = self.velocity_mps.length() + self.acceleration_mps2 * radar.frame_duration_s();
        if self.rim_radius_m.is_some() { 2.0 * of_hub_mps } else { of_hub_mps }
    }

    /// Magnitude of the acceleration |a|, m/s².
    pub(crate) fn acceleration_mps2(&self) -> f64 {
        self.acceleration_mps2
    }

    fn closest_approach_m(&self, radar: &Radar, element_m: DVec3) -> f64 {
        let from_element_m = self.point_m - element_m;
        let square = self.velocity_mps.length_squared();
        let nearest_s = if square > 0.0 { -from_element_m.dot(self.velocity_mps) / square } else { 0.0 };
        let straight_m =
            (from_element_m + self.velocity_mps * nearest_s.clamp(0.0, radar.frame_duration_s())).length();
        // Lower bound, reduced by the displacement that acceleration and wheel can cause.
        let aside_m = 0.5 * self.acceleration_mps2 * radar.frame_duration_s().powi(2)
            + self.rim_radius_m.unwrap_or(0.0);
        (straight_m - aside_m).max(0.0)
    }
}
