//! A scene stage by stage, every result in memory: the basis for programs that hold arrays instead of files,
//! such as the Python package. Results written to files equal to the byte those of the commands `paths`,
//! `echo` and `dsp`.

pub mod extensions; // file extensions, each with its writer
mod complete_artifact; // frames of an artifact with its header and provenance
mod opened_scene; // a scene that was read and planned, and its cost
mod scene_faults; // faults of a scene, rule by rule
mod scattering; // paths of a scene
pub(crate) mod paths_of_scene; // check that paths belong to a scene
mod echoes; // radar cubes of a scene
mod samples; // IF samples of other sources as radar cubes
mod processing; // maps, points, tracks and classes of cubes
mod meshes; // files and own vehicles
pub mod bounds; // ranges of the numbers that specify a table
mod tables; // S of a mesh, with its description

pub use complete_artifact::{CompleteArtifact, error_figures, model_error_figures};
pub use echoes::{echoes, echoes_of_paths};
pub use formats::export::delay_at_middle;
pub use meshes::mesh;
pub(crate) use meshes::{dressed, far_field_from_m, materials};
pub use opened_scene::{Cost, OpenedScene, inputs, radars};
pub use processing::{Classification, Processing};
pub use samples::{check_parts, cubes_of_samples, sound, unit_of_floats};
pub use scattering::paths;
pub use scene_faults::{SceneFault, file_keys, scene_faults};
pub use tables::words as table_words;
pub use tables::{
    DENSITY_PER_WAVELENGTH, DescribedTable, RequestedReceiver, RequestedTable, TableDescription, rcs,
};
pub(crate) use tables::{RcsTable, TableTimings, check_size, describe, write_values};
