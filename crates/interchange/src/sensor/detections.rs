//! Points as `osi3.RadarDetection`.

use crate::measured::existence::existence;
use crate::measured::main_lobe::{MainLobeOffset, main_lobe_offsets};
use crate::measured::sensor_axes::SensorAxes;
use crate::measured::standard_errors::standard_errors;
use crate::osi::common::{Identifier, Spherical3d, Timestamp, version};
use crate::osi::sensor_data::{
    AVAILABLE, FeatureData, RadarDetection, RadarDetectionData, SensorDetectionHeader,
};
use crate::sensor::mounting::mounting;
use artifact::Radar;
use artifact::cube::CubeHeader;
use artifact::points::{Point, PointsFrame};
use radar::cross_section::cross_section_dbsm;

/// Detections of a frame by the sensor with that number, in the order of its points.
pub(crate) fn feature_data(sensor: u64, cube: Option<&CubeHeader>, frame: &PointsFrame) -> FeatureData {
    let radar = cube.map(|cube| &cube.radar);
    let measured_at_s = frame.time_s + radar.map_or(0.0, Radar::frame_middle_s);
    let header = SensorDetectionHeader {
        measurement_time: Some(Timestamp::at(measured_at_s)),
        cycle_counter: Some(u64::from(frame.index)),
        mounting_position: radar.map(mounting),
        data_qualifier: Some(AVAILABLE),
        number_of_valid_detections: Some(frame.points.len() as u32),
        sensor_id: Identifier::of(sensor),
    };
    let main_lobe_offsets = cube.map_or_else(
        || vec![MainLobeOffset::default(); frame.points.len()],
        |cube| main_lobe_offsets(cube, &frame.points),
    );
    let detections =
        (0..).zip(main_lobe_offsets).map(|(number, offset)| detection(cube, frame, number, offset));
    let of_radar = RadarDetectionData { header: Some(header), detection: detections.collect() };
    FeatureData { version: version(), radar_sensor: vec![of_radar] }
}

fn detection(
    cube: Option<&CubeHeader>,
    frame: &PointsFrame,
    number: usize,
    offset: MainLobeOffset,
) -> RadarDetection {
    let point = &frame.points[number];
    let axes = cube.map_or_else(SensorAxes::of_world, |cube| SensorAxes::of(&cube.radar));
    let angles = axes.angles_of_world(point.azimuth_rad, point.elevation_rad);
    let errors = cube.map(|cube| standard_errors(&cube.radar, point.snr_db, offset, angles));
    let position_rmse = errors.map(|errors| Spherical3d {
        distance: Some(errors.range_m),
        azimuth: errors.azimuth_rad,
        elevation: errors.elevation_rad,
    });
    RadarDetection {
        existence_probability: cube.map(|cube| existence(&cube.radar, point.snr_db)),
        object_id: Identifier::of(point.object.map_or(Identifier::NONE, u64::from)),
        position: Some(Spherical3d {
            distance: Some(point.range_m),
            azimuth: Some(angles[0]),
            elevation: Some(angles[1]),
        }),
        position_rmse,
        radial_velocity: Some(point.radial_velocity_mps),
        radial_velocity_rmse: errors.map(|errors| errors.velocity_mps),
        rcs: cube.and_then(|cube| cross_section_dbsm(cube, point)),
        snr: Some(point.snr_db),
        ambiguity_id: Identifier::of(ambiguity(frame, number as u64, point)),
    }
}

/// Ambiguity identifier: 0 if the velocity is resolved; else one number for all points of an object, whose
/// velocities are ambiguous together, and one for each single point.
fn ambiguity(frame: &PointsFrame, number: u64, point: &Point) -> u64 {
    match point.object.and_then(|place| Some((place, frame.objects.get(place as usize)?))) {
        Some((_, object)) if object.velocity_resolved => 0,
        Some((place, _)) => 1 + u64::from(place),
        None => 1 + frame.objects.len() as u64 + number,
    }
}
