//! The strongest object of a scene, and its statement about its speed.

use crate::study::atlas::ErrorStatement;
use crate::study::scenes::detect;
use artifact::points::Object;
use artifact::scene::SceneHeader;
use wayside::host::failure::Failure;

/// The strongest object; `None` if there is none.
pub(super) fn strongest(header: &SceneHeader) -> Result<Option<Object>, Failure> {
    let objects = detect(header)?.points.objects;
    Ok(objects.into_iter().max_by(|a, b| a.snr_db.total_cmp(&b.snr_db)))
}

/// The flag of an unresolved velocity, if it is set.
pub(super) fn unless_resolved(object: &Object) -> ErrorStatement {
    if object.velocity_resolved {
        ErrorStatement::Missing
    } else {
        ErrorStatement::Remark("velocity_resolved is false")
    }
}
