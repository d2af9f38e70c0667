//! An aspect, its two standpoints, and the straight lines between surface points and an antenna.

use glam::DVec3;
use radar::standpoint::Standpoint;

/// A transmitter and a receiver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aspect {
    /// Standpoint of the transmitter.
    pub transmitter: Standpoint,
    /// Standpoint of the receiver.
    pub receiver: Standpoint,
}

/// The straight line between a surface point and an antenna.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Leg {
    /// Unit vector r̂ from the surface point to the antenna.
    pub(crate) towards: DVec3,
    /// Excess r − R of the length, metres; −r̂·x at infinite range.
    pub(crate) excess_m: f64,
    /// Length r, metres; infinite at infinite range.
    pub(crate) length_m: f64,
}

impl Aspect {
    /// Monostatic aspect: one antenna transmits and receives.
    pub fn monostatic(standpoint: Standpoint) -> Self {
        Self { transmitter: standpoint, receiver: standpoint }
    }
}

/// An antenna prepared for many legs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PreparedAntenna {
    /// Unit vector r̂ from the origin to the antenna.
    pub(crate) towards: DVec3,
    /// Position of an antenna at finite range.
    pub(crate) antenna_m: Option<DVec3>,
    range_m: f64,
    zenith_h: DVec3,
}

/// Both ends of a path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AntennaPair {
    pub(crate) transmitter: PreparedAntenna,
    /// Receiver; `None` if it is the transmitter.
    apart: Option<PreparedAntenna>,
}

impl AntennaPair {
    pub(crate) fn of(aspect: &Aspect) -> Self {
        let apart = (aspect.receiver != aspect.transmitter).then(|| PreparedAntenna::at(&aspect.receiver));
        Self { transmitter: PreparedAntenna::at(&aspect.transmitter), apart }
    }

    pub(crate) fn receiver(&self) -> &PreparedAntenna {
        self.apart.as_ref().unwrap_or(&self.transmitter)
    }

    /// Both antennas, or the single one.
    pub(crate) fn antennas(&self) -> impl Iterator<Item = &PreparedAntenna> {
        [&self.transmitter].into_iter().chain(&self.apart)
    }
}

impl PreparedAntenna {
    fn at(standpoint: &Standpoint) -> Self {
        let (sin_az, cos_az) = standpoint.azimuth_rad.sin_cos();
        let towards = standpoint.direction();
        let range_m = standpoint.range_m;
        let antenna_m = range_m.is_finite().then(|| range_m * towards);
        Self { towards, antenna_m, range_m, zenith_h: DVec3::new(-sin_az, cos_az, 0.0) }
    }

    /// The leg from surface point `x_m`.
    pub(crate) fn leg_from(&self, x_m: DVec3) -> Leg {
        let Some(antenna_m) = self.antenna_m else {
            return Leg { towards: self.towards, excess_m: -self.towards.dot(x_m), length_m: f64::INFINITY };
        };
        let line = antenna_m - x_m;
        let length_m = line.length();
        // r − R = (r² − R²)/(r + R): the difference of two lengths would lose four digits at 30 m.
        let excess_m = (x_m.length_squared() - 2.0 * antenna_m.dot(x_m)) / (length_m + self.range_m);
        Leg { towards: line / length_m, excess_m, length_m }
    }

    /// Ratio R/r for a length r; 1 at infinite range.
    pub(crate) fn spreading(&self, length_m: f64) -> f64 {
        if self.antenna_m.is_some() { self.range_m / length_m } else { 1.0 }
    }

    /// Vectors v̂ and ĥ of a path that reaches the antenna along `towards`: ĥ = unit(ẑ × r̂), v̂ = r̂ × ĥ;
    /// straight above or below, the requested azimuth decides.
    pub(crate) fn polarizations(&self, towards: DVec3) -> [DVec3; 2] {
        // Within 1e-9 rad of the zenith ẑ × r̂ is rounding.
        let horizontal = DVec3::Z.cross(towards);
        let length = horizontal.length();
        let h = if length > 1e-9 { horizontal / length } else { self.zenith_h };
        [towards.cross(h), h]
    }
}
