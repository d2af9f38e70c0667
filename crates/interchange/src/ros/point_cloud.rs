//! Points as `sensor_msgs/PointCloud2`: x, y, z in world metres, radial velocity in m/s (positive when the
//! range grows), signal-to-noise ratio in dB, the object's number (−1 without one), and 1 if z is measured, 0
//! if it is assumed or the radar's own.

use crate::ros::cdr::Cdr;
use crate::ros::frames::WORLD;
use artifact::points::{Height, Point, PointsFrame};

/// Names of the fields with the standard's numbers of their types: 7 is a 32-bit float, 5 a 32-bit integer, 6
/// an unsigned one.
const FIELDS: [(&str, u8); 7] =
    [("x", 7), ("y", 7), ("z", 7), ("velocity", 7), ("snr", 7), ("object", 5), ("height_measured", 6)];
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
    let measured = u32::from(point.height == Height::Measured);
    let numbers = floats.iter().flat_map(|value| (*value as f32).to_le_bytes());
    numbers.chain(object.to_le_bytes()).chain(measured.to_le_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_says_whether_its_height_is_measured() {
        for (height, measured) in [(Height::Measured, 1), (Height::Assumed, 0), (Height::None, 0)] {
            let point = Point {
                range_m: 40.0,
                radial_velocity_mps: -3.0,
                azimuth_rad: 0.0,
                elevation_rad: 0.0,
                height,
                position_m: [0.0, 40.0, 0.75],
                snr_db: 20.0,
                two_ways_rad: None,
                stationary: None,
                object: None,
                target: None,
                label: None,
            };
            let row = row(&point);
            assert_eq!((row.len(), row[POINT_BYTES - FIELD_BYTES..].to_vec()), (28, vec![measured, 0, 0, 0]));
        }
    }
}
