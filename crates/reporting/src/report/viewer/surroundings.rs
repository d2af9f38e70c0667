//! Things common to all frames of the view: the radar with its field of view, the road, the meshes.

use crate::pictures::field_of_view;
use crate::pictures::lane_sides::lane_sides_m;
use crate::report::viewer::packed::Packed;
use crate::report::viewer::page_budget::TRIANGLES;
use artifact::radar::{Radar, Sampling};
use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::{Lane, Lanes, NetworkLane};
use serde::Serialize;

/// Radar, road and meshes of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::report) struct Surroundings {
    radar: RadarView,
    /// Roads as rows of places left and right, world x and y, m.
    roads_m: Vec<[Vec<[f64; 2]>; 2]>,
    /// Lines of lanes.
    lines_m: Vec<Vec<[f64; 2]>>,
    lanes: Vec<LaneName>,
    meshes: Vec<MeshView>,
}

/// A radar with its field of view.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::report) struct RadarView {
    position_m: [f64; 3],
    boresight_az_rad: f64,
    boresight_el_rad: f64,
    /// Half angles of the field of view left and right of the boresight, −3 dB of an element.
    half_angles_rad: [f64; 2],
    range_max_m: f64,
    /// Whether echoes from beyond the range axis fold to its beginning.
    ranges_repeat: bool,
    /// Field of view in words.
    words: String,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct LaneName {
    name: String,
    at_m: [f64; 2],
}

/// A mesh, or only its box if there is no room for more.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct MeshView {
    /// Corners of the bounding box, body axes, m.
    box_m: [[f64; 3]; 2],
    triangles_all: usize,
    /// Vertices, x, y, z, m; `None` if the box replaces them.
    corners_m: Option<Packed>,
    triangles: Option<Packed>,
}

/// Precision of the corners of meshes, m.
const STEP_M: f64 = 0.001;

impl Surroundings {
    /// Surroundings of a scene.
    pub(in crate::report) fn of(header: &SceneHeader) -> Self {
        let mut shelf = MeshTable::default();
        header.meshes.iter().for_each(|mesh| {
            shelf.put(mesh);
        });
        Self::with_meshes(header, shelf)
    }

    /// Radar and road of a scene, with these meshes.
    pub(in crate::report) fn with_meshes(header: &SceneHeader, shelf: MeshTable) -> Self {
        let (road, far_m) = (&header.dsp.road, header.radar.waveform.range_max_m());
        let near_m = header.intersection.width_m;
        let straight = |lane: &Lane| lane_m(road, lane, [near_m, far_m]);
        let sides = road.lanes.iter().map(straight).chain(road.courses.iter().map(lane_sides_m));
        let mut roads_m: Vec<[Vec<[f64; 2]>; 2]> = sides.collect();
        let lines_m = roads_m.iter().flatten().cloned().collect();
        roads_m.extend(crossing_m(road, near_m));
        let of_lane = |lane: &Lane| LaneName {
            name: format!("lane {}", lane.number),
            at_m: road.world_m([lane.centre_m, near_m + 3.0]),
        };
        let lanes = road.lanes.iter().map(of_lane).chain(road.courses.iter().filter_map(course_name));
        let lanes = lanes.collect();
        Self { radar: RadarView::of(&header.radar), roads_m, lines_m, lanes, meshes: shelf.meshes }
    }
}

impl RadarView {
    pub(in crate::report) fn of(radar: &Radar) -> Self {
        Self {
            position_m: radar.position_m,
            boresight_az_rad: radar.boresight_az_rad,
            boresight_el_rad: radar.boresight_el_rad,
            half_angles_rad: field_of_view::half_angles_rad(radar),
            range_max_m: radar.waveform.range_max_m(),
            ranges_repeat: radar.waveform.sampling == Sampling::Complex,
            words: field_of_view::words(radar),
        }
    }
}

/// Left and right side of a straight lane.
fn lane_m(road: &Lanes, lane: &Lane, ends_m: [f64; 2]) -> [Vec<[f64; 2]>; 2] {
    [-0.5, 0.5].map(|share| {
        let across_m = lane.centre_m + share * lane.width_m;
        ends_m.map(|along_m| road.world_m([across_m, along_m])).to_vec()
    })
}

/// The road that crosses before the lanes begin.
fn crossing_m(road: &Lanes, width_m: f64) -> Option<[Vec<[f64; 2]>; 2]> {
    const HALF_LENGTH_M: f64 = 60.0;
    let side = |along_m: f64| [-HALF_LENGTH_M, HALF_LENGTH_M].map(|x| road.world_m([x, along_m])).to_vec();
    (width_m > 0.0 && !road.lanes.is_empty()).then(|| [side(width_m), side(0.0)])
}

fn course_name(course: &NetworkLane) -> Option<LaneName> {
    let at_m = course.line_m.get(course.line_m.len() / 2)?;
    Some(LaneName { name: format!("{} {}", course.number, course.name), at_m: *at_m })
}

/// Meshes of a page, whole as long as there is room.
#[derive(Default)]
pub(in crate::report) struct MeshTable {
    meshes: Vec<MeshView>,
    triangles: usize,
}

impl MeshTable {
    /// Appends a mesh, and returns its index.
    pub(in crate::report) fn put(&mut self, mesh: &Mesh) -> u32 {
        let fits = self.triangles + mesh.triangles.len() <= TRIANGLES;
        self.triangles += if fits { mesh.triangles.len() } else { 0 };
        self.meshes.push(MeshView::of(mesh, fits.then_some(mesh)));
        self.meshes.len() as u32 - 1
    }
}

impl MeshView {
    fn of(mesh: &Mesh, shown: Option<&Mesh>) -> Self {
        let corners = |mesh: &Mesh| mesh.vertices_m.as_flattened().to_vec();
        Self {
            box_m: box_m(mesh),
            triangles_all: mesh.triangles.len(),
            corners_m: shown.map(|mesh| Packed::steps(&corners(mesh), STEP_M)),
            triangles: shown.map(|mesh| Packed::numbers(mesh.triangles.as_flattened())),
        }
    }
}

fn box_m(mesh: &Mesh) -> [[f64; 3]; 2] {
    let span = |axis: usize| {
        let values = mesh.vertices_m.iter().map(|v| v[axis]);
        values.fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(v), high.max(v)])
    };
    let spans = [span(0), span(1), span(2)];
    [spans.map(|s| s[0]), spans.map(|s| s[1])]
}
