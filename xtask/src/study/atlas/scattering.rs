//! Scattering: failures between a mesh and its S.

mod far_field;
mod integration;
mod grazing;
mod corners;
mod curvature;
mod concave;
mod coarse;
mod small;
mod near;
mod aspects;
mod clipping;
mod confined;
mod materials;
mod references;

use crate::study::atlas::verdict::{AtlasCase, atlas_cases};

/// Cases in the order of docs/physics.md §10.
pub(super) const CASES: &[AtlasCase] = atlas_cases![
    far_field::table_over_range,
    far_field::paths_over_range,
    integration::small_phases,
    integration::off_specular,
    grazing::plate,
    grazing::wall_of_a_corner,
    grazing::strip_without_edges,
    grazing::strip_with_edges,
    corners::right_angles,
    corners::other_angles,
    curvature::facets_of_a_cylinder,
    curvature::spheres_against_mie,
    curvature::top_hat,
    coarse::few_polygons,
    concave::mirror_from_its_centre,
    concave::mirror_from_its_focus,
    concave::trough_of_orders,
    small::discs,
    small::sizes,
    near::antennas_in_bodies,
    near::larger_than_its_distance,
    near::sphere_from_close_by,
    near::between_walls,
    aspects::hair_steps,
    aspects::exchanged,
    aspects::rolled_dihedral,
    aspects::wide_band,
    clipping::doubled,
    clipping::far_from_the_origin,
    clipping::needles,
    clipping::touching,
    clipping::flipped,
    confined::open_box,
    confined::duct,
    confined::round_walls,
    confined::hollow_walls,
    confined::closed_box,
    materials::panes,
    materials::half_space,
    materials::behind_a_pane,
    references::few_rays,
    references::few_samples,
    references::few_samples_a_facet,
    grazing::glancing_rays,
];
