//! Points as `sensor_msgs/PointCloud2`: x, y, z in world metres, radial velocity in m/s (positive where the
//! range grows), signal-to-noise ratio in dB, and the object's number (−1 without one).

use crate::ros::cdr::Cdr;
use crate::ros::frames::WORLD;
use artifact::points::{Point, PointsFrame};

/// Names of the fields with the standard's number of their type: 7 is a 32-bit float, 5 a 32-bit integer.
const FIELDS: [(&str, u8); 6] = [("x", 7), ("y", 7), ("z", 7), ("velocity", 7), ("snr", 7), ("object", 5)];
const FIELD_BYTES: usize = 4;
const POINT_BYTES: usize = FIELD_BYTES * FIELDS.len();

/// The cloud of a frame.
pub(crate) fn message(frame: &PointsFrame) -> Vec<u8> {
    let mut message = Cdr::stamped(frame.time_s, WORLD);
    let count = frame.points.len();
    message.count(1);
    message.count(count);
    message.count(FIELDS.len());
    for (place, (name, kind)) in FIELDS.iter().enumerate() {
        message.text(name);
        message.count(place * FIELD_BYTES);
        message.put([*kind]);
        message.count(1);
    }
    message.put([0]); // little-endian
    message.count(POINT_BYTES);
    message.count(POINT_BYTES * count);
    message.count(POINT_BYTES * count);
    frame.points.iter().for_each(|point| message.raw(&row(point)));
    message.put([1]); // no value is missing
    message.finish()
}

fn row(point: &Point) -> Vec<u8> {
    let [x, y, z] = point.position_m;
    let object = point.object.map_or(-1, |object| object as i32);
    let floats = [x, y, z, point.radial_velocity_mps, point.snr_db];
    floats.iter().flat_map(|value| (*value as f32).to_le_bytes()).chain(object.to_le_bytes()).collect()
}
