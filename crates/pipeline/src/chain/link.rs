//! The stages linked: one frame from the scene snapshot to classes, each stage's frame taken from the cache
//! if present. A stage depends only on the contents of its input artifacts.

pub mod artifact_headers;
mod stage_sessions;
mod stage_step;

use crate::chain::cache::Cache;
use crate::chain::class_rule::ClassRule;
use crate::chain::expected_work::{FrameProbes, ScaledWork};
use crate::chain::frame_result::{FrameResult, Scattering};
use crate::chain::keys::{FrameKeys, SceneParts};
use crate::chain::link::stage_sessions::StageSessions;
use crate::chain::link::stage_step::{StageFrames, StageTimes, Step};
use crate::chain::loaded_model::LoadedModel;
use crate::chain::measured_frames::{self, MeasuredFrames};
use crate::chain::plan::FramePlan;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use crate::host::memory::Allowance;
use crate::host::ordered_jobs::ConcurrencyLimits;
use crate::host::progress::{self, FrameStage, Work};
use artifact::classes::{Classes, ClassesFrame};
use artifact::cube::{Cube, CubeFrame, CubeHeader};
use artifact::paths::{Paths, PathsFrame};
use artifact::points::{Points, PointsFrame};
use artifact::rcs::{Rcs, RcsFrame};
use artifact::rdm::{Rdm, RdmFrame};
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::settings::EchoMode;
use bart_rcs::FrameContext;
use fmcw_echo::EchoError;
use std::sync::{Arc, OnceLock};

/// All artifacts of one frame.
pub struct FrameProducts {
    /// The scene in this frame: vehicles in view are targets.
    pub view: SceneHeader,
    /// IF samples, √W.
    pub cube: CubeFrame,
    /// Range-Doppler maps with the detected cells.
    pub rdm: RdmFrame,
    /// Points, classes, errors and time.
    pub result: FrameResult,
}

/// A scene with everything its frames share.
pub struct Chain<'a> {
    /// The scene.
    pub header: &'a SceneHeader,
    sessions: StageSessions<'a>,
    frames: StageFrames<'a>,
    model: Option<&'a LoadedModel>,
    parts: SceneParts,
    measured: MeasuredFrames,
    probes: FrameProbes,
    memory: Allowance,
    /// Frames that share the memory for tracing; one without plans.
    at_once: OnceLock<ConcurrencyLimits>,
}

impl<'a> Chain<'a> {
    /// Makes the chain of a scene: frames are looked up in the cache and classified by the model, and tracing
    /// keeps to its memory limit.
    pub fn of(
        header: &'a SceneHeader,
        cache: Option<&'a Cache>,
        model: Option<&'a LoadedModel>,
        memory: Allowance,
    ) -> Self {
        Self {
            header,
            sessions: StageSessions::of(header),
            frames: StageFrames { cache, cached_to: Stage::Classifier, scene: &header.name },
            model,
            parts: SceneParts::of(header),
            measured: MeasuredFrames::default(),
            probes: FrameProbes::default(),
            memory,
            at_once: OnceLock::new(),
        }
    }

    /// The radar and its processing, as the detection stage takes them.
    pub fn cube_header(&self) -> &CubeHeader {
        &self.sessions.cube_header
    }

    /// Limits the cache to this stage and those before it: later ones are computed anew.
    pub fn caching_up_to(self, cached_to: Stage) -> Self {
        Self { frames: StageFrames { cached_to, ..self.frames }, ..self }
    }

    /// Uses an existing tracer of the same meshes.
    pub(crate) fn tracing_by(self, tracer: bart_rcs::Tracer) -> Self {
        Self { sessions: self.sessions.tracing_by(tracer), ..self }
    }

    /// Takes over the errors that were measured in another scene of its kind; `hash` covers their inputs.
    pub fn with_measured_errors(self, measured: measured_frames::FramesByIndex, hash: &str) -> Self {
        let parts = self.parts.measured_in(hash);
        Self { measured: MeasuredFrames::taking_over(measured), parts, ..self }
    }

    /// Frames whose errors were measured so far, for other scenes to take over.
    pub fn measured(&self) -> measured_frames::FramesByIndex {
        self.measured.all()
    }

    /// Plan of one frame: which stages run, and why.
    pub fn plan(&self, index: u32) -> FramePlan {
        let frame = scene::snapshot(self.header, index);
        let model = self.model.map(LoadedModel::hash);
        let keys = FrameKeys::of(self.header, &self.parts, &frame, model);
        FramePlan::of(self.frames.cache, self.header, index, keys)
    }

    /// Plans of all frames.
    pub fn plans(&self) -> Vec<FramePlan> {
        (0..self.header.frames).map(|index| self.plan(index)).collect()
    }

    /// Computes the parts of the plan that are missing.
    pub fn frame(&self, plan: &FramePlan) -> Result<FrameProducts, Failure> {
        let scene = scene::snapshot(self.header, plan.index);
        let mut times = StageTimes::default();
        let scattering = times.time(Stage::BartRcs, || self.scattering_step(plan, &scene))?;
        let cube = times.time(Stage::FmcwEcho, || self.cube(plan, &scene, &scattering))?;
        let (rdm, points) = times.time(Stage::Dsp, || self.maps(plan, &cube))?;
        let classes = times.time(Stage::Classifier, || self.classes(plan, &rdm, &points))?;
        let (error, model_error) = scattering.error();
        let error = error.merged(cube.error);
        let memory_estimate_mib = self.memory_estimate_mib(plan)?;
        let (StageTimes { seconds, cached }, rule) = (times, self.class_rule());
        let result = FrameResult {
            scene,
            scattering,
            points,
            classes,
            rule,
            error,
            model_error,
            seconds,
            cached,
            memory_estimate_mib,
        };
        Ok(FrameProducts { view: scene::frame_view(self.header, plan.index), cube, rdm, result })
    }

    /// Number of triangles of all bodies in view of a frame; a point counts as one.
    pub(crate) fn triangles(&self, index: u32) -> usize {
        let vehicles = scene::vehicles_in_view(self.header, index).into_iter().map(|vehicle| &vehicle.kind);
        let triangles = |kind| self.header.mesh_of(kind).map_or(1, |mesh| mesh.triangles.len());
        self.header.targets.iter().map(|target| &target.kind).chain(vehicles).map(triangles).sum()
    }

    /// Memory that tracing may take.
    pub(crate) fn memory(&self) -> Allowance {
        self.memory
    }

    /// A frame's expected work, scaled from a frame that was looked at.
    pub(crate) fn scaled_work(&self, index: u32) -> Result<ScaledWork, Failure> {
        self.probes.of(self.header, index, |at| self.expected_work(at), |at| self.triangles(at))
    }

    /// Expected work of a frame's tracing, from a sample of it.
    pub(crate) fn expected_work(&self, index: u32) -> Result<bart_rcs::ExpectedWork, Failure> {
        let (view, frame) = (scene::frame_view(self.header, index), scene::snapshot(self.header, index));
        let tracer = self.sessions.unlimited_tracer(self.memory)?;
        tracer.expected_work(&view, &frame).map_err(Failure::refused)
    }

    /// Paths or tables of one frame; a frame whose bodies have the poses and velocities of another finds that
    /// one's in the cache.
    pub fn scattering(&self, plan: &FramePlan) -> Result<Scattering, Failure> {
        Ok(self.scattering_step(plan, &scene::snapshot(self.header, plan.index))?.value)
    }

    fn scattering_step(&self, plan: &FramePlan, scene: &SceneFrame) -> Result<Step<Scattering>, Failure> {
        let (at, stage) = ((plan.index, &plan.keys.bart_rcs), Stage::BartRcs);
        match self.header.fidelity.echo {
            EchoMode::Paths => {
                let header = artifact_headers::paths_header(self.header);
                let step = self.frames.step::<Paths>(stage, at, &header, || self.paths(plan, scene))?;
                self.measured.record(self.header, scene.index, &step.value);
                let (index, time_s) = (scene.index, scene.time_s);
                Ok(step.map(|frame| Scattering::Paths(PathsFrame { index, time_s, ..frame })))
            }
            EchoMode::RcsTable => {
                let compute = || {
                    let (tracer, view) = (self.tracer(plan)?, scene::frame_view(self.header, scene.index));
                    let progress = &of_stage(scene.index, FrameStage::Scattering, "tables of bodies");
                    tracer.tables(&view, scene, progress).map_err(|error| refused_in(scene, &error))
                };
                let header = artifact_headers::rcs_header(self.header);
                let step = self.frames.step::<Rcs>(stage, at, &header, compute)?;
                let (index, time_s) = (scene.index, scene.time_s);
                Ok(step.map(|frame| Scattering::Tables(RcsFrame { index, time_s, ..frame })))
            }
        }
    }

    /// Paths with measured errors, or with errors taken over from the measured frame; the measured frame
    /// itself where nothing moved in between, as in the cache.
    fn paths(&self, plan: &FramePlan, scene: &SceneFrame) -> Result<PathsFrame, Failure> {
        let (view, tracer) = (scene::frame_view(self.header, scene.index), self.tracer(plan)?);
        let measured_in = self.header.measured_in(scene.index);
        let of_another_scene = self.measured.taken_over(measured_in);
        let in_this_scene = match &of_another_scene {
            None if measured_in != scene.index => Some(self.measured_frame(measured_in)?),
            _ => None,
        };
        let measured = of_another_scene.as_ref().or(in_this_scene.as_ref());
        let progress = &of_stage(scene.index, FrameStage::Scattering, "paths");
        let surroundings = FrameContext { like: measured.map(Arc::as_ref), progress };
        let frame = tracer.paths(&view, scene, &surroundings).map_err(|error| refused_in(scene, &error))?;
        let stands = |_: &&Arc<PathsFrame>| self.plan(measured_in).keys.bart_rcs == plan.keys.bart_rcs;
        Ok(match in_this_scene.as_ref().filter(stands) {
            Some(same) => PathsFrame { trace: same.trace.clone(), ..frame },
            None => frame,
        })
    }

    /// Measured frame, without its paths; computed unless an earlier frame of this run needed it.
    fn measured_frame(&self, index: u32) -> Result<Arc<PathsFrame>, Failure> {
        if let Some(known) = self.measured.get(index) {
            return Ok(known);
        }
        self.scattering(&self.plan(index))?;
        self.measured.get(index).ok_or_else(|| Failure::refused(format!("frame {index} has no paths")))
    }

    /// Sets how many frames are traced and held at a time; each has its share of the memory.
    pub fn share_memory(&self, at_once: ConcurrencyLimits) {
        let _ = self.at_once.set(at_once);
    }

    /// Tracer of the frames, limited to its share of the memory; refused where the frame cannot fit into the
    /// allowed memory.
    fn tracer(&self, plan: &FramePlan) -> Result<&bart_rcs::Tracer, Failure> {
        self.memory.check(self.least_memory_mib(plan)?)?;
        let at_once = || *self.at_once.get_or_init(|| ConcurrencyLimits { workers: 1, held: 1 });
        self.sessions.tracer(self.memory, || self.tracing_share(at_once()))
    }

    fn cube(
        &self,
        plan: &FramePlan,
        scene: &SceneFrame,
        scattering: &Scattering,
    ) -> Result<Step<CubeFrame>, Failure> {
        let compute = || self.synthesize(scene, scattering);
        self.frames.step::<Cube>(
            Stage::FmcwEcho,
            (plan.index, &plan.keys.fmcw_echo),
            self.cube_header(),
            compute,
        )
    }

    /// Synthesizes the echo of paths or tables.
    pub fn synthesize(&self, scene: &SceneFrame, scattering: &Scattering) -> Result<CubeFrame, Failure> {
        let work = of_stage(scene.index, FrameStage::Echo, "echo, percent");
        let progress = |share: f64| work.at((100.0 * share) as usize, 100);
        let synthesizer = self.synthesizer()?;
        match scattering {
            Scattering::Paths(frame) => {
                synthesizer.frame(frame, &progress).map_err(|error| self.of_echo(&error, frame))
            }
            Scattering::Tables(frame) => {
                synthesizer.frame_of_tables(&scene.poses, frame, &progress).map_err(Failure::refused)
            }
        }
    }

    /// Refusal that names the body whose path is at fault.
    fn of_echo(&self, error: &EchoError, frame: &PathsFrame) -> Failure {
        let path = error.path().and_then(|path| frame.paths.get(path));
        let targets = artifact_headers::body_ids(self.header);
        match path.and_then(|path| targets.get(path.target as usize)) {
            Some(id) => Failure::refused(format!("target `{id}`: {error}")),
            None => Failure::refused(error),
        }
    }

    /// Synthesizer that makes cubes of the scene's paths.
    pub fn synthesizer(&self) -> Result<&fmcw_echo::Synthesizer, Failure> {
        self.sessions.synthesizer()
    }

    /// Receiver that makes maps and points of the scene's cubes.
    pub fn receiver(&self) -> Result<&dsp::Receiver, Failure> {
        self.sessions.receiver()
    }

    fn maps(&self, plan: &FramePlan, cube: &CubeFrame) -> Result<Step<(RdmFrame, PointsFrame)>, Failure> {
        let (key, stage) = (&plan.keys.dsp, Stage::Dsp);
        let _under_way = of_stage(plan.index, FrameStage::Detection, "range-Doppler map and points");
        let compute = || self.receiver()?.range_doppler(cube).map_err(Failure::refused);
        let rdm = self.frames.step::<Rdm>(stage, (plan.index, key), self.cube_header(), compute)?;
        let detect = || self.receiver()?.detect_refined(&rdm.value, cube).map_err(Failure::refused);
        let points = self.frames.step::<Points>(
            stage,
            (plan.index, key),
            &artifact_headers::points_header(self.cube_header()),
            detect,
        )?;
        Ok(Step { cached: rdm.cached && points.cached, value: (rdm.value, points.value) })
    }

    /// Rule that decides for classes; without a model no probability is too small.
    pub(crate) fn class_rule(&self) -> ClassRule {
        self.model.map(LoadedModel::rule).unwrap_or_default()
    }

    fn classes(
        &self,
        plan: &FramePlan,
        rdm: &RdmFrame,
        points: &PointsFrame,
    ) -> Result<Step<Vec<[f32; 4]>>, Failure> {
        let stage = Stage::Classifier;
        let Some((model, key)) = self.model.zip(plan.keys.classifier.as_ref()) else {
            return Ok(Step { value: vec![], cached: false });
        };
        let name = format!("frame {}, classification", plan.index);
        let compute = || {
            let probabilities = progress::during(name, || model.classify(self.receiver()?, rdm, points))?;
            Ok(ClassesFrame { probabilities })
        };
        let step = self.frames.step::<Classes>(stage, (plan.index, key), &model.classes_header(), compute)?;
        Ok(step.map(|frame| frame.probabilities))
    }
}

/// Progress of one stage of a frame.
fn of_stage(frame: u32, stage: FrameStage, name: &str) -> Work {
    Work::in_stages(format!("frame {frame}, {name}"), &[stage])
}

/// Refusal of a frame that cannot be traced, with its time: traffic has other poses in other frames.
fn refused_in(scene: &SceneFrame, error: &bart_rcs::BartError) -> Failure {
    Failure::refused(format!("frame {}, {:.3} s: {error}", scene.index, scene.time_s))
}
