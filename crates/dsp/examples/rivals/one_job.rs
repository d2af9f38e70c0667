//! One job by mmwcore for `cargo xtask bench`: `rivals JOB FOLDER CHANNELS CHIRPS SAMPLES …` reads
//! `input.raw` there, writes `result.raw` and prints `program|seconds`.

use crate::mmwcore_way::{alarms_of_map, azimuths, maps};
use crate::task::quickest_s;
use num_complex::Complex32;
use std::path::Path;

/// Whether the words were such a job.
pub(crate) fn done(words: &[String]) -> bool {
    let [job, folder, numbers @ ..] = words else { return false };
    let shape = [0, 1, 2].map(|i| numbers[i].parse::<usize>().unwrap());
    let input = std::fs::read(Path::new(folder).join("input.raw")).unwrap();
    let (seconds, result) = match job.as_str() {
        "range-doppler" => range_doppler(&singles(&input), shape),
        "ca-cfar" => averages(&doubles(&input), shape),
        "angles" => angles(&singles(&input), shape),
        _ => return false,
    };
    std::fs::write(Path::new(folder).join("result.raw"), result).unwrap();
    println!("mmwcore 0.3.0|{seconds}");
    true
}

/// Times mmwcore's maps and writes them out; mmwcore's windows are symmetric and not divided by their means:
/// the second is made good here.
fn range_doppler(samples: &[Complex32], shape: [usize; 3]) -> (f64, Vec<u8>) {
    let gain = 0.25 * (shape[1] - 1) as f32 / shape[1] as f32 * (shape[2] - 1) as f32 / shape[2] as f32;
    let seconds = quickest_s(|| maps(samples, shape));
    let values = maps(samples, shape).into_iter().map(|z| z / gain);
    (seconds, values.flat_map(|z| [z.re.to_le_bytes(), z.im.to_le_bytes()].concat()).collect())
}

/// The first number is the factor over the mean.
fn averages(input: &[f64], [_, chirps, samples]: [usize; 3]) -> (f64, Vec<u8>) {
    let (factor, power) = (input[0] as f32, &input[1..]);
    let find = || alarms_of_map(power, [chirps, samples], factor).collect::<Vec<usize>>();
    let mut mask = vec![0; power.len()];
    find().into_iter().for_each(|cell| mask[cell] = 1);
    (quickest_s(find), mask)
}

/// Times mmwcore's azimuths and writes them out as sines, with the sign changed: its phases grow the other
/// way.
fn angles(map: &[Complex32], shape: [usize; 3]) -> (f64, Vec<u8>) {
    let found = azimuths(map, shape);
    (
        quickest_s(|| azimuths(map, shape)),
        found.into_iter().flat_map(|a| (-f64::from(a).sin()).to_le_bytes()).collect(),
    )
}

fn singles(bytes: &[u8]) -> Vec<Complex32> {
    let single = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().unwrap());
    bytes.chunks_exact(8).map(|pair| Complex32::new(single(&pair[..4]), single(&pair[4..]))).collect()
}

fn doubles(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect()
}
