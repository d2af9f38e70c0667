//! Peaks in range, velocity and direction jointly, where the power summed over channels shows only a slope.
//!
//! Bodies abreast at one velocity, whose fronts are a cell or two apart in range, lie under one main lobe of
//! the map: the stronger is the peak, the others lie on its slope. A beam towards one of them suppresses the
//! others, and in it the cell is the local maximum. Its power must exceed the main lobes and sidelobes of
//! stronger echoes in the same beam.

use crate::detection::peaks::{Finding, Peak, PeakFinder};
use crate::direction::angle::{Direction, VirtualArray};
use artifact::rdm::RdmFrame;
use num_complex::Complex64;
use rayon::prelude::*;

/// A map seen through its array.
pub(crate) struct BeamformedMap<'a> {
    pub(crate) map: &'a RdmFrame,
    pub(crate) array: &'a VirtualArray,
    pub(crate) finder: &'a PeakFinder,
}

impl BeamformedMap<'_> {
    /// Additional peaks on the slopes of `peaks`, strongest first; `slopes` are detected cells and the peak
    /// on whose slope each lies, `velocities_mps` the likeliest velocities of the peaks where folds are
    /// observable: only the right one gives a beam over the slots of the transmitters.
    pub(crate) fn on_slopes(
        &self,
        slopes: &[([usize; 2], usize)],
        peaks: &[Peak],
        velocities_mps: &[Option<f64>],
    ) -> Vec<Peak> {
        if !self.array.beams().iter().any(|beam| beam.is_finite()) {
            return vec![];
        }
        let is_summit = |cell: [usize; 2], peak: usize| cell == [peaks[peak].row, peaks[peak].column];
        let own = |(cell, peak): &([usize; 2], usize)| {
            let summit = (&peaks[*peak], velocities_mps[*peak]);
            (!is_summit(*cell, *peak)).then(|| self.own_peak(*cell, summit, peaks)).flatten()
        };
        let mut found: Vec<Peak> = slopes.par_iter().filter_map(own).collect();
        found.sort_by(|a, b| b.power.total_cmp(&a.power).then((a.row, a.column).cmp(&(b.row, b.column))));
        found
    }

    fn own_peak(
        &self,
        cell: [usize; 2],
        (summit, summit_mps): (&Peak, Option<f64>),
        peaks: &[Peak],
    ) -> Option<Peak> {
        let beam = Beam::strongest(self, cell, summit_mps);
        let power = beam.power(self, cell);
        let is_highest = self.array.cells().cells.around(cell).all(|other| power > beam.power(self, other));
        (is_highest && power > self.leaked(&beam, cell, peaks)).then(|| self.placed(&beam, cell, summit))
    }

    /// Maximum power that all peaks together may leave in a cell of this beam.
    fn leaked(&self, beam: &Beam, cell: [usize; 2], peaks: &[Peak]) -> f64 {
        let of = |peak: &Peak| self.finder.leak(peak, cell) * beam.power(self, [peak.row, peak.column]);
        crate::detection::peaks::LEAKAGE_MARGIN * peaks.iter().map(of).sum::<f64>()
    }

    fn placed(&self, beam: &Beam, [row, column]: [usize; 2], summit: &Peak) -> Peak {
        let power = beam.power(self, [row, column]) / beam.steering.len() as f64;
        let offsets = self.finder.offsets([row, column], |cell| beam.value(self, cell));
        Peak {
            row,
            column,
            fine_row: row as f64 + offsets[0],
            fine_column: column as f64 + offsets[1],
            power,
            cells: summit.cells,
            finding: Finding::Detected,
            summit: [summit.row, summit.column],
        }
    }
}

/// A beam of the array in one direction, for cells around one velocity.
struct Beam {
    steering: Vec<Complex64>,
    velocity_mps: f64,
}

impl Beam {
    /// The strongest beam in a cell, at the fold of its velocity that is nearest to its summit's if known.
    fn strongest(view: &BeamformedMap<'_>, cell: [usize; 2], summit_mps: Option<f64>) -> Self {
        let axes = view.array.cells();
        let shown_mps = axes.velocity_at(cell[0] as f64);
        let velocity_mps =
            summit_mps.map_or(axes.wrapped(shown_mps), |summit_mps| axes.unwrapped(shown_mps, summit_mps));
        let range_m = axes.range_of(cell[1] as f64, velocity_mps);
        let snapshot = view.array.snapshot(view.map, cell, velocity_mps);
        let direction: Direction = view.array.direction(&[snapshot], range_m);
        Self { steering: view.array.steering(direction, range_m), velocity_mps }
    }

    fn value(&self, view: &BeamformedMap<'_>, cell: [usize; 2]) -> Complex64 {
        view.array.beam(&view.array.snapshot(view.map, cell, self.velocity_mps), &self.steering)
    }

    fn power(&self, view: &BeamformedMap<'_>, cell: [usize; 2]) -> f64 {
        self.value(view, cell).norm_sqr()
    }
}
