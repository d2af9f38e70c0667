//! Table 2 of the paper: its three experiments, run.

use super::run_folder::RunFolder;
use super::scene_files::text_of;
use crate::study::extent::Extent;
use crate::study::pages::page_section::{PageSection, figure, figure_or_dash};
use crate::study::sources::{CHAIN, RUN, SourcePaths};
use wayside::Summary;
use wayside::host::failure::Failure;
use wayside::outcome::summary::{FrameSummary, MapState, RadarSummary, TargetSummary};

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    CHAIN,
    RUN,
    &["scenes/experiment-1.toml", "scenes/experiment-2.toml", "scenes/experiment-3.toml", file!()],
];

/// Scenes with the paper's numbers of points.
const SCENES: [(&str, u32); 3] = [("experiment-1", 14), ("experiment-2", 15), ("experiment-3", 18)];

/// Makes the part; there are three short runs, whatever the extent.
pub(crate) fn section(_: Extent) -> Result<PageSection, Failure> {
    let runs = RunFolder::new()?;
    let of = |(name, points): &(&str, u32)| Experiment::of(&runs, name, *points);
    let all: Vec<Experiment> = SCENES.iter().map(of).collect::<Result<_, _>>()?;
    let mut part = PageSection::default();
    part.head(&["", "experiment 1", "experiment 2", "experiment 3"]);
    for (name, cell) in ROWS {
        part.named_row(name, all.iter().map(cell));
    }
    Ok(part)
}

/// Results of an experiment.
struct Experiment {
    points_of_paper: u32,
    radar: RadarSummary,
    frame: FrameSummary,
    car: TargetSummary,
}

impl Experiment {
    fn of(runs: &RunFolder, name: &str, points_of_paper: u32) -> Result<Self, Failure> {
        let Summary { radar, mut frames, .. } = runs.summary(name, &text_of(name)?, |_| ())?;
        let missing = || Failure::Refused(format!("{name}: has no frame with a target"));
        let mut frame = frames.pop().ok_or_else(missing)?;
        let car = frame.targets.pop().ok_or_else(missing)?;
        Ok(Self { points_of_paper, radar, frame, car })
    }
}

type Cell = fn(&Experiment) -> String;

const ROWS: [(&str, Cell); 13] = [
    ("sampling points", |e| e.radar.samples_per_chirp.to_string()),
    ("pulse time, µs", |e| figure(1e6 * e.radar.chirp_interval_s, 0)),
    ("bandwidth, GHz", |e| figure(1e-9 * e.radar.bandwidth_hz, 4)),
    ("distance resolution, m", |e| figure(e.radar.range_resolution_m, 4)),
    ("measurement speed, m/s", |e| figure(e.radar.velocity_max_mps, 3)),
    ("RDM display", |e| display(e.frame.rdm_state).to_owned()),
    ("points, here", |e| e.frame.points.to_string()),
    ("points, paper", |e| e.points_of_paper.to_string()),
    ("range found / mean of the echo, m", range),
    ("velocity found / true, m/s", velocity),
    ("lane", |e| e.car.estimate.and_then(|car| car.lane).map_or("none".to_owned(), |lane| lane.to_string())),
    ("numerical error, dB", |e| figure_or_dash(e.frame.error_db.total, 1)),
    ("spread of node rules (model), dB", |e| figure_or_dash(e.frame.model_error_db.nodes, 1)),
];

fn display(state: MapState) -> &'static str {
    match state {
        MapState::Normal => "normal",
        MapState::Abnormal => "abnormal",
    }
}

fn range(experiment: &Experiment) -> String {
    let found = figure_or_dash(experiment.car.estimate.map(|car| car.range_m), 2);
    format!("{found} / {}", figure(experiment.car.truth.compared_range_m(), 2))
}

/// Velocity found and true; where the map shows another one, with the span between them.
fn velocity(experiment: &Experiment) -> String {
    let signed = |mps: f64| format!("{mps:+.3}").replace('-', "−");
    let true_mps = experiment.car.truth.compared_radial_velocity_mps();
    let Some(found_mps) = experiment.car.estimate.map(|car| car.radial_velocity_mps) else {
        return format!("– / {}", signed(true_mps));
    };
    let span_mps = 2.0 * experiment.radar.velocity_max_mps;
    let folded_mps = span_mps * ((found_mps - true_mps) / span_mps).round();
    let told = format!("{} / {}", signed(found_mps), signed(true_mps));
    match folded_mps == 0.0 {
        true => told,
        false => format!("{told} ({} = {})", signed(folded_mps), signed(true_mps + folded_mps)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wayside::outcome::summary::{Estimate, TruthSummary};

    #[test]
    fn a_folded_velocity_is_told_with_its_span() {
        let header = crate::study::scenes::scene_of("").unwrap();
        let radar = RadarSummary { velocity_max_mps: 8.75, ..RadarSummary::of(&header) };
        let of = |found_mps: f64| {
            let estimate = Estimate {
                range_m: 38.36,
                radial_velocity_mps: found_mps,
                x_m: 5.75,
                y_m: 38.0,
                z_m: 0.0,
                lane: Some(2),
                snr_db: 30.0,
                points: 9,
                ghost_share: None,
                stationary: None,
            };
            let truth = TruthSummary { radial_velocity_mps: -9.5, range_m: 38.25, ..TruthSummary::default() };
            let car = TargetSummary { estimate: Some(estimate), truth, ..TargetSummary::default() };
            let frame = FrameSummary::default();
            velocity(&Experiment { points_of_paper: 14, radar: radar.clone(), frame, car })
        };
        assert_eq!(of(-9.25), "−9.250 / −9.500");
        assert_eq!(of(7.75), "+7.750 / −9.500 (+17.500 = +8.000)");
    }
}
