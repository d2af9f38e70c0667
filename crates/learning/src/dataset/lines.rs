//! JSON lines of a dataset: one line per scene beside each shard, from which one line per sample is made.

use crate::dataset::draws::DrawnScene;
use crate::dataset::observed_frame::ObservedFrame;
use crate::dataset::recipe::{FRAMES_LIMIT, Recipe, VEHICLES_LIMIT};
use crate::dataset::scene_line::{EstimateLine, FrameLine, SceneLine, VehicleLine};
use crate::dataset::staging::{StagedScene, VehicleDescription};
use artifact::envelope::fingerprint;
use artifact::points::Object;
use artifact::settings::{Lanes, SmallParts};
use evaluation::Truth;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::outcome::verdict::{RequestSource, Verdict};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::path::Path;

/// Identifier of one vehicle in one frame, found or not.
pub(super) fn id(scene: u64, target: usize, frame: u32) -> String {
    format!("scene-{scene:05}-{target}-{frame:03}")
}

/// A scene with all of its frames.
pub(super) fn scene(
    recipe: &Recipe,
    drawn: &DrawnScene,
    staged: &StagedScene,
    frames: Vec<FrameLine>,
    measured_in: u64,
    shard: &str,
) -> SceneLine {
    let radar = &staged.header.radar;
    let small_parts = staged.header.fidelity.small_parts;
    let [x_m, y_m, height_m] = radar.position_m;
    SceneLine {
        file: shard.to_owned(),
        scene: Some(drawn.number),
        base: Some(recipe.bases[drawn.base].name.clone()),
        seed: recipe.seed,
        split: Some(classifier::split_of_scene(drawn.number, recipe.seed)),
        radar_x_m: Some(x_m),
        radar_y_m: Some(y_m),
        radar_height_m: Some(height_m),
        tilt_deg: Some(radar.boresight_el_rad.to_degrees()),
        lanes_azimuth_deg: Some(staged.header.dsp.road.azimuth_rad.to_degrees()),
        extra_noise_db: Some(drawn.extra_noise_db),
        is_queue: drawn.queue_mps.is_some(),
        detail: (small_parts != SmallParts::OfMesh).then(|| small_parts.name().to_owned()),
        left_out: drawn.vehicles.len() - staged.vehicles.len(),
        measured_in: Some(measured_in),
        frames,
    }
}

/// One frame with all of its vehicles.
pub(super) fn frame(drawn: &DrawnScene, staged: &StagedScene, observed: &ObservedFrame) -> FrameLine {
    let result = &observed.products.result;
    let paths = result.scattering.paths();
    let verdict = Verdict::of_paths(&staged.header.fidelity, &result.error, paths)
        .with_model_error(&result.model_error);
    let road = &staged.header.dsp.road;
    let told = staged.vehicles.iter().zip(&observed.truths).zip(&observed.object_of).enumerate();
    let vehicles = told.map(|(target, ((told, truth), object))| VehicleLine {
        id: id(drawn.number, target, result.points.index),
        target: target as u32,
        ..vehicle(told, truth, object.map(|o| &result.points.objects[o]), road)
    });
    FrameLine {
        frame: result.points.index,
        objects: result.points.objects.len(),
        points: result.points.points.len(),
        paths: paths.map(|p| p.paths.len()),
        accuracy: verdict.for_summary(RequestSource::Scene),
        vehicles: vehicles.collect(),
    }
}

fn vehicle(told: &VehicleDescription, truth: &Truth, object: Option<&Object>, road: &Lanes) -> VehicleLine {
    let across_m = |position_m: [f64; 3]| Some(road.across_along_m(position_m)[0]);
    let estimate = |o: &Object| EstimateLine {
        range_m: Some(o.range_m),
        velocity_mps: Some(o.radial_velocity_mps),
        x_m: Some(o.position_m[0]),
        across_m: across_m(o.position_m),
        lane: o.lane,
        snr_db: Some(o.snr_db),
        points: o.points,
    };
    VehicleLine {
        class: told.class.name().to_owned(),
        model: told.model.clone(),
        variant: told.variant,
        lane: truth.lane,
        range_m: Some(truth.range_m),
        velocity_mps: Some(truth.radial_velocity_mps),
        yaw_deg: Some(told.yaw_rad.to_degrees()),
        x_m: Some(truth.position_m.x),
        y_m: Some(truth.position_m.y),
        across_m: across_m(truth.position_m.into()),
        echo_range_m: truth.echo.map(|e| e.range_m),
        echo_velocity_mps: truth.echo.map(|e| e.radial_velocity_mps),
        estimate: object.map(estimate),
        ..VehicleLine::default()
    }
}

/// Key of a line's checksum, which covers the rest of the line.
const CHECKSUM: &str = "checksum";
/// Key of a scene's frames, which lines of samples omit.
const FRAMES: &str = "frames";

/// Text of a scene's line, with its checksum.
pub(super) fn sealed(scene: &SceneLine) -> serde_json::Result<String> {
    let mut scene = serde_json::to_value(scene)?;
    scene[CHECKSUM] = checksum(&scene).into();
    Ok(scene.to_string())
}

/// Beginning of every scene's line, and a key that follows within its first bytes.
const FIRST_KEYS: [&[u8]; 2] = [b"{\"base\":", b"\"extra_noise_db\":"];

/// Whether the first bytes of a file are those of a scene's line, which may be cut.
pub(super) fn begins_as_scene(head: &[u8]) -> bool {
    let line = head.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let [begin, key] = FIRST_KEYS;
    let is_cut = || serde_json::from_slice::<Value>(line).is_err();
    let has_key = || line.windows(key.len()).any(|part| part == key);
    begin.starts_with(line) || (line.starts_with(begin) && (has_key() || is_cut()))
}

/// Text of a scene's line without a checksum, its keys sorted.
pub(super) fn text(scene: &SceneLine) -> serde_json::Result<String> {
    Ok(serde_json::to_value(scene)?.to_string())
}

/// Beginning of the hash of a line's content with sorted keys.
fn checksum(scene: &Value) -> String {
    fingerprint(&scene.to_string()).chars().take(16).collect()
}

/// Largest file: a thousand frames of sixteen vehicles for each of the usual scenes of a shard.
const LIMIT_BYTES: u64 = 1 << 30;

/// Reads the lines of a shard, which another part of the same work may have written.
///
/// # Errors
/// The file cannot be read, or a line is damaged: file, line and rule.
pub(crate) fn read(file: &Path) -> Result<Vec<SceneLine>, Failure> {
    let bytes = files::read_own(file, LIMIT_BYTES).map_err(|error| Failure::system(file, "read", error))?;
    let text = bytes.strip_suffix(b"\n").unwrap_or(&bytes);
    let of_line = |(at, line)| read_scene(line).ok_or_else(|| damaged(file, at));
    text.split(|byte| *byte == b'\n').enumerate().map(of_line).collect()
}

fn damaged(file: &Path, at: usize) -> Failure {
    let place = format!("{}:{}", file.display(), at + 1);
    Failure::Refused(format!("{place}: is no line of a scene; `dataset` makes its shard anew"))
}

/// Largest size of a scene's line without its frames, which every line of a sample repeats: ten times that of
/// the program's lines.
const SCENE_LIMIT_BYTES: usize = 4096;

/// Reads a scene's line and verifies its checksum, if it has one (lines of earlier versions do not); `None`
/// if the line is damaged, or exceeds the limits of a recipe.
fn read_scene(line: &[u8]) -> Option<SceneLine> {
    let mut words: Value = serde_json::from_slice(line).ok()?;
    let told = words.as_object_mut()?.remove(CHECKSUM);
    if told.is_some_and(|told| told != checksum(&words)) {
        return None;
    }
    let scene = SceneLine::deserialize(&words).ok()?;
    words.as_object_mut()?.remove(FRAMES);
    let is_full = |frame: &FrameLine| frame.vehicles.len() > VEHICLES_LIMIT as usize;
    let is_bounded = scene.frames.len() <= FRAMES_LIMIT as usize && !scene.frames.iter().any(is_full);
    (is_bounded && words.to_string().len() <= SCENE_LIMIT_BYTES).then_some(scene)
}

/// Lines of a scene's samples: detected vehicles, each with the common values of its scene.
pub(super) fn samples(scene: &SceneLine) -> serde_json::Result<Vec<String>> {
    let mut of_all = words(&SceneLine { frames: vec![], ..scene.clone() })?;
    of_all.remove(FRAMES);
    let found = scene.vehicles().filter(|(_, vehicle)| vehicle.estimate.is_some());
    found.map(|(frame, vehicle)| joined(&of_all, frame.frame, vehicle)).collect()
}

fn joined(of_all: &Map<String, Value>, frame: u32, vehicle: &VehicleLine) -> serde_json::Result<String> {
    let mut all = of_all.clone();
    all.insert("frame".into(), frame.into());
    all.extend(words(vehicle)?);
    Ok(Value::Object(all).to_string())
}

/// Keys and values of a JSON object.
fn words(told: &impl Serialize) -> serde_json::Result<Map<String, Value>> {
    serde_json::from_value(serde_json::to_value(told)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

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
        let scene = SceneLine {
            scene: Some(7),
            base: Some("base.toml".into()),
            radar_x_m: Some(0.1 + 0.2),
            tilt_deg: Some(-0.0),
            ..SceneLine::default()
        };
        let text = sealed(&scene).unwrap();
        assert_eq!(read_scene(text.as_bytes()), Some(scene));
        for (from, to) in [("7", "8"), ("0.3", "0.4"), ("base.", "bare."), ("-0.0", "0.0")] {
            assert!(text.contains(from) && read_scene(text.replacen(from, to, 1).as_bytes()).is_none());
        }
    }

    #[test]
    fn a_sample_has_the_words_of_its_scene_its_frame_and_its_vehicle() {
        let scene = read_scene(&line(2, 1, "base.toml")).unwrap();
        assert_eq!(scene.vehicles().count(), 4);
        let lines = samples(&scene).unwrap();
        let of_frame = |frame: usize, line: &str| {
            let told: Map<String, Value> = serde_json::from_str(line).unwrap();
            assert!(told.keys().is_sorted() && !told.contains_key(FRAMES), "{line}");
            let sample =
                json!({ "base": "base.toml", "class": "car", "frame": frame, "id": "a", "scene": 7 });
            assert!(sample.as_object().unwrap().iter().all(|(key, value)| told[key] == *value), "{line}");
            assert_eq!(told["estimate"]["lane"], 2, "{line}");
        };
        assert_eq!(lines.len(), 2);
        lines.iter().enumerate().for_each(|(frame, line)| of_frame(frame, line));
    }

    /// A line as `dataset` wrote it before lines had types, its second vehicle missed.
    const WRITTEN: &str = r#"{"base":"base.toml","extra_noise_db":0.0,"file":"shard-0000.dataset",
"frames":[{"accuracy":{"advice":null,"asked_db":-20.0,"for":null,"limited_by":"dropped","met":true,
"of_use_db":null,"reached_db":-21.543755809370467},"frame":1,"objects":1,"paths":46,"points":7,
"vehicles":[{"across_m":2.0,"class":"motorcycle","echo_range_m":32.158258565382596,
"echo_velocity_mps":-4.851207129613373,"estimate":{"across_m":1.80491163510009,"lane":1,"points":6,
"range_m":32.214329449287526,"snr_db":13.262974821740027,"velocity_mps":-4.8483533689099545,
"x_m":1.80491163510009},"id":"scene-00001-0-001","lane":1,"model":"motorcycle-street",
"range_m":32.5882743124687,"target":0,"variant":0,"velocity_mps":-4.828874265509708,"x_m":2.0,
"y_m":31.968666263463465,"yaw_deg":0.0},{"across_m":5.75,"class":"car","echo_range_m":null,
"echo_velocity_mps":null,"estimate":null,"id":"scene-00001-1-001","lane":null,"model":"car-hatchback",
"range_m":40.0,"target":1,"variant":3,"velocity_mps":-1.5,"x_m":5.75,"y_m":39.5,"yaw_deg":180.0}]}],
"is_queue":false,"lanes_azimuth_deg":0.0,"left_out":0,"measured_in":1,"radar_height_m":6.0,
"radar_x_m":0.0,"radar_y_m":0.0,"scene":1,"seed":1,"split":"train","tilt_deg":-4.0}"#;
    /// The line that the manifest had of its first vehicle.
    const SAMPLE: &str = r#"{"across_m":2.0,"base":"base.toml","class":"motorcycle",
"echo_range_m":32.158258565382596,"echo_velocity_mps":-4.851207129613373,
"estimate":{"across_m":1.80491163510009,"lane":1,"points":6,"range_m":32.214329449287526,
"snr_db":13.262974821740027,"velocity_mps":-4.8483533689099545,"x_m":1.80491163510009},
"extra_noise_db":0.0,"file":"shard-0000.dataset","frame":1,"id":"scene-00001-0-001","is_queue":false,
"lane":1,"lanes_azimuth_deg":0.0,"left_out":0,"measured_in":1,"model":"motorcycle-street",
"radar_height_m":6.0,"radar_x_m":0.0,"radar_y_m":0.0,"range_m":32.5882743124687,"scene":1,"seed":1,
"split":"train","target":0,"tilt_deg":-4.0,"variant":0,"velocity_mps":-4.828874265509708,"x_m":2.0,
"y_m":31.968666263463465,"yaw_deg":0.0}"#;

    #[test]
    fn lines_of_scenes_and_samples_are_those_of_the_version_before_to_the_byte() {
        let [written, sample] = [WRITTEN, SAMPLE].map(|line| line.replace('\n', ""));
        let scene = read_scene(written.as_bytes()).unwrap();
        assert_eq!(text(&scene).unwrap(), written);
        assert_eq!(samples(&scene).unwrap(), [sample]);
    }
}
