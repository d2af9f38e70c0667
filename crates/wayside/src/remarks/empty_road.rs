//! Recorded traffic that is never in view.

use artifact::scene::SceneHeader;

/// Remark on a recording that brings no vehicle into view.
pub(super) fn remark(header: &SceneHeader) -> Option<String> {
    let traffic = header.traffic.as_ref()?;
    let frames = traffic.frames.len();
    let is_empty = frames > 0 && traffic.vehicles.is_empty();
    is_empty.then(|| {
        format!(
            "note: [traffic]: no vehicle of the recording is in view in any of {frames} frames: its steps have none \
             that is placed (who walks is passed over), or none within `view_range_m` before the radar"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::scene::{Traffic, Vehicle};

    #[test]
    fn a_recording_of_which_nothing_is_seen_is_told() {
        let options = scene::ReadOptions::names_only();
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/experiment-1.toml");
        let mut header = scene::read(&file, &options).unwrap();
        assert_eq!(remark(&header), None, "no recording");
        header.traffic = Some(Traffic { vehicles: vec![], frames: vec![vec![]; 3] });
        let told = remark(&header).unwrap();
        assert!(
            told.starts_with("note: [traffic]: no vehicle of the recording is in view in any of 3 frames"),
            "{told}"
        );
        let kind = header.targets[0].kind.clone();
        header.traffic.as_mut().unwrap().vehicles = vec![Vehicle { id: "a".into(), kind }];
        assert_eq!(remark(&header), None);
    }
}
