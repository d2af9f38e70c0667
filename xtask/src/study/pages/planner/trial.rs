//! A plan of one scene, its truth, and the same scene at other settings.

use crate::study::looks;
use artifact::Accuracy;
use artifact::paths::PathsFrame;
use artifact::scene::SceneHeader;
use artifact::settings::{BetweenBodies, Edges};
use artifact::units::db_from_amplitude;
use bart_rcs::{FrameSurroundings, PathView, Tracer, scattering_of_paths, usual_road};
use glam::DVec3;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::host::processor_time;
use wayside::planning::told::PlanFigures;
use wayside::{Allowance, SceneSource};

/// A planned scene beside its truth.
#[derive(Serialize, Deserialize)]
pub(super) struct Trial {
    name: String,
    plan: PlanFigures,
    true_db: f64,
    /// Processor seconds of the plan and its paths.
    pub(super) planned_s: f64,
    /// Processor seconds of the paths with default keys at the accuracy asked.
    pub(super) as_said_s: f64,
}

/// Decibels by which the truth is finer than what is asked.
const FINER_DB: f64 = -10.0;
/// Order of the truth at least: what is beyond is told by no look either.
const BOUNCES: u8 = 4;
/// Highest order that edges are told of.
const EDGE_BOUNCES: u8 = 3;

impl Trial {
    pub(super) fn of(scene: &str, asked_db: f64) -> Result<Self, Failure> {
        let source = written(scene, asked_db)?;
        let (planned, look_s) = timed(|| planned(&source))?;
        let (header, plan) = planned;
        let (paths, paths_s) = timed(|| paths(&header))?;
        let as_said = with_default_keys(&source, asked_db)?;
        let (_, as_said_s) = timed(|| self::paths(&as_said))?;
        let true_db = db_from_amplitude(looks::relative_error(
            &Looks::of(&header, &paths),
            &truth(&as_said, &header, asked_db)?,
        ));
        Ok(Self { name: header.name, plan, true_db, planned_s: look_s + paths_s, as_said_s })
    }

    /// Decibels by which the true error is beyond what the plan spends.
    pub(super) fn beyond_db(&self) -> f64 {
        self.true_db - self.plan.spent_db
    }

    pub(super) fn cells(&self) -> [String; 9] {
        let db = |db: f64| format!("{db:.1}").replace('-', "−");
        let seconds = |s: f64| format!("{s:.1}");
        [
            self.name.clone(),
            db(self.plan.asked_db),
            db(self.plan.spent_db),
            self.plan.limited_by.clone(),
            self.plan.bounces.to_string(),
            db(self.plan.left_out_db),
            db(self.true_db),
            seconds(self.planned_s),
            seconds(self.as_said_s),
        ]
    }
}

/// The cheapest setting that keeps what a plan spends.
#[derive(Serialize, Deserialize)]
pub(super) struct Searched {
    name: String,
    spent_db: f64,
    planned_s: f64,
    look_s: f64,
    cheapest: Option<(String, f64)>,
}

impl Searched {
    pub(super) fn of(scene: &str, asked_db: f64) -> Result<Self, Failure> {
        let source = written(scene, asked_db)?;
        let ((header, plan), look_s) = timed(|| planned(&source))?;
        let (_, paths_s) = timed(|| paths(&header))?;
        let as_said = with_default_keys(&source, asked_db)?;
        let exact = truth(&as_said, &header, asked_db)?;
        let mut by_seconds: BTreeMap<u64, String> = BTreeMap::new();
        for (name, setting) in settings(&header, plan.spent_db) {
            let (paths, seconds) = timed(|| paths(&setting))?;
            if db_from_amplitude(looks::relative_error(&Looks::of(&setting, &paths), &exact)) <= plan.spent_db
            {
                by_seconds.insert((1e3 * seconds) as u64, name);
            }
        }
        let cheapest = by_seconds.pop_first().map(|(ms, name)| (name, ms as f64 / 1e3));
        let (name, spent_db) = (header.name, plan.spent_db);
        Ok(Self { name, spent_db, planned_s: look_s + paths_s, look_s, cheapest })
    }

    pub(super) fn cells(&self) -> [String; 7] {
        let (name, seconds) = self.cheapest.clone().unwrap_or_else(|| ("none does".into(), f64::NAN));
        [
            self.name.clone(),
            format!("{:.1}", self.spent_db).replace('-', "−"),
            format!("{:.2}", self.planned_s),
            format!("{:.2}", self.look_s),
            name,
            format!("{seconds:.2}"),
            format!("{:.2}", self.planned_s / seconds),
        ]
    }
}

/// Orders, road and accuracies of the integrals, all of them together.
fn settings(header: &SceneHeader, spent_db: f64) -> Vec<(String, SceneHeader)> {
    let mut all = vec![];
    for bounces in 1..=BOUNCES {
        for road in [None, usual_road()] {
            for finer_db in [0.0, -2.0, -5.0, -10.0] {
                let mut setting = header.clone();
                setting.fidelity.bounces = bounces;
                setting.fidelity.edges = Edges::Ignored;
                setting.fidelity.accuracy = Accuracy::from_db(spent_db + finer_db);
                let on = if road.is_some() { ", road" } else { "" };
                let name = format!("{bounces} bounces{on}, {:.0} dB", spent_db + finer_db).replace('-', "−");
                setting.road.clone_from(&road);
                all.push((name, setting));
            }
        }
    }
    all
}

/// The scene in a file of its own, with an accuracy that plans it.
fn written(scene: &str, asked_db: f64) -> Result<SceneSource, Failure> {
    // A file of its own for each: what was read is never written.
    let name = scene.split('"').nth(1).unwrap_or("scene");
    let file = crate::project::project_root().join(format!("out/study-planner/{name}.toml"));
    files::write_file(&file, scene.as_bytes())?;
    Ok(SceneSource { file, accuracy_db: Some(asked_db), ..SceneSource::default() })
}

fn planned(source: &SceneSource) -> Result<(SceneHeader, PlanFigures), Failure> {
    let planned = wayside::planning::scene(source, None, Allowance::of(None))?;
    let none = || Failure::refused("nothing scatters in the scene");
    Ok((planned.loaded.header, planned.plan.ok_or_else(none)?))
}

fn with_default_keys(source: &SceneSource, asked_db: f64) -> Result<SceneHeader, Failure> {
    let source = SceneSource { accuracy_db: None, ..source.clone() };
    let mut header = wayside::planning::scene(&source, None, Allowance::of(None))?.loaded.header;
    header.fidelity.accuracy = Accuracy::from_db(asked_db);
    Ok(header)
}

fn paths(header: &SceneHeader) -> Result<PathsFrame, Failure> {
    let (view, frame) = (scene::frame_view(header, 0), scene::snapshot(header, 0));
    let tracer = Tracer::new(header).map_err(Failure::refused)?;
    tracer.all_paths(&view, &frame, &FrameSurroundings::ALONE).map_err(Failure::refused)
}

/// Echo with everything on that goes together, by the node rule of the plan, and what edges add to it, which
/// do not go with the road.
fn truth(as_said: &SceneHeader, planned: &SceneHeader, asked_db: f64) -> Result<Vec<Complex64>, Failure> {
    let mut whole = as_said.clone();
    whole.fidelity.accuracy = Accuracy::from_db(asked_db + FINER_DB);
    whole.fidelity.bounces = BOUNCES.max(planned.fidelity.bounces);
    whole.fidelity.nodes = planned.fidelity.nodes;
    whole.fidelity.between_bodies = BetweenBodies::Traced;
    whole.road = usual_road();
    let mut first = whole.clone();
    (first.fidelity.bounces, first.road) = (EDGE_BOUNCES, None);
    let mut with_edges = first.clone();
    with_edges.fidelity.edges = Edges::FirstOrder;
    let of = |header: &SceneHeader| Ok::<_, Failure>(Looks::of(header, &paths(header)?));
    let (whole, first, with_edges) = (of(&whole)?, of(&first)?, of(&with_edges)?);
    Ok((0..whole.len()).map(|i| whole[i] + with_edges[i] - first[i]).collect())
}

/// S of a frame's paths at frequencies over the band, at three moments, between three pairs of elements.
struct Looks;

impl Looks {
    fn of(header: &SceneHeader, frame: &PathsFrame) -> Vec<Complex64> {
        let (array, waveform) = (&header.radar.array, &header.radar.waveform);
        let centre_hz = waveform.centre_frequency_hz();
        let (p, q) = array.polarization.indices();
        let mut seen = vec![];
        for look in 0..3 {
            let element =
                |elements: &[[f64; 3]]| DVec3::from_array(elements[look * (elements.len() - 1) / 2]);
            let view = PathView {
                transmitter_m: element(&array.tx_m),
                receiver_m: element(&array.rx_m),
                origin_m: DVec3::from_array(header.radar.position_m) + DVec3::Y,
                seconds: look as f64 * header.radar.frame_middle_s(),
                centre_frequency_hz: centre_hz,
            };
            let of = |i: i32| centre_hz + waveform.bandwidth_hz() * ((f64::from(i) + 0.5) / 16.0 - 0.5);
            seen.extend((0..16).map(|i| scattering_of_paths(&frame.paths, &view, of(i))[p][q]));
        }
        seen
    }
}

fn timed<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<(T, f64), Failure> {
    let begin = processor_time::of_process().unwrap_or(0.0);
    let value = work()?;
    Ok((value, processor_time::of_process().unwrap_or(0.0) - begin))
}
