//! `echo`: radar cubes of a scene, from its own paths or from paths that are given.

use super::load::{self, LoadedScene, provenance};
use crate::chain::{Chain, Scattering};
use crate::cli::EchoArguments;
use crate::failure::Failure;
use crate::progress::Work;
use crate::stages::Stage;
use artifact::cube::Cube;
use artifact::paths::{Paths, PathsFrame};
use artifact::settings::EchoMode;
use artifact::{Reader, Writer};
use std::path::Path;

pub(crate) fn run(arguments: &EchoArguments) -> Result<(), Failure> {
    let mut loaded = load::scene(&arguments.scene, None)?;
    if arguments.paths.is_some() {
        loaded.header.fidelity.echo = EchoMode::Paths;
    }
    let chain = Chain::of(&loaded.header, None, None);
    let from = provenance(Stage::FmcwEcho, &loaded.header, loaded.files.clone());
    let mut writer = Writer::<Cube>::create(&arguments.out, &from, &chain.cube_header)?;
    match &arguments.paths {
        Some(file) => from_paths(&chain, &loaded, file, &mut writer)?,
        None => from_scene(&chain, &mut writer)?,
    }
    Ok(writer.finish()?)
}

fn from_scene(chain: &Chain, writer: &mut Writer<Cube>) -> Result<(), Failure> {
    let work = Work::begin("frames");
    for index in 0..chain.header.frames {
        work.at(index as usize, chain.header.frames as usize);
        let scene = scene::snapshot(chain.header, index);
        let scattering = chain.scattering(&chain.plan(index), &scene)?.value;
        writer.write(&chain.synthesize(&scene, &scattering)?)?;
    }
    Ok(())
}

fn from_paths(chain: &Chain, loaded: &LoadedScene, file: &Path, writer: &mut Writer<Cube>) -> Result<(), Failure> {
    let reader = Reader::<Paths>::open(file)?;
    let centre_hz = loaded.header.radar.waveform.centre_frequency_hz();
    let told_hz = reader.header().centre_frequency_hz;
    if (told_hz - centre_hz).abs() > 1e-9 * centre_hz {
        let rule = "amplitudes hold for the sweep they were traced for";
        let text = format!("{}: f_c is {told_hz} Hz, the scene's is {centre_hz} Hz: {rule}", file.display());
        return Err(Failure::Refused(text));
    }
    for frame in reader {
        let frame: PathsFrame = frame?;
        let scene = scene::snapshot(&loaded.header, frame.index);
        writer.write(&chain.synthesize(&scene, &Scattering::Paths(frame))?)?;
    }
    Ok(())
}
