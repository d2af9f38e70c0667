//! The road as a mirror: bodies and antenna have images below the plane z = 0, and the plane is removed.
//!
//! Unfolded at the road, every path is straight: a wave that crosses z = 0 has been reflected there. Bodies
//! and their images are therefore traced together from the antenna, and from its image, which sees the same
//! upside down; an obstacle before the road also hides the unfolded path. A path starts at the antenna and
//! ends there or at the image, and each is counted once: direct, vehicle–road, road–vehicle,
//! road–vehicle–road, and the road between two bounces on vehicles.
//!
//! At each crossing the field is multiplied by the road's coefficients. In the unfolded geometry, r_TE
//! applies to E across the plane of incidence, while r_TM changes its sign, since the mirror reverses the
//! other vector (`docs/physics.md` §5).

use crate::bodies::world::World;
use crate::materials::reflection_coefficients::PolarizationPair;
use crate::materials::surface_response::reflection;
use crate::run_control::error::BartError;
use artifact::Radar;
use artifact::material::{Material, Road};
use artifact::permittivity::substance;
use artifact::scene::SceneHeader;
use artifact::settings::{EchoMode, Sides};

/// Factors of the unfolded field at its crossing of z = 0: r_TE and −r_TM, reduced by e^{−g²/2}, g = 2kσ sinψ
/// (Ament 1953).
pub(crate) fn crossing(
    road: &Material,
    rms_height_m: f64,
    sine: f64,
    wavenumber_per_m: f64,
) -> PolarizationPair {
    let g = 2.0 * wavenumber_per_m * rms_height_m * sine;
    let loss = (-0.5 * g * g).exp();
    let PolarizationPair { te, tm } = reflection(road, sine, wavenumber_per_m);
    PolarizationPair { te: loss * te, tm: -loss * tm }
}

/// Half-space above or below the road.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum HalfSpace {
    /// Half-space of the vehicles.
    Above,
    /// Half-space of their images.
    Below,
}

/// Refuses, by name, settings that are incompatible with the road.
pub(crate) fn check_road(header: &SceneHeader) -> Result<(), BartError> {
    let refused = |choice| Err(BartError::NotBuilt { choice });
    let fidelity = &header.fidelity;
    match header.road {
        None => Ok(()),
        Some(_) if lowest_m(&header.radar) <= 0.0 => {
            Err(BartError::AntennaBelowRoad { height_m: lowest_m(&header.radar) })
        }
        Some(_) if fidelity.sides == Sides::One => refused("[road] with sides = \"one\""),
        Some(_) if fidelity.echo == EchoMode::RcsTable => refused("[road] with echo = \"rcs-table\""),
        Some(_) => Ok(()),
    }
}

/// Height of the lowest of the radar's position and its elements.
fn lowest_m(radar: &Radar) -> f64 {
    let elements = radar.array.tx_m.iter().chain(&radar.array.rx_m);
    elements.map(|element| element[2]).fold(radar.position_m[2], f64::min)
}

/// Dry asphalt with a roughness of 0.5 mm: the road that a scene without one is reported to leave out.
pub fn usual_road() -> Option<Road> {
    let asphalt = Material::HalfSpace { permittivity: substance("asphalt")?.permittivity? };
    Some(Road { material: asphalt, rms_height_m: 5e-4 })
}

/// Half-space that contains a facet.
pub(crate) fn half_of(world: &World, facet: u32) -> HalfSpace {
    if world.is_image(facet) { HalfSpace::Below } else { HalfSpace::Above }
}
