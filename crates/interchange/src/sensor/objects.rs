//! Tracks as `osi3.DetectedMovingObject`.

use crate::measured::box_covariance::middle_covariance;
use crate::osi::common::{BaseMoving, Dimension3d, Identifier, Orientation3d, Timestamp, Vector3d};
use crate::osi::moving_object::{VehicleClassification, object_type};
use crate::osi::sensor_data::{
    AVAILABLE, CandidateMovingObject, DetectedEntityHeader, DetectedItemHeader, DetectedMovingObject,
    REFERENCE_CENTER, measurement_state,
};
use artifact::Radar;
use artifact::settings::Class;
use artifact::tracks::{Track, TrackState, TracksFrame};
use std::collections::BTreeMap;

/// The header of all objects of a frame.
pub(crate) fn header(radar: Option<&Radar>, frame: &TracksFrame) -> DetectedEntityHeader {
    let measured_at_s = frame.time_s + radar.map_or(0.0, Radar::frame_middle_s);
    DetectedEntityHeader {
        measurement_time: Some(Timestamp::at(measured_at_s)),
        cycle_counter: Some(u64::from(frame.index)),
        data_qualifier: Some(AVAILABLE),
    }
}

/// Time at which each track was first seen.
#[derive(Default)]
pub(crate) struct FirstSeenTimes {
    by_track: BTreeMap<u32, f64>,
}

impl FirstSeenTimes {
    /// Objects of a frame by the sensor with that number, in the order of its tracks.
    pub(crate) fn objects(
        &mut self,
        sensor: u64,
        frame: &TracksFrame,
        classes: &BTreeMap<u32, [f64; 4]>,
    ) -> Vec<DetectedMovingObject> {
        for track in &frame.tracks {
            self.by_track.entry(track.id).or_insert(frame.time_s);
        }
        let believed = frame.tracks.iter().filter(|track| track.state != TrackState::Tentative);
        let objects = believed.map(|track| {
            let born_s = self.by_track.get(&track.id).copied().unwrap_or(frame.time_s);
            object(sensor, track, frame.time_s - born_s, classes.get(&track.id))
        });
        objects.collect()
    }
}

fn object(sensor: u64, track: &Track, age_s: f64, classes: Option<&[f64; 4]>) -> DetectedMovingObject {
    let state = match track.state {
        TrackState::Coasting => measurement_state::PREDICTED,
        TrackState::Tentative | TrackState::Confirmed => measurement_state::MEASURED,
    };
    let header = DetectedItemHeader {
        tracking_id: Identifier::of(u64::from(track.id)),
        age: Some(age_s),
        measurement_state: Some(state),
        sensor_id: Identifier::of(sensor).into_iter().collect(),
    };
    let deviation = |variance: f64| variance.max(0.0).sqrt();
    let middle = middle_covariance(track);
    let base_rmse = BaseMoving {
        position: Vector3d::flat([deviation(middle[0][0]), deviation(middle[1][1])]),
        velocity: Vector3d::flat([deviation(track.covariance[2][2]), deviation(track.covariance[3][3])]),
        ..BaseMoving::default()
    };
    DetectedMovingObject {
        header: Some(header),
        base: Some(base(track)),
        base_rmse: Some(base_rmse),
        reference_point: Some(REFERENCE_CENTER),
        candidate: classes.map_or_else(Vec::new, candidates),
    }
}

fn base(track: &Track) -> BaseMoving {
    let footprint = &track.footprint;
    BaseMoving {
        dimension: Some(Dimension3d {
            length: Some(footprint.length_m),
            width: Some(footprint.width_m),
            height: None,
        }),
        position: Vector3d::flat(footprint.centre_m),
        orientation: Some(Orientation3d { yaw: Some(footprint.heading_rad), ..Orientation3d::default() }),
        velocity: Vector3d::flat(track.velocity_mps),
    }
}

/// A candidate for each class.
fn candidates(probabilities: &[f64; 4]) -> Vec<CandidateMovingObject> {
    let of = |(class, probability): (Class, &f64)| CandidateMovingObject {
        probability: Some(*probability),
        kind: Some(object_type::VEHICLE),
        vehicle_classification: Some(VehicleClassification { kind: Some(vehicle_type(class)) }),
    };
    Class::ALL.into_iter().zip(probabilities).map(of).collect()
}

/// Value of `osi3.MovingObject.VehicleClassification.Type` for a class.
fn vehicle_type(class: Class) -> i32 {
    match class {
        Class::Car => 4,
        Class::Bus => 12,
        Class::Truck => 7,
        Class::Motorcycle => 10,
    }
}
