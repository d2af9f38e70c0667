//! Raw frames of the University of Washington: one `.mat` per frame, `[sample, chirp, receiver,
//! transmitter]`.

use crate::mat_file::{self, MatError};
use crate::raw_data::described_waveform::{NumberKey, WaveformKeys};
use crate::raw_data::{ImportedFrames, IntegerStep, LIMIT_BYTES, described_unit};
use crate::sidecar;
use artifact::bounded;
use artifact::cube::CubeHeader;
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Ending of a frame's file.
pub const ENDINGS: [&str; 1] = ["mat"];

/// Name of the array in each file.
pub(crate) const ARRAY: &str = "adcData";

/// Name of the dataset in the description of an exported one.
pub(crate) const SET: &str = "UWCR";
/// Key of that description's numbers of the radar.
pub(crate) const RADAR: &str = "radar_configs";
/// Keys of the waveform among these numbers.
pub(crate) const WAVEFORM: WaveformKeys = WaveformKeys {
    sample_rate: NumberKey { name: "digOutSampleRate", unit: 1e3 },
    start_frequency: NumberKey { name: "startFreqConst_GHz", unit: 1e9 },
    slope: NumberKey { name: "freqSlopeConst_MHz_usec", unit: 1e12 },
};

/// Samples, chirps, receivers, and transmitters or the slots of their codes: a cube's axes reversed, so that
/// its values are already in the order of a column-major array.
pub(crate) fn shape(header: &CubeHeader) -> [usize; 4] {
    let [channels, chirps, samples] = header.shape();
    let receivers = header.radar.array.rx_m.len().max(1);
    [samples, chirps, receivers, channels / receivers]
}

/// Reads the frames of files, one each, in their order, in the unit of the dataset's description if it has
/// one. The waveform in that description must be the radar's.
///
/// # Errors
/// Files that are not such arrays, or do not have the sizes of the header's radar; a description of another
/// radar.
pub fn read(files: &[PathBuf], header: &CubeHeader) -> Result<ImportedFrames, Failure> {
    let description = descriptions(files).pop().and_then(|place| Some((own_description(&place)?, place)));
    let step = match &description {
        Some((told, place)) => {
            WAVEFORM.check(&told[RADAR], place, &header.radar.waveform)?;
            described_unit::OWN_KEYS.meaning(told, place)?
        }
        None => IntegerStep::Floats,
    };
    let counted = progress::counted("frames", files, files.len());
    let frames: Result<Vec<_>, _> = counted.map(|file| of_file(file, header)).collect();
    let descriptions = description.into_iter().map(|(_, place)| place).collect();
    Ok(ImportedFrames { frames: frames?, step, descriptions })
}

/// Place of the description of the dataset of these frames, if there is one: two folders up.
pub fn descriptions(files: &[PathBuf]) -> Vec<PathBuf> {
    let first = files.first().and_then(|file| std::fs::canonicalize(file).ok());
    let place = first.and_then(|file| Some(file.ancestors().nth(2)?.join("set.json")));
    place.into_iter().filter(|place| place.is_file()).collect()
}

/// Content of a description that this program wrote of such a dataset.
fn own_description(place: &Path) -> Option<Value> {
    sidecar::read(place).filter(|told| told["set"] == SET)
}

fn of_file(file: &Path, header: &CubeHeader) -> Result<Vec<Complex32>, Failure> {
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let refused = |why: MatError| Failure::Refused(format!("{}: {why}", file.display()));
    mat_file::complex_values(&bytes, shape(header)).map_err(refused)
}
