//! Check that paths were traced for the scene whose echo is made of them.
//!
//! Noise, gains, patterns, samples of a chirp and the elements of the array may differ, because paths hold
//! for them. The centre frequency, the radar's position, the bodies with their files, poses, motions and
//! cross sections, the road and the times of the frames must agree, as must the physics that the scene's file
//! specifies. For paths whose provenance does not describe bodies, every body must be where its nearest lit
//! surface was.

use artifact::Provenance;
use artifact::paths::{PathsFrame, PathsHeader};
use artifact::scene::{Mesh, SceneFrame, SceneHeader};
use glam::DVec3;
use pipeline::chain::link::{Chain, artifact_headers};
use pipeline::host::failure::Failure;
use pipeline::host::frame_matching::is_same_time;
use pipeline::host::{progress, provenance_checks};
use scene::PhysicsKeys;
use std::path::Path;

/// Distance beyond its extent at which a point's or body's surface counts as elsewhere, m: the part of a
/// wheel beyond its hub.
const BEYOND_M: f64 = 0.5;

/// Refuses paths that were traced for another sweep, position, bodies or files, or with physics that
/// contradict `said`; of `files`, the scene file itself may differ, for example in its noise.
pub(crate) fn check_header(
    chain: &Chain,
    (files, said): (&[(String, String)], &PhysicsKeys),
    paths: &PathsHeader,
    from: &Provenance,
) -> Result<(), Failure> {
    let radar = &chain.header.radar;
    let (told_hz, centre_hz) = (paths.centre_frequency_hz, radar.waveform.centre_frequency_hz());
    if (told_hz - centre_hz).abs() > 1e-9 * centre_hz {
        let rule = "amplitudes hold for the sweep that they were traced for";
        return Err(Failure::refused(format!("f_c is {told_hz} Hz, the scene's is {centre_hz} Hz: {rule}")));
    }
    if paths.radar.position_m != radar.position_m {
        let [theirs, own] = [paths.radar.position_m, radar.position_m];
        return Err(Failure::refused(format!("traced from {theirs:?} m, the scene's radar is at {own:?} m")));
    }
    if paths.targets != artifact_headers::body_ids(chain.header) {
        let [theirs, own] =
            [&paths.targets, &artifact_headers::body_ids(chain.header)].map(|ids| first_ids(ids));
        return Err(Failure::refused(format!("traced of the bodies {theirs}, the scene has {own}")));
    }
    let files = files.get(1..).unwrap_or_default();
    provenance_checks::same_files(files, &from.inputs)?;
    let others = |of: &[(String, String)], beside: &[(String, String)]| -> Option<String> {
        of.iter().find(|file| is_mesh(&file.0) && !beside.contains(file)).map(|(name, _)| name.clone())
    };
    match (others(files, &from.inputs), others(&from.inputs, files)) {
        _ if from.inputs.is_empty() => {}
        (None, None) => provenance_checks::are_of_same_bodies(chain.header, from)?,
        (Some(own), _) => return Err(Failure::refused(format!("not traced of the scene's mesh `{own}`"))),
        (_, Some(theirs)) => {
            return Err(Failure::refused(format!("traced of the mesh `{theirs}`, not the scene's")));
        }
    }
    provenance_checks::of_same_physics(chain.header, &said.keys, from)?.into_iter().for_each(progress::note);
    Ok(())
}

/// Whether a file with this name holds the mesh of a body.
fn is_mesh(name: &str) -> bool {
    let kind = Path::new(name).extension().and_then(|kind| kind.to_str()).unwrap_or_default();
    ["glb", "gltf", "stl", "obj", "xoma"].contains(&kind.to_lowercase().as_str())
}

/// Refuses a frame of another time, or with a lit body where the scene has none.
pub(crate) fn check_frame(header: &SceneHeader, frame: &PathsFrame) -> Result<SceneFrame, Failure> {
    let index = frame.index;
    if index >= header.frames {
        let rule = format!("frame {index} is none of the scene's {}", header.frames);
        return Err(Failure::refused(rule));
    }
    let (view, snapshot) = (scene::frame_view(header, index), scene::snapshot(header, index));
    if !is_same_time(frame.time_s, snapshot.time_s) {
        let (theirs, own) = (frame.time_s, snapshot.time_s);
        return Err(Failure::refused(format!("frame {index} begins at {theirs} s, the scene's at {own} s")));
    }
    let elsewhere = (0..view.targets.len()).find(|body| {
        let nearest_m = frame.nearest_range_m.get(*body).copied().flatten();
        nearest_m.is_some_and(|range_m| !may_be_lit_at(&view, &snapshot, *body, range_m))
    });
    let elsewhere = elsewhere.or_else(|| point_elsewhere(header, frame, &snapshot));
    elsewhere.map_or(Ok(snapshot), |body| {
        let id = &view.targets[body].id;
        Err(Failure::refused(format!("frame {index}: `{id}` was lit where it is not in the scene")))
    })
}

/// Index in the frame of a point target whose path is elsewhere than the point.
fn point_elsewhere(header: &SceneHeader, frame: &PathsFrame, snapshot: &SceneFrame) -> Option<usize> {
    let in_view = scene::bodies_in_view(header, frame.index);
    let of_points = frame.paths.iter().filter(|path| path.order == 0);
    of_points.filter_map(|path| Some((path, in_view.iter().position(|body| *body == path.target)?))).find_map(
        |(path, body)| {
            let place_m = DVec3::from(snapshot.poses.get(body)?.position_m);
            (place_m.distance(DVec3::from(path.apparent_tx_m)) > BEYOND_M).then_some(body)
        },
    )
}

/// Whether a body's nearest lit surface can be at this range in the frame.
fn may_be_lit_at(view: &SceneHeader, frame: &SceneFrame, body: usize, range_m: f64) -> bool {
    let Some(pose) = frame.poses.get(body) else { return true };
    let reach_m = view.mesh_of(&view.targets[body].kind).map_or(0.0, Mesh::reach_m);
    let way_m = DVec3::from(pose.velocity_mps).length() * view.radar.frame_duration_s();
    let origin_m = DVec3::from(pose.position_m).distance(DVec3::from(view.radar.position_m));
    (range_m - origin_m).abs() <= reach_m + way_m + BEYOND_M
}

/// The first of some ids, as text.
fn first_ids(ids: &[String]) -> String {
    const TOLD: usize = 4;
    let told: Vec<String> = ids.iter().take(TOLD).map(|id| format!("`{id}`")).collect();
    let more = if ids.len() > TOLD { format!(" and {} more", ids.len() - TOLD) } else { String::new() };
    if ids.is_empty() { "none".to_owned() } else { told.join(", ") + &more }
}
