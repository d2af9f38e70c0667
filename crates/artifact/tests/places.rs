//! Places where a file may be put, and what is never replaced.

#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use artifact::atomic_file::{AtomicFile, AtomicFolder, Durability, OutputPathFault, check};
use artifact::{Fault, inputs};
use std::io::Write;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::Path;

fn write(place: &Path, text: &str) -> Result<(), Fault> {
    let mut file = AtomicFile::create(place).map_err(|e| e.fault)?;
    file.write_all(text.as_bytes()).unwrap();
    file.finish(Durability::InCache).map_err(|e| e.fault)
}

/// The rule that an attempt to write there breaks.
fn rule(place: &Path) -> OutputPathFault {
    match write(place, "new").unwrap_err() {
        Fault::Place(rule) => rule,
        other => panic!("{}: {other}", place.display()),
    }
}

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn what_is_no_plain_file_is_refused_and_stays_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let [fifo, socket, to_fifo, to_device] =
        ["fifo", "socket", "to-fifo", "to-device"].map(|name| folder.path().join(name));
    assert!(std::process::Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    symlink(&fifo, &to_fifo).unwrap();
    // Refused by what it is, before anything could be written to it.
    symlink("/dev/null", &to_device).unwrap();
    assert_eq!(rule(&fifo), OutputPathFault::Special("a FIFO"));
    assert_eq!(rule(&socket), OutputPathFault::Special("a socket"));
    assert_eq!(rule(&to_fifo), OutputPathFault::Special("a FIFO"));
    assert_eq!(rule(&to_device), OutputPathFault::Special("a device"));
    let kind = |place: &Path| std::fs::symlink_metadata(place).unwrap().file_type();
    assert!(kind(&fifo).is_fifo() && kind(&socket).is_socket());
    assert!(kind(&to_fifo).is_symlink() && kind(&to_device).is_symlink());
    assert!(std::fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    assert_eq!(names_in(folder.path()), ["fifo", "socket", "to-device", "to-fifo"]);
}

#[test]
fn folders_links_to_nothing_and_protected_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [inner, to_folder, dangling, protected] =
        ["inner", "to-folder", "dangling", "protected"].map(|name| folder.path().join(name));
    std::fs::create_dir(&inner).unwrap();
    symlink(&inner, &to_folder).unwrap();
    symlink(folder.path().join("nothing"), &dangling).unwrap();
    std::fs::write(&protected, "old").unwrap();
    std::fs::set_permissions(&protected, std::fs::Permissions::from_mode(0o444)).unwrap();
    assert_eq!(rule(&inner), OutputPathFault::Folder);
    assert_eq!(rule(&to_folder), OutputPathFault::Folder);
    assert_eq!(rule(Path::new("..")), OutputPathFault::Folder);
    assert_eq!(rule(Path::new("")), OutputPathFault::Nameless);
    assert_eq!(rule(&dangling), OutputPathFault::DanglingLink);
    assert_eq!(rule(&protected), OutputPathFault::WriteProtected);
    assert_eq!(std::fs::read(&protected).unwrap(), b"old");
    assert!(!folder.path().join("nothing").exists());
}

#[test]
fn a_link_to_a_plain_file_stays_and_the_file_is_replaced() {
    let (folder, elsewhere) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (link, file) = (folder.path().join("link"), elsewhere.path().join("file"));
    std::fs::write(&file, "old").unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o600)).unwrap();
    symlink(&file, &link).unwrap();
    write(&link, "new").unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::read(&file).unwrap(), b"new");
    assert_eq!(
        std::fs::metadata(&file).unwrap().permissions().mode() & 0o777,
        0o600,
        "what is private stays private"
    );
    assert_eq!((names_in(folder.path()).len(), names_in(elsewhere.path()).len()), (1, 1));
}

#[test]
fn an_input_is_refused_by_whatever_name_it_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let [input, hard, soft, other, late] =
        ["input", "hard", "soft", "other", "late"].map(|name| folder.path().join(name));
    std::fs::write(&input, "mine").unwrap();
    std::fs::hard_link(&input, &hard).unwrap();
    symlink(&input, &soft).unwrap();
    std::fs::write(&late, "mine").unwrap();
    drop(inputs::open(&input).unwrap());
    for place in [input.clone(), hard, soft, folder.path().join("./input"), folder.path().join("x/../input")]
    {
        std::fs::create_dir_all(folder.path().join("x")).unwrap();
        assert!(matches!(rule(&place), OutputPathFault::Input { .. }), "{}", place.display());
        assert!(check(&place).is_err_and(|e| e.is_system()));
    }
    write(&other, "new").unwrap();
    // An input that is opened while its place is being written is not replaced either.
    let mut output = AtomicFile::create(&late).unwrap();
    output.write_all(b"new").unwrap();
    inputs::register_path(&late);
    assert!(matches!(
        output.finish(Durability::OnDisk).unwrap_err().fault,
        Fault::Place(OutputPathFault::Input { .. })
    ));
    assert_eq!(
        (std::fs::read(&input).unwrap(), std::fs::read(&late).unwrap()),
        (b"mine".to_vec(), b"mine".to_vec())
    );
    assert_eq!(names_in(folder.path()), ["hard", "input", "late", "other", "soft", "x"]);
}

#[test]
fn a_file_that_has_taken_the_number_of_an_input_that_is_gone_is_none() {
    let folder = tempfile::tempdir().unwrap();
    let (input, output) = (folder.path().join("input"), folder.path().join("output"));
    std::fs::write(&input, "was read").unwrap();
    inputs::register_path(&input);
    // Renamed, it keeps its number, and nothing has the name any more that it was read by.
    std::fs::rename(&input, &output).unwrap();
    write(&output, "new").unwrap();
    assert_eq!(std::fs::read(&output).unwrap(), b"new");
}

#[test]
fn a_name_as_long_as_the_system_allows_can_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("é".repeat(127));
    write(&place, "new").unwrap();
    assert_eq!(std::fs::read(&place).unwrap(), b"new");
}

#[cfg(unix)]
#[test]
fn a_link_to_an_empty_folder_stands_for_that_folder_and_one_that_leads_nowhere_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [target, link, nowhere] = ["target", "link", "nowhere"].map(|name| folder.path().join(name));
    std::fs::create_dir(&target).unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    std::os::unix::fs::symlink(folder.path().join("none"), &nowhere).unwrap();
    let whole = AtomicFolder::create(&link).unwrap();
    std::fs::write(whole.path().join("a"), "new").unwrap();
    whole.finish().unwrap();
    assert_eq!(std::fs::read(target.join("a")).unwrap(), b"new");
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    let refused = AtomicFolder::create(&nowhere).err().unwrap().to_string();
    assert!(refused.contains("nowhere"), "{refused}");
}
