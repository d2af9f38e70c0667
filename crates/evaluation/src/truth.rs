//! Ground truth of each target of a frame. Only reports use it: no processing behind the radar cube does.

use crate::ground_outline::GroundOutline;
use artifact::Radar;
use artifact::paths::{Path, PathsFrame};
use artifact::scene::{Pose, Role, SceneFrame, SceneHeader, TargetKind};
use glam::DVec3;
use radar::aperture::{axes, pattern_amplitude};
use radar::path_echo::gain_along;
use radar::path_kinematics::{legs, mean_share, nodes};

/// Ground truth of one target at the frame's middle, seen from the radar's position.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    /// World position of the body's origin, m.
    pub position_m: DVec3,
    /// The ground that it covers.
    pub outline: GroundOutline,
    /// Distance of the position from the radar, m.
    pub range_m: f64,
    /// World velocity, m/s.
    pub velocity_mps: DVec3,
    /// Rate of the range, m/s.
    pub radial_velocity_mps: f64,
    /// Number of the lane that contains the position.
    pub lane: Option<u8>,
    /// Distance of the nearest lit surface, m; `None` if all is hidden or nothing was traced.
    pub nearest_range_m: Option<f64>,
    /// Range and radial velocity of the target's own echo; `None` if there is none or nothing was traced.
    pub echo: Option<MeanEcho>,
    /// Target or clutter; results are not compared with clutter.
    pub role: Role,
    /// Whether the array receives an echo of the body alone; echoes of tables are not traced, and are assumed
    /// if the array has gain towards the body's origin.
    pub returns_echo: bool,
}

impl Truth {
    /// Whether the radar should find it: a target that returns any echo from within the maximum unambiguous
    /// range.
    pub fn is_detectable(&self, range_max_m: f64) -> bool {
        self.role == Role::Target
            && self.returns_echo
            && self.echo.map_or(self.range_m, |e| e.range_m) <= range_max_m
    }
}

/// Power-weighted means over the paths that touch only this target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanEcho {
    /// Half the two-way length, m.
    pub range_m: f64,
    /// Half the rate of the two-way length, m/s.
    pub radial_velocity_mps: f64,
}

/// Truths in the order of the scene's targets; `paths` is `None` if the echo was made from tables.
pub fn truths(header: &SceneHeader, frame: &SceneFrame, paths: Option<&PathsFrame>) -> Vec<Truth> {
    let of = |(i, pose): (usize, &Pose)| truth(header, i, pose, paths);
    frame.poses.iter().enumerate().map(of).collect()
}

fn truth(header: &SceneHeader, index: usize, pose: &Pose, paths: Option<&PathsFrame>) -> Truth {
    let pose = &radar::motion::pose_after(pose, header.radar.frame_middle_s());
    let of_origin = (DVec3::from(pose.position_m), DVec3::from(pose.velocity_mps));
    let (position_m, velocity_mps) = paths.and_then(|p| on_rim(header, index, &p.paths)).unwrap_or(of_origin);
    let away = position_m - DVec3::from(header.radar.position_m);
    let range_m = away.length();
    let echo = paths.and_then(|p| echo(header, index, &p.paths));
    Truth {
        role: header.targets[index].role,
        position_m,
        outline: outline(header, index, pose),
        range_m,
        velocity_mps,
        radial_velocity_mps: velocity_mps.dot(away) / range_m,
        lane: header.dsp.road.at(pose.position_m),
        nearest_range_m: paths.and_then(|p| p.nearest_range_m.get(index).copied().flatten()),
        echo,
        returns_echo: paths.map_or_else(|| is_in_field_of_view(&header.radar, away), |_| echo.is_some()),
    }
}

/// Whether the elements have any gain in the direction of an offset.
pub(crate) fn is_in_field_of_view(radar: &Radar, away_m: DVec3) -> bool {
    pattern_amplitude(radar, &axes(radar), away_m.normalize_or_zero()) != 0.0
}

/// Place and velocity of a point on the rim of a wheel; its pose is that of the hub.
fn on_rim(header: &SceneHeader, index: usize, paths: &[Path]) -> Option<(DVec3, DVec3)> {
    let TargetKind::Point { wheel: Some(_), .. } = header.targets[index].kind else { return None };
    let is_it = |path: &&Path| path.target as usize == index && path.curve.rim.is_some();
    paths.iter().find(is_it).map(|path| nodes(&header.radar, path)[0])
}

fn outline(header: &SceneHeader, index: usize, pose: &Pose) -> GroundOutline {
    let mesh = header.mesh_of(&header.targets[index].kind);
    mesh.map_or(GroundOutline::of_point(pose), |mesh| GroundOutline::of_mesh(mesh, pose))
}

fn echo(header: &SceneHeader, target: usize, paths: &[Path]) -> Option<MeanEcho> {
    let (mut weight, mut range, mut velocity) = (0.0, 0.0, 0.0);
    for path in paths.iter().filter(|p| is_wholly_on(target, p) && is_received(&header.radar, p)) {
        let (power, echo) = received(&header.radar, path);
        weight += power;
        range += power * echo.range_m;
        velocity += power * echo.radial_velocity_mps;
    }
    (weight > 0.0).then(|| MeanEcho { range_m: range / weight, radial_velocity_mps: velocity / weight })
}

/// Whether a path touches only this target: a path over two vehicles appears at neither, as a ghost.
fn is_wholly_on(target: usize, path: &Path) -> bool {
    path.target as usize == target && path.sequence().iter().all(|facet| facet.body as usize == target)
}

/// Whether the elements have any gain at both ends of a path.
fn is_received(radar: &Radar, path: &Path) -> bool {
    legs(radar, path).iter().all(|leg| is_in_field_of_view(radar, leg.direction))
}

/// Power of a path up to a common factor, |a|²/(L₁L₂)² times both ends' gains and its mean share over the
/// frame (the shares of a path traced at several moments add up to 1), with half its length and rate at the
/// frame's middle.
fn received(radar: &Radar, path: &Path) -> (f64, MeanEcho) {
    let both @ [there, back] = legs(radar, path);
    let (receive, transmit) = radar.array.polarization.indices();
    let of_whole = path.amplitude_m[receive][transmit].norm_sqr() / (there.length_m * back.length_m).powi(2);
    let gain = gain_along(radar, &both);
    let power = mean_share(radar, path) * of_whole * gain.powi(2);
    let range_m = 0.5 * (there.length_m + back.length_m);
    let echo = MeanEcho { range_m, radial_velocity_mps: 0.5 * (there.rate_mps + back.rate_mps) };
    (power, echo)
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::pattern::Pattern;
    use radar::aperture::Preset;
    use radar::paper;

    fn path_to(at_m: [f64; 3]) -> Path {
        Path::of_point(at_m, [0.0; 3], [[1.0.into(); 2]; 2])
    }

    /// The far end of a bus, 60° aside: a quarter of the gain there, and of that on the way back.
    #[test]
    fn an_echo_weighs_as_much_as_is_heard_of_it() {
        let mut radar = paper::radar([0.0; 3], paper::waveform(64, 16), Preset::OneByFour.elements());
        let (sin, cos) = std::f64::consts::FRAC_PI_3.sin_cos();
        let ends = [path_to([0.0, 10.0, 0.0]), path_to([10.0 * sin, 10.0 * cos, 0.0])];
        let ratio = |radar: &Radar| received(radar, &ends[1]).0 / received(radar, &ends[0]).0;
        assert!((ratio(&radar) - 1.0).abs() < 1e-12);
        radar.array.pattern = Pattern::Cosine { exponent: 2.0 };
        assert!((ratio(&radar) * 256.0 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_path_from_behind_a_cosine_pattern_is_not_heard() {
        let mut radar = paper::radar([0.0; 3], paper::waveform(64, 16), Preset::OneByFour.elements());
        let from = |y_m: f64| path_to([1.0, y_m, 0.0]);
        assert!(is_received(&radar, &from(-15.0)), "an isotropic element hears all around");
        radar.array.pattern = Pattern::Cosine { exponent: 1.0 };
        assert_eq!([30.0, -15.0].map(|y_m| is_received(&radar, &from(y_m))), [true, false]);
        assert_eq!(
            [30.0, -15.0].map(|y_m| is_in_field_of_view(&radar, DVec3::new(1.0, y_m, 0.0))),
            [true, false]
        );
    }
}
