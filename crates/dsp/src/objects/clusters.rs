//! Clustering: points of one vehicle, grown from the strongest point along range and velocity within one
//! strip of road.
//!
//! A vehicle is a chain of scatterers along its lane, followed by a tail of multiple-bounce echoes, all at
//! nearly one radial velocity. A point therefore joins if it is near *any* member in range and velocity (a
//! chain of any length), but near the *whole* object's power-weighted mean across the lanes: chains must not
//! creep from one lane to the next, which density clustering (DBSCAN) in all three dimensions allows as soon
//! as one weak point between them is badly placed.
//!
//! A body whose echoes leave a longer gap, or one of whose points was too far aside when tested, forms two
//! groups. They are joined if they lie in one strip (means within half a lane), move alike (mean velocities
//! within half a reach) and are closer than two cars of a queue; not if the farther one is ten times
//! stronger, as a follower's front is and a shadowed rear is not. Across the line of sight a vehicle is
//! longer than the strip is wide, and its velocity varies from end to end: parts explained by one velocity,
//! one behind the other along it, are joined as well (`rigid_pieces.rs`).
//!
//! Bodies of a queue that starts or stops lie within one reach of each other and within the velocity reach:
//! their chain is cut where the velocity of its echoes steps (`velocity_steps.rs`), and parts separated by a
//! step are not joined again.
//!
//! Points left over behind a group, in its strip and at its velocity, but twenty times weaker, are its tail:
//! the far end of a long body, which returns little compared with the front, or a multiple-bounce echo. (A
//! box truck of 8 m at 30 m: the front at 25 dB, the rear, 6 m behind the last echo before it, at 11 dB.) A
//! follower of similar strength stays its own object; one that is twenty times weaker, that near and at equal
//! speed, is lost to the one ahead; at ten times, the fading of two equal cars 6 m apart sufficed to lose
//! one. A weaker group beside the front is its far corner: a bus is as wide as the strip.

use crate::objects::cluster_point::ClusterPoint;
use crate::objects::rigid_pieces::is_one_rigid_body;
use crate::objects::velocity_steps::{DopplerAxis, range_of_step, steps_between};
use artifact::settings::DspSettings;
use radar::doppler_ambiguity::wrapped_mps;

/// Groups of indices into `members`, which are sorted strongest first.
///
/// Every member is in exactly one group; groups are ordered by their strongest member, members by index.
pub(crate) fn clusters(
    members: &[ClusterPoint],
    settings: &DspSettings,
    axis: DopplerAxis,
) -> Vec<Vec<usize>> {
    let echoes = Echoes { members, settings, axis };
    let mut groups = echoes.chains();
    groups.sort_by_key(|group| group[0]);
    let groups = merged_into_earlier(groups, |piece, body| {
        echoes.is_piece(piece, body) || echoes.is_one_rigid_body([body, piece])
    });
    merged_into_earlier(groups, |tail, body| {
        !steps_between(members, axis, [tail, body])
            && (echoes.is_tail(tail, body) || echoes.is_wing(tail, body))
    })
}

/// Maximum power of a tail relative to the strongest point ahead.
const TAIL_POWER: f64 = 0.05;
/// Maximum distance of a tail behind the last point ahead, in range reaches: 6.25 m for the default 2.5 m.
const TAIL_REACHES: f64 = 2.5;
/// Maximum power of a wing relative to the strongest point of its front.
const WING_POWER: f64 = 0.1;
/// Standard errors by which a wing may appear farther across than it is.
const WING_ERRORS: f64 = 2.0;
/// Maximum distance between two pieces of one body, in range reaches: 4.4 m for the default 2.5 m. The rear
/// of a car is hidden from the front, so that echoes of two cars a metre apart are farther from each other.
const PIECE_REACHES: f64 = 1.75;
/// Maximum distance across between the means of two pieces of one body, relative to the reach across: 1.5 m,
/// two fifths of a lane.
const PIECE_STRIP: f64 = 0.6;
/// Maximum velocity difference between the means of two pieces of one body, relative to the velocity reach.
const PIECE_VELOCITY: f64 = 0.5;
/// Power ratio to nearer echoes from which an echo is a follower's front: a body's own front shadows its
/// rear.
const FOLLOWER_POWER: f64 = 10.0;
/// Distance behind the first echo, longer than cars, beyond which any stronger echo is a follower's front, m:
/// the strongest echo of a body comes from its front, its windscreen or the load above its cab.
const FRONT_M: f64 = 5.0;
/// Power relative to a front below which echoes ahead of it are its sidelobes.
const SIDELOBES: f64 = 0.01;

/// Echoes of a frame, strongest first, and the criteria by which they belong together.
#[derive(Clone, Copy)]
struct Echoes<'a> {
    members: &'a [ClusterPoint],
    settings: &'a DspSettings,
    axis: DopplerAxis,
}

impl Echoes<'_> {
    /// Chains grown from the strongest free echoes, cut where velocities step and before bodies ahead.
    fn chains(&self) -> Vec<Vec<usize>> {
        let mut free: Vec<bool> = vec![true; self.members.len()];
        let mut groups = Vec::new();
        for seed in 0..self.members.len() {
            if free[seed] {
                let mut group = self.grow(seed, &mut free);
                group.sort_unstable();
                let parts = self.split_by_velocity(group);
                groups.extend(parts.into_iter().flat_map(|part| self.split_before_front(part)));
            }
        }
        groups
    }

    /// All free members reached by a chain from the seed, strongest first so that the mean settles early.
    fn grow(&self, seed: usize, free: &mut [bool]) -> Vec<usize> {
        let mut group = Vec::new();
        let mut reached = vec![seed];
        let (mut moment, mut weight) = (0.0, 0.0);
        free[seed] = false;
        while let Some(next) = strongest(&mut reached) {
            let strays = weight > 0.0
                && (self.members[next].cross_m - moment / weight).abs() > self.settings.cluster_cross_m;
            if strays {
                free[next] = true;
                continue;
            }
            moment += self.members[next].cross_m * self.members[next].power;
            weight += self.members[next].power;
            group.push(next);
            for (other, is_free) in free.iter_mut().enumerate() {
                if *is_free && self.near(&self.members[next], &self.members[other]) {
                    *is_free = false;
                    reached.push(other);
                }
            }
        }
        group
    }

    /// Splits a grown group wherever the velocity of the chain steps and no motion across the line of sight
    /// explains the step; members stay in order of index.
    fn split_by_velocity(&self, group: Vec<usize>) -> Vec<Vec<usize>> {
        let Some(cut_m) = range_of_step(self.members, self.axis, &group) else { return vec![group] };
        let (near, far): (Vec<usize>, Vec<usize>) =
            group.iter().partition(|i| self.members[**i].range_m < cut_m);
        if self.is_one_rigid_body([&near, &far]) {
            return vec![group];
        }
        let parts = [near, far].into_iter().flat_map(|part| self.split_by_velocity(part));
        parts.collect()
    }

    /// Separates from a grown group what lies ahead of its strongest echo's body: the chain of a queue is cut
    /// at the weakest echo between two fronts.
    fn split_before_front(&self, group: Vec<usize>) -> Vec<Vec<usize>> {
        let strongest = &self.members[group[0]];
        let ahead = group.iter().find(|i| self.members[**i].range_m < strongest.range_m - FRONT_M);
        let Some(front) =
            ahead.map(|i| &self.members[*i]).filter(|front| front.power > SIDELOBES * strongest.power)
        else {
            return vec![group];
        };
        // Strictly: the front itself, and what lies at its range, stays before the cut.
        let between = |i: &&usize| {
            let range_m = self.members[**i].range_m;
            front.range_m < range_m && range_m < strongest.range_m
        };
        let Some(valley) = group.iter().rfind(between).filter(|i| self.members[**i].power < front.power)
        else {
            return vec![group];
        };
        let cut_m = self.members[*valley].range_m;
        let (near, far): (Vec<usize>, Vec<usize>) =
            group.iter().partition(|i| self.members[**i].range_m < cut_m);
        let mut groups = self.split_before_front(near);
        groups.push(far);
        groups
    }

    fn is_piece(&self, a: &[usize], b: &[usize]) -> bool {
        let gaps = a
            .iter()
            .flat_map(|i| b.iter().map(|j| (self.members[*i].range_m - self.members[*j].range_m).abs()));
        let [(cross_a_m, velocity_a), (cross_b_m, velocity_b)] = [a, b].map(|group| self.means(group));
        let apart = wrapped_mps(velocity_a - velocity_b, self.axis.span_mps).abs();
        !self.is_follower(a, b)
            && !steps_between(self.members, self.axis, [a, b])
            && apart <= PIECE_VELOCITY * self.settings.cluster_velocity_mps
            && (cross_a_m - cross_b_m).abs() <= PIECE_STRIP * self.settings.cluster_cross_m
            && gaps.fold(f64::INFINITY, f64::min) <= self.piece_reach_m()
    }

    /// Whether one velocity explains two parts, one of which lies behind the other along it.
    fn is_one_rigid_body(&self, parts: [&[usize]; 2]) -> bool {
        is_one_rigid_body(self.members, self.settings, self.axis.span_mps, parts, self.piece_reach_m())
    }

    fn piece_reach_m(&self) -> f64 {
        PIECE_REACHES * self.settings.cluster_range_m
    }

    fn is_follower(&self, a: &[usize], b: &[usize]) -> bool {
        let first_m =
            |group: &[usize]| group.iter().map(|i| self.members[*i].range_m).fold(f64::INFINITY, f64::min);
        let (near, far) = if first_m(a) <= first_m(b) { (a, b) } else { (b, a) };
        let (front, follower) = (&self.members[near[0]], &self.members[far[0]]);
        let is_far_behind = follower.range_m - first_m(near) > FRONT_M;
        follower.power > FOLLOWER_POWER * front.power || is_far_behind && follower.power > front.power
    }

    /// Power-weighted means of a group: position across the lanes, and velocity around that of its strongest
    /// member.
    fn means(&self, group: &[usize]) -> (f64, f64) {
        let strongest_mps = self.members[group[0]].radial_velocity_mps;
        let (mut cross, mut velocity, mut weight) = (0.0, 0.0, 0.0);
        for member in group.iter().map(|i| &self.members[*i]) {
            cross += member.power * member.cross_m;
            velocity +=
                member.power * wrapped_mps(member.radial_velocity_mps - strongest_mps, self.axis.span_mps);
            weight += member.power;
        }
        (cross / weight, strongest_mps + velocity / weight)
    }

    fn is_tail(&self, tail: &[usize], body: &[usize]) -> bool {
        let (strongest, weak) = (&self.members[body[0]], &self.members[tail[0]]);
        let ranges = |group: &[usize]| group.iter().map(|i| self.members[*i].range_m).collect::<Vec<_>>();
        let first_m = |group: &[usize]| ranges(group).into_iter().fold(f64::INFINITY, f64::min);
        let last_m = ranges(body).into_iter().fold(f64::NEG_INFINITY, f64::max);
        weak.power <= TAIL_POWER * strongest.power
            && first_m(tail) >= first_m(body)
            && first_m(tail) <= last_m + TAIL_REACHES * self.settings.cluster_range_m
            && self.apart_mps(strongest, weak) <= self.settings.cluster_velocity_mps
            && (strongest.cross_m - weak.cross_m).abs() <= self.settings.cluster_cross_m
    }

    /// Whether a group is a front's far corner: much weaker, as far in range as the front's strongest point,
    /// and no farther across than the reach plus its noise error (a bus is as wide as the reach).
    fn is_wing(&self, wing: &[usize], body: &[usize]) -> bool {
        let (strongest, weak) = (&self.members[body[0]], &self.members[wing[0]]);
        let reach_m = self.settings.cluster_cross_m + WING_ERRORS * weak.cross_error_m;
        weak.power <= WING_POWER * strongest.power
            && self.near(strongest, weak)
            && (strongest.cross_m - weak.cross_m).abs() <= reach_m
    }

    fn near(&self, a: &ClusterPoint, b: &ClusterPoint) -> bool {
        let near_in_range = (a.range_m - b.range_m).abs() <= self.settings.cluster_range_m;
        near_in_range && self.apart_mps(a, b) <= self.settings.cluster_velocity_mps
    }

    /// Velocity difference on the circle of one span.
    fn apart_mps(&self, a: &ClusterPoint, b: &ClusterPoint) -> f64 {
        wrapped_mps(a.radial_velocity_mps - b.radial_velocity_mps, self.axis.span_mps).abs()
    }
}

/// Joins each group, strongest first, to the strongest earlier one that it belongs to, until none belongs to
/// another.
fn merged_into_earlier(
    mut groups: Vec<Vec<usize>>,
    belongs: impl Fn(&[usize], &[usize]) -> bool,
) -> Vec<Vec<usize>> {
    loop {
        let before = groups.len();
        groups = merged_once(groups, &belongs);
        if groups.len() == before {
            return groups;
        }
    }
}

fn merged_once(groups: Vec<Vec<usize>>, belongs: &impl Fn(&[usize], &[usize]) -> bool) -> Vec<Vec<usize>> {
    let mut joined: Vec<Vec<usize>> = Vec::new();
    for group in groups {
        match joined.iter_mut().find(|earlier| belongs(&group, earlier)) {
            Some(earlier) => {
                earlier.extend(group);
                earlier.sort_unstable();
            }
            None => joined.push(group),
        }
    }
    joined
}

/// Members are sorted strongest first, so this is the lowest index.
fn strongest(reached: &mut Vec<usize>) -> Option<usize> {
    let at = (0..reached.len()).min_by_key(|i| reached[*i])?;
    Some(reached.swap_remove(at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use radar::paper;

    const AXIS: DopplerAxis = DopplerAxis { span_mps: 35.0, cell_mps: 0.25 };

    /// Groups of the ranges of bodies at rest in one lane, given by range and level.
    fn groups_of(echoes: &[(f64, f64)]) -> Vec<Vec<f64>> {
        groups(echoes.iter().map(|(range_m, db)| at(*range_m, *db)).collect())
    }

    fn groups(mut members: Vec<ClusterPoint>) -> Vec<Vec<f64>> {
        members.sort_by(|a, b| b.power.total_cmp(&a.power));
        let of = |group: &Vec<usize>| {
            let mut ranges: Vec<f64> = group.iter().map(|i| members[*i].range_m).collect();
            ranges.sort_by(f64::total_cmp);
            ranges
        };
        let mut groups: Vec<Vec<f64>> =
            clusters(&members, &paper::processing(), AXIS).iter().map(of).collect();
        groups.sort_by(|a, b| a[0].total_cmp(&b[0]));
        groups
    }

    fn at(range_m: f64, db: f64) -> ClusterPoint {
        ClusterPoint {
            range_m,
            radial_velocity_mps: 0.0,
            cross_m: 2.0,
            cross_error_m: 0.1,
            power: 10.0_f64.powf(0.1 * db),
            place_m: DVec2::new(2.0, range_m),
        }
    }

    /// The third car and the truck behind it in scenes/traffic.toml, with the multiple-bounce echoes between
    /// them.
    #[test]
    fn a_car_before_a_stronger_truck_is_not_chained_to_it_by_weak_echoes_between() {
        let echoes =
            [(27.6, 37.0), (28.1, 27.0), (29.8, 28.0), (30.9, 10.0), (31.4, 15.0), (33.3, 4.0), (33.8, 45.0)];
        assert_eq!(groups_of(&echoes), [vec![27.6, 28.1, 29.8, 30.9, 31.4], vec![33.3, 33.8]]);
    }

    /// Two echoes of one cell have one range: the weaker is no valley behind the stronger.
    #[test]
    fn two_echoes_at_the_range_of_a_front_stay_together() {
        let echoes = [(20.0, 30.0), (20.0, 8.0), (21.2, 27.0), (22.5, 28.0), (23.6, 27.0), (24.8, 38.0)];
        let groups = groups_of(&echoes);
        assert!(groups[0].starts_with(&[20.0, 20.0]), "{groups:?}");
        assert_eq!(groups.concat().len(), echoes.len(), "{groups:?}");
    }

    #[test]
    fn a_load_over_a_cab_and_a_rear_weaker_than_its_front_are_parts_of_their_bodies() {
        let truck = [(30.0, 20.0), (31.2, 12.0), (32.6, 34.0), (34.9, 18.0), (37.0, 15.0)];
        assert_eq!(groups_of(&truck).len(), 1);
        let bus = [(30.0, 33.0), (32.0, 14.0), (34.3, 13.0), (36.5, 12.0), (38.8, 24.0)];
        assert_eq!(groups_of(&bus).len(), 1);
    }

    #[test]
    fn what_is_a_hundred_times_weaker_before_a_front_is_a_sidelobe_of_it() {
        let echoes = [(30.0, 10.0), (32.0, 12.0), (34.0, 20.0), (36.0, 45.0)];
        assert_eq!(groups_of(&echoes).len(), 1);
    }

    /// A sedan, an estate and a bus that start one after the other, from a traced frame.
    const QUEUE: [(f64, f64, f64); 13] = [
        (17.56, 22.0, -0.54),
        (18.52, 22.0, -0.55),
        (19.19, 37.0, -0.56),
        (20.41, 21.0, -0.57),
        (21.14, 19.0, -0.57),
        (24.02, 23.0, -0.86),
        (25.02, 19.0, -0.86),
        (25.47, 19.0, -0.84),
        (26.86, 6.0, -0.86),
        (30.77, 23.0, -1.17),
        (32.03, 7.0, -1.17),
        (33.54, 11.0, -1.19),
        (37.27, 5.0, -1.15),
    ];

    #[test]
    fn bodies_of_a_queue_that_starts_are_parted_where_the_velocity_steps() {
        let moving =
            |(range_m, db, radial_velocity_mps)| ClusterPoint { radial_velocity_mps, ..at(range_m, db) };
        let found = groups(QUEUE.map(moving).to_vec());
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [5, 4, 4]);
        let at_one_velocity =
            |(range_m, db, _)| ClusterPoint { radial_velocity_mps: -0.9, ..at(range_m, db) };
        assert_eq!(groups(QUEUE.map(at_one_velocity).to_vec()).len(), 1);
    }
}
