//! Materials of bodies: a conductor, a half-space, or layers on air or metal.
//!
//! This is plain data: `scene` reads it from TOML (`docs/materials.md`), `bart-rcs` computes with it.
//! Permittivities are relative, ε = ε′ − jε″ with e^{jωt}, and independent of frequency: within 76–81 GHz
//! they vary by less than their uncertainty.

use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// Materials of a mesh, and whether waves are transmitted through its sheets.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct MeshMaterials {
    /// Material of each name of [`Mesh::materials`](crate::schemas::scene::Mesh::materials); if empty, every
    /// facet is a perfect conductor.
    pub materials: Vec<Material>,
    /// Whether waves are traced through sheets.
    pub transmission: Transmission,
}

/// Materials of a scene by name; a name that is absent is a perfect conductor.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct MaterialMap {
    /// Pairs of name and material; names are unique.
    pub by_name: Vec<(String, Material)>,
    /// Whether waves are traced through sheets.
    pub transmission: Transmission,
}

impl MaterialMap {
    /// Materials of a mesh whose materials have these names.
    pub fn mesh_materials(&self, names: &[String]) -> MeshMaterials {
        let known =
            |name: &String| self.by_name.iter().find(|(known, _)| known == name).map(|(_, m)| m.clone());
        let materials = names.iter().map(|name| known(name).unwrap_or_default()).collect();
        MeshMaterials { materials, transmission: self.transmission }
    }
}

/// Material of a facet.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub enum Material {
    /// A perfect conductor.
    #[default]
    Conductor,
    /// A half-space of one substance, thick enough that nothing returns from inside.
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

/// Medium behind the last layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Backing {
    /// Air: the layers are a sheet that waves pass through.
    Air,
    /// A perfect conductor.
    Metal,
}

/// Precision to which a thickness is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Thickness {
    /// Exact thickness: reflections from both faces interfere.
    Exact,
    /// Roughly known thickness: powers are averaged over it. 4 mm of glass reflects between −15 and −4 dB
    /// with a period of 0.76 mm at 77 GHz, which no drawing resolves.
    Averaged,
}

/// Whether a wave that meets a sheet continues behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Transmission {
    /// A sheet reflects and shadows what is behind it.
    #[default]
    Ignored,
    /// The wave continues along its line, attenuated and phase-shifted, and returns the same way.
    Followed,
}

impl Material {
    /// Whether waves pass through the material, which then is layers on air.
    pub fn is_sheet(&self) -> bool {
        matches!(self, Self::Layers { backing: Backing::Air, .. })
    }

    /// Permittivities of the material's substances; empty for a conductor.
    pub fn permittivities(&self) -> Vec<Complex64> {
        match self {
            Self::Conductor => vec![],
            Self::HalfSpace { permittivity } => vec![*permittivity],
            Self::Layers { layers, .. } => layers.iter().map(|layer| layer.permittivity).collect(),
        }
    }

    /// Whether the material is physical: no permittivity below that of air or with gain, and layers of
    /// finite, positive thickness.
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

impl MeshMaterials {
    /// Material of a slot; a perfect conductor where none is given.
    pub fn material(&self, slot: u16) -> &Material {
        self.materials.get(usize::from(slot)).unwrap_or(&Material::Conductor)
    }

    /// Whether every facet is a perfect conductor.
    pub fn is_perfect_conductor(&self) -> bool {
        self.materials.iter().all(|material| *material == Material::Conductor)
    }
}

/// The road as a reflecting plane z = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Road {
    /// Material of the road.
    pub material: Material,
    /// Root-mean-square height of the road, m: the coherent reflection is reduced by e^{−g²/2}, g = 4πσ
    /// sinψ/λ (Ament 1953).
    pub rms_height_m: f64,
}
