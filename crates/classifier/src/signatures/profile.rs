//! Cells of a signature above the noise, with distances behind the leading edge and cross sections.

use artifact::signature::{Signature, SignatureCell};
use artifact::units::power_from_db;

/// Least level over the noise of a visible cell, dB: one in 10⁷ cells of noise is higher (e⁻¹⁶).
pub(crate) const VISIBLE_DB: f64 = 12.0;
/// Least level over the noise of a cell with a usable direction, dB: to a tenth of a beam.
pub(crate) const LOCATED_DB: f64 = 20.0;

/// One visible cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct VisibleCell {
    /// Index of the cell in the signature.
    pub(crate) number: usize,
    /// Distance behind the object's nearest point, m.
    pub(crate) behind_m: f64,
    pub(crate) level_db: f64,
    /// Cross section, dBsm and m².
    pub(crate) dbsm: f64,
    pub(crate) rcs_m2: f64,
    /// Share of the total.
    pub(crate) share: f64,
    pub(crate) cross_m: f64,
    pub(crate) height_m: f64,
    pub(crate) coherence: f64,
    pub(crate) velocity_spread_mps: f64,
}

/// Visible cells of a signature, with their total.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Profile {
    pub(crate) cell_m: f64,
    /// Whether the array measures heights.
    pub(crate) has_rows: bool,
    /// Levels over the noise of every cell, visible or not, dB.
    pub(crate) levels_db: Vec<f64>,
    pub(crate) noise_dbsm: f64,
    /// Visible cells in order.
    pub(crate) visible: Vec<VisibleCell>,
    /// Cross section of all visible cells, m².
    pub(crate) total_m2: f64,
}

impl Profile {
    pub(crate) fn of(signature: &Signature) -> Self {
        let cells = signature.cells.iter().enumerate();
        let mut visible: Vec<VisibleCell> = cells
            .filter(|(_, cell)| f64::from(cell.level_db) >= VISIBLE_DB)
            .map(|(number, cell)| visible_cell(signature, number, cell))
            .collect();
        let total_m2: f64 = visible.iter().map(|cell| cell.rcs_m2).sum();
        visible.iter_mut().for_each(|cell| cell.share = cell.rcs_m2 / total_m2);
        Self {
            cell_m: signature.cell_m,
            has_rows: signature.beams[1].is_some(),
            levels_db: signature.cells.iter().map(|cell| f64::from(cell.level_db)).collect(),
            noise_dbsm: signature.noise_dbsm,
            visible,
            total_m2,
        }
    }

    /// Cells with a usable direction.
    pub(crate) fn located(&self) -> impl Iterator<Item = &VisibleCell> + Clone {
        self.visible.iter().filter(|cell| cell.level_db >= LOCATED_DB)
    }

    /// Mean over visible cells, weighted by power; 0 without any.
    pub(crate) fn mean(&self, value: impl Fn(&VisibleCell) -> f64) -> f64 {
        self.visible.iter().map(|cell| cell.share * value(cell)).sum()
    }
}

fn visible_cell(signature: &Signature, number: usize, cell: &SignatureCell) -> VisibleCell {
    let level_db = f64::from(cell.level_db);
    let dbsm = level_db + signature.noise_dbsm;
    VisibleCell {
        number,
        behind_m: signature.first_range_m + number as f64 * signature.cell_m - signature.range_extent_m[0],
        level_db,
        dbsm,
        rcs_m2: power_from_db(dbsm),
        share: 0.0,
        cross_m: f64::from(cell.cross_m),
        height_m: cell.height_m.map_or(0.0, f64::from),
        coherence: f64::from(cell.coherence),
        velocity_spread_mps: f64::from(cell.velocity_spread_mps),
    }
}
