//! Types of OSI's moving objects, as classes of the project's own vehicles.

use artifact::settings::Class;

/// Stand-in for objects of a type without an entry in `models`.
#[derive(Clone, Copy)]
pub(crate) enum StandIn {
    /// The vehicle of these classes nearest in size; the named one if the size is unknown.
    NearestOf(&'static [Class], &'static str),
    /// No stand-in: the object is ignored.
    Ignored,
}

const CAR: StandIn = StandIn::NearestOf(&[Class::Car], "car-sedan");
const VAN: StandIn = StandIn::NearestOf(&[Class::Car, Class::Truck], "truck-box");
const TRUCK: StandIn = StandIn::NearestOf(&[Class::Truck], "truck-box");
const BUS: StandIn = StandIn::NearestOf(&[Class::Bus], "bus-city");
const MOTORCYCLE: StandIn = StandIn::NearestOf(&[Class::Motorcycle], "motorcycle-street");
const ANY: StandIn = StandIn::NearestOf(&Class::ALL, "car-sedan");

/// Types with a stand-in; errors name those with a vehicle in this order.
const STAND_INS: [(&str, StandIn); 17] = [
    ("TYPE_SMALL_CAR", CAR),
    ("TYPE_COMPACT_CAR", CAR),
    ("TYPE_MEDIUM_CAR", CAR),
    ("TYPE_LUXURY_CAR", CAR),
    ("TYPE_VAN", VAN),
    ("TYPE_HEAVY_TRUCK", TRUCK),
    ("TYPE_SEMITRACTOR", TRUCK),
    ("TYPE_SEMITRAILER", TRUCK),
    ("TYPE_TRAILER", TRUCK),
    ("TYPE_BUS", BUS),
    ("TYPE_MOTORCYCLE", MOTORCYCLE),
    ("TYPE_UNKNOWN", ANY),
    ("TYPE_OTHER", ANY),
    ("TYPE_VEHICLE", ANY),
    ("TYPE_LAND_VEHICLE", ANY),
    ("TYPE_PEDESTRIAN", StandIn::Ignored),
    ("TYPE_ANIMAL", StandIn::Ignored),
];

/// Stand-in of a type; `None` for one that needs a model of its own. Pedestrians are ignored, like a
/// `<person>` of SUMO; a bicycle is a vehicle, and refused without a model in recordings of both kinds.
pub(crate) fn stand_in_of(kind: &str) -> Option<StandIn> {
    STAND_INS.into_iter().find(|(name, _)| *name == kind).map(|(_, stand_in)| stand_in)
}

/// Types with a vehicle as stand-in, for an error that names them.
pub(crate) fn types_with_stand_in() -> Vec<&'static str> {
    let placed = STAND_INS.into_iter().filter(|(_, stand_in)| matches!(stand_in, StandIn::NearestOf(..)));
    placed.map(|(name, _)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(feature = "interchange")]
    #[test]
    fn every_type_with_a_stand_in_is_one_by_which_objects_are_told() {
        for (name, _) in STAND_INS {
            assert!(crate::recording::trace::type_names().any(|known| known == name), "{name}");
        }
    }

    #[test]
    fn trams_and_bicycles_need_models_of_their_own_and_who_walks_is_no_vehicle() {
        for needs_model in ["TYPE_TRAM", "TYPE_BICYCLE", "TYPE_STANDUP_SCOOTER"] {
            assert!(stand_in_of(needs_model).is_none());
        }
        for passed_over in ["TYPE_PEDESTRIAN", "TYPE_ANIMAL"] {
            assert!(matches!(stand_in_of(passed_over), Some(StandIn::Ignored)));
        }
        let placed = types_with_stand_in();
        assert!(placed.contains(&"TYPE_VAN") && !placed.contains(&"TYPE_PEDESTRIAN"));
    }
}
