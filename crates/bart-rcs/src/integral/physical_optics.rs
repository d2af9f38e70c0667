//! Physical optics over one lit polygon, for any number of mirrors before and after it (the node integral).
//!
//! ```text
//! S_pq = j√(4π)/λ ∫ R_tR_r/(L₁L₂) · e_p·[d₁(n·e_q) − e_q(n·d₁)] · e^{−jk(L₁+L₂−R_t−R_r)} dA
//! ```
//! p and q are v or h of the receiver's and transmitter's own legs, carried to the node by the mirrors; L, d belong to the
//! image antennas. Computed is the amplitude `a` of a path whose node is a reference point of the polygon: S without
//! R_tR_r/(L₁L₂)·e^{−jk(L₁+L₂−R_t−R_r)} taken at that point. So nothing far away enters but small differences. Over a bent
//! facet x is the skin above the polygon's point, and n·dA its area vector.

use crate::geometry::antenna::Antenna;
use crate::geometry::complex_vector::ComplexVector;
use crate::geometry::plane_frame::PlaneFrame;
use crate::integral::polarization::{Mirrors, polarization_vectors};
use crate::integral::polygon_phase::{linear_phase_integrals, six_point_weights};
use crate::integral::steps::Steps;
use crate::integral::tiling::{self, Tile};
use crate::integral::turns::{TOGETHER, Turns, turns};
use crate::surface::bend::{Along, Bend};
use artifact::material::Material;
use artifact::paths::Amplitude;
use glam::{DVec2, DVec3};
use num_complex::Complex64;

/// A value and a bound of its error, in the value's unit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Estimate<T> {
    pub(crate) value: T,
    pub(crate) error: f64,
}

/// One end of a path as its node sees it.
#[derive(Debug, Clone)]
pub(crate) struct Leg {
    /// The antenna mirrored in the facets between.
    pub(crate) image: Antenna,
    /// Those facets, as perfect mirrors.
    pub(crate) mirrors: Mirrors,
    /// What they and the sheets between are, where that matters.
    pub(crate) steps: Steps,
    /// ĥ straight above and below.
    pub(crate) zenith_h: DVec3,
}

impl Leg {
    /// The fields that arrive of sent unit v and h, for the direction of travel at the node.
    pub(crate) fn arriving_fields(&self, travel: DVec3, wavenumber_per_m: f64) -> [ComplexVector; 2] {
        if self.steps.is_perfect() {
            return self.mirrors.fields_at_node(travel, self.zenith_h).map(ComplexVector::from);
        }
        let to_antenna = self.mirrors.antenna_direction(travel);
        let sent = polarization_vectors(to_antenna, self.zenith_h);
        self.steps.carry(sent, -to_antenna, wavenumber_per_m)
    }
}

impl Leg {
    /// What is left at a point of a field that was sent, at most.
    fn strength(&self, at_m: DVec3, wavenumber_per_m: f64) -> f64 {
        let to_antenna = self.mirrors.antenna_direction(self.image.travel_direction_at(at_m));
        self.steps.strength(-to_antenna, wavenumber_per_m)
    }
}

/// How the current at the node is projected on the receiver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bracket {
    /// Mean of both directions of travel: S(b1, b2) = S(b2, b1)ᵀ.
    Symmetrised,
    /// The current excited by the transmitter: reciprocal at the specular only.
    Plain,
}

/// A lit polygon with its two legs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node<'a> {
    /// Convex, counter-clockwise about `normal`, world metres.
    pub(crate) corners_m: &'a [DVec3],
    /// Unit normal on the lit side.
    pub(crate) normal: DVec3,
    /// `None` is a perfect conductor.
    pub(crate) material: Option<&'a Material>,
    /// The skin that is integrated over where it is not the polygon itself.
    pub(crate) bend: Option<Bend>,
    pub(crate) transmit: &'a Leg,
    pub(crate) receive: &'a Leg,
    pub(crate) bracket: Bracket,
}

impl Node<'_> {
    /// What is to be asked of the integral so that its error is `accuracy` of an unweakened one: what arrives over the road or through
    /// glass at a tenth may be wrong by ten times as much of itself.
    pub(crate) fn accuracy(&self, at_m: DVec3, wavenumbers_per_m: &[f64], accuracy: f64) -> f64 {
        let middle_per_m = wavenumbers_per_m.get(wavenumbers_per_m.len() / 2).copied().unwrap_or(0.0);
        let legs = [self.transmit, self.receive].map(|leg| leg.strength(at_m, middle_per_m));
        // Coefficients change over a polygon; half of itself is left as the least that is asked.
        let strength = (legs[0] * legs[1]).clamp(1e-6, 1.0);
        (accuracy / strength).min(accuracy.max(0.5))
    }
}

/// Amplitudes at several wavenumbers, on one tiling, of a node that is cut as far as `accuracy` asks.
///
/// `accuracy` bounds the error of every element of the 2 × 2 amplitude as a fraction of √(4π)·area/λ at the highest
/// wavenumber, the largest amplitude that the polygon can have; `error` is the bound reached, in metres. It is not
/// carried below 1e-12, where rounding begins.
pub(crate) fn node_amplitudes(
    node: &Node<'_>,
    reference_m: DVec3,
    wavenumbers_per_m: &[f64],
    accuracy: f64,
) -> Estimate<Vec<Amplitude>> {
    let field = Field::new(node, reference_m, accuracy);
    let highest = wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
    let mut sums = vec![[0.0; 4].map(Complex64::from); wavenumbers_per_m.len()];
    let mut error_m2 = 0.0;
    for_each_tile(&field, highest, &mut |tile, error| {
        error_m2 += error * tile.area_m2();
        field.add(tile, wavenumbers_per_m, &mut sums);
    });
    let value = sums.iter().zip(wavenumbers_per_m).map(|(sum, k)| amplitude_of(sum, *k)).collect();
    Estimate { value, error: error_m2 * highest / std::f64::consts::PI.sqrt() }
}

/// Calls `give` with the tiles of a node as [`node_amplitudes`] takes them, each with a bound of the error of weight·phase.
pub(crate) fn for_each_tile(field: &Field<'_>, highest_per_m: f64, give: &mut dyn FnMut(&Tile<'_>, f64)) {
    tiling::cut(field, highest_per_m, field.accuracy.max(1e-12), give);
}

/// How many there are, about; no more than `most` are counted.
pub(crate) fn count_tiles(field: &Field<'_>, highest_per_m: f64, most: u64) -> u64 {
    tiling::count(field, highest_per_m, field.accuracy.max(1e-12), most)
}

/// j√(4π)/λ = jk/√π before the integrals.
fn amplitude_of(integrals_m2: &[Complex64; 4], wavenumber_per_m: f64) -> Amplitude {
    let factor = Complex64::new(0.0, wavenumber_per_m / std::f64::consts::PI.sqrt());
    let [vv, vh, hv, hh] = integrals_m2.map(|i| factor * i);
    [[vv, vh], [hv, hh]]
}

/// |x − p| − |y − p| without the cancellation of two long lengths.
pub(crate) fn length_difference_m(antenna: Antenna, x_m: DVec3, y_m: DVec3) -> f64 {
    match antenna {
        Antenna::Point(p) => (x_m - y_m).dot((x_m - p) + (y_m - p)) / (x_m.distance(p) + y_m.distance(p)),
        Antenna::Direction(r) => -r.dot(x_m - y_m),
    }
}

/// The integrand of a node: real weights that vary slowly, and a length that the phase follows.
pub(crate) struct Field<'a> {
    pub(crate) node: &'a Node<'a>,
    /// Plane coordinates about the reference point.
    pub(crate) frame: PlaneFrame,
    reference_m: DVec3,
    /// As in [`node_amplitudes`].
    pub(crate) accuracy: f64,
}

/// A point of the scattering surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SurfacePoint {
    pub(crate) x_m: DVec3,
    /// Area vector on the lit side, per area of the polygon.
    pub(crate) area: DVec3,
    /// Rise of the surface along the facet's plane; zero where it is flat.
    slope: DVec3,
    /// Direction that the slope is along: the normal of the facet's winding.
    up: DVec3,
}

impl<'a> Field<'a> {
    pub(crate) fn new(node: &'a Node<'a>, reference_m: DVec3, accuracy: f64) -> Self {
        Self { node, frame: PlaneFrame::new(reference_m, node.normal), reference_m, accuracy }
    }

    /// The surface over a point of the polygon's plane.
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

    pub(crate) fn is_bent(&self) -> bool {
        self.node.bend.is_some()
    }

    /// What the skin does along some steps in the polygon's plane; nothing where it is flat.
    pub(crate) fn along(&self, steps_m: impl Iterator<Item = DVec2>) -> Along {
        let origin = self.frame.to_world(DVec2::ZERO);
        let in_world = steps_m.map(|step| self.frame.to_world(step) - origin);
        self.node.bend.as_ref().map_or_else(Along::default, |bend| bend.along(in_world))
    }

    /// Distances over which both waves have spread.
    pub(crate) fn ranges_m(&self, x_m: DVec3) -> [f64; 2] {
        [self.node.transmit.image.range_m(x_m), self.node.receive.image.range_m(x_m)]
    }

    /// Bracket times 1/(L₁L₂), relative to 1/(L₁L₂) at the reference point: [vv, vh, hv, hh], receiver first.
    fn weights(&self, at: &SurfacePoint) -> [f64; 4] {
        let Node { transmit, receive, bracket, .. } = *self.node;
        let SurfacePoint { x_m, area: normal, .. } = *at;
        let (d1, d2) = (transmit.image.travel_direction_at(x_m), receive.image.travel_direction_at(x_m));
        let sent = transmit.mirrors.fields_at_node(d1, transmit.zenith_h);
        let received = receive.mirrors.fields_at_node(d2, receive.zenith_h);
        let spread = self.spread(transmit.image, x_m) * self.spread(receive.image, x_m);
        let plain = |d: DVec3, e: DVec3, other: DVec3| other.dot(d) * normal.dot(e) - other.dot(e) * normal.dot(d);
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(p, q)| {
            let forth = plain(d1, sent[q], received[p]);
            spread
                * match bracket {
                    Bracket::Plain => forth,
                    Bracket::Symmetrised => 0.5 * (forth + plain(d2, received[p], sent[q])),
                }
        })
    }

    /// L₁ + L₂ at `x_m` less that at the reference point, without the cancellation.
    pub(crate) fn length_m(&self, x_m: DVec3) -> f64 {
        length_difference_m(self.node.transmit.image, x_m, self.reference_m)
            + length_difference_m(self.node.receive.image, x_m, self.reference_m)
    }

    /// Gradient of L₁ + L₂ along the polygon's plane.
    pub(crate) fn length_gradient(&self, at: &SurfacePoint) -> DVec2 {
        let both = self.both_directions(at.x_m);
        self.frame.tangential(both + both.dot(at.up) * at.slope)
    }

    /// d₁ + d₂.
    pub(crate) fn both_directions(&self, x_m: DVec3) -> DVec3 {
        self.node.transmit.image.travel_direction_at(x_m) + self.node.receive.image.travel_direction_at(x_m)
    }

    /// Bound of the derivative of every direction and unit field within `reach_m`, rad/m: 1/L of the nearer antenna, and
    /// more where its leg is steep, for v̂ and ĥ turn with the azimuth.
    pub(crate) fn turning_per_m(&self, x_m: DVec3, reach_m: f64) -> f64 {
        let of = |leg: &Leg| {
            let range_m = leg.image.range_m(x_m);
            let to_antenna = leg.mirrors.antenna_direction(leg.image.travel_direction_at(x_m));
            let least_sine = to_antenna.x.hypot(to_antenna.y) - reach_m / range_m;
            if range_m.is_finite() { 1.0 / ((range_m - reach_m).max(0.0) * least_sine.max(0.0)) } else { 0.0 }
        };
        of(self.node.transmit).max(of(self.node.receive))
    }

    pub(crate) fn spread(&self, image: Antenna, x_m: DVec3) -> f64 {
        match image {
            Antenna::Point(p) => p.distance(self.reference_m) / p.distance(x_m),
            Antenna::Direction(_) => 1.0,
        }
    }

    /// Calls `give` with the index of every wavenumber and the amplitude of a tile alone, as in [`node_amplitudes`].
    pub(crate) fn for_each_amplitude(
        &self,
        tile: &Tile<'_>,
        wavenumbers_per_m: &[f64],
        give: &mut dyn FnMut(usize, &Amplitude),
    ) {
        // A few wavenumbers at a time need no memory of the heap.
        for (chunk, some) in wavenumbers_per_m.chunks(TOGETHER).enumerate() {
            let mut sums = [[Complex64::ZERO; 4]; TOGETHER];
            self.add(tile, some, &mut sums[..some.len()]);
            for (i, (sum, k)) in sums.iter().zip(some).enumerate() {
                give(chunk * TOGETHER + i, &amplitude_of(sum, *k));
            }
        }
    }

    /// Adds a tile's integrals of weight·e^{−jkL} for every wavenumber.
    fn add(&self, tile: &Tile<'_>, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        match tile {
            _ if !self.is_perfect() => self.add_lossy(tile, wavenumbers_per_m, sums),
            Tile::Whole { corners_m, centre_m } => self.add_whole(corners_m, *centre_m, wavenumbers_per_m, sums),
            Tile::Triangle(corners_m) => self.add_triangle(*corners_m, wavenumbers_per_m, sums),
        }
    }

    /// Weight and curvature of the phase as at the centre: Gordon over the whole polygon.
    fn add_whole(&self, corners_m: &[DVec2], centre_m: DVec2, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        let whole = self.whole(corners_m, centre_m);
        let weights = self.weights(&whole.centre);
        whole.for_each_integral(wavenumbers_per_m, &mut |i, integral_m2| {
            sums[i].iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * integral_m2);
        });
    }

    /// Weight times the remainder of the phase as the quadratic through six points, under the linear phase exactly.
    fn add_triangle(&self, corners_m: [DVec2; 3], wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        let six = self.six_points(corners_m);
        let weights = six.points.map(|at| self.weights(&at));
        six.for_each_integral(wavenumbers_per_m, &mut |i, integrals_m2| {
            for (integral_m2, weights) in integrals_m2.into_iter().zip(weights) {
                sums[i].iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * integral_m2);
            }
        });
    }

    pub(crate) fn whole(&self, corners_m: &[DVec2], centre_m: DVec2) -> Whole {
        let centre = self.surface_at(centre_m);
        Whole {
            centre,
            gradient: self.length_gradient(&centre),
            length_m: self.length_m(centre.x_m),
            about_centre_m: corners_m.iter().map(|c| *c - centre_m).collect(),
        }
    }

    pub(crate) fn six_points(&self, [a, b, c]: [DVec2; 3]) -> SixPoints {
        let centre_m = (a + b + c) / 3.0;
        let points_m = [a, b, c, 0.5 * (b + c), 0.5 * (c + a), 0.5 * (a + b)];
        let gradient = self.length_gradient(&self.surface_at(centre_m));
        let points = points_m.map(|p| self.surface_at(p));
        SixPoints {
            points,
            linear_m: points_m.map(|p| gradient.dot(p - centre_m)),
            lengths_m: points.map(|at| self.length_m(at.x_m)),
            area_m2: 0.5 * (b - a).perp_dot(c - a),
        }
    }
}

/// A polygon whose phase is linear.
pub(crate) struct Whole {
    /// Where the weight is taken.
    pub(crate) centre: SurfacePoint,
    /// Of L₁ + L₂ there, and its value.
    gradient: DVec2,
    length_m: f64,
    about_centre_m: Vec<DVec2>,
}

impl Whole {
    /// Calls `give` with the place of every wavenumber and ∫ e^{−jkL} dA.
    pub(crate) fn for_each_integral(&self, wavenumbers_per_m: &[f64], give: &mut dyn FnMut(usize, Complex64)) {
        for (chunk, some) in wavenumbers_per_m.chunks(TOGETHER).enumerate() {
            let at_centre = turns(self.length_m, some);
            let about_centre_m2 = linear_phase_integrals(&self.about_centre_m, self.gradient, some);
            (0..some.len()).for_each(|i| give(chunk * TOGETHER + i, at_centre[i] * about_centre_m2[i]));
        }
    }
}

/// A triangle over which weight times the remainder of the phase is a quadratic.
pub(crate) struct SixPoints {
    /// Where the weights are taken: corners, and the middles of the edges opposite to them.
    pub(crate) points: [SurfacePoint; 6],
    /// L₁ + L₂ there: its linear part, and all of it.
    linear_m: [f64; 6],
    lengths_m: [f64; 6],
    area_m2: f64,
}

impl SixPoints {
    /// Calls `give` with the place of every wavenumber and what the weight at each point is to be multiplied with: together
    /// ∫ weight·e^{−jkL} dA.
    pub(crate) fn for_each_integral(&self, wavenumbers_per_m: &[f64], give: &mut dyn FnMut(usize, [Complex64; 6])) {
        for (chunk, some) in wavenumbers_per_m.chunks(TOGETHER).enumerate() {
            let at_corners = [0, 1, 2].map(|i| turns(self.linear_m[i], some));
            // The linear part is in the weights; what the length does beyond it turns the sampled value.
            let beyond: [Turns; 6] = std::array::from_fn(|i| turns(self.lengths_m[i] - self.linear_m[i], some));
            for (i, k) in some.iter().enumerate() {
                let phases = [0, 1, 2].map(|corner| -k * self.linear_m[corner]);
                let under_phase = six_point_weights(phases, at_corners.map(|turns| turns[i]));
                let integrals_m2 = std::array::from_fn(|point| under_phase[point] * beyond[point][i] * self.area_m2);
                give(chunk * TOGETHER + i, integrals_m2);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_quadrature::gauss_legendre;
    use artifact::units::SPEED_OF_LIGHT_MPS;

    const WAVENUMBER_PER_M: f64 = std::f64::consts::TAU * 77e9 / SPEED_OF_LIGHT_MPS;

    /// A rectangle in the plane x = 0 about the origin, and two antennas as [along its first side, its second, ahead].
    struct Case {
        name: &'static str,
        sides_m: [f64; 2],
        transmitter_m: DVec3,
        receiver_m: DVec3,
        /// Enough for 1e-13: a third of the phase's span in radians and some.
        gauss_points: usize,
    }

    const fn case(name: &'static str, sides_m: [f64; 2], t: [f64; 3], r: [f64; 3], gauss_points: usize) -> Case {
        let [transmitter_m, receiver_m] = [DVec3::new(t[2], t[0], t[1]), DVec3::new(r[2], r[0], r[1])];
        Case { name, sides_m, transmitter_m, receiver_m, gauss_points }
    }

    const HARD_CASES: [Case; 8] = [
        case("broadside, 1 m away", [0.005, 0.005], [0.0, 0.001, 1.0], [0.0, 0.001, 1.0], 60),
        case("grazing, 1 m away", [0.005, 0.005], [0.9998, 0.0, 0.02], [0.9998, 0.0, 0.02], 80),
        case("sliver", [0.1, 1e-4], [15.0, 0.0, 20.0], [15.0, 0.0, 20.0], 200),
        case("one wavelength wide", [0.0039, 0.0039], [0.5, 0.3, 0.8], [0.5, 0.3, 0.8], 30),
        case("300 m away, broadside", [0.1, 0.1], [0.0, 1.0, 300.0], [0.0, 1.0, 300.0], 60),
        case("300 m away, oblique", [0.1, 0.1], [150.0, 80.0, 240.0], [150.0, 80.0, 240.0], 130),
        case("strip along the line of sight", [0.3, 0.02], [38.0, 0.5, 6.0], [38.0, 0.5, 6.0], 400),
        case("bistatic", [0.005, 0.01], [1.0, 0.4, 1.5], [-0.2, -2.0, 1.0], 120),
    ];

    impl Case {
        fn corners_m(&self) -> [DVec3; 4] {
            let [a, b] = self.sides_m.map(|s| 0.5 * s);
            [[-a, -b], [a, -b], [a, b], [-a, b]].map(|[y, z]| DVec3::new(0.0, y, z))
        }

        fn amplitude(&self, accuracy: f64) -> Estimate<Vec<Amplitude>> {
            let leg = |p| Leg {
                image: Antenna::Point(p),
                mirrors: Mirrors::NONE,
                steps: Steps::default(),
                zenith_h: DVec3::Y,
            };
            let node = Node {
                corners_m: &self.corners_m(),
                normal: DVec3::X,
                bend: None,
                material: None,
                transmit: &leg(self.transmitter_m),
                receive: &leg(self.receiver_m),
                bracket: Bracket::Plain,
            };
            node_amplitudes(&node, DVec3::ZERO, &[WAVENUMBER_PER_M], accuracy)
        }

        /// The formula of the module's head, point by point.
        fn exact(&self) -> Amplitude {
            let (nodes, weights) = gauss_legendre(self.gauss_points);
            let mut sum = [[Complex64::ZERO; 2]; 2];
            for (u, wu) in nodes.iter().zip(&weights) {
                for (v, wv) in nodes.iter().zip(&weights) {
                    let x = DVec3::new(0.0, 0.5 * self.sides_m[0] * u, 0.5 * self.sides_m[1] * v);
                    let at = self.integrand(x);
                    for (sum, at) in sum.iter_mut().flatten().zip(at.iter().flatten()) {
                        *sum += at * (0.25 * wu * wv * self.sides_m[0] * self.sides_m[1]);
                    }
                }
            }
            sum
        }

        fn integrand(&self, x: DVec3) -> Amplitude {
            let ways = [x - self.transmitter_m, x - self.receiver_m];
            let [l1, l2] = ways.map(DVec3::length);
            let [d1, d2] = [ways[0] / l1, ways[1] / l2];
            let at_origin = self.transmitter_m.length() + self.receiver_m.length();
            let factor = Complex64::new(0.0, WAVENUMBER_PER_M / std::f64::consts::PI.sqrt())
                * Complex64::cis(-WAVENUMBER_PER_M * (l1 + l2 - at_origin))
                * (self.transmitter_m.length() * self.receiver_m.length() / (l1 * l2));
            let fields = |r: DVec3| {
                let h = DVec3::Z.cross(r) / DVec3::Z.cross(r).length();
                [r.cross(h), h]
            };
            let (sent, received) = (fields(-d1), fields(-d2));
            [0, 1].map(|p| [0, 1].map(|q| factor * received[p].dot(d1 * sent[q].x - sent[q] * d1.x)))
        }

        /// √(4π)·area/λ.
        fn scale_m(&self) -> f64 {
            self.sides_m[0] * self.sides_m[1] * WAVENUMBER_PER_M / std::f64::consts::PI.sqrt()
        }
    }

    fn distance(a: &Amplitude, b: &Amplitude) -> f64 {
        a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    }

    #[test]
    fn error_stays_below_the_accuracy_asked_and_below_the_bound_printed_over_ten_decades() {
        for case in HARD_CASES {
            let exact = case.exact();
            for decade in 1..=10 {
                let asked = 10_f64.powi(-decade);
                let got = case.amplitude(asked);
                let error = distance(&got.value[0], &exact) / case.scale_m();
                println!(
                    "{}: asked {asked:.0e}, got {error:.1e}, printed {:.1e}",
                    case.name,
                    got.error / case.scale_m()
                );
                assert!(error <= asked, "{}: asked {asked:e}, got {error:e}", case.name);
                // Gauss–Legendre's own rounding is 1e-13.
                assert!(
                    error <= got.error / case.scale_m() + 1e-13,
                    "{}: {error:e} exceeds {:e}",
                    case.name,
                    got.error
                );
            }
        }
    }
}
