//! Polarization vectors of a leg, and their transformation by mirrors to the node.

use crate::geometry::plane::Plane;
use glam::{DMat3, DVec3};

/// Sine of the angle to the vertical below which ĥ is prescribed by the caller, since unit(ẑ × r̂) is mere
/// rounding.
const ZENITH_SINE: f64 = 1e-9;

/// Vectors v̂ and ĥ of a leg: ĥ = unit(ẑ × r̂), v̂ = r̂ × ĥ, r̂ from the body to the antenna; the same for
/// both directions of travel.
///
/// `zenith_h` is ĥ straight above and below, where the requested azimuth decides: (−sin az, cos az, 0).
pub(crate) fn polarization_vectors(to_antenna: DVec3, zenith_h: DVec3) -> [DVec3; 2] {
    let across = DVec3::Z.cross(to_antenna);
    let sine = across.length();
    let h = if sine < ZENITH_SINE { zenith_h } else { across / sine };
    [to_antenna.cross(h), h]
}

/// Vector ĥ at the zenith for an azimuth from x towards y.
pub(crate) fn zenith_h(azimuth_rad: f64) -> DVec3 {
    DVec3::new(-azimuth_rad.sin(), azimuth_rad.cos(), 0.0)
}

/// Perfect mirrors between an antenna and a node: they map points, directions and unit fields of the
/// antenna's own leg to the node.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mirrors {
    /// Product of the reflections I − 2nnᵀ, the first mirror's rightmost.
    node_from_leg: DMat3,
    /// Apparent offset of the leg's coordinate origin: x_node = node_from_leg·x_leg + offset.
    offset_m: DVec3,
    /// A conductor maps e to −e + 2n(n·e), minus the reflection: −1 for an odd number of mirrors.
    sign: f64,
}

impl Mirrors {
    /// No mirrors, as in first order.
    pub(crate) const NONE: Self = Self { node_from_leg: DMat3::IDENTITY, offset_m: DVec3::ZERO, sign: 1.0 };

    /// Mirror of the antenna's image below the road z = 0: its own leg is inverted. The road's effect on the
    /// field is treated separately.
    pub(crate) const BELOW_ROAD: Self = Self {
        node_from_leg: DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::NEG_Z),
        offset_m: DVec3::ZERO,
        sign: 1.0,
    };

    /// These mirrors followed by one more.
    pub(crate) fn and(self, plane: &Plane) -> Self {
        let n = plane.normal;
        let reflection = DMat3::IDENTITY - 2.0 * DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        Self {
            node_from_leg: reflection * self.node_from_leg,
            offset_m: reflection * self.offset_m + 2.0 * plane.offset_m * n,
            sign: -self.sign,
        }
    }

    /// Apparent position at the node of a point at the antenna, unfolded through the mirrors.
    pub(crate) fn unfolded(&self, x_m: DVec3) -> DVec3 {
        self.node_from_leg.transpose() * (x_m - self.offset_m)
    }

    /// Direction r̂ of an infinitely distant antenna, as seen in its image.
    pub(crate) fn image_direction(&self, r: DVec3) -> DVec3 {
        self.node_from_leg * r
    }

    /// Unit fields v and h at the node, for the direction of travel there (away from the antenna).
    pub(crate) fn fields_at_node(&self, travel: DVec3, zenith_h: DVec3) -> [DVec3; 2] {
        let to_antenna = self.antenna_direction(travel);
        polarization_vectors(to_antenna, zenith_h).map(|e| self.sign * (self.node_from_leg * e))
    }

    /// Direction r̂ of the antenna's own leg for the direction of travel at the node.
    pub(crate) fn antenna_direction(&self, travel: DVec3) -> DVec3 {
        -(self.node_from_leg.transpose() * travel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn v_points_up_and_h_counter_clockwise() {
        let [v, h] = polarization_vectors(DVec3::X, zenith_h(0.0));
        assert_eq!((v, h), (DVec3::Z, DVec3::Y));
    }

    #[test]
    fn straight_above_the_azimuth_asked_for_decides_and_nothing_jumps_there() {
        let azimuth: f64 = 0.7;
        let near = DVec3::new(1e-6 * azimuth.cos(), 1e-6 * azimuth.sin(), 1.0);
        let [v_near, h_near] = polarization_vectors(near, zenith_h(azimuth));
        let [v, h] = polarization_vectors(DVec3::Z, zenith_h(azimuth));
        assert!((h - h_near).length() < 1e-12 && (v - v_near).length() < 2e-6);
    }

    #[test]
    fn a_mirror_keeps_the_normal_field_and_turns_the_tangential_one() {
        let n = DVec3::new(0.6, 0.0, 0.8);
        let travel = DVec3::new(-0.3, 0.4, -0.2).try_normalize().unwrap();
        let reflected = travel - 2.0 * n * n.dot(travel);
        let before = Mirrors::NONE.fields_at_node(travel, DVec3::Y);
        let after =
            Mirrors::NONE.and(&Plane { normal: n, offset_m: 0.3 }).fields_at_node(reflected, DVec3::Y);
        for (e, r) in before.into_iter().zip(after) {
            assert!((r - (-e + 2.0 * n * n.dot(e))).length() < 1e-15);
            assert!(r.dot(reflected).abs() < 1e-15);
        }
    }

    #[test]
    fn the_unfolded_point_is_as_far_from_the_antenna_as_the_point_from_its_image() {
        let planes = [(DVec3::new(0.6, 0.0, 0.8), 0.3), (DVec3::new(0.0, -0.8, 0.6), -0.7)]
            .map(|(normal, offset_m)| Plane { normal, offset_m });
        let (p, x) = (DVec3::new(3.0, 1.0, 2.0), DVec3::new(-0.4, 0.2, 0.9));
        let mirrors = Mirrors::NONE.and(&planes[0]).and(&planes[1]);
        let image = crate::geometry::antenna::Antenna::Point(p).mirrored(&planes[0]).mirrored(&planes[1]);
        assert!((mirrors.unfolded(x).distance(p) - image.path_length_m(x)).abs() < 1e-14);
    }
}
