//! RCS tables as complex128 `[frequency, elevation, azimuth]`.

use crate::npy_stream::NpyStream;
use crate::safe_file_name::safe_file_name;
use crate::sidecar;
use artifact::Reader;
use artifact::rcs::{Rcs, RcsTable};
use num_complex::Complex64;
use pipeline::host::failure::Failure;
use pipeline::host::{files, progress};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Writes one file per table; a single table keeps the requested name.
pub fn npy(reader: Reader<Rcs>, out: &Path) -> Result<(), Failure> {
    let targets = reader.header().targets.clone();
    let mut tables: Vec<(u32, RcsTable)> = Vec::new();
    for frame in progress::frames(reader) {
        let frame = frame?;
        tables.extend(frame.tables.into_iter().map(|t| (frame.index, t)));
    }
    let single = tables.len() == 1;
    let named = |(frame, table): &(u32, RcsTable)| {
        let target = targets.get(table.target as usize).map_or("mesh", String::as_str);
        (if single { out.to_owned() } else { numbered(out, *frame, target) }, target)
    };
    let places: Vec<_> = tables.iter().map(named).collect();
    places.iter().try_for_each(|(place, _)| sidecar::claim(place))?;
    if !single {
        let rule = "was not named itself, and has no description of this program's beside it";
        let keep_foreign =
            |place: &Path| files::refuse_unless(place, rule, || sidecar::beside(place).exists());
        places.iter().try_for_each(|(place, _)| keep_foreign(place))?;
    }
    for ((frame, table), (place, target)) in tables.iter().zip(&places) {
        write(place, *frame, target, table)?;
    }
    Ok(())
}

fn numbered(out: &Path, frame: u32, target: &str) -> PathBuf {
    let mut name = out.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{frame:04}-{}.npy", safe_file_name(target)));
    out.with_file_name(name)
}

fn write(out: &Path, frame: u32, target: &str, table: &RcsTable) -> Result<(), Failure> {
    let shape = [table.frequency_hz.len(), table.elevation_rad.len(), table.azimuth_rad.len()];
    NpyStream::write::<Complex64>(out, &shape, |stream| {
        stream.append(&table.amplitude_m)?;
        sidecar::remove_outdated(out)
    })?;
    let degrees = |axis: &[f64]| axis.iter().map(|a| a.to_degrees()).collect::<Vec<_>>();
    let range = table.range_m.is_finite().then_some(table.range_m);
    let [el_deg, az_deg] = [degrees(&table.elevation_rad), degrees(&table.azimuth_rad)];
    let axes = json!({ "freq_hz": table.frequency_hz, "el_deg": el_deg, "az_deg": az_deg });
    sidecar::write(
        out,
        &json!({ "axes": axes, "unit": "m", "frame": frame, "target": target, "range_m": range }),
    )
}
