//! Direction of arrival: FFT over the virtual array, then the peak of the exact beam.
//!
//! A target at direction cosine u along the row gives the phase e^{−j2πp·u/λ} on an element at p (the mixer's
//! sign: a target on the + side is nearer to + elements), so the angle spectrum is Σ x e^{+j2πp·u/λ}. The
//! FFT, over elements snapped to a lattice, only finds the right lobe of the array's point-spread function;
//! the peak is then climbed on the beam with the exact distances to every element, which a 0.34 m row needs
//! at 25 m (0.9 rad of curvature) and arbitrary positions always need.

use crate::spectrum::axes::Axes;
use crate::spectrum::code_division;
use crate::spectrum::division::Division;
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Radar};
use artifact::rdm::RdmFrame;
use glam::{DVec2, DVec3};
use num_complex::Complex64;
use radar::lattice::{Lattice, lattices};
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A radar's channels as an aperture.
pub struct VirtualArray {
    cells: Axes,
    division: Division,
    position_m: DVec3,
    /// Height of targets where the array measures no elevation, m.
    assumed_height_m: f64,
    chirp_interval_s: f64,
    wavelength_m: f64,
    /// Unit vectors of the aperture: right and up as seen along the boresight, and the boresight itself.
    axes: [DVec3; 3],
    /// Transmit and receive element of each channel relative to the array's centre, world axes, metres.
    elements: Vec<[DVec3; 2]>,
    /// Calibration factor of each channel; empty if there is no calibration.
    calibration: Vec<Complex64>,
    /// Delay of each channel's chirps relative to those of the first transmitter, s.
    slot_s: Vec<f64>,
    /// |tx|² + |rx|² of each channel, m².
    squares_m2: Vec<f64>,
    lattices: [Lattice; 2],
    occupied: OccupiedRows,
    transforms: [Arc<dyn Fft<f64>>; 2],
}

/// Direction cosines along right and, if the array has elevation rows, along up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// Direction cosine along the horizontal row; 0 where the array has no horizontal extent.
    pub right: f64,
    /// Direction cosine along the vertical; `None` where the array has no vertical extent.
    pub up: Option<f64>,
}

impl Direction {
    /// Direction cosines along right, up and ahead, whose squares add up to 1. A direction beyond the visible
    /// region, as the peak of a beam may be, is replaced by the nearest on its rim.
    pub(crate) fn cosines(self) -> [f64; 3] {
        let (right, up) = (self.right, self.up.unwrap_or(0.0));
        let beyond = (right * right + up * up).sqrt().max(1.0);
        let (right, up) = (right / beyond, up / beyond);
        [right, up, (1.0 - right * right - up * up).max(0.0).sqrt()]
    }
}

/// Values of all channels in one cell, without the phases of time and code division.
pub type Snapshot = Vec<Complex64>;

/// Number of parabola steps of the climb: each quarters the step, so the last is 1/1000 of a beamwidth and
/// the remainder far below 1e-4 in u.
const CLIMBS: usize = 5;

impl VirtualArray {
    /// Array of a radar already checked for finite elements.
    pub fn new(header: &CubeHeader) -> Self {
        let radar = &header.radar;
        let [right, ahead, up] = radar::aperture::axes(radar);
        let axes = [right, up, ahead];
        let centre = DVec3::from(radar.position_m);
        let elements: Vec<[DVec3; 2]> = (radar.array.tx_m.iter())
            .flat_map(|tx| radar.array.rx_m.iter().map(move |rx| [tx, rx].map(|p| DVec3::from(*p) - centre)))
            .collect();
        let slot_s = (0..elements.len())
            .map(|channel| match radar.array.multiplexing {
                Multiplexing::Tdm => radar.chirp_start_s(channel / radar.array.rx_m.len(), 0),
                Multiplexing::Simultaneous | Multiplexing::Ddm | Multiplexing::Bpm => 0.0,
            })
            .collect();
        let wavelength_m = radar.waveform.wavelength_m();
        let lattices = lattices(radar);
        let mut planner = FftPlanner::new();
        let transforms = [0, 1].map(|axis: usize| planner.plan_fft_inverse(lattices[axis].cells()));
        let occupied = OccupiedRows::of(lattices[1].places());
        let squares_m2 = elements.iter().map(|[tx, rx]| tx.length_squared() + rx.length_squared()).collect();
        Self {
            cells: Axes::of(radar),
            division: Division::of(radar),
            position_m: centre,
            assumed_height_m: header.dsp.assumed_height_m,
            chirp_interval_s: radar.waveform.chirp_interval_s,
            calibration: header.dsp.calibration.clone(),
            wavelength_m,
            axes,
            elements,
            slot_s,
            squares_m2,
            lattices,
            occupied,
            transforms,
        }
    }

    /// Whether both transmitters and receivers have several positions along the row.
    pub(crate) fn ends_have_rows(&self) -> bool {
        let along = |end: usize| self.elements.iter().map(move |ends| ends[end].dot(self.axes[0]));
        let extent = |end: usize| along(end).fold(f64::MIN, f64::max) - along(end).fold(f64::MAX, f64::min);
        // Rotated positions agree to rounding, far below a wavelength.
        (0..2).all(|end| extent(end) > 1e-6 * self.wavelength_m)
    }

    /// Values of one cell; `velocity_mps` removes the phases of the later slots of time and code division.
    pub fn snapshot(&self, map: &RdmFrame, cell: [usize; 2], velocity_mps: f64) -> Snapshot {
        self.snapshot_and_idle(map, cell, velocity_mps).0
    }

    /// Values of [`Self::snapshot`], and the power of unused codes.
    pub(crate) fn snapshot_and_idle(
        &self,
        map: &RdmFrame,
        cell: [usize; 2],
        velocity_mps: f64,
    ) -> (Snapshot, f64) {
        let (values, idle) = self.uncalibrated(map, cell, velocity_mps);
        (self.calibrated(values), idle)
    }

    /// [`Self::snapshot_and_idle`] before calibration, with the channels' own gains and phases.
    pub(crate) fn uncalibrated(
        &self,
        map: &RdmFrame,
        cell: [usize; 2],
        velocity_mps: f64,
    ) -> (Snapshot, f64) {
        let Axes { rows, columns, .. } = self.cells;
        let doppler_hz = 2.0 * velocity_mps / self.wavelength_m;
        let value = |channel: usize| {
            let value = map.values[(channel * rows + cell[0]) * columns + cell[1]];
            Complex64::new(f64::from(value.re), f64::from(value.im))
        };
        if self.division.multiplexing == Multiplexing::Bpm {
            let codes: Vec<Complex64> = (0..self.division.map_channels).map(value).collect();
            let cycles = doppler_hz * self.chirp_interval_s;
            let mut values = code_division::in_phase(&self.division, &codes, [cell[0], rows], cycles);
            let idle = values.split_off(self.elements.len()).iter().map(|value| value.norm_sqr()).sum();
            return (values, idle);
        }
        let turned = |(channel, slot_s): (usize, &f64)| value(channel) * turned_back(doppler_hz * slot_s);
        (self.slot_s.iter().enumerate().map(turned).collect(), 0.0)
    }

    fn calibrated(&self, mut values: Snapshot) -> Snapshot {
        values.iter_mut().zip(&self.calibration).for_each(|(value, factor)| *value *= factor);
        values
    }

    /// Strongest cell of the angle FFT over one or more cells of a map, their powers summed: accurate to half
    /// a cell of the FFT.
    pub fn fft_direction(&self, snapshots: &[Snapshot], range_m: f64) -> Direction {
        let found = self.coarse(snapshots, range_m);
        Direction { right: found.x, up: self.lattices[1].has_extent().then_some(found.y) }
    }

    /// Direction of the strongest beam over one or more cells, their powers summed: that of the FFT, climbed.
    pub fn direction(&self, snapshots: &[Snapshot], range_m: f64) -> Direction {
        let mut found = self.coarse(snapshots, range_m);
        let mut step = [0, 1].map(|axis: usize| self.lattices[axis].step());
        for _ in 0..CLIMBS {
            for axis in 0..2 {
                if self.lattices[axis].has_extent() {
                    found[axis] = self.climb(snapshots, range_m, found, axis, step[axis]);
                    step[axis] *= 0.25;
                }
            }
        }
        Direction { right: found.x, up: self.lattices[1].has_extent().then_some(found.y) }
    }

    /// Beam towards a direction: Σ over channels of value · e^{−j·phase of a point there}.
    pub fn beam(&self, snapshot: &[Complex64], steering: &[Complex64]) -> Complex64 {
        snapshot.iter().zip(steering).map(|(value, turn)| value * turn).sum()
    }

    /// Power of a cell explained by an echo from this direction.
    pub(crate) fn explained_power(&self, snapshot: &[Complex64], direction: Direction, range_m: f64) -> f64 {
        self.beam(snapshot, &self.steering(direction, range_m)).norm_sqr() / snapshot.len() as f64
    }

    /// Conjugate steering vector of a point at this direction and range: the weights that align its echo in
    /// phase on all channels.
    pub fn steering(&self, direction: Direction, range_m: f64) -> Vec<Complex64> {
        self.excess_m(direction, range_m)
            .into_iter()
            .map(|excess_m| turned_back(excess_m / self.wavelength_m))
            .collect()
    }

    /// Rows and columns of the radar's maps.
    pub(crate) fn cells(&self) -> &Axes {
        &self.cells
    }

    /// Transmitters and receivers of the array, and how transmitters are multiplexed.
    pub(crate) fn division(&self) -> &Division {
        &self.division
    }

    /// The array's centre, world metres.
    pub(crate) fn position_m(&self) -> DVec3 {
        self.position_m
    }

    /// Height of targets above the world's ground where the array measures no elevation, m.
    pub(crate) fn assumed_height_m(&self) -> f64 {
        self.assumed_height_m
    }

    /// Conjugate steering vectors of each end alone: of transmit elements, and of receive elements.
    pub(crate) fn element_steering(&self, direction: Direction, range_m: f64) -> [Vec<Complex64>; 2] {
        let point = self.point(direction, range_m);
        let turn = |element: DVec3| turned_back(excess_m(point, element, range_m) / self.wavelength_m);
        let tx =
            self.elements.iter().step_by(self.division.receivers.max(1)).map(|[tx, _]| turn(*tx)).collect();
        let rx = self.elements.iter().take(self.division.receivers).map(|[_, rx]| turn(*rx)).collect();
        [tx, rx]
    }

    /// Excess of the two-way path to a point via each channel's elements over that via the array's centre, m.
    pub fn excess_m(&self, direction: Direction, range_m: f64) -> Vec<f64> {
        let point = self.point(direction, range_m);
        self.elements
            .iter()
            .map(|[tx, rx]| excess_m(point, *tx, range_m) + excess_m(point, *rx, range_m))
            .collect()
    }

    /// Position of a point relative to the array's centre, world axes, m.
    fn point(&self, direction: Direction, range_m: f64) -> DVec3 {
        let [right, up, ahead] = self.axes;
        let [u, w, out_of_plane] = direction.cosines();
        range_m * (u * right + w * up + out_of_plane * ahead)
    }

    /// Derivatives of [`Self::excess_m`] with respect to the direction cosines, m; 0 along axes without
    /// extent.
    pub(crate) fn excess_slopes_m(&self, direction: Direction, range_m: f64) -> Vec<[f64; 2]> {
        // Central difference: the third derivative leaves 1e-12 of the slope, rounding of lengths below 1 m
        // 1e-10.
        let small = 1e-6;
        let along = |right: f64, up: f64| {
            let [more, less] = [small, -small].map(|h| {
                let up = direction.up.map(|w| w + h * up);
                self.excess_m(Direction { right: direction.right + h * right, up }, range_m)
            });
            more.into_iter().zip(less).map(|(a, b)| (a - b) / (2.0 * small)).collect::<Vec<f64>>()
        };
        let [right, up] = [(0, 1.0, 0.0), (1, 0.0, 1.0)].map(|(axis, r, u): (usize, f64, f64)| {
            if self.lattices[axis].has_extent() { along(r, u) } else { vec![0.0; self.elements.len()] }
        });
        right.into_iter().zip(up).map(|(right, up)| [right, up]).collect()
    }

    /// Maximum wavefront curvature over the elements for a point at this range, transmit and receive
    /// together.
    pub(crate) fn curvature_cycles(&self, range_m: f64) -> f64 {
        let most_m2 = self.squares_m2.iter().copied().fold(0.0, f64::max);
        most_m2 / (2.0 * range_m.max(1e-3) * self.wavelength_m)
    }

    /// Beamwidths in direction cosines along right and up, λ over the virtual extent; infinite without
    /// extent.
    pub fn beams(&self) -> [f64; 2] {
        [0, 1].map(|axis: usize| self.lattices[axis].beamwidth())
    }

    /// Wavelength at the centre of the sampled sweep.
    pub(crate) fn wavelength_m(&self) -> f64 {
        self.wavelength_m
    }

    /// Unit vectors right, up and ahead of the aperture in world axes.
    pub fn axes(&self) -> [DVec3; 3] {
        self.axes
    }

    fn power(&self, snapshots: &[Snapshot], range_m: f64, at: DVec2) -> f64 {
        let steering = self.steering(Direction { right: at.x, up: Some(at.y) }, range_m);
        snapshots.iter().map(|snapshot| self.beam(snapshot, &steering).norm_sqr()).sum()
    }

    /// One parabola step on the logarithm of the beam's power along an axis, at most one step long.
    fn climb(&self, snapshots: &[Snapshot], range_m: f64, at: DVec2, axis: usize, step: f64) -> f64 {
        let along = DVec2::from([[1.0, 0.0], [0.0, 1.0]][axis]) * step;
        let [before, here, after] = [at - along, at, at + along]
            .map(|p| self.power(snapshots, range_m, p).max(f64::MIN_POSITIVE).ln());
        let curvature = before - 2.0 * here + after;
        let offset =
            if curvature < 0.0 { (0.5 * (before - after) / curvature).clamp(-1.0, 1.0) } else { 0.0 };
        (at[axis] + offset * step).clamp(-1.0, 1.0)
    }

    /// Strongest visible cell of the summed angle spectra; the first, row by row, among equal ones.
    fn coarse(&self, snapshots: &[Snapshot], range_m: f64) -> DVec2 {
        let [columns, rows] = [0, 1].map(|axis: usize| self.lattices[axis].visible());
        let mut power = vec![0.0; columns.len() * rows.len()];
        let mut work = AngleFft::default();
        for snapshot in snapshots {
            self.transform_rows(snapshot, range_m, &mut work);
            for (column, power) in columns.iter().zip(power.chunks_exact_mut(rows.len())) {
                let spectrum = self.column(*column, &mut work);
                power.iter_mut().zip(&rows).for_each(|(sum, row)| *sum += spectrum[*row].norm_sqr());
            }
        }
        let mut best = (DVec2::ZERO, -1.0, usize::MAX);
        for (column, power) in columns.iter().zip(power.chunks_exact(rows.len())) {
            let right = self.lattices[0].cosine(*column);
            for (row, power) in rows.iter().zip(power) {
                if *power > best.1 || (*power == best.1 && *row < best.2) {
                    let at = DVec2::new(right, self.lattices[1].cosine(*row));
                    best = if at.length_squared() <= 1.0 { (at, *power, *row) } else { best };
                }
            }
        }
        best.0
    }

    /// Angle spectra along right of all lattice rows that contain elements: `[filled row, column]`.
    fn transform_rows(&self, snapshot: &[Complex64], range_m: f64, work: &mut AngleFft) {
        let columns = self.lattices[0].cells();
        let AngleFft { grid, column, scratch } = work;
        grid.clear();
        grid.resize(self.occupied.rows.len() * columns, Complex64::ZERO);
        column.resize(self.lattices[1].cells(), Complex64::ZERO);
        let scratch_cells = self.transforms.iter().map(|t| t.get_inplace_scratch_len()).max().unwrap_or(0);
        scratch.resize(scratch_cells, Complex64::ZERO);
        let per_square_m2 = 1.0 / (2.0 * range_m.max(1e-3) * self.wavelength_m);
        for (channel, value) in snapshot.iter().enumerate() {
            // Wavefront curvature as for a target ahead; the climb corrects the remainder off boresight.
            let cycles = self.squares_m2[channel] * per_square_m2;
            let turn = turned_back(if cycles < FLAT { 0.0 } else { cycles });
            grid[self.occupied.of_channels[channel] * columns + self.lattices[0].places()[channel]] +=
                value * turn;
        }
        self.transforms[0].process_with_scratch(grid, scratch);
    }

    /// Angle spectrum along up in one column of the transformed rows.
    fn column<'w>(&self, column: usize, work: &'w mut AngleFft) -> &'w [Complex64] {
        let columns = self.lattices[0].cells();
        let AngleFft { grid, column: values, scratch } = work;
        values.fill(Complex64::ZERO);
        for (index, row) in self.occupied.rows.iter().enumerate() {
            values[*row] = grid[index * columns + column];
        }
        if values.len() > 1 {
            self.transforms[1].process_with_scratch(values, scratch);
        }
        values
    }
}

/// Lattice rows along up that contain elements; a sparse array has few.
struct OccupiedRows {
    /// Indices of the rows on the lattice, ascending.
    rows: Vec<usize>,
    /// Index among these rows for each channel.
    of_channels: Vec<usize>,
}

impl OccupiedRows {
    fn of(places: &[usize]) -> Self {
        let mut rows = places.to_vec();
        rows.sort_unstable();
        rows.dedup();
        let of_channels = places.iter().map(|place| rows.partition_point(|row| row < place)).collect();
        Self { rows, of_channels }
    }
}

/// Buffers of angle FFTs.
#[derive(Default)]
struct AngleFft {
    grid: Vec<Complex64>,
    column: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

/// Maximum memory of the direction search of a cell, bytes: the power of every direction, and the spectra of
/// rows, of which an oversampled grid has elements only in a part.
pub fn search_bytes(radar: &Radar) -> u64 {
    let [across, up] = lattices(radar);
    let power = (across.visible().len() * up.visible().len()) * size_of::<f64>();
    let spectra = OccupiedRows::of(up.places()).rows.len() * across.cells() * size_of::<Complex64>();
    (power + spectra) as u64
}

/// Phase factor e^{−j2π·cycles}.
fn turned_back(cycles: f64) -> Complex64 {
    if cycles == 0.0 { Complex64::ONE } else { Complex64::from_polar(1.0, -TAU * cycles.fract()) }
}

/// Curvature in cycles that changes no cell of an FFT: it costs 1e-5 of the beam.
const FLAT: f64 = 1e-3;

/// Path difference |point − element| − range, without cancellation between two lengths.
fn excess_m(point: DVec3, element: DVec3, range_m: f64) -> f64 {
    let distance = (point - element).length();
    let difference = element.length_squared() - 2.0 * point.dot(element);
    if distance + range_m > 0.0 { difference / (distance + range_m) } else { 0.0 }
}
