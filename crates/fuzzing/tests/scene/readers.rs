//! The readers of this crate: how a case of each is made, and how it is read.

use crate::gltf;
use crate::openmaterial;
use crate::sound;
use flate2::Compression;
use flate2::write::GzEncoder;
use fuzzing::{Noise, Reader, change_numbers, changed_text};
use scene::{MeshOptions, ReadOptions};
use std::io::Write as _;
use std::path::Path;

pub(crate) const READERS: [Reader; 13] = [
    Reader::refusing("glb", 400, |n, at| put(at, "m.glb", &gltf::binary(n)), |at| mesh(at, "m.glb")),
    Reader::refusing("gltf", 400, write_gltf, |at| mesh(at, "m.gltf")),
    Reader::refusing("stl", 400, write_stl, |at| mesh(at, "m.stl")),
    Reader::refusing("stl-text", 400, |n, at| text(n, at, "m.stl", sound::STL), |at| mesh(at, "m.stl")),
    Reader::refusing("obj", 400, |n, at| text(n, at, "m.obj", sound::OBJ), |at| mesh(at, "m.obj")),
    Reader::refusing("scene-text", 150, write_scene, |at| whole_scene(at, "s.toml")),
    Reader::refusing("materials", 400, |n, at| text(n, at, "m.toml", sound::MATERIALS), materials),
    Reader::refusing("openmaterial", 400, openmaterial::write, |at| whole_scene(at, "openmaterial.toml")),
    Reader::refusing(
        "pattern",
        400,
        |n, at| text(n, at, "p.csv", sound::PATTERN),
        |at| whole_scene(at, "pattern.toml"),
    ),
    Reader::refusing(
        "calibration",
        400,
        |n, at| text(n, at, "c.csv", sound::CALIBRATION),
        |at| whole_scene(at, "calibration.toml"),
    ),
    Reader::refusing(
        "fcd",
        400,
        |n, at| text(n, at, "t.fcd.xml", sound::FCD),
        |at| whole_scene(at, "traffic.toml"),
    ),
    Reader::refusing(
        "net",
        400,
        |n, at| text(n, at, "t.net.xml", sound::NET),
        |at| whole_scene(at, "network.toml"),
    ),
    Reader::refusing("fcd-gzip", 400, write_packed, |at| whole_scene(at, "traffic.toml")),
];

/// Frequency at which materials are asked for.
const CARRIER_HZ: f64 = 77e9;

/// Writes the files that every case finds in its folder.
pub(crate) fn prepare(folder: &Path) {
    for (name, text) in sound::FILES {
        put(folder, name, text.as_bytes());
    }
}

fn put(folder: &Path, name: &str, bytes: &[u8]) {
    std::fs::write(folder.join(name), bytes).unwrap();
}

fn text(noise: &mut Noise, folder: &Path, name: &str, sound: &[&str]) {
    let whole = noise.pick(sound);
    put(folder, name, &changed_text(noise, whole.as_bytes(), &sound::words()));
}

fn write_gltf(noise: &mut Noise, folder: &Path) {
    let (mut json, buffer) = gltf::beside(noise);
    if noise.one_in(4) {
        json = changed_text(noise, &json, &sound::words());
    }
    put(folder, "m.gltf", &json);
    put(folder, "b.bin", &buffer);
}

/// Header, count, facets; the count and any number of a facet changed, the end cut off or more behind it.
fn write_stl(noise: &mut Noise, folder: &Path) {
    let facets = 1 + noise.below(20);
    let number = |i: usize| (((i * 2_654_435_761) % 1000) as f32 / 100.0).to_le_bytes();
    let facet =
        |f: usize| [(0..12).flat_map(|i| number(12 * f + i)).collect::<Vec<u8>>(), vec![0; 2]].concat();
    let head = if noise.one_in(4) { b"solid " } else { b"binary" };
    let mut bytes = [&head[..], &[0; 74]].concat();
    let count = if noise.one_in(3) { noise.next() as u32 >> noise.below(32) } else { facets as u32 };
    bytes.extend(count.to_le_bytes());
    bytes.extend((0..facets).flat_map(facet));
    for _ in 0..noise.below(3) {
        change_numbers(noise, &mut bytes[84..]);
    }
    if noise.one_in(3) {
        bytes.truncate(noise.below(bytes.len()));
    }
    put(folder, "m.stl", &bytes);
}

fn write_packed(noise: &mut Noise, folder: &Path) {
    let pack = |text: &[u8]| {
        let mut packer = GzEncoder::new(vec![], Compression::fast());
        packer.write_all(text).unwrap();
        packer.finish().unwrap()
    };
    let whole = noise.pick(sound::FCD).as_bytes();
    let (first, second) = whole.split_at(noise.below(whole.len()));
    let mut bytes = match noise.below(3) {
        0 => [pack(first), pack(second)].concat(),
        1 => pack(&[first, &b" ".repeat(noise.times() << 11), second].concat()),
        _ => pack(&changed_text(noise, whole, &sound::words())),
    };
    for _ in 0..noise.below(3) {
        let at = if noise.one_in(2) { noise.below(bytes.len().min(12)) } else { noise.below(bytes.len()) };
        bytes[at] ^= 1 << noise.below(8);
    }
    put(folder, "t.fcd.xml", &bytes);
}

/// Writes a changed scene with names of keys, so that it breaks rules behind those of its syntax.
fn write_scene(noise: &mut Noise, folder: &Path) {
    let keys: Vec<&str> = scene::keys::TABLES.iter().flat_map(scene::keys::Table::names).collect();
    let words: Vec<&str> = keys.into_iter().chain(sound::words()).collect();
    let whole = noise.pick(sound::SCENES);
    put(folder, "s.toml", &changed_text(noise, whole.as_bytes(), &words));
}

fn mesh(folder: &Path, name: &str) -> Result<(), String> {
    let file = folder.join(name);
    let mesh =
        scene::read_mesh(&file, &MeshOptions { unit_scale: None }).map_err(|error| error.to_string())?;
    assert!(mesh.vertices_m.as_flattened().iter().all(|x| x.is_finite()));
    assert!(mesh.triangles.as_flattened().iter().all(|&i| (i as usize) < mesh.vertices_m.len()));
    assert!(mesh.material_of_triangle.iter().all(|&i| usize::from(i) < mesh.materials.len()));
    Ok(())
}

fn materials(folder: &Path) -> Result<(), String> {
    scene::read_materials(&folder.join("m.toml"), CARRIER_HZ).map(drop).map_err(|errors| errors.to_string())
}

fn whole_scene(folder: &Path, name: &str) -> Result<(), String> {
    let options = ReadOptions::whole();
    let header = scene::read(&folder.join(name), &options).map_err(|errors| errors.to_string())?;
    for frame in [0, header.frames / 2, header.frames.saturating_sub(1)] {
        let poses = scene::snapshot(&header, frame).poses;
        assert!(poses.iter().all(|pose| pose.position_m.iter().all(|x| x.is_finite())), "frame {frame}");
    }
    Ok(())
}
