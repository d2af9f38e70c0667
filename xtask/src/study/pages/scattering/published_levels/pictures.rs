//! Pictures of levels all round: cars with the published level, and one vehicle of each class.

use super::levels::{ELEVATIONS_DEG, Levels};
use super::published::published_dbsm;
use crate::project::project_root;
use plotting::polar::PolarPlot;
use wayside::host::failure::Failure;
use wayside::host::files;

/// Writes both pictures.
pub(super) fn draw(all: &[Levels]) -> Result<(), Failure> {
    let line = |name: &&str| {
        let found = all.iter().find(|levels| levels.name == *name)?;
        Some((found.name.clone(), found.level_dbsm[1].clone()))
    };
    let published = ("3GPP TR 38.901".to_owned(), published_line());
    let cars = ["car-suv", "generic_sedan", "gazebo_prius"];
    let classes = ["car-sedan", "bus-city", "truck-box", "motorcycle-street"];
    let of_cars = [published].into_iter().chain(cars.iter().filter_map(line)).collect();
    write("published-levels-cars.svg", "Cars beside the published level", of_cars)?;
    write(
        "published-levels-classes.svg",
        "A vehicle of each class",
        classes.iter().filter_map(line).collect(),
    )
}

fn published_line() -> Vec<[f64; 2]> {
    (0..=360).map(f64::from).map(|az| [az, published_dbsm(az, ELEVATIONS_DEG[1])]).collect()
}

fn write(file: &str, title: &str, mut lines: Vec<(String, Vec<[f64; 2]>)>) -> Result<(), Failure> {
    lines.iter_mut().for_each(|(_, points)| points.extend(points.first().copied()));
    let plot = PolarPlot { title: title.to_owned(), unit: "dBsm".to_owned(), lines };
    files::write_file(&project_root().join("docs/pictures").join(file), plot.draw().standalone().as_bytes())
}
