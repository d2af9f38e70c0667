//! Rules of what the keys of a recipe may say together, and before its base scenes.

use crate::dataset::recipe::document::{Base, Document};
use crate::dataset::recipe::error::RecipeError;
use crate::dataset::recipe::keys;
use artifact::scene::SceneHeader;
use artifact::settings::{EchoMode, Noise};
use scene::document::section::Section;

/// Distance along the road from the radar at which a vehicle stands at least, whatever range was drawn.
pub(in crate::dataset) const NEAREST_ALONG_M: f64 = 1.0;

/// Notes every rule that the recipe breaks by itself.
pub(super) fn check_alone(root: &Section<'_>, document: &Document) {
    check_spans(root, document);
    match (root.has(keys::SCENE.name), root.has(keys::SCENES.name)) {
        (true, true) => root.note(keys::SCENES.name, RecipeError::BaseScenesTwice.into()),
        (false, false) => root.note(keys::SCENE.name, RecipeError::NoBaseScene.into()),
        _ => {}
    }
}

fn check_spans(root: &Section<'_>, document: &Document) {
    let spans = [
        (keys::RANGE.name, Some(document.range_m)),
        (keys::SPEED.name, Some(document.speed_mps)),
        (keys::YAW.name, Some(document.yaw_deg)),
        (keys::OFFSET.name, Some(document.offset_m)),
        (keys::RADAR_HEIGHT.name, document.radar_height_m),
        (keys::TILT.name, document.tilt_deg),
        (keys::EXTRA_NOISE.name, Some(document.extra_noise_db)),
        (keys::VEHICLES_PER_SCENE.name, Some(document.vehicles_per_scene.map(f64::from))),
    ];
    for (key, found) in spans.into_iter().filter_map(|(key, span)| Some((key, span?))) {
        if found[1] < found[0] {
            root.note(key, RecipeError::EndsExchanged { key, found }.into());
        }
    }
}

/// Notes every rule that the recipe breaks before this base scene.
pub(super) fn check_before(root: &Section<'_>, document: &Document, Base { name, header }: &Base) {
    check_lanes(root, document, name, header);
    if header.noise == Noise::Absent && document.extra_noise_db != [0.0; 2] {
        root.note(keys::EXTRA_NOISE.name, RecipeError::NoNoise { scene: name.clone() }.into());
    }
    if header.fidelity.echo == EchoMode::RcsTable && document.statistical_share > 0.0 {
        root.note(keys::STATISTICAL_SHARE.name, RecipeError::PartsOfTables { scene: name.clone() }.into());
    }
    check_interval(root, document, name, header);
}

/// Notes frames that begin before the radar has ended the one before. The interval of the base scene matters
/// only where a scene has more frames than a cycle has sub-frames.
fn check_interval(root: &Section<'_>, document: &Document, name: &str, header: &SceneHeader) {
    let (scene, cycle_s) = (name.to_owned(), header.radar.cycle_duration_s());
    match document.frame_interval_s {
        Some(found_s) if found_s < cycle_s => {
            let broken = RecipeError::FrameInterval { scene, cycle_s, found_s };
            root.note(keys::FRAME_INTERVAL.name, broken.into());
        }
        None if document.frames > header.radar.schedule.sub_frames() && header.frame_interval_s < cycle_s => {
            let found_s = header.frame_interval_s;
            root.note(keys::FRAMES.name, RecipeError::FramesOverlap { scene, cycle_s, found_s }.into());
        }
        _ => {}
    }
}

fn check_lanes(root: &Section<'_>, document: &Document, name: &str, header: &SceneHeader) {
    let is_known = |lane: &u8| header.dsp.road.lanes.iter().any(|l| l.number == *lane);
    let unknown = document.lanes.iter().position(|lane| !is_known(lane));
    if let Some(number) = unknown {
        let known = header.dsp.road.lanes.iter().map(|lane| lane.number).collect();
        let broken = RecipeError::Lane { scene: name.to_owned(), found: document.lanes[number], known };
        root.note_element(keys::LANES.name, number, broken.into());
        return;
    }
    let (least_m, [_, found_m]) = (least_range_m(document, header), document.range_m);
    if !document.lanes.is_empty() && found_m < least_m {
        root.note(keys::RANGE.name, RecipeError::TooNear { scene: name.to_owned(), least_m, found_m }.into());
    }
}

/// Least slant range of a vehicle in the recipe's lanes: from the distance across the road, the lowest height
/// of the radar, and [`NEAREST_ALONG_M`].
fn least_range_m(document: &Document, header: &SceneHeader) -> f64 {
    let (road, [x_m, y_m, z_m]) = (&header.dsp.road, header.radar.position_m);
    let [radar_across_m, _] = road.across_along_m([x_m, y_m, z_m]);
    let lanes = road.lanes.iter().filter(|lane| document.lanes.contains(&lane.number));
    let aside_m = lanes.map(|lane| {
        let [low_m, high_m] = document.offset_m.map(|offset_m| lane.centre_m + offset_m - radar_across_m);
        low_m.max(-high_m).max(0.0)
    });
    let up_m = document.radar_height_m.map_or(z_m, |[least_m, _]| least_m);
    aside_m.fold(f64::INFINITY, f64::min).hypot(up_m).hypot(NEAREST_ALONG_M)
}
