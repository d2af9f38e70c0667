//! Points and tracks for ROS 2, in MCAP: `sensor_msgs/PointCloud2` and `radar_msgs/RadarScan` for points,
//! `radar_msgs/RadarTracks` for tracks. Messages are encoded in CDR; their definitions are in the file, so
//! that readers need no ROS.

mod cdr;
mod definitions;
mod point_cloud;
mod radar_scan;
mod radar_tracks;

use crate::trace::{ChannelDefinition, McapFile};
use artifact::points::{PointsFrame, PointsHeader};
use artifact::tracks::TracksFrame;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// A recording being written. Channels begin with their first message.
pub struct RosRecording<W: Write> {
    file: McapFile<W>,
    channels: BTreeMap<&'static str, u16>,
}

impl<W: Write> RosRecording<W> {
    /// Begins a recording.
    ///
    /// # Errors
    /// The sink fails.
    pub fn create(sink: W) -> io::Result<Self> {
        Ok(Self { file: McapFile::begin(sink, "ros2")?, channels: BTreeMap::new() })
    }

    /// Writes the points of a frame: a cloud in world coordinates and a scan in the sensor's.
    ///
    /// # Errors
    /// The sink fails.
    pub fn points(&mut self, header: &PointsHeader, frame: &PointsFrame) -> io::Result<()> {
        let cloud = point_cloud::message(frame);
        self.write("/radar/points", definitions::POINT_CLOUD, frame.time_s, &cloud)?;
        let radar = header.cube.as_ref().map(|cube| &cube.radar);
        let scan = radar_scan::message(radar, frame);
        self.write("/radar/scan", definitions::RADAR_SCAN, frame.time_s, &scan)
    }

    /// Writes the confirmed and coasting tracks of a frame.
    ///
    /// # Errors
    /// The sink fails.
    pub fn tracks(&mut self, frame: &TracksFrame) -> io::Result<()> {
        let tracks = radar_tracks::message(frame);
        self.write("/radar/tracks", definitions::RADAR_TRACKS, frame.time_s, &tracks)
    }

    /// Writes the indexes and the end of the file.
    ///
    /// # Errors
    /// The sink fails.
    pub fn finish(self) -> io::Result<()> {
        self.file.finish()
    }

    fn write(
        &mut self,
        topic: &'static str,
        [schema, definition]: [&str; 2],
        time_s: f64,
        message: &[u8],
    ) -> io::Result<()> {
        let channel = match self.channels.get(topic) {
            Some(channel) => *channel,
            None => {
                let channel = self.file.channel(&ChannelDefinition {
                    topic,
                    schema,
                    schema_encoding: "ros2msg",
                    definition: definition.as_bytes(),
                    message_encoding: "cdr",
                    metadata: BTreeMap::new(),
                })?;
                self.channels.insert(topic, channel);
                channel
            }
        };
        self.file.write(channel, time_s, message)
    }
}
