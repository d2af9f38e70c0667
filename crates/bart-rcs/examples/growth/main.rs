//! Growth of the cost of one aspect: `RAYON_NUM_THREADS=1 cargo run --release -p bart-rcs --example
//! growth -- car.stl OUT` writes OUT/growth.csv and OUT/growth.svg; with a growth.csv in the mesh's
//! place it draws that one anew. Triangles are those of the mesh, each cut in four again and again; the
//! other sweeps take the mesh as it is. Processor time of the whole process, as the system counts it.

#[path = "../profile/processor_time.rs"]
mod processor_time;
#[path = "../profile/stl.rs"]
mod stl;
mod picture;

use artifact::Accuracy;
use artifact::scene::Mesh;
use artifact::settings::NodeRule;
use bart_rcs::{RcsRequest, rcs};
use processor_time::processor_seconds;
use std::fmt::Write as _;
use std::io::{Error, ErrorKind};

type Failure = Box<dyn std::error::Error>;

/// A sweep and what it has measured: (value, beams, processor seconds).
struct Sweep {
    name: &'static str,
    unit: &'static str,
    points: Vec<(f64, u64, f64)>,
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, out] = &arguments[..] else {
        return Err(Error::new(ErrorKind::InvalidInput, "car.stl OUT").into());
    };
    let csv = if file.ends_with(".csv") { std::fs::read_to_string(file)? } else { measured_table(file)? };
    let picture =
        picture::picture(&csv).ok_or_else(|| Error::new(ErrorKind::InvalidData, "no table of growth"))?;
    std::fs::write(format!("{out}/growth.csv"), csv)?;
    std::fs::write(format!("{out}/growth.svg"), picture)?;
    Ok(())
}

/// All sweeps of a mesh as a table.
fn measured_table(file: &str) -> Result<String, Failure> {
    let car = stl::binary(&std::fs::read(file)?)
        .ok_or_else(|| Error::new(ErrorKind::InvalidData, "no binary .stl"))?;
    let sweeps = [triangles(&car)?, frequency(&car)?, orders(&car)?, distance(&car)?];
    let mut csv = String::from("sweep,value,unit,beams,processor_seconds\n");
    for sweep in &sweeps {
        for (value, beams, seconds) in &sweep.points {
            writeln!(csv, "{},{value},{},{beams},{seconds:.4}", sweep.name, sweep.unit)?;
        }
    }
    print!("{csv}");
    Ok(csv)
}

fn triangles(car: &Mesh) -> Result<Sweep, Failure> {
    let mut points = Vec::new();
    let mut mesh = thinned(car, 8);
    for next in [
        thinned(car, 3),
        car.clone(),
        quartered(car),
        quartered(&quartered(car)),
        quartered(&quartered(&quartered(car))),
    ] {
        points.push(measured(mesh.triangles.len() as f64, &mesh, &request(77e9, 30.0, 3))?);
        mesh = next;
    }
    points.push(measured(mesh.triangles.len() as f64, &mesh, &request(77e9, 30.0, 3))?);
    Ok(Sweep { name: "triangles", unit: "1", points })
}

fn frequency(car: &Mesh) -> Result<Sweep, Failure> {
    let of = |ghz: &f64| measured(*ghz, car, &request(ghz * 1e9, 30.0, 3));
    let points = [10.0, 20.0, 40.0, 77.0, 150.0, 300.0].iter().map(of).collect::<Result<_, _>>()?;
    Ok(Sweep { name: "frequency", unit: "GHz", points })
}

fn orders(car: &Mesh) -> Result<Sweep, Failure> {
    let of = |bounces: u8| measured(f64::from(bounces), car, &request(77e9, 30.0, bounces));
    Ok(Sweep { name: "orders", unit: "1", points: (1..=5).map(of).collect::<Result<_, _>>()? })
}

fn distance(car: &Mesh) -> Result<Sweep, Failure> {
    let of = |range_m: &f64| measured(*range_m, car, &request(77e9, *range_m, 3));
    let points = [7.0, 15.0, 30.0, 60.0, 120.0, 500.0, 5000.0].iter().map(of).collect::<Result<_, _>>()?;
    Ok(Sweep { name: "distance", unit: "m", points })
}

fn measured(value: f64, mesh: &Mesh, request: &RcsRequest) -> Result<(f64, u64, f64), Failure> {
    let start = processor_seconds()?;
    let result = rcs(mesh, request, &|_, _| ())?;
    Ok((value, result.beams.iter().sum(), processor_seconds()? - start))
}

fn request(frequency_hz: f64, range_m: f64, bounces: u8) -> RcsRequest {
    RcsRequest {
        range_m,
        bounces,
        nodes: NodeRule::Middle,
        accuracy: Accuracy::from_db(-30.0),
        ..RcsRequest::over(vec![frequency_hz], vec![0.15], vec![0.4])
    }
}

/// Every n-th triangle.
fn thinned(mesh: &Mesh, n: usize) -> Mesh {
    Mesh { triangles: mesh.triangles.iter().step_by(n).copied().collect(), ..mesh.clone() }
}

/// Every triangle cut in four.
fn quartered(mesh: &Mesh) -> Mesh {
    let mut fine = Mesh { triangles: Vec::new(), ..mesh.clone() };
    let mut known = std::collections::HashMap::new();
    for &[a, b, c] in &mesh.triangles {
        let mut middle = |i: u32, j: u32| {
            *known.entry((i.min(j), i.max(j))).or_insert_with(|| {
                let [p, q] = [i.min(j), i.max(j)].map(|k| mesh.vertices_m[k as usize]);
                fine.vertices_m.push([0, 1, 2].map(|axis| 0.5 * (p[axis] + q[axis])));
                fine.vertices_m.len() as u32 - 1
            })
        };
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        fine.triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    fine
}
