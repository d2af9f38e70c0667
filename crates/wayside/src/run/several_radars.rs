//! Run of a scene with several radars, side by side: `summary.json` and `report.html` are in the folder above
//! those of the radars.

use crate::run::earlier_results::EarlierResults;
use crate::run::leftovers;
use crate::run::radar_outcome::RadarOutcome;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use pipeline::outcome::summary::{RadarsSummary, Summary, common_times_s};
use plotting::layout::Figure;
use reporting::console_lines;
use reporting::pictures;
use reporting::pictures::common_view;
use reporting::report::{self, FRAMES_DRAWN, ReportOrigin};
use std::path::{Path, PathBuf};

/// Folder of the radars' common results, above those of the radars.
pub(crate) fn above(out: &Path) -> &Path {
    out.parent().unwrap_or(Path::new(""))
}

/// Folder of the radars' common pictures, beside those of the radars.
const PICTURES: &str = "pictures";

/// Refuses a radar whose folder would be that of the common pictures; common files are claimed ([`places`]).
pub(crate) fn check_names(scene: &Path, radars: &[String]) -> Result<(), Failure> {
    if radars.iter().all(|id| id != PICTURES) {
        return Ok(());
    }
    Err(Failure::Refused(format!(
        "{}: [[radars]] `{PICTURES}`: its folder would be that of the pictures of all radars; give it another \
         `id`, or run it alone (--radar {PICTURES})",
        scene.display()
    )))
}

/// Common files of radars with `frames` common frames.
pub(crate) fn places(out: &Path, frames: usize) -> Vec<PathBuf> {
    let pictures = (0..frames.min(FRAMES_DRAWN)).map(|number| picture(out, number));
    ["summary.json", "report.html"].map(|name| out.join(name)).into_iter().chain(pictures).collect()
}

/// Common picture of a frame.
fn picture(out: &Path, number: usize) -> PathBuf {
    out.join(PICTURES).join(format!("scene-{number:04}.png"))
}

/// Writes the common results, one folder above those of the radars, and prints them.
pub(crate) fn conclude(
    radars: &[RadarOutcome],
    origin: &ReportOrigin,
    tell: &dyn Fn(&str),
) -> Result<RadarsSummary, Failure> {
    let out = above(&radars[0].out);
    let by_id: Vec<_> = radars.iter().map(|radar| (radar.id(), &radar.summary)).collect();
    let summary = RadarsSummary::of(&by_id);
    let views = views(radars);
    for (number, view) in views.iter().enumerate() {
        pictures::write_png(&picture(out, number), &view.wide)?;
    }
    files::write_file(&out.join("summary.json"), summary.json()?.as_bytes())?;
    report::write_several(&summary, &by_id, &views, origin, out)?;
    EarlierResults::in_common(out, views.len() as u32).are_whole()?;
    leftovers::remark(out, &[], |kind, number| kind == "scene" && (number as usize) < views.len());
    leftovers::note(out, other_radars(out, &summary));
    console_lines::lines_of_radars(&summary).iter().for_each(|line| tell(line));
    tell(&format!("report of all radars: {}", out.join("report.html").display()));
    Ok(summary)
}

/// Folders of radars that an earlier run had and this one does not have. Their own summaries tell them: the
/// common one is replaced, and names those of the last run alone.
fn other_radars(out: &Path, summary: &RadarsSummary) -> Vec<String> {
    let folders = std::fs::read_dir(out).into_iter().flatten().flatten();
    let names = folders.filter_map(|folder| folder.file_name().into_string().ok());
    let is_other = |name: &String| {
        summary.radars.iter().all(|radar| radar.id != *name) && is_of_radar(&out.join(name), name)
    };
    names.filter(is_other).collect()
}

/// Whether a folder holds the results of one of several radars, which is named as the folder.
fn is_of_radar(folder: &Path, name: &str) -> bool {
    let summary = Summary::read(&folder.join("summary.json"));
    summary.is_ok_and(|summary| summary.scene.rsplit_once('/').is_some_and(|(_, radar)| radar == name))
}

/// Notes that the common results above those of radar `id`, run alone, are of an earlier run.
pub(crate) fn remark_earlier(out: &Path, id: &str) {
    let file = above(out).join("summary.json");
    let Ok(summary) = RadarsSummary::read(&file) else { return };
    if out.file_name().is_some_and(|name| name == id) && summary.radars.iter().any(|radar| radar.id == id) {
        progress::note(format!(
            "note: {}: describes an earlier run of radar `{id}` with all others, and nothing of this one",
            file.display()
        ));
    }
}

/// Views from above of the first common frames, as long as every radar has a frame beginning then.
fn views(radars: &[RadarOutcome]) -> Vec<Figure> {
    let times_s = |radar: &RadarOutcome| radar.frames.iter().map(|frame| frame.scene.time_s).collect();
    let times_s: Vec<Vec<f64>> = radars.iter().map(times_s).collect();
    let view = |(number, time_s): (usize, f64)| {
        let all: Vec<_> =
            radars.iter().filter_map(|radar| Some((radar.id(), radar.frame_at(time_s)?))).collect();
        common_view(number, &all)
    };
    common_times_s(&times_s).into_iter().enumerate().map(view).collect()
}
