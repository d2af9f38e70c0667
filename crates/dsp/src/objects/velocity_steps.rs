//! Velocity steps in a chain of echoes, where one body of a queue ends and the next begins.
//!
//! All echoes of a rigid body that drives along the line of sight have one radial velocity, from front to
//! rear, including multiple-bounce echoes on it. The next body of a queue that starts or stops has another. A
//! chain is therefore two bodies if the medians before and behind a position differ by a Doppler cell or
//! more, and by more than the errors of that many velocities. A body that drives across the line of sight has
//! a different velocity at every echo; the caller must check whether one motion explains both sides
//! (`rigid_pieces.rs`).

use crate::objects::cluster_point::ClusterPoint;
use crate::objects::rigid_pieces::VELOCITY_ERROR_MPS;
use radar::doppler_ambiguity::wrapped_mps;

/// Parameters of the velocity axis for velocity differences.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DopplerAxis {
    /// Span at which velocities wrap.
    pub(crate) span_mps: f64,
    /// Width of a cell.
    pub(crate) cell_mps: f64,
}

/// Distance before and behind a position from which echoes are taken for the velocities of both sides: a
/// car's length, m.
const STRETCH_M: f64 = 5.0;
/// Minimum number of echoes on a side.
const FEWEST: usize = 2;
/// Standard errors of a difference of medians up to which it is not a step.
const ERRORS: f64 = 2.5;

/// Range of the first echo behind the largest step of a group; `None` if there is no step.
pub(crate) fn range_of_step(members: &[ClusterPoint], axis: DopplerAxis, group: &[usize]) -> Option<f64> {
    let chain = Chain::of(members, axis, group);
    if !chain.may_step(axis) {
        return None;
    }
    let step = |at: usize| (at, step(chain.before(at), chain.from(at), axis));
    // Echoes at one range stay together: a cut by range would leave nothing before them.
    let is_between = |at: &usize| chain.echoes[at - 1].range_m < chain.echoes[*at].range_m;
    let places = (FEWEST..=chain.echoes.len().saturating_sub(FEWEST)).filter(is_between);
    let steps = places.map(step);
    let (at, size) = steps.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    (size >= 1.0).then(|| chain.echoes[at].range_m)
}

/// Whether the velocity steps between two groups, the second of which lies behind the first.
pub(crate) fn steps_between(members: &[ClusterPoint], axis: DopplerAxis, groups: [&[usize]; 2]) -> bool {
    let strongest_mps = members[groups[0][0]].radial_velocity_mps;
    let mut chains = groups.map(|group| Chain::about(members, axis, group, strongest_mps));
    chains.sort_by(|a, b| a.echoes[0].range_m.total_cmp(&b.echoes[0].range_m));
    let [near, far] = &chains;
    let is_behind = near.echoes.last().is_some_and(|last| last.range_m <= far.echoes[0].range_m);
    is_behind && step(near.before(near.echoes.len()), far.from(0), axis) >= 1.0
}

/// Echoes of a group in order of range.
struct Chain {
    echoes: Vec<RangedEcho>,
}

struct RangedEcho {
    range_m: f64,
    /// Radial velocity relative to that of a strongest echo.
    velocity_mps: f64,
}

impl Chain {
    fn of(members: &[ClusterPoint], axis: DopplerAxis, group: &[usize]) -> Self {
        Self::about(members, axis, group, members[group[0]].radial_velocity_mps)
    }

    fn about(members: &[ClusterPoint], axis: DopplerAxis, group: &[usize], near_mps: f64) -> Self {
        let echo = |i: &usize| RangedEcho {
            range_m: members[*i].range_m,
            velocity_mps: wrapped_mps(members[*i].radial_velocity_mps - near_mps, axis.span_mps),
        };
        let mut echoes: Vec<RangedEcho> = group.iter().map(echo).collect();
        echoes.sort_by(|a, b| a.range_m.total_cmp(&b.range_m));
        Self { echoes }
    }

    /// Whether any two echoes differ by a cell in velocity.
    fn may_step(&self, axis: DopplerAxis) -> bool {
        let velocities = self.echoes.iter().map(|echo| echo.velocity_mps);
        let [low, high] =
            velocities.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        high - low >= axis.cell_mps
    }

    /// Echoes in the stretch that ends before the echo `end`.
    fn before(&self, end: usize) -> &[RangedEcho] {
        let from_m = self.echoes[end - 1].range_m - STRETCH_M;
        let begin = self.echoes[..end].partition_point(|echo| echo.range_m < from_m);
        &self.echoes[begin..end]
    }

    /// Echoes in the stretch that begins with the echo `begin`.
    fn from(&self, begin: usize) -> &[RangedEcho] {
        let to_m = self.echoes[begin].range_m + STRETCH_M;
        let echoes = &self.echoes[begin..];
        &echoes[..echoes.partition_point(|echo| echo.range_m <= to_m)]
    }
}

/// Difference of two sides' medians relative to the smallest step; 0 if a side has too few echoes.
fn step(near: &[RangedEcho], far: &[RangedEcho], axis: DopplerAxis) -> f64 {
    if near.len().min(far.len()) < FEWEST {
        return 0.0;
    }
    let of_one = |side: &[RangedEcho]| 1.0 / side.len() as f64;
    let error_mps = VELOCITY_ERROR_MPS * (of_one(near) + of_one(far)).sqrt();
    (median_mps(near) - median_mps(far)).abs() / axis.cell_mps.max(ERRORS * error_mps)
}

fn median_mps(echoes: &[RangedEcho]) -> f64 {
    let mut velocities: Vec<f64> = echoes.iter().map(|echo| echo.velocity_mps).collect();
    velocities.sort_by(f64::total_cmp);
    let middle = velocities.len() / 2;
    0.5 * (velocities[(velocities.len() - 1) / 2] + velocities[middle])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    const AXIS: DopplerAxis = DopplerAxis { span_mps: 20.0, cell_mps: 0.25 };

    fn chain(velocities_mps: &[f64]) -> Vec<ClusterPoint> {
        let member = |(place, velocity_mps): (usize, &f64)| ClusterPoint {
            range_m: 20.0 + place as f64,
            radial_velocity_mps: *velocity_mps,
            cross_m: 0.0,
            cross_error_m: 0.1,
            power: 1.0,
            place_m: DVec2::new(0.0, 20.0 + place as f64),
        };
        velocities_mps.iter().enumerate().map(member).collect()
    }

    fn cut_m(velocities_mps: &[f64]) -> Option<f64> {
        let members = chain(velocities_mps);
        range_of_step(&members, AXIS, &(0..members.len()).collect::<Vec<_>>())
    }

    #[test]
    fn a_chain_is_cut_at_the_first_echo_of_the_next_body() {
        assert_eq!(cut_m(&[-1.0, -1.02, -0.98, -1.4, -1.42, -1.38]), Some(23.0));
        assert_eq!(cut_m(&[-1.0, -1.02, -0.98, -1.1, -1.12, -1.08]), None);
    }

    #[test]
    fn one_stray_echo_is_no_step_and_two_echoes_need_a_larger_one() {
        assert_eq!(cut_m(&[-1.0, -1.0, -1.0, -1.6, -1.0, -1.0]), None);
        assert_eq!(cut_m(&[-1.0, -1.0, -1.3, -1.3]), None);
        assert_eq!(cut_m(&[-1.0, -1.0, -1.4, -1.4]), Some(22.0));
    }

    #[test]
    fn echoes_of_one_range_are_not_parted() {
        let mut members = chain(&[-1.0, -1.0, -1.0, -2.0]);
        for member in &mut members[..3] {
            member.range_m = 20.0;
        }
        assert_eq!(range_of_step(&members, AXIS, &[0, 1, 2, 3]), None);
    }

    #[test]
    fn velocities_on_both_sides_of_the_span_are_near_each_other() {
        assert_eq!(cut_m(&[9.95, 9.98, -9.97, 9.96, -9.98, 9.99]), None);
    }

    #[test]
    fn a_group_behind_another_steps_from_it_and_one_beside_it_does_not() {
        let members = chain(&[-1.0, -1.0, -1.0, -1.5, -1.5, -1.5]);
        assert!(steps_between(&members, AXIS, [&[3, 4, 5], &[0, 1, 2]]));
        assert!(!steps_between(&members, AXIS, [&[0, 1], &[2]]));
        assert!(!steps_between(&members, AXIS, [&[0, 2, 4], &[1, 3, 5]]));
    }
}
