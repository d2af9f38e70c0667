//! One aspect of a mesh, timed by phase: `cargo run --release -p bart-rcs --example profile -- car.stl
//! [azimuth_deg [range_m [frequencies [bounces [edges|no [accuracy_db]]]]]]`, a binary STL in body axes, the
//! word `edges` for their diffraction; fit for `valgrind --tool=callgrind` and `perf`.

mod processor_time;
mod stl;

use artifact::scene::Mesh;
use artifact::settings::Edges;
use artifact::{Accuracy, units};
use bart_rcs::{Antenna, BeamTree, RcsRequest, TraceSettings, World, rcs};
use glam::DVec3;
use processor_time::processor_seconds;
use std::io::{Error, ErrorKind};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize, default: f64| arguments.get(place).map_or(Ok(default), |text| text.parse());
    let file = arguments.first().ok_or_else(|| Error::new(ErrorKind::InvalidInput, "name a binary .stl"))?;
    let mesh = stl::binary(&std::fs::read(file)?)
        .ok_or_else(|| Error::new(ErrorKind::InvalidData, "no binary .stl"))?;
    let edges =
        if arguments.get(5).is_some_and(|word| word == "edges") { Edges::FirstOrder } else { Edges::Ignored };
    let plain = request(number(1, 23.0)?, number(2, 30.0)?, number(3, 1.0)? as usize, number(4, 3.0)? as u8);
    let request = RcsRequest { edges, accuracy: Accuracy::from_db(number(6, -30.0)?), ..plain };
    let traced_s = traced(&mesh, &request)?;
    let start_s = processor_seconds()?;
    let result = rcs(&mesh, &request, &|_, _| ())?;
    let all_s = processor_seconds()? - start_s;
    println!("{file}: {} triangles, beams {:?}", mesh.triangles.len(), result.beams);
    println!("processor seconds: tree {traced_s:.3}, everything with its checks {all_s:.3}");
    println!("{:?}", result.seconds);
    let s = result.amplitude_m[0];
    println!("S {s:.12e}, {:.6} dBsm, by order:", units::db_from_amplitude(s.norm()));
    result.by_order_m.iter().for_each(|order| println!("  {:.12e}", order[0]));
    println!("error {:?} model {:?} spread {:?}", result.error, result.model_error, result.node_spread);
    Ok(())
}

/// Processor seconds of the tree that own-edge nodes need.
fn traced(mesh: &Mesh, request: &RcsRequest) -> Result<f64, Box<dyn std::error::Error>> {
    let world = World::of_mesh(mesh)?;
    let (azimuth, elevation) = (request.azimuth_rad[0], request.elevation_rad[0]);
    let r = DVec3::new(elevation.cos() * azimuth.cos(), elevation.cos() * azimuth.sin(), elevation.sin());
    let antenna =
        if request.range_m.is_finite() { Antenna::Point(request.range_m * r) } else { Antenna::Direction(r) };
    let least_area_m2 = 1e-2 * (units::SPEED_OF_LIGHT_MPS / 77e9).powi(2) * request.accuracy.amplitude();
    let settings = TraceSettings {
        max_order: request.bounces,
        sides: request.sides,
        least_area_m2,
        least_mirror_area_m2: 100.0 * least_area_m2,
    };
    let start_s = processor_seconds()?;
    BeamTree::trace(&world, antenna, &settings)?;
    Ok(processor_seconds()? - start_s)
}

/// The middle of the 76–78 GHz band, and as many frequencies about it as a chirp of 1 GHz has samples.
fn request(azimuth_deg: f64, range_m: f64, frequencies: usize, bounces: u8) -> RcsRequest {
    RcsRequest {
        range_m,
        bounces,
        accuracy: Accuracy::from_db(-30.0),
        ..RcsRequest::over(
            (0..frequencies).map(|i| 77e9 + 1e9 * (i as f64 / frequencies as f64)).collect(),
            vec![0.15],
            vec![azimuth_deg.to_radians()],
        )
    }
}
