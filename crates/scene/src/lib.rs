//! Scenes, meshes, the project's own vehicles and their motion
