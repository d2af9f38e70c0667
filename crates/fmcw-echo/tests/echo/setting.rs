//! Radars and paths that the tests and the benchmark share.
#![allow(
    dead_code,
    unreachable_pub,
    reason = "each test file takes the part that it needs as a module of its own"
)]

use artifact::Accuracy;
use artifact::cube::{CubeFrame, CubeHeader, SampleUnit};
use artifact::paths::{Path, PathsFrame};
use artifact::radar::{Multiplexing, Radar, Waveform};
use artifact::settings::Noise;
use artifact::units::power_from_db;
use fmcw_echo::{EchoError, Synthesizer};
use num_complex::{Complex32, Complex64};
use radar::aperture::Preset;
use radar::paper;
use rand::rand_core::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Table 2 of the paper: samples of experiments 1, 2, 3 at 5.12 MHz (the printed 386 are 384).
pub const EXPERIMENT_SAMPLES: [u32; 3] = [256, 384, 512];

/// Waveform of Table 2's experiment 1, 2 or 3.
pub fn experiment(number: usize) -> Waveform {
    paper::waveform(EXPERIMENT_SAMPLES[number - 1], 128)
}

/// Element positions of an array in half wavelengths [right, up].
pub struct Layout {
    pub name: &'static str,
    pub tx: Vec<[f64; 2]>,
    pub rx: Vec<[f64; 2]>,
}

/// The presets of physics.md §7.
pub fn presets() -> Vec<Layout> {
    let of = |(name, preset): (&'static str, Preset)| {
        let [tx, rx] = preset.elements();
        Layout { name, tx, rx }
    };
    Preset::ALL.map(of).into()
}

/// A radar 6 m above the road that looks along +y, each row of elements centred on it.
pub fn radar(waveform: Waveform, layout: &Layout, multiplexing: Multiplexing) -> Radar {
    let elements = [layout.tx.clone(), layout.rx.clone()];
    let mut radar = paper::radar([0.0, 0.0, 6.0], waveform, elements);
    radar.array.multiplexing = multiplexing;
    radar
}

/// One transmitter, one receiver, both at (0, 0, 6) m.
pub fn single_channel(waveform: Waveform) -> Radar {
    radar(waveform, &presets()[0], Multiplexing::Simultaneous)
}

/// A cube of this radar.
pub fn header(radar: Radar, noise: Noise) -> CubeHeader {
    CubeHeader { radar, noise, dsp: paper::processing(), unit: SampleUnit::RootWatts }
}

/// A point target, a = +√σ in vv and hh alike.
pub fn point(position_m: [f64; 3], velocity_mps: [f64; 3], rcs_m2: f64) -> Path {
    let a = Complex64::from(rcs_m2.sqrt());
    Path::of_point(position_m, velocity_mps, [[a, Complex64::ZERO], [Complex64::ZERO, a]])
}

/// Paths of a frame.
pub fn frame(paths: Vec<Path>) -> PathsFrame {
    PathsFrame { paths, ..PathsFrame::default() }
}

/// Paths as a tracer makes them, and worse: bounces apart by metres, both apparent points moving differently,
/// every polarization of its own phase, amplitudes that turn by up to 3 rad over 1 GHz; 12 to 60 m away, up
/// to 20 m/s.
pub fn random_paths(seed: u64, count: usize) -> Vec<Path> {
    let mut random = Random(ChaCha8Rng::seed_from_u64(seed));
    (0..count).map(|_| random.path()).collect()
}

/// Paths of one rigid vehicle of 4.5 × 1.8 × 1.4 m about a place: one bounce or two a way of metres apart,
/// amplitudes that turn over the band by what 3 cm of length make.
pub fn body(seed: u64, count: usize, middle_m: [f64; 3], velocity_mps: [f64; 3]) -> Vec<Path> {
    let mut random = Random(ChaCha8Rng::seed_from_u64(seed));
    let half_m = [0.9, 2.25, 0.7];
    (0..count)
        .map(|i| {
            let mut node =
                || [0, 1, 2].map(|axis| middle_m[axis] + random.between(-half_m[axis], half_m[axis]));
            let apparent_tx_m = node();
            let apparent_rx_m = if i % 3 == 0 { node() } else { apparent_tx_m };
            Path {
                order: 1,
                apparent_tx_m,
                apparent_tx_mps: velocity_mps,
                apparent_rx_m,
                apparent_rx_mps: velocity_mps,
                amplitude_m: random.amplitude(1.0),
                slope_m_per_hz: random.amplitude(2e-10),
                ..Path::default()
            }
        })
        .collect()
}

struct Random(ChaCha8Rng);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 * 0.5_f64.powi(53)
    }

    fn vector(&mut self, low: [f64; 3], high: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| self.between(low[i], high[i]))
    }

    fn amplitude(&mut self, scale: f64) -> [[Complex64; 2]; 2] {
        [[(); 2]; 2].map(|row| {
            row.map(|()| {
                Complex64::from_polar(
                    self.between(0.1, 1.0) * scale,
                    self.between(0.0, std::f64::consts::TAU),
                )
            })
        })
    }

    fn path(&mut self) -> Path {
        let apparent_tx_m = self.vector([-8.0, 12.0, -3.0], [12.0, 60.0, 4.0]);
        let apparent_tx_mps = self.vector([-5.0, -20.0, -1.0], [5.0, 20.0, 1.0]);
        let (offset_m, offset_mps) = (self.vector([-2.0; 3], [2.0; 3]), self.vector([-1.0; 3], [1.0; 3]));
        Path {
            order: 2,
            apparent_tx_m,
            apparent_tx_mps,
            apparent_rx_m: [0, 1, 2].map(|i| apparent_tx_m[i] + offset_m[i]),
            apparent_rx_mps: [0, 1, 2].map(|i| apparent_tx_mps[i] + offset_mps[i]),
            amplitude_m: self.amplitude(1.0),
            slope_m_per_hz: self.amplitude(3e-9),
            ..Path::default()
        }
    }
}

/// ‖got − exact‖/‖exact‖ in dB.
pub fn error_db(got: &[Complex64], exact: &[Complex64]) -> f64 {
    assert_eq!(got.len(), exact.len());
    let error: f64 = got.iter().zip(exact).map(|(g, e)| (g - e).norm_sqr()).sum();
    10.0 * (error / exact.iter().map(|e| e.norm_sqr()).sum::<f64>()).log10()
}

/// Samples in f64.
pub fn widened(samples: &[Complex32]) -> Vec<Complex64> {
    samples.iter().map(|x| Complex64::new(x.re.into(), x.im.into())).collect()
}

/// Level of a linear power ratio.
pub fn linear(db: f64) -> f64 {
    power_from_db(db)
}

/// The cube of one frame by a synthesizer of its own, to the accuracy of [`asked`].
pub fn synthesized(header: &CubeHeader, seed: u64, frame: &PathsFrame) -> Result<CubeFrame, EchoError> {
    Synthesizer::new(header, seed, asked(), vec![])?.frame(frame, &|_| ())
}

/// Accuracy of the sum over paths, where a test has no reason to ask for another.
pub fn asked() -> Accuracy {
    Accuracy::from_db(-60.0)
}
