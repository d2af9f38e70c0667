//! Formats to which artifacts are exported.

/// Formats to which each kind of artifact is exported.
pub(crate) const FORMATS: [(&str, &str); 10] = [
    ("scene", "json"),
    ("paths", "csv, json"),
    ("rcs", "npy, json"),
    ("cube", "npy, dca1000, sigmf"),
    ("rdm", "npy, exr, png"),
    ("points", "csv, pcd, ply, json"),
    ("tracks", "csv, json"),
    ("dataset", "csv, npy, png"),
    ("model", "safetensors, json"),
    ("classes", "json"),
];
