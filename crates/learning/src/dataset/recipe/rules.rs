//! Rules of what the keys of a recipe may say.

use crate::dataset::recipe::document::{Base, Document};
use crate::dataset::recipe::error::RecipeError;
use artifact::scene::SceneHeader;
use artifact::seed::SEEDS;
use artifact::settings::Noise;

/// Scenes of a class: at a second a scene a week and a half.
const SCENES_LIMIT: u32 = 1_000_000;
/// Vehicles of a scene: more than stand within reach of a radar in three lanes.
pub(in crate::dataset) const VEHICLES_LIMIT: u32 = 16;
/// Distance along the road from the radar at which a vehicle stands at least, whatever range was drawn.
pub(in crate::dataset) const NEAREST_ALONG_M: f64 = 1.0;
/// Frames of a scene: a minute and a half at ten a second.
pub(in crate::dataset) const FRAMES_LIMIT: u32 = 1000;

/// The first rule that is broken.
pub(super) fn check(asked: &Document, bases: &[Base]) -> Result<(), RecipeError> {
    check_spans(asked)?;
    check_counts(asked)?;
    check_vehicles(asked)?;
    bases.iter().try_for_each(|base| check_base(asked, base))
}

fn check_spans(asked: &Document) -> Result<(), RecipeError> {
    // As far and as fast as a scene's targets.
    let spans = [
        ("range_m", Some(asked.range_m), [f64::MIN_POSITIVE, 1e5]),
        ("speed_mps", Some(asked.speed_mps), [0.0, 340.0]),
        ("yaw_deg", Some(asked.yaw_deg), [-180.0, 180.0]),
        ("offset_m", Some(asked.offset_m), [-100.0, 100.0]),
        ("radar_height_m", asked.radar_height_m, [f64::MIN_POSITIVE, 1e3]),
        ("tilt_deg", asked.tilt_deg, [-90.0, 90.0]),
        ("extra_noise_db", Some(asked.extra_noise_db), [-100.0, 100.0]),
    ];
    let known = spans.into_iter().filter_map(|(name, span, within)| Some((name, span?, within)));
    known.into_iter().try_for_each(|(name, span, within)| check_span(name, span, within))
}

fn check_span(key: &'static str, found: [f64; 2], [least, most]: [f64; 2]) -> Result<(), RecipeError> {
    let [low, high] = found;
    match low >= least && high >= low && high <= most {
        true => Ok(()),
        false => Err(RecipeError::Span { key, least, most, found }),
    }
}

fn check_counts(asked: &Document) -> Result<(), RecipeError> {
    // Variants of own vehicles are seeds too.
    let seeds = [("seed", asked.seed), ("vehicle_seeds", asked.vehicle_seeds)];
    if let Some((key, found)) = seeds.into_iter().find(|(_, found)| !SEEDS.contains(found)) {
        return Err(RecipeError::Seed { key, found });
    }
    if asked.vehicle_seeds == 0 || asked.scenes_per_class == 0 {
        return Err(RecipeError::NoSeedsOrScenes);
    }
    if asked.scenes_per_class > SCENES_LIMIT {
        return Err(RecipeError::TooManyScenes { limit: SCENES_LIMIT, found: asked.scenes_per_class });
    }
    if asked.scenes_per_shard == 0 {
        return Err(RecipeError::EmptyShards);
    }
    match asked.frames {
        1..=FRAMES_LIMIT => Ok(()),
        found => Err(RecipeError::Frames { limit: FRAMES_LIMIT, found }),
    }
}

fn check_vehicles(asked: &Document) -> Result<(), RecipeError> {
    let [least, most] = asked.vehicles_per_scene;
    if least < 1 || most < least || most > VEHICLES_LIMIT {
        return Err(RecipeError::Vehicles { limit: VEHICLES_LIMIT, found: asked.vehicles_per_scene });
    }
    match asked.queue_share {
        0.0..=1.0 => Ok(()),
        found => Err(RecipeError::QueueShare(found)),
    }
}

fn check_base(asked: &Document, Base { name, header }: &Base) -> Result<(), RecipeError> {
    let known = |lane: &u8| header.dsp.road.lanes.iter().any(|l| l.number == *lane);
    if asked.lanes.is_empty() || !asked.lanes.iter().all(known) {
        return Err(RecipeError::Lanes { scene: name.clone(), found: asked.lanes.clone() });
    }
    if header.noise == Noise::Absent && asked.extra_noise_db != [0.0; 2] {
        return Err(RecipeError::NoNoise { scene: name.clone() });
    }
    let (least_m, [_, found_m]) = (least_range_m(asked, header), asked.range_m);
    if found_m < least_m {
        return Err(RecipeError::TooNear { scene: name.clone(), least_m, found_m });
    }
    let cycle_s = header.radar.cycle_duration_s();
    match asked.frame_interval_s {
        Some(found_s) if !(cycle_s..=1e4).contains(&found_s) => {
            Err(RecipeError::FrameInterval { scene: name.clone(), cycle_s, found_s })
        }
        _ => Ok(()),
    }
}

/// Least slant range of a vehicle in the recipe's lanes: from the distance across the road, the lowest height
/// of the radar, and [`NEAREST_ALONG_M`].
fn least_range_m(asked: &Document, header: &SceneHeader) -> f64 {
    let (road, [x_m, y_m, z_m]) = (&header.dsp.road, header.radar.position_m);
    let [radar_across_m, _] = road.across_along_m([x_m, y_m, z_m]);
    let lanes = road.lanes.iter().filter(|lane| asked.lanes.contains(&lane.number));
    let aside_m = lanes.map(|lane| {
        let [low_m, high_m] = asked.offset_m.map(|offset_m| lane.centre_m + offset_m - radar_across_m);
        low_m.max(-high_m).max(0.0)
    });
    let up_m = asked.radar_height_m.map_or(z_m, |[least_m, _]| least_m);
    aside_m.fold(f64::INFINITY, f64::min).hypot(up_m).hypot(NEAREST_ALONG_M)
}
