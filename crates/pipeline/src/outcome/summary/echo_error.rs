//! Error of a target's own echo, and its effect on the estimate.

use crate::chain::frame_result::FrameResult;
use crate::outcome::error_figures::db;
use artifact::Radar;
use artifact::points::Point;
use artifact::scene::SceneHeader;
use radar::doppler_ambiguity::folded;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Numerical error of a target's own echo, and the resulting standard errors of the estimate: to first order,
/// as if the echoes of the object's points had equal and independent relative errors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EchoError {
    /// Error of the echo, dB relative to it: the frame's total restricted to the target.
    pub echo_db: Option<f64>,
    /// Standard error of the range, m; `None` without an object.
    pub range_m: Option<f64>,
    /// Standard error of the radial velocity, m/s; `None` without an object.
    pub radial_velocity_mps: Option<f64>,
    /// Standard error of the place across the line of sight, m; `None` without an object, and for an array
    /// that measures no azimuth.
    pub across_m: Option<f64>,
}

impl EchoError {
    /// Error of a target, by its index in the header, whose object is `object`; `None` if it was not
    /// measured.
    pub(super) fn of(
        header: &SceneHeader,
        result: &FrameResult,
        (index, object): (usize, Option<usize>),
    ) -> Option<Self> {
        let fineness = result.scattering.paths()?.trace.fineness.as_ref()?;
        let amplitude = fineness.echo_error(&header.targets[index].id)?;
        let is_own = |point: &&Point| object.is_some() && point.object.map(|o| o as usize) == object;
        let points: Vec<&Point> = result.points.points.iter().filter(is_own).collect();
        let [range_m, radial_velocity_mps, across_m] = standard_errors(&header.radar, &points, amplitude);
        Some(Self { echo_db: db(Some(amplitude)), range_m, radial_velocity_mps, across_m })
    }
}

/// Standard errors of the power-weighted means of the points' ranges, velocities and places across, where
/// each echo has a relative amplitude error ε: its power error 2·Re ε moves the mean, and its peak errs by
/// the Cramér–Rao bound at a signal-to-noise ratio of 1/ε² over all values.
fn standard_errors(radar: &Radar, points: &[&Point], amplitude: f64) -> [Option<f64>; 3] {
    let snr_per_cell = amplitude.powi(-2) / radar.virtual_channels() as f64;
    let bound = dsp::cramer_rao(radar, snr_per_cell);
    let off_boresight_rad = |point: &Point| folded(point.azimuth_rad - radar.boresight_az_rad, TAU);
    let across_m = |point: &Point| bound.cosines[0] * point.range_m / off_boresight_rad(point).cos().abs();
    let middle_rad = mean(points, off_boresight_rad);
    [
        of_mean(points, amplitude, |point| (point.range_m, bound.range_m)),
        of_mean(points, amplitude, |point| (point.radial_velocity_mps, bound.velocity_mps)),
        of_mean(points, amplitude, |point| {
            (point.range_m * (off_boresight_rad(point) - middle_rad), across_m(point))
        }),
    ]
}

/// Standard error of the mean of a value, given with its own standard error for each point; `None` if it is
/// not finite or there are no points.
fn of_mean(points: &[&Point], amplitude: f64, value: impl Fn(&Point) -> (f64, f64)) -> Option<f64> {
    let middle = mean(points, |point| value(point).0);
    let power: f64 = points.iter().map(|point| weight(point)).sum();
    let variance = |point: &&Point| {
        let (at, alone) = value(point);
        (weight(point) / power).powi(2) * (2.0 * (amplitude * (at - middle)).powi(2) + alone.powi(2))
    };
    let error = points.iter().map(variance).sum::<f64>().sqrt();
    (error.is_finite() && !points.is_empty()).then_some(error)
}

fn mean(points: &[&Point], value: impl Fn(&Point) -> f64) -> f64 {
    let power: f64 = points.iter().map(|point| weight(point)).sum();
    points.iter().map(|point| weight(point) * value(point)).sum::<f64>() / power
}

/// Power of a point relative to the noise, which is common to all points.
fn weight(point: &Point) -> f64 {
    10.0_f64.powf(0.1 * point.snr_db)
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::points::Height;
    use num_complex::Complex64;

    fn point(range_m: f64, snr_db: f64) -> Point {
        Point {
            range_m,
            radial_velocity_mps: 0.0,
            azimuth_rad: 0.0,
            elevation_rad: 0.0,
            height: Height::Measured,
            position_m: [0.0, range_m, 0.0],
            snr_db,
            two_ways_rad: None,
            stationary: None,
            object: Some(0),
            target: None,
            label: None,
        }
    }

    fn radar() -> Radar {
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        scene::read(&file, &scene::ReadOptions::names_only()).unwrap().radar
    }

    #[test]
    fn the_mean_of_points_whose_echoes_err_by_all_phases_scatters_as_is_told() {
        const PHASES: u32 = 16;
        let points = [point(30.0, 20.0), point(31.5, 14.0), point(34.0, 23.0)];
        let (amplitude, alone_m) = (0.03, 0.02);
        let all: Vec<&Point> = points.iter().collect();
        let told = of_mean(&all, amplitude, |point| (point.range_m, alone_m)).unwrap();
        let middle = mean(&all, |point| point.range_m);
        // Each point's error turns through all phases, and its range lies on either side.
        let off_m = |case: u32| {
            let states = 2 * PHASES;
            let erring = (0..).zip(points).map(|(i, p)| {
                let state = case / states.pow(i) % states;
                let turn = std::f64::consts::TAU * f64::from(state / 2) / f64::from(PHASES);
                let side = f64::from(state % 2) * 2.0 - 1.0;
                let echo = Complex64::ONE + Complex64::from_polar(amplitude, turn);
                point(p.range_m + side * alone_m, p.snr_db + 20.0 * echo.norm().log10())
            });
            let erring: Vec<Point> = erring.collect();
            mean(&erring.iter().collect::<Vec<_>>(), |point| point.range_m) - middle
        };
        let cases = (2 * PHASES).pow(3);
        let variance = (0..cases).map(off_m).map(|off_m| off_m * off_m).sum::<f64>() / f64::from(cases);
        assert!((variance.sqrt() / told - 1.0).abs() < 0.02, "{} against {told}", variance.sqrt());
    }

    #[test]
    fn a_lone_point_errs_by_the_cramer_rao_bound_at_the_ratio_of_its_echo_and_its_error() {
        let (radar, lone) = (radar(), point(30.0, 25.0));
        let [range_m, velocity_mps, across_m] = standard_errors(&radar, &[&lone], 0.1);
        let bound = dsp::cramer_rao(&radar, 100.0 / radar.virtual_channels() as f64);
        let alike = |told: Option<f64>, bound: f64| (told.unwrap() / bound - 1.0).abs() < 1e-12;
        assert!(alike(range_m, bound.range_m) && alike(velocity_mps, bound.velocity_mps));
        assert!(alike(across_m, 30.0 * bound.cosines[0]));
        assert_eq!(standard_errors(&radar, &[], 0.1), [None; 3]);
    }

    #[test]
    fn errors_stay_the_same_when_radar_and_points_turn_together() {
        let told = |turn_deg: f64| {
            let turn_rad = turn_deg.to_radians();
            let radar = Radar { boresight_az_rad: turn_rad, ..radar() };
            let at = |range_m: f64, off_deg: f64| {
                let azimuth_rad = folded(turn_rad + off_deg.to_radians(), TAU);
                Point { azimuth_rad, ..point(range_m, 20.0) }
            };
            standard_errors(&radar, &[&at(30.0, -3.0), &at(31.0, 4.0)], 0.1).map(Option::unwrap)
        };
        for turn_deg in [90.0, 179.0, -90.0] {
            let apart = std::iter::zip(told(turn_deg), told(0.0)).map(|(a, b)| (a / b - 1.0).abs());
            assert!(apart.fold(0.0, f64::max) < 1e-9, "{turn_deg}°: {:?}, {:?}", told(turn_deg), told(0.0));
        }
    }
}
