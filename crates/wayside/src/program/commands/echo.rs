//! `echo`: radar cubes of a scene, from its own paths or from given ones.

use crate::program::cli::EchoArguments;
use crate::program::terminal;
use crate::stepwise::paths_of_scene;
use artifact::cube::{Cube, CubeFrame};
use artifact::paths::{Paths, PathsFrame};
use artifact::scene::SceneFrame;
use artifact::settings::EchoMode;
use artifact::{Reader, Writer};
use pipeline::chain::frame_result::Scattering;
use pipeline::chain::frames::each_frame;
use pipeline::chain::link::Chain;
use pipeline::chain::loading::{self, LoadedScene, provenance};
use pipeline::chain::plan::FramePlan;
use pipeline::chain::stages::Stage;
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::progress::{self, FrameStage};
use pipeline::outcome::verdict::{self, Verdict};
use pipeline::planning::{self, PlannedScene};
use scene::PhysicsKeys;
use std::path::Path;

pub(crate) fn run(arguments: &EchoArguments, memory: Allowance) -> Result<(), Failure> {
    let PlannedScene { mut loaded, plan, said, .. } =
        planning::scene(&arguments.scene.source(), None, memory)?;
    if arguments.paths.is_some() {
        loaded.header.fidelity.echo = EchoMode::Paths;
    }
    let chain = Chain::of(&loaded.header, None, None, memory);
    let mut traced = loading::file_states(arguments.paths.as_slice())?;
    let of_paths = traced.iter().map(|file| file.named().clone());
    let files = loaded.files.iter().cloned().chain(of_paths).collect();
    let from = provenance(Stage::FmcwEcho, &loaded.header, files);
    let mut writer = Writer::<Cube>::create(&arguments.out, &from, chain.cube_header())?;
    let told = match &arguments.paths {
        Some(file) => from_paths(&chain, (&loaded, &said), file, &mut writer)?,
        None => from_scene(&chain, &mut writer)?,
    };
    loading::check_unchanged(&mut traced)?;
    writer.finish()?;
    let with_plan = |(frame, verdict): (u32, Verdict)| (frame, verdict.with_plan(plan.as_ref()));
    let told: Verdicts = told.into_iter().map(with_plan).collect();
    verdict::of_frames(&told).into_iter().for_each(terminal::line);
    Ok(())
}

/// Verdicts on the accuracy of the frames, each with its frame's number.
type Verdicts = Vec<(u32, Verdict)>;

fn from_scene(chain: &Chain, writer: &mut Writer<Cube>) -> Result<Verdicts, Failure> {
    let mut told = vec![];
    let echo = |plan: &FramePlan| {
        let scattering = chain.scattering(plan)?;
        Echo::of(chain, &scene::snapshot(chain.header, plan.index), &scattering)
    };
    let write = |echo: Echo| {
        told.push((echo.cube.index, echo.verdict));
        Ok(writer.write(&echo.cube)?)
    };
    let stages = [FrameStage::Scattering, FrameStage::Echo];
    each_frame(chain, (&chain.plans(), &stages), &Cancellation::default(), echo, write)?;
    Ok(told)
}

/// Echo of a frame; its error is added to that of the scattering.
struct Echo {
    cube: CubeFrame,
    verdict: Verdict,
}

impl Echo {
    fn of(chain: &Chain, scene: &SceneFrame, scattering: &Scattering) -> Result<Self, Failure> {
        let cube = chain.synthesize(scene, scattering)?;
        let (error, model_error) = scattering.error();
        let error = error.merged(cube.error);
        let verdict = Verdict::of_paths(&chain.header.fidelity, &error, scattering.paths());
        Ok(Self { cube, verdict: verdict.with_model_error(&model_error) })
    }
}

fn from_paths(
    chain: &Chain,
    (loaded, said): (&LoadedScene, &PhysicsKeys),
    file: &Path,
    writer: &mut Writer<Cube>,
) -> Result<Verdicts, Failure> {
    let reader = Reader::<Paths>::open(file)?;
    let from = &reader.preamble().provenance;
    let checked = paths_of_scene::check_header(chain, (&loaded.files, said), reader.header(), from);
    checked.map_err(|failure| failure.about(file))?;
    let mut told = vec![];
    for frame in progress::frames(reader) {
        let frame: PathsFrame = frame?;
        let scene = paths_of_scene::check_frame(&loaded.header, &frame);
        let (index, scene) = (frame.index, scene.map_err(|failure| failure.about(file))?);
        let echo = Echo::of(chain, &scene, &Scattering::Paths(frame))?;
        writer.write(&echo.cube)?;
        told.push((index, echo.verdict));
    }
    Ok(told)
}
