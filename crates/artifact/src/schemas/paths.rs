//! Scattering paths: exact for any bounce order, antenna element, chirp and moving body
//! (`docs/decisions/path-record.md`).

use crate::descriptions::radar::Radar;
use crate::descriptions::settings::Detail;
use crate::files::envelope::Schema;
use crate::quantities::accuracy::{ErrorBudget, ModelError};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::ops::Range;

/// The `.paths` artifact.
pub struct Paths;

impl Schema for Paths {
    const NAME: &'static str = "paths";
    const VERSION: u32 = 14;
    type Header = PathsHeader;
    type Frame = PathsFrame;

    fn contradiction(_header: &PathsHeader, frame: &PathsFrame) -> Option<String> {
        let beyond = frame.paths.iter().position(|path| usize::from(path.order) > MAX_ORDER)?;
        Some(format!("path {beyond} has {} bounces, at most {MAX_ORDER} are held", frame.paths[beyond].order))
    }
}

/// Header of the artifact, the same for all frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathsHeader {
    /// Radar for which the paths were traced.
    pub radar: Radar,
    /// Frequency f_c of the amplitudes and their slopes: the centre of the sampled sweep.
    pub centre_frequency_hz: f64,
    /// Ids of the scene's targets, indexed by [`Path::target`].
    pub targets: Vec<String>,
}

/// Paths of one frame, referred to its first sample.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PathsFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Paths in the tracer's order: body, facet sequence, cell, followed by those traced at several nodes,
    /// node by node; after a reduction of detail, target by target.
    pub paths: Vec<Path>,
    /// Range of each body's nearest lit surface from the radar's position at the frame's middle, m, in the
    /// order of the scene frame's poses; `None` if the body is completely hidden.
    pub nearest_range_m: Vec<Option<f64>>,
    /// Numerical error of this frame's paths.
    pub error: ErrorBudget,
    /// Errors of the physical model in this frame.
    pub model_error: ModelError,
    /// Statistics of the tracer's work.
    pub trace: TraceStatistics,
}

impl PathsFrame {
    /// Frame with the index of every body, target or reflector, mapped by `number`.
    pub fn renumbered(mut self, number: impl Fn(u32) -> u32) -> Self {
        for path in &mut self.paths {
            path.target = number(path.target);
            let met = path.facets_met();
            path.facets[..met].iter_mut().for_each(|facet| facet.body = number(facet.body));
        }
        self
    }
}

/// Value of [`Path::target`] for the road's own backscatter.
pub const GROUND: u32 = u32::MAX;

/// Highest bounce order that a path record holds.
pub const MAX_ORDER: usize = 5;

/// 2 × 2 scattering amplitude in metres, `[receive][transmit]`, v = 0, h = 1.
pub type Amplitude = [[Complex64; 2]; 2];

/// A facet of the scene.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Facet {
    /// Index of the target.
    pub body: u32,
    /// Index of the triangle in its mesh.
    pub triangle: u32,
}

/// One propagation path from transmitter to receiver.
///
/// Its node appears from the transmitter at x_a and from the receiver at x_b, unfolded through the
/// reflections; with L₁ = |x_a − p_t|, L₂ = |x_b − p_r| the scattering amplitude of interface.md is S = Σ
/// a·R_tR_r/(L₁L₂)·e^{−jk(L₁+L₂−R_t−R_r)}: `a` contains neither the phase of its own delay nor 1/length.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Index of the target (of the first facet).
    pub target: u32,
    /// Number of bounces; 0 for a point target.
    pub order: u8,
    /// Apparent point x_a at the frame's first sample, world metres.
    pub apparent_tx_m: [f64; 3],
    /// Velocity of x_a.
    pub apparent_tx_mps: [f64; 3],
    /// Apparent point x_b at the frame's first sample, world metres.
    pub apparent_rx_m: [f64; 3],
    /// Velocity of x_b.
    pub apparent_rx_mps: [f64; 3],
    /// Amplitude a at f_c.
    pub amplitude_m: Amplitude,
    /// Slope a′ = da/df, m/Hz: a(f) = a + (f − f_c)·a′.
    pub slope_m_per_hz: Amplitude,
    /// Facets in the order of travel; only the first `order` are valid.
    pub facets: [Facet; MAX_ORDER],
    /// Changes of the path within the frame beyond a constant velocity.
    pub curve: Curve,
}

/// Changes of a path within the frame beyond a constant velocity; none by default.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Acceleration of x_a, constant.
    pub apparent_tx_mps2: [f64; 3],
    /// Acceleration of x_b, constant.
    pub apparent_rx_mps2: [f64; 3],
    /// Rotation of the node with a wheel; x_a and x_b are then the apparent positions of its hub.
    pub rim: Option<Rim>,
    /// Part of the frame that the path represents; `None` for all of it.
    pub span: Option<Span>,
    /// Part of the array that the path represents; `None` for all of it.
    pub array_span: Option<ArraySpan>,
    /// Pairs of elements that the path represents; `None` for all of them.
    pub array_side: Option<ArraySide>,
}

/// The part of a frame that a path represents, where some propagation paths were traced at several moments:
/// at any time the paths of the nearest moments are blended, each with its [`Span::share`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// First moment, from the frame's first sample.
    pub first_s: f64,
    /// Step from one moment to the next.
    pub step_s: f64,
    /// Number of moments.
    pub moments: u32,
    /// Index of the moment at which the path was traced, from 0.
    pub moment: u32,
}

/// The part of an array that a path represents, where some propagation paths were traced from several places
/// along its row: for any pair of elements the paths of the nearest places are blended, each with its
/// [`ArraySpan::share`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ArraySpan {
    /// Vector d_t, world metres: a pair of elements lies at d_t·p_t + d_r·p_r along the row.
    pub transmit: [f64; 3],
    /// Vector d_r, defined likewise.
    pub receive: [f64; 3],
    /// Coordinate of the first place.
    pub first_m: f64,
    /// Step from one place to the next.
    pub step_m: f64,
    /// Number of places.
    pub places: u32,
    /// Index of the place from which the path was traced, from 0.
    pub place: u32,
}

/// The pairs of elements that a path represents where a polygon is lit from both ends and the outline of its
/// shadow is that of one of them: which one depends on which end is farther along the row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ArraySide {
    /// Vector d_t, world metres: a pair of elements lies at d_t·p_t + d_r·p_r.
    pub transmit: [f64; 3],
    /// Vector d_r, defined likewise.
    pub receive: [f64; 3],
    /// Least coordinate of the pairs.
    pub from_m: f64,
}

/// Number of blended nodes, where there are enough: a cubic.
const BLENDED: u32 = 4;

/// Lagrange polynomial of a node through the four of `count` nodes at 0, 1, 2 … nearest to `place`: 1 at that
/// node and 0 at the others.
fn lagrange(node: u32, count: u32, place: f64) -> f64 {
    let blended = blended_at(count, place);
    if !blended.contains(&node) {
        return 0.0;
    }
    let own = f64::from(node);
    blended.filter(|n| *n != node).map(|n| (place - f64::from(n)) / (own - f64::from(n))).product()
}

/// Nodes that are blended at a place: two before and two behind it, except at the ends.
fn blended_at(count: u32, place: f64) -> Range<u32> {
    let blended = BLENDED.min(count);
    let first = ((place.floor() - 1.0).max(0.0) as u32).min(count - blended);
    first..first + blended
}

impl Span {
    /// Factor of the path's amplitude: Lagrange polynomial through the four moments around `seconds`, 1 at
    /// the path's own moment and 0 at the others. The shares of all moments add up to 1.
    pub fn share(&self, seconds: f64) -> f64 {
        lagrange(self.moment, self.moments, (seconds - self.first_s) / self.step_s)
    }
}

impl ArraySpan {
    /// Factor of the path's amplitude between a transmit and a receive element: Lagrange polynomial through
    /// the four places around that of the pair. The shares of all places add up to 1.
    pub fn share(&self, [tx_m, rx_m]: [[f64; 3]; 2]) -> f64 {
        let along_m = along_m([self.transmit, self.receive], [tx_m, rx_m]);
        lagrange(self.place, self.places, (along_m - self.first_m) / self.step_m)
    }
}

impl ArraySide {
    /// Factor of the path's amplitude between a transmit and a receive element: 1 on this side, 0 on the
    /// other, and one half between both.
    pub fn share(&self, ends_m: [[f64; 3]; 2]) -> f64 {
        let along_m = along_m([self.transmit, self.receive], ends_m);
        match along_m.partial_cmp(&self.from_m) {
            Some(Ordering::Greater) => 1.0,
            Some(Ordering::Equal) => 0.5,
            _ => 0.0,
        }
    }
}

/// Coordinate d_t·p_t + d_r·p_r of a pair of elements.
fn along_m([transmit, receive]: [[f64; 3]; 2], [tx_m, rx_m]: [[f64; 3]; 2]) -> f64 {
    (0..3).map(|i| transmit[i] * tx_m[i] + receive[i] * rx_m[i]).sum()
}

impl Curve {
    /// Factor of the path's amplitude `seconds` after the frame's first sample, between a transmit and a
    /// receive element at these positions: 1 if the path represents the whole frame and array.
    pub fn share(&self, seconds: f64, ends_m: [[f64; 3]; 2]) -> f64 {
        self.span.map_or(1.0, |span| span.share(seconds)) * self.share_of_pair(ends_m)
    }

    /// Factor of the path's amplitude between a transmit and a receive element at any time: 1 if the path
    /// represents the whole array.
    pub fn share_of_pair(&self, ends_m: [[f64; 3]; 2]) -> f64 {
        let over_array = self.array_span.map_or(1.0, |span| span.share(ends_m));
        over_array * self.array_side.map_or(1.0, |side| side.share(ends_m))
    }
}

/// A point on the rim of a wheel that rolls upright without slipping: hub + r·(cos φ·forward + sin φ·up), φ =
/// φ₀ − (distance of the hub along forward)/r.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rim {
    /// Radius r.
    pub radius_m: f64,
    /// Unit vector in the plane of the wheel, horizontal.
    pub forward: [f64; 3],
    /// Angle φ₀ at the frame's first sample, from forward towards up.
    pub angle_rad: f64,
}

impl Path {
    /// Path of a point of target 0, with the same amplitude at all frequencies.
    pub fn of_point(position_m: [f64; 3], velocity_mps: [f64; 3], amplitude_m: Amplitude) -> Self {
        Self {
            apparent_tx_m: position_m,
            apparent_tx_mps: velocity_mps,
            apparent_rx_m: position_m,
            apparent_rx_mps: velocity_mps,
            amplitude_m,
            ..Self::default()
        }
    }

    /// Facets in the order of travel.
    pub fn sequence(&self) -> &[Facet] {
        &self.facets[..self.facets_met()]
    }

    /// Number of facets met, limited to what the record holds, since a damaged one may claim more.
    fn facets_met(&self) -> usize {
        usize::from(self.order).min(MAX_ORDER)
    }
}

/// Statistics of the tracer's work.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TraceStatistics {
    /// Triangles of all bodies.
    pub triangles: u64,
    /// Beams by bounce order, from order 1.
    pub beams: Vec<u64>,
    /// Paths by bounce order, from order 1.
    pub paths: Vec<u64>,
    /// Upper bound on the power of all discarded beams relative to the power kept.
    pub dropped_power_ratio: f64,
    /// Estimated peak memory of the tracer's own structures, bytes.
    pub bytes: u64,
    /// Fineness to which bodies were subdivided and integrated; `None` if there were no bodies.
    pub fineness: Option<Fineness>,
    /// Origin of `error` and `model_error`.
    pub origin: ErrorOrigin,
    /// Reduction of each target's paths; empty if none was requested.
    pub detail: Vec<TargetDetail>,
}

/// Fineness required by the requested accuracy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fineness {
    /// Maximum side length of the part of a facet that forms one path.
    pub cell_m: f64,
    /// Fineness of the integrals on each body.
    pub integrals: Vec<IntegralFineness>,
    /// Number of moments of the frame at which `ways` were traced; 1 where the frame's middle suffices.
    pub moments: u32,
    /// Paths that were traced at all moments: ids of the bodies in the order of travel; the reverse paths are
    /// included.
    pub ways: Vec<Vec<String>>,
    /// Number of places of the array from which `ways_of_places` were traced; 1 where its centre suffices.
    pub places: u32,
    /// Paths that were traced from all places.
    pub ways_of_places: Vec<Vec<String>>,
    /// Motion of the corners of large polygons that are no corners of their facets.
    pub outlines: Outlines,
}

/// Motion of the outlines of shadows, and of what mirrors light, on large flat polygons.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outlines {
    /// They move with the body that they fall on.
    #[default]
    Fixed,
    /// They slide over it, as was traced shortly before and after, and beside the array's centre.
    Sliding,
}

/// Fineness of the integrals on one body, and the resulting error of its echo.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IntegralFineness {
    /// The body's id, since its index among the targets may differ in another frame.
    pub body: String,
    /// Accuracy of each integral, relative to its largest possible value.
    pub accuracy: f64,
    /// Relative error of the body's echo, in the frame that was measured; `None` for a point target and for a
    /// body without echo.
    pub echo_error: Option<f64>,
}

impl Fineness {
    /// Fineness with the errors of the bodies' echoes replaced, in order.
    pub fn with_errors(mut self, errors: Vec<Option<f64>>) -> Self {
        for (body, error) in self.integrals.iter_mut().zip(errors) {
            body.echo_error = error;
        }
        self
    }

    /// Relative error of the echo of the body with this id; `None` if it was not measured.
    pub fn echo_error(&self, body: &str) -> Option<f64> {
        self.integrals.iter().find(|of| of.body == body)?.echo_error
    }
}

/// Origin of a frame's errors.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ErrorOrigin {
    /// Measured in this frame.
    #[default]
    Measured,
    /// Taken over from another frame, together with its fineness.
    TakenOver,
}

/// A target's level of detail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TargetDetail {
    /// Level of detail; never `Auto`.
    pub level: Detail,
    /// Number of traced paths.
    pub traced: u64,
    /// Number of paths in the frame.
    pub kept: u64,
    /// Error of the target's echo relative to that of all its paths, as a relative amplitude; `None` if all
    /// were kept.
    pub error: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blended(moments: u32, of: impl Fn(f64) -> f64, seconds: f64) -> f64 {
        let span = |moment: u32| Span { first_s: 1.0, step_s: 0.25, moments, moment };
        (0..moments).map(|i| span(i).share(seconds) * of(1.0 + 0.25 * f64::from(i))).sum()
    }

    #[test]
    fn a_record_that_tells_of_more_facets_than_it_holds_has_those_that_it_holds() {
        let path = Path { order: 200, ..Path::default() };
        assert_eq!(path.sequence().len(), MAX_ORDER);
        let frame = PathsFrame { paths: vec![path], ..PathsFrame::default() };
        let renumbered = frame.renumbered(|body| body + 3);
        assert!(renumbered.paths[0].facets.iter().all(|facet| facet.body == 3));
    }

    #[test]
    fn shares_blend_a_cubic_exactly_wherever_there_are_four_moments() {
        let cubic = |t: f64| 2.0 - t + 3.0 * t * t - 0.5 * t * t * t;
        for moments in [4, 5, 9, 33] {
            for i in 0..=100 {
                let t = 1.0 + 0.25 * f64::from(moments - 1) * f64::from(i) / 100.0;
                let allowed = 64.0 * f64::EPSILON * cubic(t).abs().max(t.powi(3));
                assert!((blended(moments, cubic, t) - cubic(t)).abs() < allowed, "{moments} {t}");
                assert!((blended(moments, |_| 1.0, t) - 1.0).abs() < 16.0 * f64::EPSILON);
            }
        }
    }

    #[test]
    fn few_moments_blend_a_parabola_a_line_or_nothing() {
        for t in [0.9, 1.0, 1.1, 1.3, 1.6] {
            assert!((blended(3, |t| t * t, t) - t * t).abs() < 1e-14);
            assert!((blended(2, |t| t, t) - t).abs() < 1e-14);
            assert_eq!(blended(1, |_| 3.0, t), 3.0);
        }
    }
}
