//! Borders of lit polygons along an edge: the facet itself, a shadow, or the beam that lights it.
//!
//! A shadow is cut out by whole lines, so that a line goes on beyond the shadow as a seam between two lit
//! pieces. The piece on the occluder's side of the line has the seam as [`Border::OwnInside`], the one on the
//! other side as [`Border::Shadow`]: counted with opposite signs they cancel, and the true shadow line is
//! left.

/// Border of a polygon along one of its edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Border {
    /// No border: the flat patch goes on, as beyond the diagonal of a square.
    Inner,
    /// The flat patch ends.
    Own,
    /// An occluder's shadow begins, on the lit side of the line that cuts it out.
    Shadow,
    /// The occluder's side of a line that cuts out a shadow.
    OwnInside,
    /// Patch and mirror end in one line, as both do at the fold of a corner: a node has the right phase there
    /// on either.
    Tied,
    /// A mirror before ends.
    Mirror,
    /// A shadow on a mirror before begins, on the lit side of the line that cuts it out.
    MirrorShadow,
    /// The occluder's side of a line that cuts out a shadow on a mirror before.
    MirrorInside,
}

impl Border {
    /// New edges where an occluder's plane cuts: of the part inside the shadow's plane, of the one outside.
    pub(crate) const SHADOW: [Self; 2] = [Self::OwnInside, Self::Shadow];

    /// Border of the same edge where it cuts the beam behind the mirror.
    pub(crate) fn through_mirror(self) -> Self {
        match self {
            Self::Own | Self::Tied => Self::Mirror,
            Self::Shadow => Self::MirrorShadow,
            Self::OwnInside => Self::MirrorInside,
            Self::Inner | Self::Mirror | Self::MirrorShadow | Self::MirrorInside => self,
        }
    }

    /// Border of the same edge where the window of a beam ends along it. A line that cuts out a shadow on the
    /// mirror goes on as a seam where nothing ends, and one below an upright edge lies in one plane with it:
    /// the edge stays its own.
    pub(crate) fn met_by(self, window: Self) -> Self {
        match (self, window) {
            (Self::Own, Self::Mirror) => Self::Tied,
            (Self::Inner, _) => window,
            _ => self,
        }
    }

    /// Border of the overlap of two polygons where an edge of both is the same line: the surface before the
    /// beams.
    pub(crate) fn and(self, other: Self) -> Self {
        let rank = |border: Self| match border {
            Self::Tied => 7,
            Self::Own => 6,
            Self::Shadow => 5,
            Self::OwnInside => 4,
            Self::Mirror => 3,
            Self::MirrorShadow => 2,
            Self::MirrorInside => 1,
            Self::Inner => 0,
        };
        if rank(self) >= rank(other) { self } else { other }
    }

    /// Sign with which the edge counts in the outline of all pieces together: seams cancel.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Own | Self::Shadow | Self::Tied | Self::Mirror | Self::MirrorShadow => 1.0,
            Self::OwnInside | Self::MirrorInside => -1.0,
            Self::Inner => 0.0,
        }
    }
}
