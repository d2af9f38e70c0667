//! Anybody's IF samples as radar cubes.

use crate::stepwise::opened_scene::OpenedScene;
use crate::stepwise::recorded::Recorded;
use artifact::ErrorBudget;
use artifact::cube::{Cube, CubeFrame};
use num_complex::Complex32;
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;

/// Makes cubes of samples `[frame, channel, chirp, sample]`, √W, of the scene's radar.
///
/// # Errors
/// Another shape than the radar's, and samples that are not finite.
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
    let length = of_radar.iter().product::<usize>().max(1);
    let frame = |(index, samples): (usize, &[Complex32])| {
        finite(index, samples, of_radar)?;
        let (index, samples) = (index as u32, samples.to_vec());
        let time_s = scene.header().frame_time_s(index);
        Ok(CubeFrame { index, time_s, samples, error: ErrorBudget::default() })
    };
    let frames = samples.chunks(length).enumerate().map(frame).collect::<Result<_, Failure>>()?;
    Ok(Recorded { from: scene.provenance(Stage::FmcwEcho), header, frames })
}

/// Refuses a frame's samples that are not finite.
///
/// # Errors
/// The first one that is not, with its place.
pub fn finite(frame: usize, samples: &[Complex32], [_, chirps, length]: [usize; 3]) -> Result<(), Failure> {
    let Some(at) = samples.iter().position(|v| !(v.re.is_finite() && v.im.is_finite())) else {
        return Ok(());
    };
    let place = (frame, at / (chirps * length), at / length % chirps, at % length);
    let value = samples[at];
    Err(Failure::refused(format!(
        "{value} at [frame, channel, chirp, sample] {place:?}: samples must be finite"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_that_is_no_number_is_refused_with_its_place() {
        let mut samples = vec![Complex32::new(1.0, 0.0); 24];
        assert!(finite(2, &samples, [2, 3, 4]).is_ok());
        samples[12 + 4 + 3].im = f32::NAN;
        let told = finite(2, &samples, [2, 3, 4]).unwrap_err().to_string();
        assert!(told.contains("(2, 1, 1, 3): samples must be finite"), "{told}");
    }
}
