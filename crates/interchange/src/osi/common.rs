//! Common parts of the other messages.

use prost::Message;

/// `osi3.InterfaceVersion`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct InterfaceVersion {
    #[prost(uint32, optional, tag = "1")]
    pub(crate) version_major: Option<u32>,
    #[prost(uint32, optional, tag = "2")]
    pub(crate) version_minor: Option<u32>,
    #[prost(uint32, optional, tag = "3")]
    pub(crate) version_patch: Option<u32>,
}

/// The version of written messages.
pub(crate) const VERSION: [u32; 3] = [3, 8, 0];

/// [`VERSION`] as a message.
pub(crate) fn version() -> Option<InterfaceVersion> {
    let [major, minor, patch] = VERSION.map(Some);
    Some(InterfaceVersion { version_major: major, version_minor: minor, version_patch: patch })
}

/// `osi3.Timestamp`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Timestamp {
    #[prost(int64, optional, tag = "1")]
    pub(crate) seconds: Option<i64>,
    #[prost(uint32, optional, tag = "2")]
    pub(crate) nanos: Option<u32>,
}

impl Timestamp {
    /// The time to the nearest nanosecond.
    pub(crate) fn at(time_s: f64) -> Self {
        let nanos = (time_s * 1e9).round() as i64;
        let second = 1_000_000_000;
        Self { seconds: Some(nanos.div_euclid(second)), nanos: Some(nanos.rem_euclid(second) as u32) }
    }

    pub(crate) fn time_s(&self) -> f64 {
        self.seconds.unwrap_or(0) as f64 + f64::from(self.nanos.unwrap_or(0)) * 1e-9
    }
}

/// `osi3.Identifier`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Identifier {
    #[prost(uint64, optional, tag = "1")]
    pub(crate) value: Option<u64>,
}

impl Identifier {
    /// The standard's value for no reference.
    pub(crate) const NONE: u64 = u64::MAX;

    pub(crate) fn of(value: u64) -> Option<Self> {
        Some(Self { value: Some(value) })
    }
}

/// `osi3.Vector3d`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Vector3d {
    #[prost(double, optional, tag = "1")]
    pub(crate) x: Option<f64>,
    #[prost(double, optional, tag = "2")]
    pub(crate) y: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub(crate) z: Option<f64>,
}

impl Vector3d {
    pub(crate) fn of([x, y, z]: [f64; 3]) -> Option<Self> {
        Some(Self { x: Some(x), y: Some(y), z: Some(z) })
    }

    /// A vector in the plane of the road: its height is unknown.
    pub(crate) fn flat([x, y]: [f64; 2]) -> Option<Self> {
        Some(Self { x: Some(x), y: Some(y), z: None })
    }

    pub(crate) fn array(&self) -> [f64; 3] {
        [self.x, self.y, self.z].map(|value| value.unwrap_or(0.0))
    }
}

/// `osi3.Dimension3d`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Dimension3d {
    #[prost(double, optional, tag = "1")]
    pub(crate) length: Option<f64>,
    #[prost(double, optional, tag = "2")]
    pub(crate) width: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub(crate) height: Option<f64>,
}

/// `osi3.Orientation3d`: yaw about z, then pitch about the new y, then roll.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Orientation3d {
    #[prost(double, optional, tag = "1")]
    pub(crate) roll: Option<f64>,
    #[prost(double, optional, tag = "2")]
    pub(crate) pitch: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub(crate) yaw: Option<f64>,
}

/// `osi3.Spherical3d`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Spherical3d {
    #[prost(double, optional, tag = "1")]
    pub(crate) distance: Option<f64>,
    #[prost(double, optional, tag = "2")]
    pub(crate) azimuth: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub(crate) elevation: Option<f64>,
}

/// `osi3.MountingPosition`.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct MountingPosition {
    #[prost(message, optional, tag = "1")]
    pub(crate) position: Option<Vector3d>,
    #[prost(message, optional, tag = "2")]
    pub(crate) orientation: Option<Orientation3d>,
}

/// `osi3.BaseMoving`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct BaseMoving {
    #[prost(message, optional, tag = "1")]
    pub(crate) dimension: Option<Dimension3d>,
    #[prost(message, optional, tag = "2")]
    pub(crate) position: Option<Vector3d>,
    #[prost(message, optional, tag = "3")]
    pub(crate) orientation: Option<Orientation3d>,
    #[prost(message, optional, tag = "4")]
    pub(crate) velocity: Option<Vector3d>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_whole_nanoseconds_before_the_origin_too() {
        for (time_s, seconds, nanos) in
            [(0.0, 0, 0), (1.25, 1, 250_000_000), (-0.25, -1, 750_000_000), (0.1, 0, 100_000_000)]
        {
            let stamp = Timestamp::at(time_s);
            assert_eq!((stamp.seconds, stamp.nanos), (Some(seconds), Some(nanos)), "{time_s}");
            assert!((stamp.time_s() - time_s).abs() < 1e-9);
        }
    }
}
