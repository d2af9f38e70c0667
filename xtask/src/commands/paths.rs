//! `paths`: the scattering paths of each frame of a scene.

use super::load::{self, provenance};
use crate::chain::{Chain, Scattering};
use crate::cli::PathsArguments;
use crate::failure::Failure;
use crate::progress::Work;
use crate::stages::Stage;
use crate::verdict::{self, Verdict};
use artifact::Writer;
use artifact::paths::Paths;
use artifact::settings::EchoMode;

pub(crate) fn run(arguments: &PathsArguments) -> Result<(), Failure> {
    let mut loaded = load::scene(&arguments.scene, None)?;
    loaded.header.fidelity.echo = EchoMode::Paths; // that is what was asked for
    let chain = Chain::of(&loaded.header, None, None);
    let from = provenance(Stage::BartRcs, &loaded.header, loaded.files.clone());
    let mut writer = Writer::<Paths>::create(&arguments.out, &from, &chain.paths_header())?;
    let work = Work::begin("frames");
    let mut told = vec![];
    for index in 0..loaded.header.frames {
        work.at(index as usize, loaded.header.frames as usize);
        let scene = scene::snapshot(&loaded.header, index);
        let scattering = chain.scattering(&chain.plan(index), &scene)?.value;
        if let Scattering::Paths(frame) = chain.counted_through(scattering) {
            writer.write(&frame)?;
            told.push((index, Verdict::of_paths(loaded.header.fidelity.accuracy, &frame.error, Some(&frame))));
        }
    }
    drop(work);
    writer.finish()?;
    verdict::tell(&told);
    Ok(())
}
