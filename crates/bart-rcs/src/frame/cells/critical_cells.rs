//! Large lit polygons off their specular: terms of their corners and sides in place of cells.

use crate::frame::cells::corner_slide::BorderPlace;
use crate::geometry::convex_intersection::bounds;
use crate::geometry::plane_frame::PlaneFrame;
use crate::integral::critical_points::terms::CriticalPoint;
use crate::joins::joint::Joint;
use crate::joins::scatterer::{Integration, PolygonPart, Scatterer};
use glam::{DVec2, DVec3};

/// Cells that a flat side would be cut into from which on its corners and sides are looked at, and cells that
/// a smaller polygon would. Fewer are as good: a facet of something round meets its neighbours at its
/// corners, and what both leave there is small beside either; on a car's panels of 12 cells and more corners
/// leave twice the error that cells do, on a motorcycle under the mast of 64 and more as much.
const MANY_CELLS: [f64; 2] = [64.0, 256.0];
/// Extent of a flat side.
const FLAT_SIDE_M: f64 = 0.5;

/// Whether a polygon would be cut into many cells.
pub(crate) fn is_large(extent_m: DVec2, size_m: f64) -> bool {
    let many = MANY_CELLS[usize::from(extent_m.max_element() < FLAT_SIDE_M)];
    (extent_m / size_m).ceil().max(DVec2::ONE).element_product() > many
}

/// A joint's polygon in its plane.
pub(crate) struct LaidOut {
    frame: PlaneFrame,
    polygon: Vec<DVec2>,
}

impl LaidOut {
    pub(crate) fn of(scatterer: &Scatterer<'_>, joint: &Joint, corners_m: &[DVec3]) -> Self {
        let frame = PlaneFrame::new(corners_m[0], scatterer.forward(joint).lit_normal);
        Self { frame, polygon: corners_m.iter().map(|c| frame.plane_from_world(*c)).collect() }
    }

    /// Whether it would be cut into many cells.
    pub(crate) fn is_large(&self, size_m: f64) -> bool {
        let [low, high] = bounds(&self.polygon);
        is_large(high - low, size_m)
    }
}

/// A polygon in its plane, as cells take it.
pub(crate) enum SplitJoint {
    /// To be cut into cells.
    Small(PlaneFrame, Vec<DVec2>),
    /// Parts to be shared among the nodes of a grid, and terms of what is not among them.
    Large(PlaneFrame, Vec<Vec<DVec2>>, Vec<(CriticalPoint, BorderPlace)>),
}

/// A joint's polygon as cells of `size_m` take it, as large if its outline slides; amplitudes of the terms
/// have the joint's weight.
pub(crate) fn split_joint(
    scatterer: &Scatterer<'_>,
    joint: &Joint,
    corners_m: &[DVec3],
    (size_m, slides): (f64, bool),
    request: &Integration<'_>,
) -> SplitJoint {
    let laid_out = LaidOut::of(scatterer, joint, corners_m);
    let is_small = !slides && !laid_out.is_large(size_m);
    let LaidOut { frame, polygon } = laid_out;
    if is_small {
        return SplitJoint::Small(frame, polygon);
    }
    let Integration { wavenumbers_per_m, accuracy, bracket } = *request;
    let part = PolygonPart { corners_m, reference_m: corners_m[0], bracket };
    let mut terms = Vec::new();
    let near_m = scatterer.with_field(joint, &part, (wavenumbers_per_m, accuracy), |field| {
        let parted =
            field.split_about_stationary_point(&polygon, wavenumbers_per_m[wavenumbers_per_m.len() / 2]);
        for far in &parted.far {
            field.for_each_term(far, size_m, wavenumbers_per_m, &mut |term| {
                let corners = far.ends_of(term.side).map(|end_m| corner_at(&polygon, end_m));
                let share = term.share;
                terms.push((term, BorderPlace { corners, share }));
            });
        }
        parted.near
    });
    let amplitudes = terms.iter_mut().map(|(term, _)| &mut term.amplitudes);
    amplitudes.for_each(|estimate| Scatterer::weigh(joint, wavenumbers_per_m, estimate));
    SplitJoint::Large(frame, near_m, terms)
}

/// Corner of a polygon at a place.
fn corner_at(polygon: &[DVec2], at_m: DVec2) -> Option<usize> {
    const SAME_CORNER_M: f64 = 1e-9;
    polygon.iter().position(|corner| corner.distance(at_m) < SAME_CORNER_M)
}
