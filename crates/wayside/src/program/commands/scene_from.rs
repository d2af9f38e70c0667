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
    // The error names the configuration, and its line if there is one.
    let refused = |error: device_config::SceneTextError| Failure::Refused(error.to_string());
    let text = device_config::scene_text(&settings, &arguments.config).map_err(refused)?;
    files::claim(std::slice::from_ref(&arguments.out))?; // this registers the configuration as an input
    files::refuse_unless(&arguments.out, EDITED, || is_text(&arguments.out, text.as_bytes()))?;
    files::write_file(&arguments.out, text.as_bytes())?;
    if let Some(layout) = settings.unusual_layout() {
        let file = arguments.config.display();
        let device = arguments.device.map_or_else(String::new, |board| format!(" --device {}", board.name()));
        progress::note(format!(
            "note: {file}: recordings of it have {layout}: import them with --config {file}{device}"
        ));
    }
    Ok(())
}

/// Refusal to replace a scene that was edited, as its own remarks ask for the values that no configuration
/// contains.
const EDITED: &str = "is not what scene-from would write, and would be replaced";

fn is_text(place: &Path, text: &[u8]) -> bool {
    files::read_own(place, text.len() as u64).is_ok_and(|written| written == text)
}
