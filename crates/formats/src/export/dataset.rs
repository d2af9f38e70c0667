//! Crops as uint8 `[sample, velocity, range]`, or as pictures.

use crate::export::rdm::receding_upwards;
use crate::npy_stream::NpyStream;
use crate::safe_file_name::safe_file_name;
use crate::sidecar;
use artifact::Reader;
use artifact::dataset::{Crop, Dataset, Sample};
use pipeline::host::failure::Failure;
use pipeline::host::{files, progress};
use serde_json::{Value, json};
use std::path::Path;

/// Writes the crops as a NumPy array `[sample, velocity, range]` of grey levels, with labels in its sidecar.
pub fn npy(file: &Path, out: &Path) -> Result<(), Failure> {
    let reader = Reader::<Dataset>::open(file)?;
    sidecar::claim(out)?;
    let format = *reader.header();
    let side = format.side as usize;
    let mut labels = Vec::new();
    let mut failed = None;
    let written = NpyStream::write::<u8>(out, &[reader.frames() as usize, side, side], |stream| {
        for sample in progress::frames(reader) {
            match sample.map_err(Failure::from).and_then(|sample| Ok((label(&sample), image(file, sample)?)))
            {
                Ok((label, crop)) => {
                    labels.push(label);
                    stream.append(&crop.pixels)?;
                }
                Err(failure) => {
                    failed = Some(failure);
                    return Err(std::io::Error::other("a sample is damaged or has no image"));
                }
            }
        }
        sidecar::remove_outdated(out)
    });
    failed.map_or(written, Err)?;
    sidecar::write(
        out,
        &json!({ "shape": ["sample", "velocity", "range"], "format": format, "samples": labels }),
    )
}

/// The image of a sample; refused for a dataset without images.
fn image(file: &Path, sample: Sample) -> Result<Crop, Failure> {
    let Sample { id, crop, .. } = sample;
    crop.ok_or_else(|| {
        let rule = "has no image: the recipe of this dataset says crops = false";
        Failure::Refused(format!("{}: sample `{id}` {rule}", file.display()))
    })
}

/// Fields of a sample's line in `manifest.jsonl`.
pub(crate) fn label(sample: &Sample) -> Value {
    json!({
        "id": sample.id, "class": sample.class.map(|c| c.name()),
        "model": sample.model, "variant": sample.variant,
        "scene": sample.scene, "target": sample.target, "frame": sample.frame,
        "range_m": sample.range_m, "velocity_mps": sample.radial_velocity_mps, "lane": sample.lane,
        "seed": sample.seed, "split": sample.split,
    })
}

/// Writes one grey picture per sample in the folder `out`; receding is at the top, as in all pictures.
pub fn png(file: &Path, out: &Path) -> Result<(), Failure> {
    let reader = Reader::<Dataset>::open(file)?;
    let side = reader.header().side;
    for sample in progress::frames(reader) {
        let sample = sample?;
        let place = out.join(format!("{}.png", safe_file_name(&sample.id)));
        files::refuse_foreign_head(&place, reporting::pictures::is_own)?;
        let upwards = receding_upwards(&image(file, sample)?.pixels, side);
        reporting::pictures::write_gray(&place, [side as usize; 2], &upwards)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::dataset::{CropFormat, Split};
    use artifact::signature::Signature;
    use artifact::{Provenance, Writer};

    #[test]
    fn the_last_row_of_a_crop_is_the_first_of_its_picture() {
        let folder = tempfile::tempdir().unwrap();
        let (file, out) = (folder.path().join("a.dataset"), folder.path().join("crops"));
        let format = CropFormat {
            side: 2,
            range_span_m: 24.0,
            velocity_span_mps: 8.0,
            floor_db: 0.0,
            ceiling_db: 60.0,
        };
        let crop = Crop { pixels: vec![1, 2, 3, 4], range_m: 30.0, radial_velocity_mps: 0.0 };
        let sample = Sample {
            id: "a".into(),
            signature: Signature::default(),
            crop: Some(crop),
            class: None,
            model: String::new(),
            variant: 0,
            scene: 0,
            target: 0,
            frame: 0,
            split: Split::Test,
            range_m: 30.0,
            radial_velocity_mps: 0.0,
            lane: None,
            seed: 0,
        };
        let mut writer = Writer::<Dataset>::create(&file, &Provenance::default(), &format).unwrap();
        writer.write(&sample).unwrap();
        writer.finish().unwrap();
        png(&file, &out).unwrap();
        let expected = folder.path().join("expected.png");
        reporting::pictures::write_gray(&expected, [2, 2], &[3, 4, 1, 2]).unwrap();
        assert_eq!(std::fs::read(out.join("a.png")).unwrap(), std::fs::read(expected).unwrap());
    }
}
