//! Division of lit polygons by the sheets that their waves have passed.
//!
//! If waves are traced through sheets, these hide nothing. Each polygon is then cut along the outlines of the
//! sheets before it, so that every piece has passed one set of sheets, and records them. Their effect on the
//! field is left to the integration.

use crate::beams::occlusion::lit_parts::LitParts;
use crate::beams::occlusion::shadow::{HiddenPart, Shadow, ShadowCover};
use crate::beams::occlusion::view::View;
use crate::bodies::world::VisitBuffers;
use crate::geometry::border::Border;
use crate::geometry::clip::{Corner, Split, split};
use glam::DVec3;
use std::ops::ControlFlow;

/// A part of a lit polygon and the sheets before it, in any order.
struct SheetPiece {
    corners: Vec<Corner>,
    sheets: Vec<u32>,
}

/// Polygons of a view divided by the sheets before them.
pub(crate) fn split_at_sheets(view: &View, parts: LitParts) -> LitParts {
    if view.world.sheets().is_empty() {
        return parts;
    }
    let mut walk = VisitBuffers::default();
    let mut all = LitParts::default();
    for part in &parts.parts {
        match Shadow::of(part.facet, view) {
            Some(target) if !part.corners.is_empty() => {
                let polygon = &parts.corners[part.corners.clone()];
                let sheets = sheets_about(view, polygon, &target, &mut walk);
                part_one(view, polygon, &target, &sheets, &mut all);
            }
            _ => all.append(&parts, part),
        }
    }
    all
}

/// Sheets that may extend between the antenna and a polygon, by index.
fn sheets_about(view: &View, polygon: &[Corner], target: &Shadow, walk: &mut VisitBuffers) -> Vec<Shadow> {
    let mut found = Vec::new();
    let planes = polygon.iter().map(|corner| corner.edge).chain([target.front]);
    let _ = view.world.visit_inside(planes, None, DVec3::ZERO, walk, |facet| {
        found.extend((facet != target.facet && view.world.is_transparent(facet)).then_some(facet));
        ControlFlow::Continue(())
    });
    found.sort_unstable();
    found.into_iter().filter_map(|facet| Shadow::of(facet, view)).collect()
}

fn part_one(view: &View, polygon: &[Corner], target: &Shadow, sheets: &[Shadow], all: &mut LitParts) {
    let mut pieces = vec![SheetPiece { corners: polygon.to_vec(), sheets: Vec::new() }];
    for sheet in sheets {
        if sheet.cover(HiddenPart::AllInItsCone, polygon, view.tolerance_m()) == ShadowCover::Apart {
            continue;
        }
        let before = sheet.stands_before(target, view);
        if before != HiddenPart::Nothing {
            pieces = pieces
                .into_iter()
                .flat_map(|piece| piece.behind(sheet, before, view.tolerance_m()))
                .collect();
        }
    }
    for piece in pieces {
        all.push(target, view, &piece.corners);
        if let Some(pushed) = all.parts.last_mut() {
            pushed.sheets = in_order(view, &piece);
        }
    }
}

impl SheetPiece {
    /// Parts that have passed the sheet, and parts that have not.
    fn behind(mut self, sheet: &Shadow, before: HiddenPart, tolerance_m: f64) -> Vec<Self> {
        match sheet.cover(before, &self.corners, tolerance_m) {
            ShadowCover::Apart => return vec![self],
            ShadowCover::Whole => {
                self.sheets.push(sheet.facet);
                return vec![self];
            }
            ShadowCover::Partial => {}
        }
        let mut pieces = Vec::new();
        let mut inside = self.corners.clone();
        for plane in sheet.planes(before) {
            let mut corners = inside.clone();
            // The lit surface continues beyond such an edge.
            match split(&mut corners, 0..inside.len(), &plane, Border::Inner, tolerance_m, &mut Vec::new()) {
                Split::Inside => {}
                Split::Outside => return vec![self],
                Split::Cut { inside: kept, outside } => {
                    pieces.push(Self { corners: corners[outside].to_vec(), sheets: self.sheets.clone() });
                    inside = corners[kept].to_vec();
                }
            }
        }
        self.sheets.push(sheet.facet);
        pieces.push(Self { corners: inside, sheets: self.sheets });
        pieces
    }
}

/// Sheets of a piece in the order in which a wave to its centre meets them; ties by index.
fn in_order(view: &View, piece: &SheetPiece) -> Vec<u32> {
    let middle = piece.corners.iter().map(|c| c.point_m).sum::<DVec3>() / piece.corners.len().max(1) as f64;
    let back = view.antenna.towards(middle).try_normalize().unwrap_or(DVec3::ZERO);
    let before_middle = |facet: u32| {
        let plane = view.world.facet(facet).plane;
        -plane.distance_m(middle) / plane.normal.dot(back)
    };
    let mut sheets = piece.sheets.clone();
    sheets.sort_by(|&a, &b| before_middle(b).total_cmp(&before_middle(a)).then(a.cmp(&b)));
    sheets
}
