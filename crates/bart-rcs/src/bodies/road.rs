//! The road as a mirror: bodies and antenna have images below the plane z = 0, and the plane is taken away.
//!
//! Unfolded at the road, every way is straight: a wave that crosses z = 0 has been reflected there. So bodies and their images
//! are traced together from the antenna, and from its image, which sees the same the other way up; what hides a way before
//! the road hides it in the picture too. A path begins at the antenna and ends there or at the image, and each is counted
//! once: direct, vehicle–road, road–vehicle, road–vehicle–road, and the road between two bounces on vehicles.
//!
//! Where a leg crosses, the field takes the road's coefficients. Seen unfolded, r_TE stays on E across the plane of incidence
//! and r_TM changes its sign, for the mirror turns the other vector over (`docs/physics.md` §5).

use crate::bodies::world::World;
use crate::error::BartError;
use crate::geometry::antenna::Antenna;
use crate::geometry::plane::Plane;
use crate::materials::reflection_coefficients::Pair;
use crate::materials::surface_response::reflection;
use artifact::material::{Material, Road};
use artifact::permittivity::substance;
use artifact::radar::Polarization;
use artifact::scene::{SceneHeader, TargetKind};
use artifact::settings::{EchoMode, Edges, Sides};
use glam::DVec3;
use std::f64::consts::TAU;

/// z = 0.
pub(crate) const ROAD_PLANE: Plane = Plane { normal: DVec3::Z, offset_m: 0.0 };

/// The other side of the road.
pub(crate) fn below(v: DVec3) -> DVec3 {
    v.with_z(-v.z)
}

/// What crossing z = 0 makes of a field seen unfolded: r_TE and −r_TM, weakened by e^{−g²/2}, g = 2kσ sinψ (Ament 1953).
pub(crate) fn crossing(road: &Material, rms_height_m: f64, sine: f64, wavenumber_per_m: f64) -> Pair {
    let g = 2.0 * wavenumber_per_m * rms_height_m * sine;
    let loss = (-0.5 * g * g).exp();
    let Pair { te, tm } = reflection(road, sine, wavenumber_per_m);
    Pair { te: loss * te, tm: -loss * tm }
}

/// On which side of the road something stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Half {
    /// Where the vehicles are.
    Above,
    /// Where their images are.
    Below,
}

/// The image of an antenna.
pub(crate) fn image(antenna: Antenna) -> Antenna {
    antenna.mirrored(&ROAD_PLANE)
}

/// What the road cannot go with is refused by name.
pub(crate) fn check_road(header: &SceneHeader) -> Result<(), BartError> {
    let refused = |choice| Err(BartError::NotBuilt { choice });
    let fidelity = &header.fidelity;
    match header.road {
        None => Ok(()),
        Some(_) if header.radar.position_m[2] <= 0.0 => {
            Err(BartError::AntennaBelowRoad { height_m: header.radar.position_m[2] })
        }
        Some(_) if fidelity.edges == Edges::FirstOrder => refused("[road] with edges = \"on\""),
        Some(_) if fidelity.sides == Sides::One => refused("[road] with sides = \"one\""),
        Some(_) if fidelity.echo == EchoMode::RcsTable => refused("[road] with echo = \"rcs-table\""),
        Some(_) => Ok(()),
    }
}

/// What leaving the road out costs, as an amplitude relative to the direct echo: √((2|r|)² + |r|⁴), r at the height of each
/// body's middle, dry asphalt of 0.5 mm; bodies weighted by 1/R⁴. An estimate: it takes a body to scatter as much towards
/// the road as back to the radar. `None` where the road is there, or no body.
pub(crate) fn left_out(header: &SceneHeader, poses: &[artifact::scene::Pose]) -> Option<f64> {
    if header.road.is_some() {
        return None;
    }
    let asphalt = Material::HalfSpace { permittivity: substance("asphalt")?.permittivity? };
    let road = Road { material: asphalt, rms_height_m: 5e-4 };
    let (mut sum, mut weights) = (0.0, 0.0);
    for (target, pose) in header.targets.iter().zip(poses) {
        let TargetKind::Mesh { mesh, .. } = target.kind else { continue };
        let top_m = header.meshes.get(mesh as usize)?.vertices_m.iter().map(|v| v[2]).fold(0.0, f64::max);
        let middle = DVec3::from_array(pose.position_m) + DVec3::Z * 0.5 * top_m;
        let (share, range_m) = share(header, &road, middle);
        let weight = range_m.powi(-4);
        sum += weight * share;
        weights += weight;
    }
    (weights > 0.0).then(|| (sum / weights).sqrt())
}

/// Power of the road's paths over that of the direct one, and the range.
fn share(header: &SceneHeader, road: &Road, at: DVec3) -> (f64, f64) {
    let from = DVec3::from_array(header.radar.position_m);
    let way = at - below(from);
    let wavenumber = TAU / header.radar.waveform.wavelength_m();
    let sine = (way.z / way.length()).abs();
    let Pair { te, tm } = crossing(&road.material, road.rms_height_m, sine, wavenumber);
    let r = match header.radar.array.polarization {
        Polarization::Hh => te.norm(),
        Polarization::Vv => tm.norm(),
        Polarization::Vh | Polarization::Hv => (te.norm() * tm.norm()).sqrt(),
    };
    ((2.0 * r).powi(2) + r.powi(4), at.distance(from))
}

/// Which side a facet is on.
pub(crate) fn half_of(world: &World, facet: u32) -> Half {
    if world.is_image(facet) { Half::Below } else { Half::Above }
}
