//! Trees of antennas that stand outside bodies; others are refused.

use crate::beams::beam::{BeamTree, TraceSettings};
use crate::bodies::stand_off::{check_antenna_position, check_enclosed};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::run_control::error::BartError;
use crate::run_control::progress::Progress;

impl BeamTree {
    /// [`BeamTree::trace`] with progress, for an antenna whose position is permitted at this wavelength.
    pub(crate) fn trace_from_outside(
        world: &World,
        antenna: Antenna,
        wavelength_m: f64,
        settings: &TraceSettings,
        progress: &dyn Progress,
    ) -> Result<Self, BartError> {
        check_antenna_position(world, antenna, wavelength_m)?;
        let tree = Self::trace_with_progress(world, antenna, settings, progress)?;
        tree.check_open(world)?;
        Ok(tree)
    }

    /// Refuses an enclosed antenna, judged by the facets that it lights directly or through sheets; waves
    /// pass the sheets themselves.
    pub(crate) fn check_open(&self, world: &World) -> Result<(), BartError> {
        match (self.antenna, self.audit.orders.first()) {
            (Antenna::Point(_), Some(first)) => {
                let lit = || self.beams.iter().take_while(|beam| beam.order == 1);
                let sheets = lit().filter(|beam| world.is_transparent(beam.facet));
                let of_sheets_sr: f64 = sheets.map(|beam| beam.section).sum();
                let walls = lit().filter(|beam| !world.is_transparent(beam.facet));
                let parts = walls.map(|beam| (beam.facet, beam.section));
                check_enclosed(world, first.incident_section - of_sheets_sr, parts)
            }
            _ => Ok(()),
        }
    }
}
