//! Types of OSI's moving objects, as classes of the project's own vehicles.

use artifact::settings::Class;

/// Stand-in for objects of a type where `models` says nothing.
pub(crate) enum Default {
    /// The vehicle of these classes that is nearest in size; where no size is told, the one of the name.
    NearestOf(&'static [Class], &'static str),
    /// Nothing: it is passed over.
    PassedOver,
}

/// Default of a type; `None` for one that needs a model of its own. Those who walk are passed over, as a
/// `<person>` of SUMO is; a bicycle is a vehicle, and in recordings of both kinds refused without a model.
pub(crate) fn default_of(kind: &str) -> Option<Default> {
    use Class::{Bus, Car, Motorcycle, Truck};
    let (classes, name): (&'static [Class], _) = match kind {
        "TYPE_SMALL_CAR" | "TYPE_COMPACT_CAR" | "TYPE_MEDIUM_CAR" | "TYPE_LUXURY_CAR" => {
            (&[Car], "car-sedan")
        }
        "TYPE_VAN" => (&[Car, Truck], "truck-box"),
        "TYPE_HEAVY_TRUCK" | "TYPE_SEMITRACTOR" | "TYPE_SEMITRAILER" | "TYPE_TRAILER" => {
            (&[Truck], "truck-box")
        }
        "TYPE_BUS" => (&[Bus], "bus-city"),
        "TYPE_MOTORCYCLE" => (&[Motorcycle], "motorcycle-street"),
        "TYPE_UNKNOWN" | "TYPE_OTHER" | "TYPE_VEHICLE" | "TYPE_LAND_VEHICLE" => (&Class::ALL, "car-sedan"),
        "TYPE_PEDESTRIAN" | "TYPE_ANIMAL" => return Some(Default::PassedOver),
        _ => return None,
    };
    Some(Default::NearestOf(classes, name))
}

/// Types that have a default, for an error that names them.
pub(crate) const WITH_DEFAULT: [&str; 15] = [
    "TYPE_SMALL_CAR",
    "TYPE_COMPACT_CAR",
    "TYPE_MEDIUM_CAR",
    "TYPE_LUXURY_CAR",
    "TYPE_VAN",
    "TYPE_HEAVY_TRUCK",
    "TYPE_SEMITRACTOR",
    "TYPE_SEMITRAILER",
    "TYPE_TRAILER",
    "TYPE_BUS",
    "TYPE_MOTORCYCLE",
    "TYPE_UNKNOWN",
    "TYPE_OTHER",
    "TYPE_VEHICLE",
    "TYPE_LAND_VEHICLE",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_that_is_told_to_have_a_default_has_one() {
        let is_placed = |kind: &&str| matches!(default_of(kind), Some(Default::NearestOf(..)));
        assert!(WITH_DEFAULT.iter().all(is_placed));
        for needs_model in ["TYPE_TRAM", "TYPE_BICYCLE", "TYPE_STANDUP_SCOOTER"] {
            assert!(default_of(needs_model).is_none());
        }
        for passed_over in ["TYPE_PEDESTRIAN", "TYPE_ANIMAL"] {
            assert!(matches!(default_of(passed_over), Some(Default::PassedOver)));
        }
    }
}
