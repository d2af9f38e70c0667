//! `score`: how well anybody's points and tracks agree with a scene, as the metrics of `summary.json`.

use crate::host::failure::Failure;
use crate::program::cli::ScoreArguments;
use crate::program::terminal;
use artifact::paths::{GROUND, Paths, PathsFrame};
use artifact::points::{Points, PointsFrame};
use artifact::scene::{Scene, SceneFrame, SceneHeader};
use artifact::tracks::{Tracks, TracksFrame};
use artifact::{ArtifactError, Reader, Schema};
use dsp::{ROAD_TRAFFIC, Tracker};
use evaluation::{FrameTruth, Score};
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &ScoreArguments) -> Result<(), Failure> {
    let points = Reader::<Points>::open(&arguments.points)?;
    let scene = Reader::<Scene>::open(&arguments.scene)?;
    let header = scene.header().clone();
    let mut files = Files {
        tracks: Followed::of(arguments, &points)?,
        paths: arguments.paths.as_deref().map(Reader::<Paths>::open).transpose()?,
        scene,
        arguments,
    };
    let mut score = Score::default();
    for frame in points {
        let frame = frame?;
        let (poses, paths, tracks) = files.beside(&header, &frame)?;
        let view = scene::frame_view(&header, frame.index);
        let truth = FrameTruth::of(&view, &poses, paths.as_ref(), &frame.objects);
        let bodies = scene::bodies_in_view(&header, frame.index);
        score.add(&FrameTruth { bodies, ..truth }, &frame.objects, &tracks);
    }
    terminal::line(serde_json::to_string_pretty(&score.metrics()).map_err(Failure::refused)?);
    Ok(())
}

/// Files that are read beside the points, frame by frame.
struct Files<'a> {
    scene: Reader<Scene>,
    paths: Option<Reader<Paths>>,
    tracks: Followed,
    arguments: &'a ScoreArguments,
}

impl Files<'_> {
    /// Poses, paths and tracks of the frame that these points are of.
    fn beside(
        &mut self,
        header: &SceneHeader,
        points: &PointsFrame,
    ) -> Result<(SceneFrame, Option<PathsFrame>, TracksFrame), Failure> {
        let index = points.index;
        let poses = of_frame(&mut self.scene, |frame| frame.index, index, &self.arguments.scene)?;
        let paths = match (&mut self.paths, &self.arguments.paths) {
            (Some(reader), Some(file)) => Some(of_frame(reader, |frame| frame.index, index, file)?),
            _ => None,
        };
        let paths = paths.map(|paths| counted_in_view(header, paths));
        let tracks = match &mut self.tracks {
            Followed::Given(reader, file) => of_frame(reader, |frame| frame.index, index, file)?,
            Followed::Here(tracker) => tracker.step(points).map_err(Failure::refused)?,
        };
        Ok((poses, paths, tracks))
    }
}

/// Source of tracks: a file, or a tracker that runs here.
enum Followed {
    Given(Box<Reader<Tracks>>, PathBuf),
    Here(Box<Tracker>),
}

impl Followed {
    /// The tracks of a file, or those that the points' own radar and settings give.
    fn of(arguments: &ScoreArguments, points: &Reader<Points>) -> Result<Self, Failure> {
        if let Some(file) = &arguments.tracks {
            return Ok(Self::Given(Box::new(Reader::open(file)?), file.clone()));
        }
        let Some(cube) = &points.header().cube else {
            let file = arguments.points.display();
            let rule = "no radar stands in these points that objects could be followed with: give --tracks";
            return Err(Failure::Refused(format!("{file}: {rule}")));
        };
        Ok(Self::Here(Box::new(Tracker::new(cube, ROAD_TRAFFIC).map_err(Failure::refused)?)))
    }
}

/// The frame of this index; frames before it are passed over.
fn of_frame<S: Schema>(
    reader: &mut Reader<S>,
    index_of: impl Fn(&S::Frame) -> u32,
    index: u32,
    file: &Path,
) -> Result<S::Frame, Failure> {
    let found = reader.find(|frame| frame.as_ref().map_or(true, |frame| index_of(frame) >= index));
    let found: Option<Result<S::Frame, ArtifactError>> = found;
    match found.transpose()? {
        Some(frame) if index_of(&frame) == index => Ok(frame),
        _ => Err(Failure::Refused(format!(
            "{}: frame {index} of the points is not in it, or not in the order of the points",
            file.display()
        ))),
    }
}

/// Paths with bodies counted as in the frame's view, where their file counts them through the whole scene.
fn counted_in_view(scene: &SceneHeader, mut frame: PathsFrame) -> PathsFrame {
    let bodies = scene::bodies_in_view(scene, frame.index);
    let in_view = |body: &mut u32| {
        let place = bodies.iter().position(|number| number == body);
        *body = place.map_or(GROUND, |place| place as u32);
    };
    for path in &mut frame.paths {
        in_view(&mut path.target);
        path.facets[..usize::from(path.order)].iter_mut().for_each(|facet| in_view(&mut facet.body));
    }
    frame
}
