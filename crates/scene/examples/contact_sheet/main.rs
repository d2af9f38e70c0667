//! Pictures of vehicles side by side, as many in a row as there are seeds; a mesh file is shown once:
//! `cargo run --release -p scene --example contact_sheet -- OUT.png SEEDS YAW_DEG NAME_OR_FILE…`.
//! With `OUT_DIR/` in place of the picture the meshes are written there as `.glb`.

mod png;

use artifact::scene::Mesh;
use glam::DVec3;
use std::error::Error;
use std::path::Path;

const TILE: [usize; 2] = [300, 190];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [out, seeds, yaw_deg, names @ ..] = arguments.as_slice() else {
        return Err("contact_sheet OUT.png SEEDS YAW_DEG NAME_OR_FILE...".into());
    };
    let (seeds, yaw_deg): (u64, f64) = (seeds.parse()?, yaw_deg.parse()?);
    if out.ends_with('/') {
        return write_meshes(out, seeds, names);
    }
    let mut meshes = Vec::new();
    for name in names {
        for seed in 0..seeds {
            meshes.extend(opened(name, seed)?);
        }
    }
    let columns = seeds as usize;
    let mut sheet = Sheet::new(columns, meshes.len().div_ceil(columns));
    for (place, mesh) in meshes.iter().enumerate() {
        sheet.draw(mesh, yaw_deg, [place % columns, place / columns]);
    }
    std::fs::write(out, png::encode(sheet.size(), &sheet.pixels)?)?;
    Ok(())
}

fn write_meshes(folder: &str, seeds: u64, names: &[String]) -> Result<(), Box<dyn Error>> {
    for name in names {
        for seed in 0..seeds {
            let vehicle = scene::vehicles::vehicle(name, seed).ok_or(format!("no vehicle `{name}`"))?;
            std::fs::write(format!("{folder}{name}-{seed}.glb"), scene::vehicles::glb(&vehicle))?;
        }
    }
    Ok(())
}

/// A family's mesh, or a file for the first seed.
fn opened(name: &str, seed: u64) -> Result<Option<Mesh>, Box<dyn Error>> {
    match scene::vehicles::mesh(name, seed) {
        Some(mesh) => Ok(Some(mesh)),
        None if seed > 0 => Ok(None),
        None => Ok(Some(scene::read_mesh(Path::new(name), &scene::MeshOptions { unit_scale: None })?)),
    }
}

struct Sheet {
    tiles: [usize; 2],
    pixels: Vec<[u8; 3]>,
    depth: Vec<f64>,
}

impl Sheet {
    fn new(columns: usize, rows: usize) -> Self {
        let count = columns * TILE[0] * rows * TILE[1];
        Self { tiles: [columns, rows], pixels: vec![[245; 3]; count], depth: vec![f64::NEG_INFINITY; count] }
    }

    fn size(&self) -> [usize; 2] {
        [self.tiles[0] * TILE[0], self.tiles[1] * TILE[1]]
    }

    /// Parallel view from the front left, 15° above the horizon, as large as the tile lets it be.
    fn draw(&mut self, mesh: &Mesh, yaw_deg: f64, tile: [usize; 2]) {
        let (yaw, pitch) = (yaw_deg.to_radians(), 15_f64.to_radians());
        let right = DVec3::new(-yaw.sin(), yaw.cos(), 0.0);
        let towards = DVec3::new(yaw.cos() * pitch.cos(), yaw.sin() * pitch.cos(), pitch.sin());
        let up = towards.cross(right);
        let seen = |v: &[f64; 3]| {
            let p = DVec3::from_array(*v);
            DVec3::new(p.dot(right), p.dot(up), p.dot(towards))
        };
        let points: Vec<DVec3> = mesh.vertices_m.iter().map(seen).collect();
        let low = points.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
        let high = points.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
        let room = [TILE[0] as f64 - 12.0, TILE[1] as f64 - 12.0];
        let scale = (room[0] / (high.x - low.x)).min(room[1] / (high.y - low.y));
        let corner = [(tile[0] * TILE[0]) as f64 + 6.0, ((tile[1] + 1) * TILE[1]) as f64 - 6.0];
        let place =
            |p: DVec3| DVec3::new(corner[0] + (p.x - low.x) * scale, corner[1] - (p.y - low.y) * scale, p.z);
        for (t, slot) in mesh.triangles.iter().zip(&mesh.material_of_triangle) {
            let [a, b, c] = t.map(|i| points[i as usize]);
            let normal = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Z);
            let light = normal.dot(DVec3::new(0.35, 0.55, 0.76)) * normal.z.signum();
            let name = mesh.materials.get(*slot as usize).map_or("", String::as_str);
            self.fill([a, b, c].map(place), shade(name, light));
        }
    }

    fn fill(&mut self, corners: [DVec3; 3], colour: [u8; 3]) {
        let [a, b, c] = corners;
        let [width, height] = self.size();
        let low = a.min(b).min(c).max(DVec3::ZERO);
        let high = a.max(b).max(c);
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        for row in low.y as usize..=(high.y as usize).min(height - 1) {
            for column in low.x as usize..=(high.x as usize).min(width - 1) {
                let p = glam::DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                let weight = |q: DVec3, r: DVec3| (q.truncate() - p).perp_dot(r.truncate() - p) / area;
                let (u, v, w) = (weight(b, c), weight(c, a), weight(a, b));
                let depth = u * a.z + v * b.z + w * c.z;
                let at = row * width + column;
                if u >= 0.0 && v >= 0.0 && w >= 0.0 && depth > self.depth[at] {
                    (self.depth[at], self.pixels[at]) = (depth, colour);
                }
            }
        }
    }
}

/// A material's colour in the light.
fn shade(material: &str, light: f64) -> [u8; 3] {
    let base = match material {
        "glass" => [70.0, 110.0, 140.0],
        "rubber" | "tyre_rubber" => [45.0, 45.0, 45.0],
        "plastic" => [80.0, 80.0, 85.0],
        "chrome" | "aluminium" | "steel" => [190.0, 195.0, 200.0],
        "lamp" => [255.0, 240.0, 160.0],
        "tail_lamp" => [230.0, 50.0, 40.0],
        "plate" => [250.0, 250.0, 120.0],
        "fabric" => [70.0, 90.0, 160.0],
        "leather" => [120.0, 80.0, 50.0],
        _ => [205.0, 110.0, 95.0],
    };
    base.map(|channel: f64| (channel * (0.35 + 0.65 * light.max(0.0))) as u8)
}
