//! Solvers of one aspect of a body, the tracer and its references, and the difference of two results.

use artifact::Accuracy;
use artifact::paths::Path;
use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::{NodeRule, Sides};
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::{PathView, RcsRequest, RcsResult, Standpoint, scattering_of_paths};
use glam::DVec3;
use num_complex::Complex64;
use po_sbr::{Aspect, Bracket, po, sbr};
use std::f64::consts::TAU;
use wayside::host::failure::Failure;

/// The frequency of the closed forms of docs/physics.md.
pub(super) const FREQUENCY_HZ: f64 = 77e9;
pub(super) const WAVELENGTH_M: f64 = SPEED_OF_LIGHT_MPS / FREQUENCY_HZ;
pub(super) const K: f64 = TAU / WAVELENGTH_M;

/// S of paths relative to the first body, seen from the radar at the middle of the frame.
pub(super) fn first_body_scattering(
    header: &SceneHeader,
    paths: &[Path],
    frequency_hz: f64,
) -> [[Complex64; 2]; 2] {
    let antenna_m = DVec3::from(header.radar.position_m);
    let view = PathView {
        transmitter_m: antenna_m,
        receiver_m: antenna_m,
        origin_m: DVec3::from(header.targets[0].start.position_m),
        seconds: header.radar.frame_middle_s(),
        centre_frequency_hz: header.radar.waveform.centre_frequency_hz(),
    };
    scattering_of_paths(paths, &view, frequency_hz)
}

/// One aspect from infinity, first order, with an accuracy of −60 dB.
pub(super) fn first_order_request(azimuth_deg: f64, elevation_deg: f64) -> RcsRequest {
    RcsRequest {
        bounces: 1,
        nodes: NodeRule::Middle,
        accuracy: Accuracy::from_db(-60.0),
        ..RcsRequest::over(
            vec![FREQUENCY_HZ],
            vec![elevation_deg.to_radians()],
            vec![azimuth_deg.to_radians()],
        )
    }
}

pub(super) fn request_with_bounces(azimuth_deg: f64, elevation_deg: f64, bounces: u8) -> RcsRequest {
    RcsRequest { bounces, ..first_order_request(azimuth_deg, elevation_deg) }
}

pub(super) fn trace_rcs(mesh: &Mesh, request: &RcsRequest) -> Result<RcsResult, Failure> {
    bart_rcs::rcs(mesh, request, &|_, _| ()).map_err(Failure::refused)
}

/// S of a request's single aspect by dense sampling, with the given samples per wavelength and halvings at
/// the borders of shadows.
pub(super) fn po_amplitude(
    body: &Mesh,
    request: &RcsRequest,
    per_wavelength: f64,
    shadow_levels: u32,
) -> Result<Complex64, Failure> {
    let sampling =
        po::Sampling { per_wavelength, shadow_levels, sides: Sides::Two, bracket: Bracket::Symmetrised };
    let found = po::amplitude(body, &aspect(request), &request.frequency_hz, &sampling);
    let (p, q) = request.polarization.indices();
    Ok(found.map_err(Failure::refused)?[0][p][q])
}

/// S of each order of a request's single aspect by rays.
pub(super) fn sbr_amplitudes(
    body: &Mesh,
    request: &RcsRequest,
    shooting: &sbr::RaySettings,
) -> Result<Vec<Complex64>, Failure> {
    let found = sbr::amplitude(body, &aspect(request), &request.frequency_hz, shooting);
    let (p, q) = request.polarization.indices();
    Ok(found.map_err(Failure::refused)?.orders.iter().map(|order| order[0][p][q]).collect())
}

/// Aspect of a request's single antenna, for the references.
pub(super) fn aspect(request: &RcsRequest) -> Aspect {
    Aspect::monostatic(Standpoint {
        azimuth_rad: request.azimuth_rad[0],
        elevation_rad: request.elevation_rad[0],
        range_m: request.range_m,
    })
}

/// ‖S − S_ref‖ / ‖S_ref‖ (docs/conventions.md).
pub(super) fn relative_error(found: &[Complex64], reference: &[Complex64]) -> f64 {
    let power = |values: &mut dyn Iterator<Item = Complex64>| values.map(|z| z.norm_sqr()).sum::<f64>();
    let missed = power(&mut found.iter().zip(reference).map(|(a, b)| a - b));
    (missed / power(&mut reference.iter().copied())).sqrt()
}

/// ||S|/|S_ref| − 1|, for a reference without phase.
pub(super) fn level_error(found: f64, reference: f64) -> f64 {
    (found / reference - 1.0).abs()
}
