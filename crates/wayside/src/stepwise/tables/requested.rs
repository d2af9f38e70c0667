//! A table of S as it is asked for: body, axes and settings in the units of the command line.

use crate::stepwise::tables::words::{
    EDGES, NODES, POLARIZATIONS, SIDES, SMALL_PARTS, SURFACES, TRANSMISSION, word_of,
};
use artifact::Accuracy;
use artifact::material::Transmission;
use artifact::radar::Polarization;
use artifact::settings::{Edges, NodeRule, Sides, SmallParts, Surface};
use bart_rcs::{RcsRequest, Standpoint};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Samples or rays per wavelength of the slow references, unless others are asked for.
pub const DENSITY_PER_WAVELENGTH: f64 = 6.0;

/// Body, axes and settings of a table.
#[derive(Debug, Clone)]
pub struct RequestedTable {
    /// Mesh file, or the name of one of the project's vehicles.
    pub mesh: PathBuf,
    /// Metres per unit of the mesh file; `None` for the unit of its format.
    pub unit_scale: Option<f64>,
    /// File of the mesh's materials; `None` if everything conducts.
    pub materials: Option<PathBuf>,
    /// Whether waves are followed through sheets.
    pub transmission: Transmission,
    /// Name of the method.
    pub method: String,
    /// Samples or rays per wavelength of the slow references.
    pub density_per_wavelength: f64,
    /// Axis 0, Hz.
    pub frequency_hz: Vec<f64>,
    /// Axis 1: elevations of the antenna above the horizon, degrees.
    pub elevation_deg: Vec<f64>,
    /// Axis 2: azimuths of the antenna, degrees; 0 faces the front of the body.
    pub azimuth_deg: Vec<f64>,
    /// Distance from the antenna to the mesh's origin, m; infinite for the far field.
    pub range_m: f64,
    /// Stationary receiver; `None` if it is the transmitter.
    pub receiver: Option<RequestedReceiver>,
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
    /// Source of small parts that the mesh lacks.
    pub small_parts: SmallParts,
    /// Allowed relative amplitude error, dB.
    pub accuracy_db: f64,
}

/// Stationary receiver of a table.
#[derive(Debug, Clone, Copy)]
pub struct RequestedReceiver {
    /// Azimuth, degrees.
    pub azimuth_deg: f64,
    /// Elevation above the horizon, degrees.
    pub elevation_deg: f64,
    /// Distance from the mesh's origin, m; `None` for the transmitter's.
    pub range_m: Option<f64>,
}

impl RequestedTable {
    /// Number of frequencies, elevations and azimuths.
    pub fn shape(&self) -> [usize; 3] {
        [self.frequency_hz.len(), self.elevation_deg.len(), self.azimuth_deg.len()]
    }

    /// Request of this table.
    pub fn request(&self) -> RcsRequest {
        RcsRequest {
            frequency_hz: self.frequency_hz.clone(),
            elevation_rad: radians(&self.elevation_deg),
            azimuth_rad: radians(&self.azimuth_deg),
            range_m: self.range_m,
            receiver: self.receiver.map(|receiver| receiver.standpoint(self.range_m)),
            polarization: self.polarization,
            bounces: self.bounces,
            nodes: self.nodes,
            sides: self.sides,
            edges: self.edges,
            surface: self.surface,
            small_parts: self.small_parts,
            accuracy: Accuracy::from_db(self.accuracy_db),
        }
    }

    /// Axes as `S.json` tells them.
    pub(super) fn axes(&self) -> Value {
        json!({ "freq_hz": self.frequency_hz, "el_deg": self.elevation_deg, "az_deg": self.azimuth_deg })
    }

    /// Settings as `S.json` tells them.
    pub(super) fn settings(&self) -> Value {
        let finite = |range: f64| if range.is_finite() { json!(range) } else { json!("inf") };
        // JSON is text; a path may not be.
        let materials = self.materials.as_ref().map(|file| file.to_string_lossy());
        let receiver = self.receiver;
        json!({
            "mesh": self.mesh.to_string_lossy(), "range_m": finite(self.range_m),
            "pol": word_of(&POLARIZATIONS, self.polarization), "bounces": self.bounces,
            "method": self.method, "edges": word_of(&EDGES, self.edges),
            "nodes": word_of(&NODES, self.nodes), "surface": word_of(&SURFACES, self.surface),
            "detail": word_of(&SMALL_PARTS, self.small_parts),
            "sides": word_of(&SIDES, self.sides), "materials": materials,
            "transmission": word_of(&TRANSMISSION, self.transmission), "accuracy_db": self.accuracy_db,
            "rx_az_deg": receiver.map(|receiver| receiver.azimuth_deg),
            "rx_el_deg": receiver.map(|receiver| receiver.elevation_deg),
            "rx_range_m": receiver.and_then(|receiver| receiver.range_m).map(finite),
            "density_per_wavelength": self.density_per_wavelength, "unit_scale": self.unit_scale,
        })
    }
}

impl RequestedReceiver {
    fn standpoint(self, of_transmitter_m: f64) -> Standpoint {
        Standpoint {
            azimuth_rad: self.azimuth_deg.to_radians(),
            elevation_rad: self.elevation_deg.to_radians(),
            range_m: self.range_m.unwrap_or(of_transmitter_m),
        }
    }
}

fn radians(degrees: &[f64]) -> Vec<f64> {
    degrees.iter().map(|angle| angle.to_radians()).collect()
}
