//! `dist`: an archive of the program for users who do not build it, with the scenes and the licences of all
//! that is linked into it.

mod linked;
mod system;

use crate::cli::DistArguments;
use crate::dist::linked::{LinkedPackage, linked_packages};
use crate::dist::system::{copy, entries, output};
use crate::project::project_root;
use std::path::{Path, PathBuf};
use std::process::Command;
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::program::terminal;

/// Distributed program: its package, and its features, including those for OSI and ROS 2.
const PROGRAM: [&str; 2] = ["wayside", "interchange"];
/// Distributed Python package, with its features, likewise.
const WHEEL: [&str; 2] = ["wayside-python", "interchange"];
/// Attributions of the classifier's training data, included in both.
const ATTRIBUTIONS: &str = "fixtures/classifier.attributions.txt";
/// Files of the project beside the program.
const EXTRA_FILES: [&str; 6] =
    ["README.md", "CHANGELOG.md", "CITATION.cff", "LICENSE-APACHE", "LICENSE-MIT", ATTRIBUTIONS];

/// Builds the program, fills the archive's folder and packs it.
pub(crate) fn run(arguments: &DistArguments) -> Result<(), Failure> {
    let target = arguments.target.clone().map_or_else(host, Ok)?;
    if let Some(folder) = &arguments.licences {
        return licences_of_wheel(folder, &target);
    }
    let name = format!("wayside-{}-{target}", env!("CARGO_PKG_VERSION"));
    let out = arguments.out.clone().unwrap_or_else(|| PathBuf::from("out/dist"));
    let place = out.join(format!("{name}.tar.gz"));
    let program = build(&target)?;
    let linked = linked_packages(&target, PROGRAM)?;
    let gathered = tempfile::tempdir().map_err(|error| Failure::system(Path::new("."), "create", error))?;
    gather(&gathered.path().join(&name), &program, &linked)?;
    let archive = packed(gathered.path(), &name)?;
    files::write_file(&place, &archive)?;
    let mib = archive.len() as f64 / f64::from(1 << 20);
    terminal::line(format_args!("{}: {mib:.1} MiB, {} packages linked", place.display(), linked.len()));
    Ok(())
}

/// Copies the licences of packages linked into the Python package into a folder.
fn licences_of_wheel(folder: &Path, target: &str) -> Result<(), Failure> {
    let linked = linked_packages(target, WHEEL)?;
    gather_licences(folder, &linked)?;
    copy(&project_root().join(ATTRIBUTIONS), folder)?;
    terminal::line(format_args!("{}: licences of {} packages", folder.display(), linked.len()));
    Ok(())
}

/// The platform that this compiler builds for.
fn host() -> Result<String, Failure> {
    let told = output(Command::new("rustc").arg("-vV"))?;
    let told = String::from_utf8_lossy(&told);
    let host = told.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| Failure::System("rustc -vV: tells no host".into()))
}

/// Builds the program in a separate folder, because its features differ from the workspace's, and returns its
/// path.
fn build(target: &str) -> Result<PathBuf, Failure> {
    let folder = project_root().join("target/dist");
    let [package, features] = PROGRAM;
    let words = ["build", "--release", "--locked", "--package", package];
    let mut cargo = Command::new("cargo");
    cargo.args(words).args(["--features", features, "--target", target]).arg("--target-dir").arg(&folder);
    output(cargo.current_dir(project_root()).stderr(std::process::Stdio::inherit()))?;
    let ending = if target.contains("windows") { ".exe" } else { "" };
    Ok(folder.join(target).join("release").join(format!("wayside{ending}")))
}

/// Fills the archive's folder.
fn gather(folder: &Path, program: &Path, linked: &[LinkedPackage]) -> Result<(), Failure> {
    let root = project_root();
    copy(program, folder)?;
    EXTRA_FILES.iter().try_for_each(|name| copy(&root.join(name), folder))?;
    for scene in entries(&root.join("scenes"))?.iter().filter(|file| file.is_file()) {
        copy(scene, &folder.join("scenes"))?;
    }
    gather_licences(&folder.join("licences"), linked)
}

/// Fills a folder with the licences of packages, and their list.
fn gather_licences(licences: &Path, linked: &[LinkedPackage]) -> Result<(), Failure> {
    for package in linked {
        let of_package = licences.join(&package.name);
        package.licences.iter().try_for_each(|file| copy(file, &of_package))?;
    }
    let list: String =
        linked.iter().map(|package| format!("{}: {}\n", package.name, package.expression)).collect();
    files::write_file(&licences.join("packages.txt"), list.as_bytes())
}

/// Archives one folder by the system's `tar`.
fn packed(above: &Path, name: &str) -> Result<Vec<u8>, Failure> {
    let archive = above.join("archive.tar.gz");
    output(Command::new("tar").arg("-czf").arg(&archive).arg("-C").arg(above).arg(name))?;
    std::fs::read(&archive).map_err(|error| Failure::system(&archive, "read", error))
}
