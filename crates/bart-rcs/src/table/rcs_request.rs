//! Request of a table of S, and the antennas of its aspects.

use crate::geometry::antenna::Antenna;
use crate::integral::polarization::zenith_h;
use crate::table::aspect::Aspect;
use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::settings::{Edges, NodeRule, Sides, Surface};
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use std::f64::consts::TAU;

/// S(frequency, elevation, azimuth) that is asked for; body axes.
#[derive(Debug, Clone, PartialEq)]
pub struct RcsRequest {
    /// Axis 0.
    pub frequency_hz: Vec<f64>,
    /// Axis 1: of the antenna above the horizon.
    pub elevation_rad: Vec<f64>,
    /// Axis 2: of the antenna, from body x towards body y.
    pub azimuth_rad: Vec<f64>,
    /// Antenna to origin; infinite for the far field.
    pub range_m: f64,
    /// A receiver that stands still while the transmitter takes every aspect; `None` where it is the
    /// transmitter.
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
    /// Surface that the facets stand for.
    pub surface: Surface,
    /// Relative amplitude error allowed over the whole table; not carried below −160 dB.
    pub accuracy: Accuracy,
}

/// Place of an antenna, seen from the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standpoint {
    /// Azimuth from body x towards body y.
    pub azimuth_rad: f64,
    /// Elevation above the horizon.
    pub elevation_rad: f64,
    /// Distance to the origin; infinite for the far field.
    pub range_m: f64,
}

impl RcsRequest {
    /// Wavenumbers k = 2πf/c.
    pub(crate) fn wavenumbers_per_m(&self) -> Vec<f64> {
        self.frequency_hz.iter().map(|f| TAU * f / SPEED_OF_LIGHT_MPS).collect()
    }

    /// The request with antennas that are infinitely far at this range instead.
    pub(crate) fn at_range(&self, range_m: f64) -> Self {
        let moved = |at: f64| if at.is_finite() { at } else { range_m };
        let receiver = self.receiver.map(|r| Standpoint { range_m: moved(r.range_m), ..r });
        Self { range_m: moved(self.range_m), receiver, ..self.clone() }
    }
}

impl Standpoint {
    /// Unit vector from the origin.
    pub fn direction(&self) -> DVec3 {
        let (sin_el, cos_el) = self.elevation_rad.sin_cos();
        let (sin_az, cos_az) = self.azimuth_rad.sin_cos();
        DVec3::new(cos_el * cos_az, cos_el * sin_az, sin_el)
    }

    fn antenna(&self) -> Antenna {
        if self.range_m.is_finite() {
            Antenna::Point(self.range_m * self.direction())
        } else {
            Antenna::Direction(self.direction())
        }
    }
}

/// Elevation by elevation, azimuth by azimuth.
pub(crate) fn aspects(request: &RcsRequest) -> Vec<Aspect> {
    let of = |elevation_rad: f64, azimuth_rad: f64| {
        let transmitter = Standpoint { azimuth_rad, elevation_rad, range_m: request.range_m };
        Aspect {
            transmit: (transmitter.antenna(), zenith_h(azimuth_rad)),
            receive: request.receiver.map(|r| (r.antenna(), zenith_h(r.azimuth_rad))),
        }
    };
    request
        .elevation_rad
        .iter()
        .flat_map(|el| request.azimuth_rad.iter().map(move |az| of(*el, *az)))
        .collect()
}
