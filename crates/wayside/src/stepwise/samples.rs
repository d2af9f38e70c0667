//! Anybody's IF samples as radar cubes.

use crate::stepwise::opened_scene::OpenedScene;
use crate::stepwise::recorded::Recorded;
use artifact::ErrorBudget;
use artifact::cube::{Cube, CubeFrame};
use artifact::radar::Sampling;
use num_complex::Complex32;
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;

/// Makes cubes of samples `[frame, channel, chirp, sample]`, √W, of the scene's radar.
///
/// # Errors
/// Another shape than the radar's, samples that are not finite, and complex ones of a radar that samples I
/// alone.
pub fn cubes_of_samples(
    scene: &OpenedScene,
    shape: [usize; 4],
    samples: &[Complex32],
) -> Result<Recorded<Cube>, Failure> {
    let header = scene.cube_header();
    let of_radar = header.shape();
    if shape[1..] != of_radar {
        let found = &shape[1..];
        let text = format!("[channel, chirp, sample] is {found:?}, the scene's radar has {of_radar:?}");
        return Err(Failure::refused(text));
    }
    let sampling = header.radar.waveform.sampling;
    let length = of_radar.iter().product::<usize>().max(1);
    let frame = |(index, samples): (usize, &[Complex32])| {
        sound(index, samples, of_radar, sampling)?;
        let (index, samples) = (index as u32, samples.to_vec());
        let time_s = scene.header().frame_time_s(index);
        Ok(CubeFrame { index, time_s, samples, error: ErrorBudget::default() })
    };
    let frames = samples.chunks(length).enumerate().map(frame).collect::<Result<_, Failure>>()?;
    Ok(Recorded { from: scene.provenance(Stage::FmcwEcho), header, frames })
}

/// Refuses a frame's samples that are not finite, and those with an imaginary part where the radar's have
/// none.
///
/// # Errors
/// The first one, with its place.
pub fn sound(
    frame: usize,
    samples: &[Complex32],
    shape: [usize; 3],
    sampling: Sampling,
) -> Result<(), Failure> {
    let is_finite = |v: &Complex32| v.re.is_finite() && v.im.is_finite();
    refuse(frame, samples, shape, |v| !is_finite(v), "samples must be finite")?;
    match sampling {
        Sampling::Complex => Ok(()),
        Sampling::Real => refuse(frame, samples, shape, |v| v.im != 0.0, IMAGINARY),
    }
}

const IMAGINARY: &str = "the scene's radar has sampling = \"real\": samples without an imaginary part";

fn refuse(
    frame: usize,
    samples: &[Complex32],
    [_, chirps, length]: [usize; 3],
    is_wrong: impl FnMut(&Complex32) -> bool,
    rule: &str,
) -> Result<(), Failure> {
    let Some(at) = samples.iter().position(is_wrong) else { return Ok(()) };
    let place = (frame, at / (chirps * length), at / length % chirps, at % length);
    let value = samples[at];
    Err(Failure::refused(format!("{value} at [frame, channel, chirp, sample] {place:?}: {rule}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_that_is_no_number_is_refused_with_its_place() {
        let mut samples = vec![Complex32::new(1.0, 0.0); 24];
        let sound = |samples: &[Complex32], sampling| sound(2, samples, [2, 3, 4], sampling);
        assert!(sound(&samples, Sampling::Real).is_ok());
        samples[12 + 4 + 3].im = f32::NAN;
        let told = sound(&samples, Sampling::Complex).unwrap_err().to_string();
        assert!(told.contains("(2, 1, 1, 3): samples must be finite"), "{told}");
        samples[12 + 4 + 3].im = 0.5;
        assert!(sound(&samples, Sampling::Complex).is_ok());
        let told = sound(&samples, Sampling::Real).unwrap_err().to_string();
        assert!(told.contains("(2, 1, 1, 3): the scene's radar has sampling = \"real\""), "{told}");
    }
}
