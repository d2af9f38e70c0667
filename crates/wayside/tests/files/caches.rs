//! A cache is known by its mark and its files by their names; what is damaged is named and made anew.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::Workplace;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

const TAG: &str = "Signature: 8a477f597d28d172789f06886806bc55";

/// Every file below a folder, links not followed.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = vec![];
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        match entry.file_type().unwrap().is_dir() {
            true => found.extend(files(&entry.path())),
            false => found.push(entry.path()),
        }
    }
    found.sort();
    found
}

fn said(output: &std::process::Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A folder of the user's that has the names of stages in it.
fn sources(place: &Workplace) {
    for file in [
        "cache/scene/src/lib.rs",
        "cache/dsp/ab/notes.txt",
        "cache/classifier/Cargo.toml",
        "cache/seconds.json",
    ] {
        std::fs::create_dir_all(place.path(file).parent().unwrap()).unwrap();
        std::fs::write(place.path(file), "mine").unwrap();
    }
}

#[test]
fn a_folder_without_the_mark_is_neither_cleared_nor_used() {
    let place = Workplace::new();
    sources(&place);
    for words in
        ["cache --clear", "cache", "run small.toml --out a --quiet", "run small.toml --dry-run --quiet"]
    {
        let output = place.try_run(words);
        assert_eq!(output.status.code(), Some(2), "{words}: {}", said(&output));
        assert!(said(&output).contains("no CACHEDIR.TAG"), "{words}: {}", said(&output));
    }
    assert_eq!(files(&place.path("cache")).len(), 4);
    assert!(!place.path("a").exists());
}

#[test]
fn a_dry_run_leaves_the_scene_and_the_machine_s_speed_in_the_cache_and_nothing_else() {
    let place = Workplace::new();
    place.run("run small.toml --out a --dry-run --quiet");
    let left = files(&place.path("cache"));
    let mut kinds: Vec<&str> = left.iter().filter_map(|file| file.extension()?.to_str()).collect();
    kinds.sort_unstable();
    assert_eq!(kinds, ["TAG", "scene", "speed"], "{left:?}");
    assert!(!place.path("a").exists());
}

/// A folder of the cache's own naming (two digits of a key) that no entry of it lies in.
fn free_folder(stage: &Path) -> PathBuf {
    (0..=u8::MAX).map(|digits| stage.join(format!("{digits:02x}"))).find(|folder| !folder.exists()).unwrap()
}

#[test]
fn only_files_with_the_names_of_a_cache_are_removed_from_one() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    assert!(place.bytes("cache/CACHEDIR.TAG").starts_with(TAG.as_bytes()));
    // The user's own files in it, and links out of it.
    let own = files(&place.path("cache"))
        .into_iter()
        .find(|file| file.extension().is_some_and(|e| e == "cube"))
        .unwrap();
    let name = own.file_name().unwrap().to_str().unwrap().replace(".cube", ".rdm");
    std::fs::create_dir_all(place.path("mine/aa")).unwrap();
    std::fs::write(place.path("mine/aa").join(&name), "mine").unwrap();
    std::fs::write(place.path("mine/file"), "mine").unwrap();
    std::fs::write(place.path("cache/dsp/notes.txt"), "mine").unwrap();
    std::fs::write(place.path("cache/README"), "mine").unwrap();
    std::fs::write(own.with_file_name("thesis.cube"), "mine").unwrap();
    let linked = free_folder(&place.path("cache/dsp"));
    symlink(place.path("mine"), &linked).unwrap();
    symlink(place.path("mine"), place.path("cache/mine")).unwrap();
    symlink(place.path("mine/file"), own.with_file_name(&name)).unwrap();
    for words in ["run small.toml --out b --quiet --cache-limit-mib 0", "cache --clear"] {
        place.run(words);
    }
    let in_cache = |file: &Path| file.strip_prefix(place.path("cache")).unwrap().display().to_string();
    let mut left: Vec<String> = files(&place.path("cache")).iter().map(|file| in_cache(file)).collect();
    left.retain(|file| !file.contains(&name));
    let (linked, beside) = (in_cache(&linked), in_cache(&own.with_file_name("thesis.cube")));
    assert_eq!(left, ["CACHEDIR.TAG", "README", &linked, "dsp/notes.txt", &beside, "mine"]);
    assert_eq!(place.bytes("mine/file"), b"mine");
    assert_eq!(place.bytes(&format!("mine/aa/{name}")), b"mine");
}

#[test]
fn a_cache_of_an_earlier_version_has_no_mark_and_gets_one() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    std::fs::remove_file(place.path("cache/CACHEDIR.TAG")).unwrap();
    std::fs::write(place.path("cache/seconds.json"), "{}").unwrap();
    let entry = files(&place.path("cache"))
        .into_iter()
        .find(|file| file.extension().is_some_and(|e| e == "cube"))
        .unwrap();
    std::fs::write(entry.with_extension("json"), "[[0.25,0.25,0.25,0.25]]").unwrap();
    let left = format!(".{}.aB3dE6.part", entry.file_name().unwrap().to_str().unwrap());
    std::fs::write(entry.with_file_name(left), "half").unwrap();
    place.run("cache");
    std::fs::write(place.path("small.toml"), crate::common::SMALL_SCENE.replace("seed = 3", "seed = 4"))
        .unwrap();
    place.run("run small.toml --out b --quiet");
    assert!(place.path("cache/CACHEDIR.TAG").is_file());
    place.run("cache --clear");
    let left = files(&place.path("cache"));
    assert!(
        left.iter().all(|file| file.ends_with("CACHEDIR.TAG") || file.extension().unwrap() == "part"),
        "{left:?}"
    );
}

#[test]
fn a_cache_and_the_results_are_two_folders() {
    let place = Workplace::new();
    let output = place.try_run("run small.toml --out cache --quiet");
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(!place.path("cache").exists());
}

#[test]
fn damaged_classes_are_named_and_made_anew() {
    let place = Workplace::new();
    let classified = |out: &str| {
        let output = place.try_run(&format!("run small.toml --out {out}"));
        assert!(output.status.success(), "{}", said(&output));
        (place.summary(&format!("{out}/summary.json"))["frames"][0]["targets"].clone(), said(&output))
    };
    let (right, _) = classified("a");
    let entries = files(&place.path("cache/classifier"));
    let classes: Vec<_> =
        entries.iter().filter(|file| file.extension().is_some_and(|e| e == "classes")).collect();
    assert!(!classes.is_empty(), "classes are kept: {entries:?}");
    for entry in &classes {
        let whole = std::fs::read(entry).unwrap();
        // One bit of a probability.
        let mut bytes = whole.clone();
        let at = whole.len() - 30;
        bytes[at] ^= 0x10;
        std::fs::write(entry, bytes).unwrap();
    }
    let (again, said) = classified("b");
    assert_eq!(again, right);
    for entry in classes {
        assert!(said.contains(entry.file_name().unwrap().to_str().unwrap()), "{}: {said}", entry.display());
    }
}

#[test]
fn an_entry_under_another_key_is_not_believed() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    let cubes: Vec<PathBuf> = files(&place.path("cache"))
        .into_iter()
        .filter(|file| file.extension().is_some_and(|e| e == "cube"))
        .collect();
    std::fs::copy(&cubes[0], &cubes[1]).unwrap();
    let output = place.try_run("run small.toml --out b");
    assert!(output.status.success() && said(&output).contains("of another key"), "{}", said(&output));
    assert_eq!(place.bytes("a/frames.cube"), place.bytes("b/frames.cube"));
}

#[test]
fn what_dead_runs_left_in_a_cache_goes_with_the_next_run() {
    let place = Workplace::new();
    place.run("run small.toml --out a --quiet");
    let entry = files(&place.path("cache"))
        .into_iter()
        .find(|file| file.extension().is_some_and(|e| e == "cube"))
        .unwrap();
    let left = [
        entry.with_file_name(".x.cube.aB3dE6.wayside.part"),
        place.path("a/.frames.cube.aB3dE6.wayside.part"),
    ];
    // Their names tell no machine: they are taken for a dead writer's after a day without a byte.
    let long_ago = std::time::SystemTime::now() - std::time::Duration::from_secs(2 * 24 * 3600);
    for file in &left {
        std::fs::write(file, "half").unwrap();
        std::fs::File::options().write(true).open(file).unwrap().set_modified(long_ago).unwrap();
    }
    place.run("run small.toml --out a --quiet");
    left.iter().for_each(|file| assert!(!file.exists(), "{}", file.display()));
}

#[test]
fn without_a_home_nothing_is_cached_and_that_is_said() {
    let place = Workplace::new();
    let without_home = |words: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_wayside"));
        command.args(words.split(' ')).current_dir(place.root());
        for variable in ["HOME", "XDG_CACHE_HOME", "WAYSIDE_PROJECT"] {
            command.env_remove(variable);
        }
        let output = command.output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let why = "neither XDG_CACHE_HOME nor HOME names a folder; --cache DIR takes one";
    let (code, said) = without_home("run small.toml --out a");
    assert_eq!((code, said.matches(why).count()), (Some(0), 1), "{said}");
    assert!(!place.path(".cache").exists(), "the folder of the command is not the user's cache");
    let (code, said) = without_home("cache");
    assert_eq!((code, said.matches(why).count()), (Some(2), 1), "{said}");
    let (code, said) = without_home("run small.toml --out a --cache c");
    assert!(code == Some(0) && !said.contains(why) && place.path("c").exists(), "{said}");
}

/// A scene through two radars, and a study of the small one.
const TWO_RADARS: &str = "name = \"two\"\n[[radars]]\nid = \"north\"\n[[radars]]\nid = \"east\"\n";
const STUDY: &str = "scene = \"small.toml\"\n[[vary]]\nkey = \"radar.array.preset\"\nvalues = [\"1x4\"]\n\
                     [goal]\nmetric = \"coverage\"\n";

#[test]
fn a_folder_that_results_go_into_is_no_cache_whichever_command_writes_them() {
    let place = Workplace::new();
    std::fs::write(place.path("two.toml"), TWO_RADARS).unwrap();
    std::fs::write(place.path("study.toml"), STUDY).unwrap();
    std::fs::create_dir(place.path("there")).unwrap();
    symlink(place.path("there"), place.path("link")).unwrap();
    for (words, cache) in [
        ("sweep study.toml --out x", "x"),
        ("sweep study.toml --out x", "./x"),
        ("sweep study.toml --out x", "x/runs"),
        ("run two.toml --out x", "x"),
        ("run two.toml --out x", "x/north"),
        ("run two.toml --out x", "x/east/pictures"),
        ("run two.toml --radar east", "out/two/east"),
        ("run small.toml --out x", "./x"),
        ("run small.toml --out there/x", "link/x"),
        ("run small.toml", "out/small"),
        // Clearing the cache took this run's summary for a file of its own.
        ("run small.toml --out x/dsp/last", "x"),
        ("run small.toml --out there/x/deep/er", "link/x"),
        ("sweep study.toml --out x/of/mine", "x"),
    ] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_wayside"));
        command.args(words.split(' ')).args(["--cache", cache]).current_dir(place.root());
        let output = command.output().unwrap();
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{words} --cache {cache}: {error}");
        assert!(error.contains("--out and --cache have to be two folders"), "{words}: {error}");
        assert!(!place.path("x").exists() && !place.path("there/x").exists(), "{words} --cache {cache}");
    }
}

/// A mesh whose reading takes a good part of a run: the corner, and triangles without area.
fn slow_mesh() -> String {
    crate::common::CORNER.to_owned() + &"f 1 1 2\n".repeat(400_000)
}

#[test]
fn a_mesh_that_is_replaced_while_the_scene_is_read_spoils_no_cache() {
    let place = Workplace::new();
    std::fs::write(place.path("slow.obj"), slow_mesh()).unwrap();
    let second = "[[target]]\nkind = \"mesh\"\nid = \"corner-2\"\nclass = \"car\"\nmodel = \"corner.obj\"\n\
                  position_m = [-5.75, 45.0, 0.0]\nvelocity_mps = [0.0, -3.0, 0.0]\n";
    let scene = crate::common::SMALL_SCENE.replace("model = \"corner.obj\"", "model = \"slow.obj\"") + second;
    std::fs::write(place.path("small.toml"), scene).unwrap();
    let begun = std::time::Instant::now();
    place.run("run small.toml --out whole --no-cache --quiet");
    let whole = begun.elapsed();
    for tenths in 1..8 {
        let mut run = place.command("run small.toml --out a --quiet").spawn().unwrap();
        std::thread::sleep(whole * tenths / 10);
        let larger = crate::common::CORNER.replace("0.5", "0.9");
        std::fs::write(place.path("larger.obj"), larger).unwrap();
        std::fs::rename(place.path("larger.obj"), place.path("corner.obj")).unwrap();
        assert!(matches!(run.wait().unwrap().code(), Some(0 | 2)));
        std::fs::write(place.path("corner.obj"), crate::common::CORNER).unwrap();
        place.run("run small.toml --out b --quiet");
        assert!(place.bytes("b/frames.cube") == place.bytes("whole/frames.cube"), "after {tenths} tenths");
        std::fs::remove_dir_all(place.path("cache")).unwrap();
    }
}
