//! Reads a scene file and the meshes that it names; every broken rule is reported, not only the first.

use crate::document::changes::{self, Change};
use crate::document::diagnostics::Diagnostics;
use crate::document::errors::SceneErrors;
use crate::document::keys::fidelity::{FIDELITY, MODEL};
use crate::document::keys::radar::RADAR;
use crate::document::keys::scene::{SCENE, SEED};
use crate::document::section::Section;
use crate::document::text::{read_text as text_of, without_position};
use crate::materials::{read_road, read_scene_materials};
use crate::models::library::Models;
use crate::models::options::{MeshLoading, ReadOptions};
use crate::radar::radars::{self, read_name};
use crate::radar::read_radar::{read_frames, read_radar};
use crate::settings::{
    check_with_road, read_dsp, read_fidelity, read_intersection, read_noise, read_own_road,
};
use crate::targets::target::read_targets;
use crate::traffic::read_traffic;
use artifact::material::MaterialMap;
use artifact::scene::SceneHeader;
use artifact::settings::Lanes;
use std::path::{Path, PathBuf};

/// Reads the scene in `path` with the meshes of its targets: each in body axes, the centre of its bounding
/// box on the ground at the origin; a model named twice is read once.
///
/// # Errors
/// Every broken rule of the file and of the models it names, with line and column; `is_system` distinguishes
/// a missing or unreadable file from a refused one.
pub fn read(path: &Path, options: &ReadOptions) -> Result<SceneHeader, SceneErrors> {
    read_changed(path, &[], options)
}

/// Reads a text as the scene in `path`, before it is written.
///
/// # Errors
/// Those of [`read`], with the lines of the text.
pub fn read_text(path: &Path, text: &str, options: &ReadOptions) -> Result<SceneHeader, SceneErrors> {
    of_text((path, text), &[], options).map(|(header, _)| header)
}

/// Reads the scene in `path` with some of its values changed; line and column of an error are those of the
/// value that a change replaces, or of its table; a table omitted in the file has none.
///
/// # Errors
/// Those of [`read`]; a change that has no place in the file.
pub fn read_changed(
    path: &Path,
    changes: &[Change],
    options: &ReadOptions,
) -> Result<SceneHeader, SceneErrors> {
    read_with_models(path, changes, options).map(|(header, _)| header)
}

/// The files that [`read`] opens, the scene first: all that a result depends on beside the program and its
/// options.
///
/// # Errors
/// Those of [`read`]. Meshes are opened only if there is another fault already, so that all faults are
/// reported here too.
pub fn inputs(path: &Path, options: &ReadOptions) -> Result<Vec<PathBuf>, SceneErrors> {
    inputs_of_changed(path, &[], options)
}

/// The files that [`read_changed`] opens, like [`inputs`] for [`read`].
///
/// # Errors
/// Those of [`read_changed`].
pub fn inputs_of_changed(
    path: &Path,
    changes: &[Change],
    options: &ReadOptions,
) -> Result<Vec<PathBuf>, SceneErrors> {
    let names_only = ReadOptions { meshes: MeshLoading::NamesOnly, ..options.clone() };
    let files = read_with_models(path, changes, &names_only)
        .map(|(_, models)| std::iter::once(path.to_owned()).chain(models.files()).collect::<Vec<_>>());
    match files {
        Ok(files) if files.iter().all(|file| file.is_file()) => Ok(files),
        incomplete => match options.meshes {
            MeshLoading::Whole => read_changed(path, changes, options).and(incomplete),
            MeshLoading::NamesOnly => incomplete,
        },
    }
}

/// Reads the materials of a scene by name, without opening its models.
///
/// # Errors
/// Those of [`read`].
pub fn material_map(path: &Path, radar: Option<&str>) -> Result<MaterialMap, SceneErrors> {
    read_without_models(path, &[], radar).map(|(_, models)| models.materials().clone())
}

/// The files that [`read_changed`] opens without models, the scene first: patterns, calibrations, materials
/// and networks of recordings.
///
/// # Errors
/// Those of [`read_changed`].
pub fn inputs_without_models(
    path: &Path,
    changes: &[Change],
    radar: Option<&str>,
) -> Result<Vec<PathBuf>, SceneErrors> {
    let (_, models) = read_without_models(path, changes, radar)?;
    Ok(std::iter::once(path.to_owned()).chain(models.other_inputs().cloned()).collect())
}

fn read_without_models(
    path: &Path,
    changes: &[Change],
    radar: Option<&str>,
) -> Result<(SceneHeader, Models), SceneErrors> {
    let options =
        ReadOptions { model: None, radar: radar.map(str::to_owned), meshes: MeshLoading::NamesOnly };
    read_with_models(path, changes, &options)
}

fn read_with_models(
    path: &Path,
    changes: &[Change],
    options: &ReadOptions,
) -> Result<(SceneHeader, Models), SceneErrors> {
    let text = text_of(path).map_err(|rule| without_position(path, rule))?;
    of_text((path, &text), changes, options)
}

fn of_text(
    (path, text): (&Path, &str),
    changes: &[Change],
    options: &ReadOptions,
) -> Result<(SceneHeader, Models), SceneErrors> {
    let diagnostics = Diagnostics::new(path, text);
    let mut document = diagnostics.document();
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut models = Models::new(folder, options);
    let asked = options.radar.as_deref();
    changes::apply(&mut document, changes, &diagnostics);
    let document = radars::select_radar(&document, asked);
    let root = Section::root(&document, &SCENE, &diagnostics);
    let name = read_name(&root, asked);
    let header = SceneHeader { name, ..read_header(&root, &mut models) };
    drop(root);
    diagnostics.into_errors().map(|()| (header, models))
}

fn read_header(root: &Section<'_>, models: &mut Models) -> SceneHeader {
    let radar_section = root.section(&RADAR);
    let radar = read_radar(&radar_section, models);
    let (frames, frame_interval_s) = read_frames(root, &radar);
    let (intersection, road_lanes) = read_intersection(root, &radar);
    // Opened once, because opening notes its unknown keys.
    let fidelity_section = root.section(&FIDELITY);
    let materials = read_scene_materials(root, &fidelity_section, &radar, models);
    models.set_materials(&materials, radar.waveform.centre_frequency_hz());
    let fidelity = read_fidelity(&fidelity_section, &root.section(&MODEL));
    let targets = read_targets(root, &radar, (&road_lanes.lanes, fidelity.echo), models);
    let recording = read_traffic(root, &radar, frame_interval_s, models);
    let courses = recording
        .as_ref()
        .map(|recording| recording.lanes([root, &radar_section], models))
        .unwrap_or_default();
    let own_road = Lanes { courses, ..read_own_road(&radar_section, &radar, &road_lanes) };
    let recording = recording.filter(|_| models.are_opened());
    let traffic = recording.map(|recording| recording.frames(models, &targets));
    let sub_frames = radar.schedule.sub_frames();
    let frames = traffic.as_ref().map_or(frames, |traffic| (traffic.frames.len() as u32).max(1) * sub_frames);
    let (road, backscatter) = read_road(root, &radar, fidelity.echo, models);
    if road.is_some() {
        check_with_road(&fidelity_section, &fidelity);
    }
    SceneHeader {
        name: String::new(),
        seed: root.or_default(&SEED),
        frames,
        frame_interval_s,
        noise: read_noise(root),
        dsp: read_dsp(root, &radar, own_road, models),
        fidelity,
        radar,
        intersection,
        meshes: models.take_meshes().into(),
        materials,
        road,
        backscatter,
        targets,
        traffic,
    }
}
