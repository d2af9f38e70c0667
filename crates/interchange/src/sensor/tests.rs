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

/// The paper's radar at a place.
fn cube_at(position_m: [f64; 3]) -> CubeHeader {
    let elements = [radar::aperture::row(1, 4.0), radar::aperture::row(4, 1.0)];
    let radar = radar::paper::radar(position_m, radar::paper::waveform(256, 128), elements);
    let dsp = radar::paper::processing();
    CubeHeader { radar, noise: artifact::settings::Noise::Absent, dsp, unit: Default::default() }
}

#[test]
fn a_point_on_the_slope_of_a_stronger_one_errs_by_its_distance_too() {
    let cube = cube_at([0.0, 0.0, 6.0]);
    let cells = [cube.radar.waveform.range_resolution_m(), cube.radar.velocity_resolution_mps()];
    let beside = |cells_away: f64, snr_db: f64| Point {
        range_m: 40.0 + cells_away * cells[0],
        radial_velocity_mps: -3.0 - 1.5 * cells[1],
        snr_db,
        ..point(0.0, 0.0, None)
    };
    let errors = |cells_away, snr_db| {
        let points = vec![point(0.0, 0.0, None), beside(cells_away, snr_db)];
        let seen = detections(Some(cube.clone()), points);
        seen.iter()
            .map(|d| {
                [
                    d.position_rmse.unwrap().distance.unwrap() / cells[0],
                    d.radial_velocity_rmse.unwrap() / cells[1],
                ]
            })
            .collect::<Vec<_>>()
    };
    let alone = (1.0_f64 / 12.0).sqrt();
    // Hann's lobe ends two cells from its peak, and the peak may lie half a cell beside its own.
    let slope = errors(1.9, 12.0);
    assert!((slope[0][0] - alone).abs() < 1e-3 && (slope[0][1] - alone).abs() < 1e-3, "{slope:?}");
    assert!((slope[1][0] - 1.9_f64.hypot(alone)).abs() < 1e-2, "{slope:?}");
    assert!((slope[1][1] - 1.5_f64.hypot(alone)).abs() < 1e-2, "{slope:?}");
    // Beyond the lobe it is an echo of its own, and a stronger one leaves the first on its slope.
    assert!((errors(2.6, 12.0)[1][0] - alone).abs() < 1e-2);
    assert!((errors(1.9, 30.0)[0][0] - 1.9_f64.hypot(alone)).abs() < 1e-2);
}

#[test]
fn radars_in_two_places_have_two_numbers_and_one_radar_has_one_in_all_its_traces() {
    let of_points = |cube: &CubeHeader| {
        let header = PointsHeader { cube: Some(cube.clone()), ..PointsHeader::default() };
        let mut bytes = vec![];
        let mut trace = SensorDataTrace::create(&mut bytes, Container::Osi).unwrap();
        let frame =
            PointsFrame { index: 0, time_s: 0.0, points: vec![point(0.0, 0.0, None)], objects: vec![] };
        trace.points(&header, &frame).unwrap();
        trace.finish().unwrap();
        let data: SensorData = only(&bytes);
        let own = data.sensor_id.unwrap().value.unwrap();
        let of_radar = data.feature_data.unwrap().radar_sensor[0].header.clone().unwrap();
        assert_eq!(of_radar.sensor_id.unwrap().value, Some(own));
        own
    };
    let of_tracks = |cube: &CubeHeader| {
        let mut bytes = vec![];
        let mut trace = SensorDataTrace::create(&mut bytes, Container::Osi).unwrap();
        let frame = TracksFrame { index: 0, time_s: 0.0, tracks: vec![] };
        trace.tracks(&TracksHeader { cube: Some(cube.clone()) }, &frame, &BTreeMap::new()).unwrap();
        trace.finish().unwrap();
        only::<SensorData>(&bytes).sensor_id.unwrap().value.unwrap()
    };
    let [left, right] = [cube_at([-4.0, 0.0, 6.0]), cube_at([4.0, 0.0, 6.0])];
    assert_ne!(of_points(&left), of_points(&right));
    assert_eq!([of_points(&left), of_points(&right)], [of_tracks(&left), of_tracks(&right)]);
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
    // The box is 12 m long: no vehicle of one piece is longer.
    let place = object.base_rmse.as_ref().unwrap().position.unwrap();
    assert_eq!((place.x, place.y), (Some(0.5), Some(0.5)));
    let told: Vec<(i32, f64)> = object
        .candidate
        .iter()
        .map(|c| (c.vehicle_classification.unwrap().kind.unwrap(), c.probability.unwrap()))
        .collect();
    assert_eq!(told, [(4, 0.1), (12, 0.6), (7, 0.2), (10, 0.1)]);
}

#[test]
fn the_middle_of_a_box_of_which_little_was_seen_errs_along_the_heading() {
    let footprint =
        |length_m| Footprint { centre_m: [0.0; 2], length_m, width_m: 2.0, heading_rad: FRAC_PI_2 };
    let track = |length_m| Track {
        id: 0,
        state: TrackState::Confirmed,
        age_frames: 4,
        missed_frames: 0,
        position_m: [0.0; 2],
        velocity_mps: [0.0, 7.0],
        covariance: [[0.0; 4]; 4],
        velocity_resolved: true,
        lane: None,
        footprint: footprint(length_m),
        objects: vec![],
    };
    // The front of a vehicle of every length from 4 to 12 m is seen, and a box of 4 m stands behind it.
    let lengths = (0..8000).map(|i| 4.0 + (f64::from(i) + 0.5) / 1000.0);
    let square_m2 = lengths.map(|length_m: f64| (0.5 * (length_m - 4.0)).powi(2)).sum::<f64>() / 8000.0;
    let [[xx, xy], [_, yy]] = crate::measured::box_covariance::middle_covariance(&track(4.0));
    assert!((yy - square_m2).abs() < 1e-5 && xx < 1e-12 && xy.abs() < 1e-12, "{xx} {xy} {yy} {square_m2}");
    assert!(crate::measured::box_covariance::middle_covariance(&track(15.0))[1][1] < 1e-12);
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
