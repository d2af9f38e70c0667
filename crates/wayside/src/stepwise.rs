//! A scene stage by stage, every result in memory: what programs of others stand on that hold arrays and no
//! files, such as the Python package. What is written of these results equals to the byte what the commands
//! `paths`, `echo` and `dsp` write.

pub mod endings; // of what is written, each with its writer
mod recorded; // frames of an artifact, and what is told of them
mod opened_scene; // a scene that was read and planned, and what it will cost
mod scene_faults; // what is wrong with a scene, rule by rule
mod scattering; // paths of a scene
pub(crate) mod paths_of_scene; // paths beside the scene that they have to be of
mod echoes; // radar cubes of a scene
mod samples; // anybody's samples as a radar cube
mod processing; // maps, points, tracks and classes of cubes
mod meshes; // files and own vehicles
pub mod bounds; // of numbers that a table is asked with
mod tables; // S of a mesh

pub use bart_rcs::{RcsRequest, Standpoint};
pub use echoes::{echoes, echoes_of_paths};
pub use formats::export::delay_at_middle;
pub use meshes::{dressed, far_field_from_m, materials, mesh, middle_hz};
pub use opened_scene::{Cost, OpenedScene, inputs, radars};
pub use processing::{Answered, Processing};
pub use recorded::{Recorded, error_figures, model_error_figures};
pub use samples::{check_parts, cubes_of_samples, sound, unit_of_floats};
pub use scattering::paths;
pub use scene_faults::{SceneFault, file_keys, scene_faults};
pub use tables::{RcsTable, check_size, rcs};
