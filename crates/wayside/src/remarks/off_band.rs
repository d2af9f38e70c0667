//! Substances at frequencies outside the range of their permittivities.

use artifact::material::Material;
use artifact::permittivity::{BAND_HZ, SUBSTANCES};
use std::collections::BTreeSet;

/// Part of the frequency beyond the band up to which a value holds, as for OpenMATERIAL tables
/// (docs/materials.md).
const BEYOND: f64 = 0.1;

/// Remark on the materials' substances from the table whose band does not contain the frequencies.
pub(crate) fn of_materials<'m>(
    materials: impl Iterator<Item = &'m Material>,
    [lowest_hz, highest_hz]: [f64; 2],
) -> Option<String> {
    let [from_hz, to_hz] = BAND_HZ;
    if lowest_hz >= (1.0 - BEYOND) * from_hz && highest_hz <= (1.0 + BEYOND) * to_hz {
        return None;
    }
    let names: BTreeSet<&str> = materials.flat_map(substances).collect();
    let names = names.into_iter().collect::<Vec<_>>().join(", ");
    let ghz = |hz: f64| {
        let text = format!("{:.2}", hz * 1e-9);
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    let [from, to, lowest, highest] = [from_hz, to_hz, lowest_hz, highest_hz].map(ghz);
    let at = if lowest == highest { lowest } else { format!("{lowest} to {highest}") };
    (!names.is_empty()).then(|| {
        format!(
            "note: permittivities of {names} are those of {from} to {to} GHz and are taken at {at} GHz: \
             `permittivity`, or `openmaterial`, tells others (docs/materials.md)"
        )
    })
}

/// Names of the table's substances in a material.
fn substances(material: &Material) -> impl Iterator<Item = &'static str> {
    let own = material.permittivities();
    let is_of = move |permittivity| own.contains(&permittivity);
    SUBSTANCES.iter().filter(move |s| s.permittivity.is_some_and(&is_of)).map(|s| s.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    #[test]
    fn substances_of_77_ghz_are_remarked_on_at_24_and_at_140_ghz_and_values_of_ones_own_are_not() {
        let glass = Material::HalfSpace { permittivity: Complex64::new(6.5, -0.15) };
        let own = Material::HalfSpace { permittivity: Complex64::new(6.4, -0.15) };
        let told = |hz| of_materials([&glass, &own, &Material::Conductor].into_iter(), hz);
        assert_eq!(
            told([24e9, 24.25e9]).unwrap(),
            "note: permittivities of glass are those of 76 to 81 GHz and are taken at 24 to 24.25 GHz: \
             `permittivity`, or `openmaterial`, tells others (docs/materials.md)"
        );
        assert!(told([140e9; 2]).unwrap().contains("at 140 GHz"));
        assert!(told([24.08e9; 2]).unwrap().contains("at 24.08 GHz"));
        assert_eq!(told([76e9, 81e9]), None);
        assert_eq!(of_materials([&own].into_iter(), [24e9; 2]), None);
    }
}
