//! Fuzzed assets and materials of OpenMATERIAL 3D, changed by their structure.

use crate::gltf::glb_file::GlbFile;
use fuzzing::{FuzzRng, mutate_json, mutate_text};
use serde_json::{Value, json};
use std::path::Path;

/// Writes an asset with all that it leads to, some of it changed.
pub(crate) fn write(rng: &mut FuzzRng, folder: &Path) {
    std::fs::write(folder.join("o.glb"), GlbFile::tetrahedron().bytes()).unwrap();
    let mut files = corpus();
    for _ in 0..rng.below(4) {
        let at = rng.below(files.len());
        mutate_json(rng, &mut files[at].1, &WORDS, strange);
    }
    let damaged = rng.one_in(4).then(|| rng.below(files.len()));
    for (i, (name, value)) in files.iter().enumerate() {
        let mut bytes = serde_json::to_vec(value).unwrap();
        if damaged == Some(i) {
            bytes = mutate_text(rng, &bytes, &crate::corpus::words());
        }
        std::fs::write(folder.join(name), bytes).unwrap();
    }
}

/// Files that reach every branch of the reader.
fn corpus() -> Vec<(&'static str, Value)> {
    let whole = |mut value: Value| {
        value["metadata"] = json!({ "name": "o", "openMaterial3dVersion": "1.1.0" });
        value
    };
    let asset = json!({
        "materialMappingUri": "o.xomm",
        "materialReplacements": [["paint", "rgb:1;2;3"]],
        "materialTextureAssignment": [["other", "a.png"]],
        "externalAssetReferences": [] });
    let mapping = json!({ "materialMapping": [["glass", "g.xomp", "a"], ["rgb:1;2;3", "g.xomp", "b"]] });
    let material = json!({ "materialProperties": {
        "surfaceRoughness": { "surfaceHeightRms": 0.001, "surfaceCorrelationLength": 0.01, "sources": "" },
        "electromagneticPropertiesUri": "g_emp.xompt" } });
    let table = json!({ "electromagneticProperties": [
        [0.0035, 293.0, 50.0, 1.0, 0.0, 6.0, 0.2],
        [0.0039, 293.0, 50.0, 1.0, 0.0, 6.5, 0.3],
        [0.0039, 300.0, null, null, null, 6.6, 0.3],
        [0.0041, 293.0, 50.0, 1.0, 0.0, null, null],
        [0.0042, null, 20.0, 1.0, 0.0, 7.0, 0.4]] });
    vec![
        ("o.xoma", whole(asset)),
        ("o.xomm", whole(mapping)),
        ("g.xomp", whole(material)),
        ("g_emp.xompt", whole(table)),
    ]
}

const WORDS: [&str; 12] = [
    "metadata",
    "openMaterial3dVersion",
    "materialMappingUri",
    "materialReplacements",
    "materialTextureAssignment",
    "externalAssetReferences",
    "materialMapping",
    "materialProperties",
    "surfaceRoughness",
    "surfaceHeightRms",
    "electromagneticPropertiesUri",
    "electromagneticProperties",
];

fn strange(rng: &mut FuzzRng) -> Value {
    let small = rng.below(12);
    match rng.below(10) {
        0..=2 => json!(1e-3 * small as f64),
        3 => serde_json::from_str(&rng.number_text()).unwrap_or(Value::Null),
        4 => (0..rng.repeat_count().min(200)).fold(json!(small), |inner, _| json!([inner])),
        5 => json!([small, null, -1, 1e300, 1e-300, 5, 1e308]),
        6 => json!("x".repeat(rng.repeat_count())),
        7 => json!(["paint", "glass"]),
        _ => json!(rng.choose(&[
            "o.xomm",
            "g.xomp",
            "g_emp.xompt",
            "../g.xomp",
            "/dev/zero",
            "%2e%2e/g_emp.xompt",
            "http://example.invalid/g.xomp",
            "2.0.0",
            "1",
            "",
        ])),
    }
}
