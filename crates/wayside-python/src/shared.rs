//! Scenes, samples and maps, which several classes hold, and artifacts as their files.

pub(crate) mod artifacts; // read and written
pub(crate) mod source_files; // files that a scene was read from
pub(crate) mod handle; // a scene that was read
pub(crate) mod values; // in memory that Python has too
pub(crate) mod samples; // of a cube, which Python holds
pub(crate) mod maps; // of a cube, which Python holds
