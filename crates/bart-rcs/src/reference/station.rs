//! Where an antenna stands, as `rcs` names it: azimuth, elevation, range, body axes.

use glam::DVec3;

/// A transmitter and a receiver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aspect {
    /// Where the wave comes from.
    pub transmitter: Station,
    /// Where it is received.
    pub receiver: Station,
}

/// An antenna at `range_m` from the mesh's origin; infinite range is a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// From body x (ahead) towards body y (left).
    pub azimuth_rad: f64,
    /// Above the horizon.
    pub elevation_rad: f64,
    /// R; infinity for plane waves.
    pub range_m: f64,
}

/// The straight line between a surface point and an antenna.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Leg {
    /// r̂: unit, from the surface point to the antenna.
    pub(crate) towards: DVec3,
    /// r − R, metres; −r̂·x at infinite range.
    pub(crate) excess_m: f64,
    /// r, metres; infinite at infinite range.
    pub(crate) length_m: f64,
}

impl Aspect {
    /// One antenna sends and receives.
    pub fn monostatic(station: Station) -> Self {
        Self { transmitter: station, receiver: station }
    }
}

impl Station {
    /// r̂: unit, from the origin to the antenna.
    pub fn direction(&self) -> DVec3 {
        let (sin_az, cos_az) = self.azimuth_rad.sin_cos();
        let (sin_el, cos_el) = self.elevation_rad.sin_cos();
        DVec3::new(cos_el * cos_az, cos_el * sin_az, sin_el)
    }

    /// Place of an antenna at finite range; `None` at infinite range.
    pub fn position_m(&self) -> Option<DVec3> {
        self.range_m.is_finite().then(|| self.range_m * self.direction())
    }

    /// The leg from surface point `x_m`.
    pub(crate) fn leg_from(&self, x_m: DVec3) -> Leg {
        let towards_origin_side = self.direction();
        let Some(antenna_m) = self.position_m() else {
            let excess_m = -towards_origin_side.dot(x_m);
            return Leg { towards: towards_origin_side, excess_m, length_m: f64::INFINITY };
        };
        let line = antenna_m - x_m;
        let length_m = line.length();
        // r − R = (r² − R²)/(r + R): the difference of two lengths would lose four digits at 30 m.
        let excess_m = (x_m.length_squared() - 2.0 * antenna_m.dot(x_m)) / (length_m + self.range_m);
        Leg { towards: line / length_m, excess_m, length_m }
    }

    /// R/r of a length r; 1 at infinite range.
    pub(crate) fn spreading(&self, length_m: f64) -> f64 {
        if self.range_m.is_finite() { self.range_m / length_m } else { 1.0 }
    }

    /// v̂ and ĥ of a path that reaches the antenna along `towards`: ĥ = unit(ẑ × r̂), v̂ = r̂ × ĥ; straight above or below,
    /// the azimuth asked for decides.
    pub(crate) fn polarizations(&self, towards: DVec3) -> [DVec3; 2] {
        let (sin_az, cos_az) = self.azimuth_rad.sin_cos();
        // Below 1e-9 rad off the zenith ẑ × r̂ is rounding.
        let horizontal = DVec3::Z.cross(towards);
        let h = if horizontal.length() > 1e-9 {
            horizontal / horizontal.length()
        } else {
            DVec3::new(-sin_az, cos_az, 0.0)
        };
        [towards.cross(h), h]
    }
}
