//! Test whether two groups of points are parts of one body that drives across the line of sight.
//!
//! A point of a body with velocity V has the radial velocity V·û, û the unit vector from the radar to it:
//! over the length of a crossing vehicle the radial velocity changes by metres per second, and both
//! components of V follow from that profile by least squares (Kellner, Barjenbruch, Klappstein, Dickmann and
//! Dietmayer, IEEE IV 2013). A vehicle drives along its length, so its parts lie in a strip along V no wider
//! than the vehicle. Two vehicles abreast that drive away from the radar do not: a velocity that explained
//! both would point across their lanes. Bodies at rest show no velocity, and are not tested.
//!
//! Two parts of one peak each have no misfit to judge by: any two radial velocities fit some velocity. The
//! evidence then is that this velocity points from one to the other: two parts of a side line up along it,
//! and its component across the line of sight exceeds its error.

use crate::objects::cluster_point::ClusterPoint;
use artifact::settings::DspSettings;
use glam::{DMat2, DVec2};
use radar::doppler_ambiguity::wrapped_mps;

/// Minimum and maximum speed, m/s: the velocity of a slower body hardly varies from cell to cell over its
/// length; no street vehicle is faster.
const SPEEDS_MPS: [f64; 2] = [2.0, 35.0];
/// Standard error of a peak's velocity with several parts of a body in its cell, m/s.
pub(crate) const VELOCITY_ERROR_MPS: f64 = 0.15;
/// Maximum rms misfit of the points of one body to its motion, relative to the velocity reach.
const MISFIT: f64 = 0.35;
/// Standard errors to which a group must predict another's velocities, and the maximum of these errors, m/s.
const PREDICTION_LIMITS: (f64, f64) = (2.5, 0.5);
/// Maximum length of vehicles on roads without special permit, an articulated bus or a lorry and trailer, m.
const LONGEST_M: f64 = 18.75;
/// Width of the strip that contains the echoes of one side, relative to the reach across: 1.5 m, like pieces
/// of one body in its lane.
const SIDE_WIDTH: f64 = 0.6;
/// Width of the narrowest lane for lorries, m: bodies abreast have echoes a lane apart, so echoes closer than
/// this that line up along their own motion are one side.
const LANE_M: f64 = 3.25;
/// Additional width of strips along a velocity known from few points, m.
const STRIP_MARGIN_M: f64 = 1.0;

/// Whether `b` continues `a`, at most `reach_m` from it along their velocity.
pub(crate) fn is_one_rigid_body(
    members: &[ClusterPoint],
    settings: &DspSettings,
    velocity_span_mps: f64,
    groups: [&[usize]; 2],
    reach_m: f64,
) -> bool {
    let first = groups.map(|group| &members[group[0]]);
    if first[0].place_m.distance(first[1].place_m) > LONGEST_M {
        return false;
    }
    let echo = |i: &usize| PlacedEcho::of(&members[*i], first[0].radial_velocity_mps, velocity_span_mps);
    let [a, b] = groups.map(|group| group.iter().map(echo).collect::<Vec<PlacedEcho>>());
    let all: Vec<PlacedEcho> = a.iter().chain(&b).copied().collect();
    let fit = VelocityFit::of(&all);
    let speed_mps = fit.velocity_mps.length();
    let is_a_vehicles = (SPEEDS_MPS[0]..=SPEEDS_MPS[1]).contains(&speed_mps);
    if !is_a_vehicles || fit.misfit_mps(&all) > MISFIT * settings.cluster_velocity_mps {
        return false;
    }
    let along = fit.velocity_mps / speed_mps;
    let width_m = length(extent(&all, |place_m| along.perp_dot(place_m)));
    let [of_a, of_b] = [&a, &b].map(|part| extent(part, |place_m| along.dot(place_m)));
    let gap_m = (of_b[0] - of_a[1]).max(of_a[0] - of_b[1]);
    let continues =
        gap_m <= reach_m && width_m <= settings.cluster_cross_m + STRIP_MARGIN_M && predicts(&a, &b);
    let adjoins = width_m <= settings.cluster_cross_m
        && nearest_m(&a, &b) <= settings.cluster_range_m
        && drives_across(&all, fit.velocity_mps);
    let lines_up = width_m <= SIDE_WIDTH * settings.cluster_cross_m
        && gap_m <= LANE_M.min(reach_m)
        && fit.is_known_to_cross(&all);
    length(extent(&all, |place_m| along.dot(place_m))) <= LONGEST_M && (continues || adjoins || lines_up)
}

/// Contribution of a point to its body's motion.
#[derive(Debug, Clone, Copy)]
struct PlacedEcho {
    place_m: DVec2,
    /// Unit vector from the radar.
    sight: DVec2,
    velocity_mps: f64,
}

impl PlacedEcho {
    fn of(member: &ClusterPoint, near_mps: f64, velocity_span_mps: f64) -> Self {
        let velocity_mps = near_mps + wrapped_mps(member.radial_velocity_mps - near_mps, velocity_span_mps);
        Self { place_m: member.place_m, sight: member.place_m.normalize_or_zero(), velocity_mps }
    }
}

/// Least-squares velocity of a body.
struct VelocityFit {
    velocity_mps: DVec2,
    /// Covariance of the velocity over the variance of one radial velocity.
    covariance: DMat2,
}

impl VelocityFit {
    /// Fits the velocity. Points in one direction leave the component across it undetermined: its variance
    /// then exceeds any limit.
    fn of(echoes: &[PlacedEcho]) -> Self {
        let (mut normal, mut moment) = (DMat2::from_diagonal(DVec2::splat(1e-9)), DVec2::ZERO);
        for echo in echoes {
            normal += DMat2::from_cols(echo.sight * echo.sight.x, echo.sight * echo.sight.y);
            moment += echo.sight * echo.velocity_mps;
        }
        let covariance = normal.inverse();
        Self { velocity_mps: covariance * moment, covariance }
    }

    fn misfit_mps(&self, echoes: &[PlacedEcho]) -> f64 {
        let square = |echo: &PlacedEcho| (echo.velocity_mps - self.velocity_mps.dot(echo.sight)).powi(2);
        (echoes.iter().map(square).sum::<f64>() / echoes.len() as f64).sqrt()
    }

    /// Whether the velocity across the line of sight is significant relative to its error.
    fn is_known_to_cross(&self, echoes: &[PlacedEcho]) -> bool {
        let across = mean_sight(echoes).perp();
        let error_mps = VELOCITY_ERROR_MPS * across.dot(self.covariance * across).sqrt();
        self.velocity_mps.dot(across).abs() >= PREDICTION_LIMITS.0 * error_mps
    }

    fn predicts(&self, echo: &PlacedEcho) -> bool {
        let error_mps = VELOCITY_ERROR_MPS * (1.0 + echo.sight.dot(self.covariance * echo.sight)).sqrt();
        let off_mps = (echo.velocity_mps - self.velocity_mps.dot(echo.sight)).abs();
        error_mps <= PREDICTION_LIMITS.1 && off_mps <= PREDICTION_LIMITS.0 * error_mps
    }
}

/// Whether the part with the better known motion predicts the velocities of the other.
fn predicts(a: &[PlacedEcho], b: &[PlacedEcho]) -> bool {
    let known = |part: &[PlacedEcho]| (part.len() > 1).then(|| VelocityFit::of(part));
    let trace = |fit: &VelocityFit| fit.covariance.x_axis.x + fit.covariance.y_axis.y;
    match (known(a), known(b)) {
        (Some(of_a), Some(of_b)) if trace(&of_b) < trace(&of_a) => a.iter().all(|echo| of_b.predicts(echo)),
        (Some(of_a), _) => b.iter().all(|echo| of_a.predicts(echo)),
        (None, Some(of_b)) => a.iter().all(|echo| of_b.predicts(echo)),
        (None, None) => false,
    }
}

/// Whether a body moves more across the line of sight than along it.
fn drives_across(echoes: &[PlacedEcho], velocity_mps: DVec2) -> bool {
    let sight = mean_sight(echoes);
    velocity_mps.perp_dot(sight).abs() >= velocity_mps.dot(sight).abs()
}

fn mean_sight(echoes: &[PlacedEcho]) -> DVec2 {
    echoes.iter().map(|echo| echo.place_m).sum::<DVec2>().normalize_or_zero()
}

fn nearest_m(a: &[PlacedEcho], b: &[PlacedEcho]) -> f64 {
    let apart = a.iter().flat_map(|one| b.iter().map(move |other| one.place_m.distance(other.place_m)));
    apart.fold(f64::INFINITY, f64::min)
}

fn extent(echoes: &[PlacedEcho], coordinate_m: impl Fn(DVec2) -> f64) -> [f64; 2] {
    let places = echoes.iter().map(|echo| coordinate_m(echo.place_m));
    places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

fn length([low, high]: [f64; 2]) -> f64 {
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;
    use radar::paper;

    const SPAN_MPS: f64 = 35.0;

    fn member(x_m: f64, y_m: f64, velocity_mps: DVec2) -> ClusterPoint {
        let place_m = DVec2::new(x_m, y_m);
        ClusterPoint {
            range_m: place_m.length(),
            radial_velocity_mps: velocity_mps.dot(place_m.normalize_or_zero()),
            cross_m: x_m,
            cross_error_m: 0.1,
            power: 1.0,
            place_m,
        }
    }

    fn are_one(members: &[ClusterPoint], groups: [&[usize]; 2]) -> bool {
        is_one_rigid_body(members, &paper::processing(), SPAN_MPS, groups, 4.4)
    }

    #[test]
    fn parts_of_a_car_that_crosses_are_one_body_though_their_velocities_differ() {
        let across = DVec2::new(8.0, 0.0);
        let car = [member(-0.7, 8.4, across), member(0.9, 8.9, across), member(3.0, 8.4, across)];
        assert!((car[0].radial_velocity_mps - car[1].radial_velocity_mps).abs() > 1.0);
        assert!(are_one(&car, [&[0], &[1]]));
        assert!(are_one(&car, [&[0, 1], &[2]]));
    }

    #[test]
    fn two_echoes_of_a_side_that_line_up_along_the_motion_they_tell_are_one_body() {
        let across = DVec2::new(-9.6, 0.0);
        let side = [member(-7.8, 16.3, across), member(-10.6, 16.2, across)];
        assert!(are_one(&side, [&[0], &[1]]));
        // In the next lane, at the same radial velocities.
        let beside = [side[0], member(-10.6, 19.9, across)];
        assert!(!are_one(&beside, [&[0], &[1]]));
    }

    /// Two people in a room, one walking away and one approaching, with a scene's clustering distances for
    /// people.
    #[test]
    fn parts_line_up_no_farther_than_the_reach_that_a_scene_asks_for() {
        let [recedes, comes] = [0.586, -0.469];
        let person = |x_m, y_m, radial_velocity_mps| ClusterPoint {
            radial_velocity_mps,
            ..member(x_m, y_m, DVec2::ZERO)
        };
        let pair = [person(-0.34, 2.92, recedes), person(0.82, 2.88, comes)];
        let people = DspSettings {
            cluster_range_m: 0.6,
            cluster_cross_m: 0.8,
            cluster_velocity_mps: 1.0,
            ..paper::processing()
        };
        let within = |reach_m| is_one_rigid_body(&pair, &people, SPAN_MPS, [&[0], &[1]], reach_m);
        assert!(within(4.4) && !within(1.75 * people.cluster_range_m));
    }

    #[test]
    fn cars_abreast_that_start_before_a_light_are_two_bodies() {
        let pair = [member(2.0, 28.0, DVec2::new(0.0, -0.5)), member(5.75, 28.0, DVec2::new(0.0, -1.1))];
        assert!(!are_one(&pair, [&[0], &[1]]));
    }

    #[test]
    fn cars_abreast_that_drive_away_are_two_bodies() {
        let pair = [member(2.0, 40.0, DVec2::new(0.0, -8.0)), member(5.75, 40.0, DVec2::new(0.0, -9.0))];
        assert!(!are_one(&pair, [&[0], &[1]]));
    }

    #[test]
    fn bodies_at_rest_show_no_motion_to_share() {
        let pair = [member(2.0, 28.0, DVec2::ZERO), member(4.0, 28.0, DVec2::ZERO)];
        assert!(!are_one(&pair, [&[0], &[1]]));
    }

    #[test]
    fn a_car_that_meets_another_is_not_its_continuation() {
        let [there, back] = [8.0, -8.0].map(|x| DVec2::new(x, 0.0));
        let pair = [
            member(-3.0, 9.0, there),
            member(-1.0, 9.0, there),
            member(1.5, 12.5, back),
            member(3.5, 12.5, back),
        ];
        assert!(!are_one(&pair, [&[0, 1], &[2, 3]]));
    }
}
