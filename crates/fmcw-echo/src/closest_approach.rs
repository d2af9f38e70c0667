//! How near a path's moving apparent point comes to the antenna elements within a frame.

use artifact::Radar;
use artifact::paths::Path;
use glam::DVec3;

/// One of the two legs of a path: the elements at its end, its apparent point and that point's velocity.
pub(crate) struct Leg<'a> {
    /// "transmit" or "receive".
    pub(crate) element: &'static str,
    elements_m: &'a [[f64; 3]],
    point_m: DVec3,
    velocity_mps: DVec3,
}

impl<'a> Leg<'a> {
    /// Both legs of a path.
    pub(crate) fn of(radar: &'a Radar, path: &Path) -> [Self; 2] {
        let leg = |element, elements_m, point_m, velocity_mps| Leg {
            element,
            elements_m,
            point_m: DVec3::from_array(point_m),
            velocity_mps: DVec3::from_array(velocity_mps),
        };
        [
            leg("transmit", &radar.array.tx_m, path.apparent_tx_m, path.apparent_tx_mps),
            leg("receive", &radar.array.rx_m, path.apparent_rx_m, path.apparent_rx_mps),
        ]
    }

    /// Index of the element that the point comes nearest to, and how near.
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

    /// |v|, m/s.
    pub(crate) fn speed_mps(&self) -> f64 {
        self.velocity_mps.length()
    }

    fn closest_approach_m(&self, radar: &Radar, element_m: DVec3) -> f64 {
        let from_element_m = self.point_m - element_m;
        let square = self.velocity_mps.length_squared();
        let nearest_s = if square > 0.0 { -from_element_m.dot(self.velocity_mps) / square } else { 0.0 };
        (from_element_m + self.velocity_mps * nearest_s.clamp(0.0, radar.frame_duration_s())).length()
    }
}
