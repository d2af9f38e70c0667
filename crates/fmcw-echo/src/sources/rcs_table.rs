//! The paper's table method: each target responds from its body's origin with σ_f, looked up by aspect once
//! per chirp and swept by the chirp's frequencies (eqs. 9–13; physics.md §6 explains which of these are
//! physical).
//!
//! For a linear chirp the response at f₀ + μ(t − τ) multiplies the IF sample at t, as in eq. (13) with σ_t.
//! With the delay of the origin, τ = (R_t + R_r)/c, the factor is conj S/(R_tR_r); the link amplitude
//! contains no σ, so that σ is not applied twice, as eqs. (7) and (9) together would. The table is far-field
//! (physics.md §0): for a vehicle at 30 m its error is as large as the field. That is an error of the model,
//! not of this module.

use crate::error::EchoError;
use crate::impairments::oscillator::Oscillator;
use crate::links::multiplexing::{Transmission, row};
use crate::sums::reference::legs_at;
use artifact::Radar;
use artifact::paths::{Curve, Path};
use artifact::rcs::{RcsFrame, RcsTable};
use artifact::scene::Pose;
use glam::{DQuat, DVec3};
use num_complex::Complex64;
use radar::beat::if_cycles;
use radar::link::link_amplitude;
use radar::motion::total_acceleration_mps2;
use radar::standpoint::nearest_turn;
use std::f64::consts::TAU;

/// Targets of one frame, each a table with a moving origin.
pub struct TableSum<'a> {
    radar: &'a Radar,
    bodies: Vec<Body<'a>>,
    oscillator: Option<&'a Oscillator>,
}

impl<'a> TableSum<'a> {
    /// Sum over a frame's tables; `poses` are those at the frame's first sample, indexed by the tables'
    /// `target`; `None` is an ideal oscillator.
    pub fn new(
        radar: &'a Radar,
        poses: &[Pose],
        frame: &'a RcsFrame,
        oscillator: Option<&'a Oscillator>,
    ) -> Result<Self, EchoError> {
        let body = |(index, table): (usize, &'a RcsTable)| Body::new(radar, poses, index, table);
        let bodies = frame.tables.iter().enumerate().map(body).collect::<Result<_, _>>()?;
        Ok(Self { radar, bodies, oscillator })
    }

    /// Samples of one row of the cube, √W, noise-free.
    pub fn row(&self, channel: usize, chirp: usize) -> Result<Vec<Complex64>, EchoError> {
        let mut samples = vec![Complex64::ZERO; self.radar.waveform.samples as usize];
        for transmission in row(self.radar, channel, chirp) {
            for body in &self.bodies {
                body.add_to(self, &transmission, &mut samples)?;
            }
        }
        Ok(samples)
    }
}

/// Every second value of each axis of three or more, keeping the last one.
///
/// Linear interpolation errs with the square of the step: a third of the difference between an echo from the
/// thinned and from the full table estimates the error of the latter.
pub(crate) fn decimate(frame: &RcsFrame) -> RcsFrame {
    RcsFrame { tables: frame.tables.iter().map(decimate_table).collect(), ..frame.clone() }
}

fn decimate_table(table: &RcsTable) -> RcsTable {
    let kept = |axis: &[f64]| -> Vec<usize> {
        let last = axis.len().saturating_sub(1);
        (0..axis.len()).filter(|&i| axis.len() < 3 || i % 2 == 0 || i == last).collect()
    };
    let (f, el, az) = (kept(&table.frequency_hz), kept(&table.elevation_rad), kept(&table.azimuth_rad));
    let pick = |axis: &[f64], kept: &[usize]| kept.iter().map(|&i| axis[i]).collect::<Vec<f64>>();
    let (rows, columns) = (table.elevation_rad.len(), table.azimuth_rad.len());
    let mut amplitude_m = Vec::with_capacity(f.len() * el.len() * az.len());
    for &i in &f {
        for &j in &el {
            amplitude_m.extend(az.iter().map(|&k| table.amplitude_m[(i * rows + j) * columns + k]));
        }
    }
    RcsTable {
        frequency_hz: pick(&table.frequency_hz, &f),
        elevation_rad: pick(&table.elevation_rad, &el),
        azimuth_rad: pick(&table.azimuth_rad, &az),
        amplitude_m,
        ..table.clone()
    }
}

/// A target and its response.
struct Body<'a> {
    index: usize,
    table: &'a RcsTable,
    /// The body's origin as a path, with the origin as both apparent points.
    origin: Path,
    /// Yaw of the body at the frame's first sample, and its rate.
    yaw_rad: [f64; 2],
}

impl<'a> Body<'a> {
    fn new(radar: &Radar, poses: &[Pose], index: usize, table: &'a RcsTable) -> Result<Self, EchoError> {
        check(radar, index, table)?;
        let missing = EchoError::TargetMissing { table: index, target: table.target, targets: poses.len() };
        let pose = poses.get(table.target as usize).ok_or(missing)?;
        Ok(Self { index, table, origin: origin_path(pose), yaw_rad: [pose.yaw_rad, pose.yaw_radps] })
    }

    /// Adds the body's echo for one transmission.
    fn add_to(
        &self,
        sum: &TableSum<'_>,
        transmission: &Transmission,
        samples: &mut [Complex64],
    ) -> Result<(), EchoError> {
        let radar = sum.radar;
        let waveform = &radar.waveform;
        let half_chirp_s = 0.5 * (samples.len() - 1) as f64 / waveform.sample_rate_hz;
        let response = self.response(radar, transmission.start_s + half_chirp_s)?;
        for (n, sample) in samples.iter_mut().enumerate() {
            let t = n as f64 / waveform.sample_rate_hz;
            let time_s = transmission.start_s + t;
            let legs = legs_at(&self.origin, transmission, time_s);
            let tau = legs.delay_s() + transmission.line_delay_s;
            let frequency_hz = waveform.start_frequency_hz + waveform.slope_hz_per_s * (t - tau);
            let gain = link_amplitude(radar) * legs.gain(radar);
            let phasor = Complex64::cis(TAU * if_cycles(&radar.waveform, t, tau).fract());
            let turn = sum.oscillator.map_or(Complex64::ONE, |oscillator| oscillator.rotation(time_s, tau));
            *sample +=
                transmission.turn * turn * gain * self.at_frequency(&response, frequency_hz)?.conj() * phasor;
        }
        Ok(())
    }

    /// Scattering amplitude σ_f for one chirp: S over the table's frequencies at the aspect of the radar seen
    /// from the origin.
    fn response(&self, radar: &Radar, time_s: f64) -> Result<Vec<Complex64>, EchoError> {
        let table = self.table;
        let (elevation_rad, azimuth_rad) = self.aspect(radar, time_s);
        let el = self.bracket("elevation_rad", &table.elevation_rad, elevation_rad)?;
        let azimuth_rad = turn_nearest_to(&table.azimuth_rad, azimuth_rad);
        let az = self.bracket("azimuth_rad", &table.azimuth_rad, azimuth_rad)?;
        let columns = table.azimuth_rad.len();
        let along_az = |row: &[Complex64]| az.mix(row[az.below], row[az.above]);
        let plane = |plane: &[Complex64]| {
            let row = |i: usize| along_az(&plane[i * columns..(i + 1) * columns]);
            el.mix(row(el.below), row(el.above))
        };
        Ok(table.amplitude_m.chunks(table.elevation_rad.len() * columns).map(plane).collect())
    }

    /// Elevation and azimuth of the radar in body axes.
    fn aspect(&self, radar: &Radar, time_s: f64) -> (f64, f64) {
        let Path { apparent_tx_m, apparent_tx_mps, curve, .. } = &self.origin;
        let [at_m, mps, mps2] =
            [*apparent_tx_m, *apparent_tx_mps, curve.apparent_tx_mps2].map(DVec3::from_array);
        let origin_m = at_m + time_s * (mps + 0.5 * time_s * mps2);
        let body_from_world = DQuat::from_rotation_z(-self.yaw_rad[0] - time_s * self.yaw_rad[1]);
        let to_radar = body_from_world * (DVec3::from_array(radar.position_m) - origin_m);
        (to_radar.z.atan2(to_radar.truncate().length()), to_radar.y.atan2(to_radar.x))
    }

    fn at_frequency(&self, response: &[Complex64], frequency_hz: f64) -> Result<Complex64, EchoError> {
        let f = self.bracket("frequency_hz", &self.table.frequency_hz, frequency_hz)?;
        Ok(f.mix(response[f.below], response[f.above]))
    }

    /// Neighbours of `value` on an increasing axis. Up to one step beyond an end the last two values are
    /// extrapolated: a chirp starts μτ (3 MHz at 40 m) below f₀. An axis of one value holds for every value.
    fn bracket(&self, axis: &'static str, values: &[f64], value: f64) -> Result<AxisInterval, EchoError> {
        let last = values.len() - 1;
        if last == 0 {
            return Ok(AxisInterval { below: 0, above: 0, share: 0.0 });
        }
        let below = values.partition_point(|&v| v <= value).clamp(1, last) - 1;
        let share = (value - values[below]) / (values[below + 1] - values[below]);
        if (-1.0..=2.0).contains(&share) {
            return Ok(AxisInterval { below, above: below + 1, share });
        }
        Err(EchoError::OutsideTable { table: self.index, axis, value, first: values[0], last: values[last] })
    }
}

/// Two neighbours on an axis and the weight of the upper one.
struct AxisInterval {
    below: usize,
    above: usize,
    share: f64,
}

impl AxisInterval {
    fn mix(&self, below: Complex64, above: Complex64) -> Complex64 {
        below + (above - below) * self.share
    }
}

/// Equivalent of `angle` within half a turn of the middle of the axis.
fn turn_nearest_to(axis: &[f64], angle: f64) -> f64 {
    let middle = 0.5 * (axis[0] + axis[axis.len() - 1]);
    nearest_turn(angle, middle)
}

fn origin_path(pose: &Pose) -> Path {
    let acceleration_mps2 = total_acceleration_mps2(pose);
    let curve = Curve {
        apparent_tx_mps2: acceleration_mps2,
        apparent_rx_mps2: acceleration_mps2,
        ..Curve::default()
    };
    Path { curve, ..Path::of_point(pose.position_m, pose.velocity_mps, [[Complex64::ONE; 2]; 2]) }
}

/// Paths that represent the tables' origins, for the validity checks of paths.
pub(crate) fn origins(poses: &[Pose], frame: &RcsFrame) -> Vec<Path> {
    frame.tables.iter().filter_map(|t| poses.get(t.target as usize)).map(origin_path).collect()
}

fn check(radar: &Radar, index: usize, table: &RcsTable) -> Result<(), EchoError> {
    let wanted = radar.array.polarization;
    if table.polarization != wanted {
        return Err(EchoError::TablePolarization { table: index, found: table.polarization, wanted });
    }
    let axes = [
        ("frequency_hz", &table.frequency_hz),
        ("elevation_rad", &table.elevation_rad),
        ("azimuth_rad", &table.azimuth_rad),
    ];
    for (axis, values) in axes {
        let grows = values.windows(2).all(|pair| pair[0] < pair[1]);
        if values.is_empty() || !grows || !values.iter().all(|v| v.is_finite()) {
            return Err(EchoError::TableShape { table: index, axis });
        }
    }
    let count: usize = axes.iter().map(|(_, values)| values.len()).product();
    let good = table.amplitude_m.len() == count && table.amplitude_m.iter().all(|s| s.is_finite());
    if good { Ok(()) } else { Err(EchoError::TableShape { table: index, axis: "amplitude" }) }
}
