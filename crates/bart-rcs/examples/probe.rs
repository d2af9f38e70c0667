use artifact::{Accuracy, radar::Polarization, scene::Mesh, settings::{Edges, NodeRule, Sides, Surface}};
use bart_rcs::{RcsRequest, rcs};
fn stl(path: &str) -> Mesh {
    let b = std::fs::read(path).unwrap();
    let mut mesh = Mesh::default();
    if b.starts_with(b"solid") && String::from_utf8_lossy(&b).contains("facet") {
        let t = String::from_utf8_lossy(&b);
        for l in t.lines() { let w: Vec<&str> = l.split_whitespace().collect(); if w.first()==Some(&"vertex") { mesh.vertices_m.push([w[1].parse().unwrap(), w[2].parse().unwrap(), w[3].parse().unwrap()]); } }
    } else {
        let n = u32::from_le_bytes(b[80..84].try_into().unwrap()) as usize;
        for i in 0..n { for v in 0..3 { let at = 84+50*i+12+12*v; let f = |c: usize| f32::from_le_bytes(b[at+4*c..at+4*c+4].try_into().unwrap()) as f64; mesh.vertices_m.push([f(0),f(1),f(2)]); } }
    }
    mesh.triangles = (0..mesh.vertices_m.len() as u32/3).map(|i| [3*i,3*i+1,3*i+2]).collect();
    mesh
}
// probe stl freq_ghz el az0 az1 n edges bounces nodes
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let num = |i: usize| a[i].parse::<f64>().unwrap();
    let n = num(6) as usize;
    let mesh = stl(&a[1]);
    let az: Vec<f64> = (0..n).map(|i| if n==1 {num(4)} else { num(4)+(num(5)-num(4))*i as f64/(n-1) as f64 }.to_radians()).collect();
    for (pol, name) in [(Polarization::Vv,"vv"),(Polarization::Hh,"hh"),(Polarization::Vh,"vh")] {
        let request = RcsRequest { frequency_hz: vec![num(2)*1e9], elevation_rad: vec![num(3).to_radians()], azimuth_rad: az.clone(), range_m: f64::INFINITY, receiver: None, polarization: pol, bounces: num(8) as u8, nodes: if a[9]=="exit" {NodeRule::Exit} else {NodeRule::Middle}, sides: Sides::Two, edges: if a[7]=="on" {Edges::FirstOrder} else {Edges::Ignored}, surface: Surface::Flat, accuracy: Accuracy::from_db(-60.0) };
        let r = rcs(&mesh, &request, &|_,_| {}).unwrap();
        for (i, s) in r.amplitude_m.iter().enumerate() { println!("{name} {} {:.9e} {:.9e}", az[i].to_degrees(), s.re, s.im); }
    }
}
