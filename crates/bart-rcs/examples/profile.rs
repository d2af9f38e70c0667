//! One aspect of a mesh, timed by phase: `cargo run --release -p bart-rcs --example profile -- car.stl [azimuth_deg
//! [range_m [frequencies [bounces]]]]`, a binary STL in body axes; fit for `valgrind --tool=callgrind` and `perf`.

use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::{Edges, NodeRule, Sides, Surface};
use artifact::{Accuracy, units};
use bart_rcs::{RcsRequest, rcs};
use std::io::{Error, ErrorKind};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize, default: f64| arguments.get(place).map_or(Ok(default), |text| text.parse());
    let file = arguments.first().ok_or_else(|| Error::new(ErrorKind::InvalidInput, "name a binary .stl"))?;
    let mesh = binary_stl(&std::fs::read(file)?).ok_or_else(|| Error::new(ErrorKind::InvalidData, "no binary .stl"))?;
    let request = request(number(1, 23.0)?, number(2, 30.0)?, number(3, 1.0)? as usize, number(4, 3.0)? as u8);
    let result = rcs(&mesh, &request, &|_, _| ())?;
    println!("{file}: {} triangles, beams {:?}", mesh.triangles.len(), result.beams);
    println!("{:?}", result.seconds);
    let s = result.amplitude_m[0];
    println!("S {s:.12e}, {:.6} dBsm, by order:", units::db_from_amplitude(s.norm()));
    result.by_order_m.iter().for_each(|order| println!("  {:.12e}", order[0]));
    println!("error {:?} model {:?} spread {:?}", result.error, result.model_error, result.node_spread);
    Ok(())
}

/// The middle of the 76–78 GHz band, and as many frequencies about it as a chirp of 1 GHz has samples.
fn request(azimuth_deg: f64, range_m: f64, frequencies: usize, bounces: u8) -> RcsRequest {
    RcsRequest {
        frequency_hz: (0..frequencies).map(|i| 77e9 + 1e9 * (i as f64 / frequencies as f64)).collect(),
        elevation_rad: vec![0.15],
        azimuth_rad: vec![azimuth_deg.to_radians()],
        range_m,
        receiver: None,
        polarization: Polarization::Vv,
        bounces,
        nodes: NodeRule::Middle,
        sides: Sides::Two,
        edges: Edges::Ignored,
        surface: Surface::Flat,
        accuracy: Accuracy::from_db(-30.0),
    }
}

/// Triangles of a binary STL: 80 bytes of anything, their number, and 50 bytes each; equal corners become one vertex.
fn binary_stl(bytes: &[u8]) -> Option<Mesh> {
    let word = |at: usize| bytes.get(at..at + 4).and_then(|b| <[u8; 4]>::try_from(b).ok());
    let count = u32::from_le_bytes(word(80)?);
    let mut mesh = Mesh::default();
    let mut known = std::collections::HashMap::new();
    for triangle in 0..count as usize {
        let mut corners = [0; 3];
        for (i, corner) in corners.iter_mut().enumerate() {
            let at = 84 + 50 * triangle + 12 + 12 * i;
            let bits = [word(at)?, word(at + 4)?, word(at + 8)?];
            *corner = *known.entry(bits).or_insert_with(|| {
                mesh.vertices_m.push(bits.map(|b| f64::from(f32::from_le_bytes(b))));
                mesh.vertices_m.len() as u32 - 1
            });
        }
        mesh.triangles.push(corners);
    }
    Some(mesh)
}
