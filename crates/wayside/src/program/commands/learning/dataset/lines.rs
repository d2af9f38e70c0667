//! JSON lines of a dataset: a line a scene beside each shard, from which a line a sample is made.

use crate::host::files;
use crate::outcome::verdict::{Asking, Verdict};
use crate::program::commands::learning::dataset::draws::Drawn;
use crate::program::commands::learning::dataset::recipe::Recipe;
use crate::program::commands::learning::dataset::seen::SeenFrame;
use crate::program::commands::learning::dataset::staging::{Staged, ToldVehicle};
use artifact::points::Object;
use evaluation::Truth;
use serde_json::{Map, Value, json};
use std::path::Path;

/// Identifier of one vehicle in one frame, found or not.
pub(super) fn id(scene: u64, target: usize, frame: u32) -> String {
    format!("scene-{scene:05}-{target}-{frame:03}")
}

/// A scene with all of its frames.
pub(super) fn scene(
    recipe: &Recipe,
    drawn: &Drawn,
    staged: &Staged,
    frames: Vec<Value>,
    measured_in: u64,
    shard: &str,
) -> Value {
    let radar = &staged.header.radar;
    json!({
        "file": shard,
        "scene": drawn.number,
        "base": recipe.bases[drawn.base].name,
        "seed": recipe.seed,
        "split": classifier::split_of_scene(drawn.number, recipe.seed),
        "radar_height_m": radar.position_m[2],
        "tilt_deg": radar.boresight_el_rad.to_degrees(),
        "extra_noise_db": drawn.extra_noise_db,
        "is_queue": drawn.queue_mps.is_some(),
        "left_out": drawn.vehicles.len() - staged.vehicles.len(),
        "measured_in": measured_in,
        "frames": frames,
    })
}

/// One frame with all of its vehicles.
pub(super) fn frame(drawn: &Drawn, staged: &Staged, seen: &SeenFrame) -> Value {
    let result = &seen.products.result;
    let paths = result.paths.as_ref();
    let verdict =
        Verdict::of_paths(&staged.header.fidelity, &result.error, paths).beside(&result.model_error);
    let told = staged.vehicles.iter().zip(&seen.truths).zip(&seen.object_of).enumerate();
    let vehicles = told.map(|(target, ((told, truth), object))| {
        let id = id(drawn.number, target, result.points.index);
        vehicle(&id, target, told, truth, object.map(|o| &result.points.objects[o]))
    });
    json!({
        "frame": result.points.index,
        "objects": result.points.objects.len(),
        "points": result.points.points.len(),
        "paths": paths.map(|p| p.paths.len()),
        "accuracy": verdict.told(Asking::Scene),
        "vehicles": vehicles.collect::<Vec<_>>(),
    })
}

fn vehicle(id: &str, target: usize, told: &ToldVehicle, truth: &Truth, object: Option<&Object>) -> Value {
    let echo = truth.echo;
    json!({
        "id": id,
        "target": target,
        "class": told.class.name(),
        "model": told.model,
        "variant": told.variant,
        "lane": truth.lane,
        "range_m": truth.range_m,
        "velocity_mps": truth.radial_velocity_mps,
        "yaw_deg": told.yaw_rad.to_degrees(),
        "x_m": truth.position_m.x,
        "y_m": truth.position_m.y,
        "echo_range_m": echo.map(|e| e.range_m),
        "echo_velocity_mps": echo.map(|e| e.radial_velocity_mps),
        "estimate": object.map(|o| json!({
            "range_m": o.range_m, "velocity_mps": o.radial_velocity_mps, "x_m": o.position_m[0], "lane": o.lane,
            "snr_db": o.snr_db, "points": o.points,
        })),
    })
}

/// A thousand frames of sixteen vehicles for each of the usual scenes of a shard.
pub(in crate::program::commands::learning) const LIMIT_BYTES: u64 = 1 << 30;

/// The lines of a shard, which another part of the same work may have written; `None` where they cannot be
/// read, or one of them is damaged.
pub(super) fn read(file: &Path) -> Option<Vec<Value>> {
    let bytes = files::read_own(file, LIMIT_BYTES).ok()?;
    let text = bytes.strip_suffix(b"\n").unwrap_or(&bytes);
    text.split(|byte| *byte == b'\n').map(|line| serde_json::from_slice(line).ok()).collect()
}

/// Every vehicle of every frame of such lines, with what its scene tells of all.
pub(super) fn vehicles(scenes: &[Value]) -> Vec<Value> {
    let frames =
        scenes.iter().flat_map(|scene| list(&scene["frames"]).iter().map(move |frame| (scene, frame)));
    frames
        .flat_map(|(scene, frame)| list(&frame["vehicles"]).iter().map(move |v| joined(scene, frame, v)))
        .collect()
}

/// Whether such a vehicle was found, and is a sample.
pub(super) fn is_found(vehicle: &Value) -> bool {
    vehicle["estimate"].is_object()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn joined(scene: &Value, frame: &Value, vehicle: &Value) -> Value {
    let fields = |value: &Value| value.as_object().cloned().unwrap_or_default();
    let mut all: Map<String, Value> = fields(scene);
    all.remove("frames");
    all.insert("frame".into(), frame["frame"].clone());
    all.extend(fields(vehicle));
    Value::Object(all)
}
