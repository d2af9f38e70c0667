//! Radars and cubes for the tests: point targets' IF samples straight from the formula of `interface.md`.
#![allow(dead_code, reason = "every test file uses its own part")]
#![allow(unreachable_pub, clippy::panic, reason = "shared by test crates, which fail by panicking")]

use artifact::ErrorBudget;
use artifact::cube::{CubeFrame, CubeHeader, SampleUnit};
use artifact::dataset::{Crop, CropFormat};
use artifact::points::Object;
use artifact::radar::{Multiplexing, Radar};
use artifact::rdm::RdmFrame;
use artifact::seed::key;
use artifact::settings::{DspSettings, Lane, Lanes, Noise};
use artifact::units::{BOLTZMANN_J_PER_K, SPEED_OF_LIGHT_MPS, power_from_db};
use dsp::{DspError, Receiver};
use num_complex::{Complex32, Complex64};
use radar::aperture::{Elements, Preset, mounted};
use radar::paper;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::{PI, TAU};

/// The map of one frame by a receiver of its own.
pub fn mapped(header: &CubeHeader, frame: &CubeFrame) -> Result<RdmFrame, DspError> {
    Receiver::new(header)?.range_doppler(frame)
}

/// One crop by a receiver of its own.
pub fn cropped(
    header: &CubeHeader,
    map: &RdmFrame,
    object: &Object,
    format: &CropFormat,
) -> Result<Crop, DspError> {
    Receiver::new(header)?.cropper(map, format)?.crop(object)
}

/// A point target; position at the frame's first sample.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    pub position_m: [f64; 3],
    pub velocity_mps: [f64; 3],
    pub rcs_m2: f64,
}

pub fn target(position_m: [f64; 3], velocity_mps: [f64; 3], rcs_m2: f64) -> Target {
    Target { position_m, velocity_mps, rcs_m2 }
}

/// Arrays of `interface.md`, λ/2: transmit elements, receive elements.
pub fn elements_1x1() -> [Elements; 2] {
    Preset::OneByOne.elements()
}

pub fn elements_1x4() -> [Elements; 2] {
    Preset::OneByFour.elements()
}

pub fn elements_3x4() -> [Elements; 2] {
    Preset::ThreeByFour.elements()
}

pub fn elements_6x8() -> [Elements; 2] {
    Preset::SixByEight.elements()
}

pub fn elements_12x16() -> [Elements; 2] {
    Preset::TwelveBySixteen.elements()
}

/// Experiment 1, 2 or 3 of Table 2 with these elements, 6 m above the road.
pub fn header(samples: u32, chirps: u32, elements: [Elements; 2]) -> CubeHeader {
    let radar = paper::radar([0.0, 0.0, 6.0], paper::waveform(samples, chirps), elements);
    CubeHeader { radar, noise: Noise::Absent, dsp: settings(), unit: SampleUnit::RootWatts }
}

/// World positions of the elements, for the radar's boresight.
pub fn place_elements(radar: &mut Radar) {
    *radar = mounted(radar.clone());
}

/// The defaults of a scene's `[dsp]`.
pub fn settings() -> DspSettings {
    DspSettings {
        road: Lanes {
            lanes: [(1, 2.0), (2, 5.75), (3, 9.5)]
                .map(|(number, centre_m)| Lane { number, centre_m, width_m: 3.75 })
                .to_vec(),
            ..Lanes::default()
        },
        ..paper::processing()
    }
}

/// A cube of these targets, with the header's noise (variance k·T·F·f_s per complex sample) of this seed.
pub fn cube(header: &CubeHeader, targets: &[Target], seed: u64) -> CubeFrame {
    let [channels, chirps, samples] = header.shape();
    let mut values = vec![Complex64::ZERO; channels * chirps * samples];
    for target in targets {
        for channel in 0..channels {
            add_channel(
                header,
                target,
                channel,
                &mut values[channel * chirps * samples..][..chirps * samples],
            );
        }
    }
    add_noise(header, &mut values, seed);
    let samples = values.iter().map(|v| Complex32::new(v.re as f32, v.im as f32)).collect();
    CubeFrame { index: 0, time_s: 0.0, samples, error: ErrorBudget::default() }
}

fn add_channel(header: &CubeHeader, target: &Target, channel: usize, out: &mut [Complex64]) {
    let radar = &header.radar;
    let receivers = radar.array.rx_m.len();
    let (first, rx) = (channel / receivers, channel % receivers);
    let own = Sent { tx: first, turn: first, sign: 1.0, cycles: 0.0 };
    let transmitters = radar.array.tx_m.len();
    match radar.array.multiplexing {
        Multiplexing::Simultaneous | Multiplexing::Tdm => add_pair(header, target, &own, rx, out),
        Multiplexing::Ddm => {
            for tx in 0..transmitters {
                let cycles = tx as f64 / (transmitters + 1) as f64;
                add_pair(header, target, &Sent { tx, cycles, ..own }, rx, out);
            }
        }
        Multiplexing::Bpm => {
            for tx in 0..transmitters {
                add_pair(header, target, &Sent { tx, sign: hadamard(tx, first), ..own }, rx, out);
            }
        }
    }
}

/// Sylvester's matrix of any size, built as it is defined: H₂ₙ = [H H; H −H].
fn hadamard(row: usize, column: usize) -> f64 {
    match (row, column) {
        (0, 0) => 1.0,
        _ => hadamard(row / 2, column / 2) * if row % 2 == 1 && column % 2 == 1 { -1.0 } else { 1.0 },
    }
}

/// Transmission of one transmitter in the rows of a channel.
#[derive(Clone, Copy)]
struct Sent {
    tx: usize,
    /// Index of the transmitter or slot whose starts the chirps have.
    turn: usize,
    sign: f64,
    /// Per chirp.
    cycles: f64,
}

/// A·exp j2π[f₀τ + μtτ − ½μτ²] of one transmitter and receiver, with its sign and turned by its cycles a
/// chirp.
///
/// The delay is taken as linear over a chirp's 50 µs (its curvature there moves the phase by 1e-9 rad), which
/// makes the phase a parabola in time: three values by the formula, the rest by steps.
fn add_pair(header: &CubeHeader, target: &Target, sent: &Sent, rx: usize, out: &mut [Complex64]) {
    let samples = header.radar.waveform.samples as usize;
    for (chirp, row) in out.chunks_exact_mut(samples).enumerate() {
        let start_s = header.radar.chirp_start_s(sent.turn, chirp);
        let at = |n: usize| cycles_at(header, target, [sent.tx, rx], start_s, n);
        let (amplitude, start) = at(0);
        let last = samples.max(3) - 1;
        let (half, whole) = (last / 2, last);
        let [a, b] = [at(half).1 - start, at(whole).1 - start];
        let (h, w) = (half as f64, whole as f64);
        let bend = (b / w - a / h) / (w - h);
        let slope = a / h - bend * h;
        let mut value =
            Complex64::from_polar(amplitude, TAU * (start + sent.cycles * chirp as f64).fract()) * sent.sign;
        let mut step = Complex64::from_polar(1.0, TAU * (slope + bend).fract());
        let step_of_step = Complex64::from_polar(1.0, TAU * 2.0 * bend);
        for out in row {
            *out += value;
            value *= step;
            step *= step_of_step;
        }
    }
}

/// Amplitude and phase in cycles of one sample, by the formula alone.
pub fn sample_cycles(
    header: &CubeHeader,
    target: &Target,
    [tx, rx]: [usize; 2],
    [chirp, n]: [usize; 2],
) -> (f64, f64) {
    cycles_at(header, target, [tx, rx], header.radar.chirp_start_s(tx, chirp), n)
}

fn cycles_at(
    header: &CubeHeader,
    target: &Target,
    [tx, rx]: [usize; 2],
    start_s: f64,
    n: usize,
) -> (f64, f64) {
    let w = &header.radar.waveform;
    let (p_t, p_r) = (header.radar.array.tx_m[tx], header.radar.array.rx_m[rx]);
    let t = n as f64 / w.sample_rate_hz;
    let [d_t, d_r] = legs(target, p_t, p_r, start_s + t);
    let tau = (d_t + d_r) / SPEED_OF_LIGHT_MPS;
    let cycles = w.start_frequency_hz * tau + w.slope_hz_per_s * (t * tau - 0.5 * tau * tau);
    (amplitude(header, target, d_t, d_r), cycles)
}

/// Lengths of both legs, the target where it was when it scattered.
fn legs(target: &Target, p_t: [f64; 3], p_r: [f64; 3], time_s: f64) -> [f64; 2] {
    let at = |t: f64| [0, 1, 2].map(|i: usize| target.position_m[i] + t * target.velocity_mps[i]);
    let length = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    let mut scattered_s = time_s;
    for _ in 0..3 {
        scattered_s = time_s - length(at(scattered_s), p_r) / SPEED_OF_LIGHT_MPS;
    }
    [length(at(scattered_s), p_t), length(at(scattered_s), p_r)]
}

fn amplitude(header: &CubeHeader, target: &Target, d_t: f64, d_r: f64) -> f64 {
    let gain = power_from_db(header.radar.link.antenna_gain_db);
    let power = header.radar.link.transmit_power_w * gain * gain * target.rcs_m2;
    (power * header.radar.waveform.wavelength_m().powi(2) / ((4.0 * PI).powi(3) * (d_t * d_r).powi(2))).sqrt()
}

/// Noise power of a sample, k·T·F·f_s.
pub fn noise_variance(header: &CubeHeader) -> f64 {
    match header.noise {
        Noise::Absent => 0.0,
        Noise::Figure { noise_figure_db, temperature_k } => {
            BOLTZMANN_J_PER_K
                * temperature_k
                * power_from_db(noise_figure_db)
                * header.radar.waveform.sample_rate_hz
        }
        Noise::SnrDb(_) => panic!("tests give a noise figure"),
    }
}

fn add_noise(header: &CubeHeader, values: &mut [Complex64], seed: u64) {
    let deviation = (0.5 * noise_variance(header)).sqrt();
    if deviation == 0.0 {
        return;
    }
    let mut random = ChaCha8Rng::from_seed(key(seed, "dsp/test-noise", &[]));
    for value in values {
        let (re, im): (f64, f64) = (StandardNormal.sample(&mut random), StandardNormal.sample(&mut random));
        *value += deviation * Complex64::new(re, im);
    }
}

pub const NOISE_12_DB: Noise = Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 };

/// Truth of a target in the middle of the frame: (range, radial velocity, position).
pub fn truth(header: &CubeHeader, target: &Target) -> (f64, f64, [f64; 3]) {
    let middle_s = header.radar.frame_middle_s();
    let position_m = [0, 1, 2].map(|i: usize| target.position_m[i] + middle_s * target.velocity_mps[i]);
    let from_radar = [0, 1, 2].map(|i: usize| position_m[i] - header.radar.position_m[i]);
    let range_m = from_radar.iter().map(|x| x * x).sum::<f64>().sqrt();
    let radial_mps = from_radar.iter().zip(target.velocity_mps).map(|(x, v)| x * v).sum::<f64>() / range_m;
    (range_m, radial_mps, position_m)
}

/// `count` points with random strengths over the outline of a vehicle: a box `length` × `width` × `height`
/// whose centre stands at `(x, y)` on the road, moving along it.
pub fn vehicle(
    [x, y]: [f64; 2],
    [length, width, height]: [f64; 3],
    velocity_mps: f64,
    seed: u64,
) -> Vec<Target> {
    let mut random = ChaCha8Rng::from_seed(key(seed, "dsp/test-vehicle", &[]));
    let mut uniform = || (random.next_u32() as f64 + 0.5) / 2f64.powi(32);
    let count = (12.0 * length) as usize;
    (0..count)
        .map(|_| {
            // The radar sees the near end and the side that faces it; strengths spread as exponentials do.
            let on_end = uniform() < width / (width + length);
            let along = if on_end { -0.5 } else { uniform() - 0.5 } * length;
            let across = if on_end { uniform() - 0.5 } else { -0.5 * x.signum() } * width;
            let rcs_m2 = -10.0 / count as f64 * uniform().ln();
            target([x + across, y + along, height * uniform()], [0.0, velocity_mps, 0.0], rcs_m2)
        })
        .collect()
}
