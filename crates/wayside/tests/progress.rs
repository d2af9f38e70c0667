//! Long work is heard of within two seconds of its begin, by whatever command, and `--quiet` silences it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a helper of tests fails the test")]

mod common;

use common::{SMALL_SCENE, Workplace};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant};

/// A rolling sheet of 4.2 million facets: every command still reads it when its first line comes, and works
/// for many seconds before it has a result.
fn write_large_mesh(file: &std::path::Path) {
    const SIDE: u32 = 1450;
    let mut stl = std::io::BufWriter::new(std::fs::File::create(file).unwrap());
    stl.write_all(&[0; 80]).unwrap();
    stl.write_all(&(2 * SIDE * SIDE).to_le_bytes()).unwrap();
    let corner = |i: u32, j: u32| {
        let (x, y) = (0.002 * i as f32, 0.002 * j as f32);
        [x, y, 1.0 + 0.05 * (7.0 * x).sin() * (5.0 * y).sin()]
    };
    for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        for facet in [[[0.0; 3], a, b, c], [[0.0; 3], a, c, d]] {
            facet.as_flattened().iter().for_each(|x| stl.write_all(&x.to_le_bytes()).unwrap());
            stl.write_all(&[0; 2]).unwrap();
        }
    }
    stl.flush().unwrap();
}

/// Ends with the test that began it.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The first line on standard error and when it came; `None` where none came for so long.
fn first_line(place: &Workplace, words: &str, wait: Duration) -> Option<(Duration, String)> {
    let mut command = place.command(words);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let start = Instant::now();
    let mut child = Running(command.spawn().unwrap());
    let (send, receive) = mpsc::channel();
    let errors = BufReader::new(child.0.stderr.take().unwrap());
    std::thread::spawn(move || errors.lines().map_while(Result::ok).try_for_each(|line| send.send(line)));
    receive.recv_timeout(wait).ok().map(|line| (start.elapsed(), line))
}

#[test]
fn commands_on_a_mesh_of_four_million_facets_are_heard_of_within_two_seconds() {
    let place = Workplace::new();
    write_large_mesh(&place.path("sheet.stl"));
    std::fs::write(place.path("large.toml"), SMALL_SCENE.replace("corner.obj", "sheet.stl")).unwrap();
    let rcs = "rcs sheet.stl --freq-ghz 77 --az-deg 0:90:3 --el-deg 30 --out a/s.npy";
    for (words, doing) in [
        (rcs, "reading sheet.stl"),
        ("run large.toml --out a", "large.toml"),
        ("paths large.toml --out a/f.paths", "large.toml"),
        ("echo large.toml --out a/f.cube", "large.toml"),
    ] {
        let (after, line) = first_line(&place, words, Duration::from_secs(10)).unwrap();
        println!("{words}: {after:?}: {line}");
        // A busy machine may start the program late.
        assert!(after < Duration::from_secs(3), "{words}: {after:?}");
        assert!(line.contains(doing), "{words}: {line}");
    }
    assert_eq!(first_line(&place, &format!("{rcs} --quiet"), Duration::from_secs(3)), None);
}

#[test]
fn work_on_many_frames_tells_how_many_of_them_are_done() {
    let place = Workplace::new();
    std::fs::write(place.path("many.toml"), SMALL_SCENE.replace("frames = 2", "frames = 400")).unwrap();
    place.run("echo many.toml --out many.cube --quiet");
    // The pictures of a frame take some 15 ms.
    let words = "dsp many.cube --pictures --threads 1 --out a";
    let (_, line) = first_line(&place, words, Duration::from_secs(10)).unwrap();
    assert!(line.contains("; frames: ") && line.contains(" of 400, about "), "{line}");
}
