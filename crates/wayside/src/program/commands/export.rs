//! `export`: converts any artifact to a format that other programs read; axes and units go into a `.json`
//! beside it.

use crate::program::cli::ExportArguments;
use crate::program::export_formats::{Export, export_of, formats_of, is_set, name_of};
use crate::program::option_words::{AxesWord, FormatWord};
use artifact::{Reader, Schema, read_preamble};
use formats::export::{parquet, rdm};
use formats::height_source::HeightSource;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use std::path::Path;

pub(crate) fn run(arguments: &ExportArguments) -> Result<(), Failure> {
    let (file, out, to) = (arguments.file.as_path(), arguments.out.as_path(), arguments.to);
    let is_dataset = file.is_dir() && to == FormatWord::Parquet;
    // Reading the preamble registers the file as an input.
    let schema = if is_dataset { String::new() } else { read_preamble(file)?.schema };
    let has_axes = arguments.axes == AxesWord::On;
    if has_axes && (schema.as_str(), to) != ("rdm", FormatWord::Png) {
        return Err(Failure::System("--axes on is for range-Doppler maps (.rdm) exported to png".into()));
    }
    let scene = arguments.scene.as_deref();
    if scene.is_some() && !is_set(to) {
        let rule = "--scene is for sets with labels: raddet, carrada, uwcr, kitti, nuscenes";
        return Err(Failure::System(rule.into()));
    }
    if is_dataset {
        return parquet::samples(file, out);
    }
    match export_of(&schema, to) {
        Some(Export::Set(write)) => write(file, scene, out)?,
        Some(Export::File(_)) if has_axes => rdm::png_with_axes(Reader::open(file)?, out)?,
        Some(Export::File(write)) => write(file, out)?,
        None => return Err(refuse(file, &schema, to)),
    }
    if schema == artifact::points::Points::NAME {
        HeightSource::of(file)?.note(file).into_iter().for_each(progress::note);
    }
    Ok(())
}

fn refuse(file: &Path, schema: &str, to: FormatWord) -> Failure {
    let formats = formats_of(schema);
    if formats.is_empty() {
        return crate::program::commands::inspect::unknown(file, schema);
    }
    let (file, to) = (file.display(), name_of(to));
    Failure::Refused(format!("{file}: a `{schema}` artifact is exported to {formats}, not to {to}"))
}
