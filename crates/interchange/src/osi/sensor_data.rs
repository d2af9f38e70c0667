//! Detections and objects of a sensor.

use crate::osi::common::{
    BaseMoving, Identifier, InterfaceVersion, MountingPosition, Spherical3d, Timestamp,
};
use crate::osi::moving_object::VehicleClassification;
use prost::Message;

/// `osi3.SensorData`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct SensorData {
    #[prost(message, optional, tag = "1")]
    pub(crate) version: Option<InterfaceVersion>,
    #[prost(message, optional, tag = "2")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(message, optional, tag = "5")]
    pub(crate) sensor_id: Option<Identifier>,
    #[prost(message, optional, tag = "6")]
    pub(crate) mounting_position: Option<MountingPosition>,
    #[prost(message, optional, tag = "9")]
    pub(crate) last_measurement_time: Option<Timestamp>,
    #[prost(message, optional, tag = "12")]
    pub(crate) moving_object_header: Option<DetectedEntityHeader>,
    #[prost(message, repeated, tag = "13")]
    pub(crate) moving_object: Vec<DetectedMovingObject>,
    #[prost(message, optional, tag = "26")]
    pub(crate) feature_data: Option<FeatureData>,
}

/// `osi3.DetectedEntityHeader`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct DetectedEntityHeader {
    #[prost(message, optional, tag = "1")]
    pub(crate) measurement_time: Option<Timestamp>,
    #[prost(uint64, optional, tag = "2")]
    pub(crate) cycle_counter: Option<u64>,
    /// `osi3.DetectedEntityHeader.DataQualifier`.
    #[prost(int32, optional, tag = "3")]
    pub(crate) data_qualifier: Option<i32>,
}

/// `DATA_QUALIFIER_AVAILABLE`, of both headers.
pub(crate) const AVAILABLE: i32 = 2;

/// `osi3.FeatureData`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct FeatureData {
    #[prost(message, optional, tag = "1")]
    pub(crate) version: Option<InterfaceVersion>,
    #[prost(message, repeated, tag = "2")]
    pub(crate) radar_sensor: Vec<RadarDetectionData>,
}

/// `osi3.RadarDetectionData`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct RadarDetectionData {
    #[prost(message, optional, tag = "1")]
    pub(crate) header: Option<SensorDetectionHeader>,
    #[prost(message, repeated, tag = "2")]
    pub(crate) detection: Vec<RadarDetection>,
}

/// `osi3.SensorDetectionHeader`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct SensorDetectionHeader {
    #[prost(message, optional, tag = "1")]
    pub(crate) measurement_time: Option<Timestamp>,
    #[prost(uint64, optional, tag = "2")]
    pub(crate) cycle_counter: Option<u64>,
    #[prost(message, optional, tag = "3")]
    pub(crate) mounting_position: Option<MountingPosition>,
    /// `osi3.SensorDetectionHeader.DataQualifier`.
    #[prost(int32, optional, tag = "5")]
    pub(crate) data_qualifier: Option<i32>,
    #[prost(uint32, optional, tag = "6")]
    pub(crate) number_of_valid_detections: Option<u32>,
    #[prost(message, optional, tag = "7")]
    pub(crate) sensor_id: Option<Identifier>,
}

/// `osi3.RadarDetection`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct RadarDetection {
    #[prost(double, optional, tag = "1")]
    pub(crate) existence_probability: Option<f64>,
    #[prost(message, optional, tag = "2")]
    pub(crate) object_id: Option<Identifier>,
    #[prost(message, optional, tag = "3")]
    pub(crate) position: Option<Spherical3d>,
    #[prost(message, optional, tag = "4")]
    pub(crate) position_rmse: Option<Spherical3d>,
    #[prost(double, optional, tag = "5")]
    pub(crate) radial_velocity: Option<f64>,
    #[prost(double, optional, tag = "6")]
    pub(crate) radial_velocity_rmse: Option<f64>,
    #[prost(double, optional, tag = "7")]
    pub(crate) rcs: Option<f64>,
    #[prost(double, optional, tag = "8")]
    pub(crate) snr: Option<f64>,
    #[prost(message, optional, tag = "10")]
    pub(crate) ambiguity_id: Option<Identifier>,
}

/// `osi3.DetectedMovingObject`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct DetectedMovingObject {
    #[prost(message, optional, tag = "1")]
    pub(crate) header: Option<DetectedItemHeader>,
    #[prost(message, optional, tag = "2")]
    pub(crate) base: Option<BaseMoving>,
    #[prost(message, optional, tag = "3")]
    pub(crate) base_rmse: Option<BaseMoving>,
    /// `osi3.DetectedMovingObject.ReferencePoint`.
    #[prost(int32, optional, tag = "4")]
    pub(crate) reference_point: Option<i32>,
    #[prost(message, repeated, tag = "8")]
    pub(crate) candidate: Vec<CandidateMovingObject>,
}

/// `REFERENCE_POINT_CENTER`.
pub(crate) const REFERENCE_CENTER: i32 = 2;

/// `osi3.DetectedItemHeader`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct DetectedItemHeader {
    #[prost(message, optional, tag = "1")]
    pub(crate) tracking_id: Option<Identifier>,
    #[prost(double, optional, tag = "4")]
    pub(crate) age: Option<f64>,
    /// `osi3.DetectedItemHeader.MeasurementState`.
    #[prost(int32, optional, tag = "5")]
    pub(crate) measurement_state: Option<i32>,
    #[prost(message, repeated, tag = "6")]
    pub(crate) sensor_id: Vec<Identifier>,
}

/// Values of `osi3.DetectedItemHeader.MeasurementState`.
pub(crate) mod measurement_state {
    pub(crate) const MEASURED: i32 = 2;
    pub(crate) const PREDICTED: i32 = 3;
}

/// `osi3.DetectedMovingObject.CandidateMovingObject`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct CandidateMovingObject {
    #[prost(double, optional, tag = "1")]
    pub(crate) probability: Option<f64>,
    /// `osi3.MovingObject.Type`.
    #[prost(int32, optional, tag = "2")]
    pub(crate) kind: Option<i32>,
    #[prost(message, optional, tag = "3")]
    pub(crate) vehicle_classification: Option<VehicleClassification>,
}
