//! Antennas of a table at positions where no method is valid.

use crate::bodies::stand_off::check_antenna_position;
use crate::bodies::world::World;
use crate::run_control::error::BartError;
use crate::table::rcs_request::{RcsRequest, aspects};
use crate::table::rcs_table::check;
use artifact::scene::Mesh;
use artifact::units::SPEED_OF_LIGHT_MPS;

/// Refuses a request with an antenna nearer to a facet than a wavelength, or inside a closed body, like
/// [`crate::rcs`], for methods without this check.
pub fn check_antennas(mesh: &Mesh, request: &RcsRequest) -> Result<(), BartError> {
    check(request)?;
    let is_near = request.range_m.is_finite() || request.receiver.is_some_and(|r| r.range_m.is_finite());
    let Some(lowest_hz) = request.frequency_hz.iter().copied().reduce(f64::min).filter(|_| is_near) else {
        return Ok(());
    };
    let world = World::of_mesh(mesh)?;
    let antennas = aspects(request).into_iter().flat_map(|aspect| [Some(aspect.transmit), aspect.receive]);
    antennas
        .flatten()
        .try_for_each(|(antenna, _)| check_antenna_position(&world, antenna, SPEED_OF_LIGHT_MPS / lowest_hz))
}
