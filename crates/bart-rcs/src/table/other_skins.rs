//! A table's S beside that of the same body with other skins: of coarser facets, and of sheets that waves
//! pass.

use crate::bodies::world::World;
use crate::oversight::error::BartError;
use crate::surface::skin::{COARSER, Skin, cut_for_apart, told_error};
use crate::table::aspect::{Scattering, scattering};
use crate::table::aspect_settings::{AspectSettings, Check, Checks, IntegralsCheck};
use crate::table::measured_aspects::strongest;
use crate::table::rcs_request::{Aspect, RcsRequest};
use artifact::material::{Makeup, Material, Transmission};
use artifact::scene::Mesh;
use artifact::settings::Surface;
use artifact::units::{SPEED_OF_LIGHT_MPS, amplitude_ratio};

/// Skin fine enough at the highest frequency.
pub(crate) fn skin(request: &RcsRequest) -> Skin {
    let highest_hz = request.frequency_hz.iter().copied().fold(0.0, f64::max);
    Skin::of(request.surface, request.accuracy, SPEED_OF_LIGHT_MPS / highest_hz, request.bounces)
}

/// A table that is done, and what it was made with.
pub(crate) struct OtherSkins<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) request: &'a RcsRequest,
    pub(crate) aspects: &'a [Aspect],
    pub(crate) settings: &'a AspectSettings,
    pub(crate) table: &'a [Scattering],
}

/// Aspects of a table that are traced over coarser facets as well.
const COMPARED: usize = 3;

impl OtherSkins<'_> {
    /// Error by facets in place of a skin: ‖S(of coarser ones) − S‖ over ‖S‖ at the strongest aspects; `None`
    /// where facets are the surface itself.
    pub(crate) fn tessellation(&self, world: &World) -> Result<Option<f64>, BartError> {
        if self.request.surface == Surface::Flat {
            return Ok(None);
        }
        let coarser = World::of_skin(self.mesh, skin(self.request).coarser(COARSER * world.skin_error()))?;
        let settings = AspectSettings { accuracy: 0.1 * self.settings.accuracy, ..self.settings.clone() };
        let (mut differing, mut whole, mut apart_rad) = (0.0, 0.0, 0.0_f64);
        for index in strongest(self.table, COMPARED) {
            apart_rad = apart_rad.max(self.aspects[index].apart_rad());
            let found = scattering(&coarser, &self.aspects[index], &settings, UNCHECKED)?;
            differing += found.difference(&self.table[index]);
            whole += self.table[index].mean_power();
        }
        let cut_for = cut_for_apart(world.skin_error(), apart_rad);
        Ok(Some(told_error(amplitude_ratio(differing, whole), cut_for)))
    }

    /// Ratio ‖S(through sheets) − S‖ over ‖S(through sheets)‖ of first order at the first, middle and last
    /// aspect; `None` where there is no sheet or waves are followed.
    pub(crate) fn transmission_left_out(&self) -> Result<Option<f64>, BartError> {
        let makeup = &self.mesh.makeup;
        if makeup.transmission == Transmission::Followed || !makeup.materials.iter().any(Material::is_sheet) {
            return Ok(None);
        }
        let makeup = Makeup { transmission: Transmission::Followed, ..makeup.clone() };
        let world = World::of_skin(&Mesh { makeup, ..self.mesh.clone() }, skin(self.request))?;
        let count = self.aspects.len();
        let mut checked = vec![0, count / 2, count.saturating_sub(1)];
        checked.dedup();
        checked.retain(|&i| i < count);
        let first = AspectSettings { bounces: 1, ..self.settings.clone() };
        let (mut missing, mut whole) = (0.0, 0.0);
        for i in checked {
            let through = scattering(&world, &self.aspects[i], &first, UNCHECKED)?;
            missing += through.first_order_difference(&self.table[i]);
            whole += through.mean_power();
        }
        Ok(Some(amplitude_ratio(missing, whole)))
    }
}

const UNCHECKED: Checks = Checks { integrals: IntegralsCheck::Skipped, model: Check::Skipped };
