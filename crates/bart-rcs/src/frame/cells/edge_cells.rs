//! Lit edges cut into cells: paths with their nodes on the edge, or on those where waves over faces end.

use crate::edges::edge_scattering::{EdgeWave, part_waves};
use crate::edges::lit_edge::EdgeJoint;
use crate::edges::truncation::{Truncation, truncation_amplitudes};
use crate::frame::cells::path_cells::{
    Cell, CellKind, CellSettings, as_area_m2, facets_of, joined, motions, padded, reversed,
};
use crate::joins::joint::Reverse;
use crate::joins::scatterer::Scatterer;
use artifact::paths::Facet;
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
        line.cells(scatterer, settings, |span_m, _, accuracy| {
            let (middle_m, estimate) =
                truncation_amplitudes(scatterer, end, span_m, settings.wavenumbers_per_m, accuracy);
            vec![EdgeWave::at(middle_m, estimate)]
        })
    };
    joined(truncations.par_iter().map(of).collect())
}

fn cells_of(scatterer: &Scatterer<'_>, joint: &EdgeJoint, settings: &CellSettings<'_>) -> Vec<Cell> {
    let line =
        CutLine { ends: (joint.forward, joint.backward), span_m: joint.span_m, reverse: joint.reverse };
    line.cells(scatterer, settings, |span_m, size_m, accuracy| {
        part_waves(scatterer, joint, span_m, (settings.wavenumbers_per_m, size_m), accuracy)
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
    /// Its cells, by the waves of each part: of a span, for the largest side of a cell and an accuracy.
    fn cells(
        &self,
        scatterer: &Scatterer<'_>,
        settings: &CellSettings<'_>,
        waves: impl Fn([f64; 2], f64, f64) -> Vec<EdgeWave>,
    ) -> Vec<Cell> {
        let (forward, backward) = self.ends;
        let facets = facets_of(scatterer, forward, backward);
        let accuracy = settings.accuracy_of_body[scatterer.node_body(forward)];
        let [from, to] = self.span_m;
        let size_m = settings.side_m(scatterer.world, &facets);
        let count = ((to - from) / size_m).ceil().max(1.0);
        let place = |i: u32| from + (to - from) * f64::from(i) / count;
        let mut cells = Vec::new();
        for i in 0..count as u32 {
            let span_m = [place(i), place(i + 1)];
            for wave in waves(span_m, size_m, accuracy) {
                if !settings.room.take(self.reverse.ways()) {
                    return cells;
                }
                cells.push(self.cell(scatterer, settings, (&facets, span_m), wave));
            }
        }
        if self.reverse == Reverse::Included {
            let back: Vec<Cell> = cells.iter().map(reversed).collect();
            cells.extend(back);
        }
        cells
    }

    fn cell(
        &self,
        scatterer: &Scatterer<'_>,
        settings: &CellSettings<'_>,
        (facets, [from_m, to_m]): (&[Facet], [f64; 2]),
        wave: EdgeWave,
    ) -> Cell {
        let (forward, backward) = self.ends;
        let [transmit, receive] = scatterer.legs(forward, backward);
        let [arriving_m, leaving_m] = wave.nodes_m;
        Cell {
            order: facets.len() as u8,
            facets: padded(facets),
            apparent_m: [transmit.mirrors.unfolded(wave.ends_m[0]), receive.mirrors.unfolded(wave.ends_m[1])],
            motion: [
                motions(scatterer, forward, backward, arriving_m)[0],
                motions(scatterer, forward, backward, leaving_m)[1],
            ],
            amplitudes_m: wave.estimate.value,
            area_m2: as_area_m2(to_m - from_m, settings),
            error_m: wave.estimate.error,
            kind: CellKind::PolygonPart,
            side: None,
        }
    }
}
