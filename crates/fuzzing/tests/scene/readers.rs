//! The readers of this crate: how a case of each is made, and how it is read.

use crate::corpus;
use crate::gltf;
use crate::openmaterial;
use flate2::Compression;
use flate2::write::GzEncoder;
use fuzzing::{FuzzRng, Reader, mutate_text, mutate_word32};
use scene::{MeshOptions, ReadOptions};
use std::io::Write as _;
use std::path::Path;

pub(crate) const READERS: [Reader; 13] = [
    Reader::refusing("glb", 400, |n, at| put(at, "m.glb", &gltf::binary(n)), |at| mesh(at, "m.glb")),
    Reader::refusing("gltf", 400, write_gltf, |at| mesh(at, "m.gltf")),
    Reader::refusing("stl", 400, write_stl, |at| mesh(at, "m.stl")),
    Reader::refusing("stl-text", 400, |n, at| text(n, at, "m.stl", corpus::STL), |at| mesh(at, "m.stl")),
    Reader::refusing("obj", 400, |n, at| text(n, at, "m.obj", corpus::OBJ), |at| mesh(at, "m.obj")),
    Reader::refusing("scene-text", 150, write_scene, |at| whole_scene(at, "s.toml")),
    Reader::refusing("materials", 400, |n, at| text(n, at, "m.toml", corpus::MATERIALS), materials),
    Reader::refusing("openmaterial", 400, openmaterial::write, |at| whole_scene(at, "openmaterial.toml")),
    Reader::refusing(
        "pattern",
        400,
        |n, at| text(n, at, "p.csv", corpus::PATTERN),
        |at| whole_scene(at, "pattern.toml"),
    ),
    Reader::refusing(
        "calibration",
        400,
        |n, at| text(n, at, "c.csv", corpus::CALIBRATION),
        |at| whole_scene(at, "calibration.toml"),
    ),
    Reader::refusing(
        "fcd",
        400,
        |n, at| text(n, at, "t.fcd.xml", corpus::FCD),
        |at| whole_scene(at, "traffic.toml"),
    ),
    Reader::refusing(
        "net",
        400,
        |n, at| text(n, at, "t.net.xml", corpus::NET),
        |at| whole_scene(at, "network.toml"),
    ),
    Reader::refusing("fcd-gzip", 400, write_packed, |at| whole_scene(at, "traffic.toml")),
];

/// Frequency at which materials are asked for.
const CARRIER_HZ: f64 = 77e9;

/// Writes the files that every case finds in its folder.
pub(crate) fn prepare(folder: &Path) {
    for (name, text) in corpus::FILES {
        put(folder, name, text.as_bytes());
    }
}

fn put(folder: &Path, name: &str, bytes: &[u8]) {
    std::fs::write(folder.join(name), bytes).unwrap();
}

fn text(rng: &mut FuzzRng, folder: &Path, name: &str, sound: &[&str]) {
    let whole = rng.choose(sound);
    put(folder, name, &mutate_text(rng, whole.as_bytes(), &corpus::words()));
}

fn write_gltf(rng: &mut FuzzRng, folder: &Path) {
    let (mut json, buffer) = gltf::beside(rng);
    if rng.one_in(4) {
        json = mutate_text(rng, &json, &corpus::words());
    }
    put(folder, "m.gltf", &json);
    put(folder, "b.bin", &buffer);
}

/// Header, count, facets; the count and any number of a facet changed, the end cut off or more behind it.
fn write_stl(rng: &mut FuzzRng, folder: &Path) {
    let facets = 1 + rng.below(20);
    let number = |i: usize| (((i * 2_654_435_761) % 1000) as f32 / 100.0).to_le_bytes();
    let facet =
        |f: usize| [(0..12).flat_map(|i| number(12 * f + i)).collect::<Vec<u8>>(), vec![0; 2]].concat();
    let head = if rng.one_in(4) { b"solid " } else { b"binary" };
    let mut bytes = [&head[..], &[0; 74]].concat();
    let count = if rng.one_in(3) { rng.next_u64() as u32 >> rng.below(32) } else { facets as u32 };
    bytes.extend(count.to_le_bytes());
    bytes.extend((0..facets).flat_map(facet));
    for _ in 0..rng.below(3) {
        mutate_word32(rng, &mut bytes[84..]);
    }
    if rng.one_in(3) {
        bytes.truncate(rng.below(bytes.len()));
    }
    put(folder, "m.stl", &bytes);
}

fn write_packed(rng: &mut FuzzRng, folder: &Path) {
    let pack = |text: &[u8]| {
        let mut packer = GzEncoder::new(vec![], Compression::fast());
        packer.write_all(text).unwrap();
        packer.finish().unwrap()
    };
    let whole = rng.choose(corpus::FCD).as_bytes();
    let (first, second) = whole.split_at(rng.below(whole.len()));
    let mut bytes = match rng.below(3) {
        0 => [pack(first), pack(second)].concat(),
        1 => pack(&[first, &b" ".repeat(rng.repeat_count() << 11), second].concat()),
        _ => pack(&mutate_text(rng, whole, &corpus::words())),
    };
    for _ in 0..rng.below(3) {
        let at = if rng.one_in(2) { rng.below(bytes.len().min(12)) } else { rng.below(bytes.len()) };
        bytes[at] ^= 1 << rng.below(8);
    }
    put(folder, "t.fcd.xml", &bytes);
}

/// Writes a changed scene with names of keys, so that it breaks rules behind those of its syntax.
fn write_scene(rng: &mut FuzzRng, folder: &Path) {
    let keys: Vec<&str> = scene::keys::TABLES.iter().flat_map(scene::keys::Table::names).collect();
    let words: Vec<&str> = keys.into_iter().chain(corpus::words()).collect();
    let whole = rng.choose(corpus::SCENES);
    put(folder, "s.toml", &mutate_text(rng, whole.as_bytes(), &words));
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
