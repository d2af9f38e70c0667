//! A motorcycle before scaling to its size.

use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::motorcycle::parts::CycleWheel;

/// A motorcycle as drawn at nominal size.
pub(crate) struct NominalMotorcycle {
    /// Parts without the wheels: these stretch with the size.
    pub(crate) parts: Assembly,
    pub(crate) front: CycleWheel,
    pub(crate) rear: CycleWheel,
}
