//! Surface that the facets of a mesh represent: themselves, or the curved skin that they approximate.

use crate::surface::curved_skin::CurvedSkin;
use crate::surface::refinement::BendLimits;
use crate::surface::skin_triangles::SkinTriangles;
use artifact::Accuracy;
use artifact::scene::Mesh;
use artifact::settings::Surface;
use glam::{DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Conversion of a mesh into facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Skin {
    /// The mesh unchanged.
    Flat,
    /// Facets curved according to the normals at their corners, so small that they err by a fraction of the
    /// amplitude.
    Smooth {
        /// Relative amplitude error allowed for the size of facets; at least 1e-6.
        accuracy: Accuracy,
        /// Shortest wavelength.
        wavelength_m: f64,
        /// Whether facets reflect onto others, as from the second order on.
        role: Role,
        /// Number of times that all limits are doubled.
        doublings: u32,
    },
}

/// Whether facets reflect onto others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Directly lit facets scatter, but do not reflect onto others.
    Scatterers,
    /// Each facet is also a flat mirror for the next.
    Mirrors,
}

/// Approximate maximum number of facets of a mesh: a facet and its beam take some 3 kB (measured on a car of
/// 10 077 triangles in 0.9 million facets), so these are 1.5 GiB. A skin that requires more is subdivided as
/// finely as this permits, and reports it.
const FACETS_MAX: usize = 1 << 19;

/// Share of the requested accuracy allotted to the approximation of a skin by facets.
const SKIN_SHARE: f64 = 0.6;

/// Share of the requested accuracy left by a skin with [`SKIN_SHARE`]: √(1 − 0.6²). Flat facets are the
/// surface, and leave all of it.
pub(crate) fn remaining_share(surface: Surface) -> f64 {
    match surface {
        Surface::Flat => 1.0,
        Surface::Smooth => (1.0 - SKIN_SHARE * SKIN_SHARE).sqrt(),
    }
}

/// Coarseness of the facets with which a skin's error is measured, as a factor of the error for which they
/// are subdivided.
///
/// If a mesh determines its skin, the error falls with that of the subdivision, and the difference to coarser
/// facets is three times the error. If triangles are so long, or turn so far, that their corners' normals do
/// not determine the surface between them to a fraction of the wavelength, each subdivision is another skin,
/// and both err by 1/√2 of the difference.
pub(crate) const COARSER: f64 = 4.0;

/// Approximate maximum number of facets of a body in a comparison with finer facets than its own.
///
/// For a doubly curved skin the number of facets grows by the factor by which the error falls. Mirrors send
/// beams from each to each, so fewer are affordable.
const FINER_FACETS: usize = 32_000;
const FINER_MIRRORS: usize = 8_000;
/// Factors by which the error of the finer facets is smaller, finest first.
const FINER_TIMES: [f64; 3] = [64.0, 16.0, 4.0];

/// A comparison with finer facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FinerSkin {
    /// Factor by which the error of their subdivision is smaller.
    pub(crate) times: f64,
}

impl FinerSkin {
    /// Finest affordable comparison for a number of facets and bounces; `None` if coarser facets reveal the
    /// error.
    ///
    /// For a single bounce the limits ensure this for a skin with far fewer coarser facets. From the second
    /// bounce on a facet is a flat mirror, whose sagitta does not determine how it shows the next one, and
    /// two skins that are both too coarse may differ little.
    pub(crate) fn affordable(facets: usize, coarser: usize, bounces: u8) -> Option<Self> {
        if bounces < 2 && 2 * coarser <= facets {
            return None;
        }
        let most = if bounces < 2 { FINER_FACETS } else { FINER_MIRRORS };
        let fits = |times: &f64| facets as f64 * times <= most as f64;
        FINER_TIMES.into_iter().find(fits).map(|times| Self { times })
    }

    /// Ratio of the error to the difference, if errors scale with those of the subdivision.
    pub(crate) fn over_difference(self) -> f64 {
        1.0 / (1.0 - 1.0 / self.times)
    }
}

/// Error reported for facets subdivided for `cut_for`, from the relative difference to [`COARSER`] ones. For
/// a mesh finer than both subdivisions the difference is zero, and at few frequencies and aspects it may
/// vanish by chance: at least half of the subdivision's error is reported.
pub(crate) fn reported_error(difference: f64, cut_for: f64) -> f64 {
    difference.hypot(0.5 * cut_for)
}

/// Error possible for facets subdivided for `cut_for` if both antennas are this angle apart, seen from the
/// body.
///
/// A facet at the terminator is lit or not as a whole ([`limits`]). For one position the weight of the lit
/// part falls to zero there, leaving half of a facet's turn θ; for two it falls to half of sin β, so that the
/// error is (θ + sin β)/θ times as large.
pub(crate) fn cut_for_bistatic(cut_for: f64, apart_rad: f64) -> f64 {
    let turn_rad = turn_rad(cut_for);
    if turn_rad > 0.0 { cut_for * (1.0 + apart_rad.min(FRAC_PI_2).sin() / turn_rad) } else { cut_for }
}

impl Skin {
    /// Skin requested by a run, with its share of the run's accuracy.
    pub fn of(surface: Surface, accuracy: Accuracy, wavelength_m: f64, bounces: u8) -> Self {
        let accuracy = accuracy.share(SKIN_SHARE);
        let role = if bounces > 1 { Role::Mirrors } else { Role::Scatterers };
        match surface {
            Surface::Flat => Self::Flat,
            Surface::Smooth => Self::Smooth { accuracy, wavelength_m, role, doublings: 0 },
        }
    }

    /// The skin with limits coarser by the ratio of this relative amplitude error to its own.
    pub(crate) fn coarser(self, error: f64) -> Self {
        match self {
            Self::Flat => Self::Flat,
            Self::Smooth { accuracy, wavelength_m, role, .. } => {
                let doublings = (error / least_error(accuracy)).log2().round().max(0.0) as u32;
                Self::Smooth { accuracy, wavelength_m, role, doublings }
            }
        }
    }

    /// The skin subdivided for an error `times` smaller.
    pub(crate) fn finer(self, times: f64) -> Self {
        match self {
            Self::Flat => Self::Flat,
            Self::Smooth { accuracy, wavelength_m, role, doublings } => {
                Self::Smooth { accuracy: accuracy.share(1.0 / times), wavelength_m, role, doublings }
            }
        }
    }

    /// Triangles for a mesh whose own have these corners.
    pub(crate) fn triangles(self, mesh: &Mesh, corners_m: Vec<[DVec3; 3]>) -> SkinTriangles {
        let Self::Smooth { accuracy, wavelength_m, role, doublings } = self else {
            return flat(mesh, corners_m);
        };
        let skin = CurvedSkin::of(mesh, &corners_m);
        let most = FACETS_MAX.max(2 * corners_m.len());
        let mut error = least_error(accuracy);
        let mut limits = limits(error, wavelength_m, role);
        for _ in 0..doublings {
            error *= 2.0;
            limits = limits_coarser(limits);
        }
        while skin.count(&limits) > most {
            error *= 2.0;
            limits = limits_coarser(limits);
        }
        SkinTriangles { error, ..skin.facets(&corners_m, &limits) }
    }
}

/// Relative amplitude error for which facets are subdivided.
fn least_error(accuracy: Accuracy) -> f64 {
    accuracy.amplitude().max(1e-6)
}

/// Limits on facets for a relative amplitude error.
///
/// - A curved facet that misses the skin by s shifts the phase by 2ks two-way: s ≤ λ·error/4π.
/// - A facet at the terminator is lit or not as a whole. Where it ends, the weight is half of its turn θ
///   instead of zero, and an integral along the wave that ends with weight w leaves w/2k. The rim of a sphere
///   consists of 2πρ/a facets of chord a = θρ with independent phases: √(2πρ/a)·a·½θ/2k·k/√π over √π·ρ, or
///   0.2θ^{3/2}, doubled for facets seen corner on.
/// - A mirror is flat: its strips leave gaps, which its neighbours' diffraction fills only if q = a/√(ρλ) is
///   below ½: s = q²λ/8.
fn limits(error: f64, wavelength_m: f64, role: Role) -> BendLimits {
    let sagitta_m = match role {
        Role::Scatterers => f64::INFINITY,
        Role::Mirrors => wavelength_m / 32.0,
    };
    BendLimits { sagitta_m, turn_rad: turn_rad(error), offset_m: wavelength_m * error / (4.0 * PI) }
}

/// Turn of facets whose rim errs by this share of the amplitude.
fn turn_rad(error: f64) -> f64 {
    (2.5 * error).powf(2.0 / 3.0)
}

/// Limits for twice the error.
fn limits_coarser(limits: BendLimits) -> BendLimits {
    BendLimits {
        sagitta_m: 2.0 * limits.sagitta_m,
        turn_rad: 2.0_f64.powf(2.0 / 3.0) * limits.turn_rad,
        offset_m: 2.0 * limits.offset_m,
    }
}

/// The mesh unchanged.
fn flat(mesh: &Mesh, corners_m: Vec<[DVec3; 3]>) -> SkinTriangles {
    let normal = |vertex: &u32| mesh.normals.get(*vertex as usize).map(|n| Vec3::from_array(*n).as_dvec3());
    let of_triangle = |[a, b, c]: &[u32; 3]| Some([normal(a)?, normal(b)?, normal(c)?]);
    SkinTriangles {
        triangle_of: (0..corners_m.len() as u32).collect(),
        triangles_m: corners_m,
        corner_normals: mesh.triangles.iter().map_while(of_triangle).collect(),
        ..SkinTriangles::default()
    }
}
