//! Waves between two bodies are told from direct echoes by the directions that they leave and come by.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::seed::key;
use dsp::angle::VirtualArray;
use dsp::two_ways;
use glam::DVec3;
use num_complex::Complex64;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

struct Site {
    header: CubeHeader,
    array: VirtualArray,
    random: ChaCha8Rng,
}

impl Site {
    fn new(elements: [Vec<[f64; 2]>; 2], seed: u64) -> Self {
        let header = header(64, 16, elements);
        let array = VirtualArray::new(&header);
        Self { header, array, random: ChaCha8Rng::from_seed(key(seed, "dsp/test-ghosts", &[])) }
    }

    fn uniform(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * f64::from(self.random.next_u32()) / 2f64.powi(32)
    }

    /// Unit noise on every channel.
    fn noise(&mut self) -> Vec<Complex64> {
        let array = &self.header.radar.array;
        let channels = array.tx_m.len() * array.rx_m.len();
        let mut part = || FRAC_1_SQRT_2 * Distribution::<f64>::sample(&StandardNormal, &mut self.random);
        (0..channels).map(|_| Complex64::new(part(), part())).collect()
    }

    /// Adds a wave from each transmit element over `out` and back over `back` to each receive element, by
    /// exact lengths.
    fn add(&self, values: &mut [Complex64], amplitude: Complex64, out: DVec3, back: DVec3) {
        let (radar, wavelength_m) = (&self.header.radar, self.header.radar.waveform.wavelength_m());
        let centre = DVec3::from(radar.position_m);
        let from_centre_m = out.distance(centre) + back.distance(centre);
        for (i, tx) in radar.array.tx_m.iter().enumerate() {
            for (j, rx) in radar.array.rx_m.iter().enumerate() {
                let length_m = out.distance(DVec3::from(*tx)) + back.distance(DVec3::from(*rx));
                let turn = Complex64::from_polar(1.0, TAU * (length_m - from_centre_m) / wavelength_m);
                values[i * radar.array.rx_m.len() + j] += amplitude * turn;
            }
        }
    }

    /// A place on the road.
    fn place(&self, azimuth_deg: f64, range_m: f64) -> DVec3 {
        let (sin, cos) = azimuth_deg.to_radians().sin_cos();
        DVec3::from(self.header.radar.position_m) + range_m * DVec3::new(sin, cos, 0.0)
    }

    /// Cosines of what is found in a cell.
    fn found(&self, values: &[Complex64], range_m: f64) -> Option<[f64; 2]> {
        let direct = self.array.direction(&[values.to_vec()], range_m);
        two_ways(&self.array, values, range_m, direct, 1.0).map(|two| two.directions.map(|d| d.right))
    }

    fn amplitude(&mut self, snr_db: f64) -> Complex64 {
        Complex64::from_polar(10f64.powf(snr_db / 20.0), self.uniform(0.0, TAU))
    }
}

/// Of `trials` cells the share that is marked.
fn marked(site: &mut Site, trials: u32, cell: impl Fn(&mut Site) -> (Vec<Complex64>, f64)) -> f64 {
    let hits = (0..trials).filter(|_| {
        let (values, range_m) = cell(site);
        site.found(&values, range_m).is_some()
    });
    hits.count() as f64 / f64::from(trials)
}

/// Echoes of single bodies, each by itself, any phases, within so many metres across at 30 m.
fn direct(site: &mut Site, echoes: usize, snr_db: f64, across_m: f64) -> (Vec<Complex64>, f64) {
    let (mut values, middle_deg) = (site.noise(), site.uniform(-30.0, 30.0));
    for _ in 0..echoes {
        let aside_deg = (site.uniform(-0.5, 0.5) * across_m / 30.0).to_degrees();
        let (place, amplitude) = (site.place(middle_deg + aside_deg, 30.0), site.amplitude(snr_db));
        site.add(&mut values, amplitude, place, place);
    }
    (values, 30.0)
}

/// A wave between two bodies so many beams apart, both ways round.
fn ghost(site: &mut Site, snr_db: f64, beams: f64) -> (Vec<Complex64>, f64, [f64; 2]) {
    let mut values = site.noise();
    let middle = site.uniform(-0.3, 0.3);
    let cosines = [-0.5, 0.5].map(|side| middle + side * beams * site.array.beams()[0]);
    let ranges_m = [site.uniform(20.0, 50.0), site.uniform(20.0, 50.0)];
    let places = [0, 1].map(|i| site.place(cosines[i].asin().to_degrees(), ranges_m[i]));
    let amplitude = site.amplitude(snr_db);
    site.add(&mut values, amplitude, places[0], places[1]);
    site.add(&mut values, amplitude, places[1], places[0]);
    let apart_m = places[0].distance(places[1]);
    (values, 0.5 * (ranges_m[0] + ranges_m[1] + apart_m), cosines)
}

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

/// Without two transmit elements, or two receive elements, departure and arrival cannot be told apart.
#[test]
fn an_array_with_a_single_transmitter_marks_nothing() {
    let mut site = Site::new(elements_1x4(), 4);
    assert_eq!(marked(&mut site, 100, ghost_cell), 0.0);
}

fn ghost_cell(site: &mut Site) -> (Vec<Complex64>, f64) {
    let (values, range_m, _) = ghost(site, 30.0, 1.0);
    (values, range_m)
}

#[test]
#[ignore = "a study: writes the tables of docs/validation/ghosts.md"]
fn study() {
    for (name, elements, trials) in
        [("3 × 4", elements_3x4(), 1000), ("6 × 8", elements_6x8(), 300), ("12 × 16", elements_12x16(), 40)]
    {
        let mut site = Site::new(elements, 5);
        println!(
            "\n{name}, beams of {:.3}\n\n| dB a channel | 0.5 | 0.7 | 1 | 2 | 4 |\n|---|---|---|---|---|---|",
            site.array.beams()[0]
        );
        for snr_db in [-5.0, 0.0, 5.0, 10.0, 20.0, 30.0] {
            let of = |site: &mut Site, beams: f64| {
                100.0
                    * marked(site, trials, |site| {
                        let (values, range_m, _) = ghost(site, snr_db, beams);
                        (values, range_m)
                    })
            };
            let row: Vec<String> =
                [0.5, 0.7, 1.0, 2.0, 4.0].map(|b| format!("{:.0} %", of(&mut site, b))).into();
            println!("| {snr_db} | {} |", row.join(" | "));
        }
        println!("\n| direct echoes within 30 m · | 1 | 2 | 3 | 8 | 20 |\n|---|---|---|---|---|---|");
        for across_m in [1.0, 2.0, 8.0] {
            let of = |site: &mut Site, echoes: usize| {
                100.0 * marked(site, trials, |site| direct(site, echoes, 20.0, across_m))
            };
            let row: Vec<String> = [1, 2, 3, 8, 20].map(|n| format!("{:.1} %", of(&mut site, n))).into();
            println!("| {across_m} m | {} |", row.join(" | "));
        }
    }
}
