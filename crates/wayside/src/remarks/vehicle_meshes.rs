//! Meshes of vehicles with wrong axes or units.

use crate::remarks::vehicles::vehicles;
use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::Class;
use std::collections::BTreeSet;

/// Remark on each mesh of a vehicle that is higher or wider than long, or outside the sizes of its class.
pub(super) fn remarks(header: &SceneHeader) -> Vec<String> {
    let remarks: BTreeSet<String> =
        vehicles(header).filter_map(|(class, model, mesh)| remark(mesh, model, class)).collect();
    remarks.into_iter().collect()
}

/// Shorter meshes are parts of vehicles, or in another unit: files at a hundredth of the size are common.
const SHORTEST_M: f64 = 0.2;

/// Greatest length of a vehicle, with a quarter to spare: stretched limousines, bi-articulated buses, road
/// trains, motorcycles with a trailer. In feet, the largest of the usual units, nearly all cars are longer.
fn longest_m(class: Class) -> f64 {
    match class {
        Class::Car => 10.0,
        Class::Bus => 35.0,
        Class::Truck => 60.0,
        Class::Motorcycle => 5.0,
    }
}

fn remark(mesh: &Mesh, model: &str, class: Class) -> Option<String> {
    let sides_m = mesh.size_m();
    let [length_m, width_m, height_m] = sides_m;
    let longest_side_m = sides_m.into_iter().fold(0.0, f64::max);
    if !(SHORTEST_M..=longest_m(class)).contains(&longest_side_m) {
        let (size, unit) =
            (told(sides_m, class), "say how many metres a unit of the file is, by `unit_scale`");
        return Some(format!("note: {model}: {size} is in another unit than metres: {unit}"));
    }
    let how = match (height_m > length_m, width_m > length_m) {
        (true, _) => "stands on end",
        (false, true) => "stands across",
        (false, false) => return None,
    };
    let size = told(sides_m, class);
    Some(format!("note: {model}: {size} {how}: x is forward, y left, z up (docs/scenes.md, mesh files)"))
}

fn told([length_m, width_m, height_m]: [f64; 3], class: Class) -> String {
    let class = class.name();
    format!("{length_m:.2} m long, {width_m:.2} m wide and {height_m:.2} m high, a {class}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_car_whose_file_has_y_up_stands_on_end_and_one_that_looks_along_y_across() {
        let of = |size_m: [f64; 3]| Mesh { vertices_m: vec![[0.0; 3], size_m], ..Mesh::default() };
        let told = |size_m| remark(&of(size_m), "van.obj", Class::Car);
        assert_eq!(
            told([1.8, 1.9, 5.0]).unwrap(),
            "note: van.obj: 1.80 m long, 1.90 m wide and 5.00 m high, a car stands on end: x is forward, y \
             left, z up (docs/scenes.md, mesh files)"
        );
        assert!(told([1.9, 5.0, 1.8]).unwrap().contains("stands across"));
        assert_eq!(told([5.0, 1.9, 1.8]), None);
    }

    #[test]
    fn a_vehicle_as_large_as_none_is_in_another_unit() {
        let of = |unit_m: f64, class| {
            let size_m = [4.5, 1.8, 1.5].map(|side| side / unit_m);
            remark(&Mesh { vertices_m: vec![[0.0; 3], size_m], ..Mesh::default() }, "van.obj", class)
        };
        assert_eq!(
            of(0.01, Class::Car).unwrap(),
            "note: van.obj: 450.00 m long, 180.00 m wide and 150.00 m high, a car is in another unit than \
             metres: say how many metres a unit of the file is, by `unit_scale`"
        );
        assert!([0.3048, 0.0254, 100.0, 1000.0].into_iter().all(|unit_m| of(unit_m, Class::Car).is_some()));
        assert_eq!(of(1.0, Class::Car), None);
        assert_eq!(of(0.3048, Class::Bus), None);
    }
}
