//! Inputs of the networks over range cells: quantities of each cell from before the leading edge on, and
//! quantities of the whole signature, each scaled to about ±1.

use artifact::model::ProfileShape;
use artifact::signature::{Signature, SignatureCell};

/// Number of range cells: 23 m of cells of 24 cm, an articulated vehicle.
pub(crate) const CELLS: usize = 96;
/// Cells before the object's nearest point.
const CELLS_BEFORE: i64 = 4;
/// Quantities of a cell.
pub(crate) const OF_CELLS: [&str; 7] = [
    "level_over_noise",
    "cross_section",
    "is_visible",
    "place_across",
    "height",
    "coherence",
    "is_of_another_object",
];
/// Quantities of the whole signature.
pub(crate) const OF_OBJECT: [&str; 11] = [
    "range",
    "azimuth_magnitude",
    "approaches_or_recedes",
    "beam_across",
    "beam_above",
    "has_rows",
    "radar_height",
    "noise",
    "ghost_share",
    "range_extent",
    "points",
];
/// Number of inputs.
pub(crate) const INPUTS: usize = CELLS * OF_CELLS.len() + OF_OBJECT.len();

/// Least level over the noise of a cell whose quantities are told, dB.
const VISIBLE_DB: f32 = 8.0;

/// Shape of the inputs, for a model's header.
pub(crate) fn shape() -> ProfileShape {
    let named = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    ProfileShape { cells: CELLS as u32, of_cells: named(&OF_CELLS), of_object: named(&OF_OBJECT) }
}

/// Inputs of a signature: `[quantity, cell]` of [`OF_CELLS`], then [`OF_OBJECT`]; all are finite.
pub(crate) fn inputs(signature: &Signature) -> Vec<f32> {
    let mut all = vec![0.0; INPUTS];
    let before = (signature.range_extent_m[0] - signature.first_range_m) / signature.cell_m;
    let first = before.round() as i64 - CELLS_BEFORE;
    for column in 0..CELLS {
        let number = first.saturating_add(column as i64);
        let cell = usize::try_from(number).ok().and_then(|number| signature.cells.get(number));
        if let Some(cell) = cell {
            for (quantity, value) in of_cell(cell, signature.noise_dbsm as f32).into_iter().enumerate() {
                all[quantity * CELLS + column] = value;
            }
        }
    }
    all[CELLS * OF_CELLS.len()..].copy_from_slice(&of_object(signature));
    all.iter_mut().filter(|value| !value.is_finite()).for_each(|value| *value = 0.0);
    all
}

fn of_cell(cell: &SignatureCell, noise_dbsm: f32) -> [f32; OF_CELLS.len()] {
    let level = cell.level_db.clamp(-5.0, 50.0) / 20.0;
    // A cell of another object has no level, and no direction that could explain one.
    if cell.level_db == 0.0 && cell.coherence == 0.0 {
        return [level, INVISIBLE, 0.0, 0.0, 0.0, 0.0, 1.0];
    }
    if cell.level_db <= VISIBLE_DB {
        return [level, INVISIBLE, 0.0, 0.0, 0.0, 0.0, 0.0];
    }
    let dbsm = (cell.level_db + noise_dbsm).clamp(-40.0, 30.0) / 20.0;
    let height = cell.height_m.map_or(0.0, |height| height.clamp(-2.0, 6.0) / 3.0);
    [level, dbsm, 1.0, cell.cross_m.clamp(-6.0, 6.0) / 3.0, height, cell.coherence, 0.0]
}

/// Cross section of cells that are not visible: −40 dBsm, scaled.
const INVISIBLE: f32 = -2.0;

fn of_object(signature: &Signature) -> [f32; OF_OBJECT.len()] {
    let [across, above] = signature.beams;
    let extent_m = signature.range_extent_m[1] - signature.range_extent_m[0];
    let all = [
        signature.range_m / 30.0 - 1.0,
        signature.azimuth_rad.abs(),
        if signature.radial_velocity_mps == 0.0 { 0.0 } else { signature.radial_velocity_mps.signum() },
        across.unwrap_or(0.0),
        above.unwrap_or(0.0),
        f64::from(u8::from(above.is_some())),
        signature.radar_height_m / 5.0 - 1.0,
        signature.noise_dbsm.clamp(-80.0, 40.0) / 20.0 + 2.0,
        signature.ghost_share.unwrap_or(0.0),
        extent_m.clamp(0.0, 25.0) / 5.0,
        f64::from(signature.points.max(1)).ln() / 3.0,
    ];
    all.map(|value| value as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signature() -> Signature {
        let dark = SignatureCell { coherence: 0.1, ..SignatureCell::default() };
        let mut cells = vec![dark; 40];
        cells[12] = SignatureCell {
            level_db: 30.0,
            cross_m: 1.5,
            height_m: Some(0.6),
            coherence: 0.9,
            velocity_spread_mps: 0.1,
        };
        cells[13] = SignatureCell::default();
        Signature {
            range_m: 32.0,
            noise_dbsm: -30.0,
            cell_m: 0.25,
            first_range_m: 27.0,
            range_extent_m: [30.0, 34.0],
            cells,
            ..Signature::default()
        }
    }

    #[test]
    fn the_nearest_point_is_in_the_fifth_cell_and_a_cell_of_another_object_is_marked() {
        let all = inputs(&signature());
        let of = |quantity: usize, cell: usize| all[quantity * CELLS + cell];
        let told: Vec<f32> = (0..OF_CELLS.len()).map(|quantity| of(quantity, 4)).collect();
        assert_eq!(told, [1.5, 0.0, 1.0, 0.5, 0.2, 0.9, 0.0]);
        assert_eq!([of(6, 5), of(2, 5), of(1, 5)], [1.0, 0.0, INVISIBLE]);
        assert_eq!([of(6, 6), of(2, 6), of(1, 6)], [0.0, 0.0, INVISIBLE]);
        assert_eq!((0..OF_CELLS.len()).map(|q| of(q, 40)).collect::<Vec<_>>(), [0.0; 7], "beyond the map");
        assert_eq!(all.len(), INPUTS);
    }

    #[test]
    fn whatever_is_in_a_signature_its_inputs_are_finite() {
        let mut odd = Signature { cell_m: 0.0, noise_dbsm: f64::NAN, range_m: f64::INFINITY, ..signature() };
        odd.cells[12].cross_m = f32::NAN;
        assert!(inputs(&odd).iter().all(|value| value.is_finite()));
        assert!(inputs(&Signature::default()).iter().all(|value| value.is_finite()));
    }
}
