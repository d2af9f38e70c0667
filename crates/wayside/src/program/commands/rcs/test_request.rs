//! A request that the tests of this folder share.

use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::settings::{Edges, NodeRule, Sides, Surface};
use bart_rcs::RcsRequest;

/// A plain request over frequencies and azimuths, far away.
pub(super) fn request_of(frequency_hz: &[f64], azimuth_rad: &[f64]) -> RcsRequest {
    RcsRequest {
        frequency_hz: frequency_hz.to_vec(),
        elevation_rad: vec![0.0],
        azimuth_rad: azimuth_rad.to_vec(),
        range_m: f64::INFINITY,
        receiver: None,
        polarization: Polarization::Vv,
        bounces: 1,
        nodes: NodeRule::OwnEdge,
        edges: Edges::Ignored,
        surface: Surface::Flat,
        sides: Sides::Two,
        accuracy: Accuracy::from_db(-40.0),
    }
}
