//! Backscatter of the road itself: patches of the plane z = 0, smaller than the radar's resolution, each a
//! point with random scattering amplitude.
//!
//! On a plane h below the radar, slant ranges from R on by δR over an azimuth δφ cover the area R·δR·δφ
//! exactly (ρdρ = RdR). With σ⁰ = γ·sin ψ and sin ψ = h/R a patch therefore has the mean RCS γ·h·δR·δφ,
//! wherever it lies. Its amplitude is √σ·g, g a circular complex Gaussian number of unit power: every sum
//! over patches is then Gaussian, whatever the windows, channels and antenna patterns, a cell's amplitude has
//! a Rayleigh distribution, and its mean power is the radar equation's integral ∫σ⁰G²λ²/((4π)³R⁴)dA over its
//! footprint.
//!
//! Ground and radar are both at rest: a seed draws the same patches in every frame, all of them at zero
//! Doppler.

use crate::error::EchoError;
use artifact::paths::{GROUND, Path};
use artifact::radar::{Pattern, Radar};
use artifact::scene::Backscatter;
use artifact::seed;
use num_complex::Complex64;
use rand::rand_core::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Number of patches per range cell and per beam.
const PATCHES_PER_CELL: f64 = 2.0;

/// Maximum number of patches: a gibibyte at 296 bytes each.
const PATCH_LIMIT: usize = 1 << 22;

/// Paths of the ground in front of the array, from below the radar to the waveform's range limit, beyond
/// which beat frequencies alias; none if the radar is not above the ground. Ordered by range, then by
/// azimuth.
///
/// # Errors
/// More patches than the limit of [`EchoError::GroundTooFine`].
pub fn paths(radar: &Radar, backscatter: &Backscatter, seed: u64) -> Result<Vec<Path>, EchoError> {
    let grid = GroundGrid::of(radar);
    if grid.patches() > PATCH_LIMIT {
        return Err(EchoError::GroundTooFine { patches: grid.patches(), limit: PATCH_LIMIT });
    }
    let amplitude_m = (backscatter.gamma * grid.height_m * grid.ring_m * grid.sector_rad).sqrt();
    let ring = |ring: usize| grid.ring(radar, ring, amplitude_m, seed);
    Ok((0..grid.rings).into_par_iter().map(ring).collect::<Vec<_>>().concat())
}

/// Number of paths made by [`paths`].
pub fn patches(radar: &Radar) -> usize {
    GroundGrid::of(radar).patches()
}

/// Rings of equal slant range and sectors of equal azimuth.
struct GroundGrid {
    height_m: f64,
    rings: usize,
    ring_m: f64,
    sectors: usize,
    sector_rad: f64,
}

impl GroundGrid {
    fn of(radar: &Radar) -> Self {
        let height_m = radar.position_m[2];
        let deep_m = if height_m > 0.0 { (radar.waveform.range_max_m() - height_m).max(0.0) } else { 0.0 };
        let rings = (PATCHES_PER_CELL * deep_m / radar.waveform.range_resolution_m()).ceil() as usize;
        // A row of n virtual elements half a wavelength apart has beams of 2/n rad straight ahead, where they
        // are narrowest; a single element has that of its pattern.
        let beams_per_rad = (0.5 * virtual_row(radar)).max(1.0 / two_way_beam_rad(&radar.array.pattern));
        let sectors = (PATCHES_PER_CELL * PI * beams_per_rad).ceil() as usize;
        Self {
            height_m,
            rings,
            ring_m: deep_m / rings.max(1) as f64,
            sectors,
            sector_rad: PI / sectors as f64,
        }
    }

    fn patches(&self) -> usize {
        self.rings.saturating_mul(self.sectors)
    }

    fn ring(&self, radar: &Radar, ring: usize, amplitude_m: f64, seed: u64) -> Vec<Path> {
        let mut draw = RingRandom(ChaCha8Rng::from_seed(seed::key(seed, "fmcw-echo/ground", &[ring as u64])));
        let [x, y, _] = radar.position_m;
        let patch = |sector: usize| {
            let range_m = self.height_m + self.ring_m * (ring as f64 + draw.uniform());
            let azimuth =
                radar.boresight_az_rad - FRAC_PI_2 + self.sector_rad * (sector as f64 + draw.uniform());
            let away_m = ((range_m - self.height_m) * (range_m + self.height_m)).sqrt();
            let place_m = [x + away_m * azimuth.sin(), y + away_m * azimuth.cos(), 0.0];
            let [vv, hh] = [draw.normal() * amplitude_m, draw.normal() * amplitude_m];
            let amplitude_m = [[vv, Complex64::ZERO], [Complex64::ZERO, hh]];
            Path { target: GROUND, ..Path::of_point(place_m, [0.0; 3], amplitude_m) }
        };
        (0..self.sectors).map(patch).collect()
    }
}

/// Horizontal extent of the virtual array, in elements half a wavelength apart.
fn virtual_row(radar: &Radar) -> f64 {
    let span = |row: &[[f64; 2]]| {
        let across = || row.iter().map(|element| element[0]);
        across().fold(f64::NEG_INFINITY, f64::max) - across().fold(f64::INFINITY, f64::min)
    };
    1.0 + span(&radar.array.tx_half_wavelengths).max(0.0) + span(&radar.array.rx_half_wavelengths).max(0.0)
}

/// Azimuths at which the two-way power of an element is at least half of its maximum, together; π ahead for
/// one without a pattern.
fn two_way_beam_rad(pattern: &Pattern) -> f64 {
    const STEPS: usize = 4096;
    let elevations_rad: &[f64] = match pattern {
        Pattern::Table(table) => &table.elevation_rad,
        Pattern::Isotropic | Pattern::Cosine { .. } => &[0.0],
    };
    let two_way_power = |step: usize| {
        let azimuth_rad = PI * ((step as f64 + 0.5) / STEPS as f64 - 0.5);
        let at = |elevation_rad: &f64| {
            let (up, level) = elevation_rad.sin_cos();
            pattern.amplitude([level * azimuth_rad.sin(), level * azimuth_rad.cos(), up]).powi(4)
        };
        elevations_rad.iter().map(at).fold(0.0, f64::max)
    };
    let power: Vec<f64> = (0..STEPS).map(two_way_power).collect();
    let half = 0.5 * power.iter().copied().fold(0.0, f64::max);
    PI * power.iter().filter(|power| **power >= half).count() as f64 / STEPS as f64
}

/// Random numbers for one ring.
struct RingRandom(ChaCha8Rng);

impl RingRandom {
    /// A uniform number in [0, 1) with 53 bits.
    fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (0.5_f64).powi(53)
    }

    /// A circular complex Gaussian number of unit power (Box–Muller).
    fn normal(&mut self) -> Complex64 {
        let power = -(1.0 - self.uniform()).ln();
        Complex64::from_polar(power.sqrt(), TAU * self.uniform())
    }
}
