//! Results of earlier commands in the folder of a command: they stay, as all of the user's files, and are
//! noted.

use crate::run::products::scattering_name;
use artifact::settings::EchoMode;
use pipeline::host::progress;
use std::path::Path;

/// Notes files in `out` with a run's names that are left of an earlier run: scattering of another kind than
/// in `artifacts`, and pictures whose kind and number do not belong to this run.
pub(super) fn remark(out: &Path, artifacts: &[&str], is_own: impl Fn(&str, u32) -> bool) {
    note(out, left_of_run(out, artifacts, is_own));
}

/// Notes pictures in `out` with a run's names whose kind and number do not belong to this command.
pub(crate) fn remark_on_pictures(out: &Path, is_own: impl Fn(&str, u32) -> bool) {
    note(out, other_pictures(out, is_own).collect());
}

/// Notes results that an earlier command left, by their names in `out`.
pub(crate) fn note(out: &Path, left: Vec<String>) {
    if let Some(said) = said(out, left) {
        progress::note(said);
    }
}

fn left_of_run(out: &Path, artifacts: &[&str], is_own: impl Fn(&str, u32) -> bool) -> Vec<String> {
    let kinds = [EchoMode::Paths, EchoMode::RcsTable].map(scattering_name);
    let others = kinds.into_iter().filter(|name| !artifacts.contains(name) && out.join(name).is_file());
    others.map(str::to_owned).chain(other_pictures(out, is_own)).collect()
}

fn other_pictures(out: &Path, is_own: impl Fn(&str, u32) -> bool) -> impl Iterator<Item = String> {
    let is_other = move |name: &String| frame_of(name).is_some_and(|(kind, number)| !is_own(kind, number));
    names_of_pictures(out).filter(is_other).map(|name| format!("pictures/{name}"))
}

fn said(out: &Path, mut left: Vec<String>) -> Option<String> {
    left.sort();
    let (first, last) = (left.first()?, left.last()?);
    let named = if first == last { first.clone() } else { format!("{first} to {last}") };
    let count = left.len();
    Some(format!(
        "note: {}: {named} ({count} in all) were left by an earlier run, and are none of this one",
        out.display()
    ))
}

/// Names of the files in the folder of a run's pictures.
pub(super) fn names_of_pictures(out: &Path) -> impl Iterator<Item = String> {
    let pictures = std::fs::read_dir(out.join("pictures")).into_iter().flatten().flatten();
    pictures.filter_map(|entry| entry.file_name().into_string().ok())
}

/// Kind and frame of a picture; `None` for a name that no run gives.
pub(super) fn frame_of(name: &str) -> Option<(&str, u32)> {
    let (stem, ending) = name.split_once('.')?;
    let (kind, number) = stem.split_once('-')?;
    let is_of_run = matches!((kind, ending), ("scene" | "rdm" | "points", "png") | ("rdm", "exr"));
    let is_number = number.len() >= 4 && number.bytes().all(|digit| digit.is_ascii_digit());
    if is_of_run && is_number { Some((kind, number.parse().ok()?)) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_pictures_tell_their_frame_and_other_names_none() {
        assert_eq!(frame_of("rdm-0012.exr"), Some(("rdm", 12)));
        assert_eq!(frame_of("scene-10000.png"), Some(("scene", 10_000)));
        for other in ["scene-0001.exr", "rdm-12.png", "holiday-0001.png", "rdm-0001.png.bak", "rdm-00+1.png"]
        {
            assert_eq!(frame_of(other), None, "{other}");
        }
    }

    #[test]
    fn what_earlier_runs_left_is_told_once_by_its_first_and_last_name() {
        let out = tempfile::tempdir().unwrap();
        std::fs::create_dir(out.path().join("pictures")).unwrap();
        let own = ["frames.paths", "pictures/rdm-0000.png", "pictures/rdm-0001.png", "pictures/mine.png"];
        own.iter().for_each(|name| std::fs::write(out.path().join(name), "").unwrap());
        let told = || said(out.path(), left_of_run(out.path(), &["frames.paths"], |_, number| number < 2));
        assert_eq!(told(), None);
        for name in ["frames.rcs", "pictures/rdm-0002.png", "pictures/points-0003.png"] {
            std::fs::write(out.path().join(name), "").unwrap();
        }
        assert!(told().is_some_and(|told| told.contains("frames.rcs to pictures/rdm-0002.png (3 in all)")));
    }
}
