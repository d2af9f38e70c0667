//! Response of a material to a plane wave, and to its field vectors.

use crate::materials::layers::{LayerCoefficients, averaged, coherent};
use crate::materials::reflection_coefficients::{CONDUCTOR, PolarizationPair, half_space};
use artifact::material::{Backing, Layer, Material, Thickness};
use glam::DVec3;
use num_complex::Complex64;
use radar::complex_vector::ComplexVector;
use std::f64::consts::{FRAC_PI_2, LN_10};

/// Reflection coefficients at a cosine of the angle to the normal.
pub(crate) fn reflection(material: &Material, cosine: f64, wavenumber_per_m: f64) -> PolarizationPair {
    match material {
        Material::Conductor => CONDUCTOR,
        Material::HalfSpace { permittivity } => half_space(*permittivity, cosine),
        Material::Layers { .. } => passed(material, cosine, wavenumber_per_m).reflected,
    }
}

/// Transmission of a sheet represented without thickness, t_slab·e^{+jkd cosθ}; zero for anything but layers
/// on air.
///
/// The thickness lies on the side of the incident wave: t_slab relates points of both faces straight behind
/// one another, and the line continued behind the sheet already includes the phase of the distance d·cosθ
/// travelled in glass.
pub(crate) fn transmission(material: &Material, cosine: f64, wavenumber_per_m: f64) -> PolarizationPair {
    let PolarizationPair { te, tm } = passed(material, cosine, wavenumber_per_m).transmitted;
    let thickness_m: f64 = layers_of(material).iter().map(|layer| layer.thickness_m).sum();
    let way = Complex64::cis(wavenumber_per_m * thickness_m * cosine);
    PolarizationPair { te: te * way, tm: tm * way }
}

fn passed(material: &Material, cosine: f64, wavenumber_per_m: f64) -> LayerCoefficients {
    const NOTHING: PolarizationPair = PolarizationPair { te: Complex64::ZERO, tm: Complex64::ZERO };
    match material {
        Material::Layers { layers, backing, thickness: Thickness::Exact } => {
            coherent(layers, *backing, cosine, wavenumber_per_m)
        }
        Material::Layers { layers, backing, thickness: Thickness::Averaged } => {
            averaged(layers, *backing, cosine, wavenumber_per_m)
        }
        Material::Conductor | Material::HalfSpace { .. } => {
            LayerCoefficients { reflected: CONDUCTOR, transmitted: NOTHING }
        }
    }
}

/// Layers of a material, outermost first; empty for a half-space or a conductor.
pub(crate) fn layers_of(material: &Material) -> &[Layer] {
    match material {
        Material::Layers { layers, .. } => layers,
        Material::Conductor | Material::HalfSpace { .. } => &[],
    }
}

/// Reflected fields: e_r = r_TE(e·ŝ)ŝ + r_TM(e·p̂)p̂_r with ŝ = unit(n×d), p̂ = ŝ×d, p̂_r = ŝ×d_r.
pub(crate) fn reflected_fields(
    e: [ComplexVector; 2],
    travel: DVec3,
    normal: DVec3,
    r: PolarizationPair,
) -> [ComplexVector; 2] {
    let across = across(travel, normal);
    let onwards = travel - 2.0 * normal.dot(travel) * normal;
    let [before, after] = [across.cross(travel), across.cross(onwards)];
    e.map(|e| {
        ComplexVector::of(across, r.te * e.along(across)) + ComplexVector::of(after, r.tm * e.along(before))
    })
}

/// Fields behind a sheet, with unchanged direction.
pub(crate) fn transmitted_fields(
    e: [ComplexVector; 2],
    travel: DVec3,
    normal: DVec3,
    t: PolarizationPair,
) -> [ComplexVector; 2] {
    let across = across(travel, normal);
    let in_plane = across.cross(travel);
    e.map(|e| {
        ComplexVector::of(across, t.te * e.along(across))
            + ComplexVector::of(in_plane, t.tm * e.along(in_plane))
    })
}

/// Unit vector ŝ; along the normal, where the polarizations are alike, any transverse direction.
fn across(travel: DVec3, normal: DVec3) -> DVec3 {
    let cross = normal.cross(travel);
    // Below this ŝ is rounding. te and −tm differ there by its square.
    const SINE: f64 = 1e-9;
    if cross.length_squared() < SINE * SINE {
        travel.any_orthonormal_vector()
    } else {
        cross / cross.length()
    }
}

/// Steepness of the coefficients over the angle, per radian: the exponential type m in |dⁿr/dθⁿ| ≤ mⁿ
/// (Bernstein).
///
/// A half-space varies fastest at grazing incidence in TM, by 2ε/√(ε − 1) ≈ 2√ε; the phase 2kds of a layer by
/// up to kd/|√(ε − 1)|, and the resonance of its faces sharpens that by (1 + |r|)/(1 − |r|). The vectors ŝ
/// and p̂ turn once with each of both directions. It determines the subdivision of polygons, whose effect is
/// measured.
pub(crate) fn steepness(material: &Material, wavenumber_per_m: f64) -> f64 {
    let index = |permittivity: Complex64| permittivity.norm().sqrt();
    match material {
        Material::Conductor => 0.0,
        Material::HalfSpace { permittivity } => 2.0 + 2.0 * index(*permittivity),
        Material::Layers { layers, .. } => layers.iter().fold(2.0, |m, layer| {
            let n = index(layer.permittivity);
            let turns =
                wavenumber_per_m * layer.thickness_m / (layer.permittivity - 1.0).norm().sqrt().max(0.1);
            m + 2.0 * n + turns * n
        }),
    }
}

/// Rate at which reflected fields turn with the normal in excess of those of a conductor, per radian, within
/// `turn_rad` of an angle of incidence: the local [`steepness`].
///
/// The excess fields are |r − r_PEC| as large and turn with ŝ and p̂; their coefficients are sampled at three
/// angles. Paint of 0.1 mm has 0.6 up to 45° and 10 at 83°, where TM passes its Brewster angle; over all
/// angles together nothing below 5.5 holds.
pub(crate) fn turning(material: &Material, cosine: f64, turn_rad: f64, wavenumber_per_m: f64) -> f64 {
    if matches!(material, Material::Conductor) {
        return 0.0;
    }
    let angle_rad = cosine.clamp(0.0, 1.0).acos();
    let step_rad = turn_rad.clamp(LEAST_STEP_RAD, 0.5);
    let at = |steps: f64| {
        let angle_rad = (angle_rad + steps * step_rad).abs().min(FRAC_PI_2);
        let PolarizationPair { te, tm } = reflection(material, angle_rad.cos(), wavenumber_per_m);
        [te, tm]
    };
    let [before, here, after] = [-1.0, 0.0, 1.0].map(at);
    let of = |p: usize, conductor: Complex64| {
        let first = (after[p] - before[p]).norm() / (2.0 * step_rad);
        let second = (after[p] - 2.0 * here[p] + before[p]).norm().sqrt() / step_rad;
        2.0 * (here[p] - conductor).norm() + first.max(second)
    };
    of(0, CONDUCTOR.te).max(of(1, CONDUCTOR.tm))
}

/// Minimum step between sampled angles: coefficients do not vary faster except at grazing incidence.
const LEAST_STEP_RAD: f64 = 0.02;

/// Length by which layers rotate the phase with the wavenumber, m: the two-way distance in them times their
/// refractive index, times the number of round trips before echoes become negligible.
pub(crate) fn turning_length_m(material: &Material) -> f64 {
    let Material::Layers { layers, backing, .. } = material else { return 0.0 };
    let once_m: f64 =
        layers.iter().map(|layer| 2.0 * layer.thickness_m * layer.permittivity.norm().sqrt()).sum();
    once_m * rounds(strongest_echo(layers, *backing))
}

/// Number of round trips of a wave that keeps this share of its amplitude after each.
///
/// Two are counted for panes in air, whose echo keeps a fifth: points that suffice for a rotation suffice for
/// a larger one of faint echoes. Beyond that, as many more as the decay to 10⁻⁴ takes.
fn rounds(kept: f64) -> f64 {
    const LEAST: f64 = 2.0;
    const OF_PANES: f64 = 0.19;
    let to_fall = |kept: f64| -4.0 * LN_10 / kept.min(1.0 - 1e-9).ln();
    LEAST + (to_fall(kept) - to_fall(OF_PANES)).max(0.0)
}

/// Product of the two largest reflections at normal incidence, among those of all boundaries and the metal
/// behind: the maximum amplitude kept by a wave after a round trip, without absorption.
fn strongest_echo(layers: &[Layer], backing: Backing) -> f64 {
    let index_before = |i: usize| match i.checked_sub(1) {
        Some(before) => layers[before].permittivity.sqrt(),
        None => Complex64::ONE,
    };
    let index_behind = |i: usize| layers.get(i).map_or(Complex64::ONE, |layer| layer.permittivity.sqrt());
    let reflection = |i: usize| match backing {
        Backing::Metal if i == layers.len() => 1.0,
        _ => ((index_before(i) - index_behind(i)) / (index_before(i) + index_behind(i))).norm(),
    };
    let [first, second] =
        (0..=layers.len()).map(reflection).fold([0.0; 2], |[first, second]: [f64; 2], r| {
            if r > first { [r, first] } else { [first, second.max(r)] }
        });
    first * second
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn echoes_of_panes_count_twice_and_those_of_a_resonant_coat_until_they_are_gone() {
        let layer = |real: f64| Layer { thickness_m: 1e-3, permittivity: Complex64::from(real) };
        let pane = strongest_echo(&[layer(6.5)], Backing::Air);
        // ((√6.5 − 1)/(√6.5 + 1))², and (√81 − 1)/(√81 + 1) in front of metal.
        assert!(
            (pane - 0.1906).abs() < 1e-4
                && (strongest_echo(&[layer(81.0)], Backing::Metal) - 0.8).abs() < 1e-12
        );
        assert!((rounds(pane) - 2.0).abs() < 0.02 && rounds(0.0) == 2.0);
        let many = rounds(0.8);
        assert!(0.8_f64.powf(many) < 3e-4, "{many}");
        assert!(rounds(1.0).is_finite());
    }
}
