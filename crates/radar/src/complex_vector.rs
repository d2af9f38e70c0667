//! Complex field vectors that are only rotated, projected and scaled.

use glam::{DMat3, DVec3};
use num_complex::Complex64;
use std::ops::Add;

/// A vector with complex components.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComplexVector {
    re: DVec3,
    im: DVec3,
}

impl ComplexVector {
    /// Component along a real direction.
    pub fn along(self, direction: DVec3) -> Complex64 {
        Complex64::new(self.re.dot(direction), self.im.dot(direction))
    }

    /// Product of a real direction and a complex amplitude.
    pub fn of(direction: DVec3, amplitude: Complex64) -> Self {
        Self { re: direction * amplitude.re, im: direction * amplitude.im }
    }

    /// Product Σ aᵢbᵢ without conjugation, as in reciprocity.
    pub fn dot(self, other: Self) -> Complex64 {
        Complex64::new(
            self.re.dot(other.re) - self.im.dot(other.im),
            self.re.dot(other.im) + self.im.dot(other.re),
        )
    }

    /// The vector mirrored at a plane z = const.
    pub fn mirrored_in_z(self) -> Self {
        Self { re: self.re.with_z(-self.re.z), im: self.im.with_z(-self.im.z) }
    }

    /// Product of a matrix and the vector.
    pub fn turned(self, by: DMat3) -> Self {
        Self { re: by * self.re, im: by * self.im }
    }

    /// Cross product `direction` × self.
    pub fn crossed_by(self, direction: DVec3) -> Self {
        Self { re: direction.cross(self.re), im: direction.cross(self.im) }
    }
}

impl From<DVec3> for ComplexVector {
    fn from(re: DVec3) -> Self {
        Self { re, im: DVec3::ZERO }
    }
}

impl Add for ComplexVector {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}
