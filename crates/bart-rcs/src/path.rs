//! The path table of a frame: bodies frozen at the frame's middle, every cell of their lit facets a path that moves.

use crate::antenna::Antenna;
use crate::beam::{BeamTree, TraceSettings};
use crate::error::BartError;
use crate::join::{Trees, tree_order};
use crate::nearest_surface::nearest_range_m;
use crate::path_cells::{Cell, CellSettings, cells, gathered};
use crate::scatterer::{Scatterer, ZenithH, bracket_of, check_order};
use crate::world::{Models, World};
use artifact::paths::{Amplitude, Facet, MAX_ORDER, Path, PathsFrame, TraceStatistics};
use artifact::scene::{SceneFrame, SceneHeader, TargetKind};
use artifact::settings::Fidelity;
use artifact::units::SPEED_OF_LIGHT_MPS;
use artifact::{ErrorBudget, ModelError, Waveform};
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Paths of one frame from the radar's position and back, referred to the frame's first sample.
///
/// The world is frozen at the frame's middle; which facets are lit then is lit all through. Amplitudes are fitted over the
/// sampled sweep. A point target is a path of order 0 with +√σ in vv and hh; bodies do not hide it.
pub fn trace_frame(models: &Models, header: &SceneHeader, frame: &SceneFrame) -> Result<PathsFrame, BartError> {
    check_order(header.fidelity.bounces)?;
    let middle_s = header.radar.frame_middle_s();
    let world = World::posed(models, header, frame, middle_s)?;
    let antenna = Antenna::Point(DVec3::from_array(header.radar.position_m));
    let band = Band::of(&header.radar.waveform);
    let settings = trace_settings(&header.fidelity, band.wavelength_m());
    let tree = BeamTree::trace(&world, antenna, &settings)?;
    let zenith_h = boresight_h(header.radar.boresight_az_rad);
    let scatterer = Scatterer::new(&world, Trees::Shared(&tree), ZenithH { transmit: zenith_h, receive: zenith_h });
    let sampled = band.wavenumbers_per_m();
    let cell_settings = CellSettings {
        size_m: cell_size_m(header, &world, antenna),
        velocity_quantum_mps: velocity_quantum_mps(header),
        wavenumbers_per_m: &sampled,
        accuracy: header.fidelity.accuracy.amplitude(),
        bracket: bracket_of(header.fidelity.nodes),
    };
    let found = all_cells(&scatterer, &header.fidelity, &cell_settings, settings.least_area_m2, antenna);
    let mut paths: Vec<Path> = found.iter().map(|cell| path_of(cell, &band, middle_s)).collect();
    let counts = counts_by_order(&paths, header.fidelity.bounces);
    paths.extend(point_paths(header, frame));
    Ok(PathsFrame {
        index: frame.index,
        time_s: frame.time_s,
        paths,
        nearest_range_m: nearest_range_m(
            &world,
            &tree,
            DVec3::from_array(header.radar.position_m),
            header.targets.len(),
        ),
        error: ErrorBudget::default(),
        model_error: ModelError::default(),
        trace: TraceStatistics {
            triangles: world.facets().len() as u64,
            beams: tree.audit.orders.iter().map(|order| order.beams).collect(),
            paths: counts,
            dropped_power_ratio: 0.0,
            bytes: (world.bytes() + tree.bytes()) as u64,
        },
    })
}

/// Sampled sweep: amplitudes are taken at the Chebyshev points of its band, where a straight line errs least.
pub(crate) struct Band {
    centre_hz: f64,
    /// From the centre to the outer points.
    offset_hz: f64,
}

impl Band {
    fn of(waveform: &Waveform) -> Self {
        let half_hz = 0.5 * waveform.bandwidth_hz().abs();
        Self { centre_hz: waveform.centre_frequency_hz(), offset_hz: half_hz * 0.75_f64.sqrt() }
    }

    fn wavelength_m(&self) -> f64 {
        SPEED_OF_LIGHT_MPS / self.centre_hz
    }

    fn wavenumbers_per_m(&self) -> [f64; 3] {
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

/// Slivers below λ²/100·accuracy are dropped (physics §2); mirrors a hundred times that size, a λ/10 square at −20 dB …,
/// are not followed further.
fn trace_settings(fidelity: &Fidelity, wavelength_m: f64) -> TraceSettings {
    let least_area_m2 = 1e-2 * wavelength_m * wavelength_m * fidelity.accuracy.amplitude();
    TraceSettings {
        max_order: tree_order(fidelity.bounces, fidelity.nodes),
        sides: fidelity.sides,
        least_area_m2,
        least_mirror_area_m2: 100.0 * least_area_m2,
    }
}

/// ĥ straight above and below the radar: to the left of its boresight.
fn boresight_h(boresight_az_rad: f64) -> DVec3 {
    DVec3::new(-boresight_az_rad.cos(), boresight_az_rad.sin(), 0.0)
}

fn all_cells(
    scatterer: &Scatterer<'_>,
    fidelity: &Fidelity,
    settings: &CellSettings<'_>,
    least_area_m2: f64,
    antenna: Antenna,
) -> Vec<Cell> {
    let mut found = Vec::new();
    for order in 1..=fidelity.bounces {
        let joints = scatterer.joints(order, fidelity.nodes, least_area_m2);
        let of_order = cells(scatterer, &joints, settings);
        found.extend(gathered(of_order, [antenna; 2], settings));
    }
    found
}

/// Side of the cells that one node, one amplitude and its slope may stand for.
///
/// Within D of its node a lit point's length differs from the node's by up to 2D at the ends of the band, ±ΔkD in each
/// leg with Δk = πB/c: the straight line over frequency leaves (2ΔkD/2)²/4 of it. While the node moves by vT/2 at a right
/// angle, or is seen from an element δ off the radar's position, both legs turn by (vT/2 + δ)/R: the phase between node
/// and a point D/2 away turns by kD(vT/2 + δ)/R. Each may reach the accuracy asked, as phases of independent cells.
fn cell_size_m(header: &SceneHeader, world: &World, antenna: Antenna) -> f64 {
    let waveform = &header.radar.waveform;
    let accuracy = header.fidelity.accuracy.amplitude();
    let band_per_m = std::f64::consts::PI * waveform.bandwidth_hz().abs() / SPEED_OF_LIGHT_MPS;
    let by_band = 2.0 * accuracy.sqrt() / band_per_m;
    let wavenumber = TAU / waveform.wavelength_m();
    let range_m = world.facets().iter().map(|f| antenna.path_length_m(f.corners_m[0])).fold(f64::INFINITY, f64::min);
    let way_m = 0.5 * header.radar.frame_duration_s() * fastest_mps(header) + element_offset_m(header);
    let by_motion = accuracy * range_m / (wavenumber * way_m);
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
    let of = |(target, (kind, pose)): (u32, (&artifact::scene::Target, &artifact::scene::Pose))| {
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

fn counts_by_order(paths: &[Path], bounces: u8) -> Vec<u64> {
    (1..=bounces).map(|order| paths.iter().filter(|path| path.order == order).count() as u64).collect()
}
