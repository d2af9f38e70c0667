//! Materials of bodies: a conductor, a half-space, or layers on air or metal.
//!
//! Plain data; `bart-rcs` computes with it, `scene` reads it from TOML (`docs/materials.md`). Permittivities
//! are relative, ε = ε′ − jε″ with e^{jωt}, and do not depend on frequency: within 76–81 GHz they change by
//! less than they are known.

use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// Materials of a mesh, and whether waves go through its sheets.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Makeup {
    /// Material of each name of [`Mesh::materials`](crate::schemas::scene::Mesh::materials); empty:
    /// everything conducts.
    pub materials: Vec<Material>,
    /// Whether waves are followed through sheets.
    pub transmission: Transmission,
}

/// Materials of a scene by their names; a name that is not there is a perfect conductor.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct MaterialMap {
    /// Name and material; names are unique.
    pub by_name: Vec<(String, Material)>,
    /// Whether waves are followed through sheets.
    pub transmission: Transmission,
}

impl MaterialMap {
    /// The makeup of a mesh with these names of materials.
    pub fn makeup(&self, names: &[String]) -> Makeup {
        let known =
            |name: &String| self.by_name.iter().find(|(known, _)| known == name).map(|(_, m)| m.clone());
        let materials = names.iter().map(|name| known(name).unwrap_or_default()).collect();
        Makeup { materials, transmission: self.transmission }
    }
}

/// Material of a facet.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub enum Material {
    /// A perfect conductor.
    #[default]
    Conductor,
    /// Filled with one substance, thick enough that nothing comes back from inside.
    HalfSpace {
        /// Relative permittivity ε′ − jε″.
        permittivity: Complex64,
    },
    /// Plane layers, the outermost first.
    Layers {
        /// Layers, the outermost first; at least one.
        layers: Vec<Layer>,
        /// Medium behind the last layer.
        backing: Backing,
        /// Whether the thickness is known to a fraction of a wavelength.
        thickness: Thickness,
    },
}

/// A plane layer of one substance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Layer {
    /// Thickness of the layer.
    pub thickness_m: f64,
    /// Relative permittivity ε′ − jε″.
    pub permittivity: Complex64,
}

/// Medium that layers lie on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Backing {
    /// Air: a sheet that waves pass.
    Air,
    /// A perfect conductor.
    Metal,
}

/// Precision to which a thickness is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Thickness {
    /// The thickness is exact: reflections of both faces interfere.
    Exact,
    /// The thickness is known only roughly: powers are averaged over it. 4 mm of glass reflects between −15
    /// and −4 dB with a period of 0.76 mm at 77 GHz, which no drawing tells.
    Averaged,
}

/// Whether a wave that meets a sheet goes on behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Transmission {
    /// A sheet reflects, and hides what is behind it.
    #[default]
    Ignored,
    /// The wave goes on along its line, weakened and shifted, and comes back the same way.
    Followed,
}

impl Material {
    /// Whether waves pass the material: layers on air.
    pub fn is_sheet(&self) -> bool {
        matches!(self, Self::Layers { backing: Backing::Air, .. })
    }

    /// Permittivities of what the material consists of; none of a conductor.
    pub fn permittivities(&self) -> Vec<Complex64> {
        match self {
            Self::Conductor => vec![],
            Self::HalfSpace { permittivity } => vec![*permittivity],
            Self::Layers { layers, .. } => layers.iter().map(|layer| layer.permittivity).collect(),
        }
    }

    /// Whether the material is possible: no permittivity below that of air or with a gain, and layers with
    /// a thickness.
    pub fn is_sound(&self) -> bool {
        let can_be = |e: Complex64| e.is_finite() && e.re >= 1.0 && e.im <= 0.0;
        match self {
            Self::Conductor => true,
            Self::HalfSpace { permittivity } => can_be(*permittivity),
            Self::Layers { layers, .. } => {
                let is_thick = |layer: &Layer| layer.thickness_m.is_finite() && layer.thickness_m > 0.0;
                !layers.is_empty() && layers.iter().all(|layer| is_thick(layer) && can_be(layer.permittivity))
            }
        }
    }
}

impl Makeup {
    /// The material of a slot; a conductor where nothing is said.
    pub fn material(&self, slot: u16) -> &Material {
        self.materials.get(usize::from(slot)).unwrap_or(&Material::Conductor)
    }

    /// Whether every facet is a perfect conductor.
    pub fn conducts_all_over(&self) -> bool {
        self.materials.iter().all(|material| *material == Material::Conductor)
    }
}

/// The road as a plane z = 0 that reflects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Road {
    /// Material of the road.
    pub material: Material,
    /// Root mean square of the road's height, m: the coherent reflection loses e^{−g²/2}, g = 4πσ sinψ/λ
    /// (Ament 1953).
    pub rms_height_m: f64,
}
