//! Messages that other programs speak, and the files that hold them: ASAM OSI 3.8 as `.osi` and MCAP, ROS 2
//! as MCAP, tables as Parquet. A leaf beside `artifact` and `radar`: artifacts go in and messages come out;
//! messages go in and plain records of traffic come out.
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
//! Rooms, to read in this order: `osi` has the messages as their fields go over the wire, and what tells
//! others of them; `trace` the files; `measured` what a radar's numbers are in a sensor's own axes, with
//! their standard errors; `traffic` reads ground truth, `sensor` writes what was detected and what was
//! traced, `ros` points and tracks as ROS 2 has them; `table` rows of anything as Apache Parquet.

mod osi; // messages of OSI, field by field
mod trace; // files of messages
mod measured; // a radar's numbers in a sensor's axes
pub mod traffic; // ground truth read as traffic
mod sensor; // detections and reflections written
mod ros; // points and tracks written
pub mod parquet_table; // rows as Parquet

pub use ros::RosRecording;
pub use sensor::{SensorDataTrace, SensorViewTrace};
pub use trace::Container;
