//! Places on a path from the transmitter to the receiver.
//!
//! A path record holds the apparent places of its node from both ends, unfolded through the mirrors
//! (`docs/decisions/path-record.md`). Here it is folded back: from each end the straight ray to the apparent
//! place meets the first mirror, is reflected by its plane, and continues to the next. The record does not
//! say which facet is the node's; it is the one at which both ends arrive at the same place. On curved skins
//! the planes are those of the facets, and both ends may miss each other; then the course leads through the
//! centres of the facets, and this is reported.

use artifact::paths::{Facet, Path};
use artifact::radar::Radar;
use artifact::scene::{Mesh, Pose, SceneFrame, SceneHeader, Target};
use glam::{DQuat, DVec3};
use radar::motion::pose_after;

/// Course of a path.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PathCourse {
    /// Places between transmitter and receiver, world metres.
    pub(super) places_m: Vec<DVec3>,
    /// Distance by which both ends miss each other at the node; `None` if the course leads through the
    /// centres of the facets instead.
    pub(super) missed_by_m: Option<f64>,
}

/// Largest distance by which the ends may miss each other; otherwise the course leads through the centres of
/// the facets.
const MISSED_M: f64 = 0.25;

/// Bodies of a frame at its middle, where paths are folded.
pub(super) struct PathFolding<'a> {
    radar_m: DVec3,
    middle_s: f64,
    bodies: Vec<(Option<&'a Mesh>, Pose)>,
    /// Possible reflections of a leg by the road; none if it does not reflect.
    road_turns: &'static [RoadReflection],
}

/// Reflection of a leg by the road.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RoadReflection {
    Never,
    First,
    Last,
}

const WITHOUT_ROAD: &[RoadReflection] = &[RoadReflection::Never];
const WITH_ROAD: &[RoadReflection] = &[RoadReflection::Never, RoadReflection::First, RoadReflection::Last];

impl<'a> PathFolding<'a> {
    /// Bodies of a frame; `view` is its scene.
    pub(super) fn of(view: &'a SceneHeader, frame: &SceneFrame, radar: &Radar) -> Self {
        let middle_s = radar.frame_middle_s();
        let body =
            |(target, pose): (&Target, &Pose)| (view.mesh_of(&target.kind), pose_after(pose, middle_s));
        let bodies = view.targets.iter().zip(&frame.poses).map(body).collect();
        let road_turns = if view.road.is_some() { WITH_ROAD } else { WITHOUT_ROAD };
        Self { radar_m: DVec3::from(radar.position_m), middle_s, bodies, road_turns }
    }

    /// The course of a path; for a wheel that of its hub.
    pub(super) fn way(&self, path: &Path) -> PathCourse {
        let facets = path.sequence();
        let nodes = 0..facets.len().max(1);
        let ways = nodes.filter_map(|node| self.through(path, facets, node));
        let best = ways.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, missed_m)| *missed_m < MISSED_M);
        match best {
            Some((places_m, missed_m)) => PathCourse { places_m, missed_by_m: Some(missed_m) },
            None => PathCourse { places_m: self.middles(path, facets), missed_by_m: None },
        }
    }

    /// The course with the node on one of the facets, and the distance by which both ends miss each other
    /// there.
    fn through(&self, path: &Path, facets: &[Facet], node: usize) -> Option<(Vec<DVec3>, f64)> {
        let curve = &path.curve;
        let seen_tx = self.at_middle(path.apparent_tx_m, path.apparent_tx_mps, curve.apparent_tx_mps2);
        let seen_rx = self.at_middle(path.apparent_rx_m, path.apparent_rx_mps, curve.apparent_rx_mps2);
        let before: Vec<Facet> = facets.iter().take(node).copied().collect();
        let behind: Vec<Facet> = facets.iter().skip(node + 1).rev().copied().collect();
        let (there, back) = (self.legs(seen_tx, &before), self.legs(seen_rx, &behind));
        let pairs = there.iter().flat_map(|there| back.iter().map(move |back| (there, back)));
        let apart_m =
            |(there, back): &(&Vec<DVec3>, &Vec<DVec3>)| Some(there.last()?.distance(*back.last()?));
        let joined = pairs.filter_map(|pair| Some((pair, apart_m(&pair)?)));
        let ((there, back), missed_m) = joined.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some((there.iter().chain(back.iter().rev().skip(1)).copied().collect(), missed_m))
    }

    /// Legs to a node with an apparent place behind some facets, for each possible reflection by the road.
    fn legs(&self, seen: DVec3, facets: &[Facet]) -> Vec<Vec<DVec3>> {
        self.road_turns.iter().filter_map(|turn| self.folded(seen, facets, *turn)).collect()
    }

    fn at_middle(&self, place_m: [f64; 3], mps: [f64; 3], mps2: [f64; 3]) -> DVec3 {
        let t = self.middle_s;
        DVec3::from(place_m) + DVec3::from(mps) * t + 0.5 * DVec3::from(mps2) * t * t
    }

    /// Places from the first mirror to the node; `None` if the ray does not meet a mirror before its end.
    fn folded(&self, seen: DVec3, facets: &[Facet], turn: RoadReflection) -> Option<Vec<DVec3>> {
        let (mut from, mut to, mut places) = (self.radar_m, seen, vec![]);
        let mut mirrored = |to: &mut DVec3, (place, normal): (DVec3, DVec3)| {
            let (before, behind) = (normal.dot(from - place), normal.dot(*to - place));
            if before * behind >= 0.0 {
                return None;
            }
            from += (*to - from) * (before / (before - behind));
            places.push(from);
            *to -= 2.0 * behind * normal;
            Some(())
        };
        if turn == RoadReflection::First {
            mirrored(&mut to, ROAD)?;
        }
        for facet in facets {
            mirrored(&mut to, self.plane(facet)?)?;
        }
        if turn == RoadReflection::Last {
            mirrored(&mut to, ROAD)?;
        }
        places.push(to);
        Some(places)
    }

    /// A place and the normal of a facet's plane.
    fn plane(&self, facet: &Facet) -> Option<(DVec3, DVec3)> {
        let [a, b, c] = self.corners(facet)?;
        Some((a, (b - a).cross(c - a).try_normalize()?))
    }

    fn corners(&self, facet: &Facet) -> Option<[DVec3; 3]> {
        let (mesh, pose) = self.bodies.get(facet.body as usize)?;
        let mesh = (*mesh)?;
        let turn = DQuat::from_rotation_z(pose.yaw_rad);
        let triangle = mesh.triangles.get(facet.triangle as usize)?;
        let corner = |i: u32| Some(turn * DVec3::from(*mesh.vertices_m.get(i as usize)?));
        let place = DVec3::from(pose.position_m);
        Some([place + corner(triangle[0])?, place + corner(triangle[1])?, place + corner(triangle[2])?])
    }

    /// Centres of the facets; the apparent place if there are none.
    fn middles(&self, path: &Path, facets: &[Facet]) -> Vec<DVec3> {
        let middle = |facet| self.corners(facet).map(|[a, b, c]| (a + b + c) / 3.0);
        let middles: Vec<DVec3> = facets.iter().filter_map(middle).collect();
        if middles.is_empty() { vec![DVec3::from(path.apparent_tx_m)] } else { middles }
    }
}

/// A place of the road and its normal.
const ROAD: (DVec3, DVec3) = (DVec3::ZERO, DVec3::Z);

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::paths::MAX_ORDER;

    /// Two plates of 2 m in the planes y = 10 and x = 1, with the radar in the origin at a height of 1 m.
    fn dihedral() -> Mesh {
        Mesh {
            vertices_m: vec![
                [-1.0, 10.0, 0.0],
                [1.0, 10.0, 0.0],
                [0.0, 10.0, 4.0],
                [1.0, 8.0, 0.0],
                [1.0, 10.0, 0.0],
                [1.0, 9.0, 4.0],
            ],
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            ..Mesh::default()
        }
    }

    fn path(tx_m: [f64; 3], rx_m: [f64; 3]) -> Path {
        let mut facets = [Facet::default(); MAX_ORDER];
        facets[1].triangle = 1;
        Path { order: 2, apparent_tx_m: tx_m, apparent_rx_m: rx_m, facets, ..Path::default() }
    }

    fn way(path: &Path) -> PathCourse {
        let mesh = dihedral();
        let pose = Pose {
            position_m: [0.0; 3],
            yaw_rad: 0.0,
            yaw_radps: 0.0,
            velocity_mps: [0.0; 3],
            acceleration_mps2: [0.0; 3],
        };
        let radar_m = DVec3::new(0.0, 0.0, 1.0);
        let bodies = vec![(Some(&mesh), pose)];
        PathFolding { radar_m, middle_s: 0.0, bodies, road_turns: WITH_ROAD }.way(path)
    }

    #[test]
    fn a_double_reflection_is_folded_back_from_the_side_that_mirrors_it() {
        // The node lies on the first plate at (0.5, 10, 1); from behind the second one it appears at x = 1.5.
        let way = way(&path([0.5, 10.0, 1.0], [1.5, 10.0, 1.0]));
        assert_eq!(way.places_m.len(), 2, "{way:?}");
        assert!(way.places_m[0].distance(DVec3::new(0.5, 10.0, 1.0)) < 1e-12, "{way:?}");
        // The ray to (1.5, 10) meets x = 1 at two thirds of its way.
        assert!(way.places_m[1].distance(DVec3::new(1.0, 20.0 / 3.0, 1.0)) < 1e-12, "{way:?}");
        assert!(way.missed_by_m.unwrap() < 1e-12);
    }

    #[test]
    fn ends_that_miss_each_other_lead_through_the_middles_of_the_facets() {
        let way = way(&path([0.5, 10.0, 1.0], [3.5, 10.0, 1.0]));
        assert_eq!(way.missed_by_m, None);
        assert!(way.places_m[0].distance(DVec3::new(0.0, 10.0, 4.0 / 3.0)) < 1e-12, "{way:?}");
    }

    #[test]
    fn a_place_below_the_road_is_seen_in_its_mirror() {
        let one = Path { order: 1, ..path([0.0, 10.0, 1.0], [0.0, 10.0, -1.0]) };
        let way = way(&one);
        assert_eq!(way.places_m, [DVec3::new(0.0, 10.0, 1.0), DVec3::new(0.0, 5.0, 0.0)]);
    }
}
