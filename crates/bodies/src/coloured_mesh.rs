//! A mesh with a colour per triangle and coloured lines, as binary glTF for any viewer.

use crate::glb::{Buffer, container, extent, gltf_axes};
use artifact::scene::Mesh;
use serde_json::{Value, json};

/// Parts of a coloured mesh; body axes, metres.
#[derive(Debug, Clone)]
pub struct ColouredMesh<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// One RGB per triangle.
    pub triangle_colours: &'a [[u8; 3]],
    /// Connected lines.
    pub lines: &'a [ColouredLine],
}

/// A line through two or more points.
#[derive(Debug, Clone)]
pub struct ColouredLine {
    /// Points in their order.
    pub points_m: Vec<[f64; 3]>,
    /// Colour in RGB.
    pub colour: [u8; 3],
}

/// Writes binary glTF 2.0: triangles with their own corners and vertex colours, lines as line segments,
/// independent of lighting (`KHR_materials_unlit` if a viewer supports it).
pub fn coloured_glb(coloured: &ColouredMesh) -> Vec<u8> {
    let mut buffer = Buffer::default();
    let primitives: Vec<Value> =
        [triangles(&mut buffer, coloured), lines(&mut buffer, coloured)].into_iter().flatten().collect();
    let document = json!({
        "asset": { "version": "2.0", "generator": "wayside" },
        "extensionsUsed": ["KHR_materials_unlit"],
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": coloured.mesh.name }],
        "meshes": [{ "name": coloured.mesh.name, "primitives": primitives }],
        "materials": [{ "name": "painted", "doubleSided": true, "extensions": { "KHR_materials_unlit": {} },
            "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 1.0 } }],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{ "byteLength": buffer.bytes.len() }],
    });
    container(document.to_string().into_bytes(), buffer.bytes)
}

fn triangles(buffer: &mut Buffer, coloured: &ColouredMesh) -> Option<Value> {
    let place = |vertex: u32| coloured.mesh.vertices_m[vertex as usize];
    let corners: Vec<[f64; 3]> = coloured.mesh.triangles.iter().flat_map(|t| t.map(place)).collect();
    let colours: Vec<[u8; 4]> = coloured.triangle_colours.iter().flat_map(|c| [opaque(*c); 3]).collect();
    primitive(buffer, 4, &corners, &colours)
}

fn lines(buffer: &mut Buffer, coloured: &ColouredMesh) -> Option<Value> {
    let segments = |line: &ColouredLine| {
        line.points_m
            .windows(2)
            .flat_map(|pair| [pair[0], pair[1]])
            .map(|p| (p, line.colour))
            .collect::<Vec<_>>()
    };
    let (ends, colours): (Vec<_>, Vec<_>) = coloured.lines.iter().flat_map(segments).unzip();
    primitive(buffer, 1, &ends, &colours.into_iter().map(opaque).collect::<Vec<_>>())
}

/// A primitive of points with their colours; none without points, because glTF allows no empty accessor.
fn primitive(buffer: &mut Buffer, mode: u32, points_m: &[[f64; 3]], colours: &[[u8; 4]]) -> Option<Value> {
    if points_m.is_empty() {
        return None;
    }
    let positions: Vec<[f32; 3]> = points_m.iter().map(|p| gltf_axes(p.map(|v| v as f32))).collect();
    let position = buffer.vectors(&positions, Some(extent(&positions)));
    let colour = buffer.colours(colours);
    Some(json!({ "attributes": { "POSITION": position, "COLOR_0": colour }, "material": 0, "mode": mode }))
}

fn opaque([r, g, b]: [u8; 3]) -> [u8; 4] {
    [r, g, b, 255]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_painted_mesh_is_sound_glb_with_its_triangles_lines_and_colours() {
        let vertices_m = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = Mesh { name: "one".into(), vertices_m, triangles: vec![[0, 1, 2]], ..Mesh::default() };
        let line =
            ColouredLine { points_m: vec![[0.0; 3], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]], colour: [1, 2, 3] };
        let bytes =
            coloured_glb(&ColouredMesh { mesh: &mesh, triangle_colours: &[[9, 8, 7]], lines: &[line] });
        let document = gltf::Gltf::from_slice(&bytes).unwrap();
        let blob = document.blob.as_deref().unwrap();
        let primitives: Vec<_> = document.meshes().next().unwrap().primitives().collect();
        assert_eq!(
            primitives.iter().map(|p| p.mode()).collect::<Vec<_>>(),
            [gltf::mesh::Mode::Triangles, gltf::mesh::Mode::Lines]
        );
        let reader = primitives[1].reader(|_| Some(blob));
        let ends: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        // (x, y, z) of the body is (y, z, x) in glTF.
        assert_eq!(ends, [[0.0; 3], [0.0, 2.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 1.0]]);
        assert_eq!(reader.read_colors(0).unwrap().into_rgb_u8().next(), Some([1, 2, 3]));
    }
}
