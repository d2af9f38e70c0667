//! `calibrate`: errors of a radar's channels, measured with a reflector at a known place.

use crate::program::cli::CalibrateArguments;
use crate::program::terminal;
use artifact::cube::Cube;
use artifact::units::db_from_amplitude;
use artifact::{Radar, Reader};
use dsp::{Receiver, mean_errors};
use num_complex::Complex64;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use std::f64::consts::PI;

pub(crate) fn run(arguments: &CalibrateArguments) -> Result<(), Failure> {
    let reader = Reader::<Cube>::open(&arguments.cube)?;
    files::claim(std::slice::from_ref(&arguments.out))?;
    let header = reader.header().clone();
    let refused = |error| Failure::Refused(format!("{}: {error}", arguments.cube.display()));
    let receiver = Receiver::new(&header).map_err(refused)?;
    let mut frames = Vec::new();
    for cube in progress::frames(reader) {
        let map = receiver.range_doppler(&cube?).map_err(refused)?;
        frames.push(receiver.channel_errors(&map, arguments.at_m.0).map_err(refused)?);
    }
    if frames.is_empty() {
        return Err(Failure::Refused(format!("{}: no frame is in it", arguments.cube.display())));
    }
    let errors = mean_errors(&frames);
    files::write_file(&arguments.out, table(&errors, header.radar.array.rx_m.len()).as_bytes())?;
    if let Some(aside) = aside(&errors, &header.radar) {
        let side = if aside > 0.0 { "right" } else { "left" };
        progress::note(format!(
            "note: {}: phases turn along the row as those of a reflector {:.1}° to the {side} of --at-m do, whose \
             errors would be small: is that its place?",
            arguments.cube.display(),
            aside.abs().min(1.0).asin().to_degrees()
        ));
    }
    let rms = |of: &dyn Fn(&Complex64) -> f64| {
        (errors.iter().map(|error| of(error).powi(2)).sum::<f64>() / errors.len() as f64).sqrt()
    };
    terminal::line(format!(
        "{} channels of {} frames: gains {:.2} dB, phases {:.2}° rms",
        errors.len(),
        frames.len(),
        rms(&|error| db_from_amplitude(error.norm())),
        rms(&|error| error.arg().to_degrees())
    ));
    Ok(())
}

/// Direction cosine, relative to the reflector's direction and positive to the right along the row, at which
/// the echo has all channels in phase although they are far from it at the reflector; `None` if no direction
/// brings them in phase.
fn aside(errors: &[Complex64], radar: &Radar) -> Option<f64> {
    /// Least ratio of the magnitude of the sum to the sum of the magnitudes: with wholly random phases one in
    /// forty arrays of four channels passes, none of eight.
    const IN_PHASE: f64 = 0.99;
    const APART: f64 = 0.7;
    const COSINE_STEPS: i32 = 2000;
    let places = places_along_row(radar);
    let amplitudes: f64 = errors.iter().map(|error| error.norm()).sum();
    let in_phase = |cosine: f64| {
        let turned = errors.iter().zip(&places).map(|(e, x)| e * Complex64::cis(PI * x * cosine));
        turned.sum::<Complex64>().norm() / amplitudes
    };
    let cosines = (-COSINE_STEPS..=COSINE_STEPS).map(|i| f64::from(i) / f64::from(COSINE_STEPS));
    let best = cosines.max_by(|a, b| in_phase(*a).total_cmp(&in_phase(*b)))?;
    (errors.len() >= 4 && in_phase(best) > IN_PHASE && in_phase(0.0) < APART).then_some(best)
}

/// Places of the virtual channels along the row, `tx · receivers + rx`, half wavelengths.
fn places_along_row(radar: &Radar) -> Vec<f64> {
    let array = &radar.array;
    let receivers = || array.rx_half_wavelengths.iter();
    array.tx_half_wavelengths.iter().flat_map(|tx| receivers().map(|rx| tx[0] + rx[0])).collect()
}

/// A table with one line for each transmit–receive pair.
fn table(errors: &[Complex64], receivers: usize) -> String {
    let line = |(channel, error): (usize, &Complex64)| {
        let (gain_db, phase_deg) = (db_from_amplitude(error.norm()), error.arg().to_degrees());
        format!("{},{},{gain_db:.6},{phase_deg:.6}\n", channel / receivers, channel % receivers)
    };
    let lines: String = errors.iter().enumerate().map(line).collect();
    format!("tx,rx,gain_db,phase_deg\n{lines}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_beside_the_reflector_is_told_and_errors_of_channels_are_not() {
        let options = scene::ReadOptions::names_only();
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/experiment-1.toml");
        let radar = scene::read(&file, &options).unwrap().radar;
        let places = places_along_row(&radar);
        // Along a row to the right the phase falls for what is on the right (docs/coming-from.md).
        let of_cosine =
            |cosine: f64| places.iter().map(|x| Complex64::cis(-PI * x * cosine)).collect::<Vec<_>>();
        for cosine in [-0.35, 0.2] {
            let found = aside(&of_cosine(cosine), &radar).unwrap();
            assert!((found - cosine).abs() < 2e-3, "{found} {cosine}");
        }
        assert_eq!(aside(&of_cosine(0.01), &radar), None, "a tenth of a beam");
        let erring = places.iter().enumerate().map(|(i, _)| Complex64::cis(2.0 * (7.3 * i as f64).sin()));
        assert_eq!(aside(&erring.collect::<Vec<_>>(), &radar), None);
    }
}
