//! Recipes of datasets: what they may say, what comes of it, and that neither threads nor interruptions
//! change it.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::Workplace;
use artifact::dataset::{Dataset, Sample};
use artifact::{Reader, Schema, Writer};
use serde_json::Value;
use std::collections::BTreeSet;

/// A radar for which a scene takes a fraction of a second.
const BASE: &str = "name = \"base\"\nframe_interval_s = 0.5\n[radar.waveform]\nsamples = 128\nchirps = 64\n[radar.array]\n\
preset = \"1x4\"\n[noise]\nnoise_figure_db = 12.0\n[dsp]\ntraining_cells = [3, 6]\n[fidelity]\nbounces = 1\n";

/// Keys that every recipe has; its models follow.
const NEEDED: &str = "scene = \"base.toml\"\nseed = 1\nscenes_per_class = 3\nrange_m = [25.0, 45.0]\n\
speed_mps = [1.0, 5.0]\nlanes = [1, 2]\n";

const OWN: &str = "[models]\nmotorcycle = [\"motorcycle-street\"]\ncar = [\"car-hatchback\"]\n";

fn prepared() -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("base.toml"), BASE).unwrap();
    place
}

fn made(place: &Workplace, recipe: &str, out: &str) -> Vec<Sample> {
    std::fs::write(place.path("spec.toml"), recipe).unwrap();
    place.run(&format!("dataset spec.toml --out {out} --quiet"));
    samples(place, out)
}

fn samples(place: &Workplace, out: &str) -> Vec<Sample> {
    Reader::<Dataset>::open(&place.path(&format!("{out}/shard-0000.dataset")))
        .unwrap()
        .map(Result::unwrap)
        .collect()
}

fn lines(place: &Workplace, file: &str) -> Vec<Value> {
    String::from_utf8(place.bytes(file))
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn vehicles(line: &Value) -> &[Value] {
    line["frames"][0]["vehicles"].as_array().unwrap()
}

#[test]
fn files_folders_and_manifests_are_models_beside_the_own_vehicles() {
    let place = prepared();
    place.run("vehicles car-suv car-sedan car-hatchback bus-mini motorcycle-street --out v --quiet");
    std::fs::create_dir(place.path("cars")).unwrap();
    for name in ["car-suv", "car-sedan"] {
        std::fs::copy(place.path(&format!("v/{name}.glb")), place.path(&format!("cars/my-{name}.glb")))
            .unwrap();
    }
    std::fs::create_dir(place.path("listed")).unwrap();
    std::fs::copy(place.path("v/bus-mini.glb"), place.path("listed/minibus.glb")).unwrap();
    let manifest = "[[vehicle]]\nname = \"minibus\"\nclass = \"bus\"\nlength_m = 6.0\n";
    std::fs::write(place.path("listed/manifest.toml"), manifest).unwrap();
    let models = "vehicle_seeds = 5\n[models]\nvehicles = \"listed\"\ncar = [\"cars\", \"car-hatchback\"]\n\
                  motorcycle = [\"v/motorcycle-street.glb\"]\n";
    let samples = made(&place, &format!("{NEEDED}{models}"), "d");
    let lines = lines(&place, "d/scenes.jsonl");
    let drawn: Vec<&str> = lines.iter().map(|line| vehicles(line)[0]["model"].as_str().unwrap()).collect();
    let of_round = |car| [car, "minibus", "v/motorcycle-street".trim_start_matches("v/")];
    assert_eq!(drawn, ["my-car-sedan", "my-car-suv", "car-hatchback"].map(of_round).concat());
    for sample in &samples {
        assert_eq!(sample.class.unwrap().name(), vehicles(&lines[sample.scene as usize])[0]["class"]);
        assert!(sample.variant == 0 || sample.model == "car-hatchback", "files have no variants");
        assert!(sample.crop.is_some() && sample.signature.points > 0);
    }
    let inputs = Reader::<Dataset>::open(&place.path("d/shard-0000.dataset")).unwrap();
    let hashed: Vec<String> =
        inputs.preamble().provenance.inputs.iter().map(|(name, _)| name.clone()).collect();
    let files =
        ["spec.toml", "base.toml", "manifest.toml", "my-car-sedan.glb", "my-car-suv.glb", "minibus.glb"];
    assert_eq!(hashed.iter().map(String::as_str).collect::<BTreeSet<_>>(), {
        files.into_iter().chain(["motorcycle-street.glb"]).collect()
    });
    // The same file under another name is another model, and another file under the same name is one too.
    std::fs::rename(place.path("cars/my-car-suv.glb"), place.path("cars/my-car-suw.glb")).unwrap();
    let refused = place.try_run("dataset spec.toml --out d --quiet");
    assert!(String::from_utf8_lossy(&refused.stderr).contains("another recipe"));
    std::fs::rename(place.path("cars/my-car-suw.glb"), place.path("cars/my-car-suv.glb")).unwrap();
    place.run("dataset spec.toml --out d --quiet");
    std::fs::copy(place.path("v/car-hatchback.glb"), place.path("cars/my-car-suv.glb")).unwrap();
    let refused = place.try_run("dataset spec.toml --out d --quiet");
    assert!(String::from_utf8_lossy(&refused.stderr).contains("another recipe"));
}

#[test]
fn an_asset_is_drawn_in_its_own_materials() {
    let place = prepared();
    place.run("vehicles motorcycle-street --out v --quiet");
    let write = |name: &str, mut value: Value| {
        value["metadata"] = serde_json::json!({ "openMaterial3dVersion": "1.0.0" });
        std::fs::write(place.path(name), value.to_string()).unwrap();
    };
    let glb =
        scene::read_mesh(&place.path("v/motorcycle-street.glb"), &scene::MeshOptions { unit_scale: None });
    let names = glb.unwrap().materials;
    let entries: Vec<[&str; 3]> = names.iter().map(|name| [name.as_str(), "m.xomp", "all"]).collect();
    write("v/motorcycle-street.xoma", serde_json::json!({ "materialMappingUri": "m.xomm" }));
    write("v/m.xomm", serde_json::json!({ "materialMapping": entries }));
    let properties = serde_json::json!({ "electromagneticPropertiesUri": "m_emp.xompt" });
    write("v/m.xomp", serde_json::json!({ "materialProperties": properties }));
    let row = serde_json::json!([null, null, null, null, null, 40.0, 60.0]);
    write("v/m_emp.xompt", serde_json::json!({ "electromagneticProperties": [row] }));
    let recipe =
        |ending: &str| format!("{NEEDED}[models]\nmotorcycle = [\"v/motorcycle-street.{ending}\"]\n");
    let asset = made(&place, &recipe("xoma"), "asset");
    let metal = made(&place, &recipe("glb"), "metal");
    let map: String = names.iter().map(|name| format!("{name} = {{ permittivity = [40, 60] }}\n")).collect();
    std::fs::write(place.path("base.toml"), format!("{BASE}[materials]\n{map}")).unwrap();
    let map = made(&place, &recipe("glb"), "map");
    assert!(asset == map && asset != metal && !asset.is_empty());
}

#[test]
fn crosses_are_models_as_any_other_and_their_names_are_those_of_both_families() {
    let place = prepared();
    let models = "[models]\ntruck = [\"truck-fire\", \"crosses\"]\n";
    made(&place, &format!("{NEEDED}{models}"), "d");
    let lines = lines(&place, "d/scenes.jsonl");
    let drawn: Vec<&str> = lines.iter().map(|line| vehicles(line)[0]["model"].as_str().unwrap()).collect();
    assert_eq!(drawn[0], "truck-fire");
    assert!(drawn[1..].iter().all(|model| model.starts_with("truck-") && model.contains('+')), "{drawn:?}");
}

#[test]
fn a_recipe_that_spells_out_the_defaults_draws_the_same_scenes() {
    let place = prepared();
    let short = made(&place, &format!("{NEEDED}{OWN}"), "short");
    let spelt = NEEDED.replace("scene = \"base.toml\"", "scenes = [\"base.toml\"]")
        + "vehicle_seeds = 1\nyaw_deg = [0.0, 0.0]\noffset_m = [0.0, 0.0]\nextra_noise_db = [0.0, 0.0]\nframes = 1\n\
           radar_height_m = [6.0, 6.0]\ntilt_deg = [0.0, 0.0]\nframe_interval_s = 0.5\nvehicles_per_scene = [1, 1]\n\
           queue_share = 0.0\ncrops = true\nscenes_per_shard = 64\n";
    assert!(short == made(&place, &format!("{spelt}{OWN}"), "spelt") && !short.is_empty());
}

#[test]
fn vehicles_of_a_scene_keep_clear_of_one_another_and_each_that_is_found_is_a_sample() {
    let place = prepared();
    let keys =
        "vehicles_per_scene = [2, 3]\nqueue_share = 0.5\nyaw_deg = [-5.0, 5.0]\noffset_m = [-0.3, 0.3]\n";
    let recipe = format!("{NEEDED}{keys}{OWN}").replace("scenes_per_class = 3", "scenes_per_class = 8");
    let samples = made(&place, &recipe, "d");
    let lines = lines(&place, "d/scenes.jsonl");
    for line in &lines {
        let vehicles = vehicles(line);
        assert!((2..=3).contains(&(vehicles.len() + line["left_out"].as_u64().unwrap() as usize)));
        for (i, one) in vehicles.iter().enumerate() {
            for other in &vehicles[..i] {
                let apart = |axis: &str| (one[axis].as_f64().unwrap() - other[axis].as_f64().unwrap()).abs();
                // A motorcycle is longer than 1.7 m: two halves and 1.5 m.
                assert!(apart("x_m") > 1.0 || apart("y_m") > 3.2, "{line}");
            }
            let speed_mps = one["velocity_mps"].as_f64().unwrap().abs();
            assert!(line["is_queue"] == false || speed_mps <= 0.5, "{line}");
        }
    }
    let queues = lines.iter().filter(|line| line["is_queue"] == true).count();
    assert!((1..lines.len()).contains(&queues), "{queues} of {}", lines.len());
    let found = lines.iter().flat_map(vehicles).filter(|vehicle| !vehicle["estimate"].is_null());
    assert!(found.map(|vehicle| vehicle["id"].as_str().unwrap()).eq(samples.iter().map(|s| s.id.as_str())));
    assert!(samples.iter().any(|sample| sample.target > 0));
}

#[test]
fn a_vehicle_moves_on_from_frame_to_frame_and_its_samples_are_a_track() {
    let place = prepared();
    let samples = made(&place, &format!("{NEEDED}frames = 3\ncrops = false\n{OWN}"), "d");
    let of = |frame: u32| samples.iter().find(|s| (s.scene, s.frame) == (samples[0].scene, frame));
    let (first, second) = (of(0).unwrap(), of(1).unwrap());
    assert!((first.range_m + 0.5 * first.radial_velocity_mps - second.range_m).abs() < 0.01);
    assert_eq!((first.target, &first.model, first.split), (second.target, &second.model, second.split));
    assert!(samples.iter().all(|sample| sample.crop.is_none()));
}

#[test]
fn a_dataset_without_images_is_classified_by_signatures_and_neither_exported_nor_classified_as_images() {
    let place = prepared();
    made(&place, &format!("{NEEDED}crops = false\n{OWN}"), "d");
    let model = Workplace::project_file("fixtures/paper-network.model");
    let shipped = Workplace::project_file("fixtures/classifier.model");
    assert_eq!(place.try_run(&format!("classify {shipped} d")).status.code(), Some(0));
    for words in [
        "export d/shard-0000.dataset --to npy --out x.npy".to_owned(),
        "export d/shard-0000.dataset --to png --out x".to_owned(),
        format!("classify {model} d"),
    ] {
        let output = place.try_run(&words);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{words}: {said}");
        assert!(
            said.contains("shard-0000.dataset: sample `scene-0000") && said.contains("crops = false"),
            "{said}"
        );
    }
    assert!(["x.npy", "x.npy.json", "x"].iter().all(|file| !place.path(file).exists()));
}

#[test]
fn a_radar_is_mounted_as_drawn_and_base_scenes_are_mixed() {
    let place = prepared();
    std::fs::write(place.path("wide.toml"), BASE.replace("1x4", "3x4")).unwrap();
    let keys = "radar_height_m = [3.0, 5.0]\ntilt_deg = [-4.0, -2.0]\nextra_noise_db = [1.0, 3.0]\n";
    let several = NEEDED.replace("scene = \"base.toml\"", "scenes = [\"base.toml\", \"wide.toml\"]");
    let samples = made(&place, &format!("{several}{keys}{OWN}"), "d");
    assert!(samples.iter().all(|s| (3.0..=5.0).contains(&s.signature.radar_height_m)));
    let lines = lines(&place, "d/scenes.jsonl");
    let bases: BTreeSet<&str> = lines.iter().map(|line| line["base"].as_str().unwrap()).collect();
    assert_eq!(bases.len(), 2);
    for line in &lines {
        assert!((-4.0..=-2.0).contains(&line["tilt_deg"].as_f64().unwrap()));
        assert!((1.0..=3.0).contains(&line["extra_noise_db"].as_f64().unwrap()));
    }
}

#[test]
fn a_share_of_the_scenes_has_drawn_small_parts_and_everything_else_stays_as_drawn() {
    let place = prepared();
    let with = |share: &str, out: &str| {
        made(&place, &format!("{NEEDED}statistical_share = {share}\n{OWN}"), out);
        lines(&place, &format!("{out}/scenes.jsonl"))
    };
    let [none, some] = [("0.0", "none"), ("0.5", "some")].map(|(share, out)| with(share, out));
    assert!(none.iter().all(|line| line["detail"].is_null()));
    let drawn = some.iter().filter(|line| line["detail"] == "statistical").count();
    assert!(0 < drawn && drawn < some.len(), "{drawn} of {}", some.len());
    for (mesh, line) in none.iter().zip(&some) {
        let truth = |of: &serde_json::Value| of["frames"][0]["vehicles"][0]["range_m"].clone();
        assert_eq!((truth(mesh), &mesh["radar_height_m"]), (truth(line), &line["radar_height_m"]));
        assert!(line["detail"] == "statistical" || mesh["frames"][0]["paths"] == line["frames"][0]["paths"]);
    }
}

#[test]
fn neither_threads_nor_parts_change_a_byte_and_each_kind_is_measured_once_a_shard() {
    let place = prepared();
    let recipe = format!("{NEEDED}scenes_per_shard = 4\nvehicles_per_scene = [1, 2]\n{OWN}");
    std::fs::write(place.path("spec.toml"), recipe).unwrap();
    place.run("dataset spec.toml --out one --threads 1 --quiet");
    place.run("dataset spec.toml --out two --threads 3 --shard 2/2 --quiet");
    assert!(!place.path("two/shard-0000.dataset").exists());
    place.run("dataset spec.toml --out two --threads 3 --shard 1/2 --quiet");
    for file in ["shard-0000.dataset", "shard-0001.dataset"] {
        assert_eq!(place.bytes(&format!("one/{file}")), place.bytes(&format!("two/{file}")), "{file}");
    }
    for shard in ["one/shard-0000.jsonl", "one/shard-0001.jsonl"] {
        let mut measured = BTreeSet::new();
        for line in lines(&place, shard) {
            let vehicles = vehicles(&line);
            let kind = if vehicles.len() > 1 { "several" } else { vehicles[0]["class"].as_str().unwrap() }
                .to_owned();
            let is_first = line["measured_in"] == line["scene"];
            assert_eq!(measured.insert(kind), is_first, "{line}");
        }
    }
}

#[test]
fn shards_of_another_version_of_the_program_are_refused_by_name_and_stay() {
    let place = prepared();
    made(&place, &format!("{NEEDED}scenes_per_shard = 4\ncrops = false\n{OWN}"), "d");
    let shard = place.path("d/shard-0001.dataset");
    let reader = Reader::<Dataset>::open(&shard).unwrap();
    let (mut from, header) = (reader.preamble().provenance.clone(), *reader.header());
    let own = std::mem::replace(&mut from.program_version, "0.1.0".into());
    assert!(own.starts_with("0.1.0+"), "{own}");
    let samples: Vec<Sample> = reader.map(Result::unwrap).collect();
    let mut writer = Writer::<Dataset>::create(&place.path("other"), &from, &header).unwrap();
    samples.iter().for_each(|sample| writer.write(sample).unwrap());
    writer.finish().unwrap();
    std::fs::rename(place.path("other"), &shard).unwrap();
    let before = place.bytes("d/shard-0001.dataset");
    for words in ["", "--conclude"] {
        let output = place.try_run(&format!("dataset spec.toml --out d --quiet {words}"));
        let said = String::from_utf8_lossy(&output.stderr);
        let told = "shard-0001.dataset: was made by another version of the program (0.1.0, this is 0.1.0+";
        assert!(output.status.code() == Some(2) && said.contains(told) && said.contains("--out"), "{said}");
    }
    assert!(place.bytes("d/shard-0001.dataset") == before);
}

/// Schema of shards, one version before.
struct Earlier;

impl Schema for Earlier {
    const NAME: &'static str = Dataset::NAME;
    const VERSION: u32 = Dataset::VERSION - 1;
    type Header = <Dataset as Schema>::Header;
    type Frame = <Dataset as Schema>::Frame;
}

#[test]
fn shards_of_an_earlier_version_of_their_schema_are_refused_by_name_and_stay() {
    let place = prepared();
    made(&place, &format!("{NEEDED}scenes_per_shard = 4\ncrops = false\n{OWN}"), "d");
    let shard = place.path("d/shard-0001.dataset");
    let reader = Reader::<Dataset>::open(&shard).unwrap();
    let (from, header) = (reader.preamble().provenance.clone(), *reader.header());
    drop(reader);
    Writer::<Earlier>::create(&place.path("other"), &from, &header).unwrap().finish().unwrap();
    std::fs::rename(place.path("other"), &shard).unwrap();
    let before = place.bytes("d/shard-0001.dataset");
    for words in ["", "--conclude"] {
        let output = place.try_run(&format!("dataset spec.toml --out d --quiet {words}"));
        let said = String::from_utf8_lossy(&output.stderr);
        let [found, known] = [Earlier::VERSION, Dataset::VERSION];
        let told = format!("`dataset` version {found}; this program reads version {known}; --out takes");
        assert!(output.status.code() == Some(2) && said.contains(&told), "{said}");
    }
    assert!(place.bytes("d/shard-0001.dataset") == before);
}

#[test]
fn a_changed_digit_of_a_shards_lines_counts_as_not_made() {
    let place = prepared();
    made(&place, &format!("{NEEDED}crops = false\n{OWN}"), "d");
    let whole = place.bytes("d/shard-0000.jsonl");
    let text = String::from_utf8(whole.clone()).unwrap();
    let at = text.find("\"range_m\":").unwrap() + "\"range_m\":".len();
    let digit = if text[at..].starts_with('3') { "4" } else { "3" };
    std::fs::write(place.path("d/shard-0000.jsonl"), format!("{}{digit}{}", &text[..at], &text[at + 1..]))
        .unwrap();
    let refused = place.try_run("dataset spec.toml --out d --quiet --conclude");
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("shard-0000.jsonl: not made yet or damaged"));
    let told = place.path("d").join("scenes.jsonl");
    let scenes = std::fs::read(&told).unwrap();
    let again = place.try_run("dataset spec.toml --out d");
    assert!(String::from_utf8_lossy(&again.stderr).contains("made anew: d/shard-0000.jsonl"));
    assert!(place.bytes("d/shard-0000.jsonl") == whole && std::fs::read(&told).unwrap() == scenes);
    assert!(!String::from_utf8(scenes).unwrap().contains("checksum"), "it is of the lines beside a shard");
}

/// Keys that a recipe has beside the needed ones, and how it is refused.
const REFUSED_KEYS: [(&str, &str); 17] = [
    ("scenes = [\"base.toml\"]", "spec.toml:7:10: `scene` and `scenes` exclude one another"),
    ("yaw_deg = [5.0, -5.0]", "spec.toml:7:11: `yaw_deg` must be [least, greatest], is [5, -5]"),
    ("offset_m = [0.0, nan]", "7:18: `offset_m` must be a number from -100 to 100, is NaN"),
    ("radar_height_m = [0.0, 5.0]", "7:19: `radar_height_m` must be a number above 0, up to 1000"),
    ("offset_m = [50.0, 60.0]", "4:11: `range_m` must reach beyond 52.35 m, the nearest that"),
    ("tilt_deg = [-4.0, -2.0, 0.0]", "7:12: `tilt_deg` must have 2 values, has 3"),
    ("vehicles_per_scene = [1, 2, 3]", "7:22: `vehicles_per_scene` must have 2 values, has 3"),
    ("yaw_deg = [1.0]", "`yaw_deg` must have 2 values, has 1"),
    ("vehicle_seeds = 18446744073709551615", "7:17: `vehicle_seeds` must be a number from 1 to"),
    ("frames = 0", "7:10: `frames` must be a number from 1 to 1000, is 0"),
    ("frame_interval_s = 1e-6", "7:20: `frame_interval_s` must be 0."),
    ("frame_interval_s = -1.0", "`frame_interval_s` must be a number above 0, up to 10000, is -1"),
    ("vehicles_per_scene = [2, 1]", "`vehicles_per_scene` must be [least, greatest], is [2, 1]"),
    ("queue_share = 1.5", "7:15: `queue_share` must be a number from 0 to 1, is 1.5"),
    ("scenes_per_shard = 0", "7:20: `scenes_per_shard` must be a number from 1 to"),
    ("crop = true", "7:1: unknown key `crop`; the nearest is `crops`"),
    ("car = [\"car-suv\"]", "7:1: unknown key `car` here; it belongs into [models]"),
];

/// Parts of the needed keys, what stands in their place, and how the recipe is refused.
const REFUSED_CHANGES: [(&str, &str, &str); 7] = [
    ("scene = \"base.toml\"", "", "spec.toml:1:1: `scene` or `scenes` is missing: name"),
    ("seed = 1", "", "spec.toml:1:1: key `seed` is missing"),
    ("[models]", "", "key `models` is missing"),
    (
        "seed = 1",
        "seed = 9223372036854775808",
        "2:8: `seed` must be a whole number up to 9223372036854775807",
    ),
    ("lanes = [1, 2]", "lanes = [1, 9]", "6:13: `lanes`: base.toml has no lane 9; it has 1, 2, 3"),
    (
        "scene = \"base.toml\"",
        "extra_noise_db = [0.0, 3.0]\nscene = \"silent.toml\"",
        "1:18: `extra_noise_db`: silent.toml has no noise",
    ),
    (
        "base",
        "pair",
        "spec.toml:1:9: `scene`: pair.toml has several radars ([[radars]]: left, right), and a recipe takes \
         scenes of one; name a copy of it without [[radars]]",
    ),
];

/// Models of a recipe, and how it is refused.
const REFUSED_MODELS: [(&str, &str); 9] = [
    ("", "[models]: name at least one of a class"),
    ("car = []", "8:7: [models]: `car` must be a text or a list of texts in quotes, is an empty list"),
    ("car = [\"car-suv\", 3]", "8:19: [models]: `car` must be a list of texts in quotes, is a whole number"),
    ("van = [\"car-van\"]", "8:1: [models]: unknown key `van`"),
    ("car = [\"bus-mini\"]", "8:8: [models]: `car`: `bus-mini` is a bus"),
    ("car = [\"bmw\"]", "[models]: `car`: `bmw` is no mesh file"),
    ("car = [\"empty\"]", "[models]: `car`: `empty`: the folder holds no .glb"),
    (
        "vehicles = \"up\"",
        "spec.toml: up/manifest.toml:2:8: [vehicle]: `name` must be that of a .glb in this",
    ),
    ("car = [\"car-hatchback\", \"car-hatchback.obj\"]", "[models]: `car`: two different models"),
];

#[test]
fn a_recipe_that_breaks_a_rule_is_refused_with_file_place_key_and_rule() {
    let place = prepared();
    std::fs::write(place.path("silent.toml"), BASE.replace("[noise]\nnoise_figure_db = 12.0\n", "")).unwrap();
    let pair = format!("{BASE}[[radars]]\nid = \"left\"\n[[radars]]\nid = \"right\"\n");
    std::fs::write(place.path("pair.toml"), pair).unwrap();
    std::fs::create_dir(place.path("empty")).unwrap();
    std::fs::create_dir(place.path("up")).unwrap();
    std::fs::write(place.path("up/manifest.toml"), "[[vehicle]]\nname = \"../x\"\nclass = \"car\"\n")
        .unwrap();
    std::fs::write(place.path("car-hatchback.obj"), crate::common::CORNER).unwrap();
    let keys = REFUSED_KEYS.map(|(keys, said)| (format!("{NEEDED}{keys}\n{OWN}"), said));
    let changes = REFUSED_CHANGES.map(|(from, to, said)| (format!("{NEEDED}{OWN}").replace(from, to), said));
    let models = REFUSED_MODELS.map(|(models, said)| (format!("{NEEDED}[models]\n{models}\n"), said));
    for (text, said) in keys.into_iter().chain(changes).chain(models) {
        std::fs::write(place.path("spec.toml"), &text).unwrap();
        let output = place.try_run("dataset spec.toml --out d --quiet");
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(1) && told.contains(said), "{text}\n{told}\nnot: {said}");
        assert!(!place.path("d").exists());
    }
}

#[test]
fn all_rules_that_a_recipe_breaks_are_told_at_once_each_with_line_and_column() {
    let place = prepared();
    let text = "scene = \"base.toml\"\nseed = -1\nscenes_per_clas = 3\nrange_m = [25.0, 4.0]\n\
                speed_mps = [1.0]\nlanes = [1, 7]\nqueue_share = \"half\"\nextra_noise_db = [0, 900]\n\
                [models]\ncar = [\"car-suv\", \"bus-mini\"]\nlorry = [\"truck-box\"]\n";
    std::fs::write(place.path("spec.toml"), text).unwrap();
    let output = place.try_run("dataset spec.toml --out d --quiet");
    let told = String::from_utf8_lossy(&output.stderr);
    let broken = [
        "spec.toml:1:1: key `scenes_per_class` is missing",
        "spec.toml:2:8: `seed` must be a number from 0 to",
        "spec.toml:3:1: unknown key `scenes_per_clas`; the nearest is `scenes_per_class`",
        "spec.toml:4:11: `range_m` must be [least, greatest], is [25, 4]",
        "spec.toml:5:13: `speed_mps` must have 2 values, has 1",
        "spec.toml:6:13: `lanes`: base.toml has no lane 7; it has 1, 2, 3",
        "spec.toml:7:15: `queue_share` must be a number, is a text",
        "spec.toml:8:22: `extra_noise_db` must be a number from -100 to 100, is 900",
        "spec.toml:10:19: [models]: `car`: `bus-mini` is a bus",
        "spec.toml:11:1: [models]: unknown key `lorry`",
    ];
    let lines: Vec<&str> = told.lines().filter(|line| line.contains("spec.toml:")).collect();
    assert_eq!(lines.len(), broken.len(), "{told}");
    for (line, said) in lines.iter().zip(broken) {
        assert!(line.contains(said), "{line}\nnot: {said}");
    }
    assert!(output.status.code() == Some(1) && !place.path("d").exists(), "{told}");
}

#[test]
fn what_a_recipe_names_is_refused_with_the_recipe_and_what_is_missing_is_the_systems_fault() {
    let place = prepared();
    std::fs::write(place.path("broken.toml"), "name = 3\n").unwrap();
    std::fs::write(place.path("broken.obj"), "v 0\n").unwrap();
    let of_scene = |scene: &str| format!("{NEEDED}{OWN}").replace("base.toml", scene);
    let of_models = |models: &str| format!("{NEEDED}[models]\n{models}\n");
    for (recipe, code, said) in [
        (of_scene("/gone/base.toml"), 2, "spec.toml: /gone/base.toml: cannot be read"),
        (of_scene("broken.toml"), 1, "spec.toml: broken.toml:1:8: "),
        (of_models("car = [\"gone.glb\"]"), 2, "spec.toml: gone.glb: "),
        (of_models("car = [\"broken.obj\"]"), 1, "spec.toml: broken.obj:1: "),
        (of_models("vehicles = \"gone\""), 2, "spec.toml: gone/manifest.toml: cannot be read"),
    ] {
        std::fs::write(place.path("spec.toml"), &recipe).unwrap();
        let output = place.try_run("dataset spec.toml --out d --quiet");
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(code) && told.contains(said), "{recipe}\n{told}\nnot: {said}");
    }
}
