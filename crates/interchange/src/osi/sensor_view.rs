//! Reflections at a sensor, before detection.

use crate::osi::common::{Identifier, InterfaceVersion, MountingPosition, Timestamp};
use prost::Message;

/// `osi3.SensorView`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct SensorView {
    #[prost(message, optional, tag = "1")]
    pub(crate) version: Option<InterfaceVersion>,
    #[prost(message, optional, tag = "2")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(message, optional, tag = "3")]
    pub(crate) sensor_id: Option<Identifier>,
    #[prost(message, optional, tag = "4")]
    pub(crate) mounting_position: Option<MountingPosition>,
    #[prost(message, repeated, tag = "1001")]
    pub(crate) radar_sensor_view: Vec<RadarSensorView>,
}

/// `osi3.RadarSensorView`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct RadarSensorView {
    #[prost(message, optional, tag = "1")]
    pub(crate) view_configuration: Option<RadarSensorViewConfiguration>,
    #[prost(message, repeated, tag = "2")]
    pub(crate) reflection: Vec<Reflection>,
}

/// `osi3.RadarSensorViewConfiguration`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct RadarSensorViewConfiguration {
    #[prost(message, optional, tag = "1")]
    pub(crate) sensor_id: Option<Identifier>,
    #[prost(message, optional, tag = "2")]
    pub(crate) mounting_position: Option<MountingPosition>,
    #[prost(double, optional, tag = "9")]
    pub(crate) emitter_frequency: Option<f64>,
}

/// `osi3.RadarSensorView.Reflection`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Reflection {
    #[prost(double, optional, tag = "1")]
    pub(crate) signal_strength: Option<f64>,
    #[prost(double, optional, tag = "2")]
    pub(crate) time_of_flight: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub(crate) doppler_shift: Option<f64>,
    #[prost(double, optional, tag = "4")]
    pub(crate) source_horizontal_angle: Option<f64>,
    #[prost(double, optional, tag = "5")]
    pub(crate) source_vertical_angle: Option<f64>,
}
