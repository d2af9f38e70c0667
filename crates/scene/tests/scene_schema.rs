//! The schema of scene files and the reader agree: on the project's scenes, on both ends of every range, and
//! on what a key means that is left out.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use scene::{ReadOptions, Rule};
use serde_json::Value;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// What a table says beside the key that is looked at; of several lines of a table the first that has the
/// key. A table without a line says nothing else.
const BESIDE: &[(&str, &[&str], &str)] = &[
    ("", &[], ""),
    ("noise", &["snr_db"], "[noise]\n"),
    ("noise", &[], "[noise]\nnoise_figure_db = 12\n"),
    ("radar.array", &["tx_half_wavelengths"], "[radar.array]\nrx_half_wavelengths = [[0, 0]]\n"),
    ("radar.array", &["rx_half_wavelengths"], "[radar.array]\ntx_half_wavelengths = [[0, 0]]\n"),
    ("radar.array", &["cosine_exponent"], "[radar.array]\npattern = \"cosine\"\n"),
    ("radar.array", &[], "[radar.array]\npreset = \"1x1\"\n"),
    ("radar.interferer", &[], "[[radar.interferer]]\nposition_m = [0, 80, 1]\neirp_dbm = 30\n"),
    ("radars", &[], "[[radars]]\nid = \"a\"\n"),
    ("materials", &["permittivity"], "[materials.paint]\nthickness_mm = 5\n"),
    ("materials", &[], "[materials.paint]\nsubstance = \"glass\"\nthickness_mm = 5\n"),
    ("materials.layers", &["permittivity"], "[[materials.paint.layers]]\nthickness_mm = 5\n"),
    ("materials.layers", &[], "[[materials.paint.layers]]\nsubstance = \"glass\"\nthickness_mm = 5\n"),
    ("road", &["permittivity"], "[road]\n"),
    ("road", &[], "[road]\nbackscatter = \"floor\"\n"),
    ("target", &["lane"], "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1\ny_m = 30\n"),
    ("target", &["y_m"], "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1\nlane = 2\n"),
    ("target", &["rcs_m2", "wheel_radius_m", "wheel_angle_deg"], WHEEL),
    (
        "target",
        &["unit_scale"],
        "[[target]]\nkind = \"mesh\"\nid = \"p\"\nposition_m = [2, 30, 1]\nmodel = \"a.obj\"\n",
    ),
    (
        "target",
        &[],
        "[[target]]\nkind = \"mesh\"\nid = \"p\"\nposition_m = [2, 30, 1]\nmodel = \"car-suv\"\n",
    ),
    ("clutter", &["length_m"], "[[clutter]]\nid = \"k\"\nposition_m = [2, 30, 0]\nmodel = \"kerb\"\n"),
    ("clutter", &["unit_scale"], "[[clutter]]\nid = \"k\"\nposition_m = [2, 30, 0]\nmodel = \"a.obj\"\n"),
    ("clutter", &[], "[[clutter]]\nid = \"k\"\nposition_m = [2, 30, 0]\nmodel = \"pole\"\n"),
    ("traffic", &[], "[traffic]\nfcd = \"t.fcd.xml\"\n"),
    (
        "traffic.models",
        &["unit_scale"],
        "[traffic]\nfcd = \"t.fcd.xml\"\n[traffic.models.car]\nmodel = \"a.obj\"\n",
    ),
    ("traffic.models", &[], "[traffic]\nfcd = \"t.fcd.xml\"\n[traffic.models.car]\nmodel = \"car-suv\"\n"),
];

/// A point on a wheel.
const WHEEL: &str =
    "[[target]]\nkind = \"point\"\nid = \"p\"\nposition_m = [2, 30, 1]\nrcs_m2 = 1\nwheel_radius_m = 0.3\n";

/// A scene that has the table, and can have the key, which it leaves out.
fn beside(table: &str, key: &str) -> String {
    let fits =
        |(name, keys, _): &&(&str, &[&str], &str)| *name == table && (keys.is_empty() || keys.contains(&key));
    let told =
        BESIDE.iter().find(fits).map(|(.., text)| (*text).to_owned()).unwrap_or(format!("[{table}]\n"));
    let others = told.lines().filter(|line| !line.starts_with(&format!("{key} = ")));
    let others: String = others.map(|line| format!("{line}\n")).collect();
    if key == "name" && table.is_empty() { others } else { format!("name = \"s\"\n{others}") }
}

/// The tables of a schema, the file itself first, under an empty name.
fn tables(schema: &Value) -> Vec<(&str, &Value)> {
    let below = schema["definitions"].as_object().unwrap().iter().map(|(name, table)| (name.as_str(), table));
    std::iter::once(("", schema)).chain(below).collect()
}

/// Says what is wrong with a value by the schema; `None` where it is right.
fn wrong(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    if let Some(name) = schema["$ref"].as_str() {
        return wrong(root, &root["definitions"][name.trim_start_matches("#/definitions/")], value, at);
    }
    if let Some(any) = schema["anyOf"].as_array() {
        let wrongs: Option<Vec<String>> = any.iter().map(|one| wrong(root, one, value, at)).collect();
        return wrongs.map(|all| all.join(" or "));
    }
    let is_right = match schema["type"].as_str().unwrap() {
        "object" => return wrong_table(root, schema, value, at),
        "array" => return wrong_list(root, schema, value, at),
        "string" => value.as_str().is_some_and(|text| is_text(schema, text)),
        "boolean" => value.is_boolean(),
        "integer" => value.as_number().is_some_and(|n| !n.is_f64()) && is_in_range(schema, value),
        "number" => value.is_number() && is_in_range(schema, value),
        other => panic!("{at}: type {other}"),
    };
    (!is_right).then(|| format!("{at}: {value} is not {schema}"))
}

fn wrong_table(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    let Some(table) = value.as_object() else { return Some(format!("{at}: no table")) };
    let required = schema["required"].as_array().into_iter().flatten();
    let missing = required.filter_map(Value::as_str).find(|key| !table.contains_key(*key));
    let in_table = |(key, value): (&String, &Value)| {
        let known = schema["properties"].get(key).unwrap_or(&schema["additionalProperties"]);
        let place = format!("{at}/{key}");
        if known.is_boolean() { Some(format!("{place}: unknown")) } else { wrong(root, known, value, &place) }
    };
    missing.map(|key| format!("{at}: {key} is missing")).or_else(|| table.iter().find_map(in_table))
}

fn wrong_list(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    let Some(list) = value.as_array() else { return Some(format!("{at}: no list")) };
    let (least, most) =
        (schema["minItems"].as_u64().unwrap_or(0), schema["maxItems"].as_u64().unwrap_or(1 << 30));
    if !(least..=most).contains(&(list.len() as u64)) {
        return Some(format!("{at}: {} values", list.len()));
    }
    let of = |i: usize| schema["items"].as_array().map_or(&schema["items"], |items| &items[i]);
    list.iter().enumerate().find_map(|(i, value)| wrong(root, of(i), value, &format!("{at}/{i}")))
}

fn is_text(schema: &Value, text: &str) -> bool {
    let is_word = schema["enum"].as_array().is_none_or(|words| words.iter().any(|word| word == text));
    // The two patterns that there are.
    let matches = match schema["pattern"].as_str() {
        Some("^chebyshev-") => text.starts_with("chebyshev-"),
        other => other.is_none_or(|pattern| is_without(pattern, text)),
    };
    is_word && matches
}

/// Whether a text matches `^[^…][^…]*$`: excluded characters of the first place, and of all others.
fn is_without(pattern: &str, text: &str) -> bool {
    let classes = pattern.strip_prefix("^[^").and_then(|rest| rest.strip_suffix("]*$")).unwrap();
    let (first, others) = classes.split_once("][^").unwrap();
    let is_of = |class: &str, c: char| ranges(class).iter().any(|(low, high)| (*low..=*high).contains(&c));
    let mut characters = text.chars();
    characters.next().is_some_and(|c| !is_of(first, c)) && characters.all(|c| !is_of(others, c))
}

/// First and last character of each range of a class of a regular expression.
fn ranges(class: &str) -> Vec<(char, char)> {
    let (mut ranges, mut is_open, mut rest) = (vec![], false, class.chars());
    while let Some(written) = rest.next() {
        let c = match written {
            '-' => {
                is_open = true;
                continue;
            }
            '\\' => match rest.next().unwrap() {
                'u' => {
                    let digits: String = rest.by_ref().take(4).collect();
                    char::from_u32(u32::from_str_radix(&digits, 16).unwrap()).unwrap()
                }
                other => other,
            },
            other => other,
        };
        match ranges.last_mut() {
            Some((_, high)) if is_open => *high = c,
            _ => ranges.push((c, c)),
        }
        is_open = false;
    }
    ranges
}

fn is_in_range(schema: &Value, value: &Value) -> bool {
    let (value, bound) = (value.as_f64().unwrap(), |name: &str| schema[name].as_f64());
    bound("minimum").is_none_or(|least| value >= least)
        && bound("maximum").is_none_or(|most| value <= most)
        && bound("exclusiveMinimum").is_none_or(|least| value > least)
        && bound("exclusiveMaximum").is_none_or(|most| value < most)
}

fn as_json(text: &str) -> Value {
    toml::from_str(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Without opening what it names, through the only radar of its list.
fn read(text: &str) -> Result<artifact::scene::SceneHeader, scene::SceneErrors> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("s.toml");
    std::fs::write(&file, text).unwrap();
    let radar = text.contains("[[radars]]").then(|| "a".to_owned());
    scene::read(&file, &ReadOptions { radar, ..ReadOptions::names_only() })
}

/// Scenes of a folder, not files of materials nor recipes of training.
fn scenes(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_scene = |file: &PathBuf| {
        let name = file.file_name().unwrap().to_string_lossy().into_owned();
        name.ends_with(".toml") && !name.ends_with(".materials.toml") && !name.ends_with(".dataset.toml")
    };
    files.filter(is_scene).collect()
}

#[test]
fn every_scene_of_the_project_is_one_by_the_schema() {
    let schema = scene::keys::json_schema();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let scenes = [scenes(&folder), scenes(&folder.join("training"))].concat();
    println!("{} scenes", scenes.len());
    for file in scenes {
        let text = std::fs::read_to_string(&file).unwrap();
        assert_eq!(wrong(&schema, &schema, &as_json(&text), ""), None, "{}", file.display());
    }
}

#[test]
fn what_no_scene_may_say_is_refused_by_the_schema() {
    let schema = scene::keys::json_schema();
    let broken = [
        "seed = 1\n",
        "name = \"\"\n",
        "name = \".hidden\"\n",
        "name = \" a\"\n",
        "name = \"a/b\"\n",
        "name = \"s\"\nfrmes = 2\n",
        "name = \"s\"\nframes = 2.5\n",
        "name = \"s\"\nradar = 3\n",
        "name = \"s\"\n[target]\nid = \"p\"\n",
        "name = \"s\"\n[[target]]\nid = \"p\"\n",
        "name = \"s\"\n[radar]\nposition_m = [0, 6]\n",
        "name = \"s\"\n[dsp]\nrange_window = \"kaiser\"\n",
        "name = \"s\"\n[dsp]\ndetector = \"cfar\"\n",
        "name = \"s\"\n[radar.receiver]\nphase_noise_dbc_hz = [[1e5, 3]]\n",
        "name = \"s\"\n[materials]\npaint = { colour = \"red\" }\n",
        "name = \"s\"\n[traffic]\nfcd = \"f\"\nmodels = { car = [] }\n",
    ];
    for text in broken {
        assert!(wrong(&schema, &schema, &as_json(text), "").is_some(), "{text}");
        assert!(read(text).is_err(), "{text}");
    }
}

#[test]
fn a_name_is_refused_by_the_schema_only_where_the_reader_refuses_it_and_in_ascii_always_there() {
    let schema = scene::keys::json_schema();
    for c in (0..0x250).filter_map(char::from_u32) {
        for name in [format!("{c}a"), format!("a{c}")] {
            let is_read = read(&format!("name = {}\n", Value::from(name.as_str()))).is_ok();
            let is_allowed = is_text(&schema["properties"]["name"], &name);
            assert!(if c.is_ascii() { is_read == is_allowed } else { !is_read || is_allowed }, "{name:?}");
        }
    }
}

/// Every number that a schema bounds: how it is written, `@` in its place, and its bounds.
fn numbers(schema: &Value, written: &str) -> Vec<(String, Value)> {
    let items = &schema["items"];
    if let Some(first) = schema["anyOf"].get(0) {
        return numbers(first, written); // of a pole's height
    }
    match schema["type"].as_str() {
        Some("number" | "integer") => vec![(written.to_owned(), schema.clone())],
        Some("array") if items.is_array() => {
            let sound: Vec<String> =
                items.as_array().unwrap().iter().map(|item| inside(item).to_string()).collect();
            let place = |i: usize| {
                let mut parts = sound.clone();
                parts[i] = "@".to_owned();
                numbers(&items[i], &written.replace('@', &format!("[{}]", parts.join(", "))))
            };
            (0..sound.len()).flat_map(place).collect()
        }
        Some("array") => {
            let count = schema["minItems"].as_u64().unwrap_or(1).max(1) as usize;
            let mut parts = vec!["0".to_owned(); count];
            parts[0] = "@".to_owned();
            numbers(items, &written.replace('@', &format!("[{}]", parts.join(", "))))
        }
        _ => vec![],
    }
}

/// A number in the range.
fn inside(schema: &Value) -> f64 {
    let low = schema["minimum"].as_f64().or(schema["exclusiveMinimum"].as_f64()).unwrap();
    let high = schema["maximum"].as_f64().or(schema["exclusiveMaximum"].as_f64()).unwrap();
    0.5 * (low + high)
}

/// Numbers at the ends of the range and next to them, as TOML. A whole number has its neighbour one further,
/// or where that is no other number to the reader the next that is.
fn ends(schema: &Value) -> Vec<String> {
    let whole = schema["type"] == "integer";
    let bounds = ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"];
    let near = |end: f64| match whole {
        true => [end, end.next_down().min(end - 1.0), end.next_up().max(end + 1.0)],
        false => [end, end.next_down(), end.next_up()],
    };
    let ends = bounds.iter().filter_map(|name| schema[name].as_f64()).flat_map(near);
    ends.map(|end| if whole { format!("{end:.0}") } else { format!("{end:?}") }).collect()
}

#[test]
fn the_bounds_of_the_schema_are_those_of_the_reader() {
    let schema = scene::keys::json_schema();
    let mut asked = 0;
    for (table, of_table) in tables(&schema) {
        for (key, of_key) in of_table["properties"].as_object().unwrap() {
            for (written, number) in numbers(of_key, "@") {
                for value in ends(&number) {
                    asked += 1;
                    let text = format!("{}{key} = {}\n", beside(table, key), written.replace('@', &value));
                    let refused = read(&text).err().is_some_and(|errors| {
                        let is_it = |rule: &Rule| matches!(rule, Rule::OutOfRange { key: k, .. } if k == key);
                        errors.0.iter().any(|error| is_it(&error.rule))
                    });
                    let value: f64 = value.parse().unwrap();
                    assert_eq!(refused, !is_in_range(&number, &value.into()), "{text}{number}");
                }
            }
        }
    }
    println!("{asked} numbers");
    assert!(asked > 400, "{asked}");
}

#[test]
fn a_default_that_is_written_out_changes_nothing() {
    let schema = scene::keys::json_schema();
    let mut asked = String::new();
    for (table, of_table) in tables(&schema) {
        for (key, of_key) in of_table["properties"].as_object().unwrap() {
            let Some(default) = of_key.get("default") else { continue };
            let without = beside(table, key);
            let with = format!("{without}{key} = {default}\n");
            let read = |text: &str| read(text).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
            assert!(read(&with) == read(&without), "{with}");
            write!(asked, " {key}").unwrap();
        }
    }
    println!("{}:{asked}", asked.split(' ').count() - 1);
}

#[test]
fn a_key_that_the_schema_requires_the_reader_misses() {
    let schema = scene::keys::json_schema();
    for (table, of_table) in tables(&schema) {
        for key in of_table["required"].as_array().unwrap().iter().map(|key| key.as_str().unwrap()) {
            let text = beside(table, key);
            let missed = read(&text).err().is_some_and(|errors| {
                errors.0.iter().any(|error| matches!(error.rule, Rule::Missing { key: k } if k == key))
            });
            assert!(missed, "{table}: {key}\n{text}");
            assert!(wrong(&schema, &schema, &as_json(&text), "").is_some(), "{text}");
        }
    }
}
