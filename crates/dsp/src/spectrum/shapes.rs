//! Validation of the shapes and values of a header, a cube's samples and a map.

use crate::error::DspError;
use crate::numerics::finite::first_not_finite;
use artifact::cube::{CUBE_LIMIT, CubeHeader};
use artifact::radar::Sampling;
use artifact::rdm::{self, RdmFrame};
use num_complex::Complex32;
use radar::lattice::check_directions;

/// Sizes of the cubes and maps of a header, checked to have cells and axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shapes {
    /// Shape `[channel, chirp, sample]`.
    pub(crate) cube: [usize; 3],
    /// Shape `[channel, doppler, range]`.
    pub(crate) map: [usize; 3],
    sampling: Sampling,
}

impl Shapes {
    /// Shapes of the cubes and maps of a radar that can make a map.
    ///
    /// # Errors
    /// Missing elements, non-finite values, or a calibration for another array.
    pub(crate) fn of(header: &CubeHeader) -> Result<Self, DspError> {
        check_counts(header)?;
        check_quantities(header)?;
        check_calibration(header)?;
        let (cube, map) = (header.shape(), rdm::shape(header));
        let product =
            |shape: [usize; 3]| shape.iter().try_fold(1_u64, |product, n| product.checked_mul(*n as u64));
        product(cube).filter(|values| *values <= CUBE_LIMIT).and(product(map)).ok_or(DspError::TooLarge)?;
        check_directions(&header.radar).map_err(DspError::Directions)?;
        Ok(Self { cube, map, sampling: header.radar.waveform.sampling })
    }

    /// Number of cells of one channel of a map.
    pub(crate) fn cells(&self) -> usize {
        self.map[1] * self.map[2]
    }

    /// Checks that samples match the radar's number and sampling, and are finite.
    pub(crate) fn check_samples(&self, samples: &[Complex32]) -> Result<(), DspError> {
        let [channels, chirps, length] = self.cube;
        let expected = channels * chirps * length;
        if samples.len() != expected {
            return Err(DspError::SampleCount { expected, found: samples.len() });
        }
        let place = |at: usize| [at / (chirps * length), at / length % chirps, at % length];
        if self.sampling == Sampling::Real
            && let Some(at) = samples.iter().position(|sample| sample.im != 0.0)
        {
            let [channel, chirp, sample] = place(at);
            return Err(DspError::NotReal { channel, chirp, sample });
        }
        first_not_finite(samples).map(place).map_or(Ok(()), |[channel, chirp, sample]| {
            Err(DspError::SampleNotFinite { channel, chirp, sample })
        })
    }

    /// Checks that a map's arrays have the radar's lengths and finite values.
    pub(crate) fn check_map(&self, map: &RdmFrame) -> Result<(), DspError> {
        let cells = self.cells();
        for (what, expected, found) in
            [("values", self.map[0] * cells, map.values.len()), ("mask cells", cells, map.mask.len())]
        {
            if expected != found {
                return Err(DspError::MapSize { what, expected, found });
            }
        }
        self.check_values(map.index, &map.values)
    }

    /// Checks that the values of a frame's map are finite.
    pub(crate) fn check_values(&self, frame: u32, values: &[Complex32]) -> Result<(), DspError> {
        let Some(at) = first_not_finite(values) else { return Ok(()) };
        let [_, rows, columns] = self.map;
        let [channel, doppler, range] = [at / (rows * columns), at / columns % rows, at % columns];
        Err(DspError::ValueNotFinite { frame, channel, doppler, range })
    }
}

fn check_counts(header: &CubeHeader) -> Result<(), DspError> {
    let (array, waveform) = (&header.radar.array, &header.radar.waveform);
    let counts = [
        ("transmitters", array.tx_m.len()),
        ("receivers", array.rx_m.len()),
        ("chirps", waveform.chirps as usize),
        ("samples", waveform.samples as usize),
    ];
    match counts.into_iter().find(|(_, count)| *count == 0) {
        None => Ok(()),
        Some((what, _)) => Err(DspError::Missing { what }),
    }
}

/// Quantity that may be negative: chirps fall as well as rise.
const SIGNED: &str = "slope_hz_per_s";

fn check_quantities(header: &CubeHeader) -> Result<(), DspError> {
    let radar = &header.radar;
    let squares = |places: &[[f64; 3]]| 1.0 + places.iter().flatten().map(|x| x * x).sum::<f64>();
    let quantities = [
        (SIGNED, radar.waveform.slope_hz_per_s),
        ("sample_rate_hz", radar.waveform.sample_rate_hz),
        ("chirp_interval_s", radar.waveform.chirp_interval_s),
        ("wavelength_m", radar.waveform.wavelength_m()),
        ("range_resolution_m", radar.waveform.range_resolution_m()),
        ("1 + boresight_az_rad²", 1.0 + radar.boresight_az_rad.powi(2)),
        ("1 + boresight_el_rad²", 1.0 + radar.boresight_el_rad.powi(2)),
        ("1 + |position_m|²", squares(&[radar.position_m])),
        ("1 + Σ|tx_m|²", squares(&radar.array.tx_m)),
        ("1 + Σ|rx_m|²", squares(&radar.array.rx_m)),
    ];
    let is_sound =
        |quantity, value: f64| value.is_finite() && (value > 0.0 || quantity == SIGNED && value < 0.0);
    match quantities.into_iter().find(|(quantity, value)| !is_sound(*quantity, *value)) {
        None => Ok(()),
        Some((quantity, value)) => Err(DspError::Radar { quantity, value }),
    }
}

fn check_calibration(header: &CubeHeader) -> Result<(), DspError> {
    let (calibration, expected) = (&header.dsp.calibration, header.radar.virtual_channels());
    let found = calibration.iter().filter(|factor| factor.is_finite()).count();
    if calibration.is_empty() || (found, calibration.len()) == (expected, expected) {
        return Ok(());
    }
    Err(DspError::Calibration { expected, found })
}
