//! Remarks on what a scene or a table says and is perhaps not meant so.

mod coarse_meshes;
mod off_band;
mod turned_meshes;

pub(crate) use off_band::of_materials;

use artifact::scene::SceneHeader;

/// Remarks on a scene: on its meshes, and on its materials.
pub(crate) fn of_scene(header: &SceneHeader) -> Vec<String> {
    let of_road = header.road.iter().map(|road| &road.material);
    let of_meshes = header.meshes.iter().flat_map(|mesh| &mesh.makeup.materials);
    let materials = of_meshes.chain(of_road);
    let centre_hz = header.radar.waveform.centre_frequency_hz();
    let off_band = of_materials(materials, [centre_hz; 2]);
    coarse_meshes::remarks(header).into_iter().chain(turned_meshes::remarks(header)).chain(off_band).collect()
}
