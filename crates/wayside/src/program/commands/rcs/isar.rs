//! Range profiles and inverse synthetic aperture images of a table S(frequency, azimuth).
//!
//! A scatterer at x has S ∝ e^{−2jkr}, where r is its range beyond the origin ([`AspectGeometry::range_m`];
//! −r̂·x far away): the transform over frequency compresses it to that range, and summing each azimuth's
//! profile at a place's range compresses it to its place.

use crate::program::commands::rcs::aspect_geometry::{AspectGeometry, Extent};
use crate::program::commands::rcs::sampling::{Sampling, Samplings, centre};
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use ndarray::{Array2, ArrayView2};
use num_complex::Complex64;
use rustfft::{FftDirection, FftPlanner};
use std::f64::consts::TAU;

/// Power over a square about the origin, `[ahead, left]`, body axes.
#[derive(Debug, Clone)]
pub(super) struct Image {
    pub(super) power_m2: Array2<f64>,
    pub(super) sum: Summation,
}

/// Way in which an image is summed over azimuths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Summation {
    /// Sum of complex values: azimuths are dense enough.
    Coherent,
    /// Sum of powers.
    Incoherent,
}

/// Cells of an image along each side.
const SIDE: usize = 240;
/// Oversampling of range cells, for which linear interpolation errs by less than 2 % of the peak (π²/8·4²·…,
/// Hann's main lobe).
const FINER: usize = 8;

/// (range beyond the origin in m, value) over the unambiguous range about `middle_m`; Hann window, peaks keep
/// their level.
pub(super) fn range_profile(
    frequency_hz: &[f64],
    samples: &[Complex64],
    middle_m: f64,
) -> Vec<(f64, Complex64)> {
    let profile = Profile::of(frequency_hz, samples.iter().copied());
    let count = profile.values.len() as i64;
    let first = (middle_m / profile.cell_m).round() as i64 - count / 2;
    let value = |i: i64| (i as f64 * profile.cell_m, profile.values[i.rem_euclid(count) as usize]);
    (first..first + count).map(value).collect()
}

/// The square shown in an image, with the sampling of the table.
#[derive(Debug, Clone, Copy)]
pub(super) struct Square<'a> {
    /// Half its side, about the origin.
    pub(super) half_width_m: f64,
    /// Height of the image plane over the origin: points above or below it are shown nearer or farther by the
    /// corresponding change of range.
    pub(super) height_m: f64,
    pub(super) samplings: &'a Samplings,
}

impl Square<'_> {
    fn sum(&self) -> Summation {
        let is_coarse = self.samplings.cross_range.is_some_and(|cross| cross.is_ambiguous());
        if is_coarse { Summation::Incoherent } else { Summation::Coherent }
    }

    /// Unambiguous window of a look about the middle of the body. Beyond it the body repeats; it is unbounded
    /// if the body itself does not fit and overlaps with itself anyway.
    fn window(&self, extent: &Extent) -> Extent {
        const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
        let of = |sampling: Option<Sampling>, [low, high]: [f64; 2]| match sampling {
            Some(sampling) if !sampling.is_ambiguous() => {
                [-0.5, 0.5].map(|half| 0.5 * (low + high) + half * sampling.unambiguous_m)
            }
            _ => ALL,
        };
        Extent {
            range_m: of(self.samplings.range, extent.range_m),
            across_m: of(self.samplings.cross_range, extent.across_m),
        }
    }
}

/// Backprojection of all azimuths onto a square, each with its look and the body's extent there; coherent if
/// the width is sampled without ambiguity, otherwise powers are added. A look contributes nothing where it
/// would show the body again.
pub(super) fn image(
    frequency_hz: &[f64],
    looks: &[(AspectGeometry, Extent)],
    table: &ArrayView2<Complex64>,
    square: Square<'_>,
) -> Image {
    let profiles: Vec<Profile> =
        table.columns().into_iter().map(|c| Profile::of(frequency_hz, c.iter().copied())).collect();
    let wavenumber = TAU * centre(frequency_hz) / SPEED_OF_LIGHT_MPS;
    let sum = square.sum();
    let windows: Vec<Extent> = looks.iter().map(|(_, extent)| square.window(extent)).collect();
    let place = |i: usize| square.half_width_m * (2.0 * (i as f64 + 0.5) / SIDE as f64 - 1.0);
    let cell = |(y, x): (usize, usize)| {
        let place_m = DVec3::new(place(y), place(x), square.height_m);
        let value = |((look, _), (profile, window)): (&(AspectGeometry, Extent), (&Profile, &Extent))| {
            let range_m = look.range_m(place_m);
            let is_inside = |[low, high]: [f64; 2], v: f64| low <= v && v <= high;
            if is_inside(window.range_m, range_m) && is_inside(window.across_m, look.across_m(place_m)) {
                profile.at(range_m) * Complex64::cis(2.0 * wavenumber * range_m)
            } else {
                Complex64::ZERO
            }
        };
        power(looks.iter().zip(profiles.iter().zip(&windows)).map(value), sum)
    };
    Image { power_m2: Array2::from_shape_fn((SIDE, SIDE), cell), sum }
}

fn power(values: impl ExactSizeIterator<Item = Complex64>, sum: Summation) -> f64 {
    let count = values.len() as f64;
    match sum {
        Summation::Coherent => (values.sum::<Complex64>() / count).norm_sqr(),
        Summation::Incoherent => values.map(|s| s.norm_sqr()).sum::<f64>() / count,
    }
}

/// Transformed samples over equidistant frequencies, with the phase of the centre frequency removed.
struct Profile {
    cell_m: f64,
    /// Values at ranges 0, cell, 2·cell, … and, from the end, −cell, …
    values: Vec<Complex64>,
}

impl Profile {
    fn of(frequency_hz: &[f64], samples: impl Iterator<Item = Complex64>) -> Self {
        let count = frequency_hz.len();
        let padded = FINER * count.next_power_of_two();
        let taper = |n: usize| (1.0 - (TAU * (n as f64 + 0.5) / count as f64).cos()) / count as f64;
        let mut values = vec![Complex64::ZERO; padded];
        // The centre frequency goes to index 0, so that the phase changes slowly with range.
        for (n, s) in samples.enumerate() {
            values[(n + padded - count / 2) % padded] = s * taper(n);
        }
        let step_hz = (frequency_hz[count - 1] - frequency_hz[0]) / (count - 1) as f64;
        // With falling frequencies the phase turns in the other direction.
        let direction = if step_hz < 0.0 { FftDirection::Forward } else { FftDirection::Inverse };
        FftPlanner::new().plan_fft(padded, direction).process(&mut values);
        Self { cell_m: SPEED_OF_LIGHT_MPS / (2.0 * step_hz.abs() * padded as f64), values }
    }

    /// Interpolates linearly between cells; ranges are periodic.
    fn at(&self, range_m: f64) -> Complex64 {
        let count = self.values.len();
        let place = (range_m / self.cell_m).rem_euclid(count as f64);
        let (below, share) = (place as usize % count, place.fract());
        self.values[below] * (1.0 - share) + self.values[(below + 1) % count] * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::commands::rcs::test_request::request_of;
    use artifact::scene::Mesh;
    use bart_rcs::{RcsRequest, Standpoint};

    fn scatterer(ahead_m: f64, left_m: f64, frequency_hz: &[f64], azimuth_rad: &[f64]) -> Array2<Complex64> {
        Array2::from_shape_fn((frequency_hz.len(), azimuth_rad.len()), |(f, a)| {
            let k = TAU * frequency_hz[f] / SPEED_OF_LIGHT_MPS;
            Complex64::cis(2.0 * k * (azimuth_rad[a].cos() * ahead_m + azimuth_rad[a].sin() * left_m))
        })
    }

    fn frequencies() -> Vec<f64> {
        (0..64).map(|i| 76.5e9 + 1e9 * f64::from(i) / 63.0).collect()
    }

    fn falling() -> Vec<f64> {
        frequencies().into_iter().rev().collect()
    }

    #[test]
    fn a_scatterer_ahead_of_the_origin_is_nearer_by_its_distance() {
        for frequencies in [frequencies(), falling()] {
            let table = scatterer(1.2, 0.0, &frequencies, &[0.0]);
            let profile = range_profile(&frequencies, &table.column(0).to_vec(), 0.0);
            let peak = profile.iter().max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())).unwrap();
            // A cell of 1 GHz is 0.15 m, shown eight times finer.
            println!("asked −1.2 m, 1 m²; got {:.3} m, {:.3} m²", peak.0, peak.1.norm_sqr());
            assert!((peak.0 + 1.2).abs() < 0.01 && (peak.1.norm() - 1.0).abs() < 0.01);
        }
    }

    /// The images of scatterers in the corners of a plate of 2.4 m × 1.8 m at a height, by the antennas of
    /// the request: all places of cells within 3 dB of the strongest.
    fn shown(request: &RcsRequest, height_m: f64) -> Vec<[f64; 2]> {
        let corners = CORNERS.map(|[ahead_m, left_m]| [ahead_m, left_m, height_m]);
        let mesh = Mesh { vertices_m: corners.to_vec(), ..Mesh::default() };
        let looks: Vec<(AspectGeometry, Extent)> = request
            .azimuth_rad
            .iter()
            .map(|azimuth_rad| AspectGeometry::of(request, *azimuth_rad))
            .map(|look| (look, look.extent(&mesh)))
            .collect();
        let distance_m = |at: Standpoint, place_m: DVec3| {
            // The plane wave's as a limit.
            let range_m = at.range_m.min(1e7);
            (range_m * at.direction() - place_m).length() - range_m
        };
        let table = Array2::from_shape_fn((request.frequency_hz.len(), looks.len()), |(f, a)| {
            let elevation_rad = request.elevation_rad[0];
            let azimuth_rad = request.azimuth_rad[a];
            let from = Standpoint { azimuth_rad, elevation_rad, range_m: request.range_m };
            let to = request.receiver.unwrap_or(from);
            let wavenumber = TAU * request.frequency_hz[f] / SPEED_OF_LIGHT_MPS;
            let way_m = |corner: &[f64; 3]| {
                let place_m = DVec3::from(*corner);
                distance_m(from, place_m) + distance_m(to, place_m)
            };
            corners.iter().map(|corner| Complex64::cis(-wavenumber * way_m(corner))).sum()
        });
        let samplings = Samplings::of(&mesh, request);
        let square = Square { half_width_m: HALF_WIDTH_M, height_m, samplings: &samplings };
        let image = image(&request.frequency_hz, &looks, &table.view(), square);
        assert_eq!(image.sum, Summation::Coherent);
        let strongest = image.power_m2.iter().copied().fold(0.0, f64::max);
        let place = |i: usize| HALF_WIDTH_M * (2.0 * (i as f64 + 0.5) / SIDE as f64 - 1.0);
        let bright = image.power_m2.indexed_iter().filter(|(_, power)| **power > 0.5 * strongest);
        bright.map(|((y, x), _)| [place(y), place(x)]).collect()
    }

    const CORNERS: [[f64; 2]; 4] = [[1.2, 0.9], [1.2, -0.9], [-1.2, 0.9], [-1.2, -0.9]];
    const HALF_WIDTH_M: f64 = 3.0;

    /// Azimuths over 0.06 rad from `first_rad` on, a cross-range cell of 3 cm, in steps of λ/(2·2.7 m): less
    /// than the square's side.
    fn request(frequency_hz: Vec<f64>, first_rad: f64) -> RcsRequest {
        let azimuth_rad: Vec<f64> = (0..84).map(|i| first_rad + 7.2e-4 * f64::from(i)).collect();
        request_of(&frequency_hz, &azimuth_rad)
    }

    #[test]
    fn an_image_shows_scatterers_where_they_are_and_nowhere_else() {
        let receiver = Some(Standpoint { azimuth_rad: 0.8, elevation_rad: 0.3, range_m: f64::INFINITY });
        let plain = request(frequencies(), 0.0);
        let cases = [
            ("far away", plain.clone(), 0.0),
            ("from above", RcsRequest { elevation_rad: vec![0.7], ..plain.clone() }, 0.5),
            ("falling frequencies", RcsRequest { frequency_hz: falling(), ..plain.clone() }, 0.0),
            ("near by", RcsRequest { range_m: 12.0, elevation_rad: vec![0.2], ..plain.clone() }, 0.3),
            ("from aside", request(frequencies(), 1.55), 0.0),
            ("a receiver that stands still", RcsRequest { receiver, ..plain }, 0.2),
        ];
        for (what, request, height_m) in cases {
            let shown = shown(&request, height_m);
            let off_m = |at: &[f64; 2]| {
                let distances = CORNERS.map(|corner| (at[0] - corner[0]).hypot(at[1] - corner[1]));
                distances.into_iter().fold(f64::INFINITY, f64::min)
            };
            let farthest_m = shown.iter().map(off_m).fold(0.0, f64::max);
            let is_shown =
                |corner: &[f64; 2]| shown.iter().any(|at| (at[0] - corner[0]).hypot(at[1] - corner[1]) < 0.1);
            println!("{what}: {} cells, {farthest_m:.3} m off at most", shown.len());
            // A range cell of 1 GHz is 0.15 m, twice as long by Hann and in bistatic ranges.
            assert!(farthest_m < 0.25 && CORNERS.iter().all(is_shown), "{what}");
        }
    }
}
