//! `scene-from`: a board's configuration as a scene file.

use crate::program::cli::SceneFromArguments;
use formats::device_config;
use pipeline::host::failure::Failure;
use pipeline::host::files;

pub(crate) fn run(arguments: &SceneFromArguments) -> Result<(), Failure> {
    files::claim(std::slice::from_ref(&arguments.out))?;
    let settings = device_config::read(&arguments.config, arguments.device)?;
    // The sentence names the configuration, and its line where there is one.
    let refused = |error: device_config::NoScene| Failure::Refused(error.to_string());
    let text = device_config::scene_text(&settings, &arguments.config).map_err(refused)?;
    files::write_file(&arguments.out, text.as_bytes())
}
