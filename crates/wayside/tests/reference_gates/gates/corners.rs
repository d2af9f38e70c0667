//! Corner reflectors large against the wavelength: the multiple-bounce term alone has a closed form.

use super::bodies::{self, Faces};
use super::method::{Bart, antenna, sum};
use super::row::Row;
use super::table::{Table, dbsm, worst_of_peak};
use artifact::paths::Amplitude;
use bart_rcs::Standpoint;
use num_complex::Complex64;
use std::path::Path;

/// Elevation of a trihedral's axis, atan(1/√2).
const AXIS_EL_DEG: f64 = 35.264_389_682_754_654;

pub(crate) fn rows(folder: &Path) -> Vec<Row> {
    let folder = folder.join("closed_form");
    let mut rows = peaks(&folder);
    rows.extend(off_axis(&folder));
    rows.extend(signs());
    rows.extend(dihedral_sums(&folder));
    rows
}

fn far(az_deg: f64, el_deg: f64) -> Standpoint {
    antenna(az_deg, el_deg, f64::INFINITY)
}

fn peaks(folder: &Path) -> Vec<Row> {
    let known = Table::read(&folder.join("corner_peaks.csv")).only(&[("side_m", "0.1"), ("freq_ghz", "77")]);
    let mut rows = Vec::new();
    for (faces, column) in
        [(Faces::Triangular, "triangular_trihedral_dbsm"), (Faces::Square, "square_trihedral_dbsm")]
    {
        let s =
            Bart::bounces(&bodies::trihedral(0.1, faces), 3).orders(&[far(45.0, AXIS_EL_DEG)])[0][2][0][0];
        let check = format!("{faces:?} trihedral 0.1 m, triple bounce on the axis").to_lowercase();
        rows.push(Row::near(check, dbsm(s), known.numbers(column)[0], 0.1, "dBsm"));
    }
    let s = Bart::bounces(&bodies::dihedral(0.1), 2).orders(&[far(0.0, 0.0)])[0][1][0][0];
    rows.push(Row::near(
        "dihedral 0.1 m, double bounce",
        dbsm(s),
        known.numbers("dihedral_dbsm")[0],
        0.1,
        "dBsm",
    ));
    rows
}

/// Worst level of the triple bounce over the mouth's directions within 10 dB of the peak.
fn off_axis(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("trihedral_triple_bounce.csv"));
    let row = |(faces, column): (Faces, &str)| {
        let peak = table.numbers(column).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let near_peak = table.between(column, peak - 10.0, peak);
        let mesh = bodies::trihedral(0.1, faces);
        let (az, el) = (near_peak.numbers("az_deg"), near_peak.numbers("el_deg"));
        let antennas: Vec<Standpoint> = az.iter().zip(&el).map(|(az, el)| far(*az, *el)).collect();
        let got = Bart::bounces(&mesh, 3).orders(&antennas);
        let off =
            got.iter().zip(near_peak.numbers(column)).map(|(s, known)| (dbsm(s[2][0][0]) - known).abs());
        let worst = off.fold(0.0, f64::max);
        let check = format!("{faces:?} trihedral 0.1 m, triple bounce, {} directions: worst level", az.len());
        Row::at_most(check.to_lowercase(), worst, 0.1, "dB")
    };
    [(Faces::Triangular, "triangular_dbsm"), (Faces::Square, "square_dbsm")].map(row).into()
}

/// Angle between S and the sign it must have.
fn off_sign_deg(s: Complex64, sign: Complex64) -> f64 {
    (s / sign).arg().to_degrees().abs()
}

fn signs() -> Vec<Row> {
    let j = Complex64::I;
    let plate: Amplitude = Bart::bounces(&bodies::square(0.1), 1).orders(&[far(0.0, 0.0)])[0][0];
    let double = Bart::bounces(&bodies::dihedral(0.1), 2).orders(&[far(0.0, 0.0)])[0][1];
    let triple =
        Bart::bounces(&bodies::trihedral(0.1, Faces::Triangular), 3).orders(&[far(45.0, AXIS_EL_DEG)])[0][2];
    let cases = [
        ("plate seen square, vv: +j|S|", plate[0][0], j),
        ("plate seen square, hh: +j|S|", plate[1][1], j),
        ("dihedral's double bounce, vv: −j|S|", double[0][0], -j),
        ("dihedral's double bounce, hh: +j|S|", double[1][1], j),
        ("trihedral's triple bounce, vv: −j|S|", triple[0][0], -j),
        ("trihedral's triple bounce, hh: −j|S|", triple[1][1], -j),
    ];
    cases
        .map(|(check, s, sign)| Row::at_most(format!("sign of a {check}"), off_sign_deg(s, sign), 1.0, "°"))
        .into()
}

fn dihedral_sums(folder: &Path) -> Vec<Row> {
    let table = Table::read(&folder.join("dihedral_po.csv"));
    let mut rows = Vec::new();
    for side in ["0.05", "0.1"] {
        let mesh = bodies::dihedral(side.parse().unwrap());
        let az = table.only(&[("side_m", side), ("pol", "vv")]).numbers("az_deg");
        let antennas: Vec<Standpoint> = az.iter().map(|az| far(*az, 0.0)).collect();
        let got: Vec<Amplitude> = Bart::bounces(&mesh, 2).orders(&antennas).iter().map(|s| sum(s)).collect();
        for (p, pol) in ["vv", "hh"].into_iter().enumerate() {
            let reference = table.only(&[("side_m", side), ("pol", pol)]).complex("sum_re_m", "sum_im_m");
            let got: Vec<Complex64> = got.iter().map(|s| s[p][p]).collect();
            let check = format!("dihedral {side} m, {pol}, orders 1 + 2: worst |ΔS| over the peak");
            rows.push(Row::at_most(check, worst_of_peak(&got, &reference), 1e-2, ""));
        }
    }
    rows
}
