//! The crate mmwcore: its transforms axis by axis, its square CA-CFAR, its azimuths of candidates; it has no
//! OS-CFAR.

use crate::task::{CANDIDATES, GUARD, Measurement, TRAINING, job, quickest_s};
use artifact::cube::{CubeFrame, CubeHeader};
use mmwcore::{
    AngleAxis, CandidateAzimuthConfig, CandidateAzimuthInput, CandidateCubeAxes, CandidateCubeInput,
    CandidateIndexColumns, CandidateMatrixInput, Cfar2DConfig, ComplexFftSpec, FftWindow, RangeDopplerAxes,
    ReceiverAggregation, detect_cfar_2d_complex, estimate_candidate_azimuths, fft_complex_axis,
};
use num_complex::Complex32;

pub(crate) fn measured(header: &CubeHeader, frame: &CubeFrame) -> Vec<Measurement> {
    let shape = header.shape();
    let of = |what: &str, seconds: f64| Measurement {
        job: job(header, what),
        program: "mmwcore 0.3.0".into(),
        seconds,
    };
    let map = maps(&frame.samples, shape);
    let power: Vec<Complex32> =
        map[..shape[1] * shape[2]].iter().map(|v| Complex32::new(v.norm_sqr(), 0.0)).collect();
    vec![
        of("range-Doppler", quickest_s(|| maps(&frame.samples, shape))),
        of("CA-CFAR", quickest_s(|| cfar(&power, shape))),
        of("angle FFT of 1000 cells", quickest_s(|| azimuths(&map, shape))),
    ]
}

pub(crate) fn maps(samples: &[Complex32], shape: [usize; 3]) -> Vec<Complex32> {
    let along = |n: usize, is_shifted: bool| {
        ComplexFftSpec::new(n, FftWindow::Hann, false, is_shifted, false).unwrap()
    };
    let (ranges, _) = fft_complex_axis(samples, &shape, 2, along(shape[2], false)).unwrap();
    fft_complex_axis(&ranges, &shape, 1, along(shape[1], true)).unwrap().0
}

fn cfar(power: &[Complex32], [_, chirps, samples]: [usize; 3]) -> usize {
    let axes = RangeDopplerAxes { frame: 0, doppler: 1, receiver: 2, range: 3 };
    let config = Cfar2DConfig::new(TRAINING as usize, GUARD as usize, 20.0).unwrap();
    let found =
        detect_cfar_2d_complex(power, &[1, chirps, 1, samples], axes, ReceiverAggregation::Sum, config);
    found.unwrap().magnitudes.len()
}

/// Cells of a power map that the detector finds at a factor over the mean.
pub(crate) fn alarms_of_map(
    power: &[f64],
    [chirps, samples]: [usize; 2],
    factor: f32,
) -> impl Iterator<Item = usize> {
    let power: Vec<Complex32> =
        power.iter().map(|p| Complex32::new((p / power[0].max(1e-300)) as f32, 0.0)).collect();
    let axes = RangeDopplerAxes { frame: 0, doppler: 1, receiver: 2, range: 3 };
    let config = Cfar2DConfig::new(TRAINING as usize, GUARD as usize, factor).unwrap();
    let shape = [1, chirps, 1, samples];
    let found = detect_cfar_2d_complex(&power, &shape, axes, ReceiverAggregation::Sum, config).unwrap();
    let cells: Vec<usize> = found.indices.chunks_exact(3).map(|at| at[1] * samples + at[2]).collect();
    cells.into_iter()
}

pub(crate) fn azimuths(map: &[Complex32], [channels, chirps, samples]: [usize; 3]) -> Vec<f32> {
    let positions: Vec<f32> = (0..channels).flat_map(|i| [0.5 * i as f32, 0.0, 0.0]).collect();
    let candidates: Vec<f32> =
        (0..CANDIDATES).flat_map(|i| [0.0, (i % samples) as f32, (i / samples) as f32]).collect();
    let input = CandidateAzimuthInput {
        cube: CandidateCubeInput {
            data: map,
            shape: &[1, channels, chirps, samples],
            axes: CandidateCubeAxes { frame: 0, antenna: 1, doppler: 2, range: 3 },
        },
        candidates: CandidateMatrixInput { values: &candidates, shape: [CANDIDATES, 3] },
        columns: CandidateIndexColumns { frame: 0, range: 1, doppler: 2 },
        positions_wavelengths: &positions,
        position_count: channels,
    };
    let n_fft = (4 * channels).next_power_of_two();
    let config = CandidateAzimuthConfig {
        n_fft,
        window: FftWindow::None,
        fftshift: true,
        angle_axis: AngleAxis::Azimuth,
    };
    estimate_candidate_azimuths(input, config).unwrap().angles_rad
}
