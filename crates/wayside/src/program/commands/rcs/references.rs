//! `rcs --method po` and `--method sbr`: the slow references, aspect by aspect.

use crate::program::cli::RcsArguments;
use crate::program::option_words::MethodWord;
use crate::stepwise::RcsTable;
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::settings::NodeRule;
use bart_rcs::{CheckpointKey, CheckpointStore, RcsRequest, RcsSeconds, Standpoint};
use num_complex::Complex64;
use pipeline::host::checkpoint::Checkpoint;
use pipeline::host::failure::Failure;
use pipeline::host::processor_time::WorkClock;
use pipeline::host::progress::Work;
use po_sbr::{Aspect, Bracket, ReferenceError, po, sbr};

/// Number of halvings of a cell that a shadow's border crosses (`po_sbr::po`).
const SHADOW_LEVELS: u32 = 3;

pub(super) fn answer(
    arguments: &RcsArguments,
    mesh: &Mesh,
    request: &RcsRequest,
    checkpoint: &Checkpoint,
    clock: &WorkClock,
) -> Result<RcsTable, Failure> {
    bart_rcs::check_antennas(mesh, request).map_err(Failure::refused)?;
    let start_s = clock.seconds();
    let work = Work::resumed("aspects", checkpoint.aspects());
    let (elevations, azimuths) = (&request.elevation_rad, &request.azimuth_rad);
    let aspects = elevations.len() * azimuths.len();
    let mut table = vec![Complex64::ZERO; request.frequency_hz.len() * aspects];
    let (receive, transmit) = request.polarization.indices();
    let pairs = elevations.iter().flat_map(|el| azimuths.iter().map(move |az| (*el, *az)));
    for (number, (elevation_rad, azimuth_rad)) in pairs.enumerate() {
        let piece = CheckpointKey { pass: 0, aspect: number as u32 };
        let kept = checkpoint.load(piece).and_then(|bytes| from_bytes(bytes, request.frequency_hz.len()));
        let values = match kept {
            Some(values) => values,
            None => {
                let aspect = aspect(request, elevation_rad, azimuth_rad);
                let amplitudes = amplitudes(arguments, mesh, request, &aspect).map_err(Failure::refused)?;
                let values: Vec<Complex64> = amplitudes.iter().map(|a| a[receive][transmit]).collect();
                checkpoint.store(piece, &to_bytes(&values));
                values
            }
        };
        values.iter().enumerate().for_each(|(f, value)| table[f * aspects + number] = *value);
        work.at(number + 1, aspects);
    }
    let seconds = RcsSeconds { trace: clock.seconds() - start_s, ..RcsSeconds::default() };
    Ok(RcsTable { amplitude_m: table, seconds, ..RcsTable::default() })
}

fn to_bytes(values: &[Complex64]) -> Vec<u8> {
    values.iter().flat_map(|s| [s.re, s.im]).flat_map(f64::to_le_bytes).collect()
}

/// Reads values of the given number of frequencies; `None` unless the bytes have exactly that length.
fn from_bytes(bytes: &[u8], frequencies: usize) -> Option<Vec<Complex64>> {
    let (parts, rest) = bytes.as_chunks();
    let numbers: Vec<f64> = parts.iter().map(|part| f64::from_le_bytes(*part)).collect();
    let (values, odd) = numbers.as_chunks();
    let is_whole = rest.is_empty() && odd.is_empty() && values.len() == frequencies;
    is_whole.then(|| values.iter().map(|[re, im]| Complex64::new(*re, *im)).collect())
}

fn aspect(request: &RcsRequest, elevation_rad: f64, azimuth_rad: f64) -> Aspect {
    let transmitter = Standpoint { azimuth_rad, elevation_rad, range_m: request.range_m };
    Aspect { transmitter, receiver: request.receiver.unwrap_or(transmitter) }
}

fn amplitudes(
    arguments: &RcsArguments,
    mesh: &Mesh,
    request: &RcsRequest,
    aspect: &Aspect,
) -> Result<Vec<Amplitude>, ReferenceError> {
    let (per_wavelength, sides) = (arguments.density(), request.sides);
    let bracket = match request.nodes {
        NodeRule::Middle | NodeRule::OwnEdge => Bracket::Symmetrised,
        NodeRule::Exit => Bracket::Plain,
    };
    match arguments.method {
        MethodWord::Sbr => {
            let shooting = sbr::RaySettings { per_wavelength, bounces: request.bounces, sides, bracket };
            let by_order = sbr::amplitude(mesh, aspect, &request.frequency_hz, &shooting)?;
            Ok(summed(&by_order.orders, request.frequency_hz.len()))
        }
        MethodWord::Po | MethodWord::Bart => {
            let sampling = po::Sampling { per_wavelength, shadow_levels: SHADOW_LEVELS, sides, bracket };
            po::amplitude(mesh, aspect, &request.frequency_hz, &sampling)
        }
    }
}

/// Sum over orders at each frequency.
fn summed(orders: &[Vec<Amplitude>], frequencies: usize) -> Vec<Amplitude> {
    let mut sums = vec![Amplitude::default(); frequencies];
    for (sum, term) in orders.iter().flat_map(|order| (0..frequencies).map(|f| (f, &order[f]))) {
        for (r, t) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            sums[sum][r][t] += term[r][t];
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_back_from_the_bytes_of_as_many_frequencies_and_from_no_others() {
        let values = [Complex64::new(1.0, -0.0), Complex64::new(f64::MIN_POSITIVE, 1.0 / 3.0)];
        let bytes = to_bytes(&values);
        assert_eq!(from_bytes(&bytes, 2).unwrap(), values);
        assert!([0, 1, 3].iter().all(|frequencies| from_bytes(&bytes, *frequencies).is_none()));
        (0..bytes.len()).for_each(|cut| assert!(from_bytes(&bytes[..cut], 2).is_none(), "{cut}"));
    }
}
