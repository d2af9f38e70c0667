//! Files that killed programs leave behind are removed by the next one; those that living ones are
//! writing are not.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::atomic_file::{AtomicFile, AtomicFolder, Durability, is_temporary};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// Variable that names the place where the child writes; the test is a child where it is set.
const PLACE: &str = "WRITER_OF_A_TEST";

/// Variable whose presence makes the child fill a folder.
const FOLDER: &str = "FOLDER_OF_A_TEST";

/// Writes without end if it is a child; no test by itself.
#[test]
fn a_writer() {
    let Some(place) = std::env::var_os(PLACE) else { return };
    if std::env::var_os(FOLDER).is_some() {
        let folder = AtomicFolder::create(Path::new(&place)).unwrap();
        std::fs::create_dir(folder.path().join("below")).unwrap();
        std::fs::write(folder.path().join("below/file"), [1; 1 << 16]).unwrap();
        wait();
    }
    let mut file = AtomicFile::create(Path::new(&place)).unwrap();
    file.write_all(&[1; 1 << 16]).unwrap();
    wait();
}

/// Until the child is killed.
fn wait() -> ! {
    println!("\nwriting");
    std::thread::sleep(std::time::Duration::from_secs(600));
    unreachable!("nobody has killed the writer");
}

/// A program that has begun to write.
fn writer(place: &Path) -> Child {
    begun(Command::new(std::env::current_exe().unwrap()).env(PLACE, place))
}

/// A program that has begun to fill a folder.
fn folder_writer(place: &Path) -> Child {
    begun(Command::new(std::env::current_exe().unwrap()).env(PLACE, place).env(FOLDER, "yes"))
}

fn begun(program: &mut Command) -> Child {
    let mut child =
        program.args(["--exact", "a_writer", "--nocapture"]).stdout(Stdio::piped()).spawn().unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(lines.map_while(Result::ok).any(|line| line == "writing"));
    child
}

fn temporaries(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|file| is_temporary(file)).collect()
}

fn killed(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn the_next_program_removes_what_dead_writers_left_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let in_it = |name: &str| folder.path().join(name);
    // A user's own, by name no temporary of this program, and a link that is named like one.
    std::fs::write(in_it(".table.csv.part"), "mine").unwrap();
    std::fs::write(in_it("mine"), "mine").unwrap();
    std::os::unix::fs::symlink(in_it("mine"), in_it(".x.abcdef.wayside.part")).unwrap();
    let living = writer(&in_it("c"));
    let dead = [writer(&in_it("a")), writer(&in_it("a")), writer(&in_it("b"))];
    dead.into_iter().for_each(killed);
    assert_eq!(temporaries(folder.path()).len(), 5);
    let file = AtomicFile::create(&in_it("d")).unwrap();
    assert_eq!(temporaries(folder.path()).len(), 3, "the link, that of the living, that of this one");
    file.finish(Durability::InCache).unwrap();
    killed(living);
    assert_eq!(artifact::atomic_file::remove_stale(folder.path()), 1);
    assert_eq!(std::fs::read(in_it("mine")).unwrap(), b"mine");
    assert_eq!(std::fs::read(in_it(".table.csv.part")).unwrap(), b"mine");
    assert!(["a", "b", "c"].iter().all(|name| !in_it(name).exists()));
}

/// Its lock may not be seen over a network.
#[test]
fn a_file_of_another_machine_is_left_until_nothing_was_written_to_it_for_a_day() {
    let folder = tempfile::tempdir().unwrap();
    let own = writer(&folder.path().join("a"));
    let name = temporaries(folder.path())[0].file_name().unwrap().to_str().unwrap().to_owned();
    killed(own);
    let letters = name.split('.').nth(2).unwrap();
    let foreign = folder.path().join(name.replace(letters, "another1"));
    std::fs::write(&foreign, "of another machine").unwrap();
    assert_eq!(artifact::atomic_file::remove_stale(folder.path()), 1, "the dead one of this machine");
    let silent_for = |hours: u64| {
        let last = std::time::SystemTime::now() - std::time::Duration::from_secs(3600 * hours);
        std::fs::File::options().write(true).open(&foreign).unwrap().set_modified(last).unwrap();
    };
    silent_for(23);
    assert_eq!(artifact::atomic_file::remove_stale(folder.path()), 0);
    silent_for(25);
    assert_eq!(artifact::atomic_file::remove_stale(folder.path()), 1);
    assert!(temporaries(folder.path()).is_empty());
}

#[test]
fn writers_and_sweepers_at_once_lose_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let place = |writer: usize| folder.path().join(format!("{writer}"));
    std::thread::scope(|scope| {
        for writer in 0..4 {
            let place = place(writer);
            scope.spawn(move || {
                for round in 0..500_u32 {
                    let mut file = AtomicFile::create(&place).unwrap();
                    file.write_all(&round.to_le_bytes()).unwrap();
                    file.finish(Durability::InCache).unwrap();
                }
            });
        }
        // It may take a file between its making and its locking: its writer makes another one.
        scope.spawn(|| (0..2000).for_each(|_| _ = artifact::atomic_file::remove_stale(folder.path())));
    });
    (0..4).for_each(|writer| assert_eq!(std::fs::read(place(writer)).unwrap(), 499_u32.to_le_bytes()));
    assert!(temporaries(folder.path()).is_empty());
}

#[test]
fn folders_of_dead_writers_go_with_all_they_hold_and_those_of_living_ones_stay() {
    let folder = tempfile::tempdir().unwrap();
    let in_it = |name: &str| folder.path().join(name);
    let living = folder_writer(&in_it("set"));
    [folder_writer(&in_it("set")), folder_writer(&in_it("other"))].into_iter().for_each(killed);
    assert_eq!(temporaries(folder.path()).len(), 3);
    // Whatever is written there next.
    AtomicFile::create(&in_it("d")).unwrap().finish(Durability::InCache).unwrap();
    let left = temporaries(folder.path());
    assert!(left.len() == 1 && left[0].join("below/file").is_file(), "{left:?}");
    killed(living);
    assert_eq!(artifact::atomic_file::remove_stale(folder.path()), 1);
}

#[test]
fn of_two_that_fill_one_folder_the_first_has_it_and_nothing_is_mixed() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("set");
    std::fs::create_dir(&place).unwrap(); // an empty one is no hindrance
    let both = [(); 2].map(|()| AtomicFolder::create(&place).unwrap());
    for (writer, name) in both.iter().zip(["a", "b"]) {
        std::fs::write(writer.path().join(name), name).unwrap();
    }
    let [first, second] = both;
    second.finish().unwrap();
    let refused = first.finish().unwrap_err();
    assert!(refused.is_system() && refused.to_string().contains("not empty"), "{refused}");
    assert!(place.join("b").is_file() && !place.join("a").exists());
    assert!(temporaries(folder.path()).is_empty());
}
