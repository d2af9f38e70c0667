//! Points as `radar_msgs/RadarScan` in the sensor's axes; the amplitude is the signal-to-noise ratio in dB,
//! and a positive velocity recedes.

use crate::measured::frame_names::SENSOR;
use crate::measured::sensor_axes::SensorAxes;
use crate::ros::cdr::Cdr;
use artifact::Radar;
use artifact::points::PointsFrame;

/// The scan of a frame.
pub(crate) fn message(radar: Option<&Radar>, frame: &PointsFrame) -> Vec<u8> {
    let axes = radar.map_or_else(SensorAxes::of_world, SensorAxes::of);
    let mut message = Cdr::stamped(frame.time_s, SENSOR);
    message.count(frame.points.len());
    for point in &frame.points {
        let [azimuth, elevation] = axes.angles_of_world(point.azimuth_rad, point.elevation_rad);
        message.floats(&[point.range_m, azimuth, elevation, point.radial_velocity_mps, point.snr_db]);
    }
    message.finish()
}
