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
    pub(crate) const OTHER: i32 = 1;
    pub(crate) const VEHICLE: i32 = 2;
    pub(crate) const PEDESTRIAN: i32 = 3;
    pub(crate) const ANIMAL: i32 = 4;
}

/// Names of `osi3.MovingObject.VehicleClassification.Type` by value; the newer of two names.
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

/// Earlier names of the same values, each with the present one.
const EARLIER_NAMES: [(&str, &str); 3] = [
    ("TYPE_CAR", "TYPE_MEDIUM_CAR"),
    ("TYPE_DELIVERY_VAN", "TYPE_VAN"),
    ("TYPE_MOTORBIKE", "TYPE_MOTORCYCLE"),
];
/// Names of `osi3.MovingObject.Type` that are not in the classification of vehicles.
const OBJECT_TYPES: [&str; 3] = [VEHICLE, PEDESTRIAN, ANIMAL];
const VEHICLE: &str = "TYPE_VEHICLE";
const PEDESTRIAN: &str = "TYPE_PEDESTRIAN";
const ANIMAL: &str = "TYPE_ANIMAL";

impl MovingObject {
    /// Most specific name of the type: for a vehicle that of its classification.
    pub(crate) fn type_name(&self) -> String {
        let classified = self.vehicle_classification.and_then(|told| told.kind).unwrap_or(0);
        match (self.kind.unwrap_or(0), classified) {
            (object_type::PEDESTRIAN, _) => PEDESTRIAN.into(),
            (object_type::ANIMAL, _) => ANIMAL.into(),
            (object_type::VEHICLE, 0) => VEHICLE.into(),
            (object_type::OTHER, 0) => vehicle_type(1),
            _ => vehicle_type(classified),
        }
    }
}

/// Names of types of moving objects.
pub fn type_names() -> impl Iterator<Item = &'static str> {
    VEHICLE_TYPES.into_iter().chain(OBJECT_TYPES)
}

/// The name used for objects of a type, from any of the standard's names for it, or from `TYPE_` and its
/// value; `None` if the standard has no such type.
pub fn canonical_type_name(name: &str) -> Option<String> {
    if let Some((_, told)) = EARLIER_NAMES.iter().find(|(earlier, _)| *earlier == name) {
        return Some((*told).to_owned());
    }
    let of_value = || {
        let value: i32 = name.strip_prefix("TYPE_")?.parse().ok()?;
        (value >= 0).then(|| vehicle_type(value))
    };
    type_names().find(|known| *known == name).map(str::to_owned).or_else(of_value)
}

fn vehicle_type(value: i32) -> String {
    let known = usize::try_from(value).ok().and_then(|place| VEHICLE_TYPES.get(place));
    known.map_or_else(|| format!("TYPE_{value}"), |name| (*name).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_of_the_standard_is_that_by_which_its_objects_are_told() {
        for (value, name) in (0..).zip(VEHICLE_TYPES) {
            let classified = Some(VehicleClassification { kind: Some(value) });
            let object = MovingObject { vehicle_classification: classified, ..MovingObject::default() };
            assert_eq!(object.type_name(), name);
            assert_eq!(canonical_type_name(name).as_deref(), Some(name));
            assert_eq!(canonical_type_name(&format!("TYPE_{value}")).as_deref(), Some(name));
        }
        for (kind, name) in
            [(1, "TYPE_OTHER"), (2, "TYPE_VEHICLE"), (3, "TYPE_PEDESTRIAN"), (4, "TYPE_ANIMAL")]
        {
            assert_eq!(MovingObject { kind: Some(kind), ..MovingObject::default() }.type_name(), name);
            assert_eq!(canonical_type_name(name).as_deref(), Some(name));
        }
        // osi_object.proto: both names of a value are the same number.
        for (name, value) in [("TYPE_CAR", 4), ("TYPE_DELIVERY_VAN", 6), ("TYPE_MOTORBIKE", 10)] {
            assert_eq!(canonical_type_name(name), Some(vehicle_type(value)));
        }
        assert_eq!(canonical_type_name("TYPE_99").as_deref(), Some("TYPE_99"));
        for name in ["TYPE_LORRY", "type_bus", "TYPE_", "TYPE_-1", "bus"] {
            assert_eq!(canonical_type_name(name), None, "{name}");
        }
    }
}
