//! Features of signatures as CSV, a row for each sample of a dataset.

use crate::writing::fail;
use artifact::Reader;
use artifact::dataset::{Dataset, Sample};
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use std::io::Write;
use std::path::Path;

/// The features of every sample's signature, a row each.
pub fn csv(reader: Reader<Dataset>, out: &Path) -> Result<(), Failure> {
    let mut failed = None;
    let written = pipeline::host::files::write_with(out, |stream| {
        writeln!(
            stream,
            "id,class,model,variant,scene,target,frame,split,{}",
            classifier::feature_names().join(",")
        )?;
        for sample in progress::frames(reader) {
            let sample = sample.map_err(|e| fail(&mut failed, e))?;
            writeln!(stream, "{}", row(&sample))?;
        }
        Ok(())
    });
    failed.map_or(written, |error| Err(error.into()))
}

fn row(sample: &Sample) -> String {
    let Sample { id, model, variant, scene, target, frame, split, .. } = sample;
    let class = sample.class.map_or("", |class| class.name());
    let values: Vec<String> =
        classifier::features(&sample.signature).iter().map(|(_, v)| format!("{v:.6}")).collect();
    let split = format!("{split:?}").to_lowercase();
    format!("{id},{class},{model},{variant},{scene},{target},{frame},{split},{}", values.join(","))
}
