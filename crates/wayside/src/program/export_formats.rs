//! Formats to which artifacts are exported.

/// Formats to which each kind of artifact is exported.
pub(crate) const FORMATS: [(&str, &str); 10] = [
    ("scene", "json"),
    ("paths", "csv, json, osi"),
    ("rcs", "npy, json"),
    ("cube", "npy, dca1000, sigmf, uwcr"),
    ("rdm", "npy, exr, png, raddet, carrada"),
    ("points", "csv, pcd, ply, json, osi, mcap, kitti, nuscenes, parquet"),
    ("tracks", "csv, json, osi, mcap"),
    ("dataset", "csv, npy, png, parquet"),
    ("model", "safetensors, json"),
    ("classes", "json"),
];

/// Help on the formats to which each artifact is exported, a line an artifact.
pub(crate) fn help_on_formats() -> String {
    let line = |(artifact, formats): &(&str, &str)| format!("\n  {:<10} {formats}", format!(".{artifact}"));
    format!("What goes to which format:{}", FORMATS.iter().map(line).collect::<String>())
}
