//! Rules of what the keys of a recipe may say.

use crate::dataset::document::{Base, Document};
use artifact::settings::Noise;

/// Scenes of a class: at a second a scene a week and a half.
const SCENES_LIMIT: u32 = 1_000_000;
/// Vehicles of a scene: more than stand within reach of a radar in three lanes.
pub(super) const VEHICLES_LIMIT: u32 = 16;
/// Frames of a scene: a minute and a half at ten a second.
pub(super) const FRAMES_LIMIT: u32 = 1000;

/// The first rule that is broken.
pub(super) fn check(asked: &Document, bases: &[Base]) -> Result<(), String> {
    check_spans(asked)?;
    check_counts(asked)?;
    check_vehicles(asked)?;
    bases.iter().try_for_each(|base| check_base(asked, base))
}

fn check_spans(asked: &Document) -> Result<(), String> {
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

fn check_span(name: &str, [low, high]: [f64; 2], [least, most]: [f64; 2]) -> Result<(), String> {
    if low >= least && high >= low && high <= most {
        return Ok(());
    }
    let least = if least == f64::MIN_POSITIVE { "positive".into() } else { format!("at least {least}") };
    Err(format!("{name} must be [least, greatest], {least}, at most {most}, is [{low}, {high}]"))
}

fn check_counts(asked: &Document) -> Result<(), String> {
    if asked.vehicle_seeds == 0 || asked.scenes_per_class == 0 {
        return Err("vehicle_seeds and scenes_per_class must be at least 1".into());
    }
    if asked.scenes_per_class > SCENES_LIMIT {
        return Err(format!(
            "scenes_per_class must be at most {SCENES_LIMIT}, is {}",
            asked.scenes_per_class
        ));
    }
    if asked.scenes_per_shard == 0 {
        return Err("scenes_per_shard must be at least 1".into());
    }
    match asked.frames {
        1..=FRAMES_LIMIT => Ok(()),
        other => Err(format!("frames must be from 1 to {FRAMES_LIMIT}, is {other}")),
    }
}

fn check_vehicles(asked: &Document) -> Result<(), String> {
    let [least, most] = asked.vehicles_per_scene;
    if least < 1 || most < least || most > VEHICLES_LIMIT {
        let is = asked.vehicles_per_scene;
        return Err(format!(
            "vehicles_per_scene must be [least, most], from 1 to {VEHICLES_LIMIT}, is {is:?}"
        ));
    }
    match asked.queue_share {
        0.0..=1.0 => Ok(()),
        other => Err(format!("queue_share must be from 0 to 1, is {other}")),
    }
}

fn check_base(asked: &Document, Base { name, header }: &Base) -> Result<(), String> {
    let known = |lane: &u8| header.dsp.road.lanes.iter().any(|l| l.number == *lane);
    if asked.lanes.is_empty() || !asked.lanes.iter().all(known) {
        return Err(format!("lanes must be some of the scene's ({name}), are {:?}", asked.lanes));
    }
    if header.noise == Noise::Absent && asked.extra_noise_db != [0.0; 2] {
        return Err(format!("extra_noise_db: {name} has no noise that could grow"));
    }
    let duration_s = header.radar.cycle_duration_s();
    match asked.frame_interval_s {
        Some(interval_s) if !(duration_s..=1e4).contains(&interval_s) => Err(format!(
            "frame_interval_s must be from {duration_s} (a frame of {name}) to 10000, is {interval_s}"
        )),
        _ => Ok(()),
    }
}
