//! Frames of points and the labels that belong to them: by the names of the files that the frames were read
//! from, or by their order.

use crate::radar_cloud::import::{extension, frame_order};
use pipeline::host::failure::Failure;
use pipeline::host::progress;
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
    /// Without names of frames the labels' order counts, and for a single frame with a name that is not a
    /// number the only labels.
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
            let mut there: Vec<_> = there.iter().collect();
            there.sort_by_key(|(name, _)| frame_order(Path::new(*name)));
            return Ok(there.into_iter().map(|(_, labels)| Some(labels)).collect());
        };
        let found: Vec<_> = names.iter().map(|name| there.get(name)).collect();
        match names.first() {
            Some(name) if found.iter().all(Option::is_none) => {
                if let Some((only, labels)) = only_labels(names, there) {
                    let place = place.display();
                    progress::note(format!(
                        "note: {place}: the one frame, `{name}`, has the labels `{only}`"
                    ));
                    return Ok(vec![Some(labels)]);
                }
                refused(format!("it has labels of none of the frames, the first of which is `{name}`"))
            }
            _ => Ok(found),
        }
    }
}

/// The only labels of a single frame with another name, as that of a recording; numbers are names that a set
/// gives its frames, so two of them are two frames.
fn only_labels<'a, T>(names: &[String], there: &'a BTreeMap<String, T>) -> Option<(&'a String, &'a T)> {
    let is_number = |name: &str| name.bytes().all(|byte| byte.is_ascii_digit());
    let (only, labels) = there.iter().next()?;
    let [name] = names else { return None };
    (there.len() == 1 && !(is_number(name) && is_number(only))).then_some((only, labels))
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

    #[test]
    fn the_one_frame_of_a_recording_has_the_only_labels_and_a_frame_of_another_number_has_not() {
        let of = |file: &str, there: &[&str]| {
            let there: BTreeMap<String, usize> =
                there.iter().map(|name| (*name).to_owned()).zip(0..).collect();
            let names = FrameNames::of(&[(file.to_owned(), String::new())], 1);
            names.matched(Path::new("label_2"), &there).map(|found| found[0].copied()).ok()
        };
        assert_eq!(of("capture.bin", &["00003"]), Some(Some(0)));
        assert_eq!(of("capture.bin", &["00003", "capture"]), Some(Some(1)));
        assert_eq!(of("capture.bin", &["00003", "00004"]), None);
        assert_eq!(of("00002.bin", &["00003"]), None);
    }

    #[test]
    fn labels_by_order_are_in_the_order_of_their_numbers() {
        let there: BTreeMap<String, u32> =
            [99_999, 100_000].into_iter().map(|number| (number.to_string(), number)).collect();
        let found = FrameNames::of(&[], 2).matched(Path::new("label_2"), &there).unwrap();
        assert_eq!(found, [Some(&99_999), Some(&100_000)]);
    }
}
