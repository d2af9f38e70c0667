//! The Austin RCS benchmark suite: bodies of flat facets, where the error of physical optics is physics and
//! known.

use super::bodies;
use super::method::{Bart, antenna};
use super::row::Row;
use super::table::{Table, dbsm, mean_db, power_mean_dbsm};
use artifact::radar::Polarization::{Hh, Hv, Vh, Vv};
use bart_rcs::Standpoint;
use std::path::Path;

/// First-order levels over a case's cut beside its reference solution.
struct Cut {
    az_deg: Vec<f64>,
    reference_dbsm: [Vec<f64>; 2],
    got_dbsm: Vec<f64>,
    worst_polarization: f64,
}

const POLARIZATIONS: [&str; 2] = ["vv", "hh"];

/// Every `step`th aspect of a case's cut.
fn cut(folder: &Path, case: &str, mesh: &str, step: usize) -> Cut {
    let folder = folder.join("austin");
    let table = Table::read(&folder.join(format!("derived/{case}.csv")));
    let table = table.only(&[("source", "reference")]);
    let of = |pol: &str| table.only(&[("pol", pol)]).every(step);
    let vv = of("vv");
    let az_deg = vv.numbers("az_deg");
    let aspects: Vec<_> = az_deg.iter().map(|az| antenna(*az, 0.0, f64::INFINITY)).collect();
    let mesh = bodies::stl(&folder.join(format!("meshes/{mesh}.stl")));
    let bart = Bart { frequency_hz: 1e9 * vv.numbers("freq_ghz")[0], ..Bart::first_order(&mesh) };
    let got = bart.vv(&aspects);
    let some: Vec<Standpoint> = aspects.into_iter().step_by(30).collect();
    let all_elements = bart.elements(&some, &[Vv, Hh, Vh, Hv]);
    let peak = all_elements.iter().map(|s| s[0][0][0].norm()).fold(0.0, f64::max);
    Cut {
        reference_dbsm: POLARIZATIONS.map(|pol| of(pol).numbers("rcs_dbsm")),
        got_dbsm: got.into_iter().map(dbsm).collect(),
        worst_polarization: all_elements
            .iter()
            .map(|s| (s[0][0][0] - s[0][1][1]).norm().max(s[0][0][1].norm()))
            .fold(0.0, f64::max)
            / peak,
        az_deg,
    }
}

impl Cut {
    /// Levels of the aspects between azimuths.
    fn part<'a>(&'a self, levels: &'a [f64], low: f64, high: f64) -> Vec<f64> {
        self.az_deg.iter().zip(levels).filter(|(az, _)| (low..=high).contains(*az)).map(|(_, l)| *l).collect()
    }

    fn mean_rows(&self, name: &str, known: [[f64; 2]; 2], tolerance: f64) -> Vec<Row> {
        let mut rows = Vec::new();
        for (pol, (reference, known)) in POLARIZATIONS.iter().zip(self.reference_dbsm.iter().zip(known)) {
            for (what, (figure, known)) in
                ["all", "top 30"].iter().zip(mean_db(&self.got_dbsm, reference).into_iter().zip(known))
            {
                let check = format!("{name}, {pol}, {what}: mean |dB| from the reference solution");
                rows.push(Row::near(check, figure, known, tolerance, "dB"));
            }
        }
        rows
    }
}

pub(crate) fn rows(folder: &Path) -> Vec<Row> {
    let closed_box = cut(folder, "IIIS.A.s1.f11", "IIIS.A.s1", 1);
    let mut rows = closed_box.mean_rows("closed box IIIS.A 10.24 GHz", [[2.37, 0.59], [2.64, 0.56]], 0.03);
    let mean = power_mean_dbsm(&closed_box.part(&closed_box.got_dbsm, 10.0, 45.0));
    rows.push(Row::near("closed box IIIS.A, power mean az 10–45", mean, -17.56, 0.03, "dBsm"));
    let plate = cut(folder, "II.B.sx1.f11", "II.B.sx1", 1);
    rows.extend(plate.mean_rows("thick plate II.B 10.24 GHz", [[6.62, 0.67], [5.03, 0.72]], 0.03));
    // 34 368 facets: every second degree, which moves the means by less than a third of the gate.
    let almond = cut(folder, "III.A.s1.fx3", "III.A.s1", 4);
    rows.extend(almond_rows(&almond));
    let worst = [&closed_box, &plate, &almond].map(|c| c.worst_polarization).into_iter().fold(0.0, f64::max);
    rows.push(Row::at_most("the three bodies: vv against hh, and vh, over the peak", worst, 1e-12, ""));
    rows
}

/// Rows of the almond: what is off here is physics (tip, creeping waves), and by how much is known.
fn almond_rows(almond: &Cut) -> Vec<Row> {
    let mut rows = Vec::new();
    let got = almond.part(&almond.got_dbsm, 60.0, 120.0);
    for (i, (broadside, over_all)) in [(1.97, 4.71), (2.46, 8.06)].into_iter().enumerate() {
        let pol = POLARIZATIONS[i];
        let reference = almond.part(&almond.reference_dbsm[i], 60.0, 120.0);
        let figure = mean_db(&got, &reference)[0];
        rows.push(Row::near(
            format!("almond 7 GHz, {pol}, az 60–120: mean |dB|"),
            figure,
            broadside,
            0.1,
            "dB",
        ));
        let figure = mean_db(&almond.got_dbsm, &almond.reference_dbsm[i])[0];
        rows.push(Row::near(
            format!("almond 7 GHz, {pol}, all aspects: mean |dB|"),
            figure,
            over_all,
            0.1,
            "dB",
        ));
    }
    rows
}
