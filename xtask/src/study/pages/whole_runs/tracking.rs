//! Objects and tracks of scenes over many frames, against truth.

use super::run_folder::RunFolder;
use super::scene_files::{text_of, with_key};
use crate::study::extent::Extent;
use crate::study::pages::page_section::{PageSection, figure_or_dash};
use crate::study::sources::{CHAIN, RUN, SourcePaths};
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use wayside::outcome::summary::{Agreement, IdentityMetrics, Metrics};

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    CHAIN,
    RUN,
    &["scenes/tracking.toml", "scenes/traffic-minute.toml", "fixtures/junction.fcd.xml.gz", file!()],
];

/// Names of columns, and scenes.
const SCENES: [(&str, &str); 2] = [("tracking", "tracking"), ("junction", "traffic-minute")];

/// Frames of the first scene for a quick study; a track counts from its third frame.
const QUICK_FRAMES: u32 = 4;

/// A column of objects and one of tracks for each scene; for a quick study the first frames of one.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let scenes = if extent == Extent::Quick { &SCENES[..1] } else { &SCENES[..] };
    let work = Work::begin("scenes");
    let mut all = vec![];
    for (number, (_, scene)) in scenes.iter().enumerate() {
        work.at(number, scenes.len());
        all.push(metrics(scene, extent)?);
    }
    let mut part = PageSection::default();
    let head = scenes.iter().flat_map(|(name, _)| [format!("{name}: objects"), "tracks".to_owned()]);
    let head: Vec<String> = std::iter::once(String::new()).chain(head).collect();
    part.head(&head.iter().map(String::as_str).collect::<Vec<_>>());
    for (name, cell) in ROWS {
        part.named_row(name, all.iter().flat_map(|of| [cell(&of.objects), cell(&of.tracks)]));
    }
    let of_tracks = all.iter().flat_map(|of| [String::new(), identities(&of.identities)]);
    part.named_row("bodies; tracks; changes of a body's track; purity", of_tracks);
    Ok(part)
}

fn metrics(scene: &str, extent: Extent) -> Result<Metrics, Failure> {
    let text = text_of(scene)?;
    let text = match extent {
        Extent::Quick => with_key(&text, "", "frames", QUICK_FRAMES),
        Extent::Full => text,
    };
    Ok(RunFolder::new()?.summary(scene, &text, |settings| settings.cache = None)?.metrics)
}

type Cell = fn(&Agreement) -> String;

const ROWS: [(&str, Cell); 5] = [
    ("GOSPA, m", |agreement| figure_or_dash(agreement.gospa_m, 2)),
    ("OSPA, m", |agreement| figure_or_dash(agreement.ospa_m, 2)),
    ("error of positions found, m rms", |agreement| figure_or_dash(agreement.localisation_rms_m, 2)),
    ("found, missed, false", |agreement| {
        format!("{}, {}, {}", agreement.found, agreement.missed, agreement.false_ones)
    }),
    ("lane correct, of those found in a lane", |agreement| figure_or_dash(agreement.lane_rate, 3)),
];

fn identities(of_tracks: &IdentityMetrics) -> String {
    let IdentityMetrics { bodies, tracks, switches, purity } = of_tracks;
    format!("{bodies}; {tracks}; {switches}; {}", figure_or_dash(*purity, 3))
}
