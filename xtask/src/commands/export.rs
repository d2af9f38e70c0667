//! `export`: any artifact in a format that others read; axes and units go into a `.json` beside it.

mod cube;
mod dataset;
mod npy_stream;
mod paths;
mod points;
mod rcs;
mod rdm;
mod tracks;

use super::raw_data::{dca1000, sigmf};
use crate::cli::{AxesWord, ExportArguments, FormatWord};
use crate::failure::Failure;
use crate::output;
use artifact::{Reader, Schema, read_preamble};
use clap::ValueEnum;
use std::path::{Path, PathBuf};

pub(crate) use npy_stream::NpyStream;
pub(crate) use rdm::write_exr as rdm_exr;

pub(crate) fn run(arguments: &ExportArguments) -> Result<(), Failure> {
    use FormatWord::{Csv, Dca1000, Exr, Json, Npy, Pcd, Ply, Png, Safetensors, Sigmf};
    let (file, out) = (arguments.file.as_path(), arguments.out.as_path());
    let schema = read_preamble(file)?.schema;
    if arguments.axes == AxesWord::On && (schema.as_str(), arguments.to) != ("rdm", Png) {
        return Err(Failure::System("--axes on is for range-Doppler maps (.rdm) exported to png".into()));
    }
    match (schema.as_str(), arguments.to) {
        ("cube", Npy) => cube::npy(Reader::open(file)?, out),
        ("cube", Dca1000) => dca1000::write(file, out),
        ("cube", Sigmf) => sigmf::write(file, out),
        ("rdm", Npy) => rdm::npy(Reader::open(file)?, out),
        ("rdm", Exr) => rdm::exr(Reader::open(file)?, out),
        ("rdm", Png) if arguments.axes == AxesWord::On => rdm::png_with_axes(Reader::open(file)?, out),
        ("rdm", Png) => rdm::png(Reader::open(file)?, out),
        ("points", Csv) => points::csv(Reader::open(file)?, out),
        ("points", Pcd) => points::pcd(Reader::open(file)?, out),
        ("points", Ply) => points::ply(Reader::open(file)?, out),
        ("tracks", Csv) => tracks::csv(Reader::open(file)?, out),
        ("tracks", Json) => as_json::<artifact::tracks::Tracks>(file, out),
        ("paths", Csv) => paths::csv(Reader::open(file)?, out),
        ("rcs", Npy) => rcs::npy(Reader::open(file)?, out),
        ("dataset", Npy) => dataset::npy(Reader::open(file)?, out),
        ("dataset", Png) => dataset::png(Reader::open(file)?, out),
        ("model", Safetensors) => model(file, out),
        ("scene", Json) => as_json::<artifact::scene::Scene>(file, out),
        ("points", Json) => as_json::<artifact::points::Points>(file, out),
        ("paths", Json) => as_json::<artifact::paths::Paths>(file, out),
        ("rcs", Json) => as_json::<artifact::rcs::Rcs>(file, out),
        (known, to) => Err(refuse(file, known, to)),
    }
}

fn refuse(file: &Path, schema: &str, to: FormatWord) -> Failure {
    let formats = match schema {
        "cube" => "npy, dca1000, sigmf",
        "rdm" => "npy, exr, png",
        "points" => "csv, pcd, ply, json",
        "tracks" | "paths" => "csv, json",
        "rcs" => "npy, json",
        "dataset" => "npy, png",
        "model" => "safetensors",
        "scene" => "json",
        other => return super::inspect::unknown(file, other),
    };
    let to = to.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned());
    Failure::Refused(format!("{}: a `{schema}` artifact is exported to {formats}, not to {to}", file.display()))
}

fn model(file: &Path, out: &Path) -> Result<(), Failure> {
    let weights = Reader::<artifact::model::Model>::open(file)?.next_frame()?;
    let weights = weights.ok_or_else(|| Failure::Refused(format!("{}: holds no weights", file.display())))?;
    output::write_file(out, &weights.safetensors)
}

/// Header and frames, as their types name them, one frame after the other.
fn as_json<S: Schema>(file: &Path, out: &Path) -> Result<(), Failure> {
    use std::io::Write;
    let mut reader = Reader::<S>::open(file)?;
    let mut failed = None;
    let written = output::write_with(out, |stream| {
        write!(stream, "{{\"header\":")?;
        serde_json::to_writer(&mut *stream, reader.header())?;
        write!(stream, ",\"frames\":[")?;
        for (i, frame) in reader.by_ref().enumerate() {
            match frame {
                Ok(frame) => {
                    stream.write_all(if i == 0 { b"\n" } else { b",\n" })?;
                    serde_json::to_writer(&mut *stream, &frame)?;
                }
                Err(error) => return Err(fail(&mut failed, error)),
            }
        }
        writeln!(stream, "]}}")
    });
    failed.map_or(written, |error| Err(error.into()))
}

/// Keeps an artifact's error while a stream that can only fail with I/O errors is given up.
pub(crate) fn fail(keep: &mut Option<artifact::ArtifactError>, error: artifact::ArtifactError) -> std::io::Error {
    *keep = Some(error);
    std::io::Error::other("the artifact is damaged")
}

/// `F.npy` → `F.json`; a name that ends in `.json` itself gets `.axes.json`.
pub(crate) fn sidecar(out: &Path) -> PathBuf {
    let json = out.with_extension("json");
    if json == out { out.with_extension("axes.json") } else { json }
}

/// Writes the axes beside `out`.
pub(crate) fn write_sidecar(out: &Path, axes: &serde_json::Value) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(axes).map_err(Failure::refused)?;
    output::write_file(&sidecar(out), text.as_bytes())
}
