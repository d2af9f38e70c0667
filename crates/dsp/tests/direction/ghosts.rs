//! Waves between two bodies are told from direct echoes by the directions that they leave and come by.

use crate::common::*;
use crate::ghost_cells::{Site, direct, ghost, marked};
use num_complex::Complex64;

#[test]
fn a_lone_echo_is_no_ghost_however_strong() {
    for (name, elements) in [("3 × 4", elements_3x4()), ("12 × 16", elements_12x16())] {
        let trials = if name == "3 × 4" { 2000 } else { 50 };
        let mut site = Site::new(elements, 1);
        let share = marked(&mut site, trials, |site| {
            let snr_db = site.uniform(0.0, 50.0);
            direct(site, 1, snr_db, 0.0)
        });
        println!("{name}: {share} of lone echoes are marked");
        // At a rate of 1e-4 more than two of 2,000 are as likely as 1 in 900.
        assert!(share * f64::from(trials) <= 2.0);
    }
}

#[test]
fn a_wave_between_two_bodies_is_marked_with_both_directions() {
    let mut site = Site::new(elements_3x4(), 2);
    for (beams, least) in [(1.0, 0.9), (2.0, 0.9), (4.0, 0.9)] {
        let (mut hits, mut square, trials) = (0, 0.0, 300);
        for _ in 0..trials {
            let (values, range_m, truth) = ghost(&mut site, 20.0, beams);
            if let Some(mut found) = site.found(&values, range_m) {
                found.sort_by(f64::total_cmp);
                hits += 1;
                square += (0..2).map(|i| (found[i] - truth[i]).powi(2)).sum::<f64>();
            }
        }
        let (share, rms) = (f64::from(hits) / f64::from(trials), (square / (2.0 * f64::from(hits))).sqrt());
        println!("{beams} beams apart, 20 dB a channel: {share:.3} marked, cosines within {rms:.4} rms");
        assert!(share >= least);
        // A quarter of a beam; near ranges that differ by tens of metres curve the wave as one distance does
        // not.
        assert!(rms < 0.25 * site.array.beams()[0], "{rms}");
    }
}

#[test]
fn several_direct_echoes_in_a_cell_are_hardly_ever_a_ghost() {
    let mut site = Site::new(elements_3x4(), 3);
    for echoes in [2, 3, 8] {
        for across_m in [1.0, 2.0, 8.0] {
            let share = marked(&mut site, 500, |site| direct(site, echoes, 20.0, across_m));
            println!("{echoes} echoes within {across_m} m at 30 m: {share:.3} marked");
            assert!(share <= 0.02, "{echoes} echoes within {across_m} m: {share}");
        }
    }
}

/// Departure and arrival cannot be told apart without two transmit elements, or two receive elements.
#[test]
fn an_array_with_a_single_transmitter_marks_nothing() {
    let mut site = Site::new(elements_1x4(), 4);
    assert_eq!(marked(&mut site, 100, ghost_cell), 0.0);
}

fn ghost_cell(site: &mut Site) -> (Vec<Complex64>, f64) {
    let (values, range_m, _) = ghost(site, 30.0, 1.0);
    (values, range_m)
}
