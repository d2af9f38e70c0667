//! What several radars of one scene saw, side by side: `summary.json` and `report.html` above the folders of
//! each.

use crate::host::failure::Failure;
use crate::host::files;
use crate::outcome::told;
use crate::pictures;
use crate::pictures::common_view;
use crate::pictures::seen::Seen;
use crate::report::{self, Making};
use plotting::form::Figure;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A finished run through one radar.
pub(crate) struct Told {
    /// Its `summary.json`.
    pub(crate) summary: Value,
    /// Its first frames.
    pub(crate) seen: Vec<Seen>,
    /// Its folder; the last name is the radar's.
    pub(crate) out: PathBuf,
}

impl Told {
    fn id(&self) -> &str {
        self.out.file_name().and_then(|name| name.to_str()).unwrap_or_default()
    }

    fn frames(&self) -> &[Value] {
        self.summary["frames"].as_array().map_or(&[], Vec::as_slice)
    }
}

/// Writes what the radars have in common, one folder above theirs, and tells it.
pub(crate) fn conclude(radars: &[Told], making: &Making, tell: &dyn Fn(&str)) -> Result<Value, Failure> {
    let out = radars[0].out.parent().unwrap_or(Path::new(""));
    let summary = summary(radars);
    let text = serde_json::to_string_pretty(&summary).map_err(Failure::refused)?;
    let views = views(radars);
    for (number, view) in views.iter().enumerate() {
        pictures::write_png(&out.join(format!("pictures/scene-{number:04}.png")), &view.wide)?;
    }
    files::write_file(&out.join("summary.json"), text.as_bytes())?;
    report::write_several(&summary, &views, making, out)?;
    told::lines_of_radars(&summary).iter().for_each(|line| tell(line));
    tell(&format!("report of all radars: {}", out.join("report.html").display()));
    Ok(summary)
}

/// The first frames from above, as long as every radar has one: their frames are cut alike.
fn views(radars: &[Told]) -> Vec<Figure> {
    let frames = radars.iter().map(|radar| radar.seen.len()).min().unwrap_or(0);
    let view =
        |i: usize| common_view(&radars.iter().map(|radar| (radar.id(), &radar.seen[i])).collect::<Vec<_>>());
    (0..frames).map(view).collect()
}

/// `{scene, radars: [{id, seed, …}], frames: [{time_s, targets: [{id, class, found_by, missed_by}]}]}`.
fn summary(radars: &[Told]) -> Value {
    let scene = radars[0].summary["scene"].as_str().unwrap_or_default();
    let scene = scene.rsplit_once('/').map_or(scene, |(scene, _)| scene);
    let frames = radars.iter().map(|radar| radar.frames().len()).max().unwrap_or(0);
    json!({
        "scene": scene,
        "radars": radars.iter().map(radar).collect::<Vec<_>>(),
        "frames": (0..frames).map(|i| frame(radars, i)).collect::<Vec<_>>(),
    })
}

fn radar(radar: &Told) -> Value {
    let every = |key: &'static str| {
        radar.frames().iter().flat_map(move |frame| frame[key].as_array().into_iter().flatten())
    };
    let count = |found: Value| every("targets").filter(|target| target["found"] == found).count();
    let errors =
        || radar.frames().iter().filter_map(|frame| Some((frame, frame["error_db"]["total"].as_f64()?)));
    let worst = errors().max_by(|a, b| a.1.total_cmp(&b.1));
    json!({
        "id": radar.id(),
        "seed": radar.summary["seed"],
        "channels": radar.summary["radar"]["channels"],
        "frames": radar.frames().len(),
        "targets": every("targets").count(),
        "found": count(true.into()),
        "missed": count(false.into()),
        "false": every("false_objects").count(),
        "stationary": every("stationary_objects").count(),
        "removed": every("targets").filter(|target| target["removed"] == true).count(),
        "points": radar.frames().iter().filter_map(|frame| frame["points"].as_u64()).sum::<u64>(),
        "largest_error_db": worst.map(|(_, error)| error),
        "accuracy": worst.map(|(frame, _)| &frame["accuracy"]),
        "frames_seconds": radar.summary["frames_seconds"],
    })
}

/// A target that some radar has in view.
struct Common<'a> {
    id: &'a str,
    class: &'a Value,
    found_by: Vec<&'a str>,
    missed_by: Vec<&'a str>,
}

/// Every such target, and which radars found it of those that it sends something back to.
fn frame(radars: &[Told], index: usize) -> Value {
    let mut targets: Vec<Common> = vec![];
    for radar in radars {
        for target in
            radar.frames().get(index).and_then(|frame| frame["targets"].as_array()).into_iter().flatten()
        {
            let id = target["id"].as_str().unwrap_or_default();
            let place = targets.iter().position(|known| known.id == id).unwrap_or(targets.len());
            if place == targets.len() {
                targets.push(Common { id, class: &target["class"], found_by: vec![], missed_by: vec![] });
            }
            match target["found"].as_bool() {
                Some(true) => targets[place].found_by.push(radar.id()),
                Some(false) => targets[place].missed_by.push(radar.id()),
                None => {}
            }
        }
    }
    let time_s =
        radars.iter().find_map(|radar| radar.frames().get(index)).map_or(&Value::Null, |f| &f["time_s"]);
    let told = |t: &Common| json!({ "id": t.id, "class": t.class, "found_by": t.found_by, "missed_by": t.missed_by });
    json!({ "time_s": time_s, "targets": targets.iter().map(told).collect::<Vec<_>>() })
}
