//! Outline of a mesh from above, as a picture to overlay on an image of it.

use artifact::scene::Mesh;
use pipeline::host::failure::Failure;
use plotting::raster::{self, Pixels};

/// Pixels along each side.
const SIDE: usize = 480;

/// Outline of the mesh in a square of ±`half_width_m` about the origin, front up and left on the left: white,
/// the rest transparent.
pub(super) fn png(mesh: &Mesh, half_width_m: f64) -> Result<Vec<u8>, Failure> {
    let covered = covered(mesh, half_width_m);
    let is_covered = |x: i64, y: i64| {
        let inside = |v: i64| (0..SIDE as i64).contains(&v);
        inside(x) && inside(y) && covered[y as usize * SIDE + x as usize]
    };
    let is_rim = |x: i64, y: i64| {
        let around = [(1, 0), (-1, 0), (0, 1), (0, -1)];
        is_covered(x, y) && around.iter().any(|(dx, dy)| !is_covered(x + dx, y + dy))
    };
    let pixel = |at: usize| {
        let opacity = if is_rim((at % SIDE) as i64, (at / SIDE) as i64) { 200 } else { 0 };
        [255, 255, 255, opacity]
    };
    let pixels: Vec<u8> = (0..SIDE * SIDE).flat_map(pixel).collect();
    raster::encode_png(Pixels::Rgba, [SIDE, SIDE], &pixels).map_err(Failure::refused)
}

/// Pixels whose centre is in a triangle, or that an edge of one crosses.
fn covered(mesh: &Mesh, half_width_m: f64) -> Vec<bool> {
    let mut covered = vec![false; SIDE * SIDE];
    let pixel = |v: u32| {
        let [ahead_m, left_m, _] = mesh.vertices_m[v as usize];
        [-left_m, -ahead_m].map(|m| (m / half_width_m + 1.0) * 0.5 * SIDE as f64)
    };
    for triangle in &mesh.triangles {
        let corners = triangle.map(pixel);
        fill(&mut covered, corners);
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            edge(&mut covered, corners[a], corners[b]);
        }
    }
    covered
}

fn fill(covered: &mut [bool], corners: [[f64; 2]; 3]) {
    let bound = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
        corners.iter().map(|c| c[axis]).fold(start, pick)
    };
    let rows = |v: f64| v.clamp(0.0, SIDE as f64) as usize;
    let [x0, y0] = [0, 1].map(|axis| rows(bound(axis, f64::min, f64::INFINITY)));
    let [x1, y1] = [0, 1].map(|axis| rows(bound(axis, f64::max, f64::NEG_INFINITY)));
    let side = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2], [x, y]: [f64; 2]| {
        (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    };
    for y in y0..y1 {
        for x in x0..x1 {
            let at = [x as f64 + 0.5, y as f64 + 0.5];
            let sides = [0, 1, 2].map(|i: usize| side(corners[i], corners[(i + 1) % 3], at));
            covered[y * SIDE + x] |= sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0);
        }
    }
}

/// Covers the pixels along an edge: thin parts lie between the centres of pixels.
fn edge(covered: &mut [bool], [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) {
    let steps = ((bx - ax).abs().max((by - ay).abs()).ceil() as usize).clamp(1, 2 * SIDE);
    for step in 0..=steps {
        let share = step as f64 / steps as f64;
        let (x, y) = (ax + share * (bx - ax), ay + share * (by - ay));
        if (0.0..SIDE as f64).contains(&x) && (0.0..SIDE as f64).contains(&y) {
            covered[y as usize * SIDE + x as usize] = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_above_and_the_left_is_left() {
        // From the origin 0.5 m ahead and to the left.
        let vertices_m = vec![[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.5, 0.0]];
        let mesh = Mesh { vertices_m, triangles: vec![[0, 1, 2]], ..Mesh::default() };
        let covered = covered(&mesh, 1.0);
        let at = |x: f64, y: f64| covered[(y * SIDE as f64) as usize * SIDE + (x * SIDE as f64) as usize];
        assert!(at(0.45, 0.30), "ahead and a little left");
        assert!(!at(0.55, 0.30) && !at(0.45, 0.60), "neither right nor behind");
    }
}
