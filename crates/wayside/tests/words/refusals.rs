//! Bad inputs end with the file, the place and the rule, exit code 1 or 2; nothing panics, nothing is
//! half-written.

use crate::common::{SMALL_SCENE, Workplace};
use std::collections::BTreeSet;
use std::process::Output;

/// Exit code, and that the words say something of use.
fn refused(output: &Output, code: i32, words: &[&str], what: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{what}: {said}");
    assert!(said.starts_with("error") || code == 2, "{what}: {said}");
    for word in words {
        assert!(said.contains(word), "{what}: `{word}` is not in: {said}");
    }
}

#[test]
fn broken_scenes_are_refused_with_line_column_and_rule() {
    let place = Workplace::new();
    let broken = [
        ("seed = 3", "seed = -3", "seed"),
        ("samples = 64", "samples = 0", "samples"),
        ("samples = 64", "sampels = 64", "the nearest is `samples`"),
        ("preset = \"1x4\"", "preset = \"2x2\"", "preset"),
        ("velocity_mps = [0.0, -3.0, 0.0]", "velocity_mps = [0.0, nan, 0.0]", "velocity_mps"),
        ("rcs_m2 = 10.0", "rcs_m2 = -1.0", "rcs_m2"),
        ("id = \"reflector\"", "id = \"corner-1\"", "corner-1"),
        ("model = \"corner.obj\"", "model = \"corner.abc\"", "corner.abc"),
        ("training_cells = [3, 6]", "training_cells = [30, 60]", "training cells"),
        ("frames = 2", "frames = two", "small.toml:4"),
    ];
    for (right, wrong, word) in broken {
        std::fs::write(place.path("small.toml"), SMALL_SCENE.replace(right, wrong)).unwrap();
        let output = place.try_run("run small.toml --out a --quiet");
        let code = output.status.code();
        assert!(matches!(code, Some(1 | 2)), "{wrong}: {code:?}");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.contains(word) && said.contains("small.toml"), "{wrong}: {said}");
        assert!(!place.path("a").exists(), "{wrong}: something was written");
    }
}

#[test]
fn missing_and_unreadable_files_are_the_systems_fault() {
    let place = Workplace::new();
    let cases = [
        "run nothing.toml --out a",
        "run . --out a",
        "dsp nothing.cube --out a",
        "inspect nothing.cube",
        "export nothing.rdm --to npy --out a.npy",
        "rcs nothing.glb --freq-ghz 77 --out s.npy",
        "import nothing.npy --scene small.toml --out a.cube",
        "classify nothing.model a.rdm",
        "run small.toml --out corner.obj/a --no-cache",
        "paths small.toml --out /proc/nowhere/a.paths",
        "run small.toml --classifier nothing.model --out a",
    ];
    for words in cases {
        refused(&place.try_run(&format!("{words} --quiet")), 2, &["cannot"], words);
    }
}

#[test]
fn wrong_words_are_usage_errors() {
    let place = Workplace::new();
    for words in [
        "",
        "fly",
        "run",
        "run small.toml --frames 3",
        "rcs corner.obj --out s.npy",
        "rcs corner.obj --freq-ghz 77:78 --out s.npy",
        "rcs corner.obj --freq-ghz 77 --range-m -3 --out s.npy",
        "rcs corner.obj --freq-ghz 77 --rx-az-deg 10 --out s.npy",
        "rcs corner.obj --freq-ghz 77 --bounces 9 --out s.npy",
        "rcs corner.obj --freq-ghz 77 --pol xx --out s.npy",
        "run small.toml --threads 0",
        "dataset spec.toml --out d --shard 3/2",
    ] {
        let output = place.try_run(words);
        assert_eq!(output.status.code(), Some(2), "`{words}`: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn help_is_given_for_every_command() {
    let place = Workplace::new();
    let commands = [
        "run",
        "rcs",
        "paths",
        "echo",
        "dsp",
        "dataset",
        "train",
        "classify",
        "import",
        "export",
        "inspect",
        "vehicles",
        "cache",
        "evaluate",
        "protocols",
        "calibrate",
        "sweep",
        "score",
        "scene-from",
    ];
    commands.iter().for_each(|c| assert!(place.run(&format!("{c} --help")).contains("Usage"), "{c}"));
    let help = place.run("--help");
    let listed =
        help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let all: BTreeSet<&str> = listed.filter_map(|line| line.split_whitespace().next()).collect();
    let told: BTreeSet<&str> = commands.into_iter().chain(["help"]).collect();
    assert_eq!(all, told, "every command is asked for its help");
    let page = std::fs::read_to_string(Workplace::project_file("docs/interface.md")).unwrap();
    let row = page.lines().find(|line| line.starts_with("| `run`, ")).unwrap();
    let on_page: BTreeSet<&str> = row.split('`').skip(1).step_by(2).chain(["help"]).collect();
    assert_eq!(all, on_page, "every command is on the page");
}

#[test]
fn damaged_artifacts_are_refused_by_every_reader() {
    let place = Workplace::new();
    place.run("run small.toml --out a --no-cache --quiet");
    for (artifact, reader) in [
        ("a/scene.scene", "inspect x"),
        ("a/frames.paths", "echo small.toml --paths x --out y.cube"),
        ("a/frames.cube", "dsp x --out y"),
        ("a/frames.rdm", "export x --to npy --out y.npy"),
        ("a/frames.points", "export x --to csv --out y.csv"),
    ] {
        let whole = place.bytes(artifact);
        let damages: [(&str, Vec<u8>); 5] = [
            ("cut", whole[..whole.len() / 2].to_vec()),
            ("empty", vec![]),
            ("foreign", b"name = 'not an artifact'".to_vec()),
            ("longer", [whole.as_slice(), b"more"].concat()),
            ("flipped", flipped(&whole)),
        ];
        for (damage, bytes) in damages {
            std::fs::write(place.path("x"), bytes).unwrap();
            refused(&place.try_run(&format!("{reader} --quiet")), 1, &["x"], &format!("{artifact} {damage}"));
            assert!(
                ["y", "y.cube", "y.npy", "y.csv"].iter().all(|y| is_absent_or_empty(&place, y)),
                "{artifact} {damage}"
            );
        }
    }
}

fn flipped(whole: &[u8]) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    let place = whole.len() * 2 / 3;
    bytes[place] ^= 16;
    bytes
}

/// A folder may have been made; no file may stand in it.
fn is_absent_or_empty(place: &Workplace, name: &str) -> bool {
    let path = place.path(name);
    !path.exists() || std::fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none())
}

#[test]
fn an_artifact_of_another_kind_is_refused_by_name() {
    let place = Workplace::new();
    place.run("echo small.toml --out a.cube --quiet");
    refused(&place.try_run("export a.cube --to csv --out a.csv"), 1, &["`cube`", "npy"], "cube to csv");
    refused(
        &place.try_run("echo small.toml --paths a.cube --out b.cube"),
        1,
        &["`cube`", "`paths`"],
        "cube as paths",
    );
    refused(&place.try_run("classify a.cube a.cube"), 1, &["`cube`", "`model`"], "cube as model");
}

#[test]
fn what_was_meant_is_told_where_a_word_or_a_file_is_another() {
    let place = Workplace::new();
    let misspelt = place.try_run("rcs car-suvv --freq-ghz 77 --out s.npy");
    refused(&misspelt, 1, &["`car-suvv`", "the nearest is `car-suv`"], "a vehicle's name");
    place.run("echo small.toml --out a.cube --quiet");
    place.run("dsp a.cube --out d --quiet");
    for words in
        ["export d/a.points --to kitti --scene small.toml --out k", "score d/a.points --scene small.toml"]
    {
        refused(&place.try_run(words), 1, &["small.toml", "`scene.scene`"], words);
    }
    let board = [
        "channelCfg 15 1 0",
        "profileCfg 0 77 7 7 58 0 0 60 1 128 5000 0 0 30",
        "chirpCfg 0 0 0 0 0 0 0 1",
        "frameCfg 0 0 16 0 100 1 0",
    ];
    std::fs::write(place.path("board.cfg"), board.join("\n")).unwrap();
    refused(&place.try_run("scene-from board.cfg --out b.toml"), 1, &["board.cfg", "xwr6843"], "no board");
}

#[test]
fn an_array_of_another_shape_or_with_nan_is_refused() {
    use ndarray_npy::WriteNpyExt;
    let place = Workplace::new();
    let write = |array: ndarray::Array4<num_complex::Complex32>| {
        array.write_npy(std::fs::File::create(place.path("a.npy")).unwrap()).unwrap();
        place.try_run("import a.npy --scene small.toml --out a.cube")
    };
    refused(&write(ndarray::Array4::zeros((1, 4, 16, 32))), 1, &["[4, 16, 32]", "[4, 16, 64]"], "shape");
    let mut sick = ndarray::Array4::<num_complex::Complex32>::zeros((1, 4, 16, 64));
    sick[[0, 1, 2, 3]].im = f32::NAN;
    refused(&write(sick), 1, &["(0, 1, 2, 3)", "finite"], "NaN");
    std::fs::write(place.path("a.npy"), "no array").unwrap();
    refused(&place.try_run("import a.npy --scene small.toml --out a.cube"), 1, &["a.npy"], "no array");
    assert!(!place.path("a.cube").exists());
}

#[test]
fn what_a_reference_method_does_not_have_is_refused_not_ignored() {
    let place = Workplace::new();
    for option in ["--edges on", "--surface smooth"] {
        let output = place
            .try_run(&format!("rcs corner.obj --freq-ghz 77 --az-deg 0 --method po {option} --out s.npy"));
        refused(&output, 2, &["corner.obj: ", option, "bart"], option);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_and_leaves_nothing() {
    let place = Workplace::new();
    let words = "ulimit -f 8; trap '' XFSZ; exec \"$0\" run small.toml --out a --cache c --quiet";
    let output = std::process::Command::new("bash")
        .args(["-c", words, crate::common::PROGRAM])
        .current_dir(place.root())
        .output()
        .unwrap();
    // A limit of 8 KiB a file stands for a disk that is full: writes beyond it fail.
    refused(&output, 2, &["cannot write"], "limit of file size");
    let left =
        std::fs::read_dir(place.path("a")).map_or(0, |d| d.flatten().filter(|e| e.path().is_file()).count());
    assert_eq!(left, 0);
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_with_130_and_leaves_nothing_half_written() {
    let place = Workplace::new();
    std::fs::write(place.path("small.toml"), SMALL_SCENE.replace("frames = 2", "frames = 400")).unwrap();
    let mut child = place.command("run small.toml --out a --quiet").spawn().unwrap();
    while !place.path("cache/dsp").exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(
        std::process::Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status()
            .unwrap()
            .success()
    );
    assert_eq!(child.wait().unwrap().code(), Some(130));
    // A picture may be there already; then the mark of an unfinished run is, too.
    let files = std::fs::read_dir(place.path("a")).unwrap().flatten().filter(|entry| entry.path().is_file());
    let names = files.map(|entry| entry.file_name().into_string().unwrap());
    let left: Vec<String> = names.filter(|name| name != ".wayside-unfinished.txt").collect();
    assert!(left.is_empty(), "{left:?} were left");
}

#[cfg(not(feature = "interchange"))]
#[test]
fn a_program_without_messages_of_others_says_how_to_build_one_with_them() {
    let place = Workplace::new();
    let how = "cargo install --path crates/wayside --features interchange";
    let trace = SMALL_SCENE.to_owned() + "\n[traffic]\nosi = \"a.osi\"\n";
    std::fs::write(place.path("trace.toml"), trace).unwrap();
    let run = "run trace.toml --out a --quiet";
    refused(&place.try_run(run), 2, &["a.osi: cannot be read"], "no trace");
    std::fs::write(place.path("a.osi"), "").unwrap();
    refused(&place.try_run(run), 1, &["a.osi: this program was built without", how], "a trace");
    place.run("echo small.toml --out a.cube --quiet");
    place.run("dsp a.cube --out a --quiet");
    for (file, format, ending) in
        [("a/a.points", "osi", "osi"), ("a/a.tracks", "mcap", "mcap"), ("a/a.points", "foxglove", "mcap")]
    {
        let words = format!("export {file} --to {format} --out b.{ending} --quiet");
        refused(&place.try_run(&words), 2, &[how], &words);
    }
}
