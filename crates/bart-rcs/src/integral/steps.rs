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
pub(crate) struct Steps {
    /// Surfaces other than perfect mirrors; `None` if all are perfect, in which case
    /// [`Mirrors`](crate::integral::polarization::Mirrors) suffices.
    steps: Option<Arc<[Step]>>,
}

/// One surface on a path.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    pub(crate) normal: DVec3,
    pub(crate) material: Arc<Material>,
    pub(crate) event: Event,
}

/// Interaction of a wave with a surface.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Event {
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
    Turned(Box<Turn>),
}

/// Transformation of a wave: its direction of travel by a matrix, its field by `sign` times it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Turn {
    matrix: DMat3,
    sign: f64,
}

impl Steps {
    /// Path over these surfaces; all of them are given, including perfect mirrors, consecutive ones of which
    /// are merged into one transformation.
    pub(crate) fn over(steps: &[Step]) -> Self {
        if steps.iter().all(Step::is_perfect) {
            return Self::default();
        }
        let runs = steps.chunk_by(|a, b| a.is_perfect() && b.is_perfect());
        let joined = |run: &[Step]| if run[0].is_perfect() { Step::turned(run) } else { run[0].clone() };
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
        let weakened = |(strength, travel): (f64, DVec3), step: &Step| {
            (strength * step.strength(travel, wavenumber_per_m), step.turn(travel))
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

    fn steps(&self) -> &[Step] {
        self.steps.as_deref().unwrap_or(&[])
    }
}

impl Step {
    /// Reflection at a facet.
    pub(crate) fn reflected(world: &World, facet: u32) -> Self {
        let material = world.lossy_material(facet).cloned().unwrap_or_default();
        Self { normal: world.facet(facet).normal(), material, event: Event::Reflected }
    }

    /// Passage through a sheet.
    pub(crate) fn passed(world: &World, facet: u32) -> Self {
        Self { event: Event::Passed, ..Self::reflected(world, facet) }
    }

    /// Start at the antenna's image.
    pub(crate) fn started_below() -> Self {
        Self { normal: DVec3::Z, material: Arc::default(), event: Event::StartedBelow }
    }

    /// Reflection at the road.
    pub(crate) fn crossed(road: &Road) -> Self {
        let event = Event::Crossed { rms_height_m: road.rms_height_m };
        Self { normal: DVec3::Z, material: Arc::new(road.material.clone()), event }
    }

    /// Whether it is a perfect mirror, as the antenna's image is.
    fn is_perfect(&self) -> bool {
        let is_mirror = matches!(self.event, Event::Reflected | Event::StartedBelow | Event::Turned(_));
        is_mirror && *self.material == Material::Conductor
    }

    /// Merges perfect mirrors.
    fn turned(mirrors: &[Self]) -> Self {
        let start = (DMat3::IDENTITY, 1.0);
        let (matrix, sign) = mirrors.iter().fold(start, |(turn, sign), mirror| {
            let of_mirror =
                DMat3::from_cols(mirror.turn(DVec3::X), mirror.turn(DVec3::Y), mirror.turn(DVec3::Z));
            // A conductor maps e to −e + 2n(n·e), minus the reflection.
            (of_mirror * turn, if mirror.event == Event::Reflected { -sign } else { sign })
        });
        Self {
            normal: DVec3::Z,
            material: Arc::default(),
            event: Event::Turned(Box::new(Turn { matrix, sign })),
        }
    }

    /// Direction of travel behind the surface.
    fn turn(&self, travel: DVec3) -> DVec3 {
        match &self.event {
            Event::Reflected => travel - 2.0 * self.normal.dot(travel) * self.normal,
            Event::StartedBelow => below(travel),
            Event::Turned(turn) => turn.matrix * travel,
            Event::Crossed { .. } | Event::Passed => travel,
        }
    }

    /// Coefficients of the surface; `None` for a transformation.
    fn coefficients(&self, travel: DVec3, wavenumber_per_m: f64) -> Option<PolarizationPair> {
        let cosine = self.normal.dot(travel).abs();
        match &self.event {
            Event::Reflected => Some(reflection(&self.material, cosine, wavenumber_per_m)),
            Event::Passed => Some(transmission(&self.material, cosine, wavenumber_per_m)),
            Event::Crossed { rms_height_m } => {
                Some(crossing(&self.material, *rms_height_m, cosine, wavenumber_per_m))
            }
            Event::StartedBelow | Event::Turned(_) => None,
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
            (Event::Reflected, Some(r)) => reflected_fields(fields, travel, self.normal, r),
            (_, Some(t)) => transmitted_fields(fields, travel, self.normal, t),
            (Event::Turned(turn), None) => fields.map(|field| field.turned(turn.matrix * turn.sign)),
            (_, None) => fields.map(ComplexVector::with_z_turned),
        };
        (fields, self.turn(travel))
    }
}
