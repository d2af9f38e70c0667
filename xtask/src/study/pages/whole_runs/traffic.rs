//! Bodies found, and objects of nobody, in recorded traffic and beside it, by how far apart across the road
//! the points of an object may be.

use super::run_folder::RunFolder;
use super::scene_files::{text_of, with_key, without_key};
use crate::project::{project_root, shared};
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{CHAIN, RUN, SourcePaths};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use wayside::outcome::summary::FrameSummary;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    CHAIN,
    RUN,
    &[
        "scenes/intersection.toml",
        "scenes/tracking.toml",
        "scenes/traffic-minute.toml",
        "scenes/traffic.toml",
        "fixtures/junction.fcd.xml.gz",
        file!(),
    ],
];

/// Values of `cluster_cross_m` of the second table, the default first.
const ACROSS_M: [f64; 4] = [2.5, 2.2, 2.0, 1.8];

/// A scene, and where it is told of.
struct Case {
    name: &'static str,
    text: String,
    /// Rows of the first table: their names, with `cluster_cross_m`.
    rows: &'static [(&'static str, f64)],
    /// Name of the row of the second table; `None`: it has none.
    across: Option<&'static str>,
}

/// Both tables.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let cases = cases(extent)?;
    let work = Work::begin("scenes");
    let mut all = vec![];
    for (number, case) in cases.iter().enumerate() {
        work.at(number, cases.len());
        all.push(counts(case)?);
    }
    let told: Vec<(&Case, &Counts)> = cases.iter().zip(&all).collect();
    let mut part = PageSection::default();
    part.head(&["scene", "frames", "bodies", "found", "false", "false by cause"]);
    told.iter().for_each(|(case, counts)| first_rows(&mut part, case, counts));
    part.line("\nFound and false by `cluster_cross_m`:\n");
    let across = ACROSS_M.map(|across_m| format!("{across_m:.1} m"));
    let head = std::iter::once("scene").chain(across.iter().map(String::as_str));
    part.head(&head.collect::<Vec<_>>());
    told.iter().for_each(|(case, counts)| second_row(&mut part, case, counts));
    if !sumo().exists() {
        part.line(format!("\nScenes of SUMO are left out: {} is not here.", sumo().display()));
    }
    Ok(part)
}

fn sumo() -> PathBuf {
    shared().join("sumo")
}

/// All scenes, those of SUMO where their recordings are; for a quick study the intersection.
fn cases(extent: Extent) -> Result<Vec<Case>, Failure> {
    let intersection = Case {
        name: "intersection",
        text: text_of("intersection")?,
        rows: &[("`scenes/intersection.toml`", 2.5)],
        across: Some("`scenes/intersection.toml`"),
    };
    if extent == Extent::Quick {
        return Ok(vec![intersection]);
    }
    let traffic = text_of("traffic")?;
    let once = without_key(&with_key(&traffic, "fidelity", "bounces", 1), "between_bodies");
    let mut all = vec![
        Case {
            name: "traffic",
            text: traffic,
            rows: &[
                ("`scenes/traffic.toml`, three bounces, bodies left apart", 2.2),
                ("the same with the default `cluster_cross_m` of 2.5", 2.5),
            ],
            across: Some("`scenes/traffic.toml`"),
        },
        Case {
            name: "once",
            text: once,
            rows: &[("the same with `bounces = 1` and no `between_bodies`", 2.2)],
            across: None,
        },
    ];
    all.extend(recorded()?);
    let tracking = Case {
        name: "tracking",
        text: text_of("tracking")?,
        rows: &[],
        across: Some("`scenes/tracking.toml`"),
    };
    all.extend([tracking, intersection]);
    Ok(all)
}

/// A minute of each recording, in frames far enough apart not to repeat each other.
fn recorded() -> Result<Vec<Case>, Failure> {
    let own = project_root().join("fixtures/junction.fcd.xml.gz");
    let mut all = vec![Case {
        name: "junction",
        text: minute(&own, 1, 0.9, [32.0, 59.0])?,
        rows: &[("the same junction, 32.0 to 59.0 s", 2.5)],
        across: Some("the same junction, 32.0 to 59.0 s"),
    }];
    if sumo().exists() {
        all.push(Case {
            name: "junction4",
            text: minute(&sumo().join("junction4.fcd.xml.gz"), 2, 1.4, [60.0, 119.5])?,
            rows: &[("`junction4` of SUMO, 60.0 to 119.5 s", 2.5)],
            across: Some("`junction4`"),
        });
        all.push(Case {
            name: "approach3",
            text: minute(&sumo().join("approach3.fcd.xml"), 3, 1.5, [30.0, 89.5])?,
            rows: &[("`approach3` of SUMO, 30.0 to 89.5 s", 2.5)],
            across: None,
        });
    }
    Ok(all)
}

/// The scene `traffic-minute.toml` with another recording, errors measured in every fifth frame.
fn minute(
    recording: &Path,
    seed: u64,
    interval_s: f64,
    [begin_s, end_s]: [f64; 2],
) -> Result<String, Failure> {
    let changes = [
        ("", "seed", seed.to_string()),
        ("", "frame_interval_s", format!("{interval_s:.1}")),
        ("fidelity", "measured_every", "5".to_owned()),
        ("traffic", "fcd", format!("{recording:?}")),
        ("traffic", "begin_s", format!("{begin_s:.1}")),
        ("traffic", "end_s", format!("{end_s:.1}")),
    ];
    let change = |text: String, (table, key, value): (&str, &str, String)| with_key(&text, table, key, value);
    Ok(changes.into_iter().fold(text_of("traffic-minute")?, change))
}

/// Counts of a scene's runs, in the order of [`ACROSS_M`]; `None` where neither table tells of one.
type Counts = [Option<Count>; ACROSS_M.len()];

/// Runs a scene for each `cluster_cross_m` that is told of, over the same cubes.
fn counts(case: &Case) -> Result<Counts, Failure> {
    let runs = RunFolder::new()?;
    let mut counts = Counts::default();
    for (count, across_m) in counts.iter_mut().zip(ACROSS_M) {
        if case.across.is_none() && case.rows.iter().all(|(_, of_row_m)| *of_row_m != across_m) {
            continue;
        }
        let text = with_key(&case.text, "dsp", "cluster_cross_m", format!("{across_m:.1}"));
        let name = format!("{}-{across_m:.1}", case.name);
        *count = Some(Count::of(&runs.summary(&name, &text, |_| ())?.frames));
    }
    Ok(counts)
}

fn first_rows(part: &mut PageSection, case: &Case, counts: &Counts) {
    for (name, of_row_m) in case.rows {
        let counted = ACROSS_M.iter().zip(counts).find(|(across_m, _)| *across_m == of_row_m);
        if let Some((_, Some(count))) = counted {
            part.named_row(name, count.cells());
        }
    }
}

fn second_row(part: &mut PageSection, case: &Case, counts: &Counts) {
    let (Some(name), [Some(first), ..]) = (case.across, counts) else { return };
    let cell = |count: &Option<Count>| {
        count.as_ref().map_or("–".to_owned(), |count| format!("{}, {}", count.found, count.false_ones()))
    };
    part.named_row(&format!("{name}, of {}", first.bodies), counts.iter().map(cell));
}

/// Bodies and objects over all frames of a run.
struct Count {
    frames: usize,
    /// Bodies with an echo of their own.
    bodies: usize,
    found: usize,
    /// Objects of nobody by their causes.
    causes: BTreeMap<&'static str, usize>,
}

impl Count {
    fn of(frames: &[FrameSummary]) -> Self {
        let targets = || frames.iter().flat_map(|frame| &frame.targets);
        let mut causes: BTreeMap<&'static str, usize> = BTreeMap::new();
        for object in frames.iter().flat_map(|frame| &frame.false_objects) {
            *causes.entry(object.cause.name()).or_default() += 1;
        }
        Self {
            frames: frames.len(),
            bodies: targets().filter(|target| target.found.is_some()).count(),
            found: targets().filter(|target| target.found == Some(true)).count(),
            causes,
        }
    }

    fn false_ones(&self) -> usize {
        self.causes.values().sum()
    }

    fn cells(&self) -> [String; 5] {
        let share = 100.0 * self.found as f64 / self.bodies.max(1) as f64;
        let causes: Vec<String> =
            self.causes.iter().map(|(cause, count)| format!("{count} {cause}")).collect();
        [
            self.frames.to_string(),
            self.bodies.to_string(),
            format!("{} ({share:.1} %)", self.found),
            self.false_ones().to_string(),
            causes.join(", "),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wayside::outcome::summary::{Cause, FalseObject, TargetSummary};

    #[test]
    fn every_scene_is_read_and_has_the_frames_of_the_page() {
        let frames = [("traffic", 20), ("once", 20), ("junction", 31), ("tracking", 24), ("intersection", 1)];
        let cases = cases(Extent::Full).unwrap();
        for (name, frames) in frames {
            let case = cases.iter().find(|case| case.name == name).unwrap();
            let text = with_key(&case.text, "dsp", "cluster_cross_m", "2.0").replace("name = ", "# ");
            let header = crate::study::scenes::scene_of(&text).unwrap();
            assert_eq!(header.frames, frames, "{name}");
        }
    }

    #[test]
    fn bodies_without_an_echo_are_no_bodies_and_false_objects_are_told_by_cause() {
        let target = |found| TargetSummary { found, ..TargetSummary::default() };
        let object = |cause| FalseObject { cause, ..FalseObject::default() };
        let frame = FrameSummary {
            targets: vec![target(Some(true)), target(Some(false)), target(None)],
            false_objects: vec![object(Cause::Split), object(Cause::Noise), object(Cause::Split)],
            ..FrameSummary::default()
        };
        assert_eq!(Count::of(&[frame]).cells(), ["1", "2", "1 (50.0 %)", "3", "1 noise, 2 split"]);
    }
}
