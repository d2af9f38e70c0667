//! Anybody's IF samples as radar cubes.

use crate::stepwise::opened_scene::OpenedScene;
use crate::stepwise::recorded::Recorded;
use artifact::ErrorBudget;
use artifact::cube::{Cube, CubeFrame, CubeHeader, SampleUnit};
use artifact::radar::Sampling;
use num_complex::Complex32;
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;

/// Makes cubes of samples `[frame, channel, chirp, sample]` of the scene's radar, in the unit that
/// [`unit_of_floats`] finds.
///
/// # Errors
/// Another shape than the radar's, samples that are not finite, complex ones of a radar that samples I alone,
/// and a full scale that is not above 0.
pub fn cubes_of_samples(
    scene: &OpenedScene,
    shape: [usize; 4],
    samples: &[Complex32],
    full_scale: Option<f64>,
) -> Result<Recorded<Cube>, Failure> {
    if full_scale.is_some_and(|steps| !(steps > 0.0 && steps.is_finite())) {
        return Err(Failure::refused("full_scale must be a number of steps above 0"));
    }
    let header = CubeHeader { unit: unit_of_floats(samples, full_scale), ..scene.cube_header() };
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

/// Unit of samples that are no integers: steps of a converter whose full scale is told, steps of one that
/// nobody tells of where all are whole numbers and some is not 0, else √W.
pub fn unit_of_floats<'a>(
    samples: impl IntoIterator<Item = &'a Complex32>,
    full_scale: Option<f64>,
) -> SampleUnit {
    if let Some(steps) = full_scale {
        return SampleUnit::FullScale(steps);
    }
    let is_whole = |x: f32| x.fract() == 0.0;
    let mut is_silent = true;
    let are_whole = samples.into_iter().all(|v| {
        is_silent &= *v == Complex32::ZERO;
        is_whole(v.re) && is_whole(v.im)
    });
    if are_whole && !is_silent { SampleUnit::Steps } else { SampleUnit::RootWatts }
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
    fn whole_numbers_are_steps_of_a_converter_and_what_else_nobody_tells_of_is_root_watts() {
        let of = |parts: &[f32], full_scale| {
            let samples: Vec<Complex32> = parts.iter().map(|x| Complex32::new(*x, 0.0)).collect();
            unit_of_floats(&samples, full_scale)
        };
        assert_eq!(of(&[0.0, -3.0, 1200.0], None), SampleUnit::Steps);
        assert_eq!(of(&[0.0, -3.0, 1200.5], None), SampleUnit::RootWatts);
        assert_eq!(of(&[0.0; 3], None), SampleUnit::RootWatts, "silence is in any unit");
        assert_eq!(of(&[0.25], Some(1.0)), SampleUnit::FullScale(1.0));
    }

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
