//! Shooting and bouncing rays (Ling, Chou, Lee 1989): rays on a grid over the silhouette, specularly
//! reflected; at each hit the physical-optics integral over the ray tube's footprint, if the receiver sees
//! it.
//!
//! The node is the last facet of every sequence (exit node). Facets are flat, so a tube spreads as from the
//! image of the antenna: dA = dΩ·L²/|n·d| after a path of length L (dA = da/|n·d| at infinite range). The
//! footprint is the parallelogram of a = L(g_u − d (n·g_u)/(n·d)) and b likewise, g_u = ∂d/∂u·Δu reflected
//! with the ray; the phase is linearised over it, which gives sinc(w·a/2)·sinc(w·b/2), w = −k(d₁ + d₂) (their
//! shape function).

use crate::aspect::{AntennaPair, Aspect, PreparedAntenna};
use crate::coated::{self, Fields, Surface, fields_at_all};
use crate::node::{self, Arrival, Bracket, Node};
use crate::po::{check_count, check_positive};
use crate::ray_cast::{Body, Hit, ReferenceError};
use artifact::material::Material;
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::settings::Sides;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;

/// Density of rays, and number of bounces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RaySettings {
    /// Rays per shortest wavelength at the body's centre, across the line of sight.
    pub per_wavelength: f64,
    /// Highest bounce order.
    pub bounces: u8,
    /// Sides of a facet that scatter; the other side absorbs.
    pub sides: Sides,
    /// Form of the vector part at the exit node.
    pub bracket: Bracket,
}

/// Amplitudes for one aspect.
#[derive(Debug, Clone, PartialEq)]
pub struct OrderAmplitudes {
    /// Scattering amplitude S of each bounce order separately, metres, `[order − 1][frequency]`.
    pub orders: Vec<Vec<Amplitude>>,
    /// Number of rays.
    pub rays: u64,
}

/// S of each bounce order at each frequency, metres, as defined in `interface.md`, with exit nodes.
pub fn amplitude(
    mesh: &Mesh,
    aspect: &Aspect,
    frequencies_hz: &[f64],
    shooting: &RaySettings,
) -> Result<OrderAmplitudes, ReferenceError> {
    let body = Body::of_mesh(mesh)?;
    check_positive("rays per wavelength", shooting.per_wavelength)?;
    frequencies_hz.iter().try_for_each(|f| check_positive("frequency", *f))?;
    let wavenumbers_per_m = node::wavenumbers(frequencies_hz);
    let spacing_m = node::shortest_wavelength_m(frequencies_hz) / shooting.per_wavelength;
    let ends = AntennaPair::of(aspect);
    let grid = RayGrid::over(&body, &ends.transmitter, spacing_m)?;
    let job = ShootingJob { body: &body, ends, wavenumbers_per_m: &wavenumbers_per_m, grid, shooting };
    let rows: Vec<Orders> = (0..job.grid.rows).into_par_iter().map(|row| job.shoot_row(row)).collect();
    let mut sums = job.zero_sums();
    for row in &rows {
        sums.iter_mut().flatten().zip(row.iter().flatten()).for_each(|(sum, term)| node::add(sum, term));
    }
    let orders = sums.iter().map(|order| node::scaled(order, &wavenumbers_per_m)).collect();
    Ok(OrderAmplitudes { orders, rays: job.grid.rows * job.grid.columns })
}

/// Sums `[order − 1][frequency]`, without j√(4π)/λ.
type Orders = Vec<Vec<Amplitude>>;

/// Rays on a plane through the body's centre, across the line of sight.
struct RayGrid {
    antenna_m: Option<DVec3>,
    centre_m: DVec3,
    axes: [DVec3; 2],
    travel: DVec3,
    least: [f64; 2],
    spacing_m: f64,
    rows: u64,
    columns: u64,
}

/// A ray, and the change of its direction (finite range) or position (infinite range) to the next ray of the
/// grid.
#[derive(Clone, Copy)]
struct RayTube {
    origin_m: DVec3,
    travel: DVec3,
    gradients: [DVec3; 2],
    fields: [DVec3; 2],
    length_m: f64,
    excess_m: f64,
}

/// Angle by which the grid is rotated against the body: rows along an edge would gain or lose a whole row at
/// once, and convergence would be of first order (a plate: error ∝ spacing instead of spacing^1.5).
const GRID_TURN_RAD: f64 = 0.5;

impl RayGrid {
    fn over(body: &Body, transmitter: &PreparedAntenna, spacing_m: f64) -> Result<Self, ReferenceError> {
        let antenna_m = transmitter.antenna_m;
        let line = antenna_m.map_or(transmitter.towards, |p| p - body.centre_m);
        if antenna_m.is_some() && line.length() <= body.radius_m {
            return Err(ReferenceError::AntennaInside { distance_m: line.length(), radius_m: body.radius_m });
        }
        let travel = -line / line.length();
        let first = travel.any_orthonormal_vector();
        let (sin, cos) = GRID_TURN_RAD.sin_cos();
        let second = travel.cross(first);
        let axes = [first * cos + second * sin, second * cos - first * sin];
        let mut grid = Self {
            antenna_m,
            centre_m: body.centre_m,
            axes,
            travel,
            least: [f64::INFINITY; 2],
            spacing_m,
            rows: 0,
            columns: 0,
        };
        grid.cover(body);
        check_count("rays", grid.rows as f64 * grid.columns as f64)?;
        Ok(grid)
    }

    /// Smallest rectangle of the grid that contains the body's projection.
    fn cover(&mut self, body: &Body) {
        let mut most = [f64::NEG_INFINITY; 2];
        for corner in body.facets.iter().flat_map(|f| f.corners_m) {
            let projected = self.projected(corner);
            for (i, axis) in self.axes.iter().enumerate() {
                self.least[i] = self.least[i].min(projected.dot(*axis));
                most[i] = most[i].max(projected.dot(*axis));
            }
        }
        let count = |i: usize| ((most[i] - self.least[i]) / self.spacing_m).ceil().max(0.0) as u64;
        (self.rows, self.columns) = (count(0), count(1));
    }

    /// A point of the body projected along its ray onto the grid's plane, relative to the grid's centre.
    fn projected(&self, point_m: DVec3) -> DVec3 {
        let Some(antenna_m) = self.antenna_m else { return point_m - self.centre_m };
        let ray = point_m - antenna_m;
        antenna_m + ray * ((self.centre_m - antenna_m).dot(self.travel) / ray.dot(self.travel))
            - self.centre_m
    }

    fn tube(&self, transmitter: &PreparedAntenna, row: u64, column: u64, start_m: f64) -> RayTube {
        let place = |i: usize, n: u64| self.axes[i] * (self.least[i] + (n as f64 + 0.5) * self.spacing_m);
        let through_m = self.centre_m + place(0, row) + place(1, column);
        let (origin_m, travel, gradients) = match self.antenna_m {
            Some(antenna_m) => {
                let line = through_m - antenna_m;
                let travel = line / line.length();
                let across =
                    |axis: DVec3| (axis - travel * travel.dot(axis)) * (self.spacing_m / line.length());
                (antenna_m, travel, self.axes.map(across))
            }
            None => (through_m - start_m * self.travel, self.travel, self.axes.map(|a| a * self.spacing_m)),
        };
        let fields = transmitter.polarizations(-travel);
        RayTube { origin_m, travel, gradients, fields, length_m: 0.0, excess_m: 0.0 }
    }
}

struct ShootingJob<'a> {
    body: &'a Body,
    ends: AntennaPair,
    wavenumbers_per_m: &'a [f64],
    grid: RayGrid,
    shooting: &'a RaySettings,
}

impl ShootingJob<'_> {
    fn zero_sums(&self) -> Orders {
        let order = vec![Amplitude::default(); self.wavenumbers_per_m.len()];
        vec![order; usize::from(self.shooting.bounces)]
    }

    fn shoot_row(&self, row: u64) -> Orders {
        let mut sums = self.zero_sums();
        for column in 0..self.grid.columns {
            self.follow(
                self.grid.tube(&self.ends.transmitter, row, column, 1.01 * self.body.radius_m),
                &mut sums,
            );
        }
        sums
    }

    /// Follows one ray from the antenna through its reflections.
    fn follow(&self, mut tube: RayTube, sums: &mut Orders) {
        let mut left = None;
        // Set from the first reflection by anything but a perfect conductor on.
        let mut coated: Option<Fields> = None;
        for (order, sum) in sums.iter_mut().enumerate() {
            let Some(hit) = self.body.nearest(tube.origin_m, tube.travel, left) else { return };
            tube.advance(&hit, &self.ends.transmitter, order);
            if !self.body.scatters(hit.facet, tube.travel, self.shooting.sides) {
                return;
            }
            self.add_footprint(&tube, coated.as_ref(), hit.facet, sum);
            coated = self.reflected(&tube, coated, hit.facet);
            tube.reflect(self.body.facets[hit.facet as usize].normal);
            left = Some(hit.facet);
        }
    }

    /// Fields after a reflection, if they differ from those between perfect conductors.
    fn reflected(&self, tube: &RayTube, coated: Option<Fields>, facet: u32) -> Option<Fields> {
        const CONDUCTOR: &Material = &Material::Conductor;
        let material = self.body.material(facet);
        if coated.is_none() && material.is_none() {
            return None;
        }
        let mut fields = coated.unwrap_or_else(|| fields_at_all(tube.fields, self.wavenumbers_per_m));
        let normal = self.body.facets[facet as usize].normal;
        for (pair, &wavenumber_per_m) in fields.iter_mut().zip(self.wavenumbers_per_m) {
            let surface = Surface { material: material.unwrap_or(CONDUCTOR), wavenumber_per_m };
            *pair = pair.map(|e| surface.reflected(normal, tube.travel, e));
        }
        Some(fields)
    }

    /// Adds physical optics over the tube's footprint, if the receiver sees it.
    fn add_footprint(&self, tube: &RayTube, coated: Option<&Fields>, facet: u32, sums: &mut [Amplitude]) {
        let x_m = tube.origin_m;
        let receiver = self.ends.receiver();
        let leg = receiver.leg_from(x_m);
        let backward = Arrival::direct(&leg, receiver.polarizations(leg.towards));
        let normal = self.body.facets[facet as usize].normal;
        let Some(node) = node::node(&self.ends, &tube.arrival(), &backward, normal, self.shooting.bracket)
        else {
            return;
        };
        if !self.body.scatters(facet, backward.travel, self.shooting.sides)
            || !self.body.is_clear(x_m, facet, receiver)
        {
            return;
        }
        let footprint = tube.footprint(normal);
        match (coated, self.body.material(facet)) {
            (None, None) => self.add_node(&node, footprint, sums),
            (coated, material) => {
                let conductor = Material::Conductor;
                let own = fields_at_all(tube.fields, self.wavenumbers_per_m);
                let met = CoatedWavePair {
                    tube,
                    sent: coated.unwrap_or(&own),
                    backward,
                    material: material.unwrap_or(&conductor),
                };
                self.add_coated(&node, &met, footprint, sums);
            }
        }
    }

    fn add_node(&self, node: &Node, footprint: [DVec3; 2], sums: &mut [Amplitude]) {
        for (sum, k) in sums.iter_mut().zip(self.wavenumbers_per_m) {
            node::add_weighted(sum, &node.weight, integral(node, footprint, *k));
        }
    }

    fn add_coated(
        &self,
        node: &Node,
        met: &CoatedWavePair<'_>,
        footprint: [DVec3; 2],
        sums: &mut [Amplitude],
    ) {
        let forward = met.tube.arrival();
        for ((sum, &wavenumber_per_m), sent) in sums.iter_mut().zip(self.wavenumbers_per_m).zip(met.sent) {
            let surface = Surface { material: met.material, wavenumber_per_m };
            let weight =
                coated::weight(node, (&forward, sent), &met.backward, &surface, self.shooting.bracket);
            node::add_with_phase(sum, &weight, integral(node, footprint, wavenumber_per_m));
        }
    }
}

/// Two waves on a facet, one of which has met something other than perfect conductors.
struct CoatedWavePair<'a> {
    tube: &'a RayTube,
    sent: &'a Fields,
    backward: Arrival,
    material: &'a Material,
}

/// Integral of e^{−jk·path length} over the parallelogram of a footprint.
fn integral(node: &Node, [a, b]: [DVec3; 2], wavenumber_per_m: f64) -> Complex64 {
    let shape = [a, b].map(|edge| sinc(0.5 * wavenumber_per_m * node.travel_sum.dot(edge)));
    node::phasor(wavenumber_per_m, node.excess_m) * (a.cross(b).length() * shape[0] * shape[1])
}

impl RayTube {
    /// Advances to the facet that was hit.
    fn advance(&mut self, hit: &Hit, transmitter: &PreparedAntenna, order: usize) {
        self.origin_m += hit.distance_m * self.travel;
        self.length_m += hit.distance_m;
        if order == 0 {
            // Computed from the point itself: r − R keeps its digits, and at infinite range the ray's start
            // does not matter.
            self.excess_m = transmitter.leg_from(self.origin_m).excess_m;
        } else {
            self.excess_m += hit.distance_m;
        }
        if transmitter.antenna_m.is_none() {
            self.length_m = f64::INFINITY;
        }
    }

    fn arrival(&self) -> Arrival {
        Arrival { travel: self.travel, fields: self.fields, excess_m: self.excess_m, length_m: self.length_m }
    }

    /// Edges of the parallelogram lit by the tube on a plane with this normal.
    fn footprint(&self, normal: DVec3) -> [DVec3; 2] {
        let spread = if self.length_m.is_finite() { self.length_m } else { 1.0 };
        self.gradients.map(|g| (g - self.travel * (normal.dot(g) / normal.dot(self.travel))) * spread)
    }

    /// Reflects the ray specularly; the field tangential to a perfect conductor changes its sign: e → −e +
    /// 2n(n·e).
    fn reflect(&mut self, normal: DVec3) {
        let mirrored = |v: DVec3| v - 2.0 * normal.dot(v) * normal;
        self.travel = mirrored(self.travel);
        self.gradients = self.gradients.map(mirrored);
        self.fields = self.fields.map(|e| -mirrored(e));
    }
}

fn sinc(x: f64) -> f64 {
    // The next term of the series, x⁴/120, is below rounding here.
    if x.abs() < 1e-3 { 1.0 - x * x / 6.0 } else { x.sin() / x }
}
