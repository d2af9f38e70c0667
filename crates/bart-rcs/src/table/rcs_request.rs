//! Request of a table of S, and the antennas of its aspects.

use crate::bodies::world::World;
use crate::edges::edge_on::{off_faces, sees_along_face};
use crate::geometry::antenna::Antenna;
use crate::integral::polarization::zenith_h;
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

    /// Angle between the directions to both antennas, seen from the origin.
    pub(crate) fn apart_rad(&self) -> f64 {
        let towards = |antenna: Antenna| antenna.towards(DVec3::ZERO);
        self.receive.map_or(0.0, |(receive, _)| towards(self.transmit.0).angle_between(towards(receive)))
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
    let off = |(antenna, zenith_h): (Antenna, DVec3)| (off_faces(antenna, edges), zenith_h);
    let aspect = |asked: Aspect| {
        let mut antennas = [Some(asked.transmit), asked.receive].into_iter().flatten();
        match antennas.any(|(antenna, _)| sees_along_face(antenna, edges)) {
            true => {
                Aspect { transmit: off(asked.transmit), receive: asked.receive.map(off), is_along_face: true }
            }
            false => asked,
        }
    };
    asked.into_iter().map(aspect).collect()
}
