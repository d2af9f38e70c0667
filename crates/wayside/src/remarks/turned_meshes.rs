//! Meshes of vehicles whose axes are not those of a body.

use artifact::scene::{Mesh, SceneHeader, TargetKind};
use std::collections::BTreeSet;

/// A remark on each mesh of a vehicle that is higher or wider than long.
pub(super) fn remarks(header: &SceneHeader) -> Vec<String> {
    let recorded = header.traffic.iter().flat_map(|traffic| &traffic.vehicles).map(|vehicle| &vehicle.kind);
    let kinds = header.targets.iter().map(|target| &target.kind).chain(recorded);
    let remarks: BTreeSet<String> = kinds
        .filter_map(|kind| match kind {
            TargetKind::Mesh { class: Some(class), model, mesh } => {
                let mesh = header.meshes.get(*mesh as usize)?;
                remark(mesh, model, class.name())
            }
            _ => None,
        })
        .collect();
    remarks.into_iter().collect()
}

fn remark(mesh: &Mesh, model: &str, class: &str) -> Option<String> {
    let [length_m, width_m, height_m] = mesh.size_m();
    let how = match (height_m > length_m, width_m > length_m) {
        (true, _) => "stands on end",
        (false, true) => "stands across",
        (false, false) => return None,
    };
    Some(format!(
        "note: {model}: {length_m:.2} m long, {width_m:.2} m wide and {height_m:.2} m high, a {class} {how}: x \
         is forward, y left, z up (docs/scenes.md, mesh files)"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_car_whose_file_has_y_up_stands_on_end_and_one_that_looks_along_y_across() {
        let of = |size_m: [f64; 3]| Mesh { vertices_m: vec![[0.0; 3], size_m], ..Mesh::default() };
        let told = |size_m| remark(&of(size_m), "van.obj", "car");
        assert_eq!(
            told([1.8, 1.9, 5.0]).unwrap(),
            "note: van.obj: 1.80 m long, 1.90 m wide and 5.00 m high, a car stands on end: x is forward, y \
             left, z up (docs/scenes.md, mesh files)"
        );
        assert!(told([1.9, 5.0, 1.8]).unwrap().contains("stands across"));
        assert_eq!(told([5.0, 1.9, 1.8]), None);
    }
}
