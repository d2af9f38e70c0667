//! Assets and materials of OpenMATERIAL 3D, made by hand: geometry as the glTF beside them, permittivities as
//! their tables say at the radar's frequency, and every refusal with file, place and rule.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

mod assets;
mod fixture;
#[path = "../glb_file/mod.rs"]
mod glb_file;
mod refusals;
mod scenes;
mod tables;
