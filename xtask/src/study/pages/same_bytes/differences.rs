//! Differences between the values of two results of the same work.

use artifact::Reader;
use artifact::cube::Cube;
use artifact::paths::Paths;
use artifact::points::{Point, Points};
use artifact::units::db_from_amplitude;
use num_complex::Complex64;
use std::path::Path;
use wayside::host::failure::Failure;

/// Scenes whose paths, cubes and points are compared.
const SCENES: [&str; 2] = ["car", "road"];

/// Largest differences of two results.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Differences {
    /// Amplitudes of the paths: root sum of squared differences relative to that of all.
    paths: f64,
    cube: f64,
    table: f64,
    /// Range, velocity and azimuth of the points; `None` if their numbers differ.
    points: Option<[f64; 3]>,
}

impl Differences {
    pub(super) fn of(one: &Path, other: &Path) -> Result<Self, Failure> {
        let mut all = Self { paths: 0.0, cube: 0.0, table: 0.0, points: Some([0.0; 3]) };
        for scene in SCENES {
            let [one, other] = [one.join(scene), other.join(scene)];
            all.paths = all.paths.max(relative(&paths(&one)?, &paths(&other)?));
            all.cube = all.cube.max(relative(&cube(&one)?, &cube(&other)?));
            let points = of_points(&points(&one)?, &points(&other)?);
            all.points = all.points.zip(points).map(|(a, b)| std::array::from_fn(|i| a[i].max(b[i])));
        }
        all.table = relative(&table(one)?, &table(other)?);
        Ok(all)
    }

    /// Cells of a row; "none" if nothing differs.
    pub(super) fn cells(&self) -> Vec<String> {
        let [range, velocity, azimuth] = match self.points {
            None => ["other points".into(), "–".into(), "–".into()],
            Some(points) => {
                points.map(|value| if value == 0.0 { "none".into() } else { format!("{value:.0e}") })
            }
        };
        vec![level(self.paths), level(self.cube), range, velocity, azimuth, level(self.table)]
    }

    /// The largest difference of fields, dB; 0 if the points differ in number.
    pub(super) fn worst_db(&self) -> f64 {
        let of_fields = db_from_amplitude(self.paths.max(self.cube).max(self.table));
        if self.points.is_some() { of_fields } else { of_fields.max(0.0) }
    }
}

/// Whether two files hold the same bytes; not where one is missing.
pub(super) fn identical(one: &Path, other: &Path) -> bool {
    std::fs::read(one).ok().is_some_and(|bytes| std::fs::read(other).is_ok_and(|others| others == bytes))
}

fn level(relative: f64) -> String {
    if relative == 0.0 { "none".into() } else { format!("−{:.0}", -db_from_amplitude(relative)) }
}

/// Root sum of squared differences relative to that of the first; 1 if the numbers differ.
fn relative(one: &[Complex64], other: &[Complex64]) -> f64 {
    if one.len() != other.len() {
        return 1.0;
    }
    let power = |values: &mut dyn Iterator<Item = Complex64>| values.map(|v| v.norm_sqr()).sum::<f64>();
    let of_difference = power(&mut one.iter().zip(other).map(|(a, b)| a - b));
    (of_difference / power(&mut one.iter().copied()).max(f64::MIN_POSITIVE)).sqrt()
}

fn paths(folder: &Path) -> Result<Vec<Complex64>, Failure> {
    let mut all = vec![];
    for frame in Reader::<Paths>::open(&folder.join("frames.paths"))? {
        all.extend(frame?.paths.iter().flat_map(|path| path.amplitude_m.into_iter().flatten()));
    }
    Ok(all)
}

fn cube(folder: &Path) -> Result<Vec<Complex64>, Failure> {
    let mut all = vec![];
    for frame in Reader::<Cube>::open(&folder.join("frames.cube"))? {
        all.extend(frame?.samples.iter().map(|v| Complex64::new(v.re.into(), v.im.into())));
    }
    Ok(all)
}

/// Values of a NumPy file of complex numbers: after ten bytes and the length given by the last two of them.
fn table(folder: &Path) -> Result<Vec<Complex64>, Failure> {
    let file = folder.join("table.npy");
    let bytes = std::fs::read(&file).map_err(|e| Failure::system(&file, "read", e))?;
    let header = bytes.get(8..10).map_or(0, |b| usize::from(u16::from_le_bytes([b[0], b[1]])));
    let values = bytes.get(10 + header..).unwrap_or_default();
    let (values, _) = values.as_chunks::<8>();
    let values: Vec<f64> = values.iter().map(|value| f64::from_le_bytes(*value)).collect();
    Ok(values.chunks_exact(2).map(|pair| Complex64::new(pair[0], pair[1])).collect())
}

fn points(folder: &Path) -> Result<Vec<Point>, Failure> {
    let mut all = vec![];
    for frame in Reader::<Points>::open(&folder.join("frames.points"))? {
        all.extend(frame?.points);
    }
    Ok(all)
}

fn of_points(one: &[Point], other: &[Point]) -> Option<[f64; 3]> {
    let of = |p: &Point| [p.range_m, p.radial_velocity_mps, p.azimuth_rad.to_degrees()];
    let pairs = one.iter().zip(other).map(|(a, b)| (of(a), of(b)));
    let larger = |most: [f64; 3], (a, b): ([f64; 3], [f64; 3])| {
        std::array::from_fn(|i| f64::max(most[i], (a[i] - b[i]).abs()))
    };
    (one.len() == other.len()).then(|| pairs.fold([0.0; 3], larger))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_millionth_of_all_is_120_db_below_and_other_numbers_of_values_are_all_of_it() {
        let one = [Complex64::new(3.0, 0.0), Complex64::new(0.0, 4.0)];
        let other = [one[0] + 5e-6, one[1]];
        assert!((db_from_amplitude(relative(&one, &other)) + 120.0).abs() < 1e-6);
        assert_eq!([relative(&one, &one), relative(&one, &one[..1])], [0.0, 1.0]);
    }
}
