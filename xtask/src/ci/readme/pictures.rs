//! Comparison of the main job's pictures in the docs with those just drawn.

use std::io::BufReader;
use std::path::Path;
use wayside::host::failure::Failure;

/// Pictures in `docs/pictures` with the run's file names.
const SHOWN: [(&str, &str); 2] = [("scene.png", "scene-0000.png"), ("rdm.png", "rdm-0000.png")];

/// Share of the pixels that may differ: other instruction sets round differently, and a point of the cloud
/// may move by a pixel.
const MAY_DIFFER: f64 = 0.002;

/// Sentences about pictures of `docs` that differ from those in the folder `made`.
pub(super) fn outdated(docs: &Path, made: &Path) -> Result<Vec<String>, Failure> {
    let mut outdated = Vec::new();
    for (shown, drawn) in SHOWN {
        let (shown, drawn) = (docs.join(shown), made.join(drawn));
        let share = differing(&Pixels::read(&shown)?, &Pixels::read(&drawn)?);
        if share > MAY_DIFFER {
            let percent = 100.0 * share;
            let (shown, drawn) = (shown.display(), drawn.display());
            outdated.push(format!(
                "{shown} is not what the main job draws ({percent:.1} % of it): cp {drawn} {shown}"
            ));
        }
    }
    Ok(outdated)
}

/// Samples of a picture, row by row.
struct Pixels {
    size: (u32, u32),
    bytes_per_pixel: usize,
    samples: Vec<u8>,
}

impl Pixels {
    fn read(file: &Path) -> Result<Self, Failure> {
        let opened = std::fs::File::open(file).map_err(|e| Failure::system(file, "open", e))?;
        let refused = |e: png::DecodingError| Failure::refused(format!("{}: {e}", file.display()));
        let mut reader = png::Decoder::new(BufReader::new(opened)).read_info().map_err(refused)?;
        let bytes = reader.output_buffer_size();
        let bytes = bytes.ok_or_else(|| Failure::refused(format!("{}: too large", file.display())))?;
        let mut samples = vec![0; bytes];
        let frame = reader.next_frame(&mut samples).map_err(refused)?;
        let bytes_per_pixel = frame.color_type.samples();
        Ok(Self { size: (frame.width, frame.height), bytes_per_pixel, samples })
    }
}

/// Share of the pixels that differ visibly, 0 to 1; 1 if the sizes differ.
fn differing(a: &Pixels, b: &Pixels) -> f64 {
    const TO_THE_EYE: u8 = 40;
    if (a.size, a.bytes_per_pixel) != (b.size, b.bytes_per_pixel) {
        return 1.0;
    }
    let pixels = a.samples.chunks(a.bytes_per_pixel).zip(b.samples.chunks(b.bytes_per_pixel));
    let count =
        pixels.clone().filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > TO_THE_EYE)).count();
    count as f64 / pixels.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_differ_by_the_share_of_their_pixels_and_wholly_in_another_size() {
        let grey = |size, samples: &[u8]| Pixels { size, bytes_per_pixel: 1, samples: samples.to_vec() };
        let a = grey((2, 2), &[0, 10, 20, 200]);
        assert_eq!(differing(&a, &a), 0.0);
        assert_eq!(differing(&a, &grey((2, 2), &[30, 10, 20, 100])), 0.25);
        assert_eq!(differing(&a, &grey((4, 1), &[0, 10, 20, 200])), 1.0);
    }

    #[test]
    fn a_picture_of_another_run_is_told_with_the_command_that_mends_it() {
        let folder = tempfile::tempdir().unwrap();
        let docs = crate::project::project_root().join("docs/pictures");
        for (shown, drawn) in SHOWN {
            std::fs::copy(docs.join(shown), folder.path().join(drawn)).unwrap();
        }
        assert_eq!(outdated(&docs, folder.path()).unwrap(), Vec::<String>::new());
        std::fs::copy(docs.join("rdm.png"), folder.path().join("scene-0000.png")).unwrap();
        let told = outdated(&docs, folder.path()).unwrap().join("; ");
        assert!(told.contains("scene.png is not what the main job draws") && told.contains("cp "), "{told}");
        assert!(!told.contains("rdm.png is not"), "{told}");
    }
}
