//! `summary.json`: its keys are promised in `docs/interface.md`.

use crate::chain::frame_result::FrameResult;
use crate::chain::measured_frames::errors_of_frame;
use crate::chain::stages::Stage;
use crate::outcome::error_figures::{db, error_db, model_error_db};
use crate::outcome::false_objects;
use crate::outcome::verdict::{Asking, Verdict};
use artifact::paths::{PathsFrame, TargetDetail};
use artifact::points::Object;
use artifact::radar::{ElementError, Sampling};
use artifact::scene::{Role, SceneHeader, TargetKind};
use artifact::settings::{Class, StaticEchoes};
use evaluation::{FrameTruth, Truth};
use radar::doppler_ambiguity::shown_mps;
use serde_json::{Map, Value, json};

/// The file's first level without its frames.
pub(crate) fn head(header: &SceneHeader) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("scene".into(), json!(header.name));
    map.insert("seed".into(), json!(header.seed));
    map.insert("radar".into(), radar(header));
    map.insert("lanes".into(), lanes(header));
    map.insert("static".into(), json!(header.dsp.static_echoes.name()));
    map
}

fn radar(header: &SceneHeader) -> Value {
    let (radar, waveform) = (&header.radar, &header.radar.waveform);
    json!({
        "carrier_hz": waveform.centre_frequency_hz(),
        "bandwidth_hz": waveform.bandwidth_hz().abs(),
        "chirp_interval_s": waveform.chirp_interval_s,
        "samples_per_chirp": waveform.samples,
        "sampling": match waveform.sampling {
            Sampling::Complex => "complex",
            Sampling::Real => "real",
        },
        "chirps": waveform.chirps,
        "channels": radar.virtual_channels(),
        "element_errors": element_errors(header),
        "range_resolution_m": waveform.range_resolution_m(),
        "range_max_m": waveform.range_max_m(),
        "velocity_resolution_mps": radar.velocity_resolution_mps(),
        "velocity_max_mps": radar.velocity_max_mps(),
        "sample_rate_hz": waveform.sample_rate_hz,
    })
}

/// What lanes are called by their numbers; empty where nothing says any.
fn lanes(header: &SceneHeader) -> Value {
    let road = &header.dsp.road;
    let straight = road.lanes.iter().map(|l| json!({ "number": l.number, "id": null, "width_m": l.width_m }));
    let of_net =
        road.courses.iter().map(|c| json!({ "number": c.number, "id": c.name, "width_m": c.width_m }));
    straight.chain(of_net).collect()
}

/// Those that the scene lists and those that its seed draws, together; null of an ideal array.
fn element_errors(header: &SceneHeader) -> Value {
    let hardware = fmcw_echo::element_errors::drawn(&header.radar, header.seed).hardware;
    let of = |errors: &[ElementError]| -> Vec<Value> {
        let told = |e: &ElementError| json!({ "gain_db": e.gain_db, "phase_deg": e.phase_rad.to_degrees(), "delay_ps": e.delay_s * 1e12 });
        errors.iter().map(told).collect()
    };
    match (&hardware.tx[..], &hardware.rx[..]) {
        ([], []) => Value::Null,
        (tx, rx) => json!({ "tx": of(tx), "rx": of(rx) }),
    }
}

/// One frame with its targets, truth beside estimate.
pub(crate) fn frame(header: &SceneHeader, result: &FrameResult, truth: &FrameTruth) -> Value {
    let measured_in = result.paths.as_ref().map(|paths| errors_of_frame(header, result.scene.index, paths));
    let header = &header.in_frame(result.scene.index);
    let resolved =
        !result.points.objects.is_empty() && result.points.objects.iter().all(|o| o.velocity_resolved);
    let of_role = |role: Role| (0..truth.truths.len()).filter(move |i| header.targets[*i].role == role);
    let targets: Vec<Value> = of_role(Role::Target).map(|i| target(header, result, truth, i)).collect();
    let clutter: Vec<Value> = of_role(Role::Clutter).map(|i| clutter(header, i, &truth.truths[i])).collect();
    let is_abnormal = targets.iter().any(|target| target["velocity_aliased"] == true);
    json!({
        "time_s": result.scene.time_s,
        "stage_seconds": seconds(&result.seconds),
        "cached": result.cached.iter().map(|s| s.name()).collect::<Vec<_>>(),
        "paths": result.paths.as_ref().map(|p| p.paths.len()),
        "detail": result.paths.as_ref().map(detail),
        "points": result.points.points.len(),
        "rdm_state": if is_abnormal { "abnormal" } else { "normal" },
        "velocity_resolved": resolved,
        "accuracy": verdict(header, result).json(Asking::Scene),
        "error_db": error_db(&result.error),
        "error_measured_in": measured_in,
        "model_error_db": model_error_db(&result.model_error),
        "memory_estimate_mib": result.memory_estimate_mib,
        "peak_memory_mib": crate::host::memory::peak_mib(),
        "targets": targets,
        "clutter": clutter,
        "false_objects": false_objects::told(header, result, truth),
        "stationary_points": stationary_points(header, result),
        "stationary_objects": false_objects::standing(header, result, truth),
    })
}

/// Of the frame's points; null where it is not told.
fn stationary_points(header: &SceneHeader, result: &FrameResult) -> Option<usize> {
    let at_rest = result.points.points.iter().filter(|point| point.stationary == Some(true));
    (header.dsp.static_echoes != StaticEchoes::Keep).then(|| at_rest.count())
}

fn verdict(header: &SceneHeader, result: &FrameResult) -> Verdict {
    Verdict::of_paths(header.fidelity.accuracy, &result.error, result.paths.as_ref())
}

/// Each target's level of detail.
fn detail(paths: &PathsFrame) -> Value {
    let of = |target: &TargetDetail| {
        let (level, error_db) = (target.level.name(), db(target.error));
        json!({ "level": level, "paths_traced": target.traced, "paths": target.kept, "error_db": error_db })
    };
    paths.trace.detail.iter().map(of).collect()
}

fn seconds(seconds: &[(Stage, f64)]) -> Value {
    seconds.iter().map(|(stage, s)| (stage.name().to_owned(), json!(s))).collect::<Map<_, _>>().into()
}

/// The map's velocity minus the truth's, rounded to multiples of the unambiguous span, is not zero. Without
/// an estimate the truth itself decides: a velocity beyond the span cannot show right.
fn is_aliased(header: &SceneHeader, truth: &Truth, object: Option<&Object>) -> bool {
    let span = 2.0 * header.radar.velocity_max_mps();
    let shown = object.map(|o| shown_mps(&header.radar, o.radial_velocity_mps));
    let difference = shown.unwrap_or_else(|| shown_mps(&header.radar, truth.radial_velocity_mps))
        - truth.radial_velocity_mps;
    (difference / span).round() != 0.0
}

fn target(header: &SceneHeader, result: &FrameResult, frame: &FrameTruth, index: usize) -> Value {
    let (described, truth) = (&header.targets[index], &frame.truths[index]);
    let (class, model) = match &described.kind {
        TargetKind::Mesh { class, model, .. } => (class.map(Class::name), Some(model.as_str())),
        TargetKind::Point { .. } => (None, None),
    };
    let chosen = frame.pairing.object_of[index];
    let object = chosen.map(|o| &result.points.objects[o]);
    let probabilities = chosen.filter(|_| model.is_some()).and_then(|o| result.classes.get(o));
    json!({
        "id": described.id,
        "class": class,
        "model": model,
        "truth": truth_json(truth),
        "found": frame.pairing.shown.contains(&index).then_some(object.is_some()),
        "removed": frame.pairing.removed.contains(&index),
        "object": chosen,
        "estimate": object.map(estimate),
        "velocity_aliased": is_aliased(header, truth, object),
        "predicted_class": probabilities.map(|p| result.rule.told(p)),
        "probabilities": self::probabilities(probabilities),
    })
}

/// What stands about: where it is and from where its echo comes.
fn clutter(header: &SceneHeader, index: usize, truth: &Truth) -> Value {
    let described = &header.targets[index];
    let TargetKind::Mesh { model, .. } = &described.kind else { return Value::Null };
    json!({
        "id": described.id,
        "model": model,
        "x_m": truth.position_m.x,
        "y_m": truth.position_m.y,
        "nearest_range_m": truth.nearest_range_m,
        "echo_range_m": truth.echo.map(|e| e.range_m),
    })
}

fn truth_json(truth: &Truth) -> Value {
    json!({
        "range_m": truth.range_m,
        "radial_velocity_mps": truth.radial_velocity_mps,
        "x_m": truth.position_m.x,
        "y_m": truth.position_m.y,
        "z_m": truth.position_m.z,
        "lane": truth.lane,
        "nearest_range_m": truth.nearest_range_m,
        "echo_range_m": truth.echo.map(|e| e.range_m),
        "echo_radial_velocity_mps": truth.echo.map(|e| e.radial_velocity_mps),
    })
}

fn estimate(object: &Object) -> Value {
    let [x, y, z] = object.position_m;
    json!({
        "range_m": object.range_m,
        "radial_velocity_mps": object.radial_velocity_mps,
        "x_m": x,
        "y_m": y,
        "z_m": z,
        "lane": object.lane,
        "snr_db": object.snr_db,
        "points": object.points,
        "ghost_share": object.ghost_share,
        "stationary": object.stationary,
    })
}

/// `{car, bus, truck, motorcycle}`, null where there is no crop of the target.
pub(crate) fn probabilities(values: Option<&[f32; 4]>) -> Value {
    let of =
        |(i, class): (usize, &Class)| (class.name().to_owned(), values.map_or(Value::Null, |v| json!(v[i])));
    Class::ALL.iter().enumerate().map(of).collect::<Map<_, _>>().into()
}
