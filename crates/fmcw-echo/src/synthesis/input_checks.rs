//! Checks before the first sample is computed: every number finite, every length valid, the cube bounded.

use crate::error::EchoError;
use crate::sums::closest_approach::MovingLeg;
use artifact::cube::{Cube, CubeHeader};
use artifact::paths::{ArraySide, ArraySpan, Path, Rim, Span};
use artifact::radar::{OSCILLATOR_SAMPLES_LIMIT, Pattern, PhaseNoise};
use artifact::{Radar, Schema};
use glam::DVec3;
use num_complex::Complex32;

/// Maximum speed, a hundred-thousandth of c and three times a bullet's: beyond it the scattering time would
/// need more care.
pub(crate) const SPEED_LIMIT_MPS: f64 = 3e3;

/// Refuses radars that yield no samples, and cubes that one record of a file could not hold.
pub(crate) fn check_header(header: &CubeHeader) -> Result<(), EchoError> {
    check_waveform(&header.radar)?;
    check_array(&header.radar)?;
    check_phase_noise(&header.radar)?;
    check_interferers(&header.radar)?;
    check_size(header)
}

/// Refuses frames with a path that has no finite echo.
pub(crate) fn check_paths(radar: &Radar, frame: u32, paths: &[Path]) -> Result<(), EchoError> {
    for (index, path) in paths.iter().enumerate() {
        let at = PathLocation { frame, path: index };
        at.check_finite(path)?;
        at.check_span(path)?;
        at.check_speed(radar, path)?;
        at.check_distance(radar, path)?;
    }
    Ok(())
}

/// Refuses a cube with a sample beyond f32.
pub(crate) fn check_samples(header: &CubeHeader, frame: u32, samples: &[Complex32]) -> Result<(), EchoError> {
    let [_, chirps, length] = header.shape();
    match samples.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(i) => Err(EchoError::SampleOverflow {
            frame,
            channel: i / length / chirps,
            chirp: i / length % chirps,
            sample: i % length,
        }),
    }
}

fn check_waveform(radar: &Radar) -> Result<(), EchoError> {
    let waveform = &radar.waveform;
    let positive = [
        ("start_frequency_hz", waveform.start_frequency_hz),
        ("sample_rate_hz", waveform.sample_rate_hz),
        ("chirp_interval_s", waveform.chirp_interval_s),
        ("samples", f64::from(waveform.samples)),
        ("chirps", f64::from(waveform.chirps)),
        ("centre frequency", waveform.centre_frequency_hz()),
    ];
    for (quantity, value) in positive {
        if !(value.is_finite() && value > 0.0) {
            return Err(EchoError::Waveform { quantity, value });
        }
    }
    // A ten-millionth allows for rounding of a chirp without idle time.
    let sampled_s = f64::from(waveform.samples) / waveform.sample_rate_hz;
    let more = [
        ("slope_hz_per_s", waveform.slope_hz_per_s, waveform.slope_hz_per_s.is_finite()),
        (
            "chirp_interval_s",
            waveform.chirp_interval_s,
            waveform.chirp_interval_s >= sampled_s * (1.0 - 1e-7),
        ),
    ];
    match more.iter().find(|(_, _, good)| !good) {
        None => check_schedule(radar),
        Some(&(quantity, value, _)) => Err(EchoError::Waveform { quantity, value }),
    }
}

/// Refuses chirps that start before the preceding one has ended.
fn check_schedule(radar: &Radar) -> Result<(), EchoError> {
    let (waveform, stagger_s) = (&radar.waveform, &radar.schedule.stagger_s);
    let sampled_s = f64::from(waveform.samples) / waveform.sample_rate_hz;
    for (slot, later_s) in stagger_s.iter().enumerate() {
        let next_s = waveform.chirp_interval_s + stagger_s[(slot + 1) % stagger_s.len()];
        // The comparison is false for NaN.
        let follows = next_s - later_s >= sampled_s * (1.0 - 1e-7);
        if !follows || (slot == 0 && *later_s != 0.0) {
            return Err(EchoError::Stagger { chirp: slot, later_s: *later_s });
        }
    }
    Ok(())
}

fn check_array(radar: &Radar) -> Result<(), EchoError> {
    let (tx, rx) = (&radar.array.tx_m, &radar.array.rx_m);
    if tx.is_empty() || rx.is_empty() {
        return Err(EchoError::NoElements { transmitters: tx.len(), receivers: rx.len() });
    }
    if !is_usable(&radar.array.pattern) {
        return Err(EchoError::Pattern);
    }
    let (link, hardware) = (&radar.link, &radar.hardware);
    let errors = || hardware.tx.iter().chain(&hardware.rx);
    let finite = [
        ("an element position", tx.iter().chain(rx).flatten().all(|x| x.is_finite())),
        ("the boresight", (radar.boresight_az_rad + radar.boresight_el_rad).is_finite()),
        ("the transmit power", link.transmit_power_w.is_finite() && link.transmit_power_w >= 0.0),
        ("the antenna gain", link.antenna_gain_db.is_finite()),
        ("an element's error", errors().all(|e| (e.gain_db + e.phase_rad + e.delay_s).is_finite())),
        (
            "the converter's full scale",
            hardware.adc.is_none_or(|adc| adc.full_scale.is_finite() && adc.full_scale > 0.0),
        ),
        ("the converter's number of bits", hardware.adc.is_none_or(|adc| (1..=24).contains(&adc.bits))),
    ];
    match finite.iter().find(|(_, good)| !good) {
        None => Ok(()),
        Some((quantity, _)) => Err(EchoError::NonFiniteRadar { quantity }),
    }
}

fn is_usable(pattern: &Pattern) -> bool {
    match pattern {
        Pattern::Isotropic => true,
        Pattern::Cosine { exponent } => exponent.is_finite() && *exponent >= 0.0,
        Pattern::Table(table) => {
            let axes = [&table.azimuth_rad, &table.elevation_rad];
            let grows = |axis: &[f64]| axis.windows(2).all(|pair| pair[0] < pair[1]);
            let numbers = axes.into_iter().chain([&table.amplitude]).flatten();
            axes.iter().all(|axis| (axis.len() == 1 || axis.len() >= 3) && grows(axis))
                && table.amplitude.len() == axes[0].len() * axes[1].len()
                && numbers.copied().all(f64::is_finite)
        }
    }
}

/// Refuses interferers whose chirps overlap, or that are within a metre of this radar.
fn check_interferers(radar: &Radar) -> Result<(), EchoError> {
    for (index, other) in radar.hardware.interferers.iter().enumerate() {
        let numbers =
            [other.eirp_w, other.start_frequency_hz, other.slope_hz_per_s, other.sweep_s, other.offset_s];
        let all = numbers
            .iter()
            .chain(&other.position_m)
            .chain(&other.velocity_mps)
            .chain([&other.chirp_interval_s]);
        let away_m = DVec3::from_array(other.position_m).distance(DVec3::from_array(radar.position_m));
        let rules = [
            ("a number is not finite", all.copied().all(f64::is_finite)),
            ("its power is negative", other.eirp_w >= 0.0),
            ("its chirps have no length", other.sweep_s > 0.0),
            ("its chirps begin before the one before has ended", other.chirp_interval_s >= other.sweep_s),
            ("it is nearer than a metre", away_m >= 1.0),
        ];
        if let Some((quantity, _)) = rules.iter().find(|(_, kept)| !kept) {
            return Err(EchoError::Interferer { index, quantity });
        }
    }
    Ok(())
}

/// Refuses phase noise that is not a density over increasing offsets, and frames whose oscillator would not
/// fit into memory.
fn check_phase_noise(radar: &Radar) -> Result<(), EchoError> {
    let told = &radar.hardware.phase_noise;
    let is_density =
        |point: &PhaseNoise| point.offset_hz > 0.0 && (point.offset_hz + point.dbc_per_hz).is_finite();
    if !told.iter().all(is_density) || !told.windows(2).all(|pair| pair[0].offset_hz < pair[1].offset_hz) {
        return Err(EchoError::PhaseNoise);
    }
    let needed = radar.frame_duration_s() * radar.waveform.sample_rate_hz;
    if !told.is_empty() && needed > OSCILLATOR_SAMPLES_LIMIT as f64 {
        return Err(EchoError::OscillatorTooLong { samples: needed, limit: OSCILLATOR_SAMPLES_LIMIT });
    }
    Ok(())
}

fn check_size(header: &CubeHeader) -> Result<(), EchoError> {
    let [channels, chirps, samples] = header.shape();
    let bytes = [channels, chirps, samples, size_of::<Complex32>()].iter().map(|&n| n as u128).product();
    // A record holds the samples and a few more numbers.
    let limit = Cube::RECORD_LIMIT - 4096;
    if bytes <= u128::from(limit) {
        Ok(())
    } else {
        Err(EchoError::CubeTooLarge { channels, chirps, samples, bytes, limit })
    }
}

/// Frame and path of a fault.
#[derive(Clone, Copy)]
struct PathLocation {
    frame: u32,
    path: usize,
}

impl PathLocation {
    fn check_finite(&self, path: &Path) -> Result<(), EchoError> {
        let points = [path.apparent_tx_m, path.apparent_rx_m];
        let velocities = [path.apparent_tx_mps, path.apparent_rx_mps];
        let amplitudes = [path.amplitude_m, path.slope_m_per_hz];
        let curve = &path.curve;
        let bends = [curve.apparent_tx_mps2, curve.apparent_rx_mps2];
        let is_wheel = |rim: Rim| {
            let finite = rim.forward.iter().all(|x| x.is_finite()) && rim.angle_rad.is_finite();
            finite && rim.radius_m.is_finite() && rim.radius_m > 0.0
        };
        let parts = [
            ("an acceleration", bends.iter().flatten().all(|x| x.is_finite())),
            ("the rim of a wheel", curve.rim.is_none_or(is_wheel)),
            ("an apparent point", points.iter().flatten().all(|x| x.is_finite())),
            ("a velocity", velocities.iter().flatten().all(|x| x.is_finite())),
            ("the amplitude or its slope", amplitudes.iter().flatten().flatten().all(|x| x.is_finite())),
        ];
        match parts.iter().find(|(_, finite)| !finite) {
            None => Ok(()),
            Some((quantity, _)) => {
                Err(EchoError::NonFinitePath { frame: self.frame, path: self.path, quantity })
            }
        }
    }

    /// Checks that a part of the frame is centred on one of several consecutive moments, and a part of the
    /// array on one of several places.
    fn check_span(&self, path: &Path) -> Result<(), EchoError> {
        let is_moment = |span: &Span| {
            let grows = span.first_s.is_finite() && span.step_s.is_finite() && span.step_s > 0.0;
            grows && span.moment < span.moments
        };
        let is_place = |span: &ArraySpan| {
            let mut cosines = span.transmit.iter().chain(&span.receive);
            let grows = span.first_m.is_finite() && span.step_m.is_finite() && span.step_m > 0.0;
            cosines.all(|cosine| cosine.abs() <= 1.0 + 1e-9) && grows && span.place < span.places
        };
        let (frame, path_index) = (self.frame, self.path);
        if let Some(span) = path.curve.span.filter(|span| !is_moment(span)) {
            let Span { first_s, step_s, moments, moment } = span;
            return Err(EchoError::NoSuchMoment {
                frame,
                path: path_index,
                moment,
                moments,
                first_s,
                step_s,
            });
        }
        if let Some(span) = path.curve.array_span.filter(|span| !is_place(span)) {
            return Err(EchoError::NoSuchPlace { frame, path: path_index, span });
        }
        let is_side = |side: &ArraySide| {
            let mut cosines = side.transmit.iter().chain(&side.receive);
            cosines.all(|cosine| cosine.abs() <= 1.0 + 1e-9) && side.from_m.is_finite()
        };
        match path.curve.array_side.filter(|side| !is_side(side)) {
            None => Ok(()),
            Some(side) => Err(EchoError::NoSuchSide { frame, path: path_index, side }),
        }
    }

    fn check_speed(&self, radar: &Radar, path: &Path) -> Result<(), EchoError> {
        let speed_mps =
            MovingLeg::of(radar, path).map(|leg| leg.speed_mps(radar)).into_iter().fold(0.0, f64::max);
        if speed_mps <= SPEED_LIMIT_MPS {
            return Ok(());
        }
        Err(EchoError::TooFast { frame: self.frame, path: self.path, speed_mps, limit_mps: SPEED_LIMIT_MPS })
    }

    fn check_distance(&self, radar: &Radar, path: &Path) -> Result<(), EchoError> {
        for leg in MovingLeg::of(radar, path) {
            let (index, distance_m) = leg.nearest(radar);
            if distance_m < radar.waveform.wavelength_m() {
                let (Self { frame, path }, element) = (*self, leg.element);
                return Err(EchoError::PathThroughAntenna { frame, path, element, index, distance_m });
            }
        }
        Ok(())
    }
}
