//! Messages of other programs: ASAM OSI in `.osi` or MCAP, ROS 2 and Foxglove in MCAP.

use artifact::paths::Paths;
use artifact::points::Points;
use artifact::tracks::{Tracks, TracksFrame};
use artifact::{Reader, Schema};
use interchange::{Container, FoxgloveRecording, RosRecording, SensorDataTrace, SensorViewTrace};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use pipeline::outcome::summary::{Summary, TrackSummary};
use std::collections::BTreeMap;
use std::io::Error;
use std::path::Path;

/// An artifact as messages of OSI.
pub fn osi(file: &Path, schema: &str, out: &Path) -> Result<(), Failure> {
    let container = container_of(out)?;
    match schema {
        Points::NAME => points_as_osi(Reader::open(file)?, container, out),
        Tracks::NAME => tracks_as_osi(Reader::open(file)?, container, out, &Classes::beside(file)?),
        _ => paths_as_osi(Reader::open(file)?, container, out),
    }
}

/// An artifact as messages of ROS 2.
pub fn mcap(file: &Path, schema: &str, out: &Path) -> Result<(), Failure> {
    match schema {
        Points::NAME => points_as_ros(Reader::open(file)?, out),
        _ => tracks_as_ros(Reader::open(file)?, out),
    }
}

/// Points as messages of Foxglove.
pub fn foxglove(file: &Path, out: &Path) -> Result<(), Failure> {
    let reader = Reader::<Points>::open(file)?;
    files::write_with(out, |stream| {
        let mut recording = FoxgloveRecording::create(stream)?;
        for frame in progress::frames(reader) {
            recording.points(&frame.map_err(Error::other)?)?;
        }
        recording.finish()
    })
}

/// The container for a file name's ending.
fn container_of(out: &Path) -> Result<Container, Failure> {
    match out.extension().and_then(|ending| ending.to_str()) {
        Some("osi") => Ok(Container::Osi),
        Some("mcap") => Ok(Container::Mcap),
        _ => Err(Failure::System(format!(
            "{}: messages of OSI go into a file that ends in .osi or .mcap",
            out.display()
        ))),
    }
}

fn points_as_osi(reader: Reader<Points>, container: Container, out: &Path) -> Result<(), Failure> {
    let header = reader.header().clone();
    files::write_with(out, |stream| {
        let mut trace = SensorDataTrace::create(stream, container)?;
        for frame in progress::frames(reader) {
            trace.points(&header, &frame.map_err(Error::other)?)?;
        }
        trace.finish()
    })
}

fn tracks_as_osi(
    reader: Reader<Tracks>,
    container: Container,
    out: &Path,
    classes: &Classes,
) -> Result<(), Failure> {
    let header = reader.header().clone();
    files::write_with(out, |stream| {
        let mut trace = SensorDataTrace::create(stream, container)?;
        for frame in progress::frames(reader) {
            let frame = frame.map_err(Error::other)?;
            trace.tracks(&header, &frame, &classes.of(&frame))?;
        }
        trace.finish()
    })
}

fn paths_as_osi(reader: Reader<Paths>, container: Container, out: &Path) -> Result<(), Failure> {
    let header = reader.header().clone();
    files::write_with(out, |stream| {
        let mut trace = SensorViewTrace::create(stream, container)?;
        for frame in progress::frames(reader) {
            trace.paths(&header, &frame.map_err(Error::other)?)?;
        }
        trace.finish()
    })
}

fn points_as_ros(reader: Reader<Points>, out: &Path) -> Result<(), Failure> {
    let header = reader.header().clone();
    files::write_with(out, |stream| {
        let mut recording = RosRecording::create(stream)?;
        for frame in progress::frames(reader) {
            recording.points(&header, &frame.map_err(Error::other)?)?;
        }
        recording.finish()
    })
}

fn tracks_as_ros(reader: Reader<Tracks>, out: &Path) -> Result<(), Failure> {
    files::write_with(out, |stream| {
        let mut recording = RosRecording::create(stream)?;
        for frame in progress::frames(reader) {
            recording.tracks(&frame.map_err(Error::other)?)?;
        }
        recording.finish()
    })
}

/// Classes of tracks, from the summary of the run that made the tracks.
struct Classes {
    /// The summary that lies beside the tracks, if any.
    summary: Option<Summary>,
}

impl Classes {
    /// Reads the classes from `summary.json` in the folder of a file of tracks.
    fn beside(file: &Path) -> Result<Self, Failure> {
        let summary = file.with_file_name("summary.json");
        let summary = summary.is_file().then(|| Summary::read(&summary)).transpose()?;
        Ok(Self { summary })
    }

    /// Probabilities of the four classes of a frame's tracks, if known: of tracks in the same place, as the
    /// summary may be that of another run.
    fn of(&self, frame: &TracksFrame) -> BTreeMap<u32, [f64; 4]> {
        let told = self.summary.as_ref().and_then(|summary| summary.frames.get(frame.index as usize));
        let told = told.filter(|told| told.time_s == frame.time_s);
        let is_same = |told: &&TrackSummary| {
            frame.tracks.iter().any(|own| own.id == told.id && own.position_m == [told.x_m, told.y_m])
        };
        let tracks = told.into_iter().flat_map(|told| &told.tracks).filter(is_same);
        tracks.filter_map(|track| Some((track.id, probabilities(track)?))).collect()
    }
}

fn probabilities(track: &TrackSummary) -> Option<[f64; 4]> {
    let told = &track.probabilities;
    Some([told.car?, told.bus?, told.truck?, told.motorcycle?])
}
