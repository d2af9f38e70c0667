//! IF samples of other sources as radar cubes.

use crate::stepwise::complete_artifact::CompleteArtifact;
use crate::stepwise::opened_scene::OpenedScene;
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
/// A shape other than the radar's, or no frame; samples that are not [`sound`]; samples that
/// [`unit_of_floats`] or [`check_parts`] refuses; a full scale that is not above 0.
pub fn cubes_of_samples(
    scene: &OpenedScene,
    shape: [usize; 4],
    samples: &[Complex32],
    full_scale: Option<f64>,
) -> Result<CompleteArtifact<Cube>, Failure> {
    if full_scale.is_some_and(|steps| !(steps > 0.0 && steps.is_finite())) {
        return Err(Failure::refused("full_scale must be a number of steps above 0"));
    }
    let header = CubeHeader { unit: unit_of_floats(samples, full_scale)?, ..scene.cube_header() };
    let of_radar = header.shape();
    if shape[1..] != of_radar {
        let found = &shape[1..];
        let text = format!("[channel, chirp, sample] is {found:?}, the scene's radar has {of_radar:?}");
        return Err(Failure::refused(text));
    }
    if samples.is_empty() {
        return Err(Failure::refused("samples: there is no frame, they hold no values"));
    }
    check_parts(samples, header.radar.waveform.sampling)?;
    let length = of_radar.iter().product::<usize>().max(1);
    let frame = |(index, samples): (usize, &[Complex32])| {
        sound(index, samples, &header)?;
        let (index, samples) = (index as u32, samples.to_vec());
        let time_s = scene.header().frame_time_s(index);
        Ok(CubeFrame { index, time_s, samples, error: ErrorBudget::default() })
    };
    let frames = samples.chunks(length).enumerate().map(frame).collect::<Result<_, Failure>>()?;
    Ok(CompleteArtifact { from: scene.provenance(Stage::FmcwEcho), header, frames })
}

/// Unit of non-integer samples: steps of a converter if its full scale is given; steps of an unknown
/// converter if all are whole numbers and some is not 0; otherwise √W.
///
/// # Errors
/// Whole numbers without a given full scale that are never negative and too large for signed 16-bit integers:
/// words of a file misread as unsigned.
pub fn unit_of_floats<'a>(
    samples: impl IntoIterator<Item = &'a Complex32>,
    full_scale: Option<f64>,
) -> Result<SampleUnit, Failure> {
    if let Some(steps) = full_scale {
        return Ok(SampleUnit::FullScale(steps));
    }
    let [mut least, mut most] = [0.0_f32; 2];
    let are_whole = samples.into_iter().flat_map(|v| [v.re, v.im]).all(|part| {
        (least, most) = (least.min(part), most.max(part));
        part.fract() == 0.0
    });
    if !are_whole || (least, most) == (0.0, 0.0) {
        return Ok(SampleUnit::RootWatts);
    }
    if least >= 0.0 && most > f32::from(i16::MAX) {
        return Err(Failure::refused(format!(
            "samples are whole numbers from 0 to {most}: are these words without sign? cast them to int16, or \
             tell the full scale"
        )));
    }
    Ok(SampleUnit::Steps)
}

/// Refuses real samples for a radar that samples I and Q: each echo would show twice, once with its velocity
/// and once, mirrored, with another.
///
/// # Errors
/// Every imaginary part is 0, and some real part is not.
pub fn check_parts<'a>(
    samples: impl IntoIterator<Item = &'a Complex32>,
    sampling: Sampling,
) -> Result<(), Failure> {
    let mut is_silent = true;
    let are_real = samples.into_iter().all(|v| {
        is_silent &= v.re == 0.0;
        v.im == 0.0
    });
    match sampling {
        Sampling::Complex if are_real && !is_silent => Err(Failure::refused(REAL)),
        Sampling::Complex | Sampling::Real => Ok(()),
    }
}

/// Refuses samples of a frame that are not finite, have an imaginary part although the radar's are real, or
/// exceed the full scale of their converter.
///
/// # Errors
/// The first such sample, with its place.
pub fn sound(frame: usize, samples: &[Complex32], header: &CubeHeader) -> Result<(), Failure> {
    let shape = header.shape();
    let is_finite = |v: &Complex32| v.re.is_finite() && v.im.is_finite();
    refuse(frame, samples, shape, |v| !is_finite(v), "samples must be finite")?;
    if header.radar.waveform.sampling == Sampling::Real {
        refuse(frame, samples, shape, |v| v.im != 0.0, IMAGINARY)?;
    }
    let SampleUnit::FullScale(steps) = header.unit else { return Ok(()) };
    // Samples rounded to 16-bit integers and converted to steps of another converter err by half a step.
    let most = steps * (1.0 + 1.0 / 32768.0);
    let is_beyond = |v: &Complex32| f64::from(v.re.abs().max(v.im.abs())) > most;
    let rule = format!("a part is beyond the full scale of {steps}; words without sign are cast to int16");
    refuse(frame, samples, shape, is_beyond, &rule)
}

const IMAGINARY: &str = "the scene's radar has sampling = \"real\": samples without an imaginary part";
const REAL: &str = "every imaginary part is 0, which would show each echo twice: real samples are those of a \
                    scene with sampling = \"real\" in [radar.receiver]";

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
    use artifact::settings::Noise;

    fn of_parts(parts: &[f32]) -> Vec<Complex32> {
        parts.iter().map(|x| Complex32::new(*x, 0.0)).collect()
    }

    /// Header of two channels, three chirps, eight samples.
    fn header(sampling: Sampling, unit: SampleUnit) -> CubeHeader {
        let elements = [radar::aperture::row(1, 1.0), radar::aperture::row(2, 1.0)];
        let mut radar = radar::paper::radar([0.0; 3], radar::paper::waveform(8, 3), elements);
        radar.waveform.sampling = sampling;
        CubeHeader { radar, noise: Noise::Absent, dsp: radar::paper::processing(), unit }
    }

    #[test]
    fn whole_numbers_are_steps_of_a_converter_and_what_else_nobody_tells_of_is_root_watts() {
        let of = |parts: &[f32], full_scale| unit_of_floats(&of_parts(parts), full_scale).unwrap();
        assert_eq!(of(&[0.0, -3.0, 1200.0], None), SampleUnit::Steps);
        assert_eq!(of(&[0.0, -3.0, 1200.5], None), SampleUnit::RootWatts);
        assert_eq!(of(&[0.0; 3], None), SampleUnit::RootWatts, "silence is in any unit");
        assert_eq!(of(&[0.25], Some(1.0)), SampleUnit::FullScale(1.0));
    }

    #[test]
    fn words_without_sign_are_refused_where_nobody_tells_their_full_scale() {
        let of = |parts: &[f32], full_scale| unit_of_floats(&of_parts(parts), full_scale);
        let told = of(&[3.0, 65533.0, 0.0], None).unwrap_err().to_string();
        assert!(told.contains("from 0 to 65533: are these words without sign? cast them to int16"), "{told}");
        assert_eq!(of(&[3.0, 32767.0, 0.0], None).unwrap(), SampleUnit::Steps);
        assert_eq!(of(&[-3.0, 65533.0, 0.0], None).unwrap(), SampleUnit::Steps, "a sign is there");
        assert_eq!(of(&[3.0, 65533.5, 0.0], None).unwrap(), SampleUnit::RootWatts);
        assert_eq!(of(&[65533.0], Some(65536.0)).unwrap(), SampleUnit::FullScale(65536.0));
    }

    #[test]
    fn real_samples_of_a_radar_that_samples_both_parts_are_refused_by_the_key_that_tells_of_them() {
        let mut samples = of_parts(&[1.0, -2.0, 0.0]);
        let told = check_parts(&samples, Sampling::Complex).unwrap_err().to_string();
        assert!(told.contains("sampling = \"real\" in [radar.receiver]"), "{told}");
        assert!(check_parts(&samples, Sampling::Real).is_ok());
        assert!(check_parts(&of_parts(&[0.0; 3]), Sampling::Complex).is_ok(), "silence");
        samples[2].im = 1e-9;
        assert!(check_parts(&samples, Sampling::Complex).is_ok());
    }

    #[test]
    fn a_sample_that_is_no_number_is_refused_with_its_place() {
        let mut samples = vec![Complex32::new(1.0, 0.0); 48];
        let of = |samples: &[Complex32], sampling| sound(2, samples, &header(sampling, SampleUnit::Steps));
        assert!(of(&samples, Sampling::Real).is_ok());
        samples[24 + 8 + 3].im = f32::NAN;
        let told = of(&samples, Sampling::Complex).unwrap_err().to_string();
        assert!(told.contains("(2, 1, 1, 3): samples must be finite"), "{told}");
        samples[24 + 8 + 3].im = 0.5;
        assert!(of(&samples, Sampling::Complex).is_ok());
        let told = of(&samples, Sampling::Real).unwrap_err().to_string();
        assert!(told.contains("(2, 1, 1, 3): the scene's radar has sampling = \"real\""), "{told}");
    }

    #[test]
    fn a_sample_beyond_the_full_scale_is_refused_with_its_place_and_value() {
        let mut samples = vec![Complex32::new(-32768.0, 0.0); 48];
        let of = |samples: &[Complex32], unit| sound(0, samples, &header(Sampling::Complex, unit));
        let full_scale = SampleUnit::FullScale(32768.0);
        assert!(of(&samples, full_scale).is_ok(), "the least integer of 16 bits");
        samples[24 + 5].im = 65000.0;
        let told = of(&samples, full_scale).unwrap_err().to_string();
        let expected = "-32768+65000i at [frame, channel, chirp, sample] (0, 1, 0, 5): a part is beyond the full \
                        scale of 32768; words without sign are cast to int16";
        assert_eq!(told, expected);
        assert!(of(&samples, SampleUnit::Steps).is_ok(), "nobody tells a full scale");
    }
}
