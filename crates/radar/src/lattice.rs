//! Regular grids to which an array's virtual elements are snapped, one along each axis of the aperture: an
//! FFT over them searches all directions of arrival.

use crate::aperture::axes;
use artifact::radar::Radar;
use glam::DVec3;

/// Maximum number of directions searched for an echo, the product of the grid cells along right and up: each
/// echo takes this many steps, and 12 bytes per step.
pub const DIRECTIONS_LIMIT: u64 = 1 << 22;

/// Cells of the angle FFT per null-to-null half lobe, so that the climb starts within an eighth of the lobe's
/// width.
const OVERSAMPLING: usize = 4;
/// Spacing for positions that share no grid: a phase error of at most π/8 at the edge of the visible region,
/// in the coarse search only.
const FINE_SPACING: f64 = 0.125;
/// Maximum number of grid places; a wider array is snapped to this many.
const MOST_PLACES: f64 = 4096.0;
/// Fraction of a wavelength within which positions coincide.
const SAME: f64 = 1e-4;

/// Element positions along one axis as indices on a regular grid, wavelengths.
pub struct Lattice {
    spacing: f64,
    places: Vec<usize>,
    extent: usize,
}

/// Lattices along right and up of a radar's virtual elements, `tx · receivers + rx`.
pub fn lattices(radar: &Radar) -> [Lattice; 2] {
    let [right, _, up] = axes(radar);
    let centre = DVec3::from(radar.position_m);
    let [tx, rx] = [&radar.array.tx_m, &radar.array.rx_m]
        .map(|ends| ends.iter().map(|place| DVec3::from(*place) - centre).collect::<Vec<DVec3>>());
    let wavelength_m = radar.waveform.wavelength_m();
    [right, up].map(|axis| {
        let place = |t: &DVec3, r: &DVec3| (*t + *r).dot(axis) / wavelength_m;
        let places = tx.iter().flat_map(|t| rx.iter().map(move |r| place(t, r)));
        Lattice::new(&places.collect::<Vec<f64>>())
    })
}

/// Whether the array resolves azimuth: its virtual elements have more than one position along the row.
pub fn resolves_azimuth(radar: &Radar) -> bool {
    lattices(radar)[0].has_extent()
}

/// Refuses an array with more than [`DIRECTIONS_LIMIT`] directions.
///
/// # Errors
/// The number of directions along right and up.
pub fn check_directions(radar: &Radar) -> Result<(), TooManyDirections> {
    let [right, up] = lattices(radar).map(|lattice| lattice.cells() as u64);
    if right * up > DIRECTIONS_LIMIT { Err(TooManyDirections { right, up }) } else { Ok(()) }
}

/// An array so wide in wavelengths along both axes that it would resolve too many directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the array spans so many wavelengths that echoes would be looked for in {right} × {up} directions \
     (right × up); the limit is {DIRECTIONS_LIMIT}"
)]
pub struct TooManyDirections {
    /// Number of grid cells along right.
    pub right: u64,
    /// Number of grid cells along up.
    pub up: u64,
}

impl Lattice {
    fn new(positions: &[f64]) -> Self {
        let low = positions.iter().copied().fold(f64::INFINITY, f64::min);
        let high = positions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let spacing = regular_spacing(positions, low).unwrap_or(FINE_SPACING).max((high - low) / MOST_PLACES);
        let places: Vec<usize> = positions.iter().map(|p| ((p - low) / spacing).round() as usize).collect();
        let extent = places.iter().copied().max().unwrap_or(0);
        Self { spacing, places, extent }
    }

    /// Grid index of each channel.
    pub fn places(&self) -> &[usize] {
        &self.places
    }

    /// Whether there is more than one grid place.
    pub fn has_extent(&self) -> bool {
        self.extent > 0
    }

    /// Length of the FFT along this axis.
    pub fn cells(&self) -> usize {
        if self.has_extent() { (OVERSAMPLING * (self.extent + 1)).next_power_of_two() } else { 1 }
    }

    /// FFT cells within the visible region: direction cosines up to 1.
    pub fn visible(&self) -> Vec<usize> {
        (0..self.cells()).filter(|cell| self.cosine(*cell).abs() <= 1.0).collect()
    }

    /// Direction cosine of an FFT cell.
    pub fn cosine(&self, cell: usize) -> f64 {
        let signed = if 2 * cell >= self.cells() && self.has_extent() {
            cell as f64 - self.cells() as f64
        } else {
            cell as f64
        };
        signed * self.step()
    }

    /// Step in direction cosine between FFT cells.
    pub fn step(&self) -> f64 {
        1.0 / (self.cells() as f64 * self.spacing)
    }

    /// Beamwidth in direction cosines, λ over the extent; infinite without extent.
    pub fn beamwidth(&self) -> f64 {
        if self.has_extent() { 1.0 / (self.spacing * (self.extent + 1) as f64) } else { f64::INFINITY }
    }
}

/// Smallest gap between positions, if all are multiples of it and it is no smaller than the fine grid.
fn regular_spacing(positions: &[f64], low: f64) -> Option<f64> {
    let mut sorted = positions.to_vec();
    sorted.sort_by(f64::total_cmp);
    let gap = sorted.windows(2).map(|w| w[1] - w[0]).filter(|gap| *gap > SAME).fold(f64::INFINITY, f64::min);
    let regular = |p: &f64| {
        let steps = (p - low) / gap;
        (steps - steps.round()).abs() * gap < SAME
    };
    (gap.is_finite() && gap >= FINE_SPACING && positions.iter().all(regular)).then_some(gap)
}
