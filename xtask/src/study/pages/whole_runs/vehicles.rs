//! Real vehicles in place of the car of the first experiment, each in a process of its own.

use super::scene_files::place_of;
use crate::processes::{ProcessCosts, costs_of};
use crate::project::this_program;
use crate::study::extent::Extent;
use crate::study::pages::page_section::{PageSection, figure, figure_or_dash};
use crate::study::pages::real_vehicles;
use crate::study::sources::{CHAIN, RUN, SourcePaths};
use std::path::Path;
use std::process::Command;
use wayside::Summary;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use wayside::outcome::summary::{Estimate, FrameSummary, TargetSummary};

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[CHAIN, RUN, &["scenes/experiment-1.toml", file!()]];

/// Limits of a model.
const MOST: ProcessCosts = ProcessCosts { processor_s: 300.0, peak_mib: 4096.0 };

/// A row for each model, for a quick study for the first two. Without the models the page stays as it is.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let skipped = || {
        Failure::Refused(format!("{}: skipped: the models are not here", real_vehicles::folder().display()))
    };
    let mut files = real_vehicles::files().ok_or_else(skipped)?;
    files.truncate(if extent == Extent::Quick { 2 } else { files.len() });
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    let mut part = PageSection::default();
    part.head(&COLUMNS);
    let work = Work::begin("real vehicles");
    for (number, file) in files.iter().enumerate() {
        work.at(number, files.len());
        let vehicle = Vehicle::of(file, &folder.path().join(number.to_string()))?;
        part.row(&vehicle.cells());
        if vehicle.is_beyond_limits() {
            part.complain(format!("{} takes five minutes, 4 GiB, or is no number", vehicle.name));
        }
    }
    Ok(part)
}

const COLUMNS: [&str; 12] = [
    "model",
    "triangles",
    "paths",
    "points",
    "processor s",
    "MiB",
    "range found / echo, m",
    "velocity, m/s",
    "error, dB",
    "model: bounces, dB",
    "model: nodes, dB",
    "model: road left out, dB",
];

/// A run with a real vehicle.
struct Vehicle {
    name: String,
    triangles: usize,
    /// Costs of the process; `None` where the system does not report them.
    costs: Option<ProcessCosts>,
    frame: FrameSummary,
    target: TargetSummary,
}

impl Vehicle {
    fn of(file: &Path, out: &Path) -> Result<Self, Failure> {
        let (name, triangles) = (real_vehicles::name_of(file), real_vehicles::mesh(file)?.triangles.len());
        let mut command = Command::new(this_program()?);
        command.arg("run").arg(place_of("experiment-1")).arg("--model").arg(file).arg("--out").arg(out);
        let costs = costs_of(command.args(["--no-cache", "--quiet"]), file.display())?;
        let summary = Summary::read(&out.join("summary.json"))?;
        let missing = || Failure::Refused(format!("{name}: has no frame with a target"));
        let frame = summary.frames.into_iter().next().ok_or_else(missing)?;
        let target = frame.targets.first().cloned().ok_or_else(missing)?;
        Ok(Self { name, triangles, costs, frame, target })
    }

    fn is_beyond_limits(&self) -> bool {
        let is_dear =
            |costs: ProcessCosts| costs.processor_s >= MOST.processor_s || costs.peak_mib >= MOST.peak_mib;
        let is_no_number = |found: Estimate| !(found.range_m + found.radial_velocity_mps).is_finite();
        self.costs.is_some_and(is_dear) || self.target.estimate.is_some_and(is_no_number)
    }

    fn cells(&self) -> [String; 12] {
        let Self { target, frame, .. } = self;
        let (estimate, model) = (target.estimate, &frame.model_error_db);
        let echo_m = figure(target.truth.compared_range_m(), 2);
        let range = estimate.map(|found| format!("{} / {echo_m}", figure(found.range_m, 2)));
        [
            format!("`{}`", self.name),
            self.triangles.to_string(),
            frame.paths.map_or("–".to_owned(), |paths| paths.to_string()),
            frame.points.to_string(),
            figure_or_dash(self.costs.map(|costs| costs.processor_s), 2),
            figure_or_dash(self.costs.map(|costs| costs.peak_mib), 0),
            range.unwrap_or_else(|| format!("none / {echo_m}")),
            figure_or_dash(estimate.map(|found| found.radial_velocity_mps), 2),
            figure_or_dash(frame.error_db.total, 1),
            figure_or_dash(model.bounces, 1),
            figure_or_dash(model.nodes, 1),
            figure_or_dash(model.road, 1),
        ]
    }
}
