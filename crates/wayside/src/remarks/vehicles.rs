//! Vehicles of a scene as the remarks need them.

use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::Class;

/// Class, model and mesh of each body with a specified class, targets and recorded vehicles.
pub(super) fn vehicles(header: &SceneHeader) -> impl Iterator<Item = (Class, &String, &Mesh)> {
    header.bodies().filter_map(|(_, kind)| Some((kind.class()?, kind.model()?, header.mesh_of(kind)?)))
}
