//! Points as rows of 32-bit numbers, for clouds of any message: x, y, z in world metres, radial velocity in
//! m/s (positive when the range grows), signal-to-noise ratio in dB, the object's number (−1 without one),
//! and 1 if z is measured, 0 if it is assumed or the radar's own.

use artifact::points::{Height, Point, PointsFrame};

/// Type of a number of a row, little-endian.
#[derive(Clone, Copy)]
pub(crate) enum Number {
    Float32,
    Int32,
    Uint32,
}

/// Names and types of the numbers of a row.
pub(crate) const FIELDS: [(&str, Number); 7] = [
    ("x", Number::Float32),
    ("y", Number::Float32),
    ("z", Number::Float32),
    ("velocity", Number::Float32),
    ("snr", Number::Float32),
    ("object", Number::Int32),
    ("height_measured", Number::Uint32),
];
pub(crate) const FIELD_BYTES: usize = 4;
pub(crate) const POINT_BYTES: usize = FIELD_BYTES * FIELDS.len();

/// Rows of a frame's points, one after the other.
pub(crate) fn packed(frame: &PointsFrame) -> Vec<u8> {
    frame.points.iter().flat_map(row).collect()
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
