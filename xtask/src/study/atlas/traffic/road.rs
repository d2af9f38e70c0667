//! The road as a reflector, at and near Brewster's angle.

use crate::study::atlas::CaseRow;
use crate::study::atlas::methods;
use crate::study::atlas::traffic::overlapping::empty;
use crate::study::atlas::verdict::printed;
use crate::study::bodies;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::{paths_of, with_body};
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::Sides;
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::Standpoint;
use num_complex::Complex64;
use po_sbr::{Aspect, Bracket, po};
use std::f64::consts::TAU;
use wayside::host::failure::Failure;

/// Asphalt of the paper's figures (docs/physics.md §5).
const ASPHALT: Complex64 = Complex64::new(9.5, -0.3);
const DISTANCE_M: f64 = 3.0;
const HEIGHT_M: f64 = 0.3;
/// Frequencies over the sweep, like the printed error: a path by the road fades single frequencies.
const BAND_HZ: [f64; 5] = [76.7e9, 76.85e9, 77.0e9, 77.15e9, 77.3e9];

/// A sphere above a smooth road at a grazing angle: the four paths by the antenna's image, each by dense
/// sampling of the sphere, times r for each reflection by the road. E across the road has r_TE, H across it
/// r_TM.
pub(in crate::study::atlas) fn brewster(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::ROAD
        .trial("sphere above a smooth road, Brewster's angle is 18.0°", "polarization, grazing_deg");
    let sphere = bodies::sphere(0.05, 24);
    let mut rows = Vec::new();
    for grazing_deg in [6.0_f64, 17.98, 40.0] {
        let tangent = grazing_deg.to_radians().tan();
        // The path by the road reaches the sphere's middle at this angle.
        let radar_m = DISTANCE_M * tangent - HEIGHT_M;
        let road =
            format!("[road]\npermittivity = [{:?}, {:?}]\nrms_height_mm = 0.0\n", ASPHALT.re, -ASPHALT.im);
        let header = moved(empty(&road, 1)?, radar_m);
        let header = with_body(header, &sphere, [0.0, DISTANCE_M, HEIGHT_M], [0.0; 3]);
        for (index, polarization) in [Polarization::Vv, Polarization::Hh].into_iter().enumerate() {
            let mut asked = header.clone();
            asked.radar.array.polarization = polarization;
            let frame = paths_of(&asked)?;
            let says = printed(&frame.error);
            let found: Vec<Complex64> = BAND_HZ
                .iter()
                .map(|f| rcs_solvers::first_body_scattering(&asked, &frame.paths, *f)[index][index])
                .collect();
            let exact = by_images(&sphere, radar_m, grazing_deg.to_radians(), index)?;
            let error = rcs_solvers::relative_error(&found, &exact);
            rows.push(trial.answered(format!("{polarization:?}, {grazing_deg}"), error, says));
        }
    }
    Ok(rows)
}

/// The radar with its elements at this height.
fn moved(mut header: artifact::scene::SceneHeader, height_m: f64) -> artifact::scene::SceneHeader {
    let up_m = height_m - header.radar.position_m[2];
    header.radar.position_m[2] = height_m;
    header.radar.array.tx_m.iter_mut().chain(&mut header.radar.array.rx_m).for_each(|p| p[2] += up_m);
    header
}

/// S of one polarization over the band.
fn by_images(
    sphere: &Mesh,
    radar_m: f64,
    grazing_rad: f64,
    polarization: usize,
) -> Result<Vec<Complex64>, Failure> {
    let standpoint = |up_m: f64| {
        let up_m = up_m - HEIGHT_M;
        let range_m = DISTANCE_M.hypot(up_m);
        Standpoint { azimuth_rad: 0.0, elevation_rad: (up_m / range_m).asin(), range_m }
    };
    let (real, image) = (standpoint(radar_m), standpoint(-radar_m));
    let (sin, cos2) = (grazing_rad.sin(), grazing_rad.cos().powi(2));
    let s = (ASPHALT - cos2).sqrt();
    let reflected = [(ASPHALT * sin - s) / (ASPHALT * sin + s), (sin - s) / (sin + s)][polarization];
    let sampling = po::Sampling {
        per_wavelength: 3.0,
        shadow_levels: 5,
        sides: Sides::Two,
        bracket: Bracket::Symmetrised,
    };
    let mut sums = vec![Complex64::ZERO; BAND_HZ.len()];
    let ways = [(real, real, 0), (real, image, 1), (image, real, 1), (image, image, 2)];
    for (transmitter, receiver, passages) in ways {
        let found = po::amplitude(sphere, &Aspect { transmitter, receiver }, &BAND_HZ, &sampling);
        let way_m = transmitter.range_m + receiver.range_m - 2.0 * real.range_m;
        let spread = real.range_m * real.range_m / (transmitter.range_m * receiver.range_m);
        for ((sum, s), f) in sums.iter_mut().zip(found.map_err(Failure::refused)?).zip(BAND_HZ) {
            let turn = Complex64::cis(-TAU * f / SPEED_OF_LIGHT_MPS * way_m);
            *sum += spread * turn * s[polarization][polarization] * reflected.powi(passages);
        }
    }
    Ok(sums)
}
