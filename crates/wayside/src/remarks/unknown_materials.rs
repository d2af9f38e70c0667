//! Materials of meshes without an entry in the map of materials.

use artifact::material::{Material, MaterialMap};
use artifact::scene::Mesh;
use std::collections::BTreeSet;

/// Largest number of names listed for a mesh, and of characters of each.
const TOLD: usize = 8;
const TOLD_CHARACTERS: usize = 40;

/// Remark on each mesh with some materials missing from a map that has others: they conduct, perhaps because
/// of a misspelt name.
pub(crate) fn without_entry<'m>(
    meshes: impl Iterator<Item = &'m Mesh>,
    map: &MaterialMap,
) -> BTreeSet<String> {
    if map.by_name.is_empty() {
        return BTreeSet::new();
    }
    meshes.filter_map(|mesh| of_mesh(mesh, map)).collect()
}

fn of_mesh(mesh: &Mesh, map: &MaterialMap) -> Option<String> {
    let used: BTreeSet<usize> = mesh.material_of_triangle.iter().map(|index| *index as usize).collect();
    // An asset has its own mapping.
    let conducts = |index: &usize| mesh.makeup.materials.get(*index) == Some(&Material::Conductor);
    let names = used.into_iter().filter(conducts).filter_map(|index| mesh.materials.get(index));
    let lacking: BTreeSet<&String> = names
        .filter(|name| !name.is_empty() && map.by_name.iter().all(|(known, _)| known != *name))
        .collect();
    let told: Vec<String> = lacking.iter().take(TOLD).map(|name| told(name, map)).collect();
    let others = lacking.len().saturating_sub(TOLD);
    let others = if others > 0 { format!(" and {others} more") } else { String::new() };
    (!lacking.is_empty()).then(|| {
        let (mesh, told) = (&mesh.name, told.join(", "));
        format!("note: {mesh}: materials without an entry in [materials] conduct perfectly: {told}{others}")
    })
}

/// A name, with the entry that differs from it only by capitals and separators.
fn told(name: &str, map: &MaterialMap) -> String {
    let letters = |text: &str| text.to_lowercase().replace([' ', '_', '-', '.'], "");
    let shown: String = name.chars().take(TOLD_CHARACTERS).collect();
    match map.by_name.iter().find(|(known, _)| letters(known) == letters(name)) {
        Some((known, _)) => format!("`{shown}` (the entry is `{known}`)"),
        None => format!("`{shown}`"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    #[test]
    fn a_misspelt_material_is_told_and_one_that_is_said_to_conduct_is_not() {
        let glass = Material::HalfSpace { permittivity: Complex64::new(6.5, -0.15) };
        let entries = [("glass_front", glass), ("steel", Material::Conductor)];
        let by_name = entries.map(|(name, material)| (name.to_owned(), material)).to_vec();
        let map = MaterialMap { by_name, ..MaterialMap::default() };
        let of = |names: &[&str], map: &MaterialMap| {
            let materials: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
            let makeup = map.mesh_materials(&materials);
            let material_of_triangle = (0..names.len() as u16).collect();
            let mesh =
                Mesh { name: "van.obj".into(), materials, material_of_triangle, makeup, ..Mesh::default() };
            without_entry([&mesh].into_iter(), map).into_iter().collect::<Vec<_>>()
        };
        assert_eq!(
            of(&["Glass Front", "steel", "rim", ""], &map),
            ["note: van.obj: materials without an entry in [materials] conduct perfectly: \
              `Glass Front` (the entry is `glass_front`), `rim`"]
        );
        assert!(of(&["glass_front", "steel", ""], &map).is_empty());
        assert!(of(&["Glass Front"], &MaterialMap::default()).is_empty(), "everything conducts");
        let many: Vec<String> = (10..21).map(|i| format!("m{i}")).collect();
        let many: Vec<&str> = many.iter().map(String::as_str).collect();
        assert!(of(&many, &map)[0].ends_with("`m17` and 3 more"));
    }
}
