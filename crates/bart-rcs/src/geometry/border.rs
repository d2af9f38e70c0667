//! Borders of lit polygons along an edge: the facet itself, a shadow, or the beam that lights it.
//!
//! A shadow is cut out by whole lines, so that a line goes on beyond the shadow as a seam between two lit
//! pieces. The piece on the occluder's side of the line has the seam as [`Border::OwnInside`], the one on the
//! other side as [`Border::Own`]: counted with opposite signs they cancel, and the true shadow line is left.

/// Border of a polygon along one of its edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Border {
    /// No border: the flat patch goes on, as beyond the diagonal of a square.
    Inner,
    /// The flat patch ends, or an occluder's shadow begins.
    Own,
    /// The occluder's side of a line that cuts out a shadow.
    OwnInside,
    /// Patch and mirror end in one line, as both do at the fold of a corner: a node has the right phase there
    /// on either.
    Tied,
    /// A mirror before ends, or a shadow on it begins.
    Mirror,
    /// The occluder's side of a line that cuts out a shadow on a mirror before.
    MirrorInside,
}

impl Border {
    /// New edges where an occluder's plane cuts: of the part inside the shadow's plane, of the one outside.
    pub(crate) const SHADOW: [Self; 2] = [Self::OwnInside, Self::Own];

    /// Border of the same edge where it cuts the beam behind the mirror.
    pub(crate) fn through_mirror(self) -> Self {
        match self {
            Self::Own | Self::Tied => Self::Mirror,
            Self::OwnInside => Self::MirrorInside,
            Self::Inner | Self::Mirror | Self::MirrorInside => self,
        }
    }

    /// Border of the same edge where the window of a beam ends along it.
    pub(crate) fn met_by(self, window: Self) -> Self {
        match (self, window) {
            (Self::Own, Self::Mirror | Self::MirrorInside) => Self::Tied,
            (Self::Inner, _) => window,
            _ => self,
        }
    }

    /// Border of the overlap of two polygons where an edge of both is the same line: the surface before the
    /// beams.
    pub(crate) fn and(self, other: Self) -> Self {
        let rank = |border: Self| match border {
            Self::Tied => 5,
            Self::Own => 4,
            Self::OwnInside => 3,
            Self::Mirror => 2,
            Self::MirrorInside => 1,
            Self::Inner => 0,
        };
        if rank(self) >= rank(other) { self } else { other }
    }

    /// Sign with which the edge counts in the outline of all pieces together: seams cancel.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Own | Self::Tied | Self::Mirror => 1.0,
            Self::OwnInside | Self::MirrorInside => -1.0,
            Self::Inner => 0.0,
        }
    }
}
