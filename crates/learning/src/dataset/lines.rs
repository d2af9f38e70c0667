//! JSON lines of a dataset: a line a scene beside each shard, from which a line a sample is made.

use crate::dataset::draws::Drawn;
use crate::dataset::observed_frame::SeenFrame;
use crate::dataset::recipe::{FRAMES_LIMIT, Recipe, VEHICLES_LIMIT};
use crate::dataset::staging::{Staged, ToldVehicle};
use artifact::envelope::fingerprint;
use artifact::points::Object;
use artifact::settings::Lanes;
use evaluation::Truth;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::outcome::verdict::{Asking, Verdict};
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
        "radar_x_m": radar.position_m[0],
        "radar_y_m": radar.position_m[1],
        "radar_height_m": radar.position_m[2],
        "tilt_deg": radar.boresight_el_rad.to_degrees(),
        "lanes_azimuth_deg": staged.header.dsp.road.azimuth_rad.to_degrees(),
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
    let paths = result.scattering.paths();
    let verdict =
        Verdict::of_paths(&staged.header.fidelity, &result.error, paths).beside(&result.model_error);
    let road = &staged.header.dsp.road;
    let told = staged.vehicles.iter().zip(&seen.truths).zip(&seen.object_of).enumerate();
    let vehicles = told.map(|(target, ((told, truth), object))| {
        let id = id(drawn.number, target, result.points.index);
        vehicle(&id, target, told, truth, object.map(|o| &result.points.objects[o]), road)
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

fn vehicle(
    id: &str,
    target: usize,
    told: &ToldVehicle,
    truth: &Truth,
    object: Option<&Object>,
    road: &Lanes,
) -> Value {
    let echo = truth.echo;
    let across_m = |position_m: [f64; 3]| road.across_along_m(position_m)[0];
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
        "across_m": across_m(truth.position_m.into()),
        "echo_range_m": echo.map(|e| e.range_m),
        "echo_velocity_mps": echo.map(|e| e.radial_velocity_mps),
        "estimate": object.map(|o| json!({
            "range_m": o.range_m, "velocity_mps": o.radial_velocity_mps, "x_m": o.position_m[0],
            "across_m": across_m(o.position_m), "lane": o.lane, "snr_db": o.snr_db, "points": o.points,
        })),
    })
}

/// Key of a line's checksum, which is of all else that the line says.
const CHECKSUM: &str = "checksum";

/// Text of a scene's line, with its checksum.
pub(super) fn sealed(mut scene: Value) -> String {
    scene[CHECKSUM] = checksum(&scene).into();
    scene.to_string()
}

/// Beginning of the hash of what a line says, whose keys are sorted.
fn checksum(scene: &Value) -> String {
    fingerprint(&scene.to_string()).chars().take(16).collect()
}

/// A thousand frames of sixteen vehicles for each of the usual scenes of a shard.
const LIMIT_BYTES: u64 = 1 << 30;

/// The lines of a shard, which another part of the same work may have written.
///
/// # Errors
/// They cannot be read, or one of them is damaged: file, line and rule.
pub(crate) fn read(file: &Path) -> Result<Vec<Value>, Failure> {
    let bytes = files::read_own(file, LIMIT_BYTES).map_err(|error| Failure::system(file, "read", error))?;
    let text = bytes.strip_suffix(b"\n").unwrap_or(&bytes);
    let of_line = |(at, line)| read_scene(line).ok_or_else(|| damaged(file, at));
    text.split(|byte| *byte == b'\n').enumerate().map(of_line).collect()
}

fn damaged(file: &Path, at: usize) -> Failure {
    let place = format!("{}:{}", file.display(), at + 1);
    Failure::Refused(format!("{place}: is no line of a scene; `dataset` makes its shard anew"))
}

/// Bytes of what a scene's line says beside its frames, which every line of a sample repeats: ten times as
/// many as the program writes there.
const SCENE_LIMIT_BYTES: usize = 4096;

/// The scene of a line, without its checksum, which lines of earlier versions lack; `None` where it is
/// damaged, or tells of more than a recipe may ask for.
fn read_scene(line: &[u8]) -> Option<Value> {
    let mut scene: Value = serde_json::from_slice(line).ok()?;
    let told = scene.as_object_mut()?.remove(CHECKSUM);
    if told.is_some_and(|told| told != checksum(&scene)) {
        return None;
    }
    let frames = list(&scene["frames"]);
    let is_full = |frame: &Value| list(&frame["vehicles"]).len() > VEHICLES_LIMIT as usize;
    let is_bounded = frames.len() <= FRAMES_LIMIT as usize && !frames.iter().any(is_full);
    (is_bounded && of_all(&scene).to_string().len() <= SCENE_LIMIT_BYTES).then_some(scene)
}

/// Direction along the lanes, from world +y towards +x, rad; 0 where a line of earlier versions has none.
pub(crate) fn lanes_azimuth_rad(scene: &Value) -> f64 {
    scene["lanes_azimuth_deg"].as_f64().unwrap_or(0.0).to_radians()
}

/// Every vehicle of every frame of a scene, with the frame.
pub(super) fn vehicles(scene: &Value) -> impl Iterator<Item = (&Value, &Value)> {
    list(&scene["frames"])
        .iter()
        .flat_map(|frame| list(&frame["vehicles"]).iter().map(move |vehicle| (frame, vehicle)))
}

/// Lines of a scene's samples: vehicles that were found, each with what its scene tells of all.
pub(super) fn samples(scene: &Value) -> impl Iterator<Item = Value> {
    let of_all = of_all(scene);
    let found = vehicles(scene).filter(|(_, vehicle)| is_found(vehicle));
    found.map(move |(frame, vehicle)| joined(&of_all, frame, vehicle))
}

/// What a scene tells of all of its vehicles.
fn of_all(scene: &Value) -> Value {
    let fields = scene.as_object().into_iter().flatten().filter(|(key, _)| *key != "frames");
    fields.map(|(key, value)| (key.clone(), value.clone())).collect()
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
    all.insert("frame".into(), frame["frame"].clone());
    all.extend(fields(vehicle));
    Value::Object(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(frames: usize, vehicles: usize, base: &str) -> Vec<u8> {
        let vehicle = json!({ "id": "a", "class": "car", "estimate": { "lane": 2 } });
        let missed = json!({ "id": "b", "estimate": null });
        let mut all = vec![vehicle; vehicles];
        all.extend((vehicles < 16).then_some(missed));
        let frame = |number: usize| json!({ "frame": number, "vehicles": all });
        let frames: Vec<Value> = (0..frames).map(frame).collect();
        json!({ "scene": 7, "base": base, "frames": frames }).to_string().into_bytes()
    }

    #[test]
    fn a_line_of_more_frames_vehicles_or_words_than_the_program_writes_is_damaged() {
        let is_read = |frames: usize, vehicles: usize, base: usize| {
            read_scene(&line(frames, vehicles, &"x".repeat(base))).is_some()
        };
        assert!(is_read(1000, 1, 1) && is_read(1, 16, 255) && is_read(0, 0, 4000));
        assert!(!is_read(1001, 0, 1) && !is_read(1, 17, 1) && !is_read(1, 1, 4096));
        assert!(read_scene(b"{\"scene\": 7").is_none() && read_scene(b"7").is_none());
    }

    #[test]
    fn a_line_of_which_a_digit_was_changed_is_damaged() {
        let scene = json!({ "scene": 7, "base": "base.toml", "range_m": 0.1 + 0.2, "tilt_deg": -0.0 });
        let text = sealed(scene.clone());
        assert_eq!(read_scene(text.as_bytes()), Some(scene));
        for (from, to) in [("7", "8"), ("0.3", "0.4"), ("base.", "bare."), ("-0.0", "0.0")] {
            assert!(text.contains(from) && read_scene(text.replacen(from, to, 1).as_bytes()).is_none());
        }
    }

    #[test]
    fn a_sample_has_the_words_of_its_scene_its_frame_and_its_vehicle() {
        let scene = read_scene(&line(2, 1, "base.toml")).unwrap();
        assert_eq!(vehicles(&scene).count(), 4);
        let lines: Vec<String> = samples(&scene).map(|sample| sample.to_string()).collect();
        let of_frame = |frame: usize| {
            let words = r#""base":"base.toml","class":"car","estimate":{"lane":2},"frame""#;
            format!(r#"{{{words}:{frame},"id":"a","scene":7}}"#)
        };
        assert_eq!(lines, [of_frame(0), of_frame(1)]);
    }
}
