//! Configurations of Texas Instruments' radar boards: settings for transmission, reception and recording.
//!
//! There are two kinds of files: the `.cfg` of the mmWave SDK's command line (`profileCfg …`), and the files
//! of mmWave Studio, its log (`API:ProfileConfig,…`) and its scripts (`ar1.ProfileConfig(…)`). Both become
//! the same `statements`, these a [`DeviceSettings`], and that tables of a scene.

mod boards; // antennas, lanes and bands of evaluation boards
mod statements; // commands of both kinds of files
mod sdk_cfg; // `.cfg` of the mmWave SDK
mod lua_calls; // calls of a script
mod studio_log; // logs and scripts of mmWave Studio
mod chirp_program; // transmitters of each chirp
mod scene_tables; // keys of a scene
mod scene_completion; // a scene that specifies some of them itself

pub use chirp_program::DeviceSettings;
pub use scene_completion::{ConfigFile, files_with, scene_with};
pub use scene_tables::{SceneTextError, scene_text};

use crate::devices::Board;
use artifact::bounded;
use chirp_program::Remark;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use statements::Fault;
use std::path::Path;

/// Largest file, a log of days; commands of a configuration take a few kilobytes.
const LIMIT_BYTES: u64 = 16 << 20;

/// Reads the settings of a configuration, for the requested board, else the one that it names.
pub fn read(file: &Path, board: Option<Board>) -> Result<DeviceSettings, Failure> {
    let settings = read_unremarked(file, board)?;
    for Remark { line, text } in &settings.remarks {
        progress::note(format!("note: {}:{line}: {text}", file.display()));
    }
    Ok(settings)
}

/// Reads the configuration as [`read`] does, without noting its remarks.
///
/// # Errors
/// The errors are those of [`read`].
pub fn read_unremarked(file: &Path, board: Option<Board>) -> Result<DeviceSettings, Failure> {
    let text = bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    settings(&text, board).map_err(|fault| refused(file, fault))
}

/// Refuses a configuration with which a capture card's file contains more than samples.
///
/// # Errors
/// The command that adds other words, with its line.
pub fn check_stream(file: &Path, settings: &DeviceSettings) -> Result<(), Failure> {
    settings.check_stream().map_err(|fault| refused(file, fault))
}

fn refused(file: &Path, Fault { line, rule }: Fault) -> Failure {
    let place = line.map_or_else(String::new, |line| format!(":{line}"));
    Failure::Refused(format!("{}{place}: {rule}", file.display()))
}

fn settings(text: &str, board: Option<Board>) -> Result<DeviceSettings, Fault> {
    if !studio_log::is_one(text) {
        return chirp_program::settings(&sdk_cfg::statements(text)?, board);
    }
    let (statements, in_branches) = studio_log::statements(text, board)?;
    let mut settings = chirp_program::settings(&statements, board)?;
    settings.remarks.extend(of_branches(&in_branches));
    Ok(settings)
}

/// The remark that the commands on these lines are assumed to run.
fn of_branches(lines: &[usize]) -> Option<Remark> {
    let line = *lines.first()?;
    let more = match lines.len() - 1 {
        0 => String::new(),
        more => format!(", as {more} more do"),
    };
    let text = format!("it stands in a branch of `if`{more}: all are taken to run");
    Some(Remark { line, text })
}

#[cfg(test)]
mod tests;
