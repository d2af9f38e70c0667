//! Lit edges cut into cells, each a path with its node on the edge.

use crate::edges::edge_scattering::part_amplitudes;
use crate::edges::lit_edge::EdgeJoint;
use crate::edges::truncation::{Truncation, truncation_amplitudes};
use crate::frame::cells::path_cells::{
    Cell, CellKind, CellSettings, as_area_m2, facets_of, joined, motions, padded, reversed,
};
use crate::integral::node::Estimate;
use crate::joins::joint::Reverse;
use crate::joins::scatterer::Scatterer;
use artifact::paths::Amplitude;
use glam::DVec3;
use rayon::prelude::*;

/// Cells of all joints, the reverse ones behind their own; in the order of the joints.
pub(crate) fn edge_cells(
    scatterer: &Scatterer<'_>,
    joints: &[EdgeJoint],
    settings: &CellSettings<'_>,
) -> Vec<Cell> {
    joined(joints.par_iter().map(|joint| cells_of(scatterer, joint, settings)).collect())
}

/// Cells of own edges of double reflections, as [`edge_cells`] has them.
pub(crate) fn truncation_cells(
    scatterer: &Scatterer<'_>,
    truncations: &[Truncation],
    settings: &CellSettings<'_>,
) -> Vec<Cell> {
    let of = |end: &Truncation| {
        let line = CutLine {
            ends: (end.forward, end.backward),
            span_m: [0.0, end.length_m()],
            reverse: end.reverse,
        };
        line.cells(scatterer, settings, |span_m, accuracy| {
            truncation_amplitudes(scatterer, end, span_m, settings.wavenumbers_per_m, accuracy)
        })
    };
    joined(truncations.par_iter().map(of).collect())
}

fn cells_of(scatterer: &Scatterer<'_>, joint: &EdgeJoint, settings: &CellSettings<'_>) -> Vec<Cell> {
    let line =
        CutLine { ends: (joint.forward, joint.backward), span_m: joint.span_m, reverse: joint.reverse };
    line.cells(scatterer, settings, |span_m, accuracy| {
        part_amplitudes(scatterer, joint, span_m, settings.wavenumbers_per_m, accuracy)
    })
}

/// A line that is cut into cells.
struct CutLine {
    /// Beams of the transmitter and of the receiver that lead to it.
    ends: (u32, u32),
    span_m: [f64; 2],
    reverse: Reverse,
}

impl CutLine {
    /// Its cells, by the amplitudes of a part about the part's middle.
    fn cells(
        &self,
        scatterer: &Scatterer<'_>,
        settings: &CellSettings<'_>,
        amplitudes: impl Fn([f64; 2], f64) -> (DVec3, Estimate<Vec<Amplitude>>),
    ) -> Vec<Cell> {
        let (forward, backward) = self.ends;
        let facets = facets_of(scatterer, forward, backward);
        let accuracy = settings.accuracy_of_body[scatterer.node_body(forward)];
        let [from, to] = self.span_m;
        let count = ((to - from) / settings.side_m(scatterer.world, &facets)).ceil().max(1.0);
        let place = |i: u32| from + (to - from) * f64::from(i) / count;
        let mut cells = Vec::new();
        for i in 0..count as u32 {
            if !settings.room.take(self.reverse.ways()) {
                break;
            }
            let span_m = [place(i), place(i + 1)];
            let (middle_m, estimate) = amplitudes(span_m, accuracy);
            cells.push(Cell {
                order: facets.len() as u8,
                facets: padded(&facets),
                apparent_m: scatterer.legs(forward, backward).map(|leg| leg.mirrors.unfolded(middle_m)),
                motion: motions(scatterer, forward, backward, middle_m),
                amplitudes_m: estimate.value,
                area_m2: as_area_m2(span_m[1] - span_m[0], settings),
                error_m: estimate.error,
                kind: CellKind::PolygonPart,
                side: None,
            });
        }
        if self.reverse == Reverse::Included {
            let back: Vec<Cell> = cells.iter().map(reversed).collect();
            cells.extend(back);
        }
        cells
    }
}
