//! Levels of vehicles compared with the published ones of 3GPP TR 38.901 (Release 19), section 7.9.2.1:
//! sector by sector, and the effect of a road under a car.

mod published;
mod levels;
mod pictures;
mod road;

use super::bodies::{Named, all_own, real};
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SCATTERING, SourcePaths};
use artifact::settings::{Class, SmallParts};
use levels::{Levels, mean};
use published::SECTORS;
use wayside::host::failure::Failure;
use wayside::host::progress::note;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths =
    &[SCATTERING, &["xtask/src/study/pages/scattering/published_levels", file!()]];

/// Cars of `../shared/vehicles`, by their number of triangles.
const REAL_CARS: [&str; 9] = [
    "gazebo_pickup",
    "smarts_muscle_car",
    "gazebo_prius",
    "quaternius_suv",
    "modern_hatchback",
    "nissan_patrol_suv",
    "uaz452_van",
    "generic_sedan",
    "jeep_cherokee_suv",
];

/// Number of triangles from which on a mesh counts as detailed, and below which as coarse.
const DETAILED: usize = 20_000;
const COARSE: usize = 4_000;

/// Table of all vehicles, differences by detail of the mesh, the effect of a road, pictures.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    part.line("Means of dBsm over a sector, at 0° / 10° elevation; less TR 38.901 with σ, dB:\n");
    part.head(&["vehicle", "class", "triangles", "front", "sides", "rear", "less TR, at 0°", "at 10°"]);
    let (mut all, mut drawn) = (Vec::new(), Vec::new());
    for (class, named) in vehicles(extent)? {
        if is_coarse_car(class, &named) {
            drawn.push(Levels::of(class, named.clone(), SmallParts::Statistical)?);
        }
        let levels = Levels::of(class, named, SmallParts::OfMesh)?;
        part.row(&row(&levels));
        all.push(levels);
    }
    part.line("");
    by_detail(&mut part, (&all, &drawn));
    road::added(&mut part, extent)?;
    if extent == Extent::Full {
        pictures::draw(&all)?;
    }
    Ok(part)
}

fn vehicles(extent: Extent) -> Result<Vec<(Class, Named)>, Failure> {
    let mut own = all_own()?;
    own.truncate(if extent == Extent::Quick { 1 } else { own.len() });
    let class = |name: &str| scene::vehicles::class_of(name).unwrap_or(Class::Car);
    let mut all: Vec<(Class, Named)> = own.into_iter().map(|named| (class(&named.0), named)).collect();
    for name in REAL_CARS.iter().filter(|_| extent == Extent::Full) {
        match real(name) {
            Ok(mesh) => all.push((Class::Car, ((*name).to_owned(), mesh))),
            Err(failure) => note(format!("left out: {failure}")),
        }
    }
    Ok(all)
}

fn row(levels: &Levels) -> Vec<String> {
    let both = |of: &dyn Fn(usize) -> String| format!("{} / {}", of(0), of(1)).replace('-', "−");
    let sectors = SECTORS.map(|sector| both(&|at| format!("{:.1}", levels.of_sector(at, sector))));
    let mut cells = vec![levels.name.clone(), levels.class.name().to_owned(), levels.triangles.to_string()];
    cells.extend(sectors);
    cells.extend([0, 1].map(|at| match levels.class {
        Class::Car => difference_text(levels.difference_from_published(at)),
        _ => "–".to_owned(),
    }));
    cells
}

/// Whether it is a real car whose mesh is coarse.
fn is_coarse_car(class: Class, (name, mesh): &Named) -> bool {
    class == Class::Car && mesh.triangles.len() < COARSE && scene::vehicles::class_of(name).is_none()
}

/// Text of a difference with its standard deviation, dB.
fn difference_text([middle, deviation]: [f64; 2]) -> String {
    format!("{middle:+.1} (σ {deviation:.1})").replace('-', "−")
}

/// Filter of the cars in a row.
type LevelFilter = fn(&Levels) -> bool;

/// Means over own cars, and over real ones by the detail of their meshes; `drawn` are the coarse ones with
/// small parts drawn.
fn by_detail(part: &mut PageSection, (all, drawn): (&[Levels], &[Levels])) {
    part.head(&["cars", "number", "less TR 38.901, dB, at 0°", "at 10°"]);
    let kinds: [(&str, LevelFilter); 4] = [
        ("own", |levels| levels.is_own()),
        ("real, over 20,000 triangles", |levels| !levels.is_own() && levels.triangles > DETAILED),
        ("real, 4,000 to 20,000", |l| !l.is_own() && (COARSE..=DETAILED).contains(&l.triangles)),
        ("real, below 4,000", |levels| !levels.is_own() && levels.triangles < COARSE),
    ];
    for (name, kept) in kinds {
        means(part, name, all.iter().filter(|levels| levels.class == Class::Car && kept(levels)));
    }
    means(part, "the same, small parts drawn", drawn.iter());
    part.line("");
}

/// Row of the mean over some cars; none if there are none.
fn means<'a>(part: &mut PageSection, name: &str, cars: impl Iterator<Item = &'a Levels>) {
    let cars: Vec<&Levels> = cars.collect();
    if cars.is_empty() {
        return;
    }
    let told = [0, 1].map(|elevation: usize| {
        let of_cars: Vec<[f64; 2]> =
            cars.iter().map(|car| car.difference_from_published(elevation)).collect();
        difference_text(
            [0, 1].map(|at: usize| mean(&of_cars.iter().map(|told| told[at]).collect::<Vec<_>>())),
        )
    });
    part.row(&[&[name.to_owned(), cars.len().to_string()], &told[..]].concat());
}
