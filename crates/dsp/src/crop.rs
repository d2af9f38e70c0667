//! A crop of the map around an object, beamformed to it, in fixed metres, m/s and decibels over the map's noise.

use crate::DspError;
use crate::angle::{Direction, VirtualArray};
use crate::axes::{column_at, coupling_m, row_at, unwrapped, velocity_at};
use crate::noncoherent::noise_power;
use artifact::cube::CubeHeader;
use artifact::dataset::{Crop, CropFormat};
use artifact::points::Object;
use artifact::rdm::RdmFrame;
use artifact::units::db_from_power;
use glam::DVec3;
use ndarray::Array2;

/// The paper's 451 × 451 pixels over 24 m × 8 m/s.
///
/// Levels from the noise (0 dB) to 70 dB above it: a car of 10 dBsm stands at 37–52 dB over 60–25 m on a 3 × 4 array
/// (`S6` and 10.8 dB of beamforming), the flat side of a bus up to 30 dB higher. A grey level is 0.27 dB.
pub const PAPER_CROP: CropFormat =
    CropFormat { side: 451, range_span_m: 24.0, velocity_span_mps: 8.0, floor_db: 0.0, ceiling_db: 70.0 };

/// Largest side that is drawn.
const LARGEST_SIDE: u32 = 8192;

/// The map beamformed to the object's azimuth, cut around it; columns grow with range, rows with velocity.
///
/// Power is interpolated linearly between cells. Velocity wraps, as the map's does; columns outside the map are black.
/// Ranges are those of echoes at the object's velocity (free of range–Doppler coupling), as [`Object::range_m`] is.
pub fn crop(header: &CubeHeader, map: &RdmFrame, object: &Object, format: &CropFormat) -> Result<Crop, DspError> {
    check_format(format)?;
    check_object(object)?;
    let header = &header.in_frame(map.index);
    let noise = noise_power(header, map)?;
    let centre_mps = object.radial_velocity_mps;
    let columns = pixel_centres(object.range_m + coupling_m(header, centre_mps), format.range_span_m, format.side)
        .map(|range_m| column_at(header, range_m));
    let rows = pixel_centres(centre_mps, format.velocity_span_mps, format.side)
        .map(|velocity_mps| row_at(header, velocity_mps));
    let (rows, columns): (Vec<f64>, Vec<f64>) = (rows.collect(), columns.collect());
    let patch = Patch::beamformed(header, map, object, &rows, &columns);
    let pixels = rows.iter().flat_map(|row| columns.iter().map(|column| patch.power(*row, *column)));
    Ok(Crop {
        pixels: pixels.map(|power| grey(power, noise, format)).collect(),
        range_m: object.range_m,
        radial_velocity_mps: centre_mps,
    })
}

/// Grey level of a power: 0 at the format's floor over the noise, 255 at its ceiling.
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
    let fits = spans.iter().all(|span| span.is_finite() && *span > 0.0) && (1..=LARGEST_SIDE).contains(&format.side);
    if fits { Ok(()) } else { Err(DspError::CropFormat) }
}

fn check_object(object: &Object) -> Result<(), DspError> {
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
    fn beamformed(header: &CubeHeader, map: &RdmFrame, object: &Object, rows: &[f64], columns: &[f64]) -> Self {
        let [first_row, last_row] = reach(rows);
        let [first_column, last_column] = reach(columns);
        let samples = header.radar.waveform.range_cells() as i64;
        let (first_column, end_column) = (first_column.clamp(0, samples), (last_column + 1).clamp(0, samples));
        let array = VirtualArray::new(header);
        let steering = array.steering(direction_of(header, &array, object), object.range_m);
        let size = ((last_row + 1 - first_row) as usize, (end_column - first_column).max(0) as usize);
        let power = Array2::from_shape_fn(size, |(row, column)| {
            let cell = [first_row + row as i64, first_column + column as i64];
            cell_power(header, map, &array, &steering, object, cell)
        });
        Self { first_row, first_column, power }
    }

    /// Linear between cells; nothing outside the map.
    fn power(&self, row: f64, column: f64) -> f64 {
        let (low_row, low_column) = (row.floor(), column.floor());
        let (down, right) = (row - low_row, column - low_column);
        let at = |row: i64, column: i64| {
            let (row, column) = (row - self.first_row, column - self.first_column);
            let cell = usize::try_from(row).ok().zip(usize::try_from(column).ok());
            cell.and_then(|cell| self.power.get(cell)).copied().unwrap_or(0.0)
        };
        let (r, c) = (low_row as i64, low_column as i64);
        let upper = at(r, c) * (1.0 - right) + at(r, c + 1) * right;
        let lower = at(r + 1, c) * (1.0 - right) + at(r + 1, c + 1) * right;
        upper * (1.0 - down) + lower * down
    }
}

/// First and last cell that interpolation between these places needs.
fn reach(places: &[f64]) -> [i64; 2] {
    let low = places.iter().copied().fold(f64::INFINITY, f64::min);
    let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [low.floor() as i64, high.floor() as i64 + 1]
}

fn direction_of(header: &CubeHeader, array: &VirtualArray, object: &Object) -> Direction {
    let from_radar = DVec3::from(object.position_m) - DVec3::from(header.radar.position_m);
    let [right, up, _] = array.axes();
    // The steering of an array without rows does not feel `up`.
    let unit = from_radar.try_normalize().unwrap_or(array.axes()[2]);
    Direction { right: unit.dot(right), up: Some(unit.dot(up)) }
}

/// |beam|² over the number of channels: noise keeps the level it has in one channel.
fn cell_power(
    header: &CubeHeader,
    map: &RdmFrame,
    array: &VirtualArray,
    steering: &[num_complex::Complex64],
    object: &Object,
    [row, column]: [i64; 2],
) -> f64 {
    let chirps = i64::from(header.radar.waveform.chirps);
    let row = row.rem_euclid(chirps) as usize;
    let velocity_mps = unwrapped(header, velocity_at(header, row as f64), object.radial_velocity_mps);
    let snapshot = array.snapshot(header, map, [row, column as usize], velocity_mps);
    array.beam(&snapshot, steering).norm_sqr() / snapshot.len() as f64
}
