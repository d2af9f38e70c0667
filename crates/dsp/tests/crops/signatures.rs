//! Signatures of objects: levels of the radar equation, places across, heights, and what is left out of them.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Sampling};
use artifact::signature::{Signature, SignatureCell};
use dsp::{DspError, Receiver};

fn noisy(elements: [Vec<[f64; 2]>; 2]) -> CubeHeader {
    let mut header = header(256, 128, elements);
    header.noise = NOISE_12_DB;
    header
}

/// Signature of the one object that these targets are.
fn signature(header: &CubeHeader, targets: &[Target]) -> Signature {
    let receiver = Receiver::new(header).unwrap();
    let mut cube = cube(header, targets, 1);
    if header.radar.waveform.sampling == Sampling::Real {
        cube.samples.iter_mut().for_each(|sample| sample.im = 0.0);
    }
    let map = receiver.range_doppler(&cube).unwrap();
    let points = receiver.detect(&map).unwrap();
    assert_eq!(points.objects.len(), 1, "{:?}", points.objects);
    receiver.signatures(&map).unwrap().of(&points, 0).unwrap()
}

fn strongest(signature: &Signature) -> (usize, SignatureCell) {
    let level = |cell: &SignatureCell| cell.level_db;
    let cells = signature.cells.iter().copied().enumerate();
    cells.max_by(|a, b| level(&a.1).total_cmp(&level(&b.1))).unwrap()
}

#[test]
fn a_point_stands_in_its_cell_with_its_own_cross_section_at_any_range_and_by_any_multiplexing() {
    use Multiplexing::{Bpm, Ddm, Simultaneous, Tdm};
    let complex = [Simultaneous, Tdm, Ddm, Bpm].map(|multiplexing| (multiplexing, Sampling::Complex));
    let real = [Simultaneous, Tdm].map(|multiplexing| (multiplexing, Sampling::Real));
    for (multiplexing, sampling) in complex.into_iter().chain(real) {
        // Real samples tell ranges to 30.7 m.
        let ranges_m = if sampling == Sampling::Real { [15.0, 20.0, 25.0] } else { [25.0, 40.0, 60.0] };
        for (range_m, rcs_m2) in ranges_m.into_iter().zip([1.0, 10.0, 100.0]) {
            let mut header = noisy(elements_3x4());
            header.radar.array.multiplexing = multiplexing;
            header.radar.waveform.sampling = sampling;
            // On the centre of a velocity cell of every multiplexing, and of a range cell: windows take
            // nothing off there.
            let cell_m = header.radar.waveform.range_resolution_m();
            let ahead_m = (range_m / cell_m).round() * cell_m;
            let found = signature(&header, &[target([0.0, ahead_m, 6.0], [0.0, 0.0, 0.0], rcs_m2)]);
            let (at, cell) = strongest(&found);
            let dbsm = f64::from(cell.level_db) + found.noise_dbsm;
            let expected = 10.0 * f64::log10(rcs_m2);
            // Noise 25 dB below the echo or more turns it by 0.5 dB at most.
            assert!(
                (dbsm - expected).abs() < 0.6,
                "{multiplexing:?}, {sampling:?}, {range_m} m: {dbsm:.2} dBsm for {expected}"
            );
            let place_m = found.first_range_m + at as f64 * found.cell_m;
            assert!((place_m - ahead_m).abs() < 0.5 * cell_m, "{place_m} {ahead_m}");
            assert!(cell.coherence > 0.95 && cell.cross_m.abs() < 0.5, "{cell:?}");
        }
    }
}

#[test]
fn the_gain_of_the_pattern_is_taken_out() {
    let mut header = noisy(elements_3x4());
    let at = |header: &CubeHeader| {
        let found = signature(header, &[target([10.0, 38.0, 0.75], [0.0, -6.1, 0.0], 100.0)]);
        (f64::from(strongest(&found).1.level_db), found.noise_dbsm)
    };
    let (level_db, noise_dbsm) = at(&header);
    header.radar.array.pattern = artifact::radar::Pattern::Cosine { exponent: 3.0 };
    let (lower_db, higher_dbsm) = at(&header);
    // The cube of these tests knows no pattern, so the level stays and the cross section grows by what the
    // pattern would take.
    let taken_db = -20.0 * 2.0 * 3.0 * (38.0 / 10.0_f64.hypot(38.0).hypot(5.25)).log10();
    assert!((lower_db - level_db).abs() < 1e-9 && (higher_dbsm - noise_dbsm - taken_db).abs() < 0.02);
}

#[test]
fn places_across_and_heights_are_those_of_the_cells() {
    let header = noisy(elements_6x8());
    let parts = [[1.0, 36.0, 0.5], [2.0, 38.0, 3.0]].map(|p| target(p, [0.0, -6.1, 0.0], 10.0));
    let found = signature(&header, &parts);
    let near = |ahead_m: f64, right_m: f64, up_m: f64| {
        let range_m = (right_m.powi(2) + ahead_m.powi(2) + (6.0 - up_m).powi(2)).sqrt();
        found.cells[((range_m - found.first_range_m) / found.cell_m).round() as usize]
    };
    let (first, second) = (near(36.0, 1.0, 0.5), near(38.0, 2.0, 3.0));
    assert!((first.height_m.unwrap() - 0.5).abs() < 0.25 && (second.height_m.unwrap() - 3.0).abs() < 0.25);
    // Across the line of sight to the object, which lies 1.5 m to the right at 37 m: 2 m of depth come to
    // 0.08 m.
    assert!((second.cross_m - first.cross_m - 0.92).abs() < 0.25, "{first:?} {second:?}");
    let without_rows = signature(&noisy(elements_3x4()), &parts[..1]);
    assert!(without_rows.cells.iter().all(|cell| cell.height_m.is_none()) && without_rows.beams[1].is_none());
}

#[test]
fn cells_of_another_object_are_left_out() {
    let header = noisy(elements_3x4());
    let weak = target([5.75, 38.3, 0.75], [0.0, -6.1, 0.0], 10.0);
    let strong = target([2.0, 42.0, 0.75], [0.0, -7.0, 0.0], 10_000.0);
    let alone = signature(&header, &[weak]);
    let receiver = Receiver::new(&header).unwrap();
    let map = receiver.range_doppler(&cube(&header, &[weak, strong], 1)).unwrap();
    let points = receiver.detect(&map).unwrap();
    assert_eq!(points.objects.len(), 2);
    let signatures = receiver.signatures(&map).unwrap();
    let own = u32::from(points.objects[0].snr_db > points.objects[1].snr_db);
    let among = signatures.of(&points, own).unwrap();
    let (level, expected) = (strongest(&among), strongest(&alone));
    assert!(
        level.0 == expected.0 && (level.1.level_db - expected.1.level_db).abs() < 0.5,
        "{level:?} {expected:?}"
    );
    let neighbour = signatures.of(&points, 1 - own).unwrap();
    assert!(strongest(&neighbour).1.level_db > level.1.level_db + 20.0);
    assert_eq!(signatures.of(&points, 2), Err(DspError::NoSuchObject { object: 2 }));
}
