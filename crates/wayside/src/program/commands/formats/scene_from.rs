//! `scene-from`: a board's configuration as a scene file.

use crate::host::failure::Failure;
use crate::host::files;
use crate::program::cli::SceneFromArguments;
use crate::program::commands::formats::device_config;

pub(crate) fn run(arguments: &SceneFromArguments) -> Result<(), Failure> {
    files::claim(std::slice::from_ref(&arguments.out))?;
    let settings = device_config::read(&arguments.config, arguments.device)?;
    let text = device_config::scene_text(&settings, &arguments.config)
        .map_err(|rule| Failure::Refused(format!("{}: {rule}", arguments.config.display())))?;
    files::write_file(&arguments.out, text.as_bytes())
}
