//! Vehicles of a scene as remarks look at them.

use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::Class;

/// Class, model and mesh of each body whose class is told, targets and recorded vehicles.
pub(super) fn vehicles(header: &SceneHeader) -> impl Iterator<Item = (Class, &String, &Mesh)> {
    header.bodies().filter_map(|(_, kind)| Some((kind.class()?, kind.model()?, header.mesh_of(kind)?)))
}
