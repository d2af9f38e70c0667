//! Fields of the written messages, for readers of MCAP that do not know OSI.

use crate::descriptors::Kind::{Double, Int32, Int64, Many, One, Uint32, Uint64};
use crate::descriptors::{Definitions, MessageRow, described};

const COMMON: &[MessageRow] = &[
    (
        "InterfaceVersion",
        &[("version_major", 1, Uint32), ("version_minor", 2, Uint32), ("version_patch", 3, Uint32)],
    ),
    ("Timestamp", &[("seconds", 1, Int64), ("nanos", 2, Uint32)]),
    ("Identifier", &[("value", 1, Uint64)]),
    ("Vector3d", &[("x", 1, Double), ("y", 2, Double), ("z", 3, Double)]),
    ("Dimension3d", &[("length", 1, Double), ("width", 2, Double), ("height", 3, Double)]),
    ("Orientation3d", &[("roll", 1, Double), ("pitch", 2, Double), ("yaw", 3, Double)]),
    ("Spherical3d", &[("distance", 1, Double), ("azimuth", 2, Double), ("elevation", 3, Double)]),
    ("MountingPosition", &[("position", 1, One("Vector3d")), ("orientation", 2, One("Orientation3d"))]),
    (
        "BaseMoving",
        &[
            ("dimension", 1, One("Dimension3d")),
            ("position", 2, One("Vector3d")),
            ("orientation", 3, One("Orientation3d")),
            ("velocity", 4, One("Vector3d")),
        ],
    ),
];

const SENSOR_DATA: &[MessageRow] = &[
    (
        "SensorData",
        &[
            ("version", 1, One("InterfaceVersion")),
            ("timestamp", 2, One("Timestamp")),
            ("sensor_id", 5, One("Identifier")),
            ("mounting_position", 6, One("MountingPosition")),
            ("last_measurement_time", 9, One("Timestamp")),
            ("moving_object_header", 12, One("DetectedEntityHeader")),
            ("moving_object", 13, Many("DetectedMovingObject")),
            ("feature_data", 26, One("FeatureData")),
        ],
    ),
    (
        "DetectedEntityHeader",
        &[
            ("measurement_time", 1, One("Timestamp")),
            ("cycle_counter", 2, Uint64),
            ("data_qualifier", 3, Int32),
        ],
    ),
    (
        "FeatureData",
        &[("version", 1, One("InterfaceVersion")), ("radar_sensor", 2, Many("RadarDetectionData"))],
    ),
    (
        "RadarDetectionData",
        &[("header", 1, One("SensorDetectionHeader")), ("detection", 2, Many("RadarDetection"))],
    ),
    (
        "SensorDetectionHeader",
        &[
            ("measurement_time", 1, One("Timestamp")),
            ("cycle_counter", 2, Uint64),
            ("mounting_position", 3, One("MountingPosition")),
            ("data_qualifier", 5, Int32),
            ("number_of_valid_detections", 6, Uint32),
            ("sensor_id", 7, One("Identifier")),
        ],
    ),
    (
        "RadarDetection",
        &[
            ("existence_probability", 1, Double),
            ("object_id", 2, One("Identifier")),
            ("position", 3, One("Spherical3d")),
            ("position_rmse", 4, One("Spherical3d")),
            ("radial_velocity", 5, Double),
            ("radial_velocity_rmse", 6, Double),
            ("rcs", 7, Double),
            ("snr", 8, Double),
            ("ambiguity_id", 10, One("Identifier")),
        ],
    ),
    (
        "DetectedMovingObject",
        &[
            ("header", 1, One("DetectedItemHeader")),
            ("base", 2, One("BaseMoving")),
            ("base_rmse", 3, One("BaseMoving")),
            ("reference_point", 4, Int32),
            ("candidate", 8, Many("DetectedMovingObject.CandidateMovingObject")),
        ],
    ),
    (
        "DetectedMovingObject.CandidateMovingObject",
        &[
            ("probability", 1, Double),
            ("type", 2, Int32),
            ("vehicle_classification", 3, One("MovingObject.VehicleClassification")),
        ],
    ),
    (
        "DetectedItemHeader",
        &[
            ("tracking_id", 1, One("Identifier")),
            ("age", 4, Double),
            ("measurement_state", 5, Int32),
            ("sensor_id", 6, Many("Identifier")),
        ],
    ),
    ("MovingObject", &[]),
    ("MovingObject.VehicleClassification", &[("type", 1, Int32)]),
];

const SENSOR_VIEW: &[MessageRow] = &[
    (
        "SensorView",
        &[
            ("version", 1, One("InterfaceVersion")),
            ("timestamp", 2, One("Timestamp")),
            ("sensor_id", 3, One("Identifier")),
            ("mounting_position", 4, One("MountingPosition")),
            ("radar_sensor_view", 1001, Many("RadarSensorView")),
        ],
    ),
    (
        "RadarSensorView",
        &[
            ("view_configuration", 1, One("RadarSensorViewConfiguration")),
            ("reflection", 2, Many("RadarSensorView.Reflection")),
        ],
    ),
    (
        "RadarSensorView.Reflection",
        &[
            ("signal_strength", 1, Double),
            ("time_of_flight", 2, Double),
            ("doppler_shift", 3, Double),
            ("source_horizontal_angle", 4, Double),
            ("source_vertical_angle", 5, Double),
        ],
    ),
    (
        "RadarSensorViewConfiguration",
        &[
            ("sensor_id", 1, One("Identifier")),
            ("mounting_position", 2, One("MountingPosition")),
            ("emitter_frequency", 9, Double),
        ],
    ),
];

/// Descriptor of `osi3.SensorData` and all of its parts.
pub(crate) fn sensor_data() -> Vec<u8> {
    of_osi("osi3/sensor_data.proto", SENSOR_DATA)
}

/// Descriptor of `osi3.SensorView` and all of its parts.
pub(crate) fn sensor_view() -> Vec<u8> {
    of_osi("osi3/sensor_view.proto", SENSOR_VIEW)
}

fn of_osi(name: &'static str, rows: &[MessageRow]) -> Vec<u8> {
    let messages = [COMMON, rows].concat();
    described(&[Definitions { name, package: "osi3", imports: &[], syntax: "proto2", messages }])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_message_that_a_field_names_is_described() {
        for rows in [SENSOR_DATA, SENSOR_VIEW] {
            let known: Vec<&str> = COMMON.iter().chain(rows).map(|(name, _)| *name).collect();
            for (_, fields) in COMMON.iter().chain(rows) {
                for (name, _, kind) in *fields {
                    let (One(of) | Many(of)) = kind else { continue };
                    assert!(known.contains(of), "{name}: {of}");
                }
            }
        }
    }
}
