//! Features of signatures as CSV, one row per sample of a dataset.

use artifact::Reader;
use artifact::dataset::{Dataset, Sample};
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use pipeline::host::safe_text::in_csv;
use std::io::{Error, Write};
use std::path::Path;

/// Writes the features of every sample's signature, one row each.
pub fn csv(reader: Reader<Dataset>, out: &Path) -> Result<(), Failure> {
    pipeline::host::files::write_with(out, |stream| {
        let columns = column_names().join(",");
        writeln!(stream, "id,class,model,variant,scene,target,frame,split,{columns}")?;
        for sample in progress::frames(reader) {
            let sample = sample.map_err(Error::other)?;
            writeln!(stream, "{}", row(&sample))?;
        }
        Ok(())
    })
}

/// Names of the features; duplicates have their number appended: two features of heights share a name, and
/// readers keep only one of equally named columns.
pub(crate) fn column_names() -> Vec<String> {
    let names = classifier::feature_names();
    let apart = |(at, name): (usize, &&str)| match names[..at].iter().filter(|before| *before == name).count()
    {
        0 => (*name).to_owned(),
        before => format!("{name}_{}", before + 1),
    };
    names.iter().enumerate().map(apart).collect()
}

fn row(sample: &Sample) -> String {
    let Sample { id, variant, scene, target, frame, split, .. } = sample;
    let [id, model] = [id, &sample.model].map(|text| in_csv(text));
    let class = sample.class.map_or("", |class| class.name());
    let values: Vec<String> =
        classifier::features(&sample.signature).iter().map(|(_, v)| format!("{v:.6}")).collect();
    let split = format!("{split:?}").to_lowercase();
    format!("{id},{class},{model},{variant},{scene},{target},{frame},{split},{}", values.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_feature_has_a_column_of_a_name_of_its_own() {
        let names = column_names();
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
        assert_eq!(names.len(), classifier::feature_names().len());
        assert!(names.contains(&"height_of_front_m".to_owned()));
        assert!(names.contains(&"height_of_front_m_2".to_owned()));
    }
}
