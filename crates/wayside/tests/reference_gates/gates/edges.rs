//! Edges against exact, measured and full-wave solutions: each figure beside its gate, beside plain physical
//! optics and beside what the data itself is worth.

use super::bodies;
use super::method::{Bart, FREQUENCY_HZ, antenna, sum};
use super::row::Row;
use super::table::{Table, complex_error, dbsm, mean_db, power_mean_dbsm};
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::settings::{Edges, NodeRule};
use bart_rcs::Standpoint;
use num_complex::Complex64;
use std::f64::consts::PI;
use std::path::Path;

const POLARIZATIONS: [&str; 2] = ["vv", "hh"];

pub(crate) fn rows(folder: &Path) -> Vec<Row> {
    let mut rows = strips(folder);
    rows.extend(austin(folder));
    rows.extend(full_wave(folder));
    rows
}

fn far(az_deg: f64, el_deg: f64) -> Standpoint {
    antenna(az_deg, el_deg, f64::INFINITY)
}

/// S over antennas with edges and without, orders added.
fn with_and_without(
    mesh: &Mesh,
    frequency_hz: f64,
    bounces: u8,
    antennas: &[Standpoint],
) -> [Vec<Amplitude>; 2] {
    [Edges::FirstOrder, Edges::Ignored].map(|edges| {
        let nodes = if bounces > 1 { NodeRule::OwnEdge } else { NodeRule::Middle };
        let bart = Bart { frequency_hz, bounces, edges, nodes, ..Bart::with_edges(mesh) };
        bart.orders(antennas).iter().map(|orders| sum(orders)).collect()
    })
}

/// A figure with what it was without edges and what the data is worth.
fn row(check: &str, [with, without]: [f64; 2], gate: f64, floor: &str, unit: &'static str) -> Row {
    let check = format!("{check} (physical optics {without:.2}, the data's own {floor})");
    Row::at_most(check, with, gate, unit)
}

/// Strips without ends: two of different height share what their ends scatter, so their difference is F over
/// the rest of the height, S_vv = −(l/√π)F, S_hh = +(l/√π)F.
fn strips(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("wedge/strip.csv"));
    let wavelength_m = 299_792_458.0 / FREQUENCY_HZ;
    let mut rows = Vec::new();
    for (width, gates) in [("5", [0.03, 0.01]), ("10", [0.02, 0.01]), ("20", [0.01, 0.01])] {
        let cut = |pol| {
            table.only(&[("width_wavelengths", width), ("pol", pol)]).between("phi_deg", 30.0, 90.0).every(3)
        };
        let exact = ["soft", "hard"].map(cut);
        let antennas: Vec<Standpoint> =
            exact[0].numbers("phi_deg").iter().map(|phi| far(90.0 - phi, 0.0)).collect();
        let width_m = width.parse::<f64>().unwrap() * wavelength_m;
        // Waves that run from the ends along the upright edges are the same from four widths of height on.
        let heights = [4.0, 8.0].map(|widths| widths * width_m);
        let of = |h_m: f64| {
            let (w, h) = (0.5 * width_m, 0.5 * h_m);
            let mesh = bodies::mesh_of(&[vec![[0.0, -w, -h], [0.0, w, -h], [0.0, w, h], [0.0, -w, h]]]);
            with_and_without(&mesh, FREQUENCY_HZ, 1, &antennas)
        };
        let [short, long] = heights.map(of);
        for (p, name) in ["E ∥ edges", "H ∥ edges"].into_iter().enumerate() {
            let known = exact[p].numbers("exact_db_wavelength");
            let figure = [0, 1].map(|edges| {
                let level = |(a, b): (&Amplitude, &Amplitude)| {
                    let f: Complex64 = (b[p][p] - a[p][p]) * PI.sqrt() / (heights[1] - heights[0]);
                    10.0 * (f.norm_sqr() / (2.0 * PI)).log10()
                };
                let got: Vec<f64> = short[edges].iter().zip(&long[edges]).map(level).collect();
                mean_db(&got, &known)[0]
            });
            let check =
                format!("strip of {width} wavelengths, {name}, 30° and more from its plane: mean |dB|");
            rows.push(row(&check, figure, gates[p], "1e-6", "dB"));
        }
    }
    rows
}

/// A cut of the Austin suite and the gates on its mean |dB| over all its angles.
struct Cut {
    case: &'static str,
    mesh: &'static str,
    name: &'static str,
    az_deg: [f64; 2],
    step: usize,
    gate_db: [f64; 2],
    floor: [&'static str; 2],
}

const CUTS: [Cut; 2] = [
    Cut {
        case: "II.A.sx1.f11",
        mesh: "II.A.sx1",
        name: "thin plate II.A 10.2 GHz, az to 60",
        az_deg: [0.0, 60.0],
        step: 2,
        gate_db: [0.4, 0.7],
        floor: ["unknown", "unknown"],
    },
    Cut {
        case: "II.B.sx1.f11",
        mesh: "II.B.sx1",
        name: "thick plate II.B 10.24 GHz, az to 60",
        az_deg: [0.0, 60.0],
        step: 2,
        gate_db: [0.4, 1.2],
        floor: ["0.28", "0.43"],
    },
];

fn austin(folder: &Path) -> Vec<Row> {
    let mut rows = Vec::new();
    for cut in &CUTS {
        let levels = cut.levels(folder);
        for (p, pol) in POLARIZATIONS.into_iter().enumerate() {
            let figure = levels.got.each_ref().map(|got| mean_db(&got[p], &levels.reference[p])[0]);
            rows.push(row(
                &format!("{}, {pol}: mean |dB|", cut.name),
                figure,
                cut.gate_db[p],
                cut.floor[p],
                "dB",
            ));
        }
    }
    rows.extend(closed_box(folder));
    rows
}

struct Levels {
    az_deg: Vec<f64>,
    reference: [Vec<f64>; 2],
    /// Levels in dBsm, `[with edges, without][polarization][azimuth]`.
    got: [[Vec<f64>; 2]; 2],
}

impl Cut {
    fn levels(&self, folder: &Path) -> Levels {
        let table = Table::read(&folder.join(format!("austin/derived/{}.csv", self.case)));
        let table = table.only(&[("source", "reference")]).between("az_deg", self.az_deg[0], self.az_deg[1]);
        let of = |pol: &str| table.only(&[("pol", pol)]).every(self.step);
        let vv = of("vv");
        let az_deg = vv.numbers("az_deg");
        let antennas: Vec<Standpoint> = az_deg.iter().map(|az| far(*az, 0.0)).collect();
        let mesh = bodies::stl(&folder.join(format!("austin/meshes/{}.stl", self.mesh)));
        let got = with_and_without(&mesh, 1e9 * vv.numbers("freq_ghz")[0], 1, &antennas);
        let level = |s: &[Amplitude], p: usize| s.iter().map(|s| dbsm(s[p][p])).collect::<Vec<f64>>();
        Levels {
            az_deg,
            reference: POLARIZATIONS.map(|pol| of(pol).numbers("rcs_dbsm")),
            got: got.map(|s| [level(&s, 0), level(&s, 1)]),
        }
    }
}

fn closed_box(folder: &Path) -> Vec<Row> {
    let cut = Cut {
        case: "IIIS.A.s1.f11",
        mesh: "IIIS.A.s1",
        name: "closed box IIIS.A 10.24 GHz",
        az_deg: [0.0, 180.0],
        step: 1,
        gate_db: [0.25, 0.4],
        floor: ["1.29", "1.89"],
    };
    let levels = cut.levels(folder);
    let mut rows = Vec::new();
    for (p, pol) in POLARIZATIONS.into_iter().enumerate() {
        let means = levels.got.each_ref().map(|got| mean_db(&got[p], &levels.reference[p]));
        for (i, (what, gate)) in [("all", cut.gate_db[p]), ("top 30", [0.1, 0.2][p])].into_iter().enumerate()
        {
            let check = format!("{}, {pol}, {what}: mean |dB|", cut.name);
            rows.push(row(&check, means.map(|m| m[i]), gate, cut.floor[p], "dB"));
        }
        let part = |levels_dbsm: &[f64]| {
            let inside = levels.az_deg.iter().zip(levels_dbsm).filter(|(az, _)| (10.0..=45.0).contains(*az));
            power_mean_dbsm(&inside.map(|(_, l)| *l).collect::<Vec<_>>())
        };
        let off = levels.got.each_ref().map(|got| (part(&got[p]) - part(&levels.reference[p])).abs());
        let check = format!("{}, {pol}, power mean az 10–45, off the reference", cut.name);
        rows.push(row(&check, off, [0.1, 0.4][p], ["0.07", "0.27"][p], "dB"));
    }
    rows
}

/// A cut through a full-wave body: gates on the mean |dB| and on the complex error, infinite where it is
/// shown for comparison. Off the plane of its axis a dihedral is carried by its edges, also by those seen in
/// the mirrors.
struct Solved {
    body: &'static str,
    el_deg: f64,
    az_deg: [f64; 2],
    bounces: u8,
    gate_db: [f64; 2],
    gate_complex: [f64; 2],
}

const SOLVED: [Solved; 4] = [
    Solved {
        body: "plate_5lambda",
        el_deg: 0.0,
        az_deg: [0.0, 60.0],
        bounces: 1,
        gate_db: [0.2, 0.5],
        gate_complex: [0.008, 0.025],
    },
    Solved {
        body: "cube_2p784lambda",
        el_deg: 0.0,
        az_deg: [0.0, 45.0],
        bounces: 1,
        gate_db: [0.5, 0.8],
        gate_complex: [0.03, 0.06],
    },
    Solved {
        body: "dihedral_3lambda",
        el_deg: 10.0,
        az_deg: [-44.0, 44.0],
        bounces: 3,
        gate_db: [1.0, f64::INFINITY],
        gate_complex: [0.23, 0.5],
    },
    Solved {
        body: "dihedral_6lambda",
        el_deg: 10.0,
        az_deg: [-44.0, 44.0],
        bounces: 3,
        gate_db: [1.0, f64::INFINITY],
        gate_complex: [0.21, 0.38],
    },
];

fn full_wave(folder: &Path) -> Vec<Row> {
    SOLVED.iter().flat_map(|case| solved_rows(case, &folder.join("fullwave"))).collect()
}

fn solved_rows(case: &Solved, folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join(format!("{}.csv", case.body)));
    let table = table.between("el_deg", case.el_deg - 1e-3, case.el_deg + 1e-3);
    let table = table.between("az_deg", case.az_deg[0], case.az_deg[1]);
    let of = |pol: &str| table.only(&[("pol", pol)]).every(if case.bounces > 1 { 3 } else { 1 });
    let antennas: Vec<Standpoint> =
        of("vv").numbers("az_deg").iter().map(|az| far(*az, case.el_deg)).collect();
    let mesh = bodies::stl(&folder.join(format!("{}.stl", case.body)));
    let got = with_and_without(&mesh, FREQUENCY_HZ, case.bounces, &antennas);
    let mut rows = Vec::new();
    for (p, pol) in POLARIZATIONS.into_iter().enumerate() {
        let reference = of(pol);
        let s = got.each_ref().map(|s| s.iter().map(|s| s[p][p]).collect::<Vec<Complex64>>());
        let levels = |s: &[Complex64]| s.iter().map(|s| dbsm(*s)).collect::<Vec<f64>>();
        let figure = s.each_ref().map(|s| mean_db(&levels(s), &reference.numbers("rcs_dbsm"))[0]);
        let name = format!("full-wave {}, el {}, {pol}", case.body, case.el_deg);
        rows.push(row(&format!("{name}: mean |dB|"), figure, case.gate_db[p], "0.05", "dB"));
        let figure = s.each_ref().map(|s| complex_error(s, &reference.complex("s_re_m", "s_im_m")));
        rows.push(row(&format!("{name}: complex error"), figure, case.gate_complex[p], "0.01", ""));
    }
    rows
}
