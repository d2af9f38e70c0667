//! What the facets of a mesh stand for: themselves, or the curved skin that they were cut from.

use crate::curved_skin::CurvedSkin;
use artifact::Accuracy;
use artifact::scene::Mesh;
use artifact::settings::Surface;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// How a mesh becomes facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Skin {
    /// As it is.
    Flat,
    /// Facets whose sides are within `sagitta_m` of the curves that the normals at their ends tell of.
    Smooth {
        /// m; at least 1e-9.
        sagitta_m: f64,
    },
}

/// Triangles that stand for a mesh.
pub(crate) struct SkinTriangles {
    /// Body metres.
    pub(crate) triangles_m: Vec<[DVec3; 3]>,
    /// Which of the mesh's triangles each is a part of.
    pub(crate) triangle_of: Vec<u32>,
    /// Unit normals at the corners: a smooth skin's; those that the file stores for a flat one, empty where it does not.
    pub(crate) corner_normals: Vec<[DVec3; 3]>,
    /// How far from the skin the triangles may be, m; 0 where they are the surface.
    pub(crate) sagitta_m: f64,
}

/// Most facets that a mesh is cut into, about: a facet takes some 500 bytes with its plane, hierarchy and shadow, so these
/// are 1 GiB. A skin that asks for more is cut as fine as this allows.
const FACETS_MAX: f64 = (1 << 21) as f64;

impl Skin {
    /// So fine that facets in place of the skin err by `accuracy` at this wavelength.
    ///
    /// A facet of chord a across a radius ρ lies a²/12ρ below its arc in the mean, 2/3 of its sagitta s = a²/8ρ; one across
    /// both radii of a sphere lies s below it. The phase there and back is wrong by 2ks at most: 4πs/λ of the amplitude.
    pub fn of(surface: Surface, accuracy: Accuracy, wavelength_m: f64) -> Self {
        match surface {
            Surface::Flat => Self::Flat,
            Surface::Smooth => Self::Smooth { sagitta_m: accuracy.amplitude() * wavelength_m / (4.0 * PI) },
        }
    }

    /// The amplitude's relative error of facets that are as far as this from their skin.
    pub(crate) fn error_of(sagitta_m: f64, wavelength_m: f64) -> f64 {
        4.0 * PI * sagitta_m / wavelength_m
    }

    /// Triangles for a mesh whose own have these corners.
    pub(crate) fn triangles(self, mesh: &Mesh, corners_m: Vec<[DVec3; 3]>) -> SkinTriangles {
        match self {
            Self::Flat => {
                let triangle_of = (0..corners_m.len() as u32).collect();
                let normal = |vertex: &u32| mesh.normals.get(*vertex as usize).map(|n| Vec3::from_array(*n).as_dvec3());
                let of_triangle = |[a, b, c]: &[u32; 3]| Some([normal(a)?, normal(b)?, normal(c)?]);
                let corner_normals = mesh.triangles.iter().map_while(of_triangle).collect();
                SkinTriangles { triangles_m: corners_m, triangle_of, corner_normals, sagitta_m: 0.0 }
            }
            Self::Smooth { sagitta_m } => {
                let skin = CurvedSkin::of(mesh, &corners_m);
                let most = FACETS_MAX.max(2.0 * corners_m.len() as f64);
                let mut sagitta_m = sagitta_m.max(1e-9);
                while skin.expected(sagitta_m) > most {
                    sagitta_m *= 2.0;
                }
                skin.triangles(&corners_m, sagitta_m)
            }
        }
    }
}

impl SkinTriangles {
    /// Bytes held, about.
    pub(crate) fn bytes(&self) -> usize {
        self.triangles_m.len() * (2 * size_of::<[DVec3; 3]>() + size_of::<u32>())
    }
}
