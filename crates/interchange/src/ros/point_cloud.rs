//! Points as `sensor_msgs/PointCloud2` in world coordinates.

use crate::measured::frame_names::WORLD;
use crate::measured::packed_points::{FIELD_BYTES, FIELDS, Number, POINT_BYTES, packed};
use crate::ros::cdr::Cdr;
use artifact::points::PointsFrame;

/// The cloud of a frame.
pub(crate) fn message(frame: &PointsFrame) -> Vec<u8> {
    let mut message = Cdr::stamped(frame.time_s, WORLD);
    let count = frame.points.len();
    message.count(1);
    message.count(count);
    message.count(FIELDS.len());
    for (place, (name, number)) in FIELDS.iter().enumerate() {
        message.text(name);
        message.count(place * FIELD_BYTES);
        message.put([datatype(*number)]);
        message.count(1);
    }
    message.put([0]); // little-endian
    message.count(POINT_BYTES);
    message.count(POINT_BYTES * count);
    message.count(POINT_BYTES * count);
    message.raw(&packed(frame));
    message.put([1]); // no value is missing
    message.finish()
}

/// Value of `sensor_msgs/PointField.datatype`.
fn datatype(number: Number) -> u8 {
    match number {
        Number::Int32 => 5,
        Number::Uint32 => 6,
        Number::Float32 => 7,
    }
}
