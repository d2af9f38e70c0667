//! A plan of one scene, its truth, and the same scene with other settings.

use super::random_scenes::RandomScene;
use crate::study::{rcs_solvers, scenes};
use artifact::Accuracy;
use artifact::paths::PathsFrame;
use artifact::scene::SceneHeader;
use artifact::settings::{BetweenBodies, Edges};
use artifact::units::{LOWEST_DB, db_from_amplitude};
use bart_rcs::{FrameContext, PathView, Tracer, scattering_of_paths, usual_road};
use glam::DVec3;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use wayside::chain::loading;
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::host::processor_time;
use wayside::planning::plan_figures::PlanFigures;
use wayside::{Allowance, SceneSource};

/// A planned scene with its truth.
#[derive(Serialize, Deserialize)]
pub(super) struct PlanTrial {
    name: String,
    plan: PlanFigures,
    true_db: f64,
    /// Processor seconds of the plan, its paths and their echo.
    pub(super) planned_s: f64,
    /// Processor seconds of paths and echo with default keys at the requested accuracy.
    pub(super) as_said_s: f64,
}

/// Decibels by which the truth is finer than a plan's budget.
const TRUTH_MARGIN_DB: f64 = -10.0;
/// Least order of the truth: higher orders are not measured by a look either.
const BOUNCES: u8 = 4;

impl PlanTrial {
    /// Makes the trial; `None` if nothing scatters.
    pub(super) fn of(scene: &RandomScene) -> Result<Option<Self>, Failure> {
        let Some(PlannedScene { source, header, plan, look_s }) = PlannedScene::of(scene)? else {
            return Ok(None);
        };
        let (paths, planned_s) = timed(|| echo(&header))?;
        let as_said = with_default_keys(&source, scene.asked_db)?;
        let (_, as_said_s) = timed(|| echo(&as_said))?;
        let truth = truth(&as_said, &header, plan.spent_db)?;
        let true_db =
            db_from_amplitude(rcs_solvers::relative_error(&ScatteringSamples::of(&header, &paths), &truth));
        Ok(Some(Self { name: header.name, plan, true_db, planned_s: look_s + planned_s, as_said_s }))
    }

    /// Decibels by which the true error exceeds the plan's budget.
    pub(super) fn excess_db(&self) -> f64 {
        self.true_db - self.plan.spent_db
    }

    pub(super) fn cells(&self) -> [String; 9] {
        let db = |db: f64| match db <= LOWEST_DB {
            true => "nothing".into(),
            false => format!("{db:.1}").replace('-', "−"),
        };
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

/// The cheapest setting that keeps a plan's budget.
#[derive(Serialize, Deserialize)]
pub(super) struct CheapestSetting {
    name: String,
    channels: usize,
    spent_db: f64,
    planned_s: f64,
    look_s: f64,
    cheapest: Option<(String, f64)>,
}

impl CheapestSetting {
    /// Finds the setting; `None` if nothing scatters.
    pub(super) fn of(scene: &RandomScene) -> Result<Option<Self>, Failure> {
        let Some(PlannedScene { source, header, plan, look_s }) = PlannedScene::of(scene)? else {
            return Ok(None);
        };
        let (_, planned_s) = timed(|| echo(&header))?;
        let as_said = with_default_keys(&source, scene.asked_db)?;
        let exact = truth(&as_said, &header, plan.spent_db)?;
        let mut by_seconds: BTreeMap<u64, String> = BTreeMap::new();
        for (name, setting) in settings(&header, plan.spent_db) {
            let (paths, seconds) = timed(|| echo(&setting))?;
            if db_from_amplitude(rcs_solvers::relative_error(
                &ScatteringSamples::of(&setting, &paths),
                &exact,
            )) <= plan.spent_db
            {
                by_seconds.insert((1e3 * seconds) as u64, name);
            }
        }
        let cheapest = by_seconds.pop_first().map(|(ms, name)| (name, ms as f64 / 1e3));
        let channels = header.radar.virtual_channels();
        let (name, spent_db, planned_s) = (header.name, plan.spent_db, look_s + planned_s);
        Ok(Some(Self { name, channels, spent_db, planned_s, look_s, cheapest }))
    }

    pub(super) fn cells(&self) -> [String; 8] {
        let (name, seconds) = self.cheapest.clone().unwrap_or_else(|| ("none does".into(), f64::NAN));
        [
            self.name.clone(),
            self.channels.to_string(),
            format!("{:.1}", self.spent_db).replace('-', "−"),
            format!("{:.2}", self.planned_s),
            format!("{:.2}", self.look_s),
            name,
            format!("{seconds:.2}"),
            format!("{:.2}", self.planned_s / seconds),
        ]
    }
}

/// All combinations of orders, road, edges and accuracies of the integrals.
fn settings(header: &SceneHeader, spent_db: f64) -> Vec<(String, SceneHeader)> {
    let mut all = vec![];
    for bounces in 1..=BOUNCES {
        for (road, edges) in [(false, false), (true, false), (false, true), (true, true)] {
            for finer_db in [0.0, -3.0, -10.0] {
                let mut setting = header.clone();
                setting.fidelity.bounces = bounces;
                setting.fidelity.edges = if edges { Edges::FirstOrder } else { Edges::Ignored };
                setting.fidelity.accuracy = Accuracy::from_db(spent_db + finer_db);
                setting.road = usual_road().filter(|_| road);
                let on = |is_on: bool, name: &'static str| if is_on { name } else { "" };
                let (road, edges) = (on(road, ", road"), on(edges, ", edges"));
                let name = format!("{bounces} bounces{road}{edges}, {:.0} dB", spent_db + finer_db);
                all.push((name.replace('-', "−"), setting));
            }
        }
    }
    all
}

/// Writes the scene to a separate file, with an accuracy that plans it.
fn write_scene(scene: &RandomScene) -> Result<SceneSource, Failure> {
    // A separate file for each: files that were read are never written.
    let file = crate::project::project_root().join(format!("out/study-planner/{}.toml", scene.name));
    files::write_file(&file, scene.text.as_bytes())?;
    Ok(SceneSource { file, accuracy_db: Some(scene.asked_db), ..SceneSource::default() })
}

/// A scene with its plan.
struct PlannedScene {
    source: SceneSource,
    header: SceneHeader,
    plan: PlanFigures,
    /// Processor seconds of planning, without reading the scene, which every run includes.
    look_s: f64,
}

impl PlannedScene {
    /// Plans a scene; `None` if nothing scatters.
    fn of(scene: &RandomScene) -> Result<Option<Self>, Failure> {
        let source = write_scene(scene)?;
        let (_, read_s) = timed(|| loading::scene(&source, None))?;
        let (planned, planning_s) = timed(|| wayside::planning::scene(&source, None, Allowance::of(None)))?;
        let header = planned.loaded.header;
        let look_s = (planning_s - read_s).max(0.0);
        Ok(planned.plan.map(|plan| Self { source, header, plan, look_s }))
    }
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
    tracer.all_paths(&view, &frame, &FrameContext::ALONE).map_err(Failure::refused)
}

/// Paths of the first frame; also makes its echo.
fn echo(header: &SceneHeader) -> Result<PathsFrame, Failure> {
    let paths = paths(header)?;
    scenes::cube_of(&scene::frame_view(header, 0), &paths)?;
    Ok(paths)
}

/// Echo with all physics, with the node rule of the plan.
fn truth(as_said: &SceneHeader, planned: &SceneHeader, spent_db: f64) -> Result<Vec<Complex64>, Failure> {
    let mut whole = as_said.clone();
    whole.fidelity.accuracy = Accuracy::from_db(spent_db + TRUTH_MARGIN_DB);
    whole.fidelity.bounces = BOUNCES.max(planned.fidelity.bounces);
    whole.fidelity.nodes = planned.fidelity.nodes;
    whole.fidelity.between_bodies = BetweenBodies::Traced;
    whole.road = usual_road();
    whole.fidelity.edges = Edges::FirstOrder;
    Ok(ScatteringSamples::of(&whole, &paths(&whole)?))
}

/// S of a frame's paths at frequencies over the band, at three times, between three pairs of elements.
struct ScatteringSamples;

impl ScatteringSamples {
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
