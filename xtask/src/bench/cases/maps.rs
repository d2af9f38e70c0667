//! Maps, detectors and angles of one frame of noise compared with other programs, all with the same samples.

use crate::bench::cases::timing::{Sizes, quickest};
use crate::bench::comparison::Comparison;
use crate::bench::programs::{Job, MissingProgram, RivalOutput, RivalProgram, complex};
use crate::study::scenes::{cube_header, scene_of};
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::paths::PathsFrame;
use artifact::rdm::RdmFrame;
use artifact::settings::Detector;
use dsp::angle::VirtualArray;
use dsp::cfar::{Cfar, DETECTED};
use num_complex::{Complex32, Complex64};
use rayon::prelude::*;
use wayside::host::failure::Failure;

/// Guard and training cells on each side, in both directions: others support only squares. One alarm in a
/// hundred cells, so that there is something to compare.
const GUARD: u32 = 2;
const TRAINING: u32 = 6;
const FALSE_ALARM_RATE: f64 = 1e-2;
/// Number of cells whose angle is estimated.
const CELLS: usize = 1000;
/// Range for the near field's curvature, m: so far away that the curvature is negligible.
const RANGE_M: f64 = 1e4;

const MMWCORE: RivalProgram = RivalProgram::Example("dsp", "rivals", "mmwcore");

pub(super) fn all(sizes: Sizes) -> Result<Vec<Comparison>, Failure> {
    let noise = noise()?;
    let mut list = noise.maps(sizes)?;
    list.extend(noise.detectors(sizes)?);
    list.extend(noise.angles(sizes)?);
    Ok(list)
}

/// A frame without echoes, and its map.
struct NoiseFrame {
    header: CubeHeader,
    receiver: dsp::Receiver,
    frame: CubeFrame,
    map: RdmFrame,
}

fn noise() -> Result<NoiseFrame, Failure> {
    let mut header = cube_header(&scene_of("[noise]\nnoise_figure_db = 12.0\n")?);
    (header.dsp.guard_cells, header.dsp.training_cells) = ([GUARD; 2], [TRAINING; 2]);
    header.dsp.false_alarm_rate = FALSE_ALARM_RATE;
    let accuracy = artifact::Accuracy::from_db(-60.0);
    let frame = fmcw_echo::Synthesizer::new(&header, 1, accuracy, vec![])
        .and_then(|synthesizer| synthesizer.frame(&PathsFrame::default(), &|_| ()));
    let frame = frame.map_err(Failure::refused)?;
    let receiver = dsp::Receiver::new(&header).map_err(Failure::refused)?;
    let map = receiver.range_doppler(&frame).map_err(Failure::refused)?;
    Ok(NoiseFrame { header, receiver, frame, map })
}

impl NoiseFrame {
    fn maps(&self, sizes: Sizes) -> Result<Vec<Comparison>, Failure> {
        let (ours, ours_s) =
            quickest(sizes, || self.receiver.range_doppler(&self.frame).map_err(Failure::refused))?;
        let job = Job { name: "range-doppler", input: single(&self.frame.samples) };
        let error = |answer: &RivalOutput| difference(&wide(&ours.values), &complex(&answer.result));
        let programs = [RivalProgram::Python("scipy"), RivalProgram::Python("numpy"), MMWCORE];
        self.compare_with("range-Doppler", ours_s, &job, sizes, &programs, &error)
    }

    fn detectors(&self, sizes: Sizes) -> Result<Vec<Comparison>, Failure> {
        let mut list = self.detector(
            sizes,
            Detector::CaCfar,
            "CA-CFAR",
            "ca-cfar",
            &[RivalProgram::Python("scipy"), MMWCORE],
        )?;
        list.extend(self.detector(
            sizes,
            Detector::OsCfar,
            "OS-CFAR",
            "os-cfar",
            &[RivalProgram::Python("scipy")],
        )?);
        Ok(list)
    }

    /// The rival has the threshold factor of our middle cell; it treats neither edges nor the correlation
    /// that windows make between nearby training cells.
    fn detector(
        &self,
        sizes: Sizes,
        detector: Detector,
        name: &str,
        job: &'static str,
        programs: &[RivalProgram],
    ) -> Result<Vec<Comparison>, Failure> {
        let mut header = self.header.clone();
        header.dsp.detector = detector;
        let cfar = Cfar::new(&header).map_err(Failure::refused)?;
        let power = dsp::power_map(&header, &self.map).map_err(Failure::refused)?.into_raw_vec_and_offset().0;
        let (mask, ours_s) = quickest(sizes, || Ok(cfar.mask(&power, 0.0)))?;
        let [_, chirps, samples] = header.shape();
        let factor = cfar.factor([chirps / 2, samples / 2]);
        let input =
            factor.to_le_bytes().into_iter().chain(power.iter().flat_map(|p| p.to_le_bytes())).collect();
        // For masks, 1 at an alarm: the root of the differing cells over the alarms.
        let error = |answer: &RivalOutput| {
            let alarms = |of: &dyn Fn(usize) -> bool| (0..mask.len()).filter(|cell| of(*cell)).count() as f64;
            let theirs = |cell: usize| answer.result.get(cell).is_some_and(|byte| *byte != 0);
            let differing = alarms(&|cell| (mask[cell] == DETECTED) != theirs(cell));
            (differing / alarms(&|cell| theirs(cell))).sqrt()
        };
        let alarms = mask.iter().filter(|cell| **cell == DETECTED).count();
        let mut rows = self.compare_with(name, ours_s, &Job { name: job, input }, sizes, programs, &error)?;
        rows.iter_mut().for_each(|row| row.work += &format!(", {alarms} alarms"));
        Ok(rows)
    }

    fn angles(&self, sizes: Sizes) -> Result<Vec<Comparison>, Failure> {
        let array = VirtualArray::new(&self.header);
        let columns = self.header.shape()[2];
        let cells = (0..CELLS).into_par_iter().with_min_len(CELLS / 16);
        let snapshot = |i: usize| [array.snapshot(&self.map, [i / columns, i % columns], 0.0)];
        let right = |i: usize| array.fft_direction(&snapshot(i), RANGE_M).right;
        let (ours, ours_s) = quickest(sizes, || Ok(cells.clone().map(right).collect::<Vec<f64>>()))?;
        let job = Job { name: "angles", input: single(&self.map.values) };
        // In cells of noise alone, two beams occasionally have equal power: the result is the share of cells
        // that differ by more than a cell of the transform.
        let error = |answer: &RivalOutput| {
            let apart = |(a, b): (&f64, f64)| {
                let turn = (a - b).rem_euclid(2.0);
                turn.min(2.0 - turn) > 1.0 / self.header.shape()[0] as f64
            };
            (ours.iter().zip(answer.numbers()).filter(|pair| apart(*pair)).count() as f64 / CELLS as f64)
                .sqrt()
        };
        self.compare_with(
            "angle FFT of 1000 cells",
            ours_s,
            &job,
            sizes,
            &[RivalProgram::Python("numpy"), MMWCORE],
            &error,
        )
    }

    fn compare_with(
        &self,
        name: &str,
        ours_s: f64,
        job: &Job,
        sizes: Sizes,
        programs: &[RivalProgram],
        error: &dyn Fn(&RivalOutput) -> f64,
    ) -> Result<Vec<Comparison>, Failure> {
        let shape = self.header.shape();
        let numbers: Vec<String> = shape
            .into_iter()
            .chain([GUARD as usize, TRAINING as usize, CELLS])
            .map(|n| n.to_string())
            .chain([sizes.repeated_s.to_string()])
            .collect();
        let row = |language: &RivalProgram| -> Result<Comparison, Failure> {
            let answer: Result<RivalOutput, MissingProgram> = job.run_with(*language, &numbers)?;
            let error = answer.as_ref().ok().map(error);
            Ok(Comparison {
                name: name.into(),
                ours_s,
                rival: answer.map(|answer| (answer.program, answer.seconds)),
                error,
                work: format!("{} × {} × {}, noise", shape[0], shape[1], shape[2]),
            })
        };
        programs.iter().map(row).collect()
    }
}

fn single(values: &[Complex32]) -> Vec<u8> {
    values.iter().flat_map(|x| [x.re.to_le_bytes(), x.im.to_le_bytes()]).flatten().collect()
}

fn wide(values: &[Complex32]) -> Vec<Complex64> {
    values.iter().map(|z| Complex64::new(z.re.into(), z.im.into())).collect()
}

fn difference(ours: &[Complex64], theirs: &[Complex64]) -> f64 {
    let power = |values: &mut dyn Iterator<Item = Complex64>| values.map(|z| z.norm_sqr()).sum::<f64>();
    (power(&mut ours.iter().zip(theirs).map(|(a, b)| a - b)) / power(&mut theirs.iter().copied())).sqrt()
}
