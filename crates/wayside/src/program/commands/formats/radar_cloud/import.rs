//! Clouds of other radars as points: a file, or a folder of files, a frame each in the order of their names.

use crate::chain::keys::cube_header;
use crate::chain::loading::{self, provenance};
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use crate::host::progress::Work;
use crate::program::commands::formats::levelled_axes::LevelledAxes;
use crate::program::commands::formats::radar_cloud::{Detection, LIMIT_BYTES, pcd, velodyne};
use artifact::points::{Height, Point, Points, PointsFrame, PointsHeader};
use artifact::scene::SceneHeader;
use artifact::{Writer, bounded};
use std::path::{Path, PathBuf};

/// Writes clouds as the points that the scene's radar has, with the objects that they form.
///
/// # Errors
/// A file that is no such cloud, or none at all.
pub(crate) fn points(
    asked: &Path,
    scene_file: &Path,
    scene: &SceneHeader,
    out: &Path,
) -> Result<(), Failure> {
    let files = frames_of(asked, &["bin", "pcd"])?;
    let inputs = loading::hashed(&[files.as_slice(), &[scene_file.to_owned()]].concat())?;
    let cube = cube_header(scene);
    let axes = LevelledAxes::of(&scene.radar);
    let header = PointsHeader { cube: Some(cube.clone()), ..PointsHeader::default() };
    let mut writer = Writer::<Points>::create(out, &provenance(Stage::Dsp, scene, inputs), &header)?;
    let under_way = Work::begin("frames");
    for (index, file) in (0..).zip(&files) {
        under_way.at(index as usize, files.len());
        let (seen, height) = read(file)?;
        let mut points: Vec<Point> = seen.iter().map(|seen| seen.point(&cube, &axes, height)).collect();
        let objects = dsp::objects_of_points(&cube, &mut points);
        writer.write(&PointsFrame { index, time_s: scene.frame_time_s(index), points, objects })?;
    }
    Ok(writer.finish()?)
}

/// Detections of a file, and what their height stands on: radars of `.pcd` tell none.
fn read(file: &Path) -> Result<(Vec<Detection>, Height), Failure> {
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let (found, height) = match ending(file) {
        Some("pcd") => (pcd::of_bytes(&bytes), Height::Assumed),
        _ => (velodyne::of_bytes(&bytes), Height::Measured),
    };
    let found = found.map_err(|why| Failure::Refused(format!("{}: {why}", file.display())))?;
    Ok((found, height))
}

/// The files of a folder that have one of these endings, all the same one, in the order of their names; a
/// plain file stands for itself.
pub(crate) fn frames_of(asked: &Path, endings: &[&str]) -> Result<Vec<PathBuf>, Failure> {
    if !asked.is_dir() {
        return Ok(vec![asked.to_owned()]);
    }
    let entries = std::fs::read_dir(asked).map_err(|e| Failure::system(asked, "be listed", e))?;
    let mut files = vec![];
    for entry in entries {
        let file = entry.map_err(|e| Failure::system(asked, "be listed", e))?.path();
        if ending(&file).is_some_and(|ending| endings.contains(&ending)) {
            files.push(file);
        }
    }
    files.sort();
    let refused = |rule: String| Err(Failure::Refused(format!("{}: {rule}", asked.display())));
    match files.split_first() {
        None => refused(format!("no file in it ends in .{}", endings.join(" or ."))),
        Some((first, rest)) if rest.iter().any(|file| ending(file) != ending(first)) => {
            refused(format!("its files do not all end alike, in .{}", endings.join(" or .")))
        }
        Some(_) => Ok(files),
    }
}

/// Ending of a file's name.
pub(crate) fn ending(file: &Path) -> Option<&str> {
    file.extension().and_then(|ending| ending.to_str())
}
