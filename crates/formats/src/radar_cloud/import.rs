//! Clouds of other radars as points: a file, or a folder of files, each a frame in the order of their numbers
//! or names.

use crate::height_source::HeightSource;
use crate::levelled_axes::LevelledAxes;
use crate::radar_cloud::summits::summits;
use crate::radar_cloud::{Detection, LIMIT_BYTES, pcd, velodyne};
use artifact::cube::CubeHeader;
use artifact::points::{Height, Point, Points, PointsFrame, PointsHeader};
use artifact::scene::SceneHeader;
use artifact::settings::StaticEchoes;
use artifact::units::power_from_db;
use artifact::{Writer, bounded};
use dsp::FoldCertainty;
use pipeline::chain::keys::cube_header;
use pipeline::chain::loading::{self, provenance};
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Writes clouds as points of the scene's radar, with the objects that they form; `scene_files` are the files
/// of the scene and its radar, which `scene` reads.
///
/// # Errors
/// A file that is not such a cloud, or none at all; those of `scene`; a file that changed meanwhile.
pub fn points(
    asked: &Path,
    scene_files: &[PathBuf],
    scene: impl FnOnce() -> Result<SceneHeader, Failure>,
    out: &Path,
) -> Result<(), Failure> {
    let (scene, of_scene) = loading::read_hashed(scene_files, scene)?;
    let files = frames_of(asked, &["bin", "pcd"])?;
    let description: Option<PathBuf> = files.first().and_then(|file| description_of(file));
    let mut inputs = loading::file_states(&[files.as_slice(), description.as_slice()].concat())?;
    let mut named: Vec<_> = inputs.iter().map(|file| file.named().clone()).collect();
    named.splice(files.len()..files.len(), of_scene);
    let told = description.as_deref().map(described_height).transpose()?.flatten();
    let cube = cube_header(&scene);
    let axes = LevelledAxes::of(&scene.radar);
    let header = PointsHeader { cube: Some(cube.clone()), ..PointsHeader::default() };
    let mut writer = Writer::<Points>::create(out, &provenance(Stage::Dsp, &scene, named), &header)?;
    for (index, file) in (0..).zip(progress::counted("frames", &files, files.len())) {
        let (seen, height) = read(file)?;
        let radar = Sensor { cube: cube.in_frame(index), axes: &axes, height: told.unwrap_or(height) };
        writer.write(&radar.frame(index, scene.frame_time_s(index), &seen))?;
    }
    loading::check_unchanged(&mut inputs)?;
    Ok(writer.finish()?)
}

/// The radar in one frame: its sub-frame determines which velocities it considers equal.
struct Sensor<'a> {
    cube: CubeHeader,
    axes: &'a LevelledAxes,
    height: Height,
}

impl Sensor<'_> {
    fn frame(&self, index: u32, time_s: f64, seen: &[Detection]) -> PointsFrame {
        let dsp = &self.cube.dsp;
        let points = seen.iter().map(|seen| seen.point(&self.cube, self.axes, self.height));
        let mut points: Vec<Point> = points.filter(|point| point.range_m >= dsp.nearest_m).collect();
        if dsp.static_echoes != StaticEchoes::Keep {
            self.mark(&mut points);
        }
        if dsp.static_echoes == StaticEchoes::Remove {
            points.retain(|point| point.stationary != Some(true));
        }
        let objects = dsp::objects_of_points(&self.cube, &mut points);
        PointsFrame { index, time_s, points, objects }
    }

    /// Sorts points by strength, and marks each as its summit is: at rest or not.
    fn mark(&self, points: &mut [Point]) {
        points.sort_by(|a, b| b.snr_db.total_cmp(&a.snr_db));
        let summits = summits(&self.cube, points);
        let marks: Vec<bool> = summits.iter().map(|summit| self.is_at_rest(&points[*summit])).collect();
        points.iter_mut().zip(marks).for_each(|(point, mark)| point.stationary = Some(mark));
    }

    /// Whether a point is at rest as far as this radar's map would tell: the cloud does not say how its folds
    /// were resolved.
    fn is_at_rest(&self, point: &Point) -> bool {
        let radar = &self.cube.radar;
        let over_noise = power_from_db(point.snr_db) * radar.virtual_channels() as f64;
        dsp::is_at_rest(radar, point.radial_velocity_mps, FoldCertainty::Assumed, over_noise)
    }
}

/// The description of a file's dataset, as this program writes one: three folders up for View-of-Delft and
/// nuScenes alike.
fn description_of(file: &Path) -> Option<PathBuf> {
    let file = std::fs::canonicalize(file).ok()?;
    file.ancestors().nth(3).map(|set| set.join("set.json")).filter(|place| place.is_file())
}

/// Source of the heights of a dataset, if its description specifies one.
fn described_height(description: &Path) -> Result<Option<Height>, Failure> {
    let text = bounded::read_text(description, LIMIT_BYTES);
    let text = text.map_err(|fault| Failure::unread(description, &fault))?;
    let told: Value = serde_json::from_str(&text).unwrap_or_default();
    let of_words = |words: &str| {
        if words == HeightSource::Measured.words() { Height::Measured } else { Height::Assumed }
    };
    Ok(told["heights"].as_str().map(of_words))
}

/// Detections of a file, and the source of their heights if no description specifies it: `.pcd` has no place
/// for it.
fn read(file: &Path) -> Result<(Vec<Detection>, Height), Failure> {
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let (found, height) = match extension(file) {
        Some("pcd") => (pcd::of_bytes(&bytes), Height::Assumed),
        _ => (velodyne::of_bytes(&bytes), Height::Measured),
    };
    let found = found.map_err(|why| Failure::Refused(format!("{}: {why}", file.display())))?;
    Ok((found, height))
}

/// The files of a folder with one of these endings, all the same one, in the order of `frame_order`; a
/// plain file is the only one.
pub fn frames_of(asked: &Path, endings: &[&str]) -> Result<Vec<PathBuf>, Failure> {
    if !asked.is_dir() {
        return Ok(vec![asked.to_owned()]);
    }
    let entries = std::fs::read_dir(asked).map_err(|e| Failure::system(asked, "be listed", e))?;
    let mut files = vec![];
    for entry in entries {
        let file = entry.map_err(|e| Failure::system(asked, "be listed", e))?.path();
        if extension(&file).is_some_and(|ending| endings.contains(&ending)) {
            files.push(file);
        }
    }
    files.sort_by(|a, b| frame_order(a).cmp(&frame_order(b)));
    let refused = |rule: String| Err(Failure::Refused(format!("{}: {rule}", asked.display())));
    match files.split_first() {
        None => refused(format!("no file in it ends in .{}", endings.join(" or ."))),
        Some((first, rest)) if rest.iter().any(|file| extension(file) != extension(first)) => {
            refused(format!("its files do not all end alike, in .{}", endings.join(" or .")))
        }
        Some(_) => Ok(files),
    }
}

/// Place of a frame's file among others: by its name's number, where the name is one, then by the name; those
/// with a number come first.
pub(crate) fn frame_order(file: &Path) -> (u128, &Path) {
    let number = file.file_stem().and_then(|name| name.to_str()?.parse().ok());
    (number.unwrap_or(u128::MAX), file)
}

/// Ending of a file's name.
pub fn extension(file: &Path) -> Option<&str> {
    file.extension().and_then(|ending| ending.to_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use scene::ReadOptions;

    #[test]
    fn points_of_a_scene_that_changed_after_its_hash_was_taken_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let [cloud, scene, out] = ["c.bin", "s.toml", "f.points"].map(|name| folder.path().join(name));
        std::fs::write(&cloud, [10.0_f32, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0].map(f32::to_le_bytes).concat())
            .unwrap();
        std::fs::write(&scene, "name = \"s\"\n").unwrap();
        let read = || loading::radar_only(&scene, None);
        let imported = |read: &dyn Fn() -> Result<SceneHeader, Failure>| {
            points(&cloud, std::slice::from_ref(&scene), read, &out)
        };
        let and_saved = || read().inspect(|_| std::fs::write(&scene, "name = \"other\"\n").unwrap());
        let refused = imported(&and_saved).unwrap_err().to_string();
        assert!(refused.contains("s.toml: was changed while") && !out.exists(), "{refused}");
        imported(&read).unwrap();
        assert!(out.exists());
    }

    /// Two detections in one place whose velocities differ by the span of the first sub-frame, which takes
    /// them for one: that of 20 µs is twice that of 40 µs, which does so too, that of 40 µs ¾ of that of 30
    /// µs.
    #[test]
    fn each_sub_frame_takes_for_one_velocity_what_its_own_span_does() {
        for (idle_us, objects) in [("[7.5, 27.5]", [1, 1]), ("[27.5, 17.5]", [1, 2])] {
            let text = format!(
                "name = \"s\"\n[radar.waveform]\nsamples = 64\nchirps = 32\nsub_frame_idle_us = {idle_us}\n"
            );
            let options = ReadOptions::names_only();
            let scene = scene::read_text(Path::new("s.toml"), &text, &options).unwrap();
            let (cube, axes) = (cube_header(&scene), LevelledAxes::of(&scene.radar));
            let span_mps = 2.0 * cube.in_frame(0).radar.velocity_max_mps();
            let seen = [0.0, span_mps].map(|velocity_mps| Detection {
                place_m: DVec3::new(30.0, 0.0, 0.0),
                section_dbsm: 0.0,
                velocity_mps,
            });
            let found = [0, 1].map(|index| {
                let radar = Sensor { cube: cube.in_frame(index), axes: &axes, height: Height::Measured };
                radar.frame(index, 0.0, &seen).objects.len()
            });
            assert_eq!(found, objects, "{idle_us}");
        }
    }

    /// A frame of two echoes, each with the cells of its lobe in five rows: one at rest, and one two cells
    /// faster, one of whose cells lies in the row of zero Doppler.
    fn lobes(static_echoes: &str) -> PointsFrame {
        let text = format!(
            "name = \"s\"\n[radar.waveform]\nsamples = 64\nchirps = 32\n[noise]\nnoise_figure_db = 12.0\n\
             [dsp]\nstatic = \"{static_echoes}\"\n"
        );
        let scene = scene::read_text(Path::new("s.toml"), &text, &ReadOptions::names_only()).unwrap();
        let (cube, axes) = (cube_header(&scene), LevelledAxes::of(&scene.radar));
        let cell_mps = cube.radar.velocity_resolution_mps();
        let lobe = |(ahead_m, row): (f64, i32)| {
            (-2..=2).map(move |down| Detection {
                place_m: DVec3::new(ahead_m, 0.0, 0.0),
                section_dbsm: 25.0 - 3.0 * f64::from(down * down),
                velocity_mps: f64::from(row + down) * cell_mps,
            })
        };
        let seen: Vec<Detection> = [(30.0, 0), (45.0, 2)].into_iter().flat_map(lobe).collect();
        Sensor { cube, axes: &axes, height: Height::Measured }.frame(0, 0.0, &seen)
    }

    #[test]
    fn points_in_the_main_lobe_of_a_stronger_one_are_at_rest_if_it_is() {
        let [kept, marked, left] = ["keep", "mark", "remove"].map(lobes);
        let marks = |frame: &PointsFrame, is_near: bool| {
            let points = frame.points.iter().filter(|point| (point.range_m < 40.0) == is_near);
            points.map(|point| point.stationary).collect::<Vec<_>>()
        };
        assert_eq!([marks(&kept, true), marks(&kept, false)], [[None; 5]; 2]);
        assert_eq!([marks(&marked, true), marks(&marked, false)], [[Some(true); 5], [Some(false); 5]]);
        assert_eq!((marks(&left, true), marks(&left, false)), (vec![], vec![Some(false); 5]));
        let of_objects = |frame: &PointsFrame| {
            frame.objects.iter().map(|object| (object.points, object.stationary)).collect::<Vec<_>>()
        };
        assert_eq!(of_objects(&marked), [(5, Some(true)), (5, Some(false))]);
        assert_eq!(of_objects(&left), [(5, Some(false))]);
    }

    #[test]
    fn frames_are_in_the_order_of_their_numbers_and_then_of_their_names() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b-2", "100000", "b-10", "99999", "00007", "7"] {
            std::fs::write(folder.path().join(format!("{name}.bin")), []).unwrap();
        }
        let found = frames_of(folder.path(), &["bin"]).unwrap();
        let names: Vec<&str> = found.iter().map(|file| file.file_stem().unwrap().to_str().unwrap()).collect();
        assert_eq!(names, ["00007", "7", "99999", "100000", "b-10", "b-2"]);
    }
}
