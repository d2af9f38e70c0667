//! Summits of a cloud: points that lie in no main lobe of a stronger one.
//!
//! A cloud may hold one point for each detected cell. Those on the slope of an echo have velocities of their
//! own cells, up to two from that of the echo, so the summit alone tells how the echo moves. The rule is that
//! by which [`dsp::objects_of_points`] finds the points to cluster.

use artifact::cube::CubeHeader;
use artifact::points::Point;
use radar::doppler_ambiguity::folded_mps;

/// Half a main lobe of a window like Hann's, cells.
const LOBE_CELLS: f64 = 2.0;

/// Index of the summit of each point, strongest first: the point itself, or the summit of the strongest one
/// within a main lobe of it in range and velocity and within the reach of a cluster across.
pub(super) fn summits(header: &CubeHeader, points: &[Point]) -> Vec<usize> {
    let span_mps = 2.0 * header.radar.velocity_max_mps();
    let lobe_m = LOBE_CELLS * header.radar.waveform.range_resolution_m();
    let lobe_mps = LOBE_CELLS * header.radar.velocity_resolution_mps();
    let cross_m = |point: &Point| header.dsp.road.across_along_m(point.position_m)[0];
    let crosses_m: Vec<f64> = points.iter().map(cross_m).collect();
    let is_on_slope = |weak: usize, strong: usize| {
        let [of_weak, of_strong] = [weak, strong].map(|index| &points[index]);
        let apart_mps = of_weak.radial_velocity_mps - of_strong.radial_velocity_mps;
        (of_weak.range_m - of_strong.range_m).abs() <= lobe_m
            && folded_mps(apart_mps, span_mps).abs() <= lobe_mps
            && (crosses_m[weak] - crosses_m[strong]).abs() <= header.dsp.cluster_cross_m
    };
    let mut summits: Vec<usize> = Vec::with_capacity(points.len());
    for index in 0..points.len() {
        let stronger = (0..index).find(|other| is_on_slope(index, *other));
        summits.push(stronger.map_or(index, |stronger| summits[stronger]));
    }
    summits
}
