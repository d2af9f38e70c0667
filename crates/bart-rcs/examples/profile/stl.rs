//! Binary STL, enough for a measurement.

use artifact::scene::Mesh;

/// Triangles of a binary STL: 80 bytes of anything, their number, and 50 bytes each; equal corners become one
/// vertex.
pub(crate) fn binary(bytes: &[u8]) -> Option<Mesh> {
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
