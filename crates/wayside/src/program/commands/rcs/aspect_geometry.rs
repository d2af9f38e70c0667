//! Geometry of one aspect of a table: range of a place beyond the origin, and its cross-range coordinate.

use artifact::scene::Mesh;
use bart_rcs::{RcsRequest, Standpoint};
use glam::DVec3;

/// Antennas of an azimuth at the first elevation.
#[derive(Debug, Clone, Copy)]
pub(super) struct AspectGeometry {
    transmitter: Standpoint,
    /// Fixed receiver; `None` if it moves with the transmitter.
    receiver: Option<Standpoint>,
}

/// Least and greatest range beyond the origin and cross-range coordinate of a body, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pub(super) range_m: [f64; 2],
    pub(super) across_m: [f64; 2],
}

impl AspectGeometry {
    pub(super) fn of(request: &RcsRequest, azimuth_rad: f64) -> Self {
        let elevation_rad = request.elevation_rad.first().copied().unwrap_or(0.0);
        let transmitter = Standpoint { azimuth_rad, elevation_rad, range_m: request.range_m };
        Self { transmitter, receiver: request.receiver }
    }

    /// Half the two-way distance, relative to that of the origin.
    pub(super) fn range_m(&self, place_m: DVec3) -> f64 {
        let [there_m, back_m] =
            [self.transmitter, self.receiver.unwrap_or(self.transmitter)].map(|at| beyond_m(&at, place_m));
        0.5 * (there_m + back_m)
    }

    /// Rate at which the distance to a moving antenna decreases with azimuth: the cross-range coordinate, m
    /// per radian.
    pub(super) fn across_m(&self, place_m: DVec3) -> f64 {
        let Standpoint { azimuth_rad, elevation_rad, range_m } = self.transmitter;
        let (sin, cos) = azimuth_rad.sin_cos();
        let across_m = elevation_rad.cos() * DVec3::new(-sin, cos, 0.0).dot(place_m);
        across_m
            / (1.0 + if range_m.is_finite() { beyond_m(&self.transmitter, place_m) / range_m } else { 0.0 })
    }

    /// Number of antennas that move with the azimuth: 2, or 1 with a fixed receiver.
    pub(super) fn moving(&self) -> f64 {
        if self.receiver.is_some() { 1.0 } else { 2.0 }
    }

    pub(super) fn extent(&self, mesh: &Mesh) -> Extent {
        const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];
        let wider = |[low, high]: [f64; 2], v: f64| [low.min(v), high.max(v)];
        let places = mesh.vertices_m.iter().map(|v| DVec3::from(*v));
        places.fold(Extent { range_m: NOTHING, across_m: NOTHING }, |extent, place_m| Extent {
            range_m: wider(extent.range_m, self.range_m(place_m)),
            across_m: wider(extent.across_m, self.across_m(place_m)),
        })
    }
}

/// Distance of a place from an antenna relative to that of the origin, computed without subtracting
/// distances, which would cancel far away.
fn beyond_m(from: &Standpoint, place_m: DVec3) -> f64 {
    let ahead_m = from.direction().dot(place_m);
    if !from.range_m.is_finite() {
        return -ahead_m;
    }
    let distance_m = (from.range_m * from.direction() - place_m).length();
    (place_m.length_squared() - 2.0 * from.range_m * ahead_m) / (distance_m + from.range_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(azimuth_rad: f64, elevation_rad: f64, range_m: f64) -> Standpoint {
        Standpoint { azimuth_rad, elevation_rad, range_m }
    }

    const PLACE_M: DVec3 = DVec3::new(1.1, -0.4, 0.7);

    #[test]
    fn a_range_near_by_is_a_difference_of_distances_and_far_away_a_projection() {
        let near = at(0.3, 0.5, 8.0);
        let asked = (8.0 * near.direction() - PLACE_M).length() - 8.0;
        assert!((beyond_m(&near, PLACE_M) - asked).abs() < 1e-14);
        let [far, farther] = [1e9, f64::INFINITY].map(|range_m| beyond_m(&at(0.3, 0.5, range_m), PLACE_M));
        println!("{far} {farther}");
        assert!((far - farther).abs() < 1e-8);
    }

    #[test]
    fn the_place_across_is_how_fast_the_range_changes_with_the_azimuth() {
        const STEP: f64 = 1e-6;
        for range_m in [3.0, f64::INFINITY] {
            for receiver in [None, Some(at(1.2, 0.1, 4.0))] {
                let look =
                    |azimuth_rad| AspectGeometry { transmitter: at(azimuth_rad, 0.6, range_m), receiver };
                let turned = look(0.4 + STEP).range_m(PLACE_M) - look(0.4 - STEP).range_m(PLACE_M);
                let asked = -turned / (2.0 * STEP) * 2.0 / look(0.4).moving();
                let got = look(0.4).across_m(PLACE_M);
                println!("asked {asked}, got {got}");
                assert!((got - asked).abs() < 1e-8);
            }
        }
    }
}
