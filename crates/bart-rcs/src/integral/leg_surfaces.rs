//! Surfaces on the path of a wave between an antenna and a node, where not all are perfect mirrors.

use crate::bodies::road::crossing;
use crate::bodies::road_mirror::below;
use crate::bodies::world::World;
use crate::materials::reflection_coefficients::PolarizationPair;
use crate::materials::surface_response::{
    reflected_fields, reflection, steepness, transmission, transmitted_fields, turning_length_m,
};
use artifact::material::{Material, Road};
use glam::{DMat3, DVec3};
use radar::complex_vector::ComplexVector;
use std::sync::Arc;

/// Surfaces between an antenna and a node, the antenna's first.
#[derive(Debug, Clone, Default)]
pub(crate) struct LegSurfaces {
    /// Surfaces other than perfect mirrors; `None` if all are perfect, in which case
    /// [`Mirrors`](crate::integral::polarization::Mirrors) suffices.
    steps: Option<Arc<[LegSurface]>>,
}

/// One surface on a path.
#[derive(Debug, Clone)]
pub(crate) struct LegSurface {
    pub(crate) normal: DVec3,
    pub(crate) material: Arc<Material>,
    pub(crate) event: Interaction,
}

/// Interaction of a wave with a surface.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Interaction {
    /// The wave is reflected.
    Reflected,
    /// The wave continues unchanged in direction behind a sheet.
    Passed,
    /// The wave starts at the antenna's image below the road.
    StartedBelow,
    /// The wave is reflected by the road, and continues unchanged in the unfolded image below it.
    Crossed {
        /// Root-mean-square height of the road.
        rms_height_m: f64,
    },
    /// The wave is transformed by perfect mirrors; boxed because these are few and sheets many, which are
    /// kept small.
    Turned(Box<MirrorTransform>),
}

/// Transformation of a wave: its direction of travel by a matrix, its field by `sign` times it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MirrorTransform {
    matrix: DMat3,
    sign: f64,
}

impl LegSurfaces {
    /// Path over these surfaces; all of them are given, including perfect mirrors, consecutive ones of which
    /// are merged into one transformation.
    pub(crate) fn over(steps: &[LegSurface]) -> Self {
        if steps.iter().all(LegSurface::is_perfect) {
            return Self::default();
        }
        let runs = steps.chunk_by(|a, b| a.is_perfect() && b.is_perfect());
        let joined =
            |run: &[LegSurface]| if run[0].is_perfect() { LegSurface::turned(run) } else { run[0].clone() };
        Self { steps: Some(runs.map(joined).collect()) }
    }

    /// Whether there are only perfect mirrors, or no surfaces.
    pub(crate) fn is_perfect(&self) -> bool {
        self.steps.is_none()
    }

    /// Fields that arrive when `sent` departs along `travel`.
    pub(crate) fn carry(&self, sent: [DVec3; 2], travel: DVec3, wavenumber_per_m: f64) -> [ComplexVector; 2] {
        let start = (sent.map(ComplexVector::from), travel);
        self.steps()
            .iter()
            .fold(start, |(fields, travel), step| step.pass(fields, travel, wavenumber_per_m))
            .0
    }

    /// Maximum share of a field departing along `travel` that can remain.
    pub(crate) fn strength(&self, travel: DVec3, wavenumber_per_m: f64) -> f64 {
        let weakened = |(strength, travel): (f64, DVec3), step: &LegSurface| {
            (strength * step.strength(travel, wavenumber_per_m), step.reflect(travel))
        };
        self.steps().iter().fold((1.0, travel), weakened).0
    }

    /// Sum of the surfaces' [`steepness`].
    pub(crate) fn steepness(&self, wavenumber_per_m: f64) -> f64 {
        self.steps().iter().map(|step| steepness(&step.material, wavenumber_per_m)).sum()
    }

    /// Sum of d(phase)/dk of the layers, m.
    pub(crate) fn turning_length_m(&self) -> f64 {
        self.steps().iter().map(|step| turning_length_m(&step.material)).sum()
    }

    fn steps(&self) -> &[LegSurface] {
        self.steps.as_deref().unwrap_or(&[])
    }
}

impl LegSurface {
    /// Reflection at a facet.
    pub(crate) fn reflected(world: &World, facet: u32) -> Self {
        let material = world.lossy_material(facet).cloned().unwrap_or_default();
        Self { normal: world.facet(facet).normal(), material, event: Interaction::Reflected }
    }

    /// Passage through a sheet.
    pub(crate) fn passed(world: &World, facet: u32) -> Self {
        Self { event: Interaction::Passed, ..Self::reflected(world, facet) }
    }

    /// Start at the antenna's image.
    pub(crate) fn started_below() -> Self {
        Self { normal: DVec3::Z, material: Arc::default(), event: Interaction::StartedBelow }
    }

    /// Reflection at the road.
    pub(crate) fn crossed(road: &Road) -> Self {
        let event = Interaction::Crossed { rms_height_m: road.rms_height_m };
        Self { normal: DVec3::Z, material: Arc::new(road.material.clone()), event }
    }

    /// Whether it is a perfect mirror, as the antenna's image is.
    fn is_perfect(&self) -> bool {
        let is_mirror =
            matches!(self.event, Interaction::Reflected | Interaction::StartedBelow | Interaction::Turned(_));
        is_mirror && *self.material == Material::Conductor
    }

    /// Merges perfect mirrors.
    fn turned(mirrors: &[Self]) -> Self {
        let start = (DMat3::IDENTITY, 1.0);
        let (matrix, sign) = mirrors.iter().fold(start, |(turn, sign), mirror| {
            let of_mirror = DMat3::from_cols(
                mirror.reflect(DVec3::X),
                mirror.reflect(DVec3::Y),
                mirror.reflect(DVec3::Z),
            );
            // A conductor maps e to −e + 2n(n·e), minus the reflection.
            (of_mirror * turn, if mirror.event == Interaction::Reflected { -sign } else { sign })
        });
        Self {
            normal: DVec3::Z,
            material: Arc::default(),
            event: Interaction::Turned(Box::new(MirrorTransform { matrix, sign })),
        }
    }

    /// Direction of travel behind the surface.
    fn reflect(&self, travel: DVec3) -> DVec3 {
        match &self.event {
            Interaction::Reflected => travel - 2.0 * self.normal.dot(travel) * self.normal,
            Interaction::StartedBelow => below(travel),
            Interaction::Turned(turn) => turn.matrix * travel,
            Interaction::Crossed { .. } | Interaction::Passed => travel,
        }
    }

    /// Coefficients of the surface; `None` for a transformation.
    fn coefficients(&self, travel: DVec3, wavenumber_per_m: f64) -> Option<PolarizationPair> {
        let cosine = self.normal.dot(travel).abs();
        match &self.event {
            Interaction::Reflected => Some(reflection(&self.material, cosine, wavenumber_per_m)),
            Interaction::Passed => Some(transmission(&self.material, cosine, wavenumber_per_m)),
            Interaction::Crossed { rms_height_m } => {
                Some(crossing(&self.material, *rms_height_m, cosine, wavenumber_per_m))
            }
            Interaction::StartedBelow | Interaction::Turned(_) => None,
        }
    }

    fn strength(&self, travel: DVec3, wavenumber_per_m: f64) -> f64 {
        self.coefficients(travel, wavenumber_per_m).map_or(1.0, |r| r.te.norm().max(r.tm.norm()))
    }

    fn pass(
        &self,
        fields: [ComplexVector; 2],
        travel: DVec3,
        wavenumber_per_m: f64,
    ) -> ([ComplexVector; 2], DVec3) {
        let fields = match (&self.event, self.coefficients(travel, wavenumber_per_m)) {
            (Interaction::Reflected, Some(r)) => reflected_fields(fields, travel, self.normal, r),
            (_, Some(t)) => transmitted_fields(fields, travel, self.normal, t),
            (Interaction::Turned(turn), None) => fields.map(|field| field.turned(turn.matrix * turn.sign)),
            (_, None) => fields.map(ComplexVector::mirrored_in_z),
        };
        (fields, self.reflect(travel))
    }
}
