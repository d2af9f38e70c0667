//! Messages for other programs, and the files that hold them: ASAM OSI 3.8 as `.osi` and MCAP, ROS 2 and
//! Foxglove as MCAP, tables as Parquet. A leaf crate that depends on `artifact` and `radar`: artifacts are
//! converted to messages, and messages to plain records of traffic.
//!
//! ```
//! use interchange::{Container, SensorDataTrace};
//! let mut file = Vec::new();
//! let header = artifact::points::PointsHeader::default();
//! let mut trace = SensorDataTrace::create(&mut file, Container::Osi)?;
//! let frame = artifact::points::PointsFrame { index: 0, time_s: 0.5, points: vec![], objects: vec![] };
//! trace.points(&header, &frame)?;
//! trace.finish()?;
//! // A length, then the message.
//! let length = u32::from_le_bytes([file[0], file[1], file[2], file[3]]);
//! assert_eq!(file.len(), 4 + length as usize);
//! # Ok::<(), std::io::Error>(())
//! ```
//!
//! Read the rooms in this order: `descriptors` makes definitions for readers of a file; `osi` defines the
//! messages as encoded on the wire, `trace` the files; `measured` converts a radar's measurements to a
//! sensor's own axes, with standard errors; `traffic` reads ground truth, `sensor` writes detections and
//! traced paths, `ros` points and tracks for ROS 2, `foxglove` points for Foxglove; `parquet_table` writes
//! rows of any kind as Apache Parquet.

mod descriptors; // definitions of messages for readers of a file
mod osi; // messages of OSI, field by field
mod trace; // files of messages
mod measured; // a radar's measurements in a sensor's axes
pub mod traffic; // ground truth read as traffic
mod sensor; // detections and reflections written
mod ros; // points and tracks written
mod foxglove; // points written for Foxglove
pub mod parquet_table; // rows as Parquet

pub use foxglove::FoxgloveRecording;
pub use ros::RosRecording;
pub use sensor::{SensorDataTrace, SensorViewTrace};
pub use trace::Container;
