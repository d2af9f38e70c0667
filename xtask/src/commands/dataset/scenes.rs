//! The scenes of a dataset: one vehicle each, drawn from the recipe, sent through the whole chain.

use super::recipe::Recipe;
use crate::chain::{Chain, FrameProducts};
use crate::failure::Failure;
use crate::pairing::{Pairing, Reach};
use crate::truth::{self, Truth};
use crate::verdict::{Asking, Verdict};
use artifact::dataset::{Sample, Split};
use artifact::points::Object;
use artifact::scene::{Mesh, Pose, Role, SceneHeader, Target, TargetKind};
use artifact::settings::Class;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use std::path::Path;

/// A scene before it is computed.
pub(super) struct Drawn {
    pub(super) number: u64,
    class: Class,
    model: String,
    vehicle_seed: u64,
    lane: u8,
    range_m: f64,
    speed_mps: f64,
}

/// A scene after it.
pub(super) struct Shot {
    /// The crop, if the vehicle was found.
    pub(super) sample: Option<Sample>,
    /// Truth and estimate.
    pub(super) line: Value,
}

/// All scenes, class by class in turn, so that any beginning is balanced.
pub(super) fn draw(recipe: &Recipe) -> Vec<Drawn> {
    let mut scenes = Vec::new();
    for round in 0..u64::from(recipe.scenes_per_class) {
        for (class, models) in &recipe.models {
            scenes.push(draw_one(recipe, scenes.len() as u64, *class, &models[round as usize % models.len()]));
        }
    }
    scenes
}

fn draw_one(recipe: &Recipe, number: u64, class: Class, model: &str) -> Drawn {
    let mut random = ChaCha8Rng::from_seed(artifact::seed::key(recipe.seed, "dataset/scene", &[number]));
    let within = |[low, high]: [f64; 2], share: f64| low + (high - low) * share;
    Drawn {
        number,
        class,
        model: model.to_owned(),
        vehicle_seed: random.random_range(0..recipe.vehicle_seeds),
        lane: recipe.lanes[random.random_range(0..recipe.lanes.len())],
        range_m: within(recipe.range_m, random.random()),
        speed_mps: within(recipe.speed_mps, random.random()),
    }
}

/// Computes one scene and cuts its crop.
pub(super) fn shoot(recipe: &Recipe, drawn: &Drawn, shard: &Path) -> Result<Shot, Failure> {
    let header = header(recipe, drawn)?;
    let chain = Chain::of(&header, None, None);
    let products = chain.frame(&chain.plan(0))?;
    let truths = truth::truths(&header, &products.result.scene, products.result.paths.as_ref());
    let objects = &products.result.points.objects;
    let pairing = Pairing::of(&truths, objects, &Reach::of(&header));
    let object = pairing.object_of[0].map(|o| &objects[o]);
    let sample =
        pairing.object_of[0].map(|o| sample(drawn, &chain, &products, o, &truths[0], recipe.seed)).transpose()?;
    Ok(Shot { line: line(drawn, &truths[0], object, &products, shard, recipe.seed), sample })
}

/// The base scene with this vehicle as its only target. The range is the slant range of the body's origin.
fn header(recipe: &Recipe, drawn: &Drawn) -> Result<SceneHeader, Failure> {
    let mesh = scene::vehicles::mesh(&drawn.model, drawn.vehicle_seed);
    let mesh = mesh.ok_or_else(|| Failure::refused(format!("`{}` is none of the project's vehicles", drawn.model)))?;
    let mesh = Mesh { makeup: recipe.base.materials.makeup(&mesh.materials), ..mesh };
    let (radar, road) = (&recipe.base.radar, &recipe.base.dsp.road);
    let [radar_across_m, radar_along_m] = road.across_along_m(radar.position_m);
    let lane = road.lanes.iter().find(|l| l.number == drawn.lane);
    let across_m = lane.map_or(radar_across_m, |l| l.centre_m);
    let sideways_m2 = radar.position_m[2].powi(2) + (across_m - radar_across_m).powi(2);
    let away_m = (drawn.range_m.powi(2) - sideways_m2).max(1.0).sqrt();
    let [x_m, y_m] = road.world_m([across_m, radar_along_m + away_m]);
    let (sin, cos) = road.azimuth_rad.sin_cos();
    let start = Pose {
        position_m: [x_m, y_m, 0.0],
        yaw_rad: -std::f64::consts::FRAC_PI_2 - road.azimuth_rad,
        velocity_mps: [-drawn.speed_mps * sin, -drawn.speed_mps * cos, 0.0],
        acceleration_mps2: [0.0; 3],
    };
    let kind = TargetKind::Mesh { class: Some(drawn.class), model: drawn.model.clone(), mesh: 0 };
    Ok(SceneHeader {
        name: format!("dataset-{}", drawn.number),
        seed: recipe.seed.wrapping_add(drawn.number),
        frames: 1,
        meshes: vec![mesh].into(),
        targets: vec![Target { id: "vehicle".into(), role: Role::Target, kind, start }],
        traffic: None,
        ..recipe.base.clone()
    })
}

fn sample(
    drawn: &Drawn,
    chain: &Chain,
    products: &FrameProducts,
    object: usize,
    truth: &Truth,
    seed: u64,
) -> Result<Sample, Failure> {
    let points = &products.result.points;
    let signatures = dsp::Signatures::new(&chain.cube_header, &products.rdm).map_err(Failure::refused)?;
    Ok(Sample {
        id: format!("scene-{:05}", drawn.number),
        signature: signatures.of(points, object as u32).map_err(Failure::refused)?,
        crop: None,
        target: 0,
        frame: 0,
        variant: drawn.vehicle_seed,
        class: Some(drawn.class),
        model: drawn.model.clone(),
        scene: drawn.number,
        split: split(drawn, seed),
        range_m: truth.range_m,
        radial_velocity_mps: truth.radial_velocity_mps,
        lane: truth.lane,
        seed,
    })
}

fn split(drawn: &Drawn, seed: u64) -> Split {
    classifier::split_of_scene(drawn.number, seed)
}

fn verdict(products: &FrameProducts) -> Verdict {
    let result = &products.result;
    Verdict::of_paths(products.view.fidelity.accuracy, &result.error, result.paths.as_ref())
}

fn line(
    drawn: &Drawn,
    truth: &Truth,
    object: Option<&Object>,
    products: &FrameProducts,
    shard: &Path,
    seed: u64,
) -> Value {
    let echo = truth.echo;
    json!({
        "file": shard.file_name().unwrap_or_default().to_string_lossy(),
        "sample": object.is_some(), "id": format!("scene-{:05}", drawn.number), "scene": drawn.number,
        "class": drawn.class.name(), "model": drawn.model, "vehicle_seed": drawn.vehicle_seed,
        "range_m": truth.range_m, "velocity_mps": truth.radial_velocity_mps, "lane": truth.lane,
        "x_m": truth.position_m.x, "seed": seed, "split": split(drawn, seed),
        "echo_range_m": echo.map(|e| e.range_m), "echo_velocity_mps": echo.map(|e| e.radial_velocity_mps),
        "objects": products.result.points.objects.len(), "points": products.result.points.points.len(),
        "paths": products.result.paths.as_ref().map(|p| p.paths.len()),
        "accuracy": verdict(products).json(Asking::Scene),
        "seconds": products.result.seconds.iter().map(|(_, s)| s).sum::<f64>(),
        "estimate": object.map(|o| json!({ "range_m": o.range_m, "velocity_mps": o.radial_velocity_mps,
            "x_m": o.position_m[0], "lane": o.lane, "snr_db": o.snr_db, "points": o.points })),
    })
}
