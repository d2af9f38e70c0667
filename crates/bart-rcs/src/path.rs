//! The path table of a frame: bodies frozen at the frame's middle, every cell of their lit facets a path that moves.

use crate::antenna::Antenna;
use crate::beam::{BeamTree, TraceSettings};
use crate::error::BartError;
use crate::frame_error::{self, FrameError, GivenUp};
use crate::join::{Trees, tree_order};
use crate::nearest_surface::nearest_range_m;
use crate::path_cells::{Cell, CellSettings, cells, gathered};
use crate::path_pruning::pruned;
use crate::path_sum::PathView;
use crate::scatterer::{Scatterer, ZenithH, bracket_of, check_order};
use crate::world::{Models, World};
use artifact::Waveform;
use artifact::paths::{Amplitude, Facet, MAX_ORDER, Path, PathsFrame, TraceStatistics};
use artifact::scene::{Pose, SceneFrame, SceneHeader, Target, TargetKind};
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Paths of one frame from the radar's position and back, referred to the frame's first sample.
///
/// The world is frozen at the frame's middle; what is lit then is lit all through. Amplitudes are fitted over the sampled
/// sweep. A point target is a path of order 0 with +√σ in vv and hh; bodies do not hide it. Cells are as large as the
/// accuracy asked for lets them be, by measurement: paths are compared with the bodies traced and integrated anew at
/// another moment of the frame, and that is the error that is returned. Facets are taken as the surface itself, so
/// `error.tessellation` is `None`.
pub fn trace_frame(models: &Models, header: &SceneHeader, frame: &SceneFrame) -> Result<PathsFrame, BartError> {
    check_order(header.fidelity.bounces)?;
    let plan = Plan::of(header);
    let snapshot = Snapshot::at(models, header, frame, plan.middle_s, &plan)?;
    let check = Snapshot::at(models, header, frame, plan.check_s, &plan)?;
    let reference = frame_error::reference(&check.scatterer(&plan), &plan);
    let points = point_paths(header, frame);
    let table = fitting_table(&snapshot.scatterer(&plan), &plan, &points, &reference);
    let counts = (1..=header.fidelity.bounces).map(|order| count(&table.paths, order)).collect();
    let dropped_power_ratio = table.error.dropped_at_most.powi(2);
    Ok(PathsFrame {
        index: frame.index,
        time_s: frame.time_s,
        nearest_range_m: nearest_range_m(&snapshot.world, &snapshot.tree, plan.position_m, header.targets.len()),
        error: table.error.budget(),
        model_error: reference.model_error(),
        trace: TraceStatistics {
            triangles: snapshot.world.facets().len() as u64,
            beams: snapshot.tree.audit.orders.iter().map(|order| order.beams).collect(),
            paths: counts,
            dropped_power_ratio,
            bytes: snapshot.bytes() + check.bytes(),
        },
        paths: table.paths,
    })
}

/// What a frame is traced with, from its header.
pub(crate) struct Plan<'a> {
    pub(crate) header: &'a SceneHeader,
    pub(crate) position_m: DVec3,
    pub(crate) band: Band,
    pub(crate) trace: TraceSettings,
    /// After the frame's first sample: when paths are traced, and when they are checked.
    pub(crate) middle_s: f64,
    pub(crate) check_s: f64,
}

/// Bodies and beams of one moment.
struct Snapshot {
    world: World,
    tree: BeamTree,
}

/// Paths with what was measured of them.
struct Table {
    paths: Vec<Path>,
    error: FrameError,
}

impl<'a> Plan<'a> {
    fn of(header: &'a SceneHeader) -> Self {
        let band = Band::of(&header.radar.waveform);
        let middle_s = header.radar.frame_middle_s();
        let fidelity = &header.fidelity;
        // Slivers below λ²/100·accuracy are dropped (physics.md §2), mirrors below a hundred times that are not followed.
        let least_area_m2 = 1e-2 * band.wavelength_m().powi(2) * fidelity.accuracy.amplitude();
        let trace = TraceSettings {
            max_order: tree_order(fidelity.bounces, fidelity.nodes),
            sides: fidelity.sides,
            least_area_m2,
            least_mirror_area_m2: 100.0 * least_area_m2,
        };
        let check_s = middle_s + frame_error::check_offset_s(header.radar.frame_duration_s());
        Self { header, position_m: DVec3::from_array(header.radar.position_m), band, trace, middle_s, check_s }
    }

    /// The element of a 2 × 2 amplitude that the radar's antennas send and receive: errors are told of it.
    pub(crate) fn seen(&self, amplitude: &Amplitude) -> Complex64 {
        let (receive, transmit) = self.header.radar.array.polarization.indices();
        amplitude[receive][transmit]
    }

    /// ĥ straight above and below the radar: to the left of its boresight.
    fn zenith_h(&self) -> DVec3 {
        let azimuth_rad = self.header.radar.boresight_az_rad;
        DVec3::new(-azimuth_rad.cos(), azimuth_rad.sin(), 0.0)
    }

    /// Where paths are summed at a moment of the frame. The origin is arbitrary: the place of the first target.
    pub(crate) fn view(&self, seconds: f64) -> PathView {
        let origin = self.header.targets.first().map_or([0.0; 3], |target| target.start.position_m);
        PathView {
            transmitter_m: self.position_m,
            receiver_m: self.position_m,
            origin_m: DVec3::from_array(origin),
            seconds,
            centre_frequency_hz: self.band.centre_hz,
        }
    }

    fn cell_settings<'b>(&self, size_m: f64, wavenumbers_per_m: &'b [f64]) -> CellSettings<'b> {
        CellSettings {
            size_m,
            velocity_quantum_mps: velocity_quantum_mps(self.header),
            wavenumbers_per_m,
            accuracy: self.header.fidelity.accuracy.amplitude(),
            bracket: bracket_of(self.header.fidelity.nodes),
        }
    }
}

impl Snapshot {
    fn at(
        models: &Models,
        header: &SceneHeader,
        frame: &SceneFrame,
        seconds: f64,
        plan: &Plan<'_>,
    ) -> Result<Self, BartError> {
        let world = World::posed(models, header, frame, seconds)?;
        let tree = BeamTree::trace(&world, Antenna::Point(plan.position_m), &plan.trace)?;
        Ok(Self { world, tree })
    }

    fn scatterer(&self, plan: &Plan<'_>) -> Scatterer<'_> {
        let h = plan.zenith_h();
        Scatterer::new(&self.world, Trees::Shared(&self.tree), ZenithH { transmit: h, receive: h })
    }

    fn bytes(&self) -> u64 {
        (self.world.bytes() + self.tree.bytes()) as u64
    }
}

/// The table with the largest cells that meet the accuracy; the best found where none does within a few attempts.
fn fitting_table(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    points: &[Path],
    reference: &frame_error::Reference,
) -> Table {
    const ATTEMPTS: usize = 4;
    let asked = plan.header.fidelity.accuracy.amplitude();
    let integration_power = frame_error::integration_power(scatterer, plan);
    let table = |size_m: f64| table(scatterer, plan, points, reference, (size_m, integration_power));
    let mut size_m = largest_cell_m(plan, scatterer.world);
    let smallest_m = plan.band.wavelength_m();
    let mut best = table(size_m);
    for _ in 1..ATTEMPTS {
        let error = best.error.measured();
        if error <= asked || size_m <= smallest_m {
            break;
        }
        // Errors of freezing and of the straight line over frequency grow with the first to second power of the size.
        size_m *= (0.7 * asked / error).sqrt().clamp(0.4, 0.8);
        let finer = table(size_m);
        if finer.error.measured() < best.error.measured() {
            best = finer;
        }
    }
    best
}

fn table(
    scatterer: &Scatterer<'_>,
    plan: &Plan<'_>,
    points: &[Path],
    reference: &frame_error::Reference,
    (size_m, integration_power): (f64, f64),
) -> Table {
    let wavenumbers = plan.band.wavenumbers_per_m();
    let settings = plan.cell_settings(size_m, &wavenumbers);
    let found = all_cells(scatterer, plan, &settings);
    let all: Vec<Path> = found.iter().map(|cell| path_of(cell, &plan.band, plan.middle_s)).collect();
    let kept = pruned(all, plan);
    let mut paths = kept.paths;
    paths.extend_from_slice(points);
    let given_up = GivenUp { paths_power: kept.dropped_power, integration_power };
    let error = FrameError::measured_on(scatterer, plan, &paths, points, reference, &given_up);
    Table { paths, error }
}

/// Sampled sweep: amplitudes are taken at the Chebyshev points of its band, where a straight line errs least.
pub(crate) struct Band {
    pub(crate) centre_hz: f64,
    pub(crate) bandwidth_hz: f64,
    /// From the centre to the outer points.
    offset_hz: f64,
}

impl Band {
    fn of(waveform: &Waveform) -> Self {
        let half_hz = 0.5 * waveform.bandwidth_hz().abs();
        Self {
            centre_hz: waveform.centre_frequency_hz(),
            bandwidth_hz: 2.0 * half_hz,
            offset_hz: half_hz * 0.75_f64.sqrt(),
        }
    }

    pub(crate) fn wavelength_m(&self) -> f64 {
        SPEED_OF_LIGHT_MPS / self.centre_hz
    }

    pub(crate) fn wavenumbers_per_m(&self) -> [f64; 3] {
        [-1.0, 0.0, 1.0].map(|side| TAU * (self.centre_hz + side * self.offset_hz) / SPEED_OF_LIGHT_MPS)
    }

    /// Value at the centre and slope of the straight line nearest to three samples.
    fn line(&self, samples: &[Amplitude]) -> (Amplitude, Amplitude) {
        let of = |fit: &dyn Fn(usize, usize) -> Complex64| [0, 1].map(|p| [0, 1].map(|q| fit(p, q)));
        let value = of(&|p, q| samples.iter().map(|a| a[p][q]).sum::<Complex64>() / samples.len() as f64);
        let slope = of(&|p, q| match samples {
            [low, _, high] if self.offset_hz > 0.0 => (high[p][q] - low[p][q]) / (2.0 * self.offset_hz),
            _ => Complex64::ZERO,
        });
        (value, slope)
    }
}

/// Cells of all orders in the order of the joints.
fn all_cells(scatterer: &Scatterer<'_>, plan: &Plan<'_>, settings: &CellSettings<'_>) -> Vec<Cell> {
    let fidelity = &plan.header.fidelity;
    let ends = [Antenna::Point(plan.position_m); 2];
    let of_order = |order: u8| {
        let joints = scatterer.joints(order, fidelity.nodes, plan.trace.least_area_m2);
        gathered(cells(scatterer, &joints, settings), ends, settings)
    };
    (1..=fidelity.bounces).flat_map(of_order).collect()
}

/// Largest side of the cells that one node, one amplitude and its slope may stand for; smaller ones are tried where the
/// measured error asks for it.
///
/// Within D/2 of its node a lit point's length differs from the node's by up to D, there and back: over the band, ±Δk with
/// Δk = πB/c, its phase runs over ±ΔkD, and a straight line over frequency leaves at most (ΔkD)²/4 of it. While the node
/// moves by vT/2 at a right angle, or is seen from an element δ off the radar's position, both legs turn by (vT/2 + δ)/R:
/// the phase between node and point runs over kD(vT/2 + δ)/R. Neighbouring cells cancel most of both (physics.md §6 has
/// −41 dB with cells of 12 cm where this bound says −14 dB), so either may reach four times the accuracy asked.
fn largest_cell_m(plan: &Plan<'_>, world: &World) -> f64 {
    let waveform = &plan.header.radar.waveform;
    let allowed = 4.0 * plan.header.fidelity.accuracy.amplitude();
    let band_per_m = std::f64::consts::PI * waveform.bandwidth_hz().abs() / SPEED_OF_LIGHT_MPS;
    let by_band = 2.0 * allowed.sqrt() / band_per_m;
    let wavenumber = TAU / waveform.wavelength_m();
    let range_m = world.facets().iter().map(|f| plan.position_m.distance(f.corners_m[0])).fold(f64::INFINITY, f64::min);
    let way_m = 0.5 * plan.header.radar.frame_duration_s() * fastest_mps(plan.header) + element_offset_m(plan.header);
    let by_motion = allowed * range_m / (wavenumber * way_m);
    by_band.min(by_motion).clamp(2.0 * waveform.wavelength_m(), waveform.range_resolution_m())
}

fn fastest_mps(header: &SceneHeader) -> f64 {
    header.targets.iter().map(|t| DVec3::from_array(t.start.velocity_mps).length()).fold(0.0, f64::max)
}

fn element_offset_m(header: &SceneHeader) -> f64 {
    let array = &header.radar.array;
    let centre = DVec3::from_array(header.radar.position_m);
    let elements = array.tx_m.iter().chain(&array.rx_m);
    elements.map(|p| DVec3::from_array(*p).distance(centre)).fold(0.0, f64::max)
}

/// Velocities that differ by less leave a phase of k·Δv·T/2 in each leg below the accuracy.
fn velocity_quantum_mps(header: &SceneHeader) -> f64 {
    let half_frame_s = 0.5 * header.radar.frame_duration_s();
    let wavenumber = TAU / header.radar.waveform.wavelength_m();
    header.fidelity.accuracy.amplitude() / (2.0 * wavenumber * half_frame_s)
}

fn path_of(cell: &Cell, band: &Band, middle_s: f64) -> Path {
    let (amplitude_m, slope_m_per_hz) = band.line(&cell.amplitudes_m);
    let at_first_sample = |end: usize| (cell.apparent_m[end] - middle_s * cell.velocity_mps[end]).to_array();
    Path {
        target: cell.facets[0].body,
        order: cell.order,
        apparent_tx_m: at_first_sample(0),
        apparent_tx_mps: cell.velocity_mps[0].to_array(),
        apparent_rx_m: at_first_sample(1),
        apparent_rx_mps: cell.velocity_mps[1].to_array(),
        amplitude_m,
        slope_m_per_hz,
        facets: cell.facets,
    }
}

fn point_paths(header: &SceneHeader, frame: &SceneFrame) -> Vec<Path> {
    let targets = (0..).zip(header.targets.iter().zip(&frame.poses));
    let of = |(target, (kind, pose)): (u32, (&Target, &Pose))| {
        let TargetKind::Point { rcs_m2 } = kind.kind else { return None };
        let root = Complex64::from(rcs_m2.sqrt());
        Some(Path {
            target,
            order: 0,
            apparent_tx_m: pose.position_m,
            apparent_tx_mps: pose.velocity_mps,
            apparent_rx_m: pose.position_m,
            apparent_rx_mps: pose.velocity_mps,
            amplitude_m: [[root, Complex64::ZERO], [Complex64::ZERO, root]],
            slope_m_per_hz: Amplitude::default(),
            facets: [Facet::default(); MAX_ORDER],
        })
    };
    targets.filter_map(of).collect()
}

fn count(paths: &[Path], order: u8) -> u64 {
    paths.iter().filter(|path| path.order == order).count() as u64
}
