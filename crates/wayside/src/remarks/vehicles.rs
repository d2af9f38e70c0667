//! Vehicles of a scene as remarks look at them.

use artifact::scene::{Mesh, SceneHeader, TargetKind};
use artifact::settings::Class;

/// Class, model and mesh of each body whose class is told, targets and recorded vehicles.
pub(super) fn vehicles(header: &SceneHeader) -> impl Iterator<Item = (Class, &String, &Mesh)> {
    let recorded = header.traffic.iter().flat_map(|traffic| &traffic.vehicles).map(|vehicle| &vehicle.kind);
    let kinds = header.targets.iter().map(|target| &target.kind).chain(recorded);
    kinds.filter_map(|kind| match kind {
        TargetKind::Mesh { class: Some(class), model, mesh } => {
            Some((*class, model, header.meshes.get(*mesh as usize)?))
        }
        _ => None,
    })
}
