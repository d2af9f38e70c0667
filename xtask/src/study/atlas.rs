//! Atlas of where each method fails: small cases whose answer is known, and a verdict on what the program
//! says of them.

mod verdict;
mod far_field;
mod integration;
mod corners;
mod curvature;
mod clipping;
mod cavity;
mod references;
mod frozen;
mod ambiguity;
mod detector;
mod refusals;
mod presentation;
mod picture;

pub(super) use picture::{COLUMNS, picture};
pub(super) use presentation::{count, csv, page};
pub(super) use verdict::{CaseRow, Says, Verdict};

use crate::study::extent::Extent;
use wayside::host::failure::Failure;
use wayside::host::progress::Work;

/// A group of rows.
type Case = fn(Extent) -> Result<Vec<CaseRow>, Failure>;

/// Cases by stage, in the order of docs/physics.md §10.
const CASES: [Case; 27] = [
    refusals::meshes,
    refusals::scenes,
    far_field::table_over_range,
    far_field::paths_over_range,
    integration::small_phases,
    integration::off_specular,
    corners::right_angles,
    corners::other_angles,
    curvature::facets_of_a_cylinder,
    curvature::spheres_against_mie,
    curvature::top_hat,
    clipping::doubled,
    clipping::far_from_the_origin,
    clipping::needles,
    clipping::touching,
    clipping::flipped,
    cavity::open_box,
    references::few_rays,
    references::few_samples,
    refusals::antennas,
    frozen::near_lane,
    frozen::single_precision,
    refusals::echoes,
    ambiguity::velocity,
    ambiguity::range,
    ambiguity::transmitters_in_turn,
    detector::all,
];

/// Every row, case by case.
pub(super) fn rows(extent: Extent) -> Result<Vec<CaseRow>, Failure> {
    let work = Work::begin("atlas");
    let mut all = Vec::new();
    for (number, case) in CASES.iter().enumerate() {
        work.at(number, CASES.len());
        all.extend(case(extent)?);
    }
    Ok(all)
}
