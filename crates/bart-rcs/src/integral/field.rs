//! Integrand of a node: slowly varying real weights, and a length that determines the phase.

use crate::geometry::antenna::Antenna;
use crate::geometry::plane_frame::PlaneFrame;
use crate::integral::node::{Leg, Node};
use crate::materials::surface_response::{steepness, turning};
use crate::surface::bend::SkinVariation;
use glam::{DVec2, DVec3};

/// Difference |x − p| − |y − p| without the cancellation of two long lengths.
pub(crate) fn length_difference_m(antenna: Antenna, x_m: DVec3, y_m: DVec3) -> f64 {
    match antenna {
        Antenna::Point(p) => (x_m - y_m).dot((x_m - p) + (y_m - p)) / (x_m.distance(p) + y_m.distance(p)),
        Antenna::Direction(r) => -r.dot(x_m - y_m),
    }
}

/// Integrand of a node: slowly varying real weights, and a length that determines the phase.
pub(crate) struct Field<'a> {
    pub(crate) node: &'a Node<'a>,
    /// Plane coordinates relative to the reference point.
    pub(crate) frame: PlaneFrame,
    reference_m: DVec3,
    /// Accuracy, as in [`node_amplitudes`](crate::integral::physical_optics::node_amplitudes).
    pub(crate) accuracy: f64,
}

/// A point of the scattering surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SurfacePoint {
    pub(crate) x_m: DVec3,
    /// Area vector on the lit side, per area of the polygon.
    pub(crate) area: DVec3,
    /// Slope of the surface relative to the facet's plane; zero if it is flat.
    slope: DVec3,
    /// Direction in which the slope rises: the normal by the facet's winding.
    up: DVec3,
}

impl<'a> Field<'a> {
    pub(crate) fn new(node: &'a Node<'a>, reference_m: DVec3, accuracy: f64) -> Self {
        Self { node, frame: PlaneFrame::new(reference_m, node.normal), reference_m, accuracy }
    }

    /// Surface above a point of the polygon's plane.
    pub(crate) fn surface_at(&self, plane_m: DVec2) -> SurfacePoint {
        let x_m = self.frame.to_world(plane_m);
        let normal = self.node.normal;
        let Some(bend) = &self.node.bend else {
            return SurfacePoint { x_m, area: normal, slope: DVec3::ZERO, up: normal };
        };
        let (height_m, slope) = bend.at(x_m);
        let up = bend.normal;
        let area = (up - slope) * up.dot(normal).signum();
        SurfacePoint { x_m: x_m + height_m * up, area, slope, up }
    }

    /// Surface above a world point near the polygon's plane.
    pub(crate) fn surface_about(&self, x_m: DVec3) -> SurfacePoint {
        self.surface_at(self.frame.plane_from_world(x_m))
    }

    pub(crate) fn is_bent(&self) -> bool {
        self.node.bend.is_some()
    }

    /// Height of the skin along several steps in the polygon's plane; empty if it is flat.
    pub(crate) fn along(&self, steps_m: impl Iterator<Item = DVec2>) -> SkinVariation {
        let origin = self.frame.to_world(DVec2::ZERO);
        let in_world = steps_m.map(|step| self.frame.to_world(step) - origin);
        self.node.bend.as_ref().map_or_else(SkinVariation::default, |bend| bend.along(in_world))
    }

    /// Values for both legs, the transmitter's first; if both legs are the same it is evaluated once.
    #[inline]
    pub(crate) fn of_both<T: Copy>(&self, of: impl Fn(&Leg) -> T) -> [T; 2] {
        let there = of(self.node.transmit);
        let back = if self.node.is_one_way() { there } else { of(self.node.receive) };
        [there, back]
    }

    /// Distances over which both waves have spread.
    pub(crate) fn ranges_m(&self, x_m: DVec3) -> [f64; 2] {
        self.of_both(|leg| leg.image.range_m(x_m))
    }

    /// Directions of travel d₁ and d₂, away from the antennas.
    pub(crate) fn directions(&self, x_m: DVec3) -> [DVec3; 2] {
        self.of_both(|leg| leg.image.travel_direction_at(x_m))
    }

    /// Length L₁ + L₂ at `x_m` less that at the reference point, without cancellation.
    pub(crate) fn length_m(&self, x_m: DVec3) -> f64 {
        let [there, back] = self.of_both(|leg| length_difference_m(leg.image, x_m, self.reference_m));
        there + back
    }

    /// Gradient of L₁ + L₂ along the polygon's plane.
    pub(crate) fn length_gradient(&self, at: &SurfacePoint) -> DVec2 {
        let both = self.both_directions(at.x_m);
        self.frame.tangential(both + both.dot(at.up) * at.slope)
    }

    /// Sum d₁ + d₂ of both directions.
    pub(crate) fn both_directions(&self, x_m: DVec3) -> DVec3 {
        let [there, back] = self.directions(x_m);
        there + back
    }

    /// Bound on the derivative of every direction and unit field within `reach_m`, rad/m: 1/L of the nearer
    /// antenna, and more if its leg is steep, since v̂ and ĥ rotate with the azimuth.
    pub(crate) fn turning_per_m(&self, x_m: DVec3, reach_m: f64) -> f64 {
        let of = |leg: &Leg| {
            let range_m = leg.image.range_m(x_m);
            let to_antenna = leg.mirrors.antenna_direction(leg.image.travel_direction_at(x_m));
            let least_sine = to_antenna.x.hypot(to_antenna.y) - reach_m / range_m;
            if range_m.is_finite() { 1.0 / ((range_m - reach_m).max(0.0) * least_sine.max(0.0)) } else { 0.0 }
        };
        let [there, back] = self.of_both(of);
        there.max(back)
    }

    /// Ratios of 1/L₁ and of 1/L₂ at `x_m` to those at the reference point.
    pub(crate) fn spread(&self, x_m: DVec3) -> [f64; 2] {
        self.of_both(|leg| match leg.image {
            Antenna::Point(p) => p.distance(self.reference_m) / p.distance(x_m),
            Antenna::Direction(_) => 1.0,
        })
    }

    /// Whether weights are real and independent of frequency.
    pub(crate) fn is_perfect(&self) -> bool {
        let node = self.node;
        node.material.is_none() && node.transmit.steps.is_perfect() && node.receive.steps.is_perfect()
    }

    /// Rate at which the weight varies with the skin's area vector, within `turn_rad` of one of its points: 1
    /// on a conductor, and on a flat facet, which does not vary. Surfaces on the path to the node do not vary
    /// with its skin.
    pub(crate) fn turning_with_skin(&self, at: &SurfacePoint, turn_rad: f64, wavenumber_per_m: f64) -> f64 {
        let Some(material) = self.node.material.filter(|_| self.is_bent()) else { return 1.0 };
        let normal = at.area.normalize_or_zero();
        let of = |leg: &Leg| {
            let cosine = leg.image.travel_direction_at(at.x_m).dot(normal).abs();
            turning(material, cosine, turn_rad, wavenumber_per_m)
        };
        let [there, back] = self.of_both(of);
        1.0 + there.max(back)
    }

    /// Ratio of the variation of the weights to that of directions and fields: of derivatives one to three,
    /// in units of the rate.
    ///
    /// 1/L₁, 1/L₂, d, e_q, e_p each change by at most the rate t in the first derivative; the product of five
    /// by 5t, (5 + 5·4 + 5)t² and so on; third derivatives of a unit vector stay below 6/L³. Coefficients of
    /// exponential type m multiply that (Leibniz).
    pub(crate) fn weight_turns(&self, wavenumber_per_m: f64) -> [f64; 3] {
        if self.is_perfect() {
            return [5.0, 35.0, 300.0];
        }
        let own = self.node.material.map_or(0.0, |material| steepness(material, wavenumber_per_m));
        let ways = [self.node.transmit, self.node.receive].map(|leg| leg.steps.steepness(wavenumber_per_m));
        let m = own + ways[0] + ways[1];
        [5.0 + m, 35.0 + 10.0 * m + m * m, 300.0 + 105.0 * m + 15.0 * m * m + m * m * m]
    }
}
