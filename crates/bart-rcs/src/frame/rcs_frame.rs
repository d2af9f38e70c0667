//! The paper's σ_f for one frame: far-field tables of every target over frequency and the range of aspects.

use crate::beams::beam::{BeamTree, TraceSettings};
use crate::bodies::body_gains::BodyGains;
use crate::bodies::models::{BodyMesh, Models};
use crate::bodies::motion::position_m;
use crate::bodies::road::check_road;
use crate::bodies::world::World;
use crate::edges::lit_edge::tree_order_with;
use crate::frame::band_power::frequencies_hz;
use crate::geometry::antenna::Antenna;
use crate::integral::polarization::zenith_h;
use crate::joins::band::INTERPOLATION_ERROR;
use crate::joins::joint::Trees;
use crate::joins::scatterer::{Integration, Scatterer, ZenithH, bracket_of, check_order};
use crate::run_control::error::BartError;
use crate::run_control::progress::{NoProgress, Phase, Progress};
use crate::surface::skin::{COARSER, FinerSkin, reported_error};
use crate::table::aspect_settings::{Finer, IntegralsCheck};
use crate::table::far_field_error::Compared;
use crate::table::measured_aspects::interpolation_error;
use crate::table::order_joints::{JointSettings, OrderJoints};
use crate::table::rcs_table::next_order;
use crate::table::small_mirrors::SmallMirrors;
use artifact::rcs::{RcsFrame, RcsTable};
use artifact::scene::{Mesh, Pose, SceneFrame, SceneHeader, Target, TargetKind};
use artifact::settings::{Edges, Surface};
use artifact::units::{SPEED_OF_LIGHT_MPS, amplitude_ratio};
use artifact::{ErrorBudget, ModelError};
use glam::{DMat3, DVec3};
use num_complex::Complex64;
use radar::standpoint::{Standpoint, nearest_turn};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// [`crate::Tracer::tables`] for these models.
pub(crate) fn rcs_frame(
    models: &Models,
    header: &SceneHeader,
    frame: &SceneFrame,
    progress: &dyn Progress,
) -> Result<RcsFrame, BartError> {
    check_order(header.fidelity.bounces)?;
    check_road(header)?;
    check_wheels(models, header)?;
    if frame.poses.len() != header.targets.len() {
        let (poses, targets) = (frame.poses.len(), header.targets.len());
        return Err(BartError::PosesDoNotMatch { frame: frame.index, poses, targets });
    }
    let gains = BodyGains::of(models, header, frame)?;
    let mut tables = Vec::new();
    let mut powers = Powers::default();
    for (index, (target, pose)) in (0..).zip(header.targets.iter().zip(&frame.poses)) {
        progress.at(Phase::Bodies, index as usize, header.targets.len());
        tables.push(match target.kind {
            TargetKind::Point { rcs_m2, .. } => {
                let table = point_table(header, index, rcs_m2);
                powers.add(&Powers::of_point(header, pose, (&table, gains.of_way([index; 2]))));
                table
            }
            TargetKind::Mesh { mesh, .. } => {
                let meshes = header.meshes.len();
                let missing = || BartError::MeshOutOfRange { target: target.id.clone(), mesh, meshes };
                let mesh = header.meshes.get(mesh as usize).ok_or_else(missing)?;
                let model = models.of(target)?.ok_or_else(missing)?;
                let world = World::alone(model, target, mesh.makeup.transmission)?;
                let body = TabulatedBody::new(header, (target, mesh), world, pose);
                let (of_body, table) =
                    body.weighted_by_gain(gains.of_way([index; 2])).measured_table(index)?;
                powers.add(&of_body);
                table
            }
        });
    }
    Ok(RcsFrame {
        index: frame.index,
        time_s: frame.time_s,
        tables,
        error: powers.error(),
        model_error: powers.model_error(header.fidelity.bounces),
    })
}

/// Refuses rotating parts: a table holds a body that is rigid during a frame.
fn check_wheels(models: &Models, header: &SceneHeader) -> Result<(), BartError> {
    let refused = |choice| Err(BartError::NotBuilt { choice });
    let on_wheel = |target: &Target| matches!(target.kind, TargetKind::Point { wheel: Some(_), .. });
    match header.targets.iter().any(on_wheel) {
        _ if !models.vehicles_of_wheels(header).is_empty() => {
            refused("wheels = \"turning\" with echo = \"rcs-table\"")
        }
        true => refused("a point on a wheel with echo = \"rcs-table\""),
        false => Ok(()),
    }
}

/// Maximum number of values of an axis, odd: beyond it interpolation exceeds the requested error, as reported
/// by the echo's own check.
const AZIMUTHS_MAX: usize = 9;
const ELEVATIONS_MAX: usize = 5;
const FREQUENCIES_MAX: usize = 257;
/// Number of instants of a frame at which aspects are evaluated. An extreme between two of them exceeds
/// theirs by at most an eightieth of the whole rotation, and the echo extrapolates a table by one step.
const INSTANTS: usize = 9;
/// Number of frequencies at which powers are summed.
const FREQUENCIES: usize = 12;
/// Phase rotation below which an aspect counts as constant; rounding of angles rotates a body of 100 m by
/// less.
const STILL_RAD: f64 = 1e-6;

/// A body in its own frame and its aspects towards the radar during the frame.
struct TabulatedBody<'a> {
    header: &'a SceneHeader,
    target: &'a Target,
    mesh: &'a Mesh,
    pose: &'a Pose,
    world: World,
    radius_m: f64,
    /// Product of both ends' gains towards it.
    gain: f64,
}

/// Sums over bodies of received powers at the middle aspect: over 1/R⁴, with the gains.
#[derive(Default)]
struct Powers {
    total: f64,
    by_order: Vec<f64>,
    /// Error of the integrals, measured or from their allowance over frequency.
    integration: f64,
    /// Difference to coarser facets in place of a skin, and the error for which the facets were subdivided.
    tessellation: f64,
    cut_for: f64,
    /// Power of all dropped beams, with independent phases.
    dropped: f64,
    /// Error of frozen shadows at the end of the sweep.
    freezing: f64,
    /// Difference from the spherical wave, and the power of that wave and of the point targets, to which the
    /// relative error refers.
    far_field: f64,
    spherical: f64,
}

impl<'a> TabulatedBody<'a> {
    fn new(
        header: &'a SceneHeader,
        (target, mesh): (&'a Target, &'a Mesh),
        world: World,
        pose: &'a Pose,
    ) -> Self {
        Self { header, target, mesh, pose, world, radius_m: mesh.reach_m(), gain: 1.0 }
    }

    fn weighted_by_gain(self, gain: f64) -> Self {
        Self { gain, ..self }
    }

    /// One tree at the middle aspect serves both the table and the estimation of its errors.
    fn measured_table(&self, target: u32) -> Result<(Powers, RcsTable), BartError> {
        let middle = self.to_radar_m(self.header.radar.frame_middle_s());
        let tree = self.trace(Antenna::Direction(middle / middle.length()))?;
        let scatterer = self.scatterer(&tree, middle);
        let meetings = self.meetings(&scatterer);
        Ok((self.powers(&scatterer, &meetings)?, self.table(target, &scatterer, &meetings)))
    }

    /// Vector from the body's origin to the radar, body axes.
    fn to_radar_m(&self, seconds: f64) -> DVec3 {
        let origin = position_m(self.pose, seconds);
        DMat3::from_rotation_z(-self.pose.yaw_rad - self.pose.yaw_radps * seconds)
            * (DVec3::from_array(self.header.radar.position_m) - origin)
    }

    fn table(&self, target: u32, scatterer: &Scatterer<'_>, meetings: &[OrderJoints]) -> RcsTable {
        let [elevation_rad, azimuth_rad] = self.aspect_axes();
        let frequency_hz = self.frequency_axis();
        let wavenumbers: Vec<f64> = frequency_hz.iter().map(|f| TAU * f / SPEED_OF_LIGHT_MPS).collect();
        let aspects: Vec<DVec3> =
            elevation_rad.iter().flat_map(|el| azimuth_rad.iter().map(|az| direction(*el, *az))).collect();
        let of = |r: &DVec3| self.sums(&scatterer.turned_to(*r), meetings, &wavenumbers);
        let by_aspect: Vec<Vec<Complex64>> = aspects.par_iter().map(of).collect();
        let amplitude_m = (0..frequency_hz.len()).flat_map(|f| by_aspect.iter().map(move |s| s[f])).collect();
        RcsTable {
            target,
            frequency_hz,
            elevation_rad,
            azimuth_rad,
            range_m: f64::INFINITY,
            polarization: self.header.radar.array.polarization,
            amplitude_m,
        }
    }

    /// Powers from which the errors of the table are estimated, at a few frequencies.
    fn powers(&self, scatterer: &Scatterer<'_>, meetings: &[OrderJoints]) -> Result<Powers, BartError> {
        let waveform = &self.header.radar.waveform;
        let (centre_hz, bandwidth_hz) = (waveform.centre_frequency_hz(), waveform.bandwidth_hz());
        let frequencies = frequencies_hz(centre_hz, bandwidth_hz, FREQUENCIES);
        let wavenumbers: Vec<f64> = frequencies.iter().map(|f| TAU * f / SPEED_OF_LIGHT_MPS).collect();
        let [middle, last] =
            [0.5, 1.0].map(|share| self.to_radar_m(share * self.header.radar.frame_duration_s()));
        let last_r = last / last.length();
        let by_order = self.by_order(scatterer, meetings, &self.integration(&wavenumbers));
        let table = total(&by_order, wavenumbers.len());
        let frozen = self.sums(&scatterer.turned_to(last_r), meetings, &wavenumbers);
        let anew = self.anew(Antenna::Direction(last_r), last, &wavenumbers)?;
        let spherical = self.anew(Antenna::Point(middle), middle, &wavenumbers)?;
        let near = Compared::of(&table, &spherical);
        let weight = (self.gain / middle.length_squared()).powi(2);
        let of_frequencies = wavenumbers.len() as f64;
        Ok(Powers {
            total: weight * power(&table),
            integration: weight * self.integration_power(scatterer, meetings, (&table, &wavenumbers)),
            tessellation: weight * self.tessellation_power(middle, (&table, &wavenumbers))?,
            cut_for: self.world.skin_error(),
            dropped: weight * of_frequencies * self.dropped_m(scatterer, meetings, &wavenumbers).powi(2),
            by_order: by_order.iter().map(|s| weight * power(s)).collect(),
            freezing: weight * difference(&frozen, &anew),
            far_field: weight * near.difference,
            spherical: weight * near.spherical,
        })
    }

    /// Power of the error of the integrals at the middle aspect: from the difference to finer ones, except
    /// for flat facets alone, whose closed form is exact.
    fn integration_power(
        &self,
        scatterer: &Scatterer<'_>,
        meetings: &[OrderJoints],
        (table, wavenumbers): (&[Complex64], &[f64]),
    ) -> f64 {
        let edges = self.header.fidelity.edges;
        let is_bent = self.world.skin_error() > 0.0;
        let integration = self.integration(wavenumbers);
        let interpolation = power(table) * self.interpolation_error().powi(2);
        if edges == Edges::Ignored && !is_bent {
            return interpolation;
        }
        let finer = Finer::comparison(scatterer, meetings, &integration);
        let accuracy = finer.bounds() * integration.accuracy;
        let finer_m = self.by_order(scatterer, meetings, &Integration { accuracy, ..integration });
        let finer_m = total(&finer_m, wavenumbers.len());
        let bounds = (integration.accuracy, edges);
        let compared = (difference(table, &finer_m), finer);
        IntegralsCheck::Compared.error_power(compared, bounds, power(&finer_m)) + interpolation
    }

    /// Power of the change with coarser facets in place of a skin at the middle aspect, or with finer ones
    /// where these show more ([`FinerSkin`]); zero if facets are the surface.
    fn tessellation_power(
        &self,
        middle: DVec3,
        (table, wavenumbers): (&[Complex64], &[f64]),
    ) -> Result<f64, BartError> {
        if self.header.fidelity.surface == Surface::Flat {
            return Ok(0.0);
        }
        let (header, own) = (self.header, self.world.facets().len());
        let differing = |mesh: BodyMesh| -> Result<(f64, usize), BartError> {
            let world = World::alone(Arc::new(mesh), self.target, self.mesh.makeup.transmission)?;
            let other = TabulatedBody { world, ..*self };
            let other_m = other.anew(Antenna::Direction(middle / middle.length()), middle, wavenumbers)?;
            Ok((difference(table, &other_m), other.world.facets().len()))
        };
        let error = COARSER * self.world.skin_error();
        let (by_coarser, coarser) = differing(Models::coarser_of(header, self.mesh, error)?)?;
        let Some(cut) = FinerSkin::affordable(own, coarser, header.fidelity.bounces) else {
            return Ok(by_coarser);
        };
        let (by_finer, _) = differing(Models::finer_of(header, self.mesh, cut.times)?)?;
        Ok(by_coarser.max(cut.over_difference().powi(2) * by_finer))
    }

    /// Amplitude of all dropped beams, with independent phases.
    fn dropped_m(&self, scatterer: &Scatterer<'_>, meetings: &[OrderJoints], wavenumbers: &[f64]) -> f64 {
        let trace = self.trace_settings();
        let mut mirrors = SmallMirrors::of(scatterer.trees, trace.max_order, trace.least_mirror_area_m2);
        let (integration, polarization) =
            (self.integration(wavenumbers), self.header.radar.array.polarization);
        for meeting in meetings {
            mirrors.add(mirrors.hits(scatterer, meeting, &integration, polarization));
        }
        let overlaps = meetings.iter().map(|meeting| meeting.facets.dropped_sections);
        let [dropped_m, _] = mirrors.dropped_m(scatterer.trees, overlaps, (trace.max_order, wavenumbers));
        dropped_m
    }

    fn anew(
        &self,
        antenna: Antenna,
        to_radar_m: DVec3,
        wavenumbers: &[f64],
    ) -> Result<Vec<Complex64>, BartError> {
        let tree = self.trace(antenna)?;
        let scatterer = self.scatterer(&tree, to_radar_m);
        Ok(self.sums(&scatterer, &self.meetings(&scatterer), wavenumbers))
    }

    fn trace(&self, antenna: Antenna) -> Result<BeamTree, BartError> {
        let wavelength_m = self.header.radar.waveform.wavelength_m();
        BeamTree::trace_from_outside(&self.world, antenna, wavelength_m, &self.trace_settings(), &NoProgress)
    }

    /// Settings as for paths: slivers below λ²/100·accuracy are dropped, mirrors below a hundred times that
    /// are not followed.
    fn trace_settings(&self) -> TraceSettings {
        let fidelity = &self.header.fidelity;
        let least_area_m2 =
            1e-2 * self.header.radar.waveform.wavelength_m().powi(2) * fidelity.accuracy.amplitude();
        TraceSettings {
            max_order: tree_order_with(fidelity.edges, fidelity.bounces, fidelity.nodes),
            sides: fidelity.sides,
            least_area_m2,
            least_mirror_area_m2: 100.0 * least_area_m2,
        }
    }

    fn scatterer<'b>(&'b self, tree: &'b BeamTree, to_radar_m: DVec3) -> Scatterer<'b> {
        let h = zenith_h(angles(to_radar_m)[1]);
        Scatterer::new(&self.world, Trees::Shared(tree), ZenithH { transmit: h, receive: h })
    }

    fn meetings(&self, scatterer: &Scatterer<'_>) -> Vec<OrderJoints> {
        let least_area_m2 = self.trace_settings().least_area_m2;
        let fidelity = &self.header.fidelity;
        let wavenumber_per_m = TAU / self.header.radar.waveform.wavelength_m();
        let settings =
            JointSettings { nodes: fidelity.nodes, edges: fidelity.edges, least_area_m2, wavenumber_per_m };
        (1..=fidelity.bounces).map(|order| OrderJoints::of(scatterer, order, &settings)).collect()
    }

    fn integration<'b>(&self, wavenumbers_per_m: &'b [f64]) -> Integration<'b> {
        let fidelity = &self.header.fidelity;
        Integration {
            wavenumbers_per_m,
            accuracy: fidelity.accuracy.amplitude(),
            bracket: bracket_of(fidelity.nodes),
        }
    }

    /// Error allowed for integrals over frequency, relative to S: all except closed forms, and layers, are
    /// evaluated at few frequencies.
    fn interpolation_error(&self) -> f64 {
        let (frequencies, accuracy) =
            (self.frequency_axis().len(), self.header.fidelity.accuracy.amplitude());
        match self.world.skin_error() > 0.0 || self.header.fidelity.edges == Edges::FirstOrder {
            true => INTERPOLATION_ERROR * accuracy,
            false => interpolation_error(&self.world, frequencies, accuracy),
        }
    }

    fn sums(
        &self,
        scatterer: &Scatterer<'_>,
        meetings: &[OrderJoints],
        wavenumbers: &[f64],
    ) -> Vec<Complex64> {
        total(&self.by_order(scatterer, meetings, &self.integration(wavenumbers)), wavenumbers.len())
    }

    /// S of each order over frequency, in the radar's polarization.
    fn by_order(
        &self,
        scatterer: &Scatterer<'_>,
        meetings: &[OrderJoints],
        integration: &Integration<'_>,
    ) -> Vec<Vec<Complex64>> {
        let (p, q) = self.header.radar.array.polarization.indices();
        let of =
            |m: &OrderJoints| m.sum(scatterer, DVec3::ZERO, integration).iter().map(|s| s[p][q]).collect();
        meetings.iter().map(of).collect()
    }

    /// Elevations and azimuths of the table: the aspects of a body that approaches and recedes within one
    /// frame do not lie between those at the frame's ends.
    fn aspect_axes(&self) -> [Vec<f64>; 2] {
        let frame_s = self.header.radar.frame_duration_s();
        let aspect = |i: usize| angles(self.to_radar_m(frame_s * i as f64 / (INSTANTS - 1) as f64));
        let first = aspect(0);
        let aspects: Vec<[f64; 2]> = (0..INSTANTS)
            .map(aspect)
            .map(|[elevation, azimuth]| [elevation, nearest_turn(azimuth, first[1])])
            .collect();
        [(0, ELEVATIONS_MAX), (1, AZIMUTHS_MAX)].map(|(angle, most)| {
            let values = aspects.iter().map(|aspect| aspect[angle]);
            let [low, high] = values.fold([first[angle]; 2], |[low, high], v| [low.min(v), high.max(v)]);
            self.angle_axis(low, high, most)
        })
    }

    /// Values in steps of the phase 2kr·Δangle for which linear interpolation meets the requested accuracy;
    /// both ends, ascending. A single value if the phase is constant: the angle is the same up to rounding.
    fn angle_axis(&self, low: f64, high: f64, most: usize) -> Vec<f64> {
        let wavenumber = TAU / self.header.radar.waveform.wavelength_m();
        let turn_rad = 2.0 * wavenumber * self.radius_m * (high - low);
        if turn_rad < STILL_RAD { vec![low] } else { axis(low, high, self.steps(turn_rad, most)) }
    }

    /// The sampled sweep, extended by the frequency shift of a chirp's delay: μτ, 5 MHz at 60 m.
    fn frequency_axis(&self) -> Vec<f64> {
        let waveform = &self.header.radar.waveform;
        let ends_s = [0.0, self.header.radar.frame_duration_s()];
        let farthest_m = ends_s.map(|t| self.to_radar_m(t).length()).into_iter().fold(0.0, f64::max);
        let behind_hz = waveform.slope_hz_per_s.abs() * 2.0 * farthest_m / SPEED_OF_LIGHT_MPS;
        let (centre_hz, half_hz) = (waveform.centre_frequency_hz(), 0.5 * waveform.bandwidth_hz().abs());
        let turn = 2.0 * TAU * self.radius_m * (2.0 * half_hz + behind_hz) / SPEED_OF_LIGHT_MPS;
        // The received chirp lags the transmitted one: its frequency is lower for rising chirps, higher for
        // falling ones.
        let [below_hz, above_hz] =
            if waveform.slope_hz_per_s > 0.0 { [behind_hz, 0.0] } else { [0.0, behind_hz] };
        let ends_hz = [centre_hz - half_hz - below_hz, centre_hz + half_hz + above_hz];
        axis(ends_hz[0], ends_hz[1], self.steps(turn, FREQUENCIES_MAX))
    }

    /// Number of values such that interpolating a phasor that rotates by Δφ between two errs by at most
    /// Δφ²/8. It is odd, and at least three: the echo estimates its error from every second one.
    fn steps(&self, turn_rad: f64, most: usize) -> usize {
        let step = (8.0 * self.header.fidelity.accuracy.amplitude()).sqrt();
        ((turn_rad / step).ceil() as usize + 1).clamp(3, most) | 1
    }
}

impl Powers {
    /// Power of a point target, which is exact.
    fn of_point(header: &SceneHeader, pose: &Pose, (table, gain): (&RcsTable, f64)) -> Self {
        let at_m = position_m(pose, header.radar.frame_middle_s());
        let weight = (gain / at_m.distance_squared(DVec3::from_array(header.radar.position_m))).powi(2);
        let total = weight * FREQUENCIES as f64 * power(&table.amplitude_m);
        Self { total, spherical: total, ..Self::default() }
    }

    fn add(&mut self, other: &Self) {
        self.total += other.total;
        self.integration += other.integration;
        self.tessellation += other.tessellation;
        self.cut_for = self.cut_for.max(other.cut_for);
        self.dropped += other.dropped;
        self.freezing += other.freezing;
        self.far_field += other.far_field;
        self.spherical += other.spherical;
        self.by_order.resize(self.by_order.len().max(other.by_order.len()), 0.0);
        self.by_order.iter_mut().zip(&other.by_order).for_each(|(a, b)| *a += b);
    }

    fn relative(&self, part: f64) -> f64 {
        amplitude_ratio(part, self.total)
    }

    /// Errors of the table: integrals are exact to rounding at best; shadows are those of the middle.
    fn error(&self) -> ErrorBudget {
        let told = reported_error(self.relative(self.tessellation), self.cut_for);
        ErrorBudget {
            integration: Some(self.relative(self.integration).max(1e-12)),
            tessellation: (self.cut_for > 0.0).then_some(told),
            dropped: Some(self.relative(self.dropped)),
            freezing: Some(self.relative(self.freezing)),
            ..ErrorBudget::default()
        }
    }

    fn model_error(&self, bounces: u8) -> ModelError {
        let by_order: Vec<f64> = (0..usize::from(bounces))
            .map(|o| self.relative(self.by_order.get(o).copied().unwrap_or(0.0)))
            .collect();
        ModelError {
            bounces: next_order(&by_order),
            far_field: Some(amplitude_ratio(self.far_field, self.spherical)),
            ..ModelError::default()
        }
    }
}

fn point_table(header: &SceneHeader, target: u32, rcs_m2: f64) -> RcsTable {
    let (p, q) = header.radar.array.polarization.indices();
    let amplitude = if p == q { rcs_m2.sqrt() } else { 0.0 };
    RcsTable {
        target,
        frequency_hz: vec![header.radar.waveform.centre_frequency_hz()],
        elevation_rad: vec![0.0],
        azimuth_rad: vec![0.0],
        range_m: f64::INFINITY,
        polarization: header.radar.array.polarization,
        amplitude_m: vec![Complex64::from(amplitude)],
    }
}

/// Elevation and azimuth of a vector.
fn angles(to_radar_m: DVec3) -> [f64; 2] {
    [to_radar_m.z.atan2(to_radar_m.x.hypot(to_radar_m.y)), to_radar_m.y.atan2(to_radar_m.x)]
}

fn direction(elevation_rad: f64, azimuth_rad: f64) -> DVec3 {
    Standpoint { azimuth_rad, elevation_rad, range_m: f64::INFINITY }.direction()
}

/// An axis of `count` values including both ends; a single value if the span is zero.
fn axis(from: f64, to: f64, count: usize) -> Vec<f64> {
    if to <= from {
        return vec![from];
    }
    (0..count).map(|i| from + (to - from) * i as f64 / (count - 1) as f64).collect()
}

fn total(by_order: &[Vec<Complex64>], count: usize) -> Vec<Complex64> {
    let zero = vec![Complex64::ZERO; count];
    by_order.iter().fold(zero, |all, order| all.iter().zip(order).map(|(a, b)| a + b).collect())
}

fn power(values: &[Complex64]) -> f64 {
    values.iter().map(|s| s.norm_sqr()).sum()
}

fn difference(a: &[Complex64], b: &[Complex64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm_sqr()).sum()
}
