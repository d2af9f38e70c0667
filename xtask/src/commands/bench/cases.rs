//! The comparisons: the tracer against dense sampling and ray shooting, the echo's recurrence against its reference.

use super::Comparison;
use crate::cli::BenchArguments;
use crate::failure::Failure;
use artifact::paths::Amplitude;
use artifact::radar::{Polarization, Radar};
use artifact::scene::Mesh;
use artifact::settings::{Edges, NodeRule, Sides, Surface};
use artifact::{Accuracy, Waveform};
use bart_rcs::reference::{Aspect, Bracket, po, sbr};
use bart_rcs::{RcsRequest, RcsResult, Standpoint};
use num_complex::Complex64;
use std::time::Instant;

const FREQUENCY_HZ: f64 = 77.3125e9;
const RANGE_M: f64 = 30.0;
const AZIMUTH_RAD: f64 = 0.4;
const ELEVATION_RAD: f64 = 0.15;

pub(super) fn all(arguments: &BenchArguments) -> Result<Vec<Comparison>, Failure> {
    let (model, density) = if arguments.quick { ("motorcycle-street", 2.0) } else { ("car-suv", 4.0) };
    let mesh = scene::vehicles::mesh(model, 0).ok_or_else(|| Failure::refused(format!("`{model}` is missing")))?;
    let mut list = vec![against_po(model, &mesh, density)?, against_sbr(model, &mesh, density)?];
    list.push(echo(if arguments.quick { 500 } else { 20_000 })?);
    Ok(list)
}

fn traced(mesh: &Mesh, bounces: u8, nodes: NodeRule) -> Result<RcsResult, Failure> {
    let request = RcsRequest {
        frequency_hz: vec![FREQUENCY_HZ],
        elevation_rad: vec![ELEVATION_RAD],
        azimuth_rad: vec![AZIMUTH_RAD],
        range_m: RANGE_M,
        receiver: None,
        polarization: Polarization::Vv,
        bounces,
        nodes,
        sides: Sides::Two,
        edges: Edges::Ignored,
        surface: Surface::Flat,
        accuracy: Accuracy::from_db(-40.0),
    };
    bart_rcs::rcs(mesh, &request, &|_, _| ()).map_err(Failure::refused)
}

fn aspect() -> Aspect {
    Aspect::monostatic(Standpoint { azimuth_rad: AZIMUTH_RAD, elevation_rad: ELEVATION_RAD, range_m: RANGE_M })
}

fn timed<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<(T, f64), Failure> {
    let start = Instant::now();
    let value = work()?;
    Ok((value, start.elapsed().as_secs_f64()))
}

fn against_po(model: &str, mesh: &Mesh, density: f64) -> Result<Comparison, Failure> {
    let (ours, ours_s) = timed(|| traced(mesh, 1, NodeRule::Middle))?;
    let sampling =
        po::Sampling { per_wavelength: density, shadow_levels: 3, sides: Sides::Two, bracket: Bracket::Symmetrised };
    let (rival, rival_s) =
        timed(|| po::amplitude(mesh, &aspect(), &[FREQUENCY_HZ], &sampling).map_err(Failure::refused))?;
    Ok(Comparison {
        name: format!("first order, {model}"),
        ours_s,
        rival: format!("po, {density} samples per wavelength"),
        rival_s,
        error: Some(difference(ours.amplitude_m[0], rival[0][0][0])),
        work: format!("{} triangles, one aspect, one frequency, {RANGE_M} m", mesh.triangles.len()),
    })
}

fn against_sbr(model: &str, mesh: &Mesh, density: f64) -> Result<Comparison, Failure> {
    let (ours, ours_s) = timed(|| traced(mesh, 3, NodeRule::Exit))?;
    let shooting = sbr::Shooting { per_wavelength: density, bounces: 3, sides: Sides::Two, bracket: Bracket::Plain };
    let (rival, rival_s) =
        timed(|| sbr::amplitude(mesh, &aspect(), &[FREQUENCY_HZ], &shooting).map_err(Failure::refused))?;
    let sum: Complex64 = rival.orders.iter().map(|order: &Vec<Amplitude>| order[0][0][0]).sum();
    Ok(Comparison {
        name: format!("three bounces, exit node, {model}"),
        ours_s,
        rival: format!("sbr, {density} rays per wavelength"),
        rival_s,
        error: Some(difference(ours.amplitude_m[0], sum)),
        work: format!("{} triangles, one aspect, one frequency, {} rays", mesh.triangles.len(), rival.rays),
    })
}

fn difference(ours: Complex64, rival: Complex64) -> f64 {
    (ours - rival).norm() / rival.norm()
}

/// One chirp of all channels of the paper's first experiment over points spread in front of the radar.
fn echo(count: usize) -> Result<Comparison, Failure> {
    let radar = radar();
    let paths: Vec<_> = (0..count).map(point).collect();
    let centre_hz = radar.waveform.centre_frequency_hz();
    let sum = fmcw_echo::direct_sum::DirectSum::new(&radar, centre_hz, &paths);
    let (ours, ours_s) = timed(|| Ok(sum.row(0, 0)))?;
    let samples = radar.waveform.samples as usize;
    let slow = |n| fmcw_echo::reference::cube_sample(&radar, centre_hz, &paths, [0, 0, n], None);
    let (rival, rival_s) = timed(|| Ok((0..samples).map(slow).collect::<Vec<Complex64>>()))?;
    let norm = |v: &mut dyn Iterator<Item = Complex64>| v.map(|z| z.norm_sqr()).sum::<f64>().sqrt();
    let error = norm(&mut ours.iter().zip(&rival).map(|(a, b)| a - b)) / norm(&mut rival.iter().copied());
    Ok(Comparison {
        name: "echo, quadratic recurrence".into(),
        ours_s,
        rival: "the same sum from the formulas".into(),
        rival_s,
        error: Some(error),
        work: format!("{count} paths, one chirp of {samples} samples, one channel, one thread"),
    })
}

fn radar() -> Radar {
    use artifact::radar::{Array, Hardware, Link, Multiplexing, Pattern, Schedule};
    let position_m = [0.0, 0.0, 6.0];
    Radar {
        position_m,
        boresight_az_rad: 0.0,
        boresight_el_rad: 0.0,
        schedule: Schedule::default(),
        hardware: Hardware::default(),
        waveform: Waveform {
            start_frequency_hz: 77e9,
            slope_hz_per_s: 12.5e12,
            sample_rate_hz: 5.12e6,
            sampling: artifact::radar::Sampling::Complex,
            samples: 256,
            chirp_interval_s: 60e-6,
            chirps: 128,
        },
        array: Array {
            tx_m: vec![position_m],
            rx_m: vec![position_m],
            tx_half_wavelengths: vec![[0.0; 2]],
            rx_half_wavelengths: vec![[0.0; 2]],
            multiplexing: Multiplexing::Simultaneous,
            polarization: Polarization::Vv,
            pattern: Pattern::Isotropic,
        },
        link: Link { transmit_power_w: 0.016, antenna_gain_db: 10.0 },
    }
}

fn point(number: usize) -> artifact::paths::Path {
    let spread = |step: f64| (number as f64 * step).fract();
    let place = [10.0 * spread(0.618_034), 25.0 + 30.0 * spread(0.414_214), 2.0 * spread(0.732_051)];
    let mut amplitude_m = Amplitude::default();
    amplitude_m[0][0] = Complex64::from_polar(0.1, 6.0 * spread(0.236_068));
    artifact::paths::Path {
        target: 0,
        order: 0,
        apparent_tx_m: place,
        apparent_tx_mps: [0.0, -10.0, 0.0],
        apparent_rx_m: place,
        apparent_rx_mps: [0.0, -10.0, 0.0],
        amplitude_m,
        slope_m_per_hz: Amplitude::default(),
        facets: Default::default(),
        curve: artifact::paths::Curve::default(),
    }
}
