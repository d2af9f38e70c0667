//! The echo: the recurrence against the formulas, the sum by transforms against the direct sum and another
//! program's transforms.

use crate::bench::cases::timing::{FULL, Sizes, timed};
use crate::bench::comparison::Comparison;
use crate::bench::programs::{Job, RivalProgram, complex};
use crate::study::scenes::scene_of;
use artifact::paths::{Amplitude, Path};
use artifact::{Accuracy, Radar};
use fmcw_echo::direct_sum::DirectSum;
use fmcw_echo::fast_sum;
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;
use wayside::host::failure::Failure;

const ACCURACY_DB: f64 = -60.0;

pub(super) fn all(sizes: Sizes) -> Result<Vec<Comparison>, Failure> {
    let alone = scene_of("[radar.array]\npreset = \"1x1\"\n")?.radar;
    let radar = scene_of("")?.radar;
    let paths: Vec<Path> = (0..sizes.paths).map(point).collect();
    let centre_hz = radar.waveform.centre_frequency_hz();
    let (cube, ours_s) =
        timed(|| Ok(fast_sum::cube(&radar, centre_hz, &paths, Accuracy::from_db(ACCURACY_DB))))?;
    let made = SynthesizedCube { radar: &radar, paths: &paths, cube: &cube, ours_s };
    Ok(vec![
        recurrence(&alone, if sizes == FULL { 20_000 } else { 500 })?,
        made.against_direct_sum()?,
        made.against_finufft()?,
    ])
}

/// One chirp of points spread in front of the radar.
fn recurrence(radar: &Radar, count: usize) -> Result<Comparison, Failure> {
    let paths: Vec<_> = (0..count).map(point).collect();
    let centre_hz = radar.waveform.centre_frequency_hz();
    let sum = DirectSum::new(radar, centre_hz, &paths);
    let (ours, ours_s) = timed(|| Ok(sum.row(0, 0)))?;
    let samples = radar.waveform.samples as usize;
    let slow = |n| fmcw_echo::reference::cube_sample(radar, centre_hz, &paths, [0, 0, n], None);
    let (rival, rival_s) = timed(|| Ok((0..samples).map(slow).collect::<Vec<Complex64>>()))?;
    let error = difference(&ours, &rival);
    Ok(Comparison {
        name: "echo, quadratic recurrence".into(),
        ours_s,
        rival: Ok(("the same sum from the formulas".into(), rival_s)),
        error: Some(error),
        work: format!("{count} paths, one chirp of {samples} samples, one channel, one thread"),
    })
}

/// ‖ours − theirs‖ / ‖theirs‖.
fn difference(ours: &[Complex64], theirs: &[Complex64]) -> f64 {
    let power = |values: &mut dyn Iterator<Item = Complex64>| values.map(|z| z.norm_sqr()).sum::<f64>();
    (power(&mut ours.iter().zip(theirs).map(|(a, b)| a - b)) / power(&mut theirs.iter().copied())).sqrt()
}

/// The cube by transforms.
struct SynthesizedCube<'a> {
    radar: &'a Radar,
    paths: &'a [Path],
    cube: &'a [Complex64],
    ours_s: f64,
}

impl SynthesizedCube<'_> {
    fn work(&self) -> String {
        let [chirps, samples] = [self.radar.waveform.chirps, self.radar.waveform.samples];
        let channels = self.radar.virtual_channels();
        format!("{} paths, {channels} × {chirps} × {samples}, {ACCURACY_DB} dB asked", self.paths.len())
    }

    fn against_direct_sum(&self) -> Result<Comparison, Failure> {
        let (radar, chirps) = (self.radar, self.radar.waveform.chirps as usize);
        let sum = DirectSum::new(radar, radar.waveform.centre_frequency_hz(), self.paths);
        let rows = (0..radar.virtual_channels() * chirps).into_par_iter();
        let (theirs, rival_s) = timed(|| {
            Ok(rows.flat_map_iter(|row| sum.row(row / chirps, row % chirps)).collect::<Vec<Complex64>>())
        })?;
        Ok(Comparison {
            name: "echo, by transforms".into(),
            ours_s: self.ours_s,
            rival: Ok(("the direct sum, recurrence".into(), rival_s)),
            error: Some(difference(self.cube, &theirs)),
            work: self.work(),
        })
    }

    /// The rival sums one tone per path, with its value at the frame's middle; motion over the frame is left
    /// out, which the error shows.
    fn against_finufft(&self) -> Result<Comparison, Failure> {
        let [chirps, samples] = [self.radar.waveform.chirps, self.radar.waveform.samples];
        let job = Job { name: "tones", input: self.tones() };
        let numbers = [self.paths.len(), self.radar.virtual_channels(), chirps as usize, samples as usize];
        let answer = job.run_with(RivalProgram::Python("finufft"), &numbers.map(|n| n.to_string()))?;
        let error = answer.as_ref().ok().map(|answer| difference(self.cube, &complex(&answer.result)));
        Ok(Comparison {
            name: "echo, by transforms, beside tones that stand still".into(),
            ours_s: self.ours_s,
            rival: answer.map(|answer| {
                (format!("{}, type 1, single precision, 1e-3", answer.program), answer.seconds)
            }),
            error,
            work: self.work(),
        })
    }

    /// Phase per chirp and per sample of each path on the first channel, rad in double precision; then
    /// strengths at the frame's middle, by channel and path, in single precision.
    fn tones(&self) -> Vec<u8> {
        let [m, n] = [self.radar.waveform.chirps as usize / 2, self.radar.waveform.samples as usize / 2];
        let turn =
            |path: &Path, to: [usize; 3]| (self.value(path, to) * self.value(path, [0, m, n]).conj()).arg();
        let turns: Vec<[f64; 2]> = self
            .paths
            .par_iter()
            .map(|path| [turn(path, [0, m + 1, n]), turn(path, [0, m, n + 1])])
            .collect();
        let channels = (0..self.radar.virtual_channels()).into_par_iter();
        let strengths: Vec<Complex64> = channels
            .flat_map_iter(|channel| self.paths.iter().map(move |path| self.value(path, [channel, m, n])))
            .collect();
        let turns =
            (0..2).flat_map(|axis| turns.iter().map(move |turn| turn[axis].rem_euclid(TAU).to_le_bytes()));
        let mut bytes: Vec<u8> = turns.flatten().collect();
        let single =
            strengths.iter().flat_map(|z| [(z.re as f32).to_le_bytes(), (z.im as f32).to_le_bytes()]);
        bytes.extend(single.flatten());
        bytes
    }

    fn value(&self, path: &Path, at: [usize; 3]) -> Complex64 {
        let centre_hz = self.radar.waveform.centre_frequency_hz();
        fmcw_echo::reference::cube_sample(self.radar, centre_hz, std::slice::from_ref(path), at, None)
    }
}

fn point(number: usize) -> Path {
    let spread = |step: f64| (number as f64 * step).fract();
    let place = [10.0 * spread(0.618_034), 25.0 + 30.0 * spread(0.414_214), 2.0 * spread(0.732_051)];
    let mut amplitude_m = Amplitude::default();
    amplitude_m[0][0] = Complex64::from_polar(0.1, 6.0 * spread(0.236_068));
    Path::of_point(place, [0.0, -10.0, 0.0], amplitude_m)
}
