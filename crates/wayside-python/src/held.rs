//! What several classes hold: a scene, samples, maps.

pub(crate) mod handle; // a scene that was read
pub(crate) mod samples; // of a cube, which Python holds
pub(crate) mod maps; // of a cube, which Python holds
