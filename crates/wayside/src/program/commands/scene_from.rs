//! `scene-from`: a board's configuration as a scene file.

use crate::program::cli::SceneFromArguments;
use formats::device_config;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use std::path::Path;

pub(crate) fn run(arguments: &SceneFromArguments) -> Result<(), Failure> {
    files::claim(std::slice::from_ref(&arguments.out))?;
    let settings = device_config::read(&arguments.config, arguments.device)?;
    // The sentence names the configuration, and its line where there is one.
    let refused = |error: device_config::NoScene| Failure::Refused(error.to_string());
    let text = device_config::scene_text(&settings, &arguments.config).map_err(refused)?;
    files::claim(std::slice::from_ref(&arguments.out))?; // the configuration is known as an input now
    files::keep_unless(&arguments.out, EDITED, || is_text(&arguments.out, text.as_bytes()))?;
    files::write_file(&arguments.out, text.as_bytes())?;
    if let Some(layout) = settings.unusual_layout() {
        let file = arguments.config.display();
        progress::note(format!(
            "note: {file}: recordings of it have {layout}: import them with --config {file}"
        ));
    }
    Ok(())
}

/// A scene is written to be edited: its own remarks ask for what no configuration tells.
const EDITED: &str = "is not what scene-from would write, and would be replaced";

fn is_text(place: &Path, text: &[u8]) -> bool {
    files::read_own(place, text.len() as u64).is_ok_and(|written| written == text)
}
