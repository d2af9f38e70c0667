//! Request of a table of S, and the antennas of its aspects.

use crate::bodies::world::World;
use crate::edges::edge_on::{off_faces, sees_along_face};
use crate::geometry::antenna::Antenna;
use crate::integral::polarization::zenith_h;
use crate::mesh::wedges::world_edges::WorldEdges;
use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::settings::{Edges, NodeRule, Sides, SmallParts, Surface};
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::{DQuat, DVec3};
use radar::standpoint::Standpoint;
use std::f64::consts::TAU;

/// Requested S(frequency, elevation, azimuth), body axes.
#[derive(Debug, Clone, PartialEq)]
pub struct RcsRequest {
    /// Axis 0: frequency.
    pub frequency_hz: Vec<f64>,
    /// Axis 1: elevation of the antenna above the horizon.
    pub elevation_rad: Vec<f64>,
    /// Axis 2: azimuth of the antenna, from body x towards body y.
    pub azimuth_rad: Vec<f64>,
    /// Distance from the antenna to the origin; infinite for the far field.
    pub range_m: f64,
    /// Stationary receiver, while the transmitter takes every aspect; `None` if it is the transmitter.
    pub receiver: Option<Standpoint>,
    /// Polarization of the result.
    pub polarization: Polarization,
    /// Highest bounce order, 1 to 5.
    pub bounces: u8,
    /// Node of multiple reflections.
    pub nodes: NodeRule,
    /// Sides of a facet that scatter.
    pub sides: Sides,
    /// Diffraction by edges.
    pub edges: Edges,
    /// Surface that the facets represent.
    pub surface: Surface,
    /// Source of the parts that are smaller than the mesh resolves; random ones are drawn with the seed 0.
    pub small_parts: SmallParts,
    /// Relative amplitude error allowed over the whole table; limited to −160 dB.
    pub accuracy: Accuracy,
}

impl RcsRequest {
    /// S over three axes, with the defaults of `wayside rcs`: one antenna for both directions, infinitely
    /// far; vv; three bounces, the nodes' own edges; two sides of flat facets without diffraction or drawn
    /// parts; −40 dB.
    pub fn over(frequency_hz: Vec<f64>, elevation_rad: Vec<f64>, azimuth_rad: Vec<f64>) -> Self {
        Self {
            frequency_hz,
            elevation_rad,
            azimuth_rad,
            range_m: f64::INFINITY,
            receiver: None,
            polarization: Polarization::Vv,
            bounces: 3,
            nodes: NodeRule::OwnEdge,
            sides: Sides::Two,
            edges: Edges::Ignored,
            surface: Surface::Flat,
            small_parts: SmallParts::OfMesh,
            accuracy: Accuracy::from_db(-40.0),
        }
    }

    /// Wavenumbers k = 2πf/c.
    pub(crate) fn wavenumbers_per_m(&self) -> Vec<f64> {
        self.frequency_hz.iter().map(|f| TAU * f / SPEED_OF_LIGHT_MPS).collect()
    }

    /// Request with infinitely distant antennas moved to this range.
    pub(crate) fn at_range(&self, range_m: f64) -> Self {
        let moved = |at: f64| if at.is_finite() { at } else { range_m };
        let receiver = self.receiver.map(|r| Standpoint { range_m: moved(r.range_m), ..r });
        Self { range_m: moved(self.range_m), receiver, ..self.clone() }
    }
}

fn antenna(at: &Standpoint) -> Antenna {
    if at.range_m.is_finite() {
        Antenna::Point(at.range_m * at.direction())
    } else {
        Antenna::Direction(at.direction())
    }
}

/// Positions of the antennas, with ĥ straight above and below.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Aspect {
    pub(crate) transmit: (Antenna, DVec3),
    /// Receiver; `None` if it is the transmitter.
    pub(crate) receive: Option<(Antenna, DVec3)>,
    /// Whether an antenna sees a face along its plane: the lit part of the face is a sliver, but its edges
    /// count.
    pub(crate) is_along_face: bool,
}

impl Aspect {
    /// Whether a wave is spherical.
    pub(crate) fn is_near(&self) -> bool {
        let near = |antenna: Antenna| matches!(antenna, Antenna::Point(_));
        near(self.transmit.0) || self.receive.is_some_and(|(antenna, _)| near(antenna))
    }

    /// Both antennas rotated about the origin.
    pub(crate) fn turned(&self, by: DQuat) -> Self {
        let turned = |(antenna, zenith_h): (Antenna, DVec3)| (antenna.turned(by), by * zenith_h);
        Self { transmit: turned(self.transmit), receive: self.receive.map(turned), ..*self }
    }

    /// Largest angle between the directions to both antennas, seen from a facet.
    pub(crate) fn apart_rad(&self, world: &World) -> f64 {
        let Some((receive, _)) = self.receive else { return 0.0 };
        let seen_from = |x: DVec3| self.transmit.0.towards(x).angle_between(receive.towards(x));
        world.facets().iter().map(|facet| seen_from(facet.corners_m[0])).fold(0.0, f64::max)
    }
}

/// Aspects, elevation by elevation and azimuth by azimuth.
pub(crate) fn aspects(request: &RcsRequest) -> Vec<Aspect> {
    let of = |elevation_rad: f64, azimuth_rad: f64| {
        let transmitter = Standpoint { azimuth_rad, elevation_rad, range_m: request.range_m };
        Aspect {
            transmit: (antenna(&transmitter), zenith_h(azimuth_rad)),
            receive: request.receiver.map(|r| (antenna(&r), zenith_h(r.azimuth_rad))),
            is_along_face: false,
        }
    };
    request
        .elevation_rad
        .iter()
        .flat_map(|el| request.azimuth_rad.iter().map(move |az| of(*el, *az)))
        .collect()
}

/// Aspects as traced: with edges enabled, no antenna lies in the plane of a face.
pub(crate) fn traced_aspects(request: &RcsRequest, world: &World) -> Vec<Aspect> {
    let asked = aspects(request);
    if request.edges == Edges::Ignored {
        return asked;
    }
    let edges = world.edges(request.wavenumbers_per_m().into_iter().fold(0.0, f64::max));
    asked.into_iter().map(|asked| beside_faces(&asked, edges).unwrap_or(asked)).collect()
}

/// Aspect with its antennas moved out of the planes of faces; `None` if none sees a face along its plane.
pub(crate) fn beside_faces(asked: &Aspect, edges: &WorldEdges) -> Option<Aspect> {
    let off = |(antenna, zenith_h): (Antenna, DVec3)| (off_faces(antenna, edges), zenith_h);
    let mut antennas = [Some(asked.transmit), asked.receive].into_iter().flatten();
    let is_along_face = antennas.any(|(antenna, _)| sees_along_face(antenna, edges));
    is_along_face.then(|| Aspect {
        transmit: off(asked.transmit),
        receive: asked.receive.map(off),
        is_along_face,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::scene::Mesh;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn the_bistatic_angle_is_that_at_the_body_wherever_its_origin_is() {
        let body = |x_m: f64| {
            let vertices_m = vec![[x_m, 0.0, 0.0], [x_m, 0.01, 0.0], [x_m, 0.0, 0.01]];
            World::of_mesh(&Mesh { vertices_m, triangles: vec![[0, 1, 2]], ..Mesh::default() }).unwrap()
        };
        let end = |antenna: Antenna| (antenna, DVec3::Y);
        let aspect = |transmit: Antenna, receive: Antenna| Aspect {
            transmit: end(transmit),
            receive: Some(end(receive)),
            is_along_face: false,
        };
        for x_m in [0.0, -8.0, 30.0] {
            let at = |y_m: f64| Antenna::Point(DVec3::new(x_m + 1.0, y_m, 0.0));
            let apart_rad = aspect(at(1.0), at(-1.0)).apart_rad(&body(x_m));
            // Corners of coordinates up to 30 m are rounded by 4e-15 m.
            assert!((apart_rad - FRAC_PI_2).abs() < 1e-13, "{x_m}: {apart_rad}");
            let far = aspect(Antenna::Direction(DVec3::X), Antenna::Direction(DVec3::Y));
            assert!((far.apart_rad(&body(x_m)) - FRAC_PI_2).abs() < 1e-13);
            assert_eq!(Aspect { receive: None, ..far }.apart_rad(&body(x_m)), 0.0);
        }
    }
}
