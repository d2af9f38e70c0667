//! Borders of lit polygons along an edge: the end of the facet, of a shadow, or of the beam that lights it.
//!
//! A shadow is cut out by whole lines, so that a line continues beyond the shadow as a seam between two lit
//! pieces. Both pieces store it as [`Border::Shadow`] under one name: if both are kept it is no border, and
//! if only one is, it is one, whatever happened to the other.

use crate::geometry::plane::Plane;

/// Border of a polygon along one of its edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Border {
    /// No border: the flat patch continues, as across the diagonal of a square.
    Inner,
    /// The flat patch ends.
    Own,
    /// A line that cuts out an occluder's shadow.
    Shadow,
    /// Patch and mirror end in one line, as both do at the fold of a corner: a node on either has the right
    /// phase there.
    Tied,
    /// A preceding mirror ends.
    Mirror,
    /// A line that cuts out a shadow on a preceding mirror.
    MirrorShadow,
}

/// Border along a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct BorderLine {
    pub(crate) border: Border,
    /// Name of the line along which a polygon was cut; 0 if none.
    line: u32,
}

impl From<Border> for BorderLine {
    fn from(border: Border) -> Self {
        Self { border, line: 0 }
    }
}

impl BorderLine {
    /// Border along a cutting plane; one that came via a mirror keeps the name that it has from there.
    pub(crate) fn cut_by(self, plane: &Plane) -> Self {
        if self.line == 0 { Self { line: name(plane), ..self } } else { self }
    }

    /// Name of the line, the same on both of its sides.
    pub(crate) fn line(self) -> u32 {
        self.line
    }

    /// Border of the same edge where it bounds the beam behind the mirror, under a name of its own: one plane
    /// through the antenna may cut the mirror and the facet that it lights, and these are two lines.
    pub(crate) fn through_mirror(self, mirror: &Plane) -> Self {
        let border = match self.border {
            Border::Own | Border::Tied => Border::Mirror,
            Border::Shadow => Border::MirrorShadow,
            Border::Inner | Border::Mirror | Border::MirrorShadow => self.border,
        };
        let renamed = || (self.line ^ name(mirror)).wrapping_mul(ODD as u32).rotate_left(13).max(1);
        Self { border, line: if self.line == 0 { 0 } else { renamed() } }
    }

    /// Border of the same edge where the window of a beam ends along it. A line that cuts out a shadow on the
    /// mirror continues as a seam where nothing ends, and one below an upright edge is coplanar with it: the
    /// edge stays its own.
    pub(crate) fn met_by(self, window: Self) -> Self {
        match (self.border, window.border) {
            (Border::Own, Border::Mirror) => Border::Tied.into(),
            (Border::Inner, _) => window,
            _ => self,
        }
    }

    /// Border of the overlap of two polygons where an edge of both is the same line: the surface takes
    /// precedence over the beams, and of two lines the same one is chosen on both sides.
    pub(crate) fn and(self, other: Self) -> Self {
        let rank = |at: Self| match at.border {
            Border::Tied => 5,
            Border::Own => 4,
            Border::Shadow => 3,
            Border::Mirror => 2,
            Border::MirrorShadow => 1,
            Border::Inner => 0,
        };
        if (rank(self), self.line) >= (rank(other), other.line) { self } else { other }
    }
}

/// Name of a plane, the same for the reversed plane; never 0.
fn name(plane: &Plane) -> u32 {
    let parts = [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset_m];
    let sign = if parts.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0) { -1.0 } else { 1.0 };
    // Adding 0 turns −0 into 0.
    let mixed = |mixed: u64, x: f64| (mixed ^ (sign * x + 0.0).to_bits()).wrapping_mul(ODD).rotate_left(29);
    let name = parts.into_iter().fold(0, mixed);
    ((name ^ (name >> 32)) as u32).max(1)
}

/// Fractional part of the golden ratio in 64 bits, which is odd: multiplication by it is invertible.
const ODD: u64 = 0x9e37_79b9_7f4a_7c15;

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_line_has_one_name_on_both_sides_and_another_line_another() {
        let plane = Plane { normal: DVec3::new(-0.0, -0.6, 0.8), offset_m: 0.0 };
        let other = Plane { normal: DVec3::new(0.0, 0.6, 0.8), offset_m: 0.0 };
        let line = |plane: Plane| BorderLine::from(Border::Shadow).cut_by(&plane).line();
        assert_eq!(line(plane), line(-plane));
        assert!(line(plane) != line(other) && line(plane) != 0);
        let mirrored = |cut: Plane, mirror: Plane| {
            BorderLine::from(Border::Shadow).cut_by(&cut).through_mirror(&mirror).cut_by(&other).line()
        };
        let mirror = Plane { normal: DVec3::X, offset_m: 2.0 };
        assert_eq!(mirrored(plane, mirror), mirrored(-plane, -mirror), "both sides of a seam");
        assert_ne!(mirrored(plane, mirror), line(plane), "behind the mirror it is another line");
    }
}
