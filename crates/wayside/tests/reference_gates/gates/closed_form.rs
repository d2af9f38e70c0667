//! First-order physical optics is exact on flat facets: implementation errors show here, physics needs no
//! tolerance.

use super::bodies;
use super::method::{Bart, FREQUENCY_HZ, antenna};
use super::row::Row;
use super::table::{Table, dbsm, worst_of_peak};
use artifact::paths::Amplitude;
use artifact::radar::Polarization::{Hh, Hv, Vh, Vv};
use bart_rcs::Standpoint;
use std::path::Path;

pub(crate) fn rows(folder: &Path) -> Vec<Row> {
    let folder = folder.join("closed_form");
    let mut polarizations = 0.0_f64;
    let mut rows = plates_far(&folder, &mut polarizations);
    rows.extend(plates_near(&folder));
    rows.extend(discs(&folder));
    rows.extend(disc_null(&folder));
    rows.extend(cylinders(&folder));
    rows.extend(dihedral_single(&folder));
    rows.extend(spheres(&folder));
    rows.push(Row::at_most("plates, far: vv against hh, and vh, over the peak", polarizations, 1e-12, ""));
    rows
}

fn aspects(table: &Table, az: &str, el: Option<&str>, range: Option<&str>) -> Vec<Standpoint> {
    let az = table.numbers(az);
    let el = el.map_or_else(|| vec![0.0; az.len()], |name| table.numbers(name));
    let range = range.map_or_else(|| vec![f64::INFINITY; az.len()], |name| table.numbers(name));
    (0..az.len()).map(|i| antenna(az[i], el[i], range[i])).collect()
}

/// Largest of |S_vv − S_hh| and |S_vh| over the largest |S_vv|.
fn polarization_error(s: &[Vec<Amplitude>]) -> f64 {
    let s: Vec<Amplitude> = s.iter().map(|orders| orders[0]).collect();
    let peak = s.iter().map(|s| s[0][0].norm()).fold(0.0, f64::max);
    s.iter().map(|s| (s[0][0] - s[1][1]).norm().max(s[0][1].norm()).max(s[1][0].norm())).fold(0.0, f64::max)
        / peak
}

fn plates_far(folder: &Path, polarizations: &mut f64) -> Vec<Row> {
    let table = Table::read(&folder.join("plate_far.csv"));
    let sides = ["0.03", "0.1", "0.3"];
    let row = |side: &str| {
        let cut = table.only(&[("side_m", side)]);
        let mesh = bodies::square(side.parse().unwrap());
        let antennas = aspects(&cut, "az_deg", Some("el_deg"), None);
        let got = Bart::first_order(&mesh).vv(&antennas);
        let some: Vec<Standpoint> = antennas.into_iter().step_by(20).collect();
        let all_elements = Bart::first_order(&mesh).elements(&some, &[Vv, Hh, Vh, Hv]);
        *polarizations = polarizations.max(polarization_error(&all_elements));
        let error = worst_of_peak(&got, &cut.complex("s_re_m", "s_im_m"));
        Row::at_most(format!("plate {side} m, far: worst |ΔS| over the peak"), error, 1e-3, "")
    };
    sides.into_iter().map(row).collect()
}

fn plates_near(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("plate_near.csv"));
    let mut rows = Vec::new();
    for side in ["0.1", "0.3", "1"] {
        let cut = table.only(&[("side_m", side)]);
        let mesh = bodies::square(side.parse().unwrap());
        let got = Bart::first_order(&mesh).vv(&aspects(&cut, "az_deg", Some("el_deg"), Some("range_m")));
        let (got, reference) = (got, cut.complex("s_re_m", "s_im_m"));
        let error = worst_of_peak(&got, &reference);
        rows.push(Row::at_most(
            format!("plate {side} m, 5 m to 1 km: worst |ΔS| over the peak"),
            error,
            1e-3,
            "",
        ));
        let db = got.iter().zip(&reference).map(|(g, r)| (dbsm(*g) - dbsm(*r)).abs()).fold(0.0, f64::max);
        rows.push(Row::at_most(format!("plate {side} m, 5 m to 1 km: worst level"), db, 0.01, "dB"));
    }
    for (range_m, level) in [(f64::INFINITY, 38.2703), (30.0, 37.1286), (5.0, 19.7382)] {
        let s = Bart::first_order(&bodies::square(0.3)).vv(&[antenna(0.0, 0.0, range_m)])[0];
        rows.push(Row::near(format!("plate 0.3 m seen square at {range_m} m"), dbsm(s), level, 0.01, "dBsm"));
    }
    rows
}

/// Corners of the polygon that stands for a disc: its rim is then within π²/4N² = 1e-5 of the radius.
const DISC_CORNERS: u32 = 512;

fn discs(folder: &Path) -> Vec<Row> {
    let far = Table::read(&folder.join("disc_far.csv"));
    let near = Table::read(&folder.join("disc_on_axis_near.csv"));
    let far_row = |radius: &str| {
        let cut = far.only(&[("radius_m", radius)]);
        let mesh = bodies::disc(radius.parse().unwrap(), DISC_CORNERS);
        let got = Bart::first_order(&mesh).vv(&aspects(&cut, "angle_deg", None, None));
        let error = worst_of_peak(&got, &cut.complex("s_re_m", "s_im_m"));
        Row::at_most(format!("disc radius {radius} m, far: worst |ΔS| over the peak"), error, 1e-3, "")
    };
    let near_row = |radius: &str| {
        // Every fourth range: each is a trace and integrals of its own.
        let cut = near.only(&[("radius_m", radius)]).every(4);
        let mesh = bodies::disc(radius.parse().unwrap(), DISC_CORNERS);
        let aspects: Vec<Standpoint> = cut.numbers("range_m").iter().map(|r| antenna(0.0, 0.0, *r)).collect();
        let got = Bart::first_order(&mesh).vv(&aspects);
        let error = worst_of_peak(&got, &cut.complex("s_re_m", "s_im_m"));
        Row::at_most(
            format!("disc radius {radius} m on its axis, 5–60 m: worst |ΔS| over the peak"),
            error,
            1e-3,
            "",
        )
    };
    let mut rows: Vec<Row> = ["0.01", "0.05", "0.15"].into_iter().map(far_row).collect();
    rows.extend(["0.1", "0.3", "0.3115", "0.5"].into_iter().map(near_row));
    rows
}

/// A disc of 0.3115 m on its axis has a null at a²/λ = 24.92 m, some 50 dB under its far-field level.
fn disc_null(folder: &Path) -> Vec<Row> {
    let mesh = bodies::disc(0.3115, DISC_CORNERS);
    // Twenty decibels below the depth that is asked for.
    let bart = Bart { accuracy_db: -70.0, ..Bart::first_order(&mesh) };
    let level = |range_m: f64| dbsm(bart.vv(&[antenna(0.0, 0.0, range_m)])[0]);
    let ranges: Vec<f64> = (-5..=5).map(|step| 24.92 + 4e-3 * f64::from(step)).collect();
    let levels: Vec<f64> = ranges.iter().map(|r| level(*r)).collect();
    let lowest = (0..levels.len()).fold(0, |best, i| if levels[i] < levels[best] { i } else { best });
    let far = Table::read(&folder.join("disc_on_axis_near.csv")).only(&[("radius_m", "0.3115")]);
    let depth = levels[lowest] - far.numbers("far_field_dbsm")[0];
    vec![
        Row::near("disc radius 0.3115 m: range of its null", ranges[lowest], 24.92, 0.01, "m"),
        Row::at_most("disc radius 0.3115 m: null against the far field", depth, -50.0, "dB"),
    ]
}

/// Strips at q = 0.08 of physics.md §3: −43 dB of complex error at q = 0.1 where their mean lies on the
/// surface.
fn cylinders(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("cylinder_far.csv"));
    let row = |(radius_m, radius): (f64, &str)| {
        let cut = table.only(&[("radius_m", radius)]);
        let strip_m = 0.08 * (radius_m * artifact::units::SPEED_OF_LIGHT_MPS / FREQUENCY_HZ).sqrt();
        let strips = (std::f64::consts::PI * radius_m / strip_m).ceil() as u32;
        let mesh = bodies::half_cylinder(radius_m, cut.numbers("length_m")[0], strips);
        let aspects: Vec<Standpoint> =
            cut.numbers("off_broadside_deg").iter().map(|el| antenna(0.0, *el, f64::INFINITY)).collect();
        let got = Bart::first_order(&mesh).vv(&aspects);
        let error = worst_of_peak(&got, &cut.complex("s_re_m", "s_im_m"));
        Row::at_most(
            format!("cylinder radius {radius} m, {strips} strips: worst |ΔS| over the peak"),
            error,
            1e-2,
            "",
        )
    };
    [(0.02, "0.02"), (0.05, "0.05"), (0.1, "0.1"), (0.25, "0.25")].map(row).into()
}

fn dihedral_single(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("dihedral_po.csv"));
    let row = |side: &str| {
        let cut = table.only(&[("side_m", side), ("pol", "vv")]);
        let mesh = bodies::dihedral(side.parse().unwrap());
        let got = Bart::first_order(&mesh).vv(&aspects(&cut, "az_deg", None, None));
        let error = worst_of_peak(&got, &cut.complex("single_re_m", "single_im_m"));
        Row::at_most(format!("dihedral {side} m, single bounce: worst |ΔS| over the peak"), error, 1e-3, "")
    };
    ["0.05", "0.1"].map(row).into()
}

/// Facets of at most q = 0.1: an octant's edges are halved until they are below 0.1·√(ρλ).
fn spheres(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("sphere_mie.csv"));
    let mut rows = Vec::new();
    for (radius, levels) in [("0.05", 6), ("0.1", 7)] {
        let cut = table.only(&[("radius_m", radius), ("freq_ghz", "77")]);
        let mesh = bodies::sphere(radius.parse().unwrap(), levels);
        let got = dbsm(Bart::first_order(&mesh).vv(&[antenna(25.0, 40.0, f64::INFINITY)])[0]);
        let facets = mesh.triangles.len();
        let known = |name: &str| cut.numbers(name)[0];
        let name = format!("sphere radius {radius} m, {facets} facets");
        rows.push(Row::near(format!("{name}: physical optics"), got, known("po_dbsm"), 0.05, "dBsm"));
        rows.push(Row::near(format!("{name}: Mie"), got, known("rcs_dbsm"), 0.1, "dBsm"));
    }
    rows
}
