//! One frame of the view, taken while the frame's products exist, and all of them for the page.

use crate::report::viewer::body_view::BodyView;
use crate::report::viewer::map_cells::MapCells;
use crate::report::viewer::packed::Packed;
use crate::report::viewer::page_budget::Budget;
use crate::report::viewer::page_script::json;
use crate::report::viewer::path_geometry::PathFolding;
use crate::report::viewer::strongest_paths::StrongestPaths;
use crate::report::viewer::surroundings::Surroundings;
use artifact::paths::PathsFrame;
use artifact::points::{Height, Object, Point, PointsFrame};
use artifact::tracks::{Track, TracksFrame};
use evaluation::{FrameTruth, Origin};
use pipeline::chain::link::{Chain, FrameProducts};
use pipeline::host::failure::Failure;
use pipeline::outcome::summary::{ErrorFigures, FrameSummary, ModelErrorFigures, Summary, TargetSummary};
use radar::motion::pose_after;
use serde::Serialize;

/// Numbers of a run for the view, as far as it is computed.
#[derive(Debug, Default)]
pub struct ViewerData {
    surroundings: Option<Surroundings>,
    every: u32,
    frames: Vec<ViewedFrame>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct ViewedFrame {
    index: u32,
    time_s: f64,
    bodies: Vec<BodyView>,
    /// Strongest paths; `None` for echoes from tables.
    paths: Option<StrongestPaths>,
    map: MapCells,
    /// Assumed height of points and objects, m; `None` if none depends on it.
    assumed_height_m: Option<f64>,
    points: PointsView,
    objects: Vec<ObjectView>,
    tracks: Vec<TrackView>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct PointsView {
    places_m: Packed,
    ranges_m: Packed,
    velocities_mps: Packed,
    snrs_db: Packed,
    /// Source of each point's height, as an index into [`HEIGHTS`].
    heights: Packed,
    /// Index of each point's object, counted from 1; 0: none.
    objects: Packed,
    /// Body of each point's echo, counted from 1; 0: none.
    targets: Packed,
    /// Bounces of that echo.
    orders: Packed,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct ObjectView {
    place_m: [f64; 3],
    range_m: f64,
    velocity_mps: f64,
    snr_db: f64,
    /// Source of its height, as an index into [`HEIGHTS`].
    height: u8,
    points: u32,
    /// Index of the object's body; `None`: nobody's.
    target: Option<usize>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct TrackView {
    id: u32,
    state: &'static str,
    place_m: [f64; 2],
    velocity_mps: [f64; 2],
    centre_m: [f64; 2],
    length_m: f64,
    width_m: f64,
    heading_rad: f64,
}

/// Everything that the page's script reads.
#[derive(Serialize)]
struct PageData<'a> {
    frames_all: usize,
    every: u32,
    surroundings: &'a Surroundings,
    frames: Vec<PageFrame<'a>>,
}

#[derive(Serialize)]
struct PageFrame<'a> {
    shown: &'a ViewedFrame,
    targets: &'a [TargetSummary],
    error_db: ErrorFigures,
    model_error_db: ModelErrorFigures,
}

impl ViewerData {
    /// Takes the shown parts of a frame if it is viewed; `frame` does not contain truth yet.
    pub fn take(
        &mut self,
        chain: &Chain,
        frame: &FrameProducts,
        truth: &FrameTruth,
        tracks: &TracksFrame,
    ) -> Result<(), Failure> {
        let cells = frame.rdm.mask.len();
        let budget = Budget::of(chain.header, cells);
        self.every = budget.every;
        if !frame.result.scene.index.is_multiple_of(budget.every) {
            return Ok(());
        }
        self.surroundings.get_or_insert_with(|| Surroundings::of(chain.header));
        self.frames.push(ViewedFrame::of(chain, frame, truth, tracks, &budget)?);
        Ok(())
    }

    /// Numbers for the page's script as embeddable JSON; `None` if nothing was taken.
    pub(super) fn json<'a>(&'a self, summary: &'a Summary) -> Option<String> {
        let surroundings = self.surroundings.as_ref()?;
        let told =
            |frame: &'a ViewedFrame| Some(PageFrame::of(frame, summary.frames.get(frame.index as usize)?));
        let frames = self.frames.iter().filter_map(told);
        let frames_all = summary.frames.len();
        let data = PageData { frames_all, every: self.every, surroundings, frames: frames.collect() };
        json(&data).ok()
    }
}

impl<'a> PageFrame<'a> {
    fn of(frame: &'a ViewedFrame, told: &'a FrameSummary) -> Self {
        let FrameSummary { targets, error_db, model_error_db, .. } = told;
        Self { shown: frame, targets, error_db: *error_db, model_error_db: *model_error_db }
    }
}

impl ViewedFrame {
    fn of(
        chain: &Chain,
        frame: &FrameProducts,
        truth: &FrameTruth,
        tracks: &TracksFrame,
        budget: &Budget,
    ) -> Result<Self, Failure> {
        let (view, scene) = (&frame.view, &frame.result.scene);
        let header = chain.cube_header().in_frame(scene.index);
        let radar = &header.radar;
        let folding = PathFolding::of(view, scene, radar);
        let traced = frame.result.scattering.paths();
        let strongest =
            |paths: &PathsFrame| StrongestPaths::of(radar, paths, &folding, view.targets.len(), budget.paths);
        let heard =
            traced.map(|paths| chain.synthesizer().map(|echo| echo.with_ground(paths))).transpose()?;
        let middle_s = radar.frame_middle_s();
        let bodies = view.targets.iter().zip(&scene.poses);
        let points = &frame.result.points;
        let objects = points.objects.iter().enumerate();
        Ok(Self {
            index: scene.index,
            time_s: scene.time_s,
            bodies: bodies.map(|(target, pose)| BodyView::of(target, &pose_after(pose, middle_s))).collect(),
            paths: traced.map(strongest),
            map: MapCells::of(&header, frame, heard.as_deref(), budget.cells)?,
            assumed_height_m: has_assumed(points).then_some(header.dsp.assumed_height_m),
            points: PointsView::of(points, truth, radar.position_m),
            objects: objects.map(|(i, object)| ObjectView::of(object, truth.pairing.body_of(i))).collect(),
            tracks: tracks.tracks.iter().map(TrackView::of).collect(),
        })
    }
}

/// Precision of points: m, m/s and dB.
const STEP: f64 = 0.01;

/// Sources of heights, in the page's numbering (`HEIGHTS` of telling.js).
const HEIGHTS: [Height; 3] = [Height::Measured, Height::Assumed, Height::None];

fn counted(height: Height) -> u8 {
    HEIGHTS.iter().take_while(|other| **other != height).count() as u8
}

fn has_assumed(frame: &PointsFrame) -> bool {
    let heights = frame.points.iter().map(|point| point.height);
    heights.chain(frame.objects.iter().map(|object| object.height)).any(|height| height == Height::Assumed)
}

impl PointsView {
    fn of(frame: &PointsFrame, truth: &FrameTruth, radar_m: [f64; 3]) -> Self {
        let steps = |of: &dyn Fn(&Point) -> f64| {
            Packed::steps(&frame.points.iter().map(of).collect::<Vec<_>>(), STEP)
        };
        let labels = || (0..frame.points.len()).map(|i| truth.origins.get(i).and_then(Origin::label));
        let places: Vec<[f64; 3]> = frame.points.iter().map(|point| point.position_m).collect();
        let from_1 = |index: Option<u32>| index.map_or(0, |index| index + 1);
        let heights: Vec<u8> = frame.points.iter().map(|point| counted(point.height)).collect();
        Self {
            places_m: Packed::places(&places, radar_m, STEP),
            ranges_m: steps(&|point| point.range_m),
            velocities_mps: steps(&|point| point.radial_velocity_mps),
            snrs_db: steps(&|point| point.snr_db),
            heights: Packed::bytes(&heights),
            objects: Packed::numbers(&frame.points.iter().map(|p| from_1(p.object)).collect::<Vec<_>>()),
            targets: Packed::numbers(&labels().map(|l| from_1(l.map(|l| l.target))).collect::<Vec<_>>()),
            orders: Packed::bytes(&labels().map(|l| l.map_or(0, |l| l.order)).collect::<Vec<_>>()),
        }
    }
}

impl ObjectView {
    fn of(object: &Object, target: Option<usize>) -> Self {
        Self {
            place_m: object.position_m,
            range_m: object.range_m,
            velocity_mps: object.radial_velocity_mps,
            snr_db: object.snr_db,
            height: counted(object.height),
            points: object.points,
            target,
        }
    }
}

impl TrackView {
    fn of(track: &Track) -> Self {
        let footprint = &track.footprint;
        Self {
            id: track.id,
            state: track.state.name(),
            place_m: track.position_m,
            velocity_mps: track.velocity_mps,
            centre_m: footprint.centre_m,
            length_m: footprint.length_m,
            width_m: footprint.width_m,
            heading_rad: footprint.heading_rad,
        }
    }
}
