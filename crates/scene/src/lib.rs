//! Scenes: the radar, the bodies on the road, and their motion.
//!
//! The input is a TOML file (`docs/scenes.md` has every key) with the mesh files it names; the result is a
//! [`SceneHeader`](artifact::scene::SceneHeader): the radar with its elements in world metres, the settings
//! of every later stage, meshes in body axes (x forward, y left, z up; the centre of the bounding box, on the
//! ground, at the origin) and each target's pose at the first sample. [`snapshot`] moves the targets to any
//! frame and adds the vehicles of recorded [`traffic`] that are in the radar's view; [`frame_view`] has their
//! further properties.
//!
//! ```
//! use scene::{MeshLoading, ReadOptions, read, snapshot};
//! # let folder = tempfile::tempdir()?; let file = folder.path().join("crossing.toml");
//! # std::fs::write(folder.path().join("sign.obj"), "v 0 0 1\nv 0 1 1\nv 0 1 2\nv 0 0 2\nf 1 2 3 4\n")?;
//! std::fs::write(&file, r#"
//!     name = "crossing"
//!     frames = 2
//!     [[target]]
//!     kind = "mesh"
//!     id = "sign"
//!     model = "sign.obj"            # or one of scene::vehicles::names()
//!     lane = 2
//!     y_m = 40.0
//!     velocity_mps = [0.0, -10.0, 0.0]
//! "#)?;
//! let whole = ReadOptions::whole();
//! let scene = read(&file, &whole)?;
//! assert_eq!(scene.radar.virtual_channels(), 12);
//! assert_eq!(scene.meshes[0].triangles.len(), 2);
//! assert_eq!(snapshot(&scene, 1).poses[0].position_m, [5.75, 39.0, 0.0]);
//!
//! // Every broken rule is reported, each in its place.
//! std::fs::write(&file, "name = \"crossing\"\nframes = 0\n[radar]\npositon_m = [0, 0, 6]\n")?;
//! let errors = read(&file, &whole).unwrap_err();
//! assert_eq!(errors.0.len(), 2);
//! let last = "4:1: [radar]: unknown key `positon_m`; the nearest is `position_m`";
//! assert!(errors.to_string().ends_with(last));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`read_mesh`] reads a mesh alone and keeps the file's origin; [`centred`] moves the origin to that of a
//! scene.
//!
//! The project's own [`vehicles`] and [`street`] furniture are the crate `bodies`.
//!
//! Read the rooms in this order; each uses only those before it. First come bodies from files, [`mesh`]
//! (glTF, STL, OBJ, and assets of OpenMATERIAL 3D), and SUMO's recordings; `document` defines the content of
//! a scene (`keys`), its faults (`diagnostics`) and its typed values with their places (`section`); then come
//! the rooms that read tables, and `read`, which calls them.

mod wording; // sentences about input, and where references may lead
mod measured; // patterns and calibrations from files
mod openmaterial; // assets of OpenMATERIAL 3D
pub mod mesh; // meshes from files
mod recording; // what SUMO writes
pub mod document; // a scene file, or a page like it, as tables that know their place
mod models; // what the scene names of bodies
mod materials; // names of materials, and the road
mod radar; // position, waveform and antennas
mod settings; // noise, processing, fidelity, lanes
mod targets; // moving bodies and clutter
pub mod traffic;
mod motion; // poses in a frame
mod read; // a scene file and all files that it names

pub use bodies::{ColouredLine, ColouredMesh, coloured_glb, street, vehicles};
pub use document::changes::Change;
pub use document::errors::{MapAxis, Place, Position, Rule, SceneError, SceneErrors};
pub use document::keys;
pub use document::keys::fidelity::{LEAST_ACCURACY_DB, Planning};
pub use document::toml_text;
pub use materials::read_materials;
pub use measured::calibration::{CalibrationFileError, CalibrationRule};
pub use measured::pattern_table::{PatternFileError, PatternRule};
pub use mesh::{MeshError, MeshOptions, centred, read_mesh};
pub use models::library::unknown_vehicle;
pub use models::options::{MeshLoading, ReadOptions};
pub use motion::{bodies_in_view, frame_view, snapshot, vehicles_in_view};
pub use openmaterial::{OpenMaterialError, OpenMaterialFault, asset_materials};
pub use radar::radars::radars;
pub use read::{
    inputs, inputs_of_changed, inputs_without_models, material_map, read, read_changed, read_text,
};
pub use recording::xml::XmlFault;
pub use settings::physics_keys::{PhysicsKeys, physics_keys, physics_settings};
pub use wording::allowed_range::AllowedRange;
