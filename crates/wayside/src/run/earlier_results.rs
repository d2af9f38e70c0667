//! Results of an earlier run that a run replaces: distinguished from the user's own files before the work,
//! and removed before the first new result is written, so that an interrupted run leaves only its own.

use crate::run::leftovers::{frame_of, names_of_pictures};
use crate::run::products;
use artifact::scene::SceneHeader;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::outcome::summary;
use reporting::report::{self, FRAMES_DRAWN};
use std::path::{Path, PathBuf};

/// Largest summary or report: a hundred thousand frames.
const LIMIT_BYTES: u64 = 1 << 30;

/// Mark in the folder from the first result to the last: files beside it belong to a run.
const UNFINISHED: &str = ".wayside-unfinished.txt";
const SAID: &str =
    "A run writes into this folder, or was ended before its last result: not all of it is here.\n";

/// Folder of results, and a run's file names in it.
pub(crate) struct EarlierResults {
    out: PathBuf,
    artifacts: Vec<&'static str>,
    /// Kind of its pictures; `None`: all kinds.
    only: Option<&'static str>,
    frames: u32,
}

impl EarlierResults {
    /// Results of one radar.
    pub(crate) fn of_radar(header: &SceneHeader, out: &Path) -> Self {
        let artifacts = products::artifacts(header).to_vec();
        Self { out: out.to_owned(), artifacts, only: None, frames: header.frames }
    }

    /// Results that radars with `frames` common frames share.
    pub(crate) fn in_common(out: &Path, frames: u32) -> Self {
        let frames = frames.min(FRAMES_DRAWN as u32);
        Self { out: out.to_owned(), artifacts: vec![], only: Some("scene"), frames }
    }

    /// Refuses to replace files that no run left here: a summary, a report or an artifact of another origin,
    /// and pictures without other results of a run.
    pub(crate) fn refuse_foreign(&self) -> Result<(), Failure> {
        let place = |name: &str| self.out.join(name);
        files::refuse_foreign(&place(TOLD[0]), LIMIT_BYTES, summary::is_summary)?;
        files::refuse_foreign(&place(TOLD[1]), LIMIT_BYTES, report::is_report)?;
        self.artifacts.iter().try_for_each(|name| files::refuse_no_artifact(&place(name)))?;
        let of_runs = self.artifacts.iter().chain(&TOLD).chain([&UNFINISHED]);
        if of_runs.into_iter().any(|name| place(name).is_file()) {
            return Ok(());
        }
        self.pictures().iter().try_for_each(|picture| files::refuse_foreign(picture, 0, |_| false))
    }

    /// Removes the results that will be written anew, beginning with those that describe the others.
    pub(crate) fn remove_outdated(&self) -> Result<(), Failure> {
        files::overwrite(&self.out.join(UNFINISHED), SAID.as_bytes())?;
        let names = TOLD.iter().chain(&self.artifacts).map(|name| self.out.join(name));
        files::remove_outdated(names.chain(self.pictures()))
    }

    /// Removes the mark when all results are complete.
    pub(crate) fn are_whole(&self) -> Result<(), Failure> {
        let mark = self.out.join(UNFINISHED);
        std::fs::remove_file(&mark).map_err(|e| Failure::system(&mark, "remove", e))
    }

    /// Removes the mark of a failed run that left no pictures to be identified by it.
    pub(crate) fn forget_if_none(&self) {
        if self.pictures().is_empty() {
            let _ = std::fs::remove_file(self.out.join(UNFINISHED)); // it does no harm
        }
    }

    /// Existing pictures with the names of this run's.
    fn pictures(&self) -> Vec<PathBuf> {
        let is_own = |name: &String| {
            frame_of(name).is_some_and(|(kind, number)| {
                number < self.frames && self.only.is_none_or(|only| only == kind)
            })
        };
        names_of_pictures(&self.out).filter(is_own).map(|name| self.out.join("pictures").join(name)).collect()
    }
}

/// Names of the files that describe a run.
const TOLD: [&str; 2] = ["summary.json", "report.html"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_a_runs_own_beside_its_mark_and_the_users_without_it() {
        let out = tempfile::tempdir().unwrap();
        let picture = out.path().join("pictures/scene-0000.png");
        std::fs::create_dir(out.path().join("pictures")).unwrap();
        std::fs::write(&picture, "mine").unwrap();
        let results = EarlierResults::in_common(out.path(), 2);
        assert!(
            results.refuse_foreign().unwrap_err().to_string().contains("scene-0000.png: was not written")
        );
        assert!(EarlierResults::in_common(out.path(), 0).refuse_foreign().is_ok(), "none of its names");
        results.remove_outdated().unwrap();
        assert!(!picture.exists());
        std::fs::write(&picture, "of a run that was ended").unwrap();
        results.refuse_foreign().unwrap();
        results.forget_if_none();
        results.are_whole().unwrap();
        assert!(results.refuse_foreign().is_err());
        results.remove_outdated().unwrap();
        results.forget_if_none();
        assert!(results.are_whole().is_err(), "a run that failed before its first picture leaves no mark");
    }
}
