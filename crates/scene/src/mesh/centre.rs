//! Origin of a mesh in a scene.

use artifact::scene::Mesh;
use glam::DVec3;

/// Moves the origin to the centre of the mesh's bounding box, on the ground.
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
