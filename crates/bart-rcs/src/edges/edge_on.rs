//! Antennas in the plane of a face, of a sheet or of a closed body's wall: no polygon of the face is lit
//! there, and edges without another lit face are silent, while the field is continuous from one side to the
//! other. Such an antenna is moved out of the plane by a distance that is negligible in phase.

use crate::edges::fringe::{EDGE_ON_RAD, LEAST_SINE};
use crate::geometry::antenna::Antenna;
use crate::mesh::wedges::wedge::Wedge;
use crate::mesh::wedges::world_edges::{EdgeGeometry, WorldEdges};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

/// Angle by which an antenna is moved, rad: beyond the edge-on limit (fringe.rs, 1e-9) even if it leaves a
/// plane obliquely, and over 10 m at 77 GHz a phase of 3e-4 rad.
const ASIDE_RAD: f64 = 2e-8;
/// Angle to the plane of a sheet within which it shows slivers that may be dropped as too small, with their
/// edges, rad.
const SLIVER_OF_SHEET_RAD: f64 = 1e-3;
/// The same angle for walls of closed bodies, rad: for bodies with some thousand walls one of thirty aspects
/// is that near to one.
const SLIVER_OF_WALL_RAD: f64 = 1e-5;
/// Number of directions tried for moving an antenna out of the planes of faces.
const DIRECTIONS: u32 = 16;

/// Antenna moved out of the planes of all faces that have an edge across its line of sight.
pub(crate) fn off_faces(antenna: Antenna, edges: &WorldEdges) -> Antenna {
    let in_plane: Vec<(DVec3, &EdgeGeometry)> = edges
        .edges
        .iter()
        .flat_map(|edge| normals_if_edge_on(antenna, edge, |_| EDGE_ON_RAD).map(move |normal| (normal, edge)))
        .collect();
    let Some((first, edge)) = in_plane.first() else { return antenna };
    let middle_m = edge.point_m(0.5 * edge.length_m);
    let sight = antenna.travel_direction_at(middle_m);
    let turned = |step| DQuat::from_axis_angle(sight, f64::from(step) * PI / f64::from(DIRECTIONS)) * *first;
    let least = |aside: DVec3| in_plane.iter().map(|(n, _)| n.dot(aside).abs()).fold(1.0, f64::min);
    let better = |a: DVec3, b: DVec3| if least(b) > least(a) { b } else { a };
    let aside = (0..DIRECTIONS).map(turned).fold(*first, better);
    match antenna {
        Antenna::Point(p) => Antenna::Point(p + ASIDE_RAD * p.distance(middle_m) * aside),
        Antenna::Direction(r) => Antenna::Direction((r + ASIDE_RAD * aside).try_normalize().unwrap_or(r)),
    }
}

/// Whether the antenna sees a face at such a grazing angle that it shows only a sliver.
pub(crate) fn sees_along_face(antenna: Antenna, edges: &WorldEdges) -> bool {
    let within_rad =
        |wedge: &Wedge| if wedge.is_of_sheet() { SLIVER_OF_SHEET_RAD } else { SLIVER_OF_WALL_RAD };
    edges.edges.iter().any(|edge| normals_if_edge_on(antenna, edge, within_rad).next().is_some())
}

/// Normals of the faces at an edge whose planes contain the antenna to within an angle, if it sees the edge.
fn normals_if_edge_on(
    antenna: Antenna,
    edge: &EdgeGeometry,
    within_rad: impl Fn(&Wedge) -> f64,
) -> impl Iterator<Item = DVec3> {
    let (wedge, sight) = (edge.wedge, antenna.travel_direction_at(edge.point_m(0.5 * edge.length_m)));
    let within_rad = within_rad(&wedge);
    let is_seen = wedge.along.cross(sight).length() > LEAST_SINE;
    let faces = if wedge.is_of_sheet() { 1 } else { 2 };
    let is_edge_on = move |normal: &DVec3| is_seen && normal.dot(sight).abs() < within_rad;
    wedge.normal.into_iter().take(faces).filter(is_edge_on)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::world::World;
    use artifact::scene::Mesh;

    /// Two sheets of a metre: one in the plane y = 0, one in z = 0, apart.
    fn sheets() -> World {
        let at = |x: f64, y: f64, z: f64| [x, y, z];
        let vertices_m = vec![
            at(0.0, 0.0, 0.0),
            at(1.0, 0.0, 0.0),
            at(1.0, 0.0, 1.0),
            at(0.0, 0.0, 1.0),
            at(0.0, 2.0, 0.0),
            at(1.0, 2.0, 0.0),
            at(1.0, 3.0, 0.0),
            at(0.0, 3.0, 0.0),
        ];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        World::of_mesh(&Mesh { vertices_m, triangles, ..Mesh::default() }).unwrap()
    }

    #[test]
    fn an_antenna_leaves_the_planes_of_all_sheets_that_it_sees_edge_on_and_no_other_moves() {
        let world = sheets();
        let edges = world.edges(1600.0);
        let Antenna::Direction(moved) = off_faces(Antenna::Direction(DVec3::X), edges) else { panic!() };
        assert!(moved.y.abs() > 5.0 * EDGE_ON_RAD && moved.z.abs() > 5.0 * EDGE_ON_RAD, "{moved}");
        assert!(moved.distance(DVec3::X) < 1.01 * ASIDE_RAD);
        let aslant = Antenna::Direction(DVec3::new(0.6, 0.48, 0.64));
        assert_eq!(off_faces(aslant, edges), aslant);
        let near = Antenna::Point(DVec3::new(9.0, 0.0, 0.5));
        let Antenna::Point(moved) = off_faces(near, edges) else { panic!() };
        assert!(moved.y.abs() > 5e-8 && moved.distance(DVec3::new(9.0, 0.0, 0.5)) < 2e-7, "{moved}");
    }
}
