//! What is true of each target, and which detected object it is compared with. Only reports come here: nothing behind
//! the radar cube reads it.

use crate::path_legs::legs;
use artifact::paths::{Path, PathsFrame};
use artifact::points::Object;
use artifact::scene::{Pose, Role, SceneFrame, SceneHeader};
use artifact::settings::Lanes;
use glam::DVec3;

/// An object further away than this in range is another vehicle's (interface.md).
const RANGE_GATE_M: f64 = 4.0;
/// An object further away than this across is another lane's (interface.md).
const CROSS_GATE_M: f64 = 3.75;

/// Truth of one target at the frame's middle, seen from the radar's position.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Truth {
    pub(crate) position_m: DVec3,
    pub(crate) range_m: f64,
    pub(crate) radial_velocity_mps: f64,
    pub(crate) lane: Option<u8>,
    pub(crate) nearest_range_m: Option<f64>,
    pub(crate) echo: Option<Echo>,
    /// Clutter is what results are not compared with.
    pub(crate) role: Role,
    /// Whether it has an echo of its own; echoes of tables are not traced, and taken for granted.
    pub(crate) sends_back: bool,
}

/// Power-weighted means over the paths that touch this target only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Echo {
    pub(crate) range_m: f64,
    pub(crate) radial_velocity_mps: f64,
}

/// In the order of the scene's targets; `paths` is `None` where the echo was made from tables.
pub(crate) fn truths(header: &SceneHeader, frame: &SceneFrame, paths: Option<&PathsFrame>) -> Vec<Truth> {
    let of = |(i, pose): (usize, &Pose)| truth(header, i, pose, paths);
    frame.poses.iter().enumerate().map(of).collect()
}

fn truth(header: &SceneHeader, index: usize, pose: &Pose, paths: Option<&PathsFrame>) -> Truth {
    let pose = &scene::pose_after(pose, header.radar.frame_middle_s());
    let position_m = DVec3::from(pose.position_m);
    let away = position_m - DVec3::from(header.radar.position_m);
    let range_m = away.length();
    let echo = paths.and_then(|p| echo(header, index, &p.paths));
    Truth {
        role: header.targets[index].role,
        position_m,
        range_m,
        radial_velocity_mps: DVec3::from(pose.velocity_mps).dot(away) / range_m,
        lane: header.dsp.road.at(pose.position_m),
        nearest_range_m: paths.and_then(|p| p.nearest_range_m.get(index).copied().flatten()),
        echo,
        sends_back: paths.is_none() || echo.is_some(),
    }
}

fn echo(header: &SceneHeader, target: usize, paths: &[Path]) -> Option<Echo> {
    let (mut weight, mut range, mut velocity) = (0.0, 0.0, 0.0);
    for path in paths.iter().filter(|p| is_wholly_on(target, p)) {
        let (power, echo) = received(header, path);
        weight += power;
        range += power * echo.range_m;
        velocity += power * echo.radial_velocity_mps;
    }
    (weight > 0.0).then(|| Echo { range_m: range / weight, radial_velocity_mps: velocity / weight })
}

/// A way over two vehicles shows at neither: it is a ghost, not an echo of one of them.
fn is_wholly_on(target: usize, path: &Path) -> bool {
    path.target as usize == target && path.sequence().iter().all(|facet| facet.body as usize == target)
}

/// Power of a path up to a common factor, |a|²/(L₁L₂)², and half its length and rate at the frame's middle.
fn received(header: &SceneHeader, path: &Path) -> (f64, Echo) {
    let [there, back] = legs(&header.radar, path);
    let (receive, transmit) = header.radar.array.polarization.indices();
    let power = path.amplitude_m[receive][transmit].norm_sqr() / (there.length_m * back.length_m).powi(2);
    let range_m = 0.5 * (there.length_m + back.length_m);
    let echo = Echo { range_m, radial_velocity_mps: 0.5 * (there.rate_mps + back.rate_mps) };
    (power, echo)
}

/// For each truth the object it is compared with: the nearest within the gates; no object serves two targets, and none clutter.
pub(crate) fn assign(road: &Lanes, truths: &[Truth], objects: &[Object]) -> Vec<Option<usize>> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (t, truth) in truths.iter().enumerate().filter(|(_, truth)| truth.role == Role::Target) {
        pairs.extend(objects.iter().enumerate().filter_map(|(o, object)| Some((distance(road, truth, object)?, t, o))));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut chosen = vec![None; truths.len()];
    for (_, t, o) in pairs {
        if chosen[t].is_none() && !chosen.contains(&Some(o)) {
            chosen[t] = Some(o);
        }
    }
    chosen
}

/// Distance in gates; `None` outside. Range is that of the echo where it is known: a bus's origin lies 6 m behind its front.
fn distance(road: &Lanes, truth: &Truth, object: &Object) -> Option<f64> {
    let [asked, got] = [truth.position_m.to_array(), object.position_m].map(|place| road.across_along_m(place)[0]);
    let range = (object.range_m - truth.echo.map_or(truth.range_m, |e| e.range_m)).abs() / RANGE_GATE_M;
    let cross = (got - asked).abs() / CROSS_GATE_M;
    (range <= 1.0 && cross <= 1.0).then(|| range.hypot(cross))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn truth_at(range_m: f64, x_m: f64) -> Truth {
        let position_m = DVec3::new(x_m, range_m, 0.0);
        Truth {
            role: Role::Target,
            position_m,
            range_m,
            radial_velocity_mps: 0.0,
            lane: None,
            nearest_range_m: None,
            echo: None,
            sends_back: true,
        }
    }

    fn object_at(range_m: f64, x_m: f64) -> Object {
        Object {
            range_m,
            radial_velocity_mps: 0.0,
            velocity_resolved: false,
            azimuth_rad: 0.0,
            position_m: [x_m, range_m, 0.75],
            lane: None,
            snr_db: 20.0,
            points: 1,
            range_extent_m: [range_m; 2],
            velocity_extent_mps: [0.0; 2],
            ghost_share: 0.0,
        }
    }

    #[test]
    fn the_nearest_object_is_taken_and_serves_one_target_only() {
        let truths = [truth_at(40.0, 2.0), truth_at(41.0, 2.0)];
        let objects = [object_at(40.9, 2.0), object_at(44.5, 2.0)];
        assert_eq!(assign(&Lanes::default(), &truths, &objects), [None, Some(0)]);
    }

    #[test]
    fn clutter_has_no_object_however_near_it_stands() {
        let pole = Truth { role: Role::Clutter, ..truth_at(40.0, 2.0) };
        let objects = [object_at(40.0, 2.0)];
        assert_eq!(assign(&Lanes::default(), &[pole, truth_at(41.0, 2.0)], &objects), [None, Some(0)]);
    }

    #[test]
    fn an_object_outside_the_gates_is_nobodys() {
        let objects = [object_at(44.1, 2.0), object_at(40.0, 5.8)];
        assert_eq!(assign(&Lanes::default(), &[truth_at(40.0, 2.0)], &objects), [None]);
    }
}
