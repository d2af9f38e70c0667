//! Iterated physical optics of two bounces by dense sampling: the currents on every facet in the near field
//! of the currents on all facets of other patches (Burkholder and Lundin, IEEE T-AP 53 (2005) 793, first
//! iteration).
//!
//! It uses no mirrors, no stationary phase and no nodes: the currents of [`crate::po`] at a point x radiate
//!
//! ```text
//! H(y) = Σ J × R̂ (jk + 1/R) e^{−jkR}/(4πR) dA        J = 2 n × H
//! ```
//! to every point y visible on its lit side, and the currents there radiate to the receiver. It is slow:
//! samples of one patch times samples of the others.

use crate::aspect::{AntennaPair, Aspect, PreparedAntenna};
use crate::node;
use crate::po::{check_count, check_positive};
use crate::ray_cast::{Body, ReferenceError};
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::PI;

/// A complex vector as its real and imaginary part.
type Vector = [DVec3; 2];

/// A sample of a facet.
struct Sample {
    at_m: DVec3,
    area_m2: f64,
    normal: DVec3,
    facet: u32,
    /// Patch index; facets in one plane are one patch and do not light each other.
    patch: usize,
}

/// Scattering amplitude S of two bounces, metres: only of sequences of two facets in different planes, both
/// sides of which scatter. For perfect conductors, in the far field or at finite range.
///
/// There are `per_wavelength` samples per wavelength; 8 leave an error of 1 % (`verification` tests). Not
/// reciprocal by itself: the mean over both directions is what [`crate::Bracket::Symmetrised`] represents.
pub fn double_bounce(
    mesh: &Mesh,
    aspect: &Aspect,
    frequency_hz: f64,
    per_wavelength: f64,
) -> Result<Amplitude, ReferenceError> {
    check_positive("samples per wavelength", per_wavelength)?;
    check_positive("frequency", frequency_hz)?;
    let body = Body::of_mesh(mesh)?;
    let wavenumber_per_m = 2.0 * PI * frequency_hz / SPEED_OF_LIGHT_MPS;
    let samples = samples(&body, SPEED_OF_LIGHT_MPS / frequency_hz / per_wavelength);
    check_count("pairs of samples", (samples.len() as f64).powi(2))?;
    let optics = DoubleBounce { body: &body, samples: &samples, wavenumber_per_m };
    let ends = AntennaPair::of(aspect);
    Ok(optics.amplitude(&ends.transmitter, ends.receiver()))
}

/// Samples at the centres of small equal triangles of every facet.
fn samples(body: &Body, edge_m: f64) -> Vec<Sample> {
    let mut all = Vec::new();
    let mut planes: Vec<(DVec3, f64)> = Vec::new();
    for (facet, of) in (0..).zip(&body.facets) {
        let plane = (of.normal, of.normal.dot(of.corners_m[0]));
        let patch = planes.iter().position(|other| is_one_plane(other, &plane)).unwrap_or(planes.len());
        if patch == planes.len() {
            planes.push(plane);
        }
        let [a, b, c] = of.corners_m;
        let longest_m = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let count = (longest_m / edge_m).ceil().max(1.0) as u32;
        let area_m2 = 0.5 * (b - a).cross(c - a).length() / f64::from(count * count);
        for at_m in centres(of.corners_m, count) {
            all.push(Sample { at_m, area_m2, normal: of.normal, facet, patch });
        }
    }
    all
}

fn is_one_plane(a: &(DVec3, f64), b: &(DVec3, f64)) -> bool {
    let sign = a.0.dot(b.0).signum();
    (a.0 - sign * b.0).length() < 1e-9 && (a.1 - sign * b.1).abs() < 1e-9
}

/// Centres of the count² triangles into which lines parallel to its sides divide a triangle.
fn centres([a, b, c]: [DVec3; 3], count: u32) -> Vec<DVec3> {
    let n = f64::from(count);
    let at = |i: f64, j: f64| a + (b - a) * (i / n) + (c - a) * (j / n);
    let mut all = Vec::new();
    for i in 0..count {
        for j in 0..count - i {
            let (x, y) = (f64::from(i), f64::from(j));
            all.push(at(x + 1.0 / 3.0, y + 1.0 / 3.0));
            if i + j + 2 <= count {
                all.push(at(x + 2.0 / 3.0, y + 2.0 / 3.0));
            }
        }
    }
    all
}

struct DoubleBounce<'a> {
    body: &'a Body,
    samples: &'a [Sample],
    wavenumber_per_m: f64,
}

/// Currents J·dA of a sample for transmitted v and h, times Z₀ over the transmitted field.
type Currents = [Vector; 2];

/// Currents due to the transmitter's field.
#[derive(Default)]
struct FirstCurrents {
    currents: Currents,
    /// Unit normal on the lit side; zero in the shadow.
    lit_normal: DVec3,
}

impl DoubleBounce<'_> {
    fn amplitude(&self, transmitter: &PreparedAntenna, receiver: &PreparedAntenna) -> Amplitude {
        let first: Vec<FirstCurrents> =
            self.samples.par_iter().map(|sample| self.first_currents(sample, transmitter)).collect();
        let share = |sample: &Sample| self.share(sample, &first, receiver);
        let shares: Vec<Amplitude> = self.samples.par_iter().map(share).collect();
        shares.into_iter().fold(Amplitude::default(), |mut sum, share| {
            node::add(&mut sum, &share);
            sum
        })
    }

    fn first_currents(&self, sample: &Sample, transmitter: &PreparedAntenna) -> FirstCurrents {
        if !self.body.is_clear(sample.at_m, sample.facet, transmitter) {
            return FirstCurrents::default();
        }
        let leg = transmitter.leg_from(sample.at_m);
        let lit_normal = sample.normal * sample.normal.dot(leg.towards).signum();
        let phase = node::phasor(self.wavenumber_per_m, leg.excess_m) * transmitter.spreading(leg.length_m);
        let currents = transmitter.polarizations(leg.towards).map(|field| {
            let current = 2.0 * sample.area_m2 * lit_normal.cross((-leg.towards).cross(field));
            [current * phase.re, current * phase.im]
        });
        FirstCurrents { currents, lit_normal }
    }

    /// Contribution to S of a sample's current in the field of all first currents.
    fn share(&self, to: &Sample, first: &[FirstCurrents], receiver: &PreparedAntenna) -> Amplitude {
        let mut share = Amplitude::default();
        if !self.body.is_clear(to.at_m, to.facet, receiver) {
            return share;
        }
        let leg = receiver.leg_from(to.at_m);
        let out = to.normal * to.normal.dot(leg.towards).signum();
        let way = node::phasor(self.wavenumber_per_m, leg.excess_m) * receiver.spreading(leg.length_m);
        let scale = Complex64::new(0.0, self.wavenumber_per_m / (4.0 * PI).sqrt()) * way;
        for (q, field) in self.second_field(to, out, first).iter().enumerate() {
            let current = field.map(|part| 2.0 * to.area_m2 * out.cross(part));
            for (p, received) in receiver.polarizations(leg.towards).iter().enumerate() {
                share[p][q] += scale * Complex64::new(current[0].dot(*received), current[1].dot(*received));
            }
        }
        share
    }

    /// Field Z₀H at a sample, due to the first currents whose lit side is visible from the side of `out`.
    fn second_field(&self, to: &Sample, out: DVec3, first: &[FirstCurrents]) -> Currents {
        let mut sum = Currents::default();
        for (from, FirstCurrents { currents, lit_normal }) in self.samples.iter().zip(first) {
            let line = to.at_m - from.at_m;
            if from.patch == to.patch || out.dot(line) >= 0.0 || lit_normal.dot(line) <= 0.0 {
                continue;
            }
            let r = line.length();
            let factor = Complex64::new(1.0 / r, self.wavenumber_per_m) / (4.0 * PI * r)
                * Complex64::cis(-self.wavenumber_per_m * r);
            for (sum, [re, im]) in sum.iter_mut().zip(currents) {
                let [re, im] = [re, im].map(|part| part.cross(line / r));
                sum[0] += re * factor.re - im * factor.im;
                sum[1] += re * factor.im + im * factor.re;
            }
        }
        sum
    }
}
