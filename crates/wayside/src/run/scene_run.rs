//! `run`: a scene to all of its results.

use crate::remarks;
use crate::run::earlier_results::EarlierResults;
use crate::run::leftovers;
use crate::run::products::{self, Products};
use crate::run::radar_outcome::RadarOutcome;
use crate::run::several_radars;
use artifact::points::PointsFrame;
use artifact::scene::SceneHeader;
use artifact::tracks::TracksFrame;
use pipeline::chain::cache::{Cache, CacheLocation};
use pipeline::chain::expectation::{self, Expectation, ExpectedTotal};
use pipeline::chain::frames::{each_frame, resolved};
use pipeline::chain::link::{Chain, FrameProducts};
use pipeline::chain::loaded_model::LoadedModel;
use pipeline::chain::loading::{self, LoadedScene, SceneSource};
use pipeline::chain::plan::FramePlan;
use pipeline::chain::stages::Stage;
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::files::{self, FolderLock};
use pipeline::host::memory::Allowance;
use pipeline::host::processor_time;
use pipeline::host::progress::{self, FrameStage, Work};
use pipeline::outcome::frame_truth::frame_truth;
use pipeline::outcome::summary::{FrameSummary, Metrics, RadarsSummary, Summary};
use pipeline::outcome::tracking::Tracking;
use pipeline::planning::{self, PlannedScene};
use reporting::console_lines;
use reporting::report::figures::Figures;
use reporting::report::{self, ReportOrigin};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Settings of a run: the scene, and the way it is run.
pub struct Settings<'a> {
    /// Scene to run.
    pub scene: SceneSource,
    /// Folder of all results; `None`: `out/` and the scene's name.
    pub out: Option<PathBuf>,
    /// The classifier's model; `None`: the shipped one.
    pub classifier: Option<PathBuf>,
    /// Cache of frames; `None`: no cache.
    pub cache: Option<CacheLocation>,
    /// Memory allowed for tracing.
    pub memory: Allowance,
    /// Reports the planned work with its time and memory, and does nothing.
    pub dry_run: bool,
    /// Reports why each stage runs or not.
    pub explain: bool,
    /// Command that the report names.
    pub origin: ReportOrigin,
    /// Receives each line of results.
    pub tell: &'a dyn Fn(&str),
    /// Ends the run between two frames.
    pub cancellation: Cancellation,
}

impl Settings<'_> {
    /// Makes settings from a scene file and the folder of its results: the shipped model, the default cache,
    /// nine tenths of the free memory, and no output of lines.
    pub fn of(scene: impl Into<PathBuf>, out: impl Into<PathBuf>) -> Self {
        Self {
            scene: SceneSource { file: scene.into(), ..SceneSource::default() },
            out: Some(out.into()),
            classifier: None,
            cache: Some(CacheLocation::default()),
            memory: Allowance::of(None),
            dry_run: false,
            explain: false,
            origin: ReportOrigin::default(),
            tell: &|_| {},
            cancellation: Cancellation::default(),
        }
    }
}

/// Result of a run beside its files.
pub struct Outcome {
    of_radars: Vec<RadarOutcome>,
    of_all: Option<RadarsSummary>,
}

impl Outcome {
    /// Summary of a scene with one radar, as in `summary.json`; `None` after a dry run, and if the scene has
    /// several radars.
    pub fn summary(&self) -> Option<&Summary> {
        self.only_radar().map(RadarOutcome::summary)
    }

    /// Points and objects of every frame of a scene with one radar, read from `frames.points`; empty where
    /// [`Self::summary`] is `None`.
    ///
    /// ```no_run
    /// let outcome = wayside::run(&wayside::Settings::of("crossing.toml", "out/crossing"))?;
    /// for point in outcome.points()?.iter().flat_map(|frame| &frame.points) {
    ///     println!("{:.2} m, {:.1} dB", point.range_m, point.snr_db);
    /// }
    /// # Ok::<(), wayside::Failure>(())
    /// ```
    ///
    /// # Errors
    /// A file that was removed or damaged after the run.
    pub fn points(&self) -> Result<Vec<PointsFrame>, Failure> {
        self.only_radar().map_or(Ok(vec![]), RadarOutcome::points)
    }

    /// Tracks of every frame of a scene with one radar, read from `frames.tracks`; empty where
    /// [`Self::summary`] is `None`.
    ///
    /// ```no_run
    /// let outcome = wayside::run(&wayside::Settings::of("crossing.toml", "out/crossing"))?;
    /// for track in outcome.tracks()?.iter().flat_map(|frame| &frame.tracks) {
    ///     println!("{}: {:?} m, {:?}", track.id, track.position_m, track.state);
    /// }
    /// # Ok::<(), wayside::Failure>(())
    /// ```
    ///
    /// # Errors
    /// A file that was removed or damaged after the run.
    pub fn tracks(&self) -> Result<Vec<TracksFrame>, Failure> {
        self.only_radar().map_or(Ok(vec![]), RadarOutcome::tracks)
    }

    /// Result of each radar, with its folder; none after a dry run.
    pub fn radars(&self) -> &[RadarOutcome] {
        &self.of_radars
    }

    fn only_radar(&self) -> Option<&RadarOutcome> {
        match &self.of_radars[..] {
            [only] => Some(only),
            _ => None,
        }
    }

    /// Joint summary of the radars of a scene; `None` if it has one, or one was requested.
    pub fn radars_summary(&self) -> Option<&RadarsSummary> {
        self.of_all.as_ref()
    }
}

/// Runs a scene through the whole chain and writes artifacts, `summary.json`, `report.html` and pictures.
///
/// # Errors
/// A sentence that names file, place and rule if the scene, a model or the memory is refused; complete
/// results are kept.
pub fn run(settings: &Settings) -> Result<Outcome, Failure> {
    whole(settings).map_err(|failure| failure.about(&settings.scene.file))
}

fn whole(settings: &Settings) -> Result<Outcome, Failure> {
    let cache = Cache::of_run(settings.cache.as_ref())?;
    let model = loading::model(settings.classifier.as_deref())?;
    let runs = runs(settings)?;
    // Folders given by the user are checked before anything is written into them; those by scene names when
    // the scenes are read.
    let said = runs.iter().filter_map(|run| run.out.as_deref()).chain(settings.out.as_deref());
    apart(cache.as_ref(), said)?;
    // All scenes are planned before the first is computed, so that an error of the last radar is reported at
    // once.
    let planned_scene =
        if settings.explain || settings.dry_run { planning::explained_scene } else { planning::scene };
    let load = |run: &Run| planned_scene(&run.scene, cache.as_ref(), settings.memory);
    let planned: Vec<PlannedScene> = runs.iter().map(load).collect::<Result<_, _>>()?;
    let outs: Vec<PathBuf> = runs.iter().zip(&planned).map(|(run, planned)| run.out_of(planned)).collect();
    let is_of_all = settings.scene.radar.is_none() && runs.iter().all(|run| run.scene.radar.is_some());
    let above = outs.first().filter(|_| is_of_all).map(|out| several_radars::above(out));
    apart(cache.as_ref(), outs.iter().map(PathBuf::as_path).chain(above))?;
    let _writing = (!settings.dry_run).then(|| begin(&planned, &outs, above)).transpose()?;
    let shipped = model.as_ref().filter(|_| settings.classifier.is_none());
    remarks_of_all(&runs, &planned, shipped).into_iter().for_each(progress::note);
    let mut in_common = above.map(|out| EarlierResults::in_common(out, common_frames(&planned)));
    let (mut of_radars, mut expected) = (vec![], vec![]);
    let work = (runs.len() > 1).then(|| Work::begin("radars"));
    for (number, ((run, planned), out)) in runs.iter().zip(&planned).zip(&outs).enumerate() {
        if let Some(work) = &work {
            work.at(number, runs.len());
            (settings.tell)(&format!("radar {}", run.scene.radar.as_deref().unwrap_or_default()));
        }
        let forget =
            |_: &Failure| above.iter().for_each(|out| EarlierResults::in_common(out, 1).forget_if_none());
        let folder = Folder { out, in_common: &mut in_common };
        match one_radar(settings, planned, cache.as_ref(), model.as_ref(), folder).inspect_err(forget)? {
            RadarResult::Ran(outcome) => of_radars.push(*outcome),
            RadarResult::Expected(total) => expected.push(total),
        }
    }
    if let Some(total) = expected.into_iter().reduce(ExpectedTotal::and).filter(|_| runs.len() > 1) {
        (settings.tell)("all radars");
        (settings.tell)(&total.line());
    }
    if let ([alone], Some(id)) = (&of_radars[..], &settings.scene.radar) {
        several_radars::remark_earlier(&alone.out, id);
    }
    let conclude = || several_radars::conclude(&of_radars, &settings.origin, settings.tell);
    let of_all = (is_of_all && !of_radars.is_empty()).then(conclude).transpose()?;
    Ok(Outcome { of_radars, of_all })
}

/// Notes about the scenes of all radars, each said once; those of the shipped model where it answers.
fn remarks_of_all(runs: &[Run], planned: &[PlannedScene], shipped: Option<&LoadedModel>) -> Vec<String> {
    let mut all: Vec<String> = vec![];
    for (run, planned) in runs.iter().zip(planned) {
        let header = &planned.loaded.header;
        let untrained = shipped.and_then(|_| remarks::untrained_radar::remark(header));
        for remark in remarks_of(&run.scene, header).into_iter().chain(untrained) {
            if !all.contains(&remark) {
                all.push(remark);
            }
        }
    }
    all
}

/// Notes about the meshes and materials of a scene.
fn remarks_of(source: &SceneSource, header: &SceneHeader) -> Vec<String> {
    let map = scene::material_map(&source.file, source.radar.as_deref());
    let unknown = map.map(|map| remarks::without_entry(header.meshes.iter(), &map)).unwrap_or_default();
    remarks::of_scene(header).into_iter().chain(unknown).collect()
}

/// Refuses a cache that is one of these folders or one of their folders of pictures.
fn apart<'a>(cache: Option<&Cache>, outs: impl Iterator<Item = &'a Path>) -> Result<(), Failure> {
    let Some(cache) = cache else { return Ok(()) };
    let folders: Vec<PathBuf> = outs.flat_map(|out| [out.to_owned(), out.join("pictures")]).collect();
    cache.apart_from(folders.iter().map(PathBuf::as_path))
}

/// Begins to write into the folder of each radar and into the common one above, if there is one, and claims
/// all of their files: results that cannot be written are reported before the first frame is computed.
fn begin(
    planned: &[PlannedScene],
    outs: &[PathBuf],
    above: Option<&Path>,
) -> Result<Vec<FolderLock>, Failure> {
    let folders = outs.iter().map(PathBuf::as_path).chain(above);
    let writing = folders.map(FolderLock::acquire).collect::<Result<Vec<_>, _>>()?;
    let of_radar = |(planned, out): (&PlannedScene, &PathBuf)| {
        let told = ["summary.json", "report.html"].map(|name| out.join(name));
        products::places(&planned.loaded.header, out).into_iter().chain(told)
    };
    let frames = common_frames(planned);
    let in_common = above.into_iter().flat_map(|out| several_radars::places(out, frames as usize));
    let places: Vec<PathBuf> = planned.iter().zip(outs).flat_map(of_radar).chain(in_common).collect();
    files::claim(&places)?;
    let in_common = above.map(|out| EarlierResults::in_common(out, frames));
    let of_radar =
        |(planned, out): (&PlannedScene, &PathBuf)| EarlierResults::of_radar(&planned.loaded.header, out);
    planned.iter().zip(outs).map(of_radar).try_for_each(|results| results.refuse_foreign())?;
    in_common.iter().try_for_each(EarlierResults::refuse_foreign)?;
    Ok(writing)
}

/// Most frames that all radars have in common.
fn common_frames(planned: &[PlannedScene]) -> u32 {
    planned.iter().map(|planned| planned.loaded.header.frames).min().unwrap_or(0)
}

/// Run of the scene with one radar, with its folder.
struct Run {
    scene: SceneSource,
    /// Folder of the results; `None`: named after the scene.
    out: Option<PathBuf>,
}

impl Run {
    /// Folder of the results.
    fn out_of(&self, planned: &PlannedScene) -> PathBuf {
        let of_name = || PathBuf::from("out").join(&planned.loaded.header.name);
        self.out.clone().unwrap_or_else(of_name)
    }
}

/// Runs to make: one or, if the scene has several radars and none was selected, one for each.
fn runs(settings: &Settings) -> Result<Vec<Run>, Failure> {
    let radars = match settings.scene.radar {
        Some(_) => vec![],
        None => scene::radars(&settings.scene.file).map_err(loading::scene_failure)?,
    };
    if radars.is_empty() {
        return Ok(vec![Run { scene: settings.scene.clone(), out: settings.out.clone() }]);
    }
    several_radars::check_names(&settings.scene.file, &radars)?;
    let run = |id: String| {
        let out = settings.out.as_ref().map(|out| out.join(&id));
        Run { scene: SceneSource { radar: Some(id), ..settings.scene.clone() }, out }
    };
    Ok(radars.into_iter().map(run).collect())
}

/// Folder of a radar's results, with what its first new result makes outdated.
struct Folder<'a> {
    out: &'a Path,
    /// Earlier results of all radars, until one of them has a new one.
    in_common: &'a mut Option<EarlierResults>,
}

/// Result of one radar.
enum RadarResult {
    /// A finished run.
    Ran(Box<RadarOutcome>),
    /// Expected cost of its frames, for a dry run.
    Expected(ExpectedTotal),
}

/// Runs the scene with one radar, or estimates the cost.
fn one_radar(
    settings: &Settings,
    planned: &PlannedScene,
    cache: Option<&Cache>,
    model: Option<&LoadedModel>,
    folder: Folder<'_>,
) -> Result<RadarResult, Failure> {
    let (loaded, out) = (&planned.loaded, folder.out);
    let chain = Chain::of(&loaded.header, cache, model, settings.memory);
    let plans = chain.plans();
    if let Some(plan) = planned.plan.as_ref().filter(|_| settings.explain || settings.dry_run) {
        let machine_speed = expectation::machine_speed::of_this_machine(cache)?;
        plan.lines(machine_speed).iter().for_each(|line| (settings.tell)(line));
    }
    if settings.explain {
        let verdict = if loaded.cached { "cached" } else { "runs: a file it reads is new or changed" };
        (settings.tell)(&format!("{}: {verdict}", Stage::Scene.name()));
        plans.iter().flat_map(FramePlan::explained).for_each(|line| (settings.tell)(&line));
    }
    if settings.dry_run {
        let total = ExpectedTotal::of(&Expectation::of(&chain, cache, &plans)?, plans.len());
        expectation::lines(&plans).iter().chain([&total.line()]).for_each(|line| (settings.tell)(line));
        return Ok(RadarResult::Expected(total));
    }
    let (start, begin) = (Instant::now(), processor_time::of_process());
    let forget = |_: &Failure| EarlierResults::of_radar(&loaded.header, out).forget_if_none();
    let (computed, figures) = compute(&chain, planned, &plans, settings, folder).inspect_err(forget)?;
    let processor = processor_time::of_process().zip(begin).map(|(end, begin)| end - begin);
    let timings = RunTimings { seconds: start.elapsed().as_secs_f64(), processor };
    if let Some(cache) = cache {
        cache.trim();
    }
    let summary = conclude(planned, computed, timings, &figures, settings, out)?;
    Ok(RadarResult::Ran(Box::new(RadarOutcome {
        summary,
        frames: figures.radar_frames,
        out: out.to_owned(),
    })))
}

/// Duration of all frames, to the end of the last picture.
struct RunTimings {
    /// Wall-clock time of all frames, s.
    seconds: f64,
    /// Processor time of all threads, s; `None` where the system does not report it.
    processor: Option<f64>,
}

/// Part of `summary.json` that is computed frame by frame.
struct Computed {
    frames: Vec<FrameSummary>,
    metrics: Metrics,
}

/// Computes a few frames at a time, so that memory does not grow with their number; frames are tracked and
/// written in order while later ones are computed.
fn compute(
    chain: &Chain,
    planned: &PlannedScene,
    plans: &[FramePlan],
    settings: &Settings,
    Folder { out, in_common }: Folder<'_>,
) -> Result<(Computed, Figures), Failure> {
    let mut products = Products::create(chain, out, &planned.loaded.files)?;
    let mut tracking = Tracking::of(chain)?;
    let (mut frames, mut cycle) = (Vec::new(), Vec::new());
    let mut own = Some(EarlierResults::of_radar(chain.header, out));
    let frame_of = |plan: &FramePlan| {
        progress::note(format!("frame {} of {}", plan.index + 1, plans.len()));
        chain.frame(plan)
    };
    let write = |frame: FrameProducts| {
        cycle.push(with_scene(frame, &planned.loaded));
        if cycle.len() < chain.header.radar.schedule.sub_frames() as usize {
            return Ok(());
        }
        resolved(chain, std::mem::take(&mut cycle))?.into_iter().try_for_each(|frame| {
            let truth = frame_truth(chain, &frame)?;
            let (tracks, told_of_tracks) = tracking.step(&frame, &truth)?;
            let (plan, told) = (planned.plan.as_ref(), (&frame.result, &truth));
            frames.push(FrameSummary::of_planned(&frame.view, plan, told, told_of_tracks));
            progress::during("artifacts and pictures", || {
                let mut outdated = in_common.take().into_iter().chain(own.take());
                outdated.try_for_each(|results| results.remove_outdated())?;
                products.write(chain, frame, &truth, &tracks)
            })
        })
    };
    let stages = [FrameStage::Scattering, FrameStage::Echo, FrameStage::Detection];
    each_frame(chain, (plans, &stages), &settings.cancellation, frame_of, write)?;
    Ok((Computed { frames, metrics: tracking.metrics() }, products.finish()?))
}

/// Adds the scene's loading time, and whether it was cached, to the first frame.
fn with_scene(mut frame: FrameProducts, loaded: &LoadedScene) -> FrameProducts {
    let is_first = frame.result.scene.index == 0;
    frame.result.seconds.insert(0, (Stage::Scene, if is_first { loaded.seconds } else { 0.0 }));
    if loaded.cached {
        frame.result.cached.insert(0, Stage::Scene);
    }
    frame
}

fn conclude(
    planned: &PlannedScene,
    computed: Computed,
    timings: RunTimings,
    figures: &Figures,
    settings: &Settings,
    out: &Path,
) -> Result<Summary, Failure> {
    let _under_way = Work::begin("summary and report");
    let summary = Summary {
        frames_seconds: timings.seconds,
        frames_processor_seconds: timings.processor,
        plan: planned.plan.clone(),
        ..Summary::of(&planned.loaded.header, computed.frames, computed.metrics)
    };
    files::write_file(&out.join("summary.json"), summary.json()?.as_bytes())?;
    report::write(&summary, figures, &settings.origin, out)?;
    EarlierResults::of_radar(&planned.loaded.header, out).are_whole()?;
    let frames = planned.loaded.header.frames;
    leftovers::remark(out, &figures.artifacts, |_, number| number < frames);
    console_lines::lines(&summary).iter().for_each(|line| (settings.tell)(line));
    (settings.tell)(&format!("report: {}", out.join("report.html").display()));
    Ok(summary)
}
