//! Cells that hold waves between two bodies, or several direct echoes, by exact lengths between elements and
//! bodies.

use super::common::*;
use artifact::cube::CubeHeader;
use artifact::seed::key;
use dsp::angle::VirtualArray;
use dsp::multipath_ghost;
use glam::DVec3;
use num_complex::Complex64;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

pub(crate) struct Site {
    header: CubeHeader,
    pub(crate) array: VirtualArray,
    random: ChaCha8Rng,
}

impl Site {
    pub(crate) fn new(elements: [Vec<[f64; 2]>; 2], seed: u64) -> Self {
        let header = header(64, 16, elements);
        let array = VirtualArray::new(&header);
        Self { header, array, random: ChaCha8Rng::from_seed(key(seed, "dsp/test-ghosts", &[])) }
    }

    pub(crate) fn uniform(&mut self, from: f64, to: f64) -> f64 {
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
    pub(crate) fn found(&self, values: &[Complex64], range_m: f64) -> Option<[f64; 2]> {
        let direct = self.array.direction(&[values.to_vec()], range_m);
        multipath_ghost(&self.array, values, range_m, direct, 1.0).map(|two| two.directions.map(|d| d.right))
    }

    fn amplitude(&mut self, snr_db: f64) -> Complex64 {
        Complex64::from_polar(10f64.powf(snr_db / 20.0), self.uniform(0.0, TAU))
    }
}

/// Share of `trials` cells that is marked.
pub(crate) fn marked(site: &mut Site, trials: u32, cell: impl Fn(&mut Site) -> (Vec<Complex64>, f64)) -> f64 {
    let hits = (0..trials).filter(|_| {
        let (values, range_m) = cell(site);
        site.found(&values, range_m).is_some()
    });
    hits.count() as f64 / f64::from(trials)
}

/// Echoes of single bodies, each by itself, any phases, within so many metres across at 30 m.
pub(crate) fn direct(site: &mut Site, echoes: usize, snr_db: f64, across_m: f64) -> (Vec<Complex64>, f64) {
    let (mut values, middle_deg) = (site.noise(), site.uniform(-30.0, 30.0));
    for _ in 0..echoes {
        let aside_deg = (site.uniform(-0.5, 0.5) * across_m / 30.0).to_degrees();
        let (place, amplitude) = (site.place(middle_deg + aside_deg, 30.0), site.amplitude(snr_db));
        site.add(&mut values, amplitude, place, place);
    }
    (values, 30.0)
}

/// A wave between two bodies so many beams apart, both ways round.
pub(crate) fn ghost(site: &mut Site, snr_db: f64, beams: f64) -> (Vec<Complex64>, f64, [f64; 2]) {
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
