//! Lit polygons of one view.

use crate::beams::occlusion::shadow::Shadow;
use crate::beams::occlusion::view::View;
use crate::geometry::clip::{Corner, doubled_area, perimeter_m};
use crate::geometry::section::section;
use glam::DVec3;
use std::ops::Range;

/// Lit polygons of one view.
#[derive(Debug, Clone, Default)]
pub(crate) struct LitParts {
    /// Polygons by facet, then piece.
    pub(crate) parts: Vec<LitPart>,
    /// Corners of all polygons.
    pub(crate) corners: Vec<Corner>,
}

/// A lit polygon.
#[derive(Debug, Clone)]
pub(crate) struct LitPart {
    /// Index into the world's facets.
    pub(crate) facet: u32,
    /// Unit normal on the lit side.
    pub(crate) lit_normal: DVec3,
    /// Range of the corners in [`LitParts::corners`]; empty if the polygon is mere rounding.
    pub(crate) corners: Range<usize>,
    /// Area, m².
    pub(crate) area_m2: f64,
    /// Area across the wave, area·cosθ at the centre, m².
    pub(crate) across_m2: f64,
    /// Solid angle, sr, or area across the direction, m².
    pub(crate) section: f64,
    /// Sheets passed by the wave since the preceding mirror, in its order.
    pub(crate) sheets: Vec<u32>,
}

impl LitParts {
    /// Adds a lit polygon. A polygon thinner than rounding keeps its area, for the audit, but loses its
    /// corners.
    pub(crate) fn push(&mut self, target: &Shadow, view: &View, polygon: &[Corner]) {
        let area_m2 = 0.5 * doubled_area(polygon.iter().map(|c| c.point_m)).dot(target.front.normal).max(0.0);
        let start = self.corners.len();
        if area_m2 > view.tolerance_m() * perimeter_m(polygon) {
            self.corners.extend_from_slice(polygon);
        }
        let middle = polygon.iter().map(|c| c.point_m).sum::<DVec3>() / polygon.len() as f64;
        let towards = view.antenna.towards(middle).try_normalize().unwrap_or(DVec3::ZERO);
        self.parts.push(LitPart {
            facet: target.facet,
            lit_normal: target.front.normal,
            corners: start..self.corners.len(),
            area_m2,
            across_m2: area_m2 * towards.dot(target.front.normal).abs(),
            section: section(view.antenna, polygon.iter().map(|c| c.point_m)),
            sheets: Vec::new(),
        });
    }

    /// Adds a part of another set unchanged.
    pub(crate) fn append(&mut self, others: &Self, part: &LitPart) {
        let start = self.corners.len();
        self.corners.extend_from_slice(&others.corners[part.corners.clone()]);
        self.parts.push(LitPart { corners: start..self.corners.len(), ..part.clone() });
    }
}
