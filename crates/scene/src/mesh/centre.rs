//! The origin that a scene gives to a mesh.

use artifact::scene::Mesh;
use glam::DVec3;

/// The mesh with the centre of its bounding box, on the ground, at the origin.
pub fn centred(mut mesh: Mesh) -> Mesh {
    let [low, high] = mesh.bounds_m().map(DVec3::from);
    let middle = 0.5 * (low + high);
    let origin_m = DVec3::new(middle.x, middle.y, low.z);
    for vertex in &mut mesh.vertices_m {
        *vertex = (DVec3::from(*vertex) - origin_m).into();
    }
    for wheel in &mut mesh.wheels {
        wheel.hub_m = (DVec3::from(wheel.hub_m) - origin_m).into();
    }
    mesh
}
