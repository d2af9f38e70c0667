//! Our clusters beside DBSCAN's on the same points: `cargo run --release -p dsp --example clusters [--
//! STREETS [FIRST]]`.
//!
//! Streets of one to four vehicles in three lanes, random in kind, place and speed, go through the whole
//! chain; the points, as detected, then go to scikit-learn's DBSCAN with the same reaches, where `python3`
//! finds it (`dbscan.py` in this folder). Points are given to the true vehicle nearest in range, velocity and
//! across, in reaches; a vehicle is cut if two objects hold most of their points from it, and lost if no
//! object does.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a measurement, not a library")]

#[path = "../../tests/common/mod.rs"]
mod common;

use artifact::cube::CubeHeader;
use artifact::points::Point;
use artifact::seed::key;
use common::{Target, cube, elements_3x4, header, truth, vehicle};
use dsp::Receiver;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::fmt::Write;
use std::process::Command;

fn main() {
    let numbers: Vec<u64> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    let (streets, first) = (numbers.first().copied().unwrap_or(200), numbers.get(1).copied().unwrap_or(0));
    let mut header = header(256, 128, elements_3x4());
    header.noise = common::NOISE_12_DB;
    let lines: Vec<String> =
        (first..first + streets).into_par_iter().map(|seed| street(&header, seed)).collect();
    let folder = tempfile::tempdir().unwrap();
    let file = std::env::var("WAYSIDE_POINTS").map_or_else(|_| folder.path().join("points.csv"), Into::into);
    std::fs::write(&file, lines.concat()).unwrap();
    let settings = &header.dsp;
    let reaches = [settings.cluster_range_m, settings.cluster_velocity_mps, settings.cluster_cross_m];
    let mut command = Command::new("python3");
    command.args(["-c", include_str!("dbscan.py")]).arg(&file);
    command.args(reaches.map(|r| r.to_string())).arg((2.0 * header.radar.velocity_max_mps()).to_string());
    match command.output() {
        Ok(done) => {
            print!("{}{}", String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr))
        }
        Err(_) => println!("skipped: python3 is not here"),
    }
}

/// Lines `street,vehicles,range_m,velocity_mps,cross_m,snr_db,object,vehicle` of a street's points, object −1
/// for none.
fn street(header: &CubeHeader, seed: u64) -> String {
    let vehicles = vehicles(seed);
    let targets: Vec<Target> = vehicles.concat();
    let points = Receiver::new(header).unwrap().process(&cube(header, &targets, seed)).unwrap().1.points;
    let mut lines = String::new();
    for point in &points {
        let object = point.object.map_or(-1, i64::from);
        let Point { range_m, radial_velocity_mps, position_m: [cross_m, ..], snr_db, .. } = point;
        let of = nearest(header, &vehicles, point);
        writeln!(
            lines,
            "{seed},{},{range_m},{radial_velocity_mps},{cross_m},{snr_db},{object},{of}",
            vehicles.len()
        )
        .unwrap();
    }
    lines
}

/// Motorcycles, cars, buses: bumpers of a lane at least 4 m apart, speeds in it within 1 m/s of each other,
/// lanes from −14 to −2 m/s.
fn vehicles(seed: u64) -> Vec<Vec<Target>> {
    let mut random = ChaCha8Rng::from_seed(key(seed, "dsp/example-clusters", &[]));
    let mut between = |low: f64, high: f64| low + (high - low) * f64::from(random.next_u32()) / 2f64.powi(32);
    let count = between(1.0, 5.0) as usize;
    let lane_speeds = [0; 3].map(|_| between(-13.0, -3.0));
    let mut standing: Vec<(usize, f64, f64)> = Vec::new();
    let mut all = Vec::new();
    while all.len() < count {
        let lane = between(0.0, 3.0) as usize;
        let size =
            [[2.2, 0.8, 1.3], [4.5, 1.8, 1.5], [4.5, 1.8, 1.5], [12.0, 2.5, 3.0]][between(0.0, 4.0) as usize];
        let (y, speed) = (between(22.0, 52.0), lane_speeds[lane] + between(-1.0, 1.0));
        let free = |(of, at, length): &(usize, f64, f64)| {
            *of != lane || (at - y).abs() > 0.5 * (length + size[0]) + 4.0
        };
        if standing.iter().all(free) {
            standing.push((lane, y, size[0]));
            all.push(vehicle([[2.0, 5.75, 9.5][lane], y], size, speed, 10 * seed + all.len() as u64));
        }
    }
    all
}

/// The vehicle with the scatterer nearest to a point, in reaches.
fn nearest(header: &CubeHeader, vehicles: &[Vec<Target>], point: &Point) -> usize {
    let settings = &header.dsp;
    let away = |target: &Target| {
        let (range_m, velocity_mps, position_m) = truth(header, target);
        ((range_m - point.range_m) / settings.cluster_range_m).powi(2)
            + ((velocity_mps - point.radial_velocity_mps) / settings.cluster_velocity_mps).powi(2)
            + ((position_m[0] - point.position_m[0]) / settings.cluster_cross_m).powi(2)
    };
    let least = |targets: &[Target]| targets.iter().map(away).fold(f64::INFINITY, f64::min);
    let away: Vec<f64> = vehicles.iter().map(|targets| least(targets)).collect();
    (0..away.len()).fold(0, |best, i| if away[i] < away[best] { i } else { best })
}
