//! Trees of antennas that stand outside of bodies; others are refused.

use crate::beams::beam::{BeamTree, TraceSettings};
use crate::bodies::stand_off::{check_enclosed, check_stand};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::oversight::error::BartError;
use crate::oversight::progress::Progress;

impl BeamTree {
    /// [`BeamTree::trace`] while somebody listens, of an antenna that may stand where it does at this
    /// wavelength.
    pub(crate) fn trace_from_outside(
        world: &World,
        antenna: Antenna,
        wavelength_m: f64,
        settings: &TraceSettings,
        progress: &dyn Progress,
    ) -> Result<Self, BartError> {
        check_stand(world, antenna, wavelength_m)?;
        let tree = Self::trace_heard(world, antenna, settings, progress)?;
        tree.check_open(world)?;
        Ok(tree)
    }

    /// Refuses an antenna that is shut in, by what it lights straight.
    pub(crate) fn check_open(&self, world: &World) -> Result<(), BartError> {
        match (self.antenna, self.audit.orders.first()) {
            // Through sheets it lights what stands behind them as well, and waves leave.
            (Antenna::Point(_), Some(first)) if !world.has_sheets() => {
                let lit = self.beams.iter().take_while(|beam| beam.order == 1);
                check_enclosed(world, first.incident_section, lit.map(|beam| (beam.facet, beam.section)))
            }
            _ => Ok(()),
        }
    }
}
