//! `paths`: the scattering paths of each frame of a scene.

use crate::program::cli::PathsArguments;
use crate::program::terminal;
use artifact::Writer;
use artifact::paths::Paths;
use artifact::settings::EchoMode;
use pipeline::chain::frame_result::Scattering;
use pipeline::chain::frames::each_frame;
use pipeline::chain::link::{Chain, artifact_headers};
use pipeline::chain::loading::provenance;
use pipeline::chain::plan::FramePlan;
use pipeline::chain::stages::Stage;
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::progress::FrameStage;
use pipeline::outcome::verdict::{self, Verdict};
use pipeline::planning::{self, PlannedScene};

pub(crate) fn run(arguments: &PathsArguments, memory: Allowance) -> Result<(), Failure> {
    let PlannedScene { mut loaded, plan, .. } = planning::scene(&arguments.scene.source(), None, memory)?;
    loaded.header.fidelity.echo = EchoMode::Paths; // the command asks for paths
    let chain = Chain::of(&loaded.header, None, None, memory);
    let from = provenance(Stage::BartRcs, &loaded.header, loaded.files.clone());
    let mut writer =
        Writer::<Paths>::create(&arguments.out, &from, &artifact_headers::paths_header(chain.header))?;
    let mut told = vec![];
    let traced = |plan: &FramePlan| Ok((plan.index, chain.scattering(plan)?));
    let write = |(index, scattering): (u32, Scattering)| {
        if let Scattering::Paths(frame) = scattering.numbered_as_in(chain.header) {
            writer.write(&frame)?;
            let verdict = Verdict::of_paths(&loaded.header.fidelity, &frame.error, Some(&frame));
            told.push((index, verdict.with_model_error(&frame.model_error).with_plan(plan.as_ref())));
        }
        Ok(())
    };
    let stages = [FrameStage::Scattering];
    each_frame(&chain, (&chain.plans(), &stages), &Cancellation::default(), traced, write)?;
    writer.finish()?;
    verdict::of_frames(&told).into_iter().for_each(terminal::line);
    Ok(())
}
