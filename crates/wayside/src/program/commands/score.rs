//! `score`: agreement of any program's points and tracks with a scene or with labels of a dataset, by the
//! metrics of `summary.json`.

use crate::program::cli::ScoreArguments;
use crate::program::terminal;
use artifact::paths::{GROUND, Paths, PathsFrame};
use artifact::points::{Points, PointsFrame};
use artifact::scene::{Scene, SceneFrame, SceneHeader};
use artifact::tracks::{Tracks, TracksFrame};
use artifact::{Provenance, Radar, Reader};
use dsp::{ROAD_TRAFFIC, Tracker};
use evaluation::{FrameTruth, Score};
use formats::training_sets::labels::SetLabels;
use pipeline::host::failure::Failure;
use pipeline::host::frame_matching::{FrameMatcher, ROUNDED_TIME_S, SAME_TIME_S, check_begin, check_poses};
use pipeline::host::progress;
use pipeline::host::provenance_checks;
use serde_json::Value;
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &ScoreArguments) -> Result<(), Failure> {
    let told = match (&arguments.scene, &arguments.labels) {
        (Some(scene), _) => by_scene(arguments, scene)?,
        (None, Some(labels)) => by_labels(arguments, labels)?,
        (None, None) => {
            let points = arguments.points.display();
            let rule = "--scene or --labels has to give the truth";
            return Err(Failure::System(format!("{points}: {rule}")));
        }
    };
    terminal::lines(&told);
    Ok(())
}

fn by_scene(arguments: &ScoreArguments, file: &Path) -> Result<String, Failure> {
    let points = Reader::<Points>::open(&arguments.points)?;
    let mut scene = FrameMatcher::<Scene>::open(file, |frame| frame.index)?;
    let from = &points.preamble().provenance;
    let is_same = provenance_checks::same_scene(file, scene.provenance(), ("frames", from))?;
    let header = scene.header().clone();
    provenance_checks::has_bodies(file, &header, &points.header().targets)?;
    let radar = points.header().cube.as_ref().map(|cube| &cube.radar);
    provenance_checks::same_radar(&arguments.points, &header.radar, radar)?;
    let mut tracks = TrackSource::of(arguments, &points, &header.radar, Some((file, scene.provenance())))?;
    let mut paths = arguments.paths.as_deref().map(|file| paths_of(file, &header)).transpose()?;
    let within_s = if is_same { SAME_TIME_S } else { ROUNDED_TIME_S };
    let mut score = Score::default();
    for frame in progress::frames(points) {
        let frame = frame?;
        let poses = scene.frame(frame.index)?;
        check_begin(&arguments.points, (frame.index, frame.time_s), &poses, within_s)?;
        let tracks = tracks.frame(&frame, &poses)?;
        let bodies = scene::bodies_in_view(&header, frame.index);
        let paths = paths.as_mut().map(|paths| paths.frame(&poses)).transpose()?;
        let paths = paths.map(|paths| counted_in_view(&bodies, paths));
        let view = scene::frame_view(&header, frame.index);
        check_poses(file, &view, &poses)?;
        let truth = FrameTruth::of(&view, &poses, paths.as_ref(), &frame.objects);
        score.add(&FrameTruth { bodies, ..truth }, &frame.objects, &tracks);
    }
    serde_json::to_string_pretty(&score.metrics()).map_err(Failure::refused)
}

/// Score of the frames that have labels. Where these do not tell bodies apart there are no identities.
fn by_labels(arguments: &ScoreArguments, place: &Path) -> Result<String, Failure> {
    let labels = SetLabels::of_points(place, &arguments.points)?;
    let points = Reader::<Points>::open(&arguments.points)?;
    let mut tracks = TrackSource::of(arguments, &points, labels.radar(), None)?;
    let mut score = Score::default();
    for frame in progress::frames(points) {
        let frame = frame?;
        // Labels tell no times: the points' own count.
        let begin = SceneFrame { index: frame.index, time_s: frame.time_s, poses: vec![] };
        let tracks = tracks.frame(&frame, &begin)?;
        if let Some(truth) = labels.truth(&frame) {
            score.add(&truth, &frame.objects, &tracks);
        }
    }
    if labels.tells_bodies() {
        return serde_json::to_string_pretty(&score.metrics()).map_err(Failure::refused);
    }
    let mut told = serde_json::to_value(score.metrics()).map_err(Failure::refused)?;
    told["identities"] = Value::Null;
    serde_json::to_string_pretty(&told).map_err(Failure::refused)
}

/// Paths of a scene, refused if they belong to another scene's bodies.
struct PathsOfScene {
    file: PathBuf,
    paths: FrameMatcher<Paths>,
}

fn paths_of(file: &Path, scene: &SceneHeader) -> Result<PathsOfScene, Failure> {
    let paths = FrameMatcher::<Paths>::open(file, |frame| frame.index)?;
    provenance_checks::are_of_bodies(file, scene, &paths.header().targets)?;
    provenance_checks::same_radar(file, &scene.radar, Some(&paths.header().radar))?;
    provenance_checks::are_of_same_bodies(scene, paths.provenance())
        .map_err(|failure| failure.about(file))?;
    Ok(PathsOfScene { file: file.to_owned(), paths })
}

impl PathsOfScene {
    /// Paths of the scene's frame.
    fn frame(&mut self, of_scene: &SceneFrame) -> Result<PathsFrame, Failure> {
        let frame = self.paths.frame(of_scene.index)?;
        check_begin(&self.file, (frame.index, frame.time_s), of_scene, SAME_TIME_S)?;
        Ok(frame)
    }
}

/// Source of tracks: a file, or a tracker run here.
enum TrackSource {
    Given(PathBuf, Box<FrameMatcher<Tracks>>),
    Here(Box<Tracker>),
}

impl TrackSource {
    /// Tracks of a file, refused if they belong to another radar, or to another scene where one is given, or
    /// those made with the points' own radar and settings.
    fn of(
        arguments: &ScoreArguments,
        points: &Reader<Points>,
        radar: &Radar,
        scene: Option<(&Path, &Provenance)>,
    ) -> Result<Self, Failure> {
        if let Some(file) = &arguments.tracks {
            let tracks = FrameMatcher::<Tracks>::open(file, |frame| frame.index)?;
            if let Some((scene, from)) = scene {
                provenance_checks::same_scene(scene, from, ("tracks", tracks.provenance()))?;
            }
            let seen_by = tracks.header().cube.as_ref().map(|cube| &cube.radar);
            provenance_checks::same_radar(file, radar, seen_by)?;
            return Ok(Self::Given(file.clone(), Box::new(tracks)));
        }
        let Some(cube) = &points.header().cube else {
            let file = arguments.points.display();
            let rule = "no radar stands in these points that objects could be followed with: give --tracks";
            return Err(Failure::Refused(format!("{file}: {rule}")));
        };
        Ok(Self::Here(Box::new(Tracker::new(cube, ROAD_TRAFFIC).map_err(Failure::refused)?)))
    }

    /// Tracks of the frame of these points; the scene gives its time.
    fn frame(&mut self, points: &PointsFrame, of_scene: &SceneFrame) -> Result<TracksFrame, Failure> {
        match self {
            Self::Given(file, tracks) => {
                let frame = tracks.frame(points.index)?;
                check_begin(file, (frame.index, frame.time_s), of_scene, ROUNDED_TIME_S)?;
                Ok(frame)
            }
            Self::Here(tracker) => tracker.step(points).map_err(Failure::refused),
        }
    }
}

/// Renumbers the bodies of paths to those in the frame's view if their file numbers them over the whole
/// scene; `bodies` are the scene's numbers of those in view.
fn counted_in_view(bodies: &[u32], paths: PathsFrame) -> PathsFrame {
    let place = |body: u32| bodies.iter().position(|number| *number == body);
    paths.renumbered(|body| place(body).map_or(GROUND, |place| place as u32))
}
