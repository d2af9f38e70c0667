//! First-order physical optics by dense sampling: every facet is divided into small cells, a shadow ray is
//! cast from each cell to the antennas, and the integrand is evaluated at the points of a quadrature rule.

use crate::aspect::{AntennaPair, Aspect, PreparedAntenna};
use crate::coated::{self, Surface};
use crate::node::{self, Arrival, Bracket};
use crate::ray_cast::{Body, ReferenceError};
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::settings::Sides;
use glam::DVec3;
use num_complex::Complex64;
use radar::complex_vector::ComplexVector;
use rayon::prelude::*;

/// Sampling density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Cells per shortest wavelength: no edge is longer than that wavelength over this.
    pub per_wavelength: f64,
    /// Number of halvings of a cell across a shadow boundary; 0 casts one shadow ray per cell.
    pub shadow_levels: u32,
    /// Sides of a facet that scatter.
    pub sides: Sides,
    /// Form of the vector part where transmitter and receiver are apart; in one place all forms are equal.
    pub bracket: Bracket,
}

/// First-order S at each frequency, metres, as defined in `interface.md`.
///
/// Inside a lit cell the rule has degree 5, so the slowest convergence is at shadow boundaries: the error
/// falls as (cell edge)^1.5, and `shadow_levels` refines the cells there alone.
pub fn amplitude(
    mesh: &Mesh,
    aspect: &Aspect,
    frequencies_hz: &[f64],
    sampling: &Sampling,
) -> Result<Vec<Amplitude>, ReferenceError> {
    let body = Body::of_mesh(mesh)?;
    check_positive("samples per wavelength", sampling.per_wavelength)?;
    frequencies_hz.iter().try_for_each(|f| check_positive("frequency", *f))?;
    let wavenumbers_per_m = node::wavenumbers(frequencies_hz);
    let edge_m = node::shortest_wavelength_m(frequencies_hz) / sampling.per_wavelength;
    let job = SamplingJob {
        body: &body,
        ends: AntennaPair::of(aspect),
        wavenumbers_per_m: &wavenumbers_per_m,
        edge_m,
        sampling,
    };
    job.check_count()?;
    let patches: Vec<Cell> = (0..body.facets.len() as u32).flat_map(|f| job.patches(f)).collect();
    let parts: Vec<Vec<Amplitude>> = patches.par_iter().map(|patch| job.integrate(patch)).collect();
    let mut sums = vec![Amplitude::default(); frequencies_hz.len()];
    for part in &parts {
        sums.iter_mut().zip(part).for_each(|(sum, term)| node::add(sum, term));
    }
    Ok(node::scaled(&sums, &wavenumbers_per_m))
}

pub(crate) fn check_positive(what: &'static str, value: f64) -> Result<(), ReferenceError> {
    let ok = value > 0.0 && value.is_finite();
    if ok { Ok(()) } else { Err(ReferenceError::NotPositive { what, value }) }
}

/// A part of a facet.
#[derive(Debug, Clone, Copy)]
struct Cell {
    facet: u32,
    corners_m: [DVec3; 3],
}

struct SamplingJob<'a> {
    body: &'a Body,
    ends: AntennaPair,
    wavenumbers_per_m: &'a [f64],
    edge_m: f64,
    sampling: &'a Sampling,
}

/// Edge length in cells of a patch, the unit of parallel work.
const CELLS_PER_PATCH_EDGE: f64 = 64.0;

/// Maximum number of cells, or rays, per aspect: some hours on one processor.
const MOST_SAMPLES: f64 = 1e10;

pub(crate) fn check_count(what: &'static str, count: f64) -> Result<(), ReferenceError> {
    if count <= MOST_SAMPLES {
        Ok(())
    } else {
        Err(ReferenceError::TooMany { what, count, most: MOST_SAMPLES })
    }
}

impl SamplingJob<'_> {
    /// Checks the number of cells over all facets, with two cells for a square of their edge.
    fn check_count(&self) -> Result<(), ReferenceError> {
        let area_m2 = |facet| Cell { facet: 0, corners_m: facet }.area_m2();
        let all_m2: f64 = self.body.facets.iter().map(|facet| area_m2(facet.corners_m)).sum();
        check_count("cells of physical optics", 2.0 * all_m2 / (self.edge_m * self.edge_m))
    }

    /// Divides a facet into units of work; empty if the facet cannot scatter from one antenna to the other.
    fn patches(&self, facet: u32) -> Vec<Cell> {
        let corners_m = self.body.facets[facet as usize].corners_m;
        let travel = |post: &PreparedAntenna| -post.leg_from(corners_m[0]).towards;
        let mut patches = Vec::new();
        if self.ends.antennas().all(|post| self.body.scatters(facet, travel(post), self.sampling.sides)) {
            let whole = Cell { facet, corners_m };
            whole.split_to(CELLS_PER_PATCH_EDGE * self.edge_m, &mut |cell| patches.push(cell));
        }
        patches
    }

    fn integrate(&self, patch: &Cell) -> Vec<Amplitude> {
        let mut sums = vec![Amplitude::default(); self.wavenumbers_per_m.len()];
        patch.split_to(self.edge_m, &mut |cell| self.add_cell(&cell, self.sampling.shadow_levels, &mut sums));
        sums
    }

    /// Adds a cell; a partly lit one is halved while levels remain.
    fn add_cell(&self, cell: &Cell, levels: u32, sums: &mut [Amplitude]) {
        let lit = self.is_lit(cell, cell.at([1.0 / 3.0; 3]));
        let border = levels > 0 && PROBES.iter().any(|probe| self.is_lit(cell, cell.at(*probe)) != lit);
        if border {
            cell.halves().iter().for_each(|half| self.add_cell(half, levels - 1, sums));
        } else if lit {
            self.add_lit(cell, sums);
        }
    }

    fn is_lit(&self, cell: &Cell, point_m: DVec3) -> bool {
        self.ends.antennas().all(|post| self.body.is_clear(point_m, cell.facet, post))
    }

    fn add_lit(&self, cell: &Cell, sums: &mut [Amplitude]) {
        let area_m2 = cell.area_m2();
        for (barycentric, share) in quadrature_points() {
            self.add_point(cell.facet, cell.at(barycentric), area_m2 * share, sums);
        }
    }

    fn add_point(&self, facet: u32, x_m: DVec3, area_m2: f64, sums: &mut [Amplitude]) {
        let [forward, backward] = [&self.ends.transmitter, self.ends.receiver()].map(|post| {
            let leg = post.leg_from(x_m);
            Arrival::direct(&leg, post.polarizations(leg.towards))
        });
        let normal = self.body.facets[facet as usize].normal;
        let bracket = self.sampling.bracket;
        let Some(node) = node::node(&self.ends, &forward, &backward, normal, bracket) else { return };
        let material = self.body.material(facet);
        let sent = forward.fields.map(ComplexVector::from);
        for (sum, &wavenumber_per_m) in sums.iter_mut().zip(self.wavenumbers_per_m) {
            let value: Complex64 = node::phasor(wavenumber_per_m, node.excess_m) * area_m2;
            let Some(material) = material else {
                node::add_weighted(sum, &node.weight, value);
                continue;
            };
            let surface = Surface { material, wavenumber_per_m };
            let weight = coated::weight(&node, (&forward, &sent), &backward, &surface, bracket);
            node::add_with_phase(sum, &weight, value);
        }
    }
}

/// Points, besides its centre, at which a cell tests whether it is completely lit.
const PROBES: [[f64; 3]; 3] = [[0.9, 0.05, 0.05], [0.05, 0.9, 0.05], [0.05, 0.05, 0.9]];

/// Radon's rule of degree 5 with 7 points: barycentric coordinates and area weights (Abramowitz & Stegun
/// 25.4.63).
fn quadrature_points() -> [([f64; 3], f64); 7] {
    let root = 15.0_f64.sqrt();
    let near = |r: f64| ((6.0 + r) / 21.0, (9.0 - 2.0 * r) / 21.0, (155.0 + r) / 1200.0);
    let ((a, b, inner), (c, d, outer)) = (near(-root), near(root));
    [
        ([1.0 / 3.0; 3], 9.0 / 40.0),
        ([b, a, a], inner),
        ([a, b, a], inner),
        ([a, a, b], inner),
        ([d, c, c], outer),
        ([c, d, c], outer),
        ([c, c, d], outer),
    ]
}

impl Cell {
    fn at(&self, barycentric: [f64; 3]) -> DVec3 {
        let [a, b, c] = self.corners_m;
        a * barycentric[0] + b * barycentric[1] + c * barycentric[2]
    }

    fn area_m2(&self) -> f64 {
        let [a, b, c] = self.corners_m;
        0.5 * (b - a).cross(c - a).length()
    }

    /// Index of the corner at which the longest edge starts.
    fn longest_edge(&self) -> usize {
        let length = |i: usize| self.corners_m[i].distance_squared(self.corners_m[(i + 1) % 3]);
        (1..3).fold(0, |best, i| if length(i) > length(best) { i } else { best })
    }

    /// Both halves of the cell, divided at the middle of its longest edge: needles become compact.
    fn halves(&self) -> [Self; 2] {
        let i = self.longest_edge();
        let [a, b, c] = [0, 1, 2].map(|j| self.corners_m[(i + j) % 3]);
        let middle = 0.5 * (a + b);
        [[a, middle, c], [middle, b, c]].map(|corners_m| Self { facet: self.facet, corners_m })
    }

    /// Passes on the parts of the cell that have no edge longer than `edge_m`.
    fn split_to(&self, edge_m: f64, take: &mut impl FnMut(Self)) {
        let i = self.longest_edge();
        if self.corners_m[i].distance(self.corners_m[(i + 1) % 3]) <= edge_m {
            take(*self);
        } else {
            self.halves().iter().for_each(|half| half.split_to(edge_m, take));
        }
    }
}
