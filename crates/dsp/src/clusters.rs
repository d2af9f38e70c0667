//! Clusters: points of one vehicle, grown from the strongest point along range and velocity within one strip of road.
//!
//! A vehicle is a chain of scatterers along its lane, its echoes of several bounces a tail behind it, all at nearly one
//! radial velocity. So a point joins when it is near *any* member in range and velocity (a chain of any length), but near
//! the *whole* object's power-weighted mean across the lanes: chains must not creep from one lane to the next, which
//! density clustering (DBSCAN) in all three allows as soon as one weak point between them is badly placed.

use artifact::settings::DspSettings;

/// What clustering knows of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Member {
    /// From the array's centre, m.
    pub range_m: f64,
    /// m/s, in one span of the velocity axis.
    pub radial_velocity_mps: f64,
    /// Across the lanes, m.
    pub cross_m: f64,
    /// Weight.
    pub power: f64,
}

/// Groups of indices into `members`, which come strongest first; `velocity_span_mps` is where velocities wrap.
///
/// Every member is in exactly one group; groups are in the order of their strongest member, members in order of index.
pub fn clusters(members: &[Member], settings: &DspSettings, velocity_span_mps: f64) -> Vec<Vec<usize>> {
    let mut free: Vec<bool> = vec![true; members.len()];
    let mut groups = Vec::new();
    for seed in 0..members.len() {
        if free[seed] {
            let mut group = grow(members, settings, velocity_span_mps, seed, &mut free);
            group.sort_unstable();
            groups.push(group);
        }
    }
    groups
}

/// All free members that a chain reaches from the seed, strongest first so that the mean settles early.
fn grow(
    members: &[Member],
    settings: &DspSettings,
    velocity_span_mps: f64,
    seed: usize,
    free: &mut [bool],
) -> Vec<usize> {
    let mut group = Vec::new();
    let mut reached = vec![seed];
    let (mut moment, mut weight) = (0.0, 0.0);
    free[seed] = false;
    while let Some(next) = strongest(&mut reached) {
        let strays = weight > 0.0 && (members[next].cross_m - moment / weight).abs() > settings.cluster_cross_m;
        if strays {
            free[next] = true;
            continue;
        }
        moment += members[next].cross_m * members[next].power;
        weight += members[next].power;
        group.push(next);
        for other in 0..members.len() {
            if free[other] && near(&members[next], &members[other], settings, velocity_span_mps) {
                free[other] = false;
                reached.push(other);
            }
        }
    }
    group
}

/// Members come strongest first: the lowest index.
fn strongest(reached: &mut Vec<usize>) -> Option<usize> {
    let at = (0..reached.len()).min_by_key(|i| reached[*i])?;
    Some(reached.swap_remove(at))
}

fn near(a: &Member, b: &Member, settings: &DspSettings, velocity_span_mps: f64) -> bool {
    let half = 0.5 * velocity_span_mps;
    let apart_mps = (a.radial_velocity_mps - b.radial_velocity_mps + half).rem_euclid(velocity_span_mps) - half;
    (a.range_m - b.range_m).abs() <= settings.cluster_range_m && apart_mps.abs() <= settings.cluster_velocity_mps
}
