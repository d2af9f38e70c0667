//! Frames of points and the labels that belong to them: by the names of the files that the frames were read
//! from, or by their order.

use crate::radar_cloud::import::extension;
use pipeline::host::failure::Failure;
use std::collections::BTreeMap;
use std::path::Path;

/// Endings of files that hold a frame each.
const ENDINGS: [&str; 4] = ["bin", "pcd", "mat", "npy"];

/// Frames of a file of points.
pub(super) struct FrameNames {
    /// Name of each frame's file, without its ending; `None` if frames were not read from a file each.
    names: Option<Vec<String>>,
    frames: usize,
}

impl FrameNames {
    /// Frames of points with these inputs, as their provenance names them.
    pub(super) fn of(inputs: &[(String, String)], frames: usize) -> Self {
        // Files of frames come first; meshes of a scene may have buffers with these endings too.
        let is_of_frame = |file: &&Path| extension(file).is_some_and(|ending| ENDINGS.contains(&ending));
        let files = inputs.iter().map(|(name, _)| Path::new(name));
        let names: Vec<String> = files.take_while(is_of_frame).map(name_of).collect();
        Self { names: (names.len() == frames).then_some(names), frames }
    }

    /// The labels of each frame among those that there are, by their names; `None` where there are none.
    /// Without names of frames the labels' order counts.
    ///
    /// # Errors
    /// No frame has labels, or their numbers differ where the order counts.
    pub(super) fn matched<'a, T>(
        &self,
        place: &Path,
        there: &'a BTreeMap<String, T>,
    ) -> Result<Vec<Option<&'a T>>, Failure> {
        let refused = |rule: String| Err(Failure::Refused(format!("{}: {rule}", place.display())));
        let Some(names) = &self.names else {
            let (labelled, frames) = (there.len(), self.frames);
            if labelled != frames {
                return refused(format!(
                    "it has labels of {labelled} frames, the points are {frames} frames that name no files"
                ));
            }
            return Ok(there.values().map(Some).collect());
        };
        let found: Vec<_> = names.iter().map(|name| there.get(name)).collect();
        match names.first() {
            Some(name) if found.iter().all(Option::is_none) => {
                refused(format!("it has labels of none of the frames, the first of which is `{name}`"))
            }
            _ => Ok(found),
        }
    }
}

/// Name of a file without folder and ending.
pub(super) fn name_of(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_belong_to_frames_by_the_names_of_their_files_and_else_by_their_order() {
        let inputs = |names: &[&str]| -> Vec<(String, String)> {
            names.iter().map(|name| ((*name).to_owned(), String::new())).collect()
        };
        let there: BTreeMap<String, u8> = [("00003".to_owned(), 3), ("00007".to_owned(), 7)].into();
        let matched = |names: &[&str], frames| {
            let found = FrameNames::of(&inputs(names), frames).matched(Path::new("label_2"), &there);
            found.map(|found| found.into_iter().map(Option::<&u8>::copied).collect::<Vec<_>>())
        };
        let clouds = ["00002.bin", "00003.bin", "00007.bin", "s.toml", "set.json"];
        assert_eq!(matched(&clouds, 3).unwrap(), [None, Some(3), Some(7)]);
        assert_eq!(matched(&["s.toml", "corner.obj"], 2).unwrap(), [Some(3), Some(7)]);
        // One recording of two frames.
        assert_eq!(matched(&["capture.bin", "s.toml"], 2).unwrap(), [Some(3), Some(7)]);
        for (names, frames, why) in
            [(&clouds[..1], 1, "none of the frames"), (&clouds[3..], 3, "labels of 2 frames")]
        {
            let refused = matched(names, frames).unwrap_err().to_string();
            assert!(refused.starts_with("label_2: ") && refused.contains(why), "{refused}");
        }
    }
}
