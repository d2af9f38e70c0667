//! Remarks on input of a scene or a table that is perhaps a mistake.

mod absolute_pattern;
mod coarse_meshes;
mod empty_road;
pub(crate) mod forward_scattering;
mod off_band;
mod still_wheels;
mod unknown_materials;
pub(crate) mod untrained_radar;
mod vehicle_meshes;
mod vehicles;

pub(crate) use off_band::of_materials;
pub(crate) use unknown_materials::without_entry;

use artifact::scene::SceneHeader;

/// Remarks on a scene: on its meshes, its materials, its radar and its traffic.
pub(crate) fn of_scene(header: &SceneHeader) -> Vec<String> {
    let of_road = header.road.iter().map(|road| &road.material);
    let of_meshes = header.meshes.iter().flat_map(|mesh| &mesh.makeup.materials);
    let materials = of_meshes.chain(of_road);
    let centre_hz = header.radar.waveform.centre_frequency_hz();
    let off_band = of_materials(materials, [centre_hz; 2]);
    let of_vehicles = vehicle_meshes::remarks(header).into_iter().chain(still_wheels::remark(header));
    let of_radar = absolute_pattern::remark(&header.radar).into_iter().chain(empty_road::remark(header));
    coarse_meshes::remarks(header).into_iter().chain(of_vehicles).chain(off_band).chain(of_radar).collect()
}
