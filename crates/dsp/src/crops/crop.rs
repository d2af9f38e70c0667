//! A crop of the map around an object, beamformed towards it, in fixed metres, m/s and decibels above the
//! map's noise.

use crate::crops::cell_owners::CellOwners;
use crate::direction::angle::{Direction, VirtualArray};
use crate::error::DspError;
use crate::plan::Plan;
use artifact::cube::CUBE_LIMIT;
use artifact::dataset::{Crop, CropFormat};
use artifact::points::{Object, PointsFrame};
use artifact::rdm::RdmFrame;
use artifact::units::db_from_power;
use glam::DVec3;
use ndarray::Array2;
use num_complex::Complex64;

/// Format of the paper: 451 × 451 pixels over 24 m × 8 m/s.
///
/// Levels range from the noise (0 dB) to 70 dB above it: a car of 10 dBsm has 37–52 dB at 60–25 m on a 3 × 4
/// array (`S6` and 10.8 dB of beamforming), the flat side of a bus up to 30 dB more. A grey level is 0.27 dB.
pub const PAPER_CROP: CropFormat =
    CropFormat { side: 451, range_span_m: 24.0, velocity_span_mps: 8.0, floor_db: 0.0, ceiling_db: 70.0 };

/// Maximum side length, pixels.
const LARGEST_SIDE: u32 = 8192;
/// Position beyond which cell indices are no longer exact integers.
const FARTHEST_PLACE: f64 = (1_u64 << 52) as f64;

/// Crops of one map, with shared quantities computed once.
pub struct Cropper<'a> {
    plan: &'a Plan,
    map: &'a RdmFrame,
    format: CropFormat,
    noise: f64,
}

impl<'a> Cropper<'a> {
    /// Prepares crops of one format.
    pub(crate) fn new(plan: &'a Plan, map: &'a RdmFrame, format: &CropFormat) -> Result<Self, DspError> {
        check_format(format)?;
        Ok(Self { plan, map, format: *format, noise: plan.levels(map)?.noise() })
    }

    /// Crop of the map beamformed to the object's azimuth, with everything it contains; columns grow with
    /// range, rows with velocity.
    ///
    /// Power is interpolated linearly between cells. Velocity wraps, as in the map; columns outside the map
    /// are black. Ranges are those of echoes at the object's velocity (free of range–Doppler coupling), like
    /// [`Object::range_m`].
    pub fn crop(&self, object: &Object) -> Result<Crop, DspError> {
        self.rendered(object, |patch| patch)
    }

    /// Crop of an object among the others of its frame: cells nearer to a point of another object are limited
    /// to the noise level.
    pub fn crop_among(&self, points: &PointsFrame, object: u32) -> Result<Crop, DspError> {
        let own = points.objects.get(object as usize).ok_or(DspError::NoSuchObject { object })?;
        self.rendered(own, |patch| {
            let owners = CellOwners::within(self.plan.array.cells(), points, patch.window());
            patch.capped(self.noise, |cell| owners.of(cell).is_some_and(|owner| owner != object))
        })
    }

    fn rendered(&self, object: &Object, kept: impl FnOnce(Patch) -> Patch) -> Result<Crop, DspError> {
        check_object(object)?;
        let (axes, format) = (self.plan.array.cells(), &self.format);
        let centre_mps = object.radial_velocity_mps;
        let centre_m = object.range_m + axes.coupling_m(centre_mps);
        let columns =
            pixel_centres(centre_m, format.range_span_m, format.side).map(|range_m| axes.column_at(range_m));
        let rows = pixel_centres(centre_mps, format.velocity_span_mps, format.side)
            .map(|velocity_mps| axes.row_at(velocity_mps));
        let (rows, columns): (Vec<f64>, Vec<f64>) = (rows.collect(), columns.collect());
        if rows_across(&rows) * axes.columns as f64 > CUBE_LIMIT as f64 {
            return Err(DspError::CropFormat);
        }
        let lines = kept(Patch::beamformed(self, object, &rows, &columns)).along(&columns);
        let pixels = rows.iter().flat_map(|row| lines.between(*row));
        Ok(Crop {
            pixels: pixels.map(|power| grey(power, self.noise, format)).collect(),
            range_m: object.range_m,
            radial_velocity_mps: centre_mps,
        })
    }

    /// Power |beam|² over the number of channels, which keeps noise at its single-channel level.
    fn cell_power(&self, steering: &[Complex64], object: &Object, [row, column]: [i64; 2]) -> f64 {
        let (array, axes) = (&self.plan.array, self.plan.array.cells());
        let row = row.rem_euclid(axes.rows as i64) as usize;
        let velocity_mps = axes.unwrapped(axes.velocity_at(row as f64), object.radial_velocity_mps);
        let snapshot = array.snapshot(self.map, [row, column as usize], velocity_mps);
        array.beam(&snapshot, steering).norm_sqr() / snapshot.len() as f64
    }
}

/// Grey level of a power: 0 at the format's floor above the noise, 255 at its ceiling.
pub(crate) fn grey(power: f64, noise: f64, format: &CropFormat) -> u8 {
    if power <= 0.0 || noise <= 0.0 {
        return 0;
    }
    let level = (db_from_power(power / noise) - format.floor_db) / (format.ceiling_db - format.floor_db);
    (255.0 * level.clamp(0.0, 1.0)).round() as u8
}

/// Centres of `side` pixels over a span.
pub(crate) fn pixel_centres(centre: f64, span: f64, side: u32) -> impl Iterator<Item = f64> {
    (0..side).map(move |i| centre + span * ((f64::from(i) + 0.5) / f64::from(side) - 0.5))
}

pub(crate) fn check_format(format: &CropFormat) -> Result<(), DspError> {
    let spans = [format.range_span_m, format.velocity_span_mps, format.ceiling_db - format.floor_db];
    let fits =
        spans.iter().all(|span| span.is_finite() && *span > 0.0) && (1..=LARGEST_SIDE).contains(&format.side);
    if fits { Ok(()) } else { Err(DspError::CropFormat) }
}

pub(crate) fn check_object(object: &Object) -> Result<(), DspError> {
    for (quantity, finite) in [
        ("range_m", object.range_m.is_finite()),
        ("radial_velocity_mps", object.radial_velocity_mps.is_finite()),
        ("position_m", object.position_m.iter().all(|x| x.is_finite())),
    ] {
        if !finite {
            return Err(DspError::ObjectNotFinite { quantity });
        }
    }
    Ok(())
}

/// Beamformed power of the cells that a crop touches; rows are not wrapped.
struct Patch {
    first_row: i64,
    first_column: i64,
    power: Array2<f64>,
}

impl Patch {
    fn beamformed(cropper: &Cropper<'_>, object: &Object, rows: &[f64], columns: &[f64]) -> Self {
        let [first_row, last_row] = reach(rows);
        let [first_column, last_column] = reach(columns);
        let array = &cropper.plan.array;
        let samples = array.cells().columns as i64;
        let (first_column, end_column) =
            (first_column.clamp(0, samples), last_column.saturating_add(1).clamp(0, samples));
        let steering = array.steering(direction_of(array, object), object.range_m);
        let size = ((last_row + 1 - first_row) as usize, (end_column - first_column).max(0) as usize);
        let power = Array2::from_shape_fn(size, |(row, column)| {
            cropper.cell_power(&steering, object, [first_row + row as i64, first_column + column as i64])
        });
        Self { first_row, first_column, power }
    }

    /// First and last row, first and last column.
    fn window(&self) -> [[i64; 2]; 2] {
        let last = |first: i64, count: usize| [first, first + count as i64 - 1];
        [last(self.first_row, self.power.nrows()), last(self.first_column, self.power.ncols())]
    }

    /// Limits to `most` the cells `[row, column]` that are to be left out.
    fn capped(mut self, most: f64, is_left_out: impl Fn([i64; 2]) -> bool) -> Self {
        for ((row, column), power) in self.power.indexed_iter_mut() {
            if *power > most && is_left_out([self.first_row + row as i64, self.first_column + column as i64])
            {
                *power = most;
            }
        }
        self
    }

    /// Each row of cells sampled at these columns, linear between cells; zero outside the map.
    fn along(&self, columns: &[f64]) -> Lines {
        let at = |row: usize, column: i64| {
            let column = usize::try_from(column - self.first_column).ok();
            column.and_then(|column| self.power.get((row, column))).copied().unwrap_or(0.0)
        };
        let power = Array2::from_shape_fn((self.power.nrows(), columns.len()), |(row, pixel)| {
            let low = columns[pixel].floor();
            let right = columns[pixel] - low;
            at(row, low as i64) * (1.0 - right) + at(row, low as i64 + 1) * right
        });
        Lines { first_row: self.first_row, power }
    }
}

/// A patch sampled at the columns of a crop's pixels.
struct Lines {
    first_row: i64,
    power: Array2<f64>,
}

impl Lines {
    /// Pixels of a row interpolated between two rows of cells.
    fn between(&self, row: f64) -> impl Iterator<Item = f64> {
        let low = row.floor();
        let down = row - low;
        let upper = (low as i64 - self.first_row) as usize;
        let pixels = self.power.row(upper).into_iter().zip(self.power.row(upper + 1));
        pixels.map(move |(upper, lower)| upper * (1.0 - down) + lower * down)
    }
}

/// Number of rows needed to interpolate at these positions, in a map without ends; infinite beyond the range
/// of exact integers.
fn rows_across(places: &[f64]) -> f64 {
    let [first, last] = reach(places);
    let rows = last.saturating_sub(first).saturating_add(1) as f64;
    if places.iter().all(|place| place.abs() < FARTHEST_PLACE) { rows } else { f64::INFINITY }
}

/// First and last cell needed to interpolate at these positions.
fn reach(places: &[f64]) -> [i64; 2] {
    let low = places.iter().copied().fold(f64::INFINITY, f64::min);
    let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [low.floor() as i64, (high.floor() as i64).saturating_add(1)]
}

pub(crate) fn direction_of(array: &VirtualArray, object: &Object) -> Direction {
    let from_radar = DVec3::from(object.position_m) - array.position_m();
    let [right, up, _] = array.axes();
    // The steering of an array without rows does not depend on `up`.
    let unit = from_radar.try_normalize().unwrap_or(array.axes()[2]);
    Direction { right: unit.dot(right), up: Some(unit.dot(up)) }
}
