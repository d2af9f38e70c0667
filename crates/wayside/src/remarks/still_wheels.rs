//! Turning wheels of models without wheel nodes.

use crate::remarks::vehicles::vehicles;
use artifact::scene::SceneHeader;
use artifact::settings::Wheels;
use std::collections::BTreeSet;

/// Remark on vehicle models without wheels in a scene with turning wheels.
pub(super) fn remark(header: &SceneHeader) -> Option<String> {
    let without: BTreeSet<&str> = vehicles(header)
        .filter(|(_, _, mesh)| mesh.wheels.is_empty())
        .map(|(_, model, _)| model.as_str())
        .collect();
    let names = without.iter().copied().collect::<Vec<_>>().join(", ");
    (header.fidelity.wheels == Wheels::Turning && !without.is_empty()).then(|| {
        format!(
            "note: {names}: no wheel turns: none is named as one by its node, mesh or material, or what is named \
             so is round, off the ground or far from its fellow on the axle (docs/decisions/wheels.md)"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::scene::Mesh;

    #[test]
    fn models_without_wheels_are_told_where_wheels_are_to_turn() {
        let options = scene::ReadOptions::names_only();
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/experiment-1.toml");
        let mut header = scene::read(&file, &options).unwrap();
        let with_wheels = scene::vehicles::mesh("car-suv", 0).unwrap();
        let without = Mesh { wheels: vec![], ..with_wheels.clone() };
        header.fidelity.wheels = Wheels::Turning;
        header.meshes = vec![without.clone()].into();
        let told = remark(&header).unwrap();
        assert!(told.starts_with("note: car-suv: no wheel turns"), "{told}");
        header.meshes = vec![with_wheels].into();
        assert_eq!(remark(&header), None);
        (header.fidelity.wheels, header.meshes) = (Wheels::Still, vec![without].into());
        assert_eq!(remark(&header), None);
    }
}
