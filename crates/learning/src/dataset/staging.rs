//! A drawn scene with its meshes: vehicles placed in front of the radar of its base scene.

use crate::dataset::draws::{self, DrawnScene, Drive, Vehicle};
use crate::dataset::placement::BodyOnRoad;
use crate::dataset::recipe::{Base, Model, NEAREST_ALONG_M, Recipe};
use artifact::scene::{Mesh, Role, SceneHeader, Target, TargetKind};
use artifact::settings::{Class, Fidelity, Noise, SmallParts};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Number of attempts after which a vehicle without room is left out.
const TRIES: usize = 32;
/// Least and greatest gap from bumper to bumper in a queue, m.
const QUEUE_GAP_M: [f64; 2] = [2.0, 4.0];
/// Interval of measurements: all frames of a scene take over the errors of its first.
const MEASURED_EVERY: u32 = 1_000_000;

/// A scene ready to be computed.
pub(super) struct StagedScene {
    pub(super) header: SceneHeader,
    /// Vehicles that found room, in the order of the targets.
    pub(super) vehicles: Vec<VehicleDescription>,
}

/// Description of a vehicle in lines and samples, without its estimates.
pub(super) struct VehicleDescription {
    pub(super) class: Class,
    pub(super) model: String,
    pub(super) variant: u64,
    pub(super) yaw_rad: f64,
}

/// The base scene with these vehicles as its only targets; those without room are left out.
pub(super) fn stage(recipe: &Recipe, drawn: &DrawnScene) -> StagedScene {
    let base = before_radar(recipe, drawn);
    let mesh = |vehicle: &Vehicle| model(recipe, vehicle).mesh(vehicle.variant, drawn.base, &base);
    let all: Vec<Mesh> = drawn.vehicles.iter().map(mesh).collect();
    let places = Road { recipe, drawn, base: &base }.places(&all);
    let (mut meshes, mut targets, mut vehicles) = (Vec::new(), Vec::new(), Vec::<VehicleDescription>::new());
    for ((vehicle, mesh), place) in drawn.vehicles.iter().zip(all).zip(places) {
        let Some(place) = place else { continue };
        let told = describe(recipe, vehicle);
        // Errors measured for a body in one scene apply to the corresponding body in another.
        let number = 1 + vehicles.iter().filter(|before| before.class == told.class).count();
        let id = format!("{}-{number}", told.class.name());
        let kind = TargetKind::Mesh {
            class: Some(told.class),
            model: told.model.clone(),
            mesh: vehicles.len() as u32,
        };
        targets.push(Target { id, role: Role::Target, kind, start: place.pose(&base) });
        meshes.push(mesh);
        vehicles.push(told);
    }
    StagedScene { header: SceneHeader { meshes: meshes.into(), targets, ..base }, vehicles }
}

fn model<'r>(recipe: &'r Recipe, vehicle: &Vehicle) -> &'r Model {
    &recipe.models[&vehicle.class][vehicle.model]
}

fn describe(recipe: &Recipe, vehicle: &Vehicle) -> VehicleDescription {
    let Vehicle { class, variant, yaw_rad, .. } = *vehicle;
    VehicleDescription { class, model: model(recipe, vehicle).name.clone(), variant, yaw_rad }
}

/// The base scene without targets, with its radar mounted as drawn.
fn before_radar(recipe: &Recipe, drawn: &DrawnScene) -> SceneHeader {
    let Base { header: base, .. } = &recipe.bases[drawn.base];
    let [_, _, height_m] = base.radar.position_m;
    let height_m = drawn.radar_height_m.unwrap_or(height_m);
    let tilt_rad = drawn.tilt_rad.unwrap_or(base.radar.boresight_el_rad);
    let small_parts = if drawn.is_statistical { SmallParts::Statistical } else { base.fidelity.small_parts };
    let fidelity = Fidelity { measured_every: MEASURED_EVERY, small_parts, ..base.fidelity };
    SceneHeader {
        name: format!("dataset-{}", drawn.number),
        seed: draws::noise_seed(recipe.seed, drawn.number),
        frames: recipe.document.frames,
        frame_interval_s: recipe.document.frame_interval_s.unwrap_or(base.frame_interval_s),
        radar: radar::aperture::remounted(&base.radar, height_m, tilt_rad),
        noise: noisier(base.noise, drawn.extra_noise_db),
        fidelity,
        meshes: vec![].into(),
        targets: vec![],
        traffic: None,
        ..base.clone()
    }
}

fn noisier(noise: Noise, extra_db: f64) -> Noise {
    match noise {
        Noise::Absent => Noise::Absent,
        Noise::Figure { noise_figure_db, temperature_k } => {
            Noise::Figure { noise_figure_db: noise_figure_db + extra_db, temperature_k }
        }
        Noise::SnrDb(snr_db) => Noise::SnrDb(snr_db - extra_db),
    }
}

/// Road of the base scene, on which the drawn vehicles are placed.
struct Road<'a> {
    recipe: &'a Recipe,
    drawn: &'a DrawnScene,
    base: &'a SceneHeader,
}

/// A placed vehicle.
#[derive(Clone, Copy)]
struct PlacedVehicle {
    lane: u8,
    place: BodyOnRoad,
}

impl Road<'_> {
    /// Places of the vehicles; `None` without room.
    fn places(&self, meshes: &[Mesh]) -> Vec<Option<BodyOnRoad>> {
        let mut random = draws::stream(self.recipe, "dataset/places", &[self.drawn.number]);
        let mut before: Vec<PlacedVehicle> = Vec::new();
        let mut places = Vec::new();
        for (number, (vehicle, mesh)) in self.drawn.vehicles.iter().zip(meshes).enumerate() {
            let first = (number == 0).then_some(self.drawn.first);
            let placed = (0..TRIES).find_map(|_| {
                let drive = first.unwrap_or_else(|| draws::drive(self.recipe, &mut random));
                self.place(drive, vehicle, mesh, &before, &mut random)
            });
            before.extend(placed);
            places.push(placed.map(|placed| placed.place));
        }
        places
    }

    fn place(
        &self,
        drive: Drive,
        vehicle: &Vehicle,
        mesh: &Mesh,
        before: &[PlacedVehicle],
        random: &mut ChaCha8Rng,
    ) -> Option<PlacedVehicle> {
        let speed_mps = self.drawn.queue_mps.unwrap_or(drive.speed_mps);
        let across_m = self.across_m(drive.lane) + vehicle.offset_m;
        let at = |along_m: f64| {
            BodyOnRoad::of([across_m, along_m], half_extent_m(mesh), speed_mps, vehicle.yaw_rad)
        };
        let mut place = at(self.along_m(across_m, drive.range_m));
        let last = before
            .iter()
            .rev()
            .find(|other| other.lane == drive.lane)
            .filter(|_| self.drawn.queue_mps.is_some());
        if let Some(PlacedVehicle { place: last, .. }) = last {
            let gap_m = draws::within(QUEUE_GAP_M, random.random());
            place = at(last.at_m[1] + last.half_along_m() + gap_m + place.half_along_m());
        }
        let is_clear = before.iter().all(|other| place.is_clear_of(&other.place, self.seconds()));
        is_clear.then_some(PlacedVehicle { lane: drive.lane, place })
    }

    fn across_m(&self, lane: u8) -> f64 {
        let known = self.base.dsp.road.lanes.iter().find(|l| l.number == lane);
        known.map_or_else(|| self.base.dsp.road.across_along_m(self.base.radar.position_m)[0], |l| l.centre_m)
    }

    /// Position along the road, m, at which the slant range of the body's origin is `range_m`; `across_m` is
    /// its position across the road. If the lane is farther from the radar than that, the body is placed as
    /// near as possible.
    fn along_m(&self, across_m: f64, range_m: f64) -> f64 {
        let radar_m = self.base.radar.position_m;
        let [radar_across_m, radar_along_m] = self.base.dsp.road.across_along_m(radar_m);
        let sideways_m2 = radar_m[2].powi(2) + (across_m - radar_across_m).powi(2);
        radar_along_m + (range_m.powi(2) - sideways_m2).max(NEAREST_ALONG_M.powi(2)).sqrt()
    }

    /// Time from the beginning of the first frame to the end of the last, s.
    fn seconds(&self) -> f64 {
        let last = self.base.frames - 1;
        self.base.frame_time_s(last) + self.base.radar.in_frame(last).frame_duration_s()
    }
}

/// Half width and half length of a mesh whose origin is its middle.
fn half_extent_m(mesh: &Mesh) -> [f64; 2] {
    [1, 0].map(|axis: usize| mesh.vertices_m.iter().map(|vertex| vertex[axis].abs()).fold(0.0, f64::max))
}
