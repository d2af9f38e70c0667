//! Texts that a user writes beside scenes: studies, recipes, manifests of vehicles, attributions.

#[path = "../../../scene/tests/glb_file/mod.rs"]
#[allow(dead_code, reason = "tests of meshes change it, these take it as it is")]
mod glb_file;

use crate::commands::{put, run_scheduled, schedule};
use crate::corpus::{self, RECIPE, STUDY};
use fuzzing::{FuzzRng, Reader, mutate_json_keeping_types, mutate_text, with_toml_punctuation};
use glb_file::GlbFile;
use serde_json::Value;
use std::path::Path;

pub(crate) fn readers() -> Vec<Reader> {
    vec![
        Reader::refusing("study", 100, write_study, run_scheduled),
        Reader::refusing("recipe", 200, write_recipe, run_scheduled),
        Reader::refusing("manifest", 200, write_manifest, run_scheduled),
        Reader::refusing("attributions", 4, write_attributions, run_scheduled),
    ]
}

/// The last part of very many: what is asked for is read and drawn, and nothing is made.
const LAST_PART: &str = "--shard 4294967295/4294967295";

const STUDIES: [&str; 3] = [
    STUDY,
    "scene = \"sound/small.toml\"\nseed = 5\nrepeats = 3\nconfidence = 0.9\nrange_bands_m = [10, 20]\n\
     [[vary]]\nname = \"array\"\nkeys = [\"radar.array.preset\", \"radar.waveform.chirps\"]\n\
     values = [[\"1x4\", 16], [\"3x4\", 8]]\nlabels = [\"small\", \"large\"]\n\
     [[vary]]\nkey = \"noise.noise_figure_db\"\ndraw = { uniform = [9.0, 15.0] }\n\
     [[condition]]\nkey = \"target[0].position_m\"\nvalues = [[-2.0, 20.0, 0.0], [2.0, 30.0, 0.0]]\n\
     [[condition]]\nkey = \"target[1].rcs_m2\"\ndraw = { whole = [1, 9] }\n\
     [sample]\ncount = 4\n[goal]\nmetric = \"coverage\"\nbetter = \"higher\"\ncost = \"channels\"\n\
     margin = 0.1\n\
     [stop]\nconfidence = 0.95\nleast = 3\n",
    "scene = \"sound/small.toml\"\n[[vary]]\nkey = \"seed\"\nvalues = [1, 2, 3]\n\
     [[vary]]\nkey = \"dsp.training_cells\"\nvalues = [[3, 6], [2, 4]]\n\
     [[condition]]\nkey = \"frames\"\nvalues = [1, 2]\n[goal]\nmetric = \"coverage\"\n",
];

/// Words of studies and recipes.
const WORDS: [&str; 32] = [
    "nan",
    "inf",
    "true",
    "1979-05-27",
    "vary",
    "condition",
    "values",
    "draw",
    "uniform",
    "whole",
    "repeats",
    "sample",
    "count",
    "goal",
    "metric",
    "cost",
    "stop",
    "least",
    "range_bands_m",
    "scenes",
    "scenes_per_class",
    "scenes_per_shard",
    "frames",
    "vehicles_per_scene",
    "queue_share",
    "crops",
    "models",
    "motorcycle",
    "\"motorcycle-street\"",
    "\"sound/plate.obj\"",
    "\"../x\"",
    "\"f\"",
];

fn write_study(rng: &mut FuzzRng, folder: &Path) {
    corpus::texts(folder);
    let whole = rng.choose(&STUDIES);
    put(folder, "study.toml", &changed_toml(rng, whole));
    schedule(folder, &format!("sweep @study.toml --out @O --no-cache {LAST_PART}"));
}

/// A document changed by its values, which leaves its syntax right, or by its words.
fn changed_toml(rng: &mut FuzzRng, text: &str) -> Vec<u8> {
    if rng.one_in(2) {
        return mutate_text(rng, text.as_bytes(), &with_toml_punctuation(&WORDS));
    }
    let mut value: Value = toml::from_str(text).unwrap();
    for _ in 0..=rng.below(2) {
        mutate_json_keeping_types(rng, &mut value);
    }
    let keys = value.as_object().cloned().unwrap_or_default();
    keys.iter().map(|(key, value)| format!("{key} = {}\n", inline(value))).collect::<String>().into_bytes()
}

/// A value as TOML writes it in a line.
fn inline(value: &Value) -> String {
    let list = |all: Vec<String>| all.join(", ");
    match value {
        Value::Array(all) => format!("[{}]", list(all.iter().map(inline).collect())),
        Value::Object(all) => {
            let pairs = all.iter().map(|(key, value)| format!("{key} = {}", inline(value)));
            format!("{{ {} }}", list(pairs.collect()))
        }
        Value::Null => "\"\"".to_owned(),
        // Numbers and texts are written alike in both.
        other => other.to_string(),
    }
}

const RECIPES: [&str; 2] = [
    RECIPE,
    "scenes = [\"sound/base.toml\", \"sound/small.toml\"]\nseed = 1\nscenes_per_class = 3\n\
     scenes_per_shard = 2\n\
     range_m = [25.0, 45.0]\nspeed_mps = [1.0, 5.0]\nlanes = [1, 2]\nvehicle_seeds = 2\nyaw_deg = [-5, 5]\n\
     offset_m = [-0.5, 0.5]\nradar_height_m = [5, 6]\ntilt_deg = [-8, -4]\nextra_noise_db = [0, 6]\n\
     frames = 2\n\
     frame_interval_s = 0.1\nvehicles_per_scene = [1, 3]\nqueue_share = 0.5\nstatistical_share = 0.5\ncrops = false\n\
     [models]\nmotorcycle = [\"motorcycle-street\"]\ncar = [\"sound/plate.obj\"]\ntruck = [\"f\"]\n",
];

fn write_recipe(rng: &mut FuzzRng, folder: &Path) {
    corpus::texts(folder);
    std::fs::create_dir(folder.join("f")).unwrap();
    put(folder, "f/a.glb", &GlbFile::tetrahedron().bytes());
    let whole = rng.choose(&RECIPES);
    put(folder, "spec.toml", &changed_toml(rng, whole));
    schedule(folder, &format!("dataset @spec.toml --out @O {LAST_PART}"));
}

const MANIFEST: &str = "# vehicles\n[[vehicle]]\nname = \"a\"\nclass = \"car\"\nlength_m = 4.5\n\
[[vehicle]]\nname = \"b\"\nclass = \"motorcycle\"\n[[vehicle]]\nname = \"c\"\nclass = \"truck\"\n\
source = \"own\"\n";

fn write_manifest(rng: &mut FuzzRng, folder: &Path) {
    corpus::texts(folder);
    std::fs::create_dir(folder.join("v")).unwrap();
    for name in ["a", "b", "c"] {
        put(folder, &format!("v/{name}.glb"), &GlbFile::tetrahedron().bytes());
    }
    let words =
        ["[[vehicle]]", "name", "class", "\"car\"", "\"bus\"", "\"../v/a\"", "\"\"", "\"a\"", "=", "[", "]"];
    put(folder, "v/manifest.toml", &mutate_text(rng, MANIFEST.as_bytes(), &words));
    put(folder, "spec.toml", RECIPE.replace("car = [\"sound/plate.obj\"]", "vehicles = \"v\"").as_bytes());
    schedule(folder, &format!("dataset @spec.toml --out @O {LAST_PART}"));
}

fn write_attributions(rng: &mut FuzzRng, folder: &Path) {
    corpus::dataset(folder);
    let whole = include_str!("../../../../fixtures/classifier.attributions.txt");
    put(folder, "a.txt", &mutate_text(rng, whole.as_bytes(), &with_toml_punctuation(&WORDS)));
    schedule(folder, "train @sound/d --learner trees --attributions @a.txt --out @O");
}
