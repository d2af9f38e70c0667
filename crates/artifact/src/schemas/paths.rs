//! Scattering paths: exact for any bounce order, antenna element, chirp and moving body
//! (`docs/decisions/path-record.md`).

use crate::descriptions::radar::Radar;
use crate::descriptions::settings::Detail;
use crate::files::envelope::Schema;
use crate::quantities::accuracy::{ErrorBudget, ModelError};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// The `.paths` artifact.
pub struct Paths;

impl Schema for Paths {
    const NAME: &'static str = "paths";
    const VERSION: u32 = 12;
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
    /// The radar the paths were traced for.
    pub radar: Radar,
    /// Frequency f_c of the amplitudes and their slopes: the centre of the sampled sweep.
    pub centre_frequency_hz: f64,
    /// Ids of the scene's targets; [`Path::target`] points here.
    pub targets: Vec<String>,
}

/// Paths of one frame, referred to its first sample.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PathsFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Paths in the tracer's order: body, facet sequence, cell, and behind them what was traced at several
    /// nodes, one after the other; where detail was taken from them, target by target.
    pub paths: Vec<Path>,
    /// Nearest lit surface of each body from the radar's position at the frame's middle, m, in the order of
    /// the scene frame's poses; `None` if all is hidden.
    pub nearest_range_m: Vec<Option<f64>>,
    /// Numerical error of this frame's paths.
    pub error: ErrorBudget,
    /// Errors of the physical model in this frame.
    pub model_error: ModelError,
    /// Statistics of the tracer's work.
    pub trace: TraceStatistics,
}

impl PathsFrame {
    /// The frame with every body, target or reflector, numbered anew.
    pub fn renumbered(mut self, number: impl Fn(u32) -> u32) -> Self {
        for path in &mut self.paths {
            path.target = number(path.target);
            let met = path.facets_met();
            path.facets[..met].iter_mut().for_each(|facet| facet.body = number(facet.body));
        }
        self
    }
}

/// The [`Path::target`] of the road's own backscatter.
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

/// One way from transmitter to receiver.
///
/// Its node appears from the transmitter at x_a and from the receiver at x_b, unfolded through the
/// reflections; with L₁ = |x_a − p_t|, L₂ = |x_b − p_r| the scattering amplitude of interface.md is S = Σ
/// a·R_tR_r/(L₁L₂)·e^{−jk(L₁+L₂−R_t−R_r)}: `a` holds neither its own delay's phase nor 1/length.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Index of the target (of the first facet).
    pub target: u32,
    /// Bounces; 0 for a point target.
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
    /// The facets in the order of travel; the first `order` are meant.
    pub facets: [Facet; MAX_ORDER],
    /// Changes of the path within the frame, beside a constant velocity.
    pub curve: Curve,
}

/// Changes of a path within the frame, beside a constant velocity; none by default.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Acceleration of x_a, constant.
    pub apparent_tx_mps2: [f64; 3],
    /// Acceleration of x_b, constant.
    pub apparent_rx_mps2: [f64; 3],
    /// The node goes round with a wheel; x_a and x_b are then where its hub appears.
    pub rim: Option<Rim>,
    /// The part of the frame that the path stands for; `None` for all of it.
    pub span: Option<Span>,
    /// The part of the array that the path stands for; `None` for all of it.
    pub array_span: Option<ArraySpan>,
}

/// The part of a frame that a path stands for, where some ways were traced at several moments of it: at any
/// time the paths of the nearest moments are blended, each with its [`Span::share`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// The first of the moments, from the frame's first sample.
    pub first_s: f64,
    /// Step from one moment to the next.
    pub step_s: f64,
    /// Number of moments.
    pub moments: u32,
    /// Index of the moment at which the path was traced, from 0.
    pub moment: u32,
}

/// The part of an array that a path stands for, where some ways were traced from several places along its
/// row: for any pair of elements the paths of the nearest places are blended, each with its
/// [`ArraySpan::share`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ArraySpan {
    /// Vector d_t: a pair of elements is at d_t·p_t + d_r·p_r along the row, world metres.
    pub transmit: [f64; 3],
    /// Vector d_r.
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

/// Nodes that a blend is made of, where there are as many: a cubic.
const BLENDED: u32 = 4;

/// Lagrange's polynomial of a node through the four of `count` nodes at 0, 1, 2 … about `place`: 1 at its own
/// node and 0 at the others.
fn lagrange(node: u32, count: u32, place: f64) -> f64 {
    let blended = blended_at(count, place);
    if !blended.contains(&node) {
        return 0.0;
    }
    let own = f64::from(node);
    blended.filter(|n| *n != node).map(|n| (place - f64::from(n)) / (own - f64::from(n))).product()
}

/// The nodes that are blended at a place: two before and two behind it, but at the ends.
fn blended_at(count: u32, place: f64) -> Range<u32> {
    let blended = BLENDED.min(count);
    let first = ((place.floor() - 1.0).max(0.0) as u32).min(count - blended);
    first..first + blended
}

impl Span {
    /// Factor of the path's amplitude: Lagrange's polynomial through the four moments about `seconds`, 1 at
    /// its own moment and 0 at the others. The shares of all moments add up to 1.
    pub fn share(&self, seconds: f64) -> f64 {
        lagrange(self.moment, self.moments, (seconds - self.first_s) / self.step_s)
    }
}

impl ArraySpan {
    /// Factor of the path's amplitude from a transmit element to a receive element: Lagrange's polynomial
    /// through the four places about where the pair is. The shares of all places add up to 1.
    pub fn share(&self, [tx_m, rx_m]: [[f64; 3]; 2]) -> f64 {
        let along_m: f64 = (0..3).map(|i| self.transmit[i] * tx_m[i] + self.receive[i] * rx_m[i]).sum();
        lagrange(self.place, self.places, (along_m - self.first_m) / self.step_m)
    }
}

impl Curve {
    /// Factor of the path's amplitude some `seconds` after the frame's first sample, from a transmit element
    /// to a receive element at these places: 1 where the path stands for all of the frame and the array.
    pub fn share(&self, seconds: f64, ends_m: [[f64; 3]; 2]) -> f64 {
        let over_time = self.span.map_or(1.0, |span| span.share(seconds));
        over_time * self.array_span.map_or(1.0, |span| span.share(ends_m))
    }
}

/// A point on the rim of a wheel that rolls upright without slipping: hub + r·(cos φ·forward + sin φ·up), φ =
/// φ₀ − (way of the hub along forward)/r.
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
    /// Path of a point of target 0, the same at all frequencies.
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

    /// The facets in the order of travel.
    pub fn sequence(&self) -> &[Facet] {
        &self.facets[..self.facets_met()]
    }

    /// Number of facets met; a damaged record may tell of more than it holds.
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
    /// Upper bound of the power of all beams given up over the power kept.
    pub dropped_power_ratio: f64,
    /// Bytes that the tracer's own structures held at most, estimated.
    pub bytes: u64,
    /// Fineness to which bodies were cut and integrated; `None` where there was no body.
    pub fineness: Option<Fineness>,
    /// Origin of `error` and `model_error`.
    pub origin: ErrorOrigin,
    /// Reduction of each target's paths; empty where nothing was asked of them.
    pub detail: Vec<TargetDetail>,
}

/// Fineness that the accuracy asked for turned out to need.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fineness {
    /// Largest side of the parts of a facet that are one path.
    pub cell_m: f64,
    /// Fineness of the integrals on each body.
    pub integrals: Vec<IntegralFineness>,
    /// Number of moments of the frame at which `ways` were traced; 1 where the frame's middle is enough.
    pub moments: u32,
    /// Ways that were traced at all moments: ids of the bodies in the order of travel, ways back among
    /// them.
    pub ways: Vec<Vec<String>>,
    /// Number of places of the array from which `ways_of_places` were traced; 1 where its middle is enough.
    pub places: u32,
    /// Ways that were traced from all places.
    pub ways_of_places: Vec<Vec<String>>,
}

/// Fineness of the integrals on one body, and the error of its echo.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IntegralFineness {
    /// The body's id: in another frame it may stand elsewhere among the targets.
    pub body: String,
    /// Accuracy of each integral, relative to the largest that it could be.
    pub accuracy: f64,
    /// Error of the body's echo, relative to it, in the frame that was measured; `None` of a point target
    /// and of what has no echo.
    pub echo_error: Option<f64>,
}

impl Fineness {
    /// The same with the errors of the bodies' echoes, in their order.
    pub fn with_errors(mut self, errors: Vec<Option<f64>>) -> Self {
        for (body, error) in self.integrals.iter_mut().zip(errors) {
            body.echo_error = error;
        }
        self
    }

    /// Error of the echo of the body with this id, relative to it; `None` where it was not measured.
    pub fn echo_error(&self, body: &str) -> Option<f64> {
        self.integrals.iter().find(|of| of.body == body)?.echo_error
    }
}

/// Whether a frame's errors were measured in it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ErrorOrigin {
    /// The errors were measured in this frame.
    #[default]
    Measured,
    /// The errors are those of another frame, whose fineness this one has.
    TakenOver,
}

/// A target's level of detail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TargetDetail {
    /// Level of detail, never `Auto`.
    pub level: Detail,
    /// Paths that were traced.
    pub traced: u64,
    /// Paths of the frame.
    pub kept: u64,
    /// Error of the target's echo against that of all its paths, relative amplitude; `None` where these
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
