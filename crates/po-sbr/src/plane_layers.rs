//! Reflection by plane layers from characteristic matrices (Born, Wolf, Principles of Optics, 1.6): the beam
//! tracer uses a recursion of reflections from the back, and the two share no formula.
//!
//! ```text
//! M = Π ½ [1 + P, (1 − P)/q; q(1 − P), 1 + P]     P = e^{−2jkds}     s = √(ε − sin²θ)     q = s (TE), s/ε (TM)
//! (b, c) = M·(what is behind)     r = (b·cosθ − c)/(b·cosθ + c)
//! ```
//! Coefficients are of E for TE and of H for TM; each matrix lacks its factor e^{jkds}, which would overflow
//! in thick lossy layers and does not affect r. Behind is (1, q) for a half-space or for air; for metal,
//! where E (TE) or H's partner (TM) vanishes: (0, 1) and (1, 0).

use artifact::material::{Backing, Layer, Material, Thickness};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Coefficients r_TE on E and r_TM on H of a material for a wave from air.
pub fn reflection(material: &Material, cosine: f64, wavenumber_per_m: f64) -> [Complex64; 2] {
    POLARIZATIONS.map(|polarization| {
        let wave = Wave { polarization, cosine, wavenumber_per_m };
        match material {
            Material::Conductor => wave.seen(METAL[polarization as usize]),
            Material::HalfSpace { permittivity } => {
                wave.seen([Complex64::ONE, wave.admittance(*permittivity)])
            }
            Material::Layers { layers, backing, thickness: Thickness::Exact } => {
                wave.seen(wave.in_front_of(layers, *backing, &vec![0.0; layers.len()]))
            }
            Material::Layers { layers, backing, thickness: Thickness::Averaged } => {
                wave.averaged(layers, *backing)
            }
        }
    })
}

#[derive(Debug, Clone, Copy)]
enum Polarization {
    Te,
    Tm,
}

const POLARIZATIONS: [Polarization; 2] = [Polarization::Te, Polarization::Tm];
const METAL: [[Complex64; 2]; 2] = [[Complex64::ZERO, Complex64::ONE], [Complex64::ONE, Complex64::ZERO]];

#[derive(Debug, Clone, Copy)]
struct Wave {
    polarization: Polarization,
    cosine: f64,
    wavenumber_per_m: f64,
}

/// Number of equal phase steps of the mean: it errs by the power of the multiply reflected wave, |r|³².
const PHASES: usize = 16;

impl Wave {
    /// Parameter s of the wave inside; the forward, decaying wave is the principal root, since Im ε ≤ 0.
    fn cosine_inside(&self, permittivity: Complex64) -> Complex64 {
        (permittivity - (1.0 - self.cosine * self.cosine)).sqrt()
    }

    fn admittance(&self, permittivity: Complex64) -> Complex64 {
        let s = self.cosine_inside(permittivity);
        match self.polarization {
            Polarization::Te => s,
            Polarization::Tm => s / permittivity,
        }
    }

    /// Fields at the first face, with a phase in rad added to each layer's round trip.
    fn in_front_of(&self, layers: &[Layer], backing: Backing, phases: &[f64]) -> [Complex64; 2] {
        let behind = match backing {
            Backing::Metal => METAL[self.polarization as usize],
            Backing::Air => [Complex64::ONE, Complex64::from(self.cosine)],
        };
        layers.iter().zip(phases).rev().fold(behind, |[b, c], (layer, phase)| {
            let s = self.cosine_inside(layer.permittivity);
            let q = self.admittance(layer.permittivity);
            let way = Complex64::new(0.0, -2.0 * self.wavenumber_per_m * layer.thickness_m) * s;
            let p = (way + Complex64::new(0.0, *phase)).exp();
            [0.5 * ((1.0 + p) * b + (1.0 - p) / q * c), 0.5 * (q * (1.0 - p) * b + (1.0 + p) * c)]
        })
    }

    fn seen(&self, [b, c]: [Complex64; 2]) -> Complex64 {
        (b * self.cosine - c) / (b * self.cosine + c)
    }

    /// Root mean power over all phases of every layer, with the phase of the first face, or of metal behind.
    fn averaged(&self, layers: &[Layer], backing: Backing) -> Complex64 {
        let cases = PHASES.pow(layers.len() as u32);
        let phase = |case: usize, layer: usize| (case / PHASES.pow(layer as u32) % PHASES) as f64;
        let power = |case: usize| {
            let step = 2.0 * PI / PHASES as f64;
            let phases: Vec<f64> = (0..layers.len()).map(|layer| step * phase(case, layer)).collect();
            self.seen(self.in_front_of(layers, backing, &phases)).norm_sqr()
        };
        let mean = (0..cases).map(power).sum::<f64>() / cases as f64;
        let face = match backing {
            Backing::Metal => self.seen(METAL[self.polarization as usize]),
            Backing::Air => self.seen([Complex64::ONE, self.admittance(layers[0].permittivity)]),
        };
        Complex64::from_polar(mean.sqrt(), face.arg())
    }
}
