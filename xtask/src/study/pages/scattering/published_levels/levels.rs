//! Levels all round a vehicle in the far field, compared with the published ones.

use super::super::bodies::Named;
use super::published::{Sector, published_dbsm};
use crate::study::pages::measures::references::methods::request;
use artifact::settings::{Class, NodeRule, SmallParts};
use artifact::units::db_from_power;
use bart_rcs::{RcsRequest, Standpoint, rcs};
use wayside::host::failure::Failure;

/// Elevations of the radar, degrees: level with the car, and at the lobes of the sides and the rear.
pub(super) const ELEVATIONS_DEG: [f64; 2] = [0.0, 10.0];

const STEP_DEG: f64 = 3.0;
/// Number of aspects to either side in the average of a level: with the aspect itself 15°, half of a lobe.
const BESIDE: i64 = 2;
/// Number of frequencies in the gigahertz from 76 GHz.
const FREQUENCIES: u32 = 16;

/// A vehicle with its levels.
pub(super) struct Levels {
    pub(super) name: String,
    pub(super) class: Class,
    pub(super) triangles: usize,
    /// Azimuth in degrees, for each elevation, and level averaged over the frequencies and the neighbouring
    /// aspects, dBsm.
    pub(super) level_dbsm: [Vec<[f64; 2]>; 2],
}

impl Levels {
    /// Levels of vv with three bounces, with small parts from this source.
    pub(super) fn of(class: Class, (name, mesh): Named, small_parts: SmallParts) -> Result<Self, Failure> {
        let frequencies_hz: Vec<f64> =
            (0..FREQUENCIES).map(|i| 76e9 + 1e9 * (f64::from(i) + 0.5) / f64::from(FREQUENCIES)).collect();
        let far = Standpoint { azimuth_rad: 0.0, elevation_rad: 0.0, range_m: f64::INFINITY };
        let azimuths_deg: Vec<f64> =
            (0..(360.0 / STEP_DEG) as u32).map(|i| STEP_DEG * f64::from(i)).collect();
        let asked = RcsRequest {
            elevation_rad: ELEVATIONS_DEG.map(f64::to_radians).to_vec(),
            azimuth_rad: azimuths_deg.iter().map(|az| az.to_radians()).collect(),
            small_parts,
            ..request(far, &frequencies_hz, 3, NodeRule::OwnEdge, -20.0)
        };
        let table = rcs(&mesh, &asked, &|_, _| {}).map_err(Failure::refused)?;
        let aspects = azimuths_deg.len();
        let power_m2 = |aspect: usize| {
            let of_aspect = table.amplitude_m.iter().skip(aspect).step_by(2 * aspects);
            of_aspect.map(|s| s.norm_sqr()).sum::<f64>() / f64::from(FREQUENCIES)
        };
        let level_dbsm = [0, 1].map(|elevation| {
            let power_m2: Vec<f64> =
                (0..aspects).map(|aspect| power_m2(elevation * aspects + aspect)).collect();
            azimuths_deg
                .iter()
                .enumerate()
                .map(|(at, az)| [*az, db_from_power(around(&power_m2, at))])
                .collect()
        });
        Ok(Self { name, class, triangles: mesh.triangles.len(), level_dbsm })
    }

    /// Whether it is one of the project's own vehicles.
    pub(super) fn is_own(&self) -> bool {
        scene::vehicles::class_of(&self.name).is_some()
    }

    /// Mean of the levels in dBsm over a sector, at one of the elevations.
    pub(super) fn of_sector(&self, elevation: usize, sector: Sector) -> f64 {
        let inside = self.level_dbsm[elevation].iter().filter(|[az, _]| Sector::of(*az) == sector);
        mean(&inside.map(|[_, dbsm]| *dbsm).collect::<Vec<_>>())
    }

    /// Mean and standard deviation in dB of a car's levels minus the published ones at the same aspects.
    pub(super) fn difference_from_published(&self, elevation: usize) -> [f64; 2] {
        let less = |[az, dbsm]: &[f64; 2]| dbsm - published_dbsm(*az, ELEVATIONS_DEG[elevation]);
        let apart: Vec<f64> = self.level_dbsm[elevation].iter().map(less).collect();
        let middle = mean(&apart);
        [middle, mean(&apart.iter().map(|db| (db - middle).powi(2)).collect::<Vec<_>>()).sqrt()]
    }
}

/// Mean power of an aspect and its neighbours, all round.
fn around(power_m2: &[f64], aspect: usize) -> f64 {
    let of = power_m2.len() as i64;
    let beside = (-BESIDE..=BESIDE).map(|by| (aspect as i64 + by).rem_euclid(of) as usize);
    beside.map(|at| power_m2[at]).sum::<f64>() / (2 * BESIDE + 1) as f64
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}
