//! Geometrical optics between bounces on bodies of some wavelengths: how far it is from full-wave solutions is known.

use crate::bodies;
use crate::method::{Bart, antenna, sum};
use crate::row::Row;
use crate::table::{Table, complex_error, dbsm, mean_db, power_mean_dbsm};
use artifact::paths::Amplitude;
use artifact::settings::NodeRule::{self, Exit, Middle};
use bart_rcs::Standpoint;
use std::path::Path;

/// A cut through a full-wave body and the mean |dB| it may be off, vv and hh, with exit nodes: the gates are figures of
/// shooting and bouncing rays, whose node is the last facet.
struct Case {
    body: &'static str,
    el_deg: f64,
    az_deg: [f64; 2],
    bounces: u8,
    gate_db: [f64; 2],
}

const CASES: [Case; 5] = [
    Case { body: "dihedral_3lambda", el_deg: 0.0, az_deg: [-44.0, 44.0], bounces: 2, gate_db: [1.0, 1.2] },
    Case { body: "dihedral_6lambda", el_deg: 0.0, az_deg: [-44.0, 44.0], bounces: 2, gate_db: [1.0, 1.0] },
    Case { body: "dihedral100_3lambda", el_deg: 0.0, az_deg: [-49.0, 49.0], bounces: 2, gate_db: [1.4, 1.8] },
    Case { body: "trihedral_4lambda", el_deg: AXIS_EL_DEG, az_deg: [1.0, 89.0], bounces: 3, gate_db: [0.9, 0.7] },
    Case { body: "trihedral_4lambda", el_deg: 15.0, az_deg: [1.0, 89.0], bounces: 3, gate_db: [1.2, 0.6] },
];

/// Elevation of a trihedral's axis, atan(1/√2).
const AXIS_EL_DEG: f64 = 35.264_389_682_754_654;

pub(crate) fn rows(folder: &Path) -> Vec<Row> {
    let mut rows = Vec::new();
    for nodes in [Exit, Middle] {
        rows.extend(CASES.iter().flat_map(|case| case_rows(case, nodes, &folder.join("fullwave"))));
        rows.extend(trihedral_peak(nodes, &folder.join("fullwave")));
    }
    rows.extend(duct_box(&folder.join("austin")));
    rows
}

/// Gated with exit nodes, for comparison with others.
fn row(nodes: NodeRule, check: String, figure: f64, limit: f64) -> Row {
    match nodes {
        Exit => Row::at_most(check, figure, limit, "dB"),
        Middle => Row::shown(check, figure, "dB"),
    }
}

fn case_rows(case: &Case, nodes: NodeRule, folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join(format!("{}.csv", case.body)));
    let table = table.between("el_deg", case.el_deg - 1e-3, case.el_deg + 1e-3);
    let table = table.between("az_deg", case.az_deg[0], case.az_deg[1]);
    let mesh = bodies::stl(&folder.join(format!("{}.stl", case.body)));
    let az_deg = table.only(&[("pol", "vv")]).numbers("az_deg");
    let antennas: Vec<Standpoint> = az_deg.into_iter().map(|az| antenna(az, case.el_deg, f64::INFINITY)).collect();
    let bart = Bart { nodes, ..Bart::bounces(&mesh, case.bounces) };
    let got: Vec<Amplitude> = bart.orders(&antennas).iter().map(|s| sum(s)).collect();
    let mut rows = Vec::new();
    for (p, pol) in ["vv", "hh"].into_iter().enumerate() {
        let reference = table.only(&[("pol", pol)]);
        let s: Vec<_> = got.iter().map(|s| s[p][p]).collect();
        let levels: Vec<f64> = s.iter().map(|s| dbsm(*s)).collect();
        let figure = mean_db(&levels, &reference.numbers("rcs_dbsm"))[0];
        let relative = complex_error(&s, &reference.complex("s_re_m", "s_im_m"));
        let check = format!(
            "{}, el {:.2}, {pol}, {} bounces, {nodes:?}: mean |dB| (complex error {relative:.2})",
            case.body, case.el_deg, case.bounces
        );
        rows.push(row(nodes, check, figure, case.gate_db[p]));
    }
    rows
}

/// −17.89 dBsm is the closed form of the triple bounce; the whole solution is −17.08.
fn trihedral_peak(nodes: NodeRule, folder: &Path) -> Option<Row> {
    let mesh = bodies::stl(&folder.join("trihedral_4lambda.stl"));
    let bart = Bart { nodes, ..Bart::bounces(&mesh, 3) };
    let s = bart.orders(&[antenna(45.0, AXIS_EL_DEG, f64::INFINITY)])[0][2][0][0];
    let check = format!("trihedral_4lambda on its axis, triple bounce alone, {nodes:?}");
    Some(Row::near(check, dbsm(s), -17.89, 0.1, "dBsm"))
}

/// A box with a round blind duct, 10.2451 GHz: the mean level over az 10–45 and the mean |dB| at whole degrees.
fn duct_box(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("derived/IIIS.C.s1.f11.csv")).only(&[("source", "reference")]);
    let table = table.between("az_deg", 10.0, 45.0);
    let mesh = bodies::stl(&folder.join("meshes/IIIS.C.s1.stl"));
    let az_deg: Vec<f64> = (10..=45).map(f64::from).collect();
    let antennas: Vec<Standpoint> = az_deg.iter().map(|az| antenna(*az, 0.0, f64::INFINITY)).collect();
    let bart = Bart { frequency_hz: 10.2451e9, nodes: Exit, ..Bart::bounces(&mesh, 3) };
    let got: Vec<Amplitude> = bart.orders(&antennas).iter().map(|s| sum(s)).collect();
    let mut rows = Vec::new();
    let mut all = Vec::new();
    for ((p, pol), gate) in ["vv", "hh"].into_iter().enumerate().zip([2.5, 4.6]) {
        let cut = table.only(&[("pol", pol)]);
        let whole = |az: &f64| (az - az.round()).abs() < 1e-9;
        let reference: Vec<f64> = cut
            .numbers("az_deg")
            .iter()
            .zip(cut.numbers("rcs_dbsm"))
            .filter(|(az, _)| whole(az))
            .map(|(_, level)| level)
            .collect();
        let levels: Vec<f64> = got.iter().map(|s| dbsm(s[p][p])).collect();
        let figure = mean_db(&levels, &reference)[0];
        let check = format!("duct box IIIS.C, {pol}, az 10–45, 3 bounces, Exit: mean |dB|");
        rows.push(Row::at_most(check, figure, gate, "dB"));
        all.extend(levels);
    }
    let mean = power_mean_dbsm(&all);
    let check = "duct box IIIS.C, power mean of vv and hh over az 10–45, 3 bounces, Exit";
    rows.push(Row::near(check, mean, 5.17, 1.0, "dBsm"));
    rows
}
