//! `calibrate`: what the channels of a radar differ by from ideal ones, from a reflector at a known place.

use crate::program::cli::CalibrateArguments;
use crate::program::terminal;
use artifact::Reader;
use artifact::cube::Cube;
use artifact::units::db_from_amplitude;
use dsp::{Receiver, mean_errors};
use num_complex::Complex64;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;

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

/// A line for every transmit–receive pair.
fn table(errors: &[Complex64], receivers: usize) -> String {
    let line = |(channel, error): (usize, &Complex64)| {
        let (gain_db, phase_deg) = (db_from_amplitude(error.norm()), error.arg().to_degrees());
        format!("{},{},{gain_db:.6},{phase_deg:.6}\n", channel / receivers, channel % receivers)
    };
    let lines: String = errors.iter().enumerate().map(line).collect();
    format!("tx,rx,gain_db,phase_deg\n{lines}")
}
