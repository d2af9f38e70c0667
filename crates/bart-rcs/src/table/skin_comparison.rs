//! Comparison of a table's S with that of the same body with other skins: with coarser facets, and with
//! transmission through sheets.

use crate::bodies::world::World;
use crate::run_control::cancellation::CancellationCheck;
use crate::run_control::error::BartError;
use crate::surface::skin::{COARSER, FinerSkin, Skin, cut_for_bistatic, reported_error};
use crate::table::aspect::{Scattering, scattering};
use crate::table::aspect_settings::{AspectSettings, Check, Checks, IntegralsCheck};
use crate::table::measured_aspects::strongest;
use crate::table::rcs_request::{Aspect, RcsRequest};
use artifact::material::{Material, MeshMaterials, Transmission};
use artifact::scene::Mesh;
use artifact::settings::Surface;
use artifact::units::{SPEED_OF_LIGHT_MPS, amplitude_ratio};
use glam::{DQuat, DVec3};
use std::f64::consts::{PI, TAU};

/// Skin that is fine enough at the highest frequency.
pub(crate) fn skin(request: &RcsRequest) -> Skin {
    let highest_hz = request.frequency_hz.iter().copied().fold(0.0, f64::max);
    Skin::of(request.surface, request.accuracy, SPEED_OF_LIGHT_MPS / highest_hz, request.bounces)
}

/// A finished table, and the inputs with which it was made.
pub(crate) struct SkinComparison<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) request: &'a RcsRequest,
    pub(crate) aspects: &'a [Aspect],
    pub(crate) settings: &'a AspectSettings,
    pub(crate) table: &'a [Scattering],
    pub(crate) cancellation: CancellationCheck<'a>,
}

/// Number of a table's aspects that are also traced with coarser facets.
const COMPARED: usize = 3;
/// Maximum number of facets for comparing finer ones also at a lobe beside each aspect.
const FEW_FACETS: usize = 500;

impl SkinComparison<'_> {
    /// Error of facets in place of a skin: ‖S(of coarser ones) − S‖ over ‖S‖ at the strongest aspects, or
    /// with finer ones where these show more and are affordable ([`FinerSkin`]); `None` if facets are the
    /// surface itself.
    pub(crate) fn tessellation(&self, world: &World) -> Result<Option<f64>, BartError> {
        if self.request.surface == Surface::Flat {
            return Ok(None);
        }
        let coarser = World::of_skin(self.mesh, skin(self.request).coarser(COARSER * world.skin_error()))?;
        let settings = AspectSettings { accuracy: 0.1 * self.settings.accuracy, ..self.settings.clone() };
        let (mut differing, mut whole, mut apart_rad) = (0.0, 0.0, 0.0_f64);
        let compared = strongest(self.table, COMPARED);
        for &index in &compared {
            self.cancellation.check()?;
            apart_rad = apart_rad.max(self.aspects[index].apart_rad(world));
            let found = scattering(&coarser, &self.aspects[index], &settings, UNCHECKED)?;
            differing += found.difference(&self.table[index]);
            whole += self.table[index].mean_power();
        }
        if let Some((finer, over_difference)) = self.finer(world, &coarser)? {
            let turn_rad = (world.facets().len() <= FEW_FACETS).then(|| self.lobe_rad());
            let by_finer = |&index: &usize| {
                self.cancellation.check()?;
                differing_about(&self.aspects[index], turn_rad, [world, &finer], &settings)
            };
            let powers = compared.iter().map(by_finer).collect::<Result<Vec<_>, _>>()?;
            differing = differing.max(over_difference.powi(2) * powers.iter().sum::<f64>());
        }
        let cut_for = cut_for_bistatic(world.skin_error(), apart_rad);
        Ok(Some(reported_error(amplitude_ratio(differing, whole), cut_for)))
    }

    /// World with finer facets, if coarser ones show too little and finer ones are affordable, with the ratio
    /// of the error to the difference.
    fn finer(&self, world: &World, coarser: &World) -> Result<Option<(World, f64)>, BartError> {
        let own = world.facets().len();
        let Some(cut) = FinerSkin::affordable(own, coarser.facets().len(), self.request.bounces) else {
            return Ok(None);
        };
        let finer = World::of_skin(self.mesh, skin(self.request).finer(cut.times))?;
        Ok(Some((finer, cut.over_difference())).filter(|(finer, _)| finer.facets().len() > own))
    }

    /// Width of a lobe of the body's extent D at the highest frequency, λ/2D; at most a hundredth of a turn.
    fn lobe_rad(&self) -> f64 {
        let extent_m = DVec3::from_array(self.mesh.size_m()).length();
        let highest_per_m = self.settings.wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
        (PI / (highest_per_m * extent_m)).min(TAU / 100.0)
    }

    /// Ratio ‖S(through sheets) − S‖ over ‖S(through sheets)‖ in first order at the first, middle and last
    /// aspect; `None` if there is no sheet or transmission is traced.
    pub(crate) fn transmission_left_out(&self) -> Result<Option<f64>, BartError> {
        let makeup = &self.mesh.makeup;
        if makeup.transmission == Transmission::Followed || !makeup.materials.iter().any(Material::is_sheet) {
            return Ok(None);
        }
        let makeup = MeshMaterials { transmission: Transmission::Followed, ..makeup.clone() };
        let world = World::of_skin(&Mesh { makeup, ..self.mesh.clone() }, skin(self.request))?;
        let count = self.aspects.len();
        let mut checked = vec![0, count / 2, count.saturating_sub(1)];
        checked.dedup();
        checked.retain(|&i| i < count);
        let first = AspectSettings { bounces: 1, ..self.settings.clone() };
        let (mut missing, mut whole) = (0.0, 0.0);
        for i in checked {
            self.cancellation.check()?;
            let through = scattering(&world, &self.aspects[i], &first, UNCHECKED)?;
            missing += through.first_order_difference(&self.table[i]);
            whole += through.mean_power();
        }
        Ok(Some(amplitude_ratio(missing, whole)))
    }
}

/// Mean power of the difference between two worlds at an aspect and, if a lobe is given, at two beside it,
/// each about another axis: at a single one it may vanish by chance. If no antenna can stand beside it, the
/// aspect alone.
fn differing_about(
    aspect: &Aspect,
    turn_rad: Option<f64>,
    worlds: [&World; 2],
    settings: &AspectSettings,
) -> Result<f64, BartError> {
    let differing = |aspect: &Aspect| -> Result<f64, BartError> {
        let [one, other] = worlds.map(|world| scattering(world, aspect, settings, UNCHECKED));
        Ok(one?.difference(&other?))
    };
    let (antenna, zenith_h) = aspect.transmit;
    let across = zenith_h.cross(antenna.towards(DVec3::ZERO).normalize_or_zero());
    let beside = [zenith_h + across, zenith_h - across].into_iter().filter_map(|axis| {
        differing(&aspect.turned(DQuat::from_axis_angle(axis.try_normalize()?, turn_rad?))).ok()
    });
    let powers: Vec<f64> = [differing(aspect)?].into_iter().chain(beside).collect();
    Ok(powers.iter().sum::<f64>() / powers.len() as f64)
}

const UNCHECKED: Checks = Checks { integrals: IntegralsCheck::Skipped, model: Check::Skipped };
