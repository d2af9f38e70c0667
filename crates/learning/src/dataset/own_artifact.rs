//! Artifacts under names that nobody typed: those of their own kind are replaced, all else is refused.

use artifact::{ArtifactError, Fault, Reader, Schema};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use std::path::Path;

/// Refuses, before the work, to replace a file that is no artifact, or one of another kind. A damaged
/// artifact of this kind and an empty file are replaced.
pub(crate) fn refuse_other_artifact<S: Schema>(place: &Path) -> Result<(), Failure> {
    files::refuse_no_artifact(place)?;
    let rule = format!("is no `{}` artifact, and would be replaced", S::NAME);
    files::refuse_unless(place, &rule, || is_of_kind::<S>(place))
}

/// Whether an artifact is of this kind, as far as it can be read.
fn is_of_kind<S: Schema>(place: &Path) -> bool {
    let opened = Reader::<S>::open_own(place).map(drop);
    !matches!(opened, Err(ArtifactError { fault: Fault::Schema { .. }, .. }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::classes::{Classes, ClassesHeader};
    use artifact::model::Model;
    use artifact::{Provenance, Writer};

    #[test]
    fn artifacts_of_another_kind_and_other_files_stay_and_damaged_ones_of_this_kind_do_not() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("weights.model");
        let header = ClassesHeader { classes: vec![] };
        Writer::<Classes>::create(&place, &Provenance::default(), &header).unwrap().finish().unwrap();
        assert!(refuse_other_artifact::<Classes>(&place).is_ok());
        let refused = refuse_other_artifact::<Model>(&place).unwrap_err();
        assert!(refused.to_string().contains("weights.model: is no `model` artifact"), "{refused}");
        assert!(matches!(refused, Failure::System(_)), "exit code 2");
        let whole = std::fs::read(&place).unwrap();
        std::fs::write(&place, &whole[..20]).unwrap();
        assert!(refuse_other_artifact::<Model>(&place).is_ok(), "nothing tells its kind");
        std::fs::write(&place, "mine").unwrap();
        let refused = refuse_other_artifact::<Model>(&place).unwrap_err().to_string();
        assert!(refused.contains("was not written by this program"), "{refused}");
        std::fs::write(&place, "").unwrap();
        assert!(refuse_other_artifact::<Model>(&place).is_ok());
    }
}
