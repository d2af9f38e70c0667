//! Signature of an object: its own echo along range, cell by cell, with levels from the radar equation,
//! cross-range positions and heights.
//!
//! A rigid vehicle fills a row or two of a map (0.15 m/s at 10 m/s), so its shape shows in range and
//! direction. The strongest of the object's own velocity cells represents each range cell; cells nearer to a
//! point of another object (`cell_owners.rs`) are left out.

use crate::crops::cell_owners::CellOwners;
use crate::crops::crop::{check_object, direction_of};
use crate::direction::angle::Direction;
use crate::direction::position::{WorldPosition, world_position};
use crate::error::DspError;
use crate::plan::Plan;
use artifact::points::{Object, PointsFrame};
use artifact::radar::Sampling;
use artifact::rdm::RdmFrame;
use artifact::signature::{Signature, SignatureCell};
use artifact::units::{db_from_power, power_from_db};
use glam::{DVec2, DVec3};
use ndarray::Array2;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Extent before an object's nearest point, m, for parts below the detector's threshold.
const BEFORE_M: f64 = 3.0;
/// Extent from the nearest point on, m: an articulated vehicle and delayed echoes from underneath.
const BEHIND_M: f64 = 21.0;
/// Velocity gate around the object's velocity, either way, m/s.
const GATE_MPS: f64 = 1.25;
/// Maximum distance from the object's position at which a cell's own direction is used, m: no vehicle is
/// wider; otherwise that of the object.
const ACROSS_M: f64 = 6.0;
/// Threshold for measuring a direction: standard deviations of noise by which the channels' mean power
/// exceeds its mean.
const DEVIATIONS: f64 = 5.0;
/// Minimum amplitude of the antenna pattern for which levels are corrected.
const LEAST_PATTERN: f64 = 0.1;

/// Signatures of the objects of one map, with shared quantities computed once.
pub struct Signatures<'a> {
    plan: &'a Plan,
    map: &'a RdmFrame,
    /// Mean power over channels, `[doppler, range]`.
    power: Array2<f64>,
    /// Mean noise power of one channel in a cell.
    noise: f64,
}

/// Part of the map searched for an object's signature.
struct Search<'o> {
    object: &'o Object,
    number: u32,
    owners: CellOwners,
    rows: [i64; 2],
    direction: Direction,
    position: WorldPosition,
}

impl<'a> Signatures<'a> {
    /// Prepares the signatures of a map of this sub-frame.
    ///
    /// # Errors
    /// The map has another shape, or contains non-finite values.
    pub(crate) fn new(plan: &'a Plan, map: &'a RdmFrame) -> Result<Self, DspError> {
        let levels = plan.levels(map)?;
        Ok(Self { plan, map, noise: levels.noise(), power: levels.into_mean() })
    }

    /// Signature of one object among the others of its frame.
    ///
    /// # Errors
    /// There is no such object, or its range, velocity or position is not finite.
    pub fn of(&self, points: &PointsFrame, object: u32) -> Result<Signature, DspError> {
        let own = points.objects.get(object as usize).ok_or(DspError::NoSuchObject { object })?;
        check_object(own)?;
        let columns = self.columns(own);
        let search = self.search(points, own, object, columns);
        let cells: Vec<SignatureCell> =
            (columns[0]..=columns[1]).map(|column| self.cell(&search, column)).collect();
        let [across, above] = self.plan.array.beams();
        let width = |beam: f64| beam.is_finite().then_some(beam);
        Ok(Signature {
            range_m: own.range_m,
            radial_velocity_mps: own.radial_velocity_mps,
            azimuth_rad: search.direction.right.clamp(-1.0, 1.0).asin(),
            radar_height_m: self.plan.radar.position_m[2],
            beams: [width(across), width(above)],
            cell_m: self.plan.array.cells().range_cell_m,
            velocity_cell_mps: self.plan.array.cells().velocity_cell_mps,
            noise_dbsm: self.noise_dbsm(own, search.direction),
            points: own.points,
            range_extent_m: own.range_extent_m,
            ghost_share: own.ghost_share,
            first_range_m: self.range_at(columns[0], own.radial_velocity_mps),
            cells,
        })
    }

    /// First and last range cell, within the map.
    fn columns(&self, object: &Object) -> [i64; 2] {
        let (last, axes) = (self.power.ncols() as i64 - 1, self.plan.array.cells());
        let shift_m = axes.coupling_m(object.radial_velocity_mps);
        [-BEFORE_M, BEHIND_M].map(|offset_m| {
            let column = axes.column_at(object.range_extent_m[0] + shift_m + offset_m);
            (column.round() as i64).clamp(0, last)
        })
    }

    fn range_at(&self, column: i64, velocity_mps: f64) -> f64 {
        let axes = self.plan.array.cells();
        axes.range_at(column as f64) - axes.coupling_m(velocity_mps)
    }

    fn search<'o>(
        &self,
        points: &PointsFrame,
        object: &'o Object,
        number: u32,
        columns: [i64; 2],
    ) -> Search<'o> {
        let (velocity_mps, chirps) = (object.radial_velocity_mps, self.power.nrows() as i64);
        let (array, axes) = (&self.plan.array, self.plan.array.cells());
        let [first, last] = [-GATE_MPS, GATE_MPS].map(|offset| axes.row_at(velocity_mps + offset));
        let first = first.floor() as i64;
        let rows = [first, (last.ceil() as i64).min(first + chirps - 1)];
        let direction = direction_of(array, object);
        Search {
            object,
            number,
            owners: CellOwners::within(axes, points, [rows, columns]),
            rows,
            direction,
            position: world_position(array, direction, object.range_m),
        }
    }

    /// Strongest of the object's own velocity cells at a range; empty if all belong to other objects.
    fn cell(&self, search: &Search<'_>, column: i64) -> SignatureCell {
        let chirps = self.power.nrows() as i64;
        let own: Vec<(i64, f64)> = (search.rows[0]..=search.rows[1])
            .filter(|row| search.owners.of([*row, column]).is_none_or(|owner| owner == search.number))
            .map(|row| (row, self.power[(row.rem_euclid(chirps) as usize, column as usize)]))
            .collect();
        let strongest = own.iter().copied().reduce(|best, next| if next.1 > best.1 { next } else { best });
        let Some((row, power)) = strongest else { return self.nothing() };
        SignatureCell {
            velocity_spread_mps: self.spread_mps(&own) as f32,
            ..self.located(search, [row, column], power)
        }
    }

    /// Level, cross-range position, height and coherence from the channels of a cell.
    fn located(&self, search: &Search<'_>, [row, column]: [i64; 2], power: f64) -> SignatureCell {
        let (array, axes) = (&self.plan.array, self.plan.array.cells());
        let row = row.rem_euclid(axes.rows as i64) as usize;
        let velocity_mps = axes.unwrapped(axes.velocity_at(row as f64), search.object.radial_velocity_mps);
        let snapshot = array.snapshot(self.map, [row, column as usize], velocity_mps);
        let range_m = self.range_at(column, velocity_mps).max(axes.range_cell_m);
        let (direction, found) = self.direction(search, &snapshot, range_m, power);
        let explained = array.explained_power(&snapshot, direction, range_m);
        let total: f64 = snapshot.iter().map(|value| value.norm_sqr()).sum();
        SignatureCell {
            level_db: db_from_power((explained / self.noise.max(f64::MIN_POSITIVE)).max(1e-3)) as f32,
            cross_m: self.cross_m(&search.position, &found) as f32,
            height_m: self.has_rows().then_some(found.position_m.z as f32),
            coherence: (explained / total.max(f64::MIN_POSITIVE)) as f32,
            velocity_spread_mps: 0.0,
        }
    }

    /// Direction of the strongest beam of a cell, if it is near the object; otherwise the object's.
    fn direction(
        &self,
        search: &Search<'_>,
        snapshot: &[Complex64],
        range_m: f64,
        power: f64,
    ) -> (Direction, WorldPosition) {
        let array = &self.plan.array;
        let own = || (search.direction, world_position(array, search.direction, range_m));
        let deviation = self.noise / (snapshot.len() as f64).sqrt();
        if power < self.noise + DEVIATIONS * deviation {
            return own();
        }
        let direction = array.direction(&[snapshot.to_vec()], range_m);
        let found = world_position(array, direction, range_m);
        if self.cross_m(&search.position, &found).abs() <= ACROSS_M { (direction, found) } else { own() }
    }

    /// Standard deviation of velocity over an object's rows, weighted by the power above the noise, m/s.
    fn spread_mps(&self, own: &[(i64, f64)]) -> f64 {
        let weight = |power: f64| (power - self.noise).max(0.0);
        let sum = |value: &dyn Fn(f64) -> f64| {
            own.iter().map(|(row, p)| weight(*p) * value(*row as f64)).sum::<f64>()
        };
        let total = sum(&|_| 1.0);
        if total <= 0.0 {
            return 0.0;
        }
        let mean = sum(&|row| row) / total;
        (sum(&|row| (row - mean).powi(2)) / total).sqrt() * self.plan.array.cells().velocity_cell_mps
    }

    fn has_rows(&self) -> bool {
        self.plan.array.beams()[1].is_finite()
    }

    fn nothing(&self) -> SignatureCell {
        let height_m = self.has_rows().then_some(0.0);
        SignatureCell { level_db: 0.0, cross_m: 0.0, height_m, coherence: 0.0, velocity_spread_mps: 0.0 }
    }

    /// Noise level as an RCS in dBsm, σ = P (4π)³R⁴/(P_t G²λ² N_s²N_c² N) for a beam over N channels, with P
    /// the noise of one; the windows' coherent gain is 1. For real samples the kept half of the map contains
    /// half of an echo's amplitude.
    fn noise_dbsm(&self, object: &Object, direction: Direction) -> f64 {
        let (radar, waveform) = (&self.plan.radar, &self.plan.radar.waveform);
        let gain = power_from_db(radar.link.antenna_gain_db);
        let kept = match waveform.sampling {
            Sampling::Complex => 1.0,
            Sampling::Real => 0.5,
        };
        let transform = kept * f64::from(waveform.samples) * f64::from(waveform.chirps);
        let up = direction.up.unwrap_or_else(|| self.assumed_up(object));
        let ahead = (1.0 - direction.right.powi(2) - up.powi(2)).max(0.0).sqrt();
        let pattern = radar.array.pattern.amplitude([direction.right, ahead, up]).abs().max(LEAST_PATTERN);
        let echo = radar.link.transmit_power_w
            * (gain * waveform.wavelength_m() * transform * pattern.powi(2)).powi(2)
            / ((2.0 * TAU).powi(3) * object.range_m.max(1.0).powi(4));
        db_from_power(self.noise / (echo * radar.virtual_channels() as f64))
    }

    /// Direction cosine along up for an array without rows, from the assumed height of the object.
    fn assumed_up(&self, object: &Object) -> f64 {
        let from_radar = DVec3::from(object.position_m) - self.plan.array.position_m();
        from_radar.normalize_or_zero().dot(self.plan.array.axes()[1])
    }

    /// Distance of a position to the right of an object's, across the horizontal line of sight to it, m.
    fn cross_m(&self, object: &WorldPosition, found: &WorldPosition) -> f64 {
        let radar = self.plan.array.position_m();
        let sight = (object.position_m - radar).truncate().normalize_or(DVec2::Y);
        (found.position_m - object.position_m).truncate().dot(DVec2::new(sight.y, -sight.x))
    }
}
