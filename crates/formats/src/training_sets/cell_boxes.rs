//! Extents of boxes in cells of a range–azimuth–Doppler tensor.

use crate::azimuth_row::AZIMUTHS;
use crate::training_sets::truth_boxes::TruthBox;
use artifact::Radar;
use glam::DVec3;
use radar::beat::coupling_m;

/// Extent of a body along the axes of a tensor, each as least and greatest cell, fractional and at least one
/// cell apart: range from near to far, azimuth from left to right, Doppler from approaching to receding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CellBox {
    pub(crate) range: [f64; 2],
    pub(crate) azimuth: [f64; 2],
    pub(crate) doppler: [f64; 2],
}

/// The extent of a box; `None` if its middle is behind the antenna or beyond the range axis.
///
/// Velocities fold into the map's span as echoes do; a body whose velocities straddle an end of the span is
/// placed where its middle velocity folds to, and cut there. Range includes the map's range–Doppler coupling.
pub(crate) fn cell_box(radar: &Radar, body: &TruthBox) -> Option<CellBox> {
    let [right, ahead, _] = radar::aperture::axes(radar);
    let place_m = DVec3::from(radar.position_m);
    let middle = body.middle_m() - place_m;
    if ahead.dot(middle) <= 0.0 || middle.length() > radar.waveform.range_max_m() {
        return None;
    }
    let away = body.corners_m().map(|corner| corner - place_m);
    let nearest_m = (body.nearest_m(place_m) - place_m).length();
    let range_m = [nearest_m, extent(away.map(DVec3::length))[1]];
    let sine = extent(away.map(|way| right.dot(way) / way.length()));
    let velocity_mps = extent(away.map(|way| body.velocity_mps.dot(way) / way.length()));
    let shift_m = coupling_m(&radar.waveform, body.velocity_mps.dot(middle) / middle.length());
    let cells = radar.waveform.range_cells() as f64;
    let of_range = |range_m: f64| (range_m + shift_m) / radar.waveform.range_resolution_m();
    let of_sine = |sine: f64| 0.5 * (sine + 1.0) * AZIMUTHS as f64;
    Some(CellBox {
        range: within(range_m.map(of_range), cells),
        azimuth: within(sine.map(of_sine), AZIMUTHS as f64),
        doppler: within(folded(radar, velocity_mps), f64::from(radar.waveform.chirps)),
    })
}

/// Rows of velocities, shifted together by whole spans so that their middle is on the axis.
fn folded(radar: &Radar, velocity_mps: [f64; 2]) -> [f64; 2] {
    let rows = f64::from(radar.waveform.chirps);
    let row = velocity_mps.map(|v| v / radar.velocity_resolution_mps() + (rows / 2.0).floor());
    let spans = (0.5 * (row[0] + row[1]) / rows).floor();
    row.map(|row| row - spans * rows)
}

/// Widens an extent to at least one cell, within the axis.
fn within([low, high]: [f64; 2], cells: f64) -> [f64; 2] {
    let more = (0.5 * (1.0 - (high - low))).max(0.0);
    [(low - more).clamp(0.0, cells - 1.0), (high + more).clamp(0.0, cells - 1.0)]
}

fn extent(values: [f64; 8]) -> [f64; 2] {
    [values.into_iter().fold(f64::INFINITY, f64::min), values.into_iter().fold(f64::NEG_INFINITY, f64::max)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training_sets::test_body::bus;
    use radar::{aperture::Preset, paper};

    /// A bus from 44 to 56 m that approaches at 10 m/s, by hand.
    #[test]
    fn a_bus_covers_its_ranges_sines_and_velocities() {
        let radar = paper::radar([0.0, 0.0, 0.0], paper::waveform(256, 128), Preset::ThreeByFour.elements());
        let cells = cell_box(&radar, &bus()).unwrap();
        let resolution_m = radar.waveform.range_resolution_m();
        let shift_m = -0.0619 * resolution_m / resolution_m;
        let nearest_m = 44.0_f64.hypot(0.75);
        let farthest_m = (56.0_f64.powi(2) + 3.25_f64.powi(2) + 9.0).sqrt();
        assert!((cells.range[0] - (nearest_m + shift_m * 1.0) / resolution_m).abs() < 0.01, "{cells:?}");
        assert!((cells.range[1] - (farthest_m + shift_m) / resolution_m).abs() < 0.01, "{cells:?}");
        let sine = 3.25 / (44.0_f64.powi(2) + 3.25_f64.powi(2)).sqrt();
        assert!((cells.azimuth[1] - 128.0 * (1.0 + sine)).abs() < 1e-9, "{cells:?}");
        let row = |velocity: f64| velocity / radar.velocity_resolution_mps() + 64.0;
        assert!(cells.doppler[0] >= row(-10.0) - 0.5 && cells.doppler[1] <= row(-9.9) + 0.5, "{cells:?}");
        let behind = TruthBox { foot_m: DVec3::new(2.0, -50.0, 0.0), ..bus() };
        assert_eq!(cell_box(&radar, &behind), None);
        // A whole span faster it shows in the same cells of Doppler.
        let span = DVec3::new(0.0, -2.0 * radar.velocity_max_mps(), 0.0);
        let faster = TruthBox { velocity_mps: bus().velocity_mps + span, ..bus() };
        let there = cell_box(&radar, &faster).unwrap().doppler;
        assert!((there[0] - cells.doppler[0]).abs() < 0.5, "{there:?}");
    }
}
