//! Geometrical optics between bounces on bodies of some wavelengths: how far it is from full-wave solutions
//! is known.

use super::bodies;
use super::method::{Bart, antenna, sum};
use super::row::Row;
use super::table::{Table, complex_error, dbsm, mean_db, power_mean_dbsm};
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::settings::NodeRule::{self, Exit, Middle, OwnEdge};
use bart_rcs::Standpoint;
use std::path::Path;

/// A cut through a full-wave body and the mean |dB| it may be off, vv and hh, with exit nodes: the gates are
/// figures of shooting and bouncing rays, whose node is the last facet.
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
    Case {
        body: "trihedral_4lambda",
        el_deg: AXIS_EL_DEG,
        az_deg: [1.0, 89.0],
        bounces: 3,
        gate_db: [0.9, 0.7],
    },
    Case { body: "trihedral_4lambda", el_deg: 15.0, az_deg: [1.0, 89.0], bounces: 3, gate_db: [1.2, 0.6] },
];

/// Elevation of a trihedral's axis, atan(1/√2).
const AXIS_EL_DEG: f64 = 35.264_389_682_754_654;

pub(crate) fn rows(folder: &Path) -> Vec<Row> {
    let mut rows = Vec::new();
    for nodes in [Exit, Middle, OwnEdge] {
        rows.extend(CASES.iter().flat_map(|case| case_rows(case, nodes, &folder.join("fullwave"))));
        rows.extend(trihedral_peak(nodes, &folder.join("fullwave")));
        rows.extend(HOVERING.iter().flat_map(|case| hovering_rows(case, nodes, &folder.join("fullwave"))));
        rows.extend(duct_box(nodes, &folder.join("austin")));
    }
    rows.extend(corners_in_the_plane(&folder.join("fullwave")));
    rows
}

/// Gated with exit nodes, for comparison with others.
fn row(nodes: NodeRule, check: String, figure: f64, limit: f64) -> Row {
    match nodes {
        Exit => Row::at_most(check, figure, limit, "dB"),
        Middle | OwnEdge => Row::shown(check, figure, "dB"),
    }
}

fn case_rows(case: &Case, nodes: NodeRule, folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join(format!("{}.csv", case.body)));
    let table = table.between("el_deg", case.el_deg - 1e-3, case.el_deg + 1e-3);
    let table = table.between("az_deg", case.az_deg[0], case.az_deg[1]);
    let mesh = bodies::stl(&folder.join(format!("{}.stl", case.body)));
    let az_deg = table.only(&[("pol", "vv")]).numbers("az_deg");
    let antennas: Vec<Standpoint> =
        az_deg.into_iter().map(|az| antenna(az, case.el_deg, f64::INFINITY)).collect();
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

/// A box with a round blind duct, 10.2451 GHz: the mean level over az 10–45 and the mean |dB| at whole
/// degrees.
fn duct_box(nodes: NodeRule, folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("derived/IIIS.C.s1.f11.csv")).only(&[("source", "reference")]);
    let table = table.between("az_deg", 10.0, 45.0);
    let mesh = bodies::stl(&folder.join("meshes/IIIS.C.s1.stl"));
    let az_deg: Vec<f64> = (10..=45).map(f64::from).collect();
    let antennas: Vec<Standpoint> = az_deg.iter().map(|az| antenna(*az, 0.0, f64::INFINITY)).collect();
    let bart = Bart { frequency_hz: 10.2451e9, nodes, ..Bart::bounces(&mesh, 3) };
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
        let check = format!("duct box IIIS.C, {pol}, az 10–45, 3 bounces, {nodes:?}: mean |dB|");
        rows.push(row(nodes, check, figure, gate));
        all.extend(levels);
    }
    let mean = power_mean_dbsm(&all);
    let check = format!("duct box IIIS.C, power mean of vv and hh over az 10–45, 3 bounces, {nodes:?}");
    rows.push(match nodes {
        Exit => Row::near(check, mean, 5.17, 1.0, "dBsm"),
        Middle | OwnEdge => Row::shown(check, mean, "dBsm"),
    });
    rows
}

/// A plate of 2.5 wavelengths that hovers over a mirror of 6: the sequence mirror, plate, mirror is specular
/// at az 0.
const HOVERING: [(&str, [f64; 2]); 2] =
    [("mirror35_6lambda", [20.0, 50.0]), ("mirror15_6lambda", [5.0, 30.0])];

/// Complex error over elevations about the specular, orders 1 to 4; too small for geometrical optics to be
/// good.
fn hovering_rows((body, el_deg): &(&str, [f64; 2]), nodes: NodeRule, folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join(format!("{body}.csv"))).between("az_deg", -1e-3, 1e-3);
    let table = table.between("el_deg", el_deg[0], el_deg[1]);
    let mesh = bodies::stl(&folder.join(format!("{body}.stl")));
    let elevations = table.only(&[("pol", "vv")]).numbers("el_deg");
    let antennas: Vec<Standpoint> =
        elevations.into_iter().map(|el| antenna(0.0, el, f64::INFINITY)).collect();
    let got: Vec<Amplitude> =
        Bart { nodes, ..Bart::bounces(&mesh, 4) }.orders(&antennas).iter().map(|s| sum(s)).collect();
    let row = |(p, pol): (usize, &str)| {
        let s: Vec<_> = got.iter().map(|s| s[p][p]).collect();
        let error = complex_error(&s, &table.only(&[("pol", pol)]).complex("s_re_m", "s_im_m"));
        let [low, high] = el_deg;
        let check = format!("{body}, az 0, el {low}–{high}, {pol}, 4 bounces, {nodes:?}: complex error");
        Row::shown(check, 20.0 * error.log10(), "dB")
    };
    ["vv", "hh"].into_iter().enumerate().map(row).collect()
}

/// Strips of 10 to 24 wavelengths in the x-z plane (`generate2d.py`), as bodies of this length along y, in
/// wavelengths.
const LENGTH: f64 = 1000.0;

/// The six scenes of `corners2d.csv`: mean over scenes of the complex error of S over the cut, 4 bounces.
fn corners_in_the_plane(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("corners2d.csv"));
    let scenes = ["hover15", "hover35", "wedge80", "wedge88", "wedge95", "wedge100"];
    let of_rule = |nodes: NodeRule| {
        let errors: Vec<[f64; 2]> = scenes.iter().map(|scene| in_the_plane(scene, nodes, &table)).collect();
        let mean = |p: usize| errors.iter().map(|e| 20.0 * e[p].log10()).sum::<f64>() / scenes.len() as f64;
        ["vv", "hh"]
            .into_iter()
            .enumerate()
            .map(move |(p, pol)| {
                let check = format!(
                    "corners2d, mean of six scenes, el 5–75.5, {pol}, 4 bounces, {nodes:?}: complex error"
                );
                Row::shown(check, mean(p), "dB")
            })
            .collect::<Vec<_>>()
    };
    [Exit, Middle, OwnEdge].into_iter().flat_map(of_rule).collect()
}

/// Complex error of one scene, vv and hh.
fn in_the_plane(scene: &str, nodes: NodeRule, table: &Table) -> [f64; 2] {
    let table = table.only(&[("scene", scene)]);
    let wavelength_m = artifact::units::SPEED_OF_LIGHT_MPS / super::method::FREQUENCY_HZ;
    let mesh = extruded(&strips(scene), LENGTH, wavelength_m);
    // Every second of 142 elevations.
    let table = ["vv", "hh"].map(|pol| table.only(&[("pol", pol)]).every(2));
    let elevations = table[0].numbers("el_deg");
    let antennas: Vec<Standpoint> =
        elevations.into_iter().map(|el| antenna(0.0, el, f64::INFINITY)).collect();
    let got: Vec<Amplitude> =
        Bart { nodes, ..Bart::bounces(&mesh, 4) }.orders(&antennas).iter().map(|s| sum(s)).collect();
    [0, 1].map(|p| {
        let s: Vec<_> = got.iter().map(|s| s[p][p] / (LENGTH * wavelength_m)).collect();
        complex_error(&s, &table[p].complex("s_re", "s_im"))
    })
}

/// Bent strips of a scene, in wavelengths.
fn strips(scene: &str) -> Vec<Vec<[f64; 2]>> {
    let degrees = |prefix: &str| scene.strip_prefix(prefix).map(|angle| angle.parse::<f64>().unwrap());
    if let Some(angle) = degrees("wedge") {
        let (sin, cos) = angle.to_radians().sin_cos();
        return vec![vec![[24.0, 0.0], [0.0, 0.0], [12.0 * cos, 12.0 * sin]]];
    }
    let angle = degrees("hover").unwrap();
    let (sin, cos) = angle.to_radians().sin_cos();
    let centre = [-8.4, if angle == 15.0 { 6.4 } else { 8.0 }];
    let end = |side: f64| [centre[0] + side * 5.0 * sin, centre[1] + side * 5.0 * cos];
    vec![vec![[-12.0, 0.0], [12.0, 0.0]], vec![end(-1.0), end(1.0)]]
}

fn extruded(strips: &[Vec<[f64; 2]>], length: f64, wavelength_m: f64) -> Mesh {
    let at = |p: [f64; 2], y: f64| [p[0] * wavelength_m, y * wavelength_m, p[1] * wavelength_m];
    let h = 0.5 * length;
    let wall = |ends: &[[f64; 2]]| vec![at(ends[0], -h), at(ends[1], -h), at(ends[1], h), at(ends[0], h)];
    bodies::mesh_of(&strips.iter().flat_map(|strip| strip.windows(2).map(wall)).collect::<Vec<_>>())
}
