//! Clusters of this crate beside DBSCAN (crate `petal-clustering`) on the same points: how often vehicles are told apart.
//!
//! `cargo run --release -p dsp --example clusters_against_dbscan -- [scenes]`: streets of one to four vehicles (cars of 5 m, one
//! in four a bus of 12 m) in three lanes, 15–55 m, each lane at one speed with gaps of 6 m and more; points as [`dsp::detect`]
//! makes them. DBSCAN sees range over 2.5 m, velocity over 1 m/s and place across over 2.5 m, the greatest of which is the
//! distance, and joins what is within 1.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a study prints and stops at the first wrong thing")]

#[path = "../tests/common/mod.rs"]
mod common;

use artifact::points::PointsFrame;
use common::{NOISE_12_DB, Target, cube, elements_3x4, header, vehicle};
use dsp::clusters::{Member, clusters};
use ndarray::{Array2, ArrayView1};
use petal_clustering::{Dbscan, Fit};
use petal_neighbors::distance::Metric;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Greatest of the scaled distances.
#[derive(Clone)]
struct Greatest;

impl Metric<f64> for Greatest {
    fn distance(&self, a: &ArrayView1<f64>, b: &ArrayView1<f64>) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    fn rdistance(&self, a: &ArrayView1<f64>, b: &ArrayView1<f64>) -> f64 {
        self.distance(a, b)
    }

    fn rdistance_to_distance(&self, d: f64) -> f64 {
        d
    }

    fn distance_to_rdistance(&self, d: f64) -> f64 {
        d
    }
}

fn main() {
    let scenes: u64 = std::env::args().nth(1).map_or(60, |n| n.parse().unwrap());
    let header = {
        let mut h = header(256, 64, elements_3x4());
        h.noise = NOISE_12_DB;
        h
    };
    let names = ["this crate", "DBSCAN, 1 point", "DBSCAN, 3 points", "DBSCAN, 5 points"];
    let mut counts = [[0_u32; 3]; 4];
    for scene in 0..scenes {
        let (vehicles, targets) = street(scene);
        let map = dsp::range_doppler(&header, &cube(&header, &targets, scene)).unwrap();
        let points = dsp::detect(&header, &map).unwrap();
        let members = members(&points);
        let own = clusters(&members, &header.dsp, 2.0 * header.radar.velocity_max_mps());
        let found =
            [own.iter().filter(|g| g.len() > 1).count(), dbscan(&members, 1), dbscan(&members, 3), dbscan(&members, 5)];
        for (count, found) in counts.iter_mut().zip(found) {
            count[match found.cmp(&vehicles) {
                std::cmp::Ordering::Less => 0,
                std::cmp::Ordering::Equal => 1,
                std::cmp::Ordering::Greater => 2,
            }] += 1;
        }
    }
    println!("{scenes} streets: too few objects, as many as vehicles, too many");
    names.iter().zip(counts).for_each(|(name, count)| println!("{name:<18} {count:?}"));
}

/// Number of vehicles, and what scatters.
fn street(seed: u64) -> (usize, Vec<Target>) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut uniform = || f64::from(random.next_u32()) / 2f64.powi(32);
    let speeds = [0, 1, 2].map(|_| -10.0 * uniform());
    let mut next_m = [0, 1, 2].map(|_| 15.0 + 10.0 * uniform());
    let count = 1 + (4.0 * uniform()) as usize;
    let mut targets = Vec::new();
    let mut vehicles = 0;
    for i in 0..count {
        let lane = (3.0 * uniform()) as usize;
        let size = if uniform() < 0.25 { [12.0, 2.5, 3.0] } else { [5.0, 2.0, 1.5] };
        let middle_m = next_m[lane] + 0.5 * size[0];
        if middle_m + 0.5 * size[0] < 55.0 {
            targets.extend(vehicle([[2.0, 5.75, 9.5][lane], middle_m], size, speeds[lane], 100 * seed + i as u64));
            vehicles += 1;
        }
        next_m[lane] = middle_m + 0.5 * size[0] + 6.0 + 8.0 * uniform();
    }
    (vehicles, targets)
}

fn members(points: &PointsFrame) -> Vec<Member> {
    let of = |p: &artifact::points::Point| Member {
        range_m: p.range_m,
        radial_velocity_mps: p.radial_velocity_mps,
        cross_m: p.position_m[0],
        power: 10_f64.powf(0.1 * p.snr_db),
    };
    points.points.iter().map(of).collect()
}

/// Clusters of more than one point.
fn dbscan(members: &[Member], least: usize) -> usize {
    let scaled = |m: &Member| [m.range_m / 2.5, m.radial_velocity_mps, m.cross_m / 2.5];
    let flat: Vec<f64> = members.iter().flat_map(scaled).collect();
    let table = Array2::from_shape_vec((members.len(), 3), flat).unwrap();
    let (found, _) = Dbscan::new(1.0, least, Greatest).fit(&table, None);
    found.values().filter(|cluster| cluster.len() > 1).count()
}
