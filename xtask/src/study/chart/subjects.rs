//! Bodies whose scattering is computed by all methods, from a plate to a truck.

use crate::project::shared;
use crate::study::bodies::{self, Face};
use crate::study::extent::Extent;
use artifact::scene::Mesh;
use wayside::host::failure::Failure;

/// A body, with its aspect and its sampling density.
pub(super) struct Subject {
    pub(super) name: &'static str,
    pub(super) body: Mesh,
    pub(super) azimuth_deg: f64,
    pub(super) elevation_deg: f64,
    /// Samples per wavelength for dense sampling, and rays for ray shooting.
    pub(super) samples: Densities,
    pub(super) rays: Densities,
}

/// Densities per wavelength: the charted ones, and that of the reference for beams; without one, because it
/// would take hours, beams are compared with their own finest setting, and the charted densities show how the
/// other method approaches it.
#[derive(Clone, Copy)]
pub(super) struct Densities {
    pub(super) charted: &'static [f64],
    pub(super) finest: Option<f64>,
}

const fn dense(charted: &'static [f64], finest: f64) -> Densities {
    Densities { charted, finest: Some(finest) }
}

const fn coarse(charted: &'static [f64]) -> Densities {
    Densities { charted, finest: None }
}

/// Every body of the chart, or the one of a quick chart, without those whose third-party files are missing.
pub(super) fn all(extent: Extent) -> Result<Vec<Subject>, Failure> {
    match extent {
        Extent::Quick => Ok(vec![corner()]),
        Extent::Full => Ok(small().into_iter().chain(vehicles()?).collect()),
    }
}

fn subject(name: &'static str, body: Mesh, [az, el]: [f64; 2], [samples, rays]: [Densities; 2]) -> Subject {
    Subject { name, body, azimuth_deg: az, elevation_deg: el, samples, rays }
}

const SMALL: [Densities; 2] = [dense(&[1.0, 2.0, 4.0, 8.0], 20.0), dense(&[1.0, 2.0, 4.0, 8.0], 40.0)];

/// A trihedral of 0.1 m with a cube of 3 cm in it: shadows and three bounces.
pub(super) fn corner() -> Subject {
    let cube = bodies::shifted(bodies::cube(0.03, &Face::ALL), [0.06, 0.05, 0.02]);
    let body = bodies::joined(bodies::square_trihedral(0.1), &cube);
    subject("trihedral 0.1 m with a cube of 3 cm, 30 m", body, [40.0, 30.0], SMALL)
}

fn small() -> Vec<Subject> {
    const ROUND: [Densities; 2] = [dense(&[1.0, 2.0, 4.0], 10.0), dense(&[1.0, 2.0, 4.0, 8.0], 20.0)];
    vec![
        subject("plate 0.2 m, 7° off, 30 m", bodies::plate(0.2), [7.0, 4.0], SMALL),
        subject("dihedral 0.15 m of 100°, 30 m", bodies::dihedral(100.0), [5.0, 12.0], SMALL),
        corner(),
        subject("top hat 0.1 m on a floor, 30 m", bodies::top_hat(0.1, 0.15, 96, 0.5), [0.0, 30.0], ROUND),
    ]
}

fn vehicles() -> Result<Vec<Subject>, Failure> {
    const NEAR: [Densities; 2] = [dense(&[1.0, 2.0], 4.0), dense(&[1.0, 2.0, 4.0], 8.0)];
    const CAR: [Densities; 2] = [coarse(&[1.0, 2.0]), dense(&[1.0, 2.0, 4.0], 8.0)];
    const LARGE: [Densities; 2] = [coarse(&[1.0]), coarse(&[1.0, 2.0])];
    let at = |name, body, densities| subject(name, body, [23.0, 9.0], densities);
    let mut all = vec![
        at("motorcycle-street, 30 m", own("motorcycle-street")?, NEAR),
        at("car-suv, 30 m", own("car-suv")?, CAR),
    ];
    let file = shared().join("vehicles/gazebo_prius.glb");
    if file.is_file() {
        let body =
            scene::read_mesh(&file, &scene::MeshOptions { unit_scale: None }).map_err(Failure::refused)?;
        all.push(at("a real car, 30 m", body, LARGE));
    }
    all.push(at("bus-city, 30 m", own("bus-city")?, LARGE));
    all.push(at("truck-semi, 30 m", own("truck-semi")?, LARGE));
    Ok(all)
}

fn own(model: &str) -> Result<Mesh, Failure> {
    scene::vehicles::mesh(model, 0).ok_or_else(|| Failure::refused(format!("`{model}` is missing")))
}
