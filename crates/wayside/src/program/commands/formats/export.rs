//! `export`: any artifact in a format that others read; axes and units go into a `.json` beside it.

mod cube;
mod dataset;
#[cfg(feature = "classifier")]
mod features;
#[cfg_attr(not(feature = "interchange"), path = "export/no_interchange.rs")]
mod interchange;
#[cfg_attr(not(feature = "interchange"), path = "export/no_parquet.rs")]
mod parquet;
mod paths;
mod points;
mod rcs;
mod rdm;
mod tracks;

use crate::host::failure::Failure;
use crate::host::files;
use crate::host::progress;
use crate::program::cli::ExportArguments;
use crate::program::commands::formats::heights::Heights;
use crate::program::commands::formats::raw_data::dca1000;
use crate::program::commands::formats::raw_data::sigmf;
use crate::program::commands::formats::training_sets;
use crate::program::commands::formats::writing::fail;
use crate::program::export_formats::FORMATS;
use crate::program::words::{AxesWord, FormatWord};
use artifact::{Reader, Schema, read_preamble};
use clap::ValueEnum;
use std::path::Path;

pub(crate) fn run(arguments: &ExportArguments) -> Result<(), Failure> {
    let (file, out) = (arguments.file.as_path(), arguments.out.as_path());
    if file.is_dir() && arguments.to == FormatWord::Parquet {
        return parquet::samples(file, out);
    }
    let schema = read_preamble(file)?.schema; // from here on the file is known as an input
    if arguments.axes == AxesWord::On && (schema.as_str(), arguments.to) != ("rdm", FormatWord::Png) {
        return Err(Failure::System("--axes on is for range-Doppler maps (.rdm) exported to png".into()));
    }
    let (scene, is_set) = (arguments.scene.as_deref(), training_sets::is_set(arguments.to));
    if scene.is_some() && !is_set {
        let rule = "--scene is for sets with labels: raddet, carrada, uwcr, kitti, nuscenes";
        return Err(Failure::System(rule.into()));
    }
    if let Some(written) = training_sets::write(arguments.to, &schema, file, scene, out) {
        written?;
    } else {
        alone(arguments, &schema)?;
    }
    if schema == artifact::points::Points::NAME {
        Heights::of(file)?.note(file).into_iter().for_each(progress::note);
    }
    Ok(())
}

/// Writes an artifact in a format that is a file, or a pair of them.
fn alone(arguments: &ExportArguments, schema: &str) -> Result<(), Failure> {
    use FormatWord::{Csv, Dca1000, Exr, Json, Mcap, Npy, Osi, Parquet, Pcd, Ply, Png, Safetensors, Sigmf};
    let (file, out) = (arguments.file.as_path(), arguments.out.as_path());
    match (schema, arguments.to) {
        ("cube", Npy) => cube::npy(Reader::open(file)?, out),
        ("cube", Dca1000) => dca1000::write(file, out),
        ("cube", Sigmf) => sigmf::write(file, out),
        ("rdm", Npy) => rdm::npy(Reader::open(file)?, out),
        ("rdm", Exr) => rdm::exr(Reader::open(file)?, out),
        ("rdm", Png) if arguments.axes == AxesWord::On => rdm::png_with_axes(Reader::open(file)?, out),
        ("rdm", Png) => rdm::png(Reader::open(file)?, out),
        ("points", Csv) => points::csv(Reader::open(file)?, out),
        ("points", Pcd) => points::pcd(Reader::open(file)?, out),
        ("points", Parquet) => parquet::points(Reader::open(file)?, out),
        ("points", Ply) => points::ply(Reader::open(file)?, out),
        (kind @ ("points" | "tracks" | "paths"), Osi) => interchange::osi(file, kind, out),
        (kind @ ("points" | "tracks"), Mcap) => interchange::mcap(file, kind, out),
        ("tracks", Csv) => tracks::csv(Reader::open(file)?, out),
        ("tracks", Json) => as_json::<artifact::tracks::Tracks>(file, out),
        ("paths", Csv) => paths::csv(Reader::open(file)?, out),
        ("rcs", Npy) => rcs::npy(Reader::open(file)?, out),
        ("dataset", Parquet) => parquet::samples(file, out),
        ("dataset", Npy) => dataset::npy(file, out),
        ("dataset", Png) => dataset::png(file, out),
        #[cfg(feature = "classifier")]
        ("dataset", Csv) => features::csv(Reader::open(file)?, out),
        #[cfg(not(feature = "classifier"))]
        ("dataset", Csv) => {
            Err(Failure::refused("features of datasets need a program with the feature `classifier`"))
        }
        ("model", Safetensors) => model(file, out),
        ("model", Json) => as_json::<artifact::model::Model>(file, out),
        ("scene", Json) => as_json::<artifact::scene::Scene>(file, out),
        ("points", Json) => as_json::<artifact::points::Points>(file, out),
        ("paths", Json) => as_json::<artifact::paths::Paths>(file, out),
        ("classes", Json) => as_json::<artifact::classes::Classes>(file, out),
        ("rcs", Json) => as_json::<artifact::rcs::Rcs>(file, out),
        (known, to) => Err(refuse(file, known, to)),
    }
}

fn refuse(file: &Path, schema: &str, to: FormatWord) -> Failure {
    let Some((_, formats)) = FORMATS.iter().find(|(known, _)| *known == schema) else {
        return crate::program::commands::formats::inspect::unknown(file, schema);
    };
    let to = to.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned());
    Failure::Refused(format!(
        "{}: a `{schema}` artifact is exported to {formats}, not to {to}",
        file.display()
    ))
}

fn model(file: &Path, out: &Path) -> Result<(), Failure> {
    let weights = Reader::<artifact::model::Model>::open(file)?.next_frame()?;
    match weights {
        Some(artifact::model::Weights::Network { safetensors }) => files::write_file(out, &safetensors),
        Some(artifact::model::Weights::Trees(_)) => {
            Err(Failure::Refused(format!("{}: trees have no tensors; --to json writes them", file.display())))
        }
        None => Err(Failure::Refused(format!("{}: holds no weights", file.display()))),
    }
}

/// Header and frames, as their types name them, one frame after the other.
fn as_json<S: Schema>(file: &Path, out: &Path) -> Result<(), Failure> {
    use std::io::Write;
    let mut reader = Reader::<S>::open(file)?;
    let mut failed = None;
    let written = files::write_with(out, |stream| {
        write!(stream, "{{\"header\":")?;
        serde_json::to_writer(&mut *stream, reader.header())?;
        write!(stream, ",\"frames\":[")?;
        let of = reader.frames() as usize;
        for (i, frame) in progress::counted("frames", reader.by_ref(), of).enumerate() {
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
