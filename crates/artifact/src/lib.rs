//! Artifacts passed between the stages: plain data, no physics.
//!
//! Five stages (`scene`, `bart-rcs`, `fmcw-echo`, `dsp`, `classifier`) know this crate and not each other.
//! Each reads one kind of artifact and writes the next:
//!
//! ```text
//! scene.toml → .scene → .paths (or .rcs) → .cube → .rdm → .points → crops → classes
//! ```
//!
//! An artifact is one [`envelope`]: kind, origin, a header, then one record per radar frame, each with its
//! length and checksum, then an end mark. It is written as a stream and renamed when complete; it is read as
//! a stream with bounded memory. Signs, axes and units are those of `docs/conventions.md`.
//!
//! ```
//! use artifact::{Provenance, Reader, Writer, points::{Points, PointsFrame, PointsHeader}};
//! # let dir = tempfile::tempdir()?; let file = dir.path().join("frames.points");
//! let header = PointsHeader::default();
//! let mut writer = Writer::<Points>::create(&file, &Provenance::default(), &header)?;
//! writer.write(&PointsFrame { index: 0, time_s: 0.0, points: vec![], objects: vec![] })?;
//! writer.finish()?;
//! let frames = Reader::<Points>::open(&file)?.collect::<Result<Vec<_>, _>>()?;
//! assert_eq!(frames.len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod quantities; // numbers with units
mod files; // reading and writing
mod descriptions; // descriptions shared by artifacts
mod schemas; // the artifacts

pub use descriptions::radar::{Radar, Waveform};
pub use descriptions::{goal, material, pattern, permittivity, radar, settings};
pub use files::envelope::{
    ArtifactError, Fault, Preamble, Provenance, Reader, Schema, Writer, read_preamble,
};
pub use files::{atomic_file, bounded, changed_inputs, envelope, inputs, message};
pub use quantities::accuracy::{Accuracy, ErrorBudget, ModelError};
pub use quantities::{accuracy, seed, units};
pub use schemas::{classes, cube, dataset, model, paths, points, rcs, rdm, scene, signature, tracks};
