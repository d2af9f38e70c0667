//! Random tables of several aspects, antennas together or apart, at every choice that `rcs` has: the error of
//! S that is printed beside the true one.
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]

use super::methods::{decibels, error};
use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::{Edges, NodeRule, Sides, SmallParts, Surface};
use bart_rcs::{RcsRequest, Standpoint, rcs};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use std::f64::consts::{PI, TAU};

/// A table; decibels are relative amplitude errors.
#[derive(Debug)]
pub(crate) struct Found {
    pub(crate) name: String,
    pub(crate) request: RcsRequest,
    pub(crate) asked_db: f64,
    pub(crate) printed_db: f64,
    pub(crate) true_db: f64,
}

/// So much finer is the reference: where both are just met, its own error blurs what is measured by 0.8 dB.
const REFERENCE_DB: f64 = 20.0;

/// Table number `case` at the accuracy asked against the same one [`REFERENCE_DB`] finer; `band_hz` are
/// frequencies in whose middle tables of 1 % bandwidth lie.
pub(crate) fn try_table(case: u64, meshes: &[(impl AsRef<str>, Mesh)], bands_hz: &[f64]) -> Found {
    let mut rng = ChaCha12Rng::from_seed(artifact::seed::key(7, "validation/random-tables", &[case]));
    let (name, mesh) = &meshes[rng.random_range(0..meshes.len())];
    let asked_db = rng.random_range(-30.0..-10.0);
    let request = request(&mut rng, bands_hz, asked_db);
    let finer = RcsRequest { accuracy: Accuracy::from_db(asked_db - REFERENCE_DB), ..request.clone() };
    let [got, truth] = [&request, &finer].map(|request| rcs(mesh, request, &|_, _| {}).unwrap());
    Found {
        name: name.as_ref().to_owned(),
        request,
        asked_db,
        printed_db: decibels(got.error.total().unwrap_or(0.0)),
        // Of what vanishes by symmetry none is printed, and there is none.
        true_db: decibels(if truth.vanishes { 0.0 } else { error(&got.amplitude_m, &truth.amplitude_m) }),
    }
}

fn request(rng: &mut ChaCha12Rng, bands_hz: &[f64], asked_db: f64) -> RcsRequest {
    let band_hz = one_of(rng, bands_hz);
    let frequencies = rng.random_range(3..10);
    let azimuths = one_of(rng, &[1, 2, 4, 12]);
    let (first_rad, step_rad) = (rng.random_range(0.0..TAU), rng.random_range(-1.0..1.0));
    let transmitter = standpoint(rng);
    let receiver = rng.random_bool(0.3).then(|| standpoint(rng));
    RcsRequest {
        frequency_hz: (0..frequencies).map(|_| band_hz * rng.random_range(0.995..1.005)).collect(),
        elevation_rad: vec![transmitter.elevation_rad],
        azimuth_rad: (0..azimuths).map(|i| first_rad + f64::from(i) * step_rad).collect(),
        range_m: transmitter.range_m,
        receiver,
        polarization: one_of(rng, &[Polarization::Vv, Polarization::Hh, Polarization::Vh, Polarization::Hv]),
        bounces: rng.random_range(1..=3),
        nodes: one_of(rng, &[NodeRule::Middle, NodeRule::Exit, NodeRule::OwnEdge]),
        sides: one_of(rng, &[Sides::Two, Sides::One]),
        edges: one_of(rng, &[Edges::Ignored, Edges::FirstOrder]),
        surface: if rng.random_bool(0.15) { Surface::Smooth } else { Surface::Flat },
        small_parts: SmallParts::OfMesh,
        accuracy: Accuracy::from_db(asked_db),
    }
}

/// A place at any azimuth, far away in two of five cases and 13 to 100 m away in the others.
fn standpoint(rng: &mut ChaCha12Rng) -> Standpoint {
    Standpoint {
        azimuth_rad: rng.random_range(-PI..PI),
        elevation_rad: rng.random_range(-0.1..0.6),
        range_m: if rng.random_bool(0.4) { f64::INFINITY } else { 10.0_f64.powf(rng.random_range(1.1..2.0)) },
    }
}

fn one_of<T: Copy>(rng: &mut ChaCha12Rng, choices: &[T]) -> T {
    choices[rng.random_range(0..choices.len())]
}

impl std::fmt::Display for Found {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let request = &self.request;
        let azimuths = &request.azimuth_rad;
        let of = |at: f64| format!("{:.1}", at.to_degrees());
        write!(f, "| {} | {:.1} | ", self.name, request.frequency_hz[0] * 1e-9)?;
        write!(f, "{} … {} ({}) | ", of(azimuths[0]), of(azimuths[azimuths.len() - 1]), azimuths.len())?;
        write!(f, "{} | {:.1} | ", of(request.elevation_rad[0]), request.range_m)?;
        match request.receiver {
            None => write!(f, "– | ")?,
            Some(r) => write!(f, "{}, {}, {:.1} | ", of(r.azimuth_rad), of(r.elevation_rad), r.range_m)?,
        }
        write!(f, "{:?} {:?} {:?} ", request.polarization, request.nodes, request.sides)?;
        write!(f, "{:?} {:?} | {} | ", request.edges, request.surface, request.bounces)?;
        write!(f, "{:.1} | {:.1} | ", self.asked_db, self.printed_db)?;
        write!(f, "{:.1} | {:.1} |", self.true_db, self.printed_db - self.true_db)
    }
}
