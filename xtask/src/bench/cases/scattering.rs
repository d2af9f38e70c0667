//! The tracer against dense sampling, ray shooting, and another program's rays.

use crate::bench::cases::timing::{FULL, Sizes, timed};
use crate::bench::comparison::Comparison;
use crate::bench::programs::{Job, RivalProgram};
use artifact::paths::Amplitude;
use artifact::scene::Mesh;
use artifact::settings::{NodeRule, Sides};
use bart_rcs::{Antenna, BeamTree, RcsRequest, RcsResult, Standpoint, TraceSettings, World};
use glam::DVec3;
use num_complex::Complex64;
use po_sbr::{Aspect, Bracket, po, sbr};
use wayside::host::failure::Failure;

const RANGE_M: f64 = 30.0;
const AZIMUTH_RAD: f64 = 0.4;
const ELEVATION_RAD: f64 = 0.15;

pub(super) fn all(sizes: Sizes) -> Result<Vec<Comparison>, Failure> {
    let model = if sizes == FULL { "car-suv" } else { "motorcycle-street" };
    let mesh =
        scene::vehicles::mesh(model, 0).ok_or_else(|| Failure::refused(format!("`{model}` is missing")))?;
    let case =
        BodyCase { model, mesh: &mesh, density: sizes.per_wavelength, frequency_hz: sizes.frequency_hz };
    Ok(vec![case.against_po()?, case.against_sbr()?, case.against_embree()?])
}

fn traced(case: &BodyCase<'_>, bounces: u8, nodes: NodeRule) -> Result<RcsResult, Failure> {
    let request = RcsRequest {
        range_m: RANGE_M,
        bounces,
        nodes,
        ..RcsRequest::over(vec![case.frequency_hz], vec![ELEVATION_RAD], vec![AZIMUTH_RAD])
    };
    bart_rcs::rcs(case.mesh, &request, &|_, _| ()).map_err(Failure::refused)
}

fn aspect() -> Aspect {
    Aspect::monostatic(Standpoint {
        azimuth_rad: AZIMUTH_RAD,
        elevation_rad: ELEVATION_RAD,
        range_m: RANGE_M,
    })
}

/// A body, with the sampling density and the frequency for the other methods.
struct BodyCase<'a> {
    model: &'a str,
    mesh: &'a Mesh,
    density: f64,
    frequency_hz: f64,
}

impl BodyCase<'_> {
    fn against_po(&self) -> Result<Comparison, Failure> {
        let BodyCase { model, mesh, density, frequency_hz } = *self;
        let (ours, ours_s) = timed(|| traced(self, 1, NodeRule::Middle))?;
        let sampling = po::Sampling {
            per_wavelength: density,
            shadow_levels: 3,
            sides: Sides::Two,
            bracket: Bracket::Symmetrised,
        };
        let (rival, rival_s) =
            timed(|| po::amplitude(mesh, &aspect(), &[frequency_hz], &sampling).map_err(Failure::refused))?;
        Ok(Comparison {
            name: format!("first order, {model}"),
            ours_s,
            rival: Ok((format!("po, {density} samples per wavelength"), rival_s)),
            error: Some(difference(ours.amplitude_m[0], rival[0][0][0])),
            work: format!(
                "{} triangles, one aspect, {:.0} GHz, {RANGE_M} m",
                mesh.triangles.len(),
                1e-9 * frequency_hz
            ),
        })
    }

    fn against_sbr(&self) -> Result<Comparison, Failure> {
        let BodyCase { model, mesh, density, frequency_hz } = *self;
        let (ours, ours_s) = timed(|| traced(self, 3, NodeRule::Exit))?;
        let shooting = sbr::RaySettings {
            per_wavelength: density,
            bounces: 3,
            sides: Sides::Two,
            bracket: Bracket::Plain,
        };
        let (rival, rival_s) =
            timed(|| sbr::amplitude(mesh, &aspect(), &[frequency_hz], &shooting).map_err(Failure::refused))?;
        let sum: Complex64 = rival.orders.iter().map(|order: &Vec<Amplitude>| order[0][0][0]).sum();
        Ok(Comparison {
            name: format!("three bounces, exit node, {model}"),
            ours_s,
            rival: Ok((format!("sbr, {density} rays per wavelength"), rival_s)),
            error: Some(difference(ours.amplitude_m[0], sum)),
            work: format!(
                "{} triangles, one aspect, one frequency, {} rays",
                mesh.triangles.len(),
                rival.rays
            ),
        })
    }

    /// First hits: the lit silhouette seen from one direction, exactly by beams, otherwise by evenly spaced
    /// rays.
    fn against_embree(&self) -> Result<Comparison, Failure> {
        let BodyCase { model, mesh, density, frequency_hz } = *self;
        let towards =
            DVec3::new(AZIMUTH_RAD.cos(), AZIMUTH_RAD.sin(), ELEVATION_RAD.tan()).normalize_or_zero();
        let settings =
            TraceSettings { max_order: 1, sides: Sides::Two, least_area_m2: 0.0, least_mirror_area_m2: 0.0 };
        let (ours_m2, ours_s) = timed(|| {
            let world = World::of_mesh(mesh).map_err(Failure::refused)?;
            let tree =
                BeamTree::trace(&world, Antenna::Direction(towards), &settings).map_err(Failure::refused)?;
            Ok(tree.audit.orders.first().map_or(0.0, |order| order.lit_section))
        })?;
        let step_m = artifact::units::SPEED_OF_LIGHT_MPS / frequency_hz / density;
        let corners = mesh.triangles.iter().flatten().flat_map(|&vertex| mesh.vertices_m[vertex as usize]);
        let job = Job { name: "first-hits", input: corners.flat_map(|x| (x as f32).to_le_bytes()).collect() };
        let numbers = [towards.x, towards.y, towards.z, step_m].map(|x| x.to_string());
        let answer = job.run_with(RivalProgram::Python("embreex"), &numbers)?;
        let error = answer.as_ref().ok().map(|answer| {
            let theirs_m2: f64 = answer.numbers().next().unwrap_or(f64::NAN);
            (ours_m2 - theirs_m2).abs() / theirs_m2
        });
        Ok(Comparison {
            name: format!("first hits, {model}"),
            ours_s,
            rival: answer.map(|answer| {
                (format!("{}, rays at {density} per wavelength, one thread", answer.program), answer.seconds)
            }),
            error,
            work: format!(
                "{} triangles, from far away, lit area across the direction, with the hierarchy's building",
                mesh.triangles.len()
            ),
        })
    }
}

fn difference(ours: Complex64, rival: Complex64) -> f64 {
    (ours - rival).norm() / rival.norm()
}
