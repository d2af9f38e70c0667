//! Run of a scene with several radars, side by side: `summary.json` and `report.html` are in the folder above
//! those of the radars.

use crate::run::earlier_results::EarlierResults;
use crate::run::leftovers;
use crate::run::radar_outcome::RadarOutcome;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::outcome::summary::{RadarsSummary, common_times_s};
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
    console_lines::lines_of_radars(&summary).iter().for_each(|line| tell(line));
    tell(&format!("report of all radars: {}", out.join("report.html").display()));
    Ok(summary)
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
