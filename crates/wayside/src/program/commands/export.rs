//! `export`: any artifact in a format that others read; axes and units go into a `.json` beside it.

use crate::program::cli::ExportArguments;
use crate::program::export_formats::FORMATS;
use crate::program::words::{AxesWord, FormatWord};
use artifact::{Reader, Schema, read_preamble};
use clap::ValueEnum;
use formats::export::{as_json, cube, dataset, interchange, model, parquet, paths, points, rcs, rdm, tracks};
use formats::heights::Heights;
use formats::raw_data::dca1000;
use formats::raw_data::sigmf;
use formats::training_sets;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
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
    let (scene, set) = (arguments.scene.as_deref(), arguments.to.set());
    if scene.is_some() && set.is_none() {
        let rule = "--scene is for sets with labels: raddet, carrada, uwcr, kitti, nuscenes";
        return Err(Failure::System(rule.into()));
    }
    let of_set = set.and_then(|set| training_sets::write(set, &schema, file, scene, out));
    if let Some(written) = of_set {
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
        ("dataset", Csv) => formats::export::features::csv(Reader::open(file)?, out),
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
        return crate::program::commands::inspect::unknown(file, schema);
    };
    let to = to.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned());
    Failure::Refused(format!(
        "{}: a `{schema}` artifact is exported to {formats}, not to {to}",
        file.display()
    ))
}
