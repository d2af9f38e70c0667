//! The plane z = 0 as a mirror.

use crate::geometry::antenna::Antenna;
use crate::geometry::plane::Plane;
use glam::DVec3;

/// The plane z = 0.
pub(crate) const ROAD_PLANE: Plane = Plane { normal: DVec3::Z, offset_m: 0.0 };

/// Mirror image of a vector below the road.
pub(crate) fn below(v: DVec3) -> DVec3 {
    v.with_z(-v.z)
}

/// Mirror image of an antenna.
pub(crate) fn image(antenna: Antenna) -> Antenna {
    antenna.mirrored(&ROAD_PLANE)
}
