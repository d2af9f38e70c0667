//! Moving objects of a ground truth, and their types.

use crate::osi::common::{BaseMoving, Identifier};
use prost::Message;

/// `osi3.MovingObject`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct MovingObject {
    #[prost(message, optional, tag = "1")]
    pub(crate) id: Option<Identifier>,
    #[prost(message, optional, tag = "2")]
    pub(crate) base: Option<BaseMoving>,
    /// `osi3.MovingObject.Type`.
    #[prost(int32, optional, tag = "3")]
    pub(crate) kind: Option<i32>,
    #[prost(message, optional, tag = "6")]
    pub(crate) vehicle_classification: Option<VehicleClassification>,
}

/// `osi3.MovingObject.VehicleClassification`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct VehicleClassification {
    /// `osi3.MovingObject.VehicleClassification.Type`.
    #[prost(int32, optional, tag = "1")]
    pub(crate) kind: Option<i32>,
}

/// Values of `osi3.MovingObject.Type`.
pub(crate) mod object_type {
    pub(crate) const VEHICLE: i32 = 2;
    pub(crate) const PEDESTRIAN: i32 = 3;
    pub(crate) const ANIMAL: i32 = 4;
}

/// Names of `osi3.MovingObject.VehicleClassification.Type` by their values; of two names the newer.
const VEHICLE_TYPES: [&str; 23] = [
    "TYPE_UNKNOWN",
    "TYPE_OTHER",
    "TYPE_SMALL_CAR",
    "TYPE_COMPACT_CAR",
    "TYPE_MEDIUM_CAR",
    "TYPE_LUXURY_CAR",
    "TYPE_VAN",
    "TYPE_HEAVY_TRUCK",
    "TYPE_SEMITRAILER",
    "TYPE_TRAILER",
    "TYPE_MOTORCYCLE",
    "TYPE_BICYCLE",
    "TYPE_BUS",
    "TYPE_TRAM",
    "TYPE_TRAIN",
    "TYPE_WHEELCHAIR",
    "TYPE_SEMITRACTOR",
    "TYPE_STANDUP_SCOOTER",
    "TYPE_MICROMOBILITY_DEVICE",
    "TYPE_WORK_MACHINE",
    "TYPE_WATERCRAFT",
    "TYPE_AIRCRAFT",
    "TYPE_LAND_VEHICLE",
];

impl MovingObject {
    /// Name of the type that tells most: of a vehicle the one that classifies it.
    pub(crate) fn type_name(&self) -> String {
        match self.kind.unwrap_or(0) {
            object_type::PEDESTRIAN => "TYPE_PEDESTRIAN".into(),
            object_type::ANIMAL => "TYPE_ANIMAL".into(),
            _ => vehicle_type(self.vehicle_classification.and_then(|told| told.kind).unwrap_or(0)),
        }
    }
}

fn vehicle_type(value: i32) -> String {
    let known = usize::try_from(value).ok().and_then(|place| VEHICLE_TYPES.get(place));
    known.map_or_else(|| format!("TYPE_{value}"), |name| (*name).to_owned())
}
