//! A moving body chirp by chirp: does the scattered field run on smoothly? What jumps from one chirp to the
//! next is noise in the Doppler spectrum that no integration removes.
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]

use super::methods::{Run, bart, decibels};
use artifact::scene::Mesh;
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::Standpoint;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// A body that slides past the antenna, its x axis forward.
pub(crate) struct Slide<'a> {
    pub(crate) mesh: &'a Mesh,
    /// Antenna at the middle chirp, body axes.
    pub(crate) antenna_m: DVec3,
    pub(crate) velocity_mps: DVec3,
    pub(crate) frequency_hz: f64,
    pub(crate) chirp_interval_s: f64,
    pub(crate) chirps: usize,
}

/// The echo of every chirp, S·e^{−2jkR}, all orders.
fn echoes(slide: &Slide<'_>, method: &dyn Fn(&Mesh, Standpoint, &[f64]) -> Run) -> Vec<Complex64> {
    let wavenumber = TAU * slide.frequency_hz / SPEED_OF_LIGHT_MPS;
    let of = |chirp: usize| {
        let seconds = (chirp as f64 - 0.5 * slide.chirps as f64) * slide.chirp_interval_s;
        let to_antenna = slide.antenna_m - seconds * slide.velocity_mps;
        let place = Standpoint {
            azimuth_rad: to_antenna.y.atan2(to_antenna.x),
            elevation_rad: (to_antenna.z / to_antenna.length()).asin(),
            range_m: to_antenna.length(),
        };
        let run = method(slide.mesh, place, &[slide.frequency_hz]);
        let sum: Complex64 = run.orders.iter().map(|order| order[0]).sum();
        sum * Complex64::cis(-2.0 * wavenumber * to_antenna.length())
    };
    (0..slide.chirps).map(of).collect()
}

/// Root mean square difference of the phase increments from chirp to chirp, rad, each weighted by its power:
/// where the field passes through a null its phase says nothing.
fn increment_error_rad(got: &[Complex64], reference: &[Complex64]) -> f64 {
    let steps = |s: &[Complex64]| s.windows(2).map(|pair| pair[1] * pair[0].conj()).collect::<Vec<_>>();
    let (got, reference) = (steps(got), steps(reference));
    let weighted = got.iter().zip(&reference).map(|(g, r)| (r.norm(), (g * r.conj()).arg()));
    let (sum, weight) =
        weighted.fold((0.0, 0.0), |(s, w), (weight, error)| (s + weight * error * error, w + weight));
    (sum / weight).sqrt()
}

/// Median power of the half of the Doppler cells that lie farthest from the strongest one, over that one's,
/// dB. The window (Blackman–Harris, −92 dB) hides nothing above.
fn spectral_floor_db(echoes: &[Complex64]) -> f64 {
    let count = echoes.len();
    let power: Vec<f64> = (0..count).map(|cell| cell_power(echoes, cell)).collect();
    let peak = (0..count).max_by(|a, b| power[*a].total_cmp(&power[*b])).unwrap();
    let distance = |cell: usize| {
        let d = cell.abs_diff(peak);
        d.min(count - d)
    };
    let mut far: Vec<f64> = (0..count).filter(|c| distance(*c) > count / 4).map(|c| power[c]).collect();
    far.sort_by(f64::total_cmp);
    decibels((far[far.len() / 2] / power[peak]).sqrt())
}

fn cell_power(echoes: &[Complex64], cell: usize) -> f64 {
    let count = echoes.len() as f64;
    let term = |(n, s): (usize, &Complex64)| {
        let turn = TAU * (n as f64 + 0.5) / count;
        // Harris, Proc. IEEE 66 (1978) 51, minimum four-term window.
        let taper =
            0.35875 - 0.48829 * turn.cos() + 0.14128 * (2.0 * turn).cos() - 0.01168 * (3.0 * turn).cos();
        s * taper * Complex64::cis(-TAU * (n * cell) as f64 / count)
    };
    echoes.iter().enumerate().map(term).sum::<Complex64>().norm_sqr()
}

/// A method by its name, with so many bounces.
pub(crate) type Named<'a> = (&'a str, u8, Box<Method<'a>>);

type Method<'a> = dyn Fn(&Mesh, Standpoint, &[f64]) -> Run + 'a;

/// Name, increment error in rad against BART 60 dB below the field with as many bounces, spectral floor in
/// dB; the last two are the references themselves, of one bounce and of three.
pub(crate) fn rows(slide: &Slide<'_>, methods: &[Named<'_>]) -> Vec<(String, f64, f64)> {
    let fine = |bounces: u8| echoes(slide, &|mesh, place, f| bart(mesh, place, f, bounces, -60.0));
    let references = [fine(1), fine(3)];
    let row = |(name, bounces, method): &Named<'_>| {
        let found = echoes(slide, method);
        let reference = &references[usize::from(*bounces > 1)];
        (name.to_string(), increment_error_rad(&found, reference), spectral_floor_db(&found))
    };
    let names = ["BART, one bounce, −60 dB asked", "BART, three bounces, −60 dB asked"];
    let of_reference = |(name, s): (&&str, &Vec<Complex64>)| (name.to_string(), 0.0, spectral_floor_db(s));
    methods.iter().map(row).chain(names.iter().zip(&references).map(of_reference)).collect()
}
