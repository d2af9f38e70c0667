//! Artifacts in formats of other programs: a module for each kind of artifact, whole artifacts as JSON, and
//! unchanged weights.

mod delays; // of paths
pub mod cube;
pub mod dataset;
#[cfg(feature = "classifier")]
pub mod features;
#[cfg_attr(not(feature = "interchange"), path = "export/no_interchange.rs")]
pub mod interchange;
#[cfg_attr(not(feature = "interchange"), path = "export/no_parquet.rs")]
pub mod parquet;
pub mod paths;
pub mod points;
pub mod rcs;
pub mod rdm;
pub mod tracks;

use artifact::model::{Model, Weights};
use artifact::{Reader, Schema};
pub use delays::delay_at_middle;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use std::path::Path;

/// Writes the tensors of a network's weights.
pub fn model(file: &Path, out: &Path) -> Result<(), Failure> {
    let weights = Reader::<Model>::open(file)?.next_frame()?;
    match weights {
        Some(Weights::Network { safetensors }) => files::write_file(out, &safetensors),
        Some(Weights::Trees(_) | Weights::Profile(_) | Weights::Both { .. }) => {
            Err(Failure::Refused(format!(
                "{}: a model of signatures has no file of tensors; --to json writes its weights",
                file.display()
            )))
        }
        None => Err(Failure::Refused(format!("{}: holds no weights", file.display()))),
    }
}

/// Writes header and frames with the field names of their types, one frame after the other.
pub fn as_json<S: Schema>(file: &Path, out: &Path) -> Result<(), Failure> {
    use std::io::{Error, Write};
    let mut reader = Reader::<S>::open(file)?;
    files::write_with(out, |stream| {
        write!(stream, "{{\"header\":")?;
        serde_json::to_writer(&mut *stream, reader.header())?;
        write!(stream, ",\"frames\":[")?;
        let of = reader.frames() as usize;
        for (i, frame) in progress::counted("frames", reader.by_ref(), of).enumerate() {
            let frame = frame.map_err(Error::other)?;
            stream.write_all(if i == 0 { b"\n" } else { b",\n" })?;
            serde_json::to_writer(&mut *stream, &frame)?;
        }
        writeln!(stream, "]}}")
    })
}
