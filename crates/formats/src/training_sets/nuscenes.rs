//! Layout of nuScenes (Caesar et al. 2020): radar clouds as `.pcd`, and all tables of its database.
//!
//! `samples/RADAR_FRONT/NNNNNN.pcd` in the levelled axes of the radar, tables as JSON in `v1.0-wayside`. The
//! global frame is the scene's world; the ego vehicle is at the radar's foot.

use crate::levelled_axes::LevelledAxes;
use crate::radar_cloud::{Detection, pcd};
use crate::training_sets::nuscenes_tables::{AnnotatedBody, Tables};
use crate::training_sets::opened_points::OpenedPoints;
use crate::training_sets::radar_of_points::sections_of;
use crate::training_sets::set_folder::SetFolder;
use crate::training_sets::truth_boxes::TruthBox;
use artifact::points::{Point, PointsFrame, PointsHeader};
use glam::DVec3;
use pipeline::host::failure::Failure;
use reporting::pictures;
use serde_json::json;
use std::path::Path;

/// Folder of the tables: the version to request from the dataset's own reader.
const VERSION: &str = "v1.0-wayside";

/// Distance from a box within which a point counts as its own, m: a range cell and the noise of its azimuth.
const NEAR_M: f64 = 0.5;

/// Writes the points of a run as one scene of the dataset, labelled if a scene is given.
pub fn write(file: &Path, scene: Option<&Path>, out: &Path) -> Result<(), Failure> {
    let OpenedPoints { reader, header, heights, mut truth, axes } = OpenedPoints::open(file, scene)?;
    let name = truth.as_ref().map_or("scene".to_owned(), |truth| truth.header().name.clone());
    let mut set = SetFolder::begin(out)?;
    let mut tables = Tables::of(&name, &axes);
    let frames = set.each_frame(
        reader,
        |frame| frame.index,
        |set, frame| {
            let file = format!("samples/RADAR_FRONT/{:06}.pcd", frame.index);
            set.write(&file, &pcd::to_bytes(&rows(&header, &axes, &frame)))?;
            let boxes = truth
                .as_mut()
                .map(|truth| truth.of_frame(frame.index, frame.time_s))
                .transpose()?
                .unwrap_or_default();
            let seen =
                boxes.into_iter().map(|body| AnnotatedBody { points: points_in(&body, &frame.points), body });
            tables.add(frame.time_s, &file, seen.collect());
            Ok(())
        },
    )?;
    for (table, content) in tables.content() {
        set.write_json(&format!("{VERSION}/{table}.json"), &content)?;
    }
    pictures::write_gray(&set.place("maps/none.png"), [1, 1], &[255])?;
    set.finish(&json!({
        "set": "nuScenes", "version": VERSION, "frames": frames, "labelled": truth.is_some(),
        "rcs": sections_of(&header), "heights": heights.words(),
        "not_filled": ["x_rms", "y_rms", "vx_rms", "vy_rms", "pdh0", "num_lidar_pts", "visibility", "map"],
    }))
}

fn rows(header: &PointsHeader, axes: &LevelledAxes, frame: &PointsFrame) -> Vec<pcd::Row> {
    let row = |(number, point): (usize, &Point)| pcd::Row {
        seen: Detection::of(header.cube.as_ref(), axes, point),
        id: i16::try_from(number).unwrap_or(i16::MAX),
        dynamics: point.stationary.map_or(4, i8::from),
        // The dataset's own reader keeps only detections marked as unambiguous: velocities are the radar's,
        // resolved or within its span.
        ambiguity: 3,
    };
    frame.points.iter().enumerate().map(row).filter(|row| row.seen.is_sound()).collect()
}

fn points_in(body: &TruthBox, points: &[Point]) -> usize {
    let is_near = |point: &&Point| {
        let place_m = DVec3::from(point.position_m);
        body.nearest_m(place_m).distance(place_m) <= NEAR_M
    };
    points.iter().filter(is_near).count()
}
