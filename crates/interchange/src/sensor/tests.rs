//! Messages hold what the artifact holds, in the sensor's axes.

use super::*;
use crate::osi::sensor_data::RadarDetection;
use artifact::cube::CubeHeader;
use artifact::points::{Height, Point};
use artifact::tracks::{Footprint, Track, TrackState};
use prost::Message;
use std::f64::consts::FRAC_PI_2;

fn point(azimuth_rad: f64, elevation_rad: f64, object: Option<u32>) -> Point {
    Point {
        range_m: 40.0,
        radial_velocity_mps: -3.0,
        azimuth_rad,
        elevation_rad,
        height: Height::Assumed,
        position_m: [0.0; 3],
        snr_db: 20.0,
        two_ways_rad: None,
        stationary: None,
        object,
        target: None,
        label: None,
    }
}

/// The message of a `.osi` trace with one.
fn only<M: Message + Default>(bytes: &[u8]) -> M {
    let (length, message) = bytes.split_at(4);
    assert_eq!(u32::from_le_bytes(length.try_into().unwrap()) as usize, message.len());
    M::decode(message).unwrap()
}

fn detections(cube: Option<CubeHeader>, points: Vec<Point>) -> Vec<RadarDetection> {
    let header = PointsHeader { cube, ..PointsHeader::default() };
    let frame = PointsFrame { index: 3, time_s: 0.25, points, objects: vec![] };
    let mut bytes = vec![];
    let mut trace = SensorDataTrace::create(&mut bytes, Container::Osi).unwrap();
    trace.points(&header, &frame).unwrap();
    trace.finish().unwrap();
    let data: SensorData = only(&bytes);
    assert_eq!(data.timestamp.unwrap().nanos, Some(250_000_000));
    let of_radar = &data.feature_data.unwrap().radar_sensor[0];
    assert_eq!(of_radar.header.as_ref().unwrap().number_of_valid_detections, Some(2));
    of_radar.detection.clone()
}

#[test]
fn a_point_to_the_right_of_north_has_a_negative_azimuth_and_a_lone_one_no_object() {
    let [right, up]: [RadarDetection; 2] =
        detections(None, vec![point(0.5, 0.0, None), point(0.0, 0.2, Some(4))]).try_into().unwrap();
    let place = right.position.unwrap();
    assert_eq!(place.distance, Some(40.0));
    assert!((place.azimuth.unwrap() + 0.5).abs() < 1e-12);
    assert!((up.position.unwrap().elevation.unwrap() - 0.2).abs() < 1e-12);
    assert_eq!(right.object_id.unwrap().value, Some(u64::MAX));
    assert_eq!(up.object_id.unwrap().value, Some(4));
    assert_eq!((right.radial_velocity, right.snr), (Some(-3.0), Some(20.0)));
    // Points from elsewhere carry no radar, whose errors are not known then.
    assert_eq!((right.position_rmse, right.existence_probability, right.rcs), (None, None, None));
}

#[test]
fn believed_tracks_are_objects_with_their_errors_and_classes() {
    let footprint = Footprint { centre_m: [1.0, 30.0], length_m: 12.0, width_m: 2.5, heading_rad: FRAC_PI_2 };
    let mut covariance = [[0.0; 4]; 4];
    (0..4).for_each(|i| covariance[i][i] = 0.25);
    let track = |id, state| Track {
        id,
        state,
        age_frames: 4,
        missed_frames: 0,
        position_m: [1.0, 29.0],
        velocity_mps: [0.0, 7.0],
        covariance,
        velocity_resolved: true,
        lane: None,
        footprint,
        objects: vec![],
    };
    let tracks = vec![track(0, TrackState::Tentative), track(1, TrackState::Coasting)];
    let mut bytes = vec![];
    let mut trace = SensorDataTrace::create(&mut bytes, Container::Osi).unwrap();
    let classes = BTreeMap::from([(1, [0.1, 0.6, 0.2, 0.1])]);
    let frame = TracksFrame { index: 0, time_s: 1.0, tracks };
    trace.tracks(&TracksHeader::default(), &frame, &classes).unwrap();
    trace.finish().unwrap();
    let data: SensorData = only(&bytes);
    let [object] = data.moving_object.as_slice() else { panic!("{data:?}") };
    assert_eq!(object.header.as_ref().unwrap().measurement_state, Some(3));
    assert_eq!(object.base_rmse.as_ref().unwrap().position.unwrap().x, Some(0.5));
    let told: Vec<(i32, f64)> = object
        .candidate
        .iter()
        .map(|c| (c.vehicle_classification.unwrap().kind.unwrap(), c.probability.unwrap()))
        .collect();
    assert_eq!(told, [(4, 0.1), (12, 0.6), (7, 0.2), (10, 0.1)]);
}

#[test]
fn equal_frames_give_equal_bytes_in_mcap() {
    let written = || {
        let mut bytes = vec![];
        let mut trace = SensorDataTrace::create(&mut bytes, Container::Mcap).unwrap();
        let frame =
            PointsFrame { index: 0, time_s: 0.5, points: vec![point(0.1, 0.0, None)], objects: vec![] };
        trace.points(&PointsHeader::default(), &frame).unwrap();
        trace.finish().unwrap();
        bytes
    };
    assert_eq!(written(), written());
    assert!(written().windows(15).any(|bytes| bytes == b"osi3.SensorData"));
}
