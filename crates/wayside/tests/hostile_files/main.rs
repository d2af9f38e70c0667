//! Hostile files for every reader: each is refused with exit code 1 or 2 and a sentence that names it, within
//! a minute and gibibytes, and what is no plain file is refused before it is opened.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

#[path = "../common/mod.rs"]
mod common;
mod contents;
mod gltf;

use common::{BOARD, Workplace, bounded};
use std::path::Path;
use std::process::Command;

/// A reader: what its file is called, and a command that reads it.
const READERS: [(&str, &str); 33] = [
    ("h.toml", "run h.toml --out a --no-cache"),
    ("h.toml", "paths h.toml --out a.paths"),
    ("h.toml", "dataset h.toml --out a"),
    ("h.toml", "sweep h.toml --out a --no-cache"),
    ("manifest.toml", "dataset spec.toml --out a"),
    ("h.toml", "import x.bin --scene h.toml --config b.cfg --device xwr1443 --out a.cube"),
    ("h.glb", "rcs h.glb --freq-ghz 77 --az-deg 0 --out a.npy"),
    ("h.gltf", "rcs h.gltf --freq-ghz 77 --az-deg 0 --out a.npy"),
    ("h.stl", "rcs h.stl --freq-ghz 77 --az-deg 0 --out a.npy"),
    ("h.obj", "rcs h.obj --freq-ghz 77 --az-deg 0 --out a.npy"),
    ("h.toml", "rcs corner.obj --freq-ghz 77 --az-deg 0 --materials h.toml --out a.npy"),
    ("b.bin", "rcs beside.gltf --freq-ghz 77 --az-deg 0 --out a.npy"),
    ("h.fcd.xml", "run traffic.toml --out a --no-cache"),
    ("h.net.xml", "run network.toml --out a --no-cache"),
    ("h.csv", "run pattern.toml --out a --no-cache"),
    ("h.csv", "run calibration.toml --out a --no-cache"),
    ("h.toml", "run materials.toml --out a --no-cache"),
    ("h.npy", "import h.npy --scene small.toml --out a.cube"),
    ("h.bin", "import h.bin --scene small.toml --out a.cube"),
    ("h.sigmf-meta", "import h.sigmf-meta --scene small.toml --out a.cube"),
    ("s.sigmf-data", "import s.sigmf-meta --scene small.toml --out a.cube"),
    ("h.cube", "dsp h.cube --out a"),
    ("h.cube", "inspect h.cube"),
    ("h.rdm", "export h.rdm --to npy --out a.npy"),
    ("h.paths", "echo small.toml --paths h.paths --out a.cube"),
    ("h.model", "classify h.model h.rdm"),
    ("h.model", "run small.toml --classifier h.model --out a --no-cache"),
    ("h.points", "score h.points --scene small.scene"),
    ("h.cube", "calibrate h.cube --at-m 2,30,1 --out a.csv"),
    ("h.cfg", "scene-from h.cfg --device xwr1443 --out a.toml"),
    ("h.mat", "import h.mat --scene small.toml --out a.cube"),
    ("h.pcd", "import h.pcd --scene small.toml --out a.points"),
    ("h.dataset", "export h.dataset --to csv --out a.csv"),
];

/// Files of other readers that these commands need, and that are sound.
fn prepare(place: &Workplace) {
    let small = std::fs::read_to_string(place.path("small.toml")).unwrap();
    let scenes = [
        (
            "traffic",
            "name = \"t\"\n[traffic]\nfcd = \"h.fcd.xml\"\nmodels = { car = \"corner.obj\" }\n".to_owned(),
        ),
        ("network", "name = \"n\"\n[traffic]\nfcd = \"sound.fcd.xml\"\nnet = \"h.net.xml\"\n".to_owned()),
        ("pattern", small.replace("preset =", "pattern = \"table\"\npattern_file = \"h.csv\"\npreset =")),
        ("calibration", small.replace("[dsp]", "[dsp]\ncalibration = \"h.csv\"")),
        ("materials", format!("{small}[fidelity]\nmaterials = \"h.toml\"\n")),
    ];
    for (name, text) in scenes {
        std::fs::write(place.path(&format!("{name}.toml")), text).unwrap();
    }
    let recording = "<fcd-export><timestep time=\"0\"/></fcd-export>";
    std::fs::write(place.path("sound.fcd.xml"), recording).unwrap();
    std::fs::write(place.path("beside.gltf"), gltf::beside("b.bin")).unwrap();
    let recipe = "scene = \"small.toml\"\nseed = 1\nscenes_per_class = 1\nrange_m = [25, 45]\n\
                  speed_mps = [1, 5]\nlanes = [1]\n[models]\nvehicles = \".\"\n";
    std::fs::write(place.path("spec.toml"), recipe).unwrap();
    std::fs::write(place.path("b.cfg"), BOARD).unwrap();
    std::fs::write(place.path("x.bin"), [0; 16 * 8 * 64]).unwrap();
    place.run("run small.toml --out sound --no-cache --quiet");
    std::fs::rename(place.path("sound/scene.scene"), place.path("small.scene")).unwrap();
    let told = r#"{"global": {"core:datatype": "cf32_le", "core:num_channels": 4}}"#;
    std::fs::write(place.path("s.sigmf-meta"), told).unwrap();
}

/// Exit code 1 or 2, one of `names` in a sentence of moderate length, nothing written, in bounded time and
/// memory.
fn assert_refused(place: &Workplace, words: &str, names: &[&str], what: &str) {
    let ended = bounded::run(place.root(), words.split_whitespace());
    let (said, is_refused) = (ended.said.as_str(), ended.is_refused());
    let about = format!("{words}, {what}: {} after {:?}: {said}", ended.status, ended.after);
    assert!(is_refused && names.iter().any(|name| said.contains(name)), "{about}");
    assert!(said.len() < 300_000 && !said.contains('\u{1b}'), "{} bytes: {about}", said.len());
    let left: Vec<_> =
        std::fs::read_dir(place.root()).unwrap().flatten().map(|entry| entry.file_name()).collect();
    assert!(!left.iter().any(|name| name.to_string_lossy().starts_with("a.")), "{left:?}: {about}");
}

#[test]
fn files_that_hold_something_else_are_refused_by_every_reader() {
    let place = Workplace::new();
    prepare(&place);
    let mut cases = 0;
    for (what, bytes) in contents::of_any() {
        for (file, words) in READERS {
            std::fs::write(place.path(file), &bytes).unwrap();
            assert_refused(&place, words, &[file, "beside.gltf"], what);
            cases += 1;
        }
    }
    tell_refused("files of something else", cases);
}

#[test]
fn files_that_cost_more_than_they_say_are_refused_by_their_reader() {
    let place = Workplace::new();
    prepare(&place);
    let sets = [
        ("h.npy", "import h.npy --scene small.toml --out a.cube", contents::headers()),
        ("h.fcd.xml", "run traffic.toml --out a --no-cache", contents::recordings()),
        ("h.net.xml", "run network.toml --out a --no-cache", contents::networks()),
        ("h.obj", "rcs h.obj --freq-ghz 77 --az-deg 0 --out a.npy", contents::objects()),
        (
            "h.sigmf-meta",
            "import h.sigmf-meta --scene small.toml --out a.cube",
            contents::SIGMF.map(|t| t.as_bytes().to_vec()).to_vec(),
        ),
        ("h.gltf", "rcs h.gltf --freq-ghz 77 --az-deg 0 --out a.npy", gltf::expensive()),
        ("h.glb", "rcs h.glb --freq-ghz 77 --az-deg 0 --out a.npy", gltf::chunks()),
    ];
    std::fs::write(place.path("large.bin"), vec![0; 64 << 20]).unwrap();
    let mut cases = 0;
    for (file, words, contents) in sets {
        for (number, bytes) in contents.iter().enumerate() {
            std::fs::write(place.path(file), bytes).unwrap();
            // A description may fit its own rules and name data that are not there.
            let names = [file, if file == "h.sigmf-meta" { "h.sigmf-data" } else { file }];
            assert_refused(&place, words, &names, &format!("number {number}"));
            cases += 1;
        }
    }
    tell_refused("files that cost more than they say", cases);
}

fn tell_refused(kind: &str, cases: u64) {
    common::tell_cases(kind, cases, &format!("{cases} refused"));
}

#[cfg(unix)]
#[test]
fn what_is_no_plain_file_is_refused_before_it_is_opened() {
    let place = Workplace::new();
    prepare(&place);
    let mut cases = 0;
    for (kind, make) in SPECIAL {
        for (file, words) in READERS {
            make(&place.path(file));
            assert_refused(&place, words, &[file, "h.model"], kind);
            cases += 1;
            let at = place.path(file);
            if at.is_dir() { std::fs::remove_dir(at).unwrap() } else { std::fs::remove_file(at).unwrap() }
        }
    }
    tell_refused("files that are no plain ones", cases);
}

type Make = fn(&Path);

#[cfg(unix)]
const SPECIAL: [(&str, Make); 5] = [
    ("a FIFO", |at| assert!(Command::new("mkfifo").arg(at).status().unwrap().success())),
    ("a socket", |at| drop(std::os::unix::net::UnixListener::bind(at).unwrap())),
    ("a folder", |at| std::fs::create_dir(at).unwrap()),
    ("a link to nothing", |at| std::os::unix::fs::symlink("nothing-is-here", at).unwrap()),
    ("a link to itself", |at| std::os::unix::fs::symlink(at, at).unwrap()),
];

#[cfg(unix)]
#[test]
fn names_that_are_no_text_work_like_others() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let place = Workplace::new();
    let name = |ending: &[u8]| OsStr::from_bytes(&[b"b\xff", ending].concat()).to_owned();
    let at = |ending: &[u8]| place.root().join(name(ending));
    std::fs::copy(place.path("corner.obj"), at(b".obj")).unwrap();
    std::fs::copy(place.path("small.toml"), at(b".toml")).unwrap();
    std::fs::write(at(b"m.toml"), "[materials]\npaint = { substance = \"metal\" }\n").unwrap();
    let run = |words: &[&OsStr]| {
        let output = Command::new(common::PROGRAM).args(words).current_dir(place.root()).output().unwrap();
        assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    };
    let word = |text: &'static str| OsStr::new(text);
    run(&[
        word("rcs"),
        &name(b".obj"),
        word("--freq-ghz"),
        word("77"),
        word("--az-deg"),
        word("0:4:5"),
        word("--materials"),
        &name(b"m.toml"),
        word("--pictures"),
        word("--out"),
        &name(b".npy"),
    ]);
    assert!(at(b".npy").exists());
    run(&[
        word("run"),
        &name(b".toml"),
        word("--model"),
        &name(b".obj"),
        word("--out"),
        &name(b"out"),
        word("--cache"),
        &name(b"cache"),
    ]);
    run(&[word("run"), &name(b".toml"), word("--out"), &name(b"out2"), word("--cache"), &name(b"cache")]);
    run(&[word("echo"), &name(b".toml"), word("--out"), &name(b".cube")]);
    run(&[
        word("dsp"),
        &name(b".cube"),
        word("--scene"),
        &name(b".toml"),
        word("--pictures"),
        word("--out"),
        &name(b"maps"),
    ]);
    run(&[word("export"), &name(b".cube"), word("--to"), word("npy"), word("--out"), &name(b"c.npy")]);
    run(&[
        word("import"),
        &name(b"c.npy"),
        word("--scene"),
        &name(b".toml"),
        word("--out"),
        &name(b"i.cube"),
    ]);
    run(&[word("inspect"), &name(b"i.cube")]);
}
