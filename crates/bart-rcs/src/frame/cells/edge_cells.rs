//! Lit edges cut into cells, each a path with its node on the edge.

use crate::edges::edge_scattering::part_amplitudes;
use crate::edges::lit_edge::EdgeJoint;
use crate::frame::cells::path_cells::{Cell, CellSettings, facets_of, motions, padded, reversed};
use crate::joins::joint::Reverse;
use crate::joins::scatterer::Scatterer;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Cells of all joints, the reverse ones behind their own; in the order of the joints.
pub(crate) fn edge_cells(
    scatterer: &Scatterer<'_>,
    joints: &[EdgeJoint],
    settings: &CellSettings<'_>,
) -> Vec<Cell> {
    let parts: Vec<Vec<Cell>> = joints.par_iter().map(|joint| cells_of(scatterer, joint, settings)).collect();
    parts.into_iter().flatten().collect()
}

fn cells_of(scatterer: &Scatterer<'_>, joint: &EdgeJoint, settings: &CellSettings<'_>) -> Vec<Cell> {
    let facets = facets_of(scatterer, joint.forward, joint.backward);
    let motion = motions(scatterer, joint.forward, joint.backward);
    let accuracy = settings.accuracy_of_body[scatterer.node_body(joint.forward)];
    let [from, to] = joint.span_m;
    let count = ((to - from) / settings.size_m).ceil().max(1.0);
    let place = |i: f64| from + (to - from) * i / count;
    let mut cells = Vec::new();
    for i in 0..count as u32 {
        if !settings.room.take() {
            break;
        }
        let span_m = [place(f64::from(i)), place(f64::from(i + 1))];
        let (middle_m, estimate) =
            part_amplitudes(scatterer, joint, span_m, settings.wavenumbers_per_m, accuracy);
        cells.push(Cell {
            order: facets.len() as u8,
            facets: padded(&facets),
            apparent_m: scatterer
                .legs(joint.forward, joint.backward)
                .map(|leg| leg.mirrors.unfolded(middle_m)),
            motion,
            amplitudes_m: estimate.value,
            area_m2: as_area_m2(span_m, settings),
            error_m: estimate.error,
        });
    }
    if joint.reverse == Reverse::Included {
        let back: Vec<Cell> = cells.iter().map(reversed).collect();
        cells.extend(back);
    }
    cells
}

/// The area whose largest amplitude, kA/√π, is the edge's length/√π: the weight of its place among polygons.
fn as_area_m2(span_m: [f64; 2], settings: &CellSettings<'_>) -> f64 {
    let highest = settings.wavenumbers_per_m.iter().copied().fold(TAU, f64::max);
    (span_m[1] - span_m[0]) / highest
}
