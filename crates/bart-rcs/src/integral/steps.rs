//! What a wave meets on its way between an antenna and a node, where not everything is a perfect mirror.

use crate::bodies::road::{below, crossing};
use crate::bodies::world::World;
use crate::geometry::complex_vector::ComplexVector;
use crate::materials::surface_response::{
    phase_length_m, reflected_field, reflection, steepness, transmission, transmitted_field,
};
use artifact::material::{Material, Road};
use glam::DVec3;
use std::sync::Arc;

/// The surfaces between an antenna and a node, the antenna's first.
#[derive(Debug, Clone, Default)]
pub(crate) struct Steps {
    /// `None` where all of them are perfect mirrors: [`Mirrors`](crate::integral::polarization::Mirrors) knows enough then.
    steps: Option<Arc<[Step]>>,
}

/// One surface on a way.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    pub(crate) normal: DVec3,
    pub(crate) material: Arc<Material>,
    pub(crate) event: Event,
}

/// What becomes of a wave at a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Event {
    /// It goes on reflected.
    Reflected,
    /// It goes on as it came, behind a sheet.
    Passed,
    /// It starts at the antenna's image below the road.
    StartedBelow,
    /// It is reflected by the road, and goes on as it came in the picture below it.
    Crossed {
        /// Of the road.
        rms_height_m: f64,
    },
}

impl Steps {
    /// A way over these surfaces; all of them, the perfect mirrors too.
    pub(crate) fn over(steps: Vec<Step>) -> Self {
        Self { steps: Some(steps.into()) }
    }

    /// Whether there are perfect mirrors only, or nothing at all.
    pub(crate) fn is_perfect(&self) -> bool {
        self.steps.is_none()
    }

    /// The field that arrives where `sent` left along `travel`.
    pub(crate) fn carry(&self, sent: DVec3, travel: DVec3, wavenumber_per_m: f64) -> ComplexVector {
        let start = (ComplexVector::from(sent), travel);
        self.steps().iter().fold(start, |(field, travel), step| step.pass(field, travel, wavenumber_per_m)).0
    }

    /// Sum of the surfaces' [`steepness`].
    pub(crate) fn steepness(&self, wavenumber_per_m: f64) -> f64 {
        self.steps().iter().map(|step| steepness(&step.material, wavenumber_per_m)).sum()
    }

    /// Sum of d(phase)/dk of the layers, m.
    pub(crate) fn phase_length_m(&self) -> f64 {
        self.steps().iter().map(|step| phase_length_m(&step.material)).sum()
    }

    fn steps(&self) -> &[Step] {
        self.steps.as_deref().unwrap_or(&[])
    }
}

impl Step {
    /// At a facet.
    pub(crate) fn reflected(world: &World, facet: u32) -> Self {
        let material = world.lossy_material(facet).cloned().unwrap_or_default();
        Self { normal: world.facet(facet).normal(), material, event: Event::Reflected }
    }

    /// Through a sheet.
    pub(crate) fn passed(world: &World, facet: u32) -> Self {
        Self { event: Event::Passed, ..Self::reflected(world, facet) }
    }

    /// At the antenna's image.
    pub(crate) fn started_below() -> Self {
        Self { normal: DVec3::Z, material: Arc::default(), event: Event::StartedBelow }
    }

    /// At the road.
    pub(crate) fn crossed(road: &Road) -> Self {
        let event = Event::Crossed { rms_height_m: road.rms_height_m };
        Self { normal: DVec3::Z, material: Arc::new(road.material.clone()), event }
    }

    /// Whether it is a perfect mirror.
    pub(crate) fn is_perfect(&self) -> bool {
        self.event == Event::Reflected && *self.material == Material::Conductor
    }

    fn pass(&self, field: ComplexVector, travel: DVec3, wavenumber_per_m: f64) -> (ComplexVector, DVec3) {
        let Self { normal, material, event } = self;
        let cosine = normal.dot(travel).abs();
        match event {
            Event::Reflected => {
                let r = reflection(material, cosine, wavenumber_per_m);
                (reflected_field(field, travel, *normal, r), travel - 2.0 * normal.dot(travel) * *normal)
            }
            Event::StartedBelow => (field.with_z_turned(), below(travel)),
            Event::Crossed { rms_height_m } => {
                let r = crossing(material, *rms_height_m, cosine, wavenumber_per_m);
                (transmitted_field(field, travel, *normal, r), travel)
            }
            Event::Passed => {
                let t = transmission(material, cosine, wavenumber_per_m);
                (transmitted_field(field, travel, *normal, t), travel)
            }
        }
    }
}
