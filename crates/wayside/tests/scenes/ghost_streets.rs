//! Streets of plates over which waves run between two bodies, and how many of their cells are marked.
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]

use std::collections::BTreeMap;
use std::fmt::Write;

/// The scene among the files of a street.
pub(crate) const SCENE: &str = "ghosts.toml";

type V3 = [f64; 3];

const RADAR: V3 = [0.0, 0.0, 6.0];
/// Cells of 0.24 m × 0.5 m/s.
const HEAD: &str = "name = \"ghosts\"\n[radar.waveform]\nsamples = 256\nchirps = 64\n[noise]\nnoise_figure_db = 12.0\n[dsp]\n\
                    false_alarm_rate = 1e-4\n[fidelity]\naccuracy_db = -20.0\nbounces = 2\n";

fn less(a: V3, b: V3) -> V3 {
    [0, 1, 2].map(|i: usize| a[i] - b[i])
}

fn unit(a: V3) -> V3 {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}

fn cross(a: V3, b: V3) -> V3 {
    [0, 1, 2].map(|i: usize| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

/// Square plates at their places, each a mesh of its own.
struct Street {
    /// Names and texts of the meshes, and at last of the scene.
    files: Vec<(String, String)>,
    scene: String,
    /// Distance of the direction cosines of a pair, by the ids of its two plates.
    apart: BTreeMap<String, f64>,
}

impl Street {
    /// Five pairs of plates, each turned so that a wave runs from the radar over both and back, and five that
    /// face the radar, so fast that no window's slope of theirs reaches a pair's cells. Everything is spread
    /// by multiples of the golden ratio, from `seed` on.
    fn new(array: &str, seed: u32) -> Self {
        let mut street =
            Self { files: vec![], scene: format!("{HEAD}[radar.array]\n{array}\n"), apart: BTreeMap::new() };
        let mut drawn = f64::from(seed);
        let mut uniform = |from: f64, to: f64| {
            drawn += 0.618_033_988_75;
            from + (to - from) * (drawn * (1.0 + drawn)).fract()
        };
        for (pair, velocity_mps) in [0.0, -2.0, -4.0, 2.0, 4.0].into_iter().enumerate() {
            let middle_deg = uniform(-12.0, 12.0);
            let half_deg = uniform(5.5, 9.0);
            let near_m = 18.0 + 7.0 * pair as f64 + uniform(0.0, 3.0);
            let mut plate = |side: f64| {
                let (sin, cos) = (middle_deg + side * half_deg).to_radians().sin_cos();
                let range_m = near_m + uniform(-1.5, 1.5);
                [range_m * sin, range_m * cos, uniform(1.0, 6.0)]
            };
            let places = [plate(-1.0), plate(1.0)];
            let cosines = places.map(|p| unit(less(p, RADAR))[0]);
            for (own, other) in [(0, 1), (1, 0)] {
                let [to_radar, to_other] = [RADAR, places[other]].map(|p| unit(less(p, places[own])));
                let normal = unit([0, 1, 2].map(|i: usize| to_radar[i] + to_other[i]));
                let id = format!("{}{pair}", ["left-", "right-"][own]);
                street.add(&id, places[own], normal, 1.0, velocity_mps);
                street.apart.insert(id, (cosines[0] - cosines[1]).abs());
            }
            let (sin, cos) = uniform(-15.0, 15.0).to_radians().sin_cos();
            let range_m = 21.0 + 8.0 * pair as f64 + uniform(0.0, 3.0);
            let facing = [range_m * sin, range_m * cos, 6.0];
            street.add(&format!("lone-{pair}"), facing, unit(less(RADAR, facing)), 0.7, velocity_mps + 10.0);
        }
        street.files.push((SCENE.to_owned(), street.scene.clone()));
        street
    }

    fn add(&mut self, id: &str, at_m: V3, normal: V3, side_m: f64, velocity_mps: f64) {
        let left = unit(cross([0.0, 0.0, 1.0], normal));
        let up = cross(normal, left);
        let mut mesh = String::new();
        for (a, b) in [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)] {
            let [x, y, z] = [0, 1, 2].map(|i: usize| side_m * (a * left[i] + b * up[i]));
            writeln!(mesh, "v {x:.9} {y:.9} {z:.9}").unwrap();
        }
        self.files.push((format!("{id}.obj"), mesh + "f 1 2 3\nf 1 3 4\n"));
        let [x, y, z] = at_m;
        write!(
            self.scene,
            "[[target]]\nkind = \"mesh\"\nid = \"{id}\"\nclass = \"car\"\nmodel = \"{id}.obj\"\nposition_m = [{x:.6}, {y:.6}, {z:.6}]\n\
             velocity_mps = [0.0, {velocity_mps:.1}, 0.0]\nyaw_deg = 0.0\n"
        )
        .unwrap();
    }
}

/// A row for each point, by the names of the columns.
fn rows(table: &str) -> Vec<BTreeMap<String, String>> {
    let mut lines = table.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines.map(|row| head.iter().cloned().zip(row).collect()).collect()
}

/// Marked cells of how many.
#[derive(Default)]
pub(crate) struct Count {
    pub(crate) marked: u32,
    pub(crate) all: u32,
}

impl Count {
    fn add(&mut self, marks: u32) {
        self.marked += marks;
        self.all += 1;
    }
}

/// Counts of cells in some streets, and those that are marked wrongly.
#[derive(Default)]
pub(crate) struct Counts {
    /// Cells of a way over two bodies that stand a beam apart.
    pub(crate) ghosts: Count,
    /// Cells of one body.
    pub(crate) direct: Count,
    /// Street and point of each cell that is marked wrongly, or not marked.
    pub(crate) wrong: Vec<String>,
}

/// The table of points of a street of these files, as CSV.
type TableOf<'a, E> = dyn Fn(&[(String, String)]) -> Result<String, E> + 'a;

/// Cells of 15 dB a channel and more that at least nine tenths of the power in their own beam come from.
/// `table_of` writes files of these names and texts, runs the scene [`SCENE`] among them and gives its table
/// of points as CSV.
pub(crate) fn counts<E>(
    array: &str,
    beam: f64,
    seeds: std::ops::Range<u32>,
    table_of: &TableOf<'_, E>,
) -> Result<Counts, E> {
    let mut counts = Counts::default();
    for seed in seeds {
        let street = Street::new(array, seed);
        for row in rows(&table_of(&street.files)?) {
            counts.add(&street, beam, seed, &row);
        }
    }
    Ok(counts)
}

impl Counts {
    fn add(&mut self, street: &Street, beam: f64, seed: u32, row: &BTreeMap<String, String>) {
        let number = |key: &str| row[key].parse::<f64>().unwrap_or(0.0);
        if number("snr_db") < 15.0 || number("true_share") < 0.9 {
            return;
        }
        let is_marked = !row["two_ways_az_deg"].is_empty();
        match row["true_bodies"].as_str() {
            "1" => self.direct.add(u32::from(is_marked)),
            _ if street.apart[&row["true_target"]] >= beam => self.ghosts.add(u32::from(is_marked)),
            _ => {}
        }
        if is_marked == (row["true_bodies"] == "1") {
            self.wrong.push(format!("street {seed}: {row:?}"));
        }
    }
}
