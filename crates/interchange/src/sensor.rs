//! A radar's output in OSI: detections and objects as `SensorData`, paths as `SensorView`.
//!
//! A roadside radar has no host vehicle. Its mounting position and its detected objects are given in the
//! world's axes: the frame of the host vehicle is that of the world.

mod mounting;
mod detections;
mod objects;
mod reflections;

use crate::osi::common::{Identifier, Timestamp, version};
use crate::osi::descriptors;
use crate::osi::sensor_data::SensorData;
use crate::osi::sensor_view::SensorView;
use crate::trace::{Container, MessageKind, TraceWriter};
use artifact::Radar;
use artifact::paths::{PathsFrame, PathsHeader};
use artifact::points::{PointsFrame, PointsHeader};
use artifact::tracks::{TracksFrame, TracksHeader};
use mounting::{mounting, number};
use objects::FirstSeenTimes;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// A trace of `osi3.SensorData`.
pub struct SensorDataTrace<W: Write> {
    file: TraceWriter<W>,
    first_seen: FirstSeenTimes,
}

impl<W: Write> SensorDataTrace<W> {
    /// Begins a trace.
    ///
    /// # Errors
    /// The sink fails.
    pub fn create(sink: W, container: Container) -> io::Result<Self> {
        let kind = MessageKind {
            schema: "osi3.SensorData",
            topic: "SensorData",
            descriptor: descriptors::sensor_data,
        };
        Ok(Self { file: TraceWriter::begin(sink, container, &kind)?, first_seen: FirstSeenTimes::default() })
    }

    /// Writes the points of a frame as radar detections.
    ///
    /// # Errors
    /// The sink fails.
    pub fn points(&mut self, header: &PointsHeader, frame: &PointsFrame) -> io::Result<()> {
        let sensor = number(header.cube.as_ref().map(|cube| &cube.radar));
        let cube = header.cube.as_ref().map(|cube| cube.in_frame(frame.index));
        let radar = cube.as_ref().map(|cube| &cube.radar);
        let feature_data = Some(detections::feature_data(sensor, cube.as_ref(), frame));
        let data = SensorData { feature_data, ..head(sensor, radar, frame.time_s) };
        self.file.write(frame.time_s, &data)
    }

    /// Writes the confirmed and coasting tracks of a frame as detected moving objects; `classes` has the
    /// probabilities of the four classes, in their order, for tracks with a known class.
    ///
    /// # Errors
    /// The sink fails.
    pub fn tracks(
        &mut self,
        header: &TracksHeader,
        frame: &TracksFrame,
        classes: &BTreeMap<u32, [f64; 4]>,
    ) -> io::Result<()> {
        let sensor = number(header.cube.as_ref().map(|cube| &cube.radar));
        let radar = header.cube.as_ref().map(|cube| cube.radar.in_frame(frame.index));
        let moving_object_header = Some(objects::header(radar.as_ref(), frame));
        let moving_object = self.first_seen.objects(sensor, frame, classes);
        let data =
            SensorData { moving_object_header, moving_object, ..head(sensor, radar.as_ref(), frame.time_s) };
        self.file.write(frame.time_s, &data)
    }

    /// Writes the end of the file.
    ///
    /// # Errors
    /// The sink fails.
    pub fn finish(self) -> io::Result<()> {
        self.file.finish()
    }
}

/// A trace of `osi3.SensorView`.
pub struct SensorViewTrace<W: Write> {
    file: TraceWriter<W>,
}

impl<W: Write> SensorViewTrace<W> {
    /// Begins a trace.
    ///
    /// # Errors
    /// The sink fails.
    pub fn create(sink: W, container: Container) -> io::Result<Self> {
        let kind = MessageKind {
            schema: "osi3.SensorView",
            topic: "SensorView",
            descriptor: descriptors::sensor_view,
        };
        Ok(Self { file: TraceWriter::begin(sink, container, &kind)? })
    }

    /// Writes the paths of a frame as reflections.
    ///
    /// # Errors
    /// The sink fails.
    pub fn paths(&mut self, header: &PathsHeader, frame: &PathsFrame) -> io::Result<()> {
        let (sensor, radar) = (number(Some(&header.radar)), header.radar.in_frame(frame.index));
        let view = SensorView {
            version: version(),
            timestamp: Some(Timestamp::at(frame.time_s)),
            sensor_id: Identifier::of(sensor),
            mounting_position: Some(mounting(&radar)),
            radar_sensor_view: vec![reflections::radar_view(
                sensor,
                &radar,
                header.centre_frequency_hz,
                frame,
            )],
        };
        self.file.write(frame.time_s, &view)
    }

    /// Writes the end of the file.
    ///
    /// # Errors
    /// The sink fails.
    pub fn finish(self) -> io::Result<()> {
        self.file.finish()
    }
}

/// Fields common to all `SensorData`.
fn head(sensor: u64, radar: Option<&Radar>, time_s: f64) -> SensorData {
    let measured_at_s = time_s + radar.map_or(0.0, Radar::frame_middle_s);
    SensorData {
        version: version(),
        timestamp: Some(Timestamp::at(time_s)),
        sensor_id: Identifier::of(sensor),
        mounting_position: radar.map(mounting),
        last_measurement_time: Some(Timestamp::at(measured_at_s)),
        ..SensorData::default()
    }
}

#[cfg(test)]
mod tests;
