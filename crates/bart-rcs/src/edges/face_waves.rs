//! Waves across faces from edge to edge: where they end, and the waves that they excite there.
//!
//! The fringe current of an edge travels along its face as a wave. Where the face ends, the part that would
//! lie beyond is subtracted, and the edge there launches waves of its own, over both of its faces; each of
//! these ends again where its face does. This concerns H ∥: for E ∥ the wave vanishes on the face. Near
//! grazing all of them count: on a strip seen along its plane the waves of first and higher orders cancel one
//! by one, so that S vanishes as the square of the angle (docs/decisions/edges.md).

use crate::edges::edge_node::{EdgeNode, EdgePart, spread};
use crate::edges::end_current::EndCurrent;
use crate::edges::fields_over_surfaces::{over_surfaces, turning_length_m};
use crate::edges::fresnel::edge_wave;
use crate::edges::fringe::FaceView;
use crate::edges::line_integral::{Integrand, for_each_piece};
use crate::edges::wave_exit::{ExitLeg, WaveExit};
use crate::integral::field::length_difference_m;
use crate::integral::node::Leg;
use crate::joins::scatterer::EdgeWaves;
use crate::mesh::wedges::face_end::{FaceEnds, FaceExit};
use crate::mesh::wedges::wedge::Wedge;
use crate::mesh::wedges::world_edges::{EdgeGeometry, WorldEdges};
use glam::{DVec2, DVec3};
use num_complex::Complex64;

/// Direction of travel along a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sense {
    /// The wave travels from the transmitter to the receiver.
    Forth,
    /// The wave travels from the receiver to the transmitter, transposed.
    Back,
    /// Both directions with one antenna: one is the transpose of the other.
    Both,
}

/// Maximum number of faces that a wave crosses: over each further one, 5 λ wide, it loses nine tenths and
/// more.
const FACES: usize = 4;
/// Minimum current, relative to the transmitted field, for a wave to be followed past the end of its face; up
/// to twice as much it is faded in, point by point along its edge, so that nothing jumps and nothing depends
/// on the division into runs. The neglected part is below −34 dB of the amplitude of an edge at normal
/// incidence, and edges without corner terms are no better.
const FAINTEST: f64 = 0.02;
/// The same relative to the accuracy, where that is finer: what is neglected is then within the accuracy, and
/// shows in the comparison with finer integrals.
const FAINTEST_OVER_ACCURACY: f64 = 2.0;
/// Finest minimum, to bound the number of waves.
const LEAST_FAINTEST: f64 = 1e-3;
/// Share of the accuracy to which waves over a second and further faces are integrated, since there are more
/// of them.
const FURTHER_FACES_SHARE: f64 = 0.1;
/// Finest accuracy of these integrals; their error is reported.
const FINEST: f64 = 1e-4;

/// Calls `give` with the parts of all waves that start at an edge, and an error bound for each, √π·m.
pub(crate) fn for_each_part(
    node: &EdgeNode<'_>,
    reference_m: DVec3,
    highest_per_m: f64,
    accuracy: f64,
    give: &mut dyn FnMut(&dyn EdgePart, f64),
) {
    let faintest = (FAINTEST_OVER_ACCURACY * accuracy).clamp(LEAST_FAINTEST, FAINTEST);
    let mut following = WaveTracing { node, reference_m, highest_per_m, accuracy, faintest, give };
    let senses: &[Sense] = if node.has_one_leg() { &[Sense::Both] } else { &[Sense::Forth, Sense::Back] };
    for first in CrossedFace::faces_of(node.edges, node.edge, 1.0) {
        let mut crossed = vec![first];
        for sense in senses {
            following.follow(&mut crossed, *sense, node.span_m);
        }
    }
}

/// Waves of an edge being followed.
struct WaveTracing<'a, 'g> {
    node: &'a EdgeNode<'a>,
    reference_m: DVec3,
    highest_per_m: f64,
    accuracy: f64,
    /// Minimum current of waves that are followed.
    faintest: f64,
    give: &'g mut dyn FnMut(&dyn EdgePart, f64),
}

impl WaveTracing<'_, '_> {
    /// Passes on the ends of the waves over the last face, then those of the waves that they excite.
    fn follow(&mut self, crossed: &mut Vec<CrossedFace>, sense: Sense, span_m: [f64; 2]) {
        for ExitSpan { span_m: piece_m, exit } in self.waves(crossed, sense).runs(span_m) {
            exit_by(crossed, Some(exit));
            let waves = self.waves(crossed, sense);
            let accuracy = if crossed.len() > 1 {
                (FURTHER_FACES_SHARE * self.accuracy).max(FINEST)
            } else {
                self.accuracy
            };
            let give = &mut *self.give;
            for_each_piece(&waves, piece_m, self.highest_per_m, accuracy, &mut |part, error| {
                give(part, error);
            });
            let Some((next, loud_m)) = worth_following(&waves, piece_m) else { continue };
            let edges = self.node.edges;
            let free = CrossedFace::faces_of(edges, &edges.edges[next as usize], 1.0);
            for face in free.into_iter().filter(|face| face.is_free) {
                crossed.push(face);
                for span_m in &loud_m {
                    self.follow(crossed, sense, *span_m);
                }
                crossed.pop();
            }
        }
        exit_by(crossed, None);
    }

    fn waves<'c>(&self, crossed: &'c [CrossedFace], sense: Sense) -> FaceWaves<'c>
    where
        Self: 'c,
    {
        let Self { node, reference_m, faintest, .. } = *self;
        FaceWaves { node, reference_m, crossed, sense, faintest }
    }
}

/// Edge at which the waves from a span end, and the parts of the span whose waves excite others. On a face
/// with a wall the waves reflected by the wall are not modelled, so the second order is the last there.
fn worth_following(waves: &FaceWaves<'_>, span_m: [f64; 2]) -> Option<(u32, Vec<[f64; 2]>)> {
    let is_free = waves.crossed.last().is_some_and(|face| face.is_free);
    let most = match waves.node.waves {
        EdgeWaves::OverFaces => FACES,
        EdgeWaves::OverOwnFaces => 1,
    };
    if !is_free || waves.crossed.len() >= most {
        return None;
    }
    let edge = waves.wave_from(0.5 * (span_m[0] + span_m[1]))?.met.edge?;
    let loud_m = waves.significant_spans(span_m);
    (!loud_m.is_empty()).then_some((edge, loud_m))
}

/// A face crossed by a wave, from one of its edges.
struct CrossedFace {
    edge: EdgeGeometry,
    face: usize,
    ends: FaceEnds,
    /// Weight of the waves over it.
    share: f64,
    /// Whether it ends at edges only and no wall rises on it.
    is_free: bool,
    /// End met by all rays over it; `None` while each meets its own nearest.
    exit: Option<usize>,
}

/// A part of the first edge from which all rays over the last face meet the same end.
#[derive(Debug, Clone, Copy)]
struct ExitSpan {
    span_m: [f64; 2],
    exit: usize,
}

/// Sets the end met by all rays over the last crossed face.
fn exit_by(crossed: &mut [CrossedFace], exit: Option<usize>) {
    if let Some(last) = crossed.last_mut() {
        last.exit = exit;
    }
}

/// Relative inset from the ends of a span for tests, so that rounding does not decide where a ray meets a
/// corner.
const INSET: f64 = 1e-11;
/// Bisections that find where rays change from one end to the next, to 2⁻⁴⁰ of a span.
const CHANGE_HALVINGS: u32 = 40;
/// Positions, as shares of a span, at which the end met by rays is determined, and the maximum number of ends
/// between two of them.
const RUN_LOOKS: [f64; 5] = [0.0, 0.125, 0.5, 0.875, 1.0];
const ENDS_BETWEEN: usize = 4;
/// Number of parts of a span between positions tested for waves strong enough to be followed.
const LOUD_LOOKS: f64 = 8.0;

/// Position between two up to which a condition holds that holds at the first.
fn change_between([mut from_m, mut to_m]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..CHANGE_HALVINGS {
        let middle_m = 0.5 * (from_m + to_m);
        if holds(middle_m) {
            from_m = middle_m;
        } else {
            to_m = middle_m;
        }
    }
    0.5 * (from_m + to_m)
}

impl CrossedFace {
    /// Faces of an edge, on which waves have a weight. Both sides of a sheet carry the same fringe current:
    /// one represents both if it ends at edges of sheets only.
    fn faces_of(edges: &WorldEdges, edge: &EdgeGeometry, share: f64) -> Vec<Self> {
        let mut ends_at = edges.ends_of_face(edge, 0).iter().filter_map(|end| end.edge);
        let is_of_sheet = |end: u32| edges.edges[end as usize].wedge.is_of_sheet();
        match edge.wedge.is_of_sheet() && ends_at.all(is_of_sheet) {
            true => vec![Self::of(edges, edge, 0, 2.0 * share)],
            false => [0, 1].map(|face| Self::of(edges, edge, face, share)).into(),
        }
    }

    fn of(edges: &WorldEdges, edge: &EdgeGeometry, face: usize, share: f64) -> Self {
        let Wedge { along, inward, normal, .. } = edge.wedge;
        let of_face = edges.ends_of_face(edge, face);
        // The edge of a corner faces away from what the corner encloses.
        let looks = |end: u32| edges.edges[end as usize].wedge.has_face(normal[face]);
        let is_free = of_face.iter().all(|end| end.edge.is_some_and(looks));
        let ends = FaceEnds::seen_from(edge.from_m, along, inward[face], of_face);
        Self { edge: edge.clone(), face, ends, share, is_free, exit: None }
    }

    /// Direction of a wave along the face in the coordinates of the face's ends.
    fn direction(&self, view: &FaceView) -> DVec2 {
        DVec2::new(view.sin_in, view.along_face().dot(self.edge.wedge.along))
    }

    fn place_of(&self, x_m: DVec3) -> f64 {
        (x_m - self.edge.from_m).dot(self.edge.wedge.along)
    }

    /// Intersection of a wave from a position on the edge with the end of the face.
    fn met_from(&self, at_m: f64, view: &FaceView) -> Option<FaceExit> {
        let direction = self.direction(view);
        match self.exit {
            Some(end) => Some(self.ends.on_line(end, at_m, direction)),
            None => self.ends.nearest(at_m, direction),
        }
    }
}

/// Amplitude of the currents beyond the end of the last crossed face, which is subtracted, and of the
/// contribution of the edge there.
struct FaceWaves<'a> {
    node: &'a EdgeNode<'a>,
    reference_m: DVec3,
    crossed: &'a [CrossedFace],
    sense: Sense,
    faintest: f64,
}

/// A wave over the last face, from one point of the first edge.
#[derive(Clone)]
struct Wave {
    /// Face as seen by the wave's edge.
    view: FaceView,
    /// End of the face, and where it is met.
    met: FaceExit,
    end_m: DVec3,
    /// Path length over all faces.
    way_m: f64,
    current: EndCurrent,
    /// Factor of the current at the last edge for each transmitted field: one over a first face.
    arriving: [f64; 2],
    before: WaveDecay,
}

/// End of a wave at an edge, per unit of its current.
struct Arrival {
    /// Faces of the edge as seen by the wave.
    faces: [FaceView; 2],
    travel: DVec3,
    field: DVec3,
    /// Direction to the receiver, and its unit fields.
    out: DVec3,
    received: [DVec3; 2],
    /// Length of the preceding edge over the length met by its waves here.
    width: f64,
}

/// Decay of the waves over the faces before the last, to be evaluated at a wavenumber.
#[derive(Debug, Clone, Copy, Default)]
struct WaveDecay {
    /// Roots of κd(1 + cosφ′)/k by face.
    roots: [f64; FACES],
    count: usize,
}

impl WaveDecay {
    fn then(mut self, root: f64) -> Self {
        self.roots[self.count] = root;
        self.count += 1;
        self
    }

    fn at(&self, wavenumber_per_m: f64) -> Complex64 {
        let root_k = wavenumber_per_m.sqrt();
        self.roots[..self.count].iter().map(|root| edge_wave(root * root_k)).product()
    }
}

/// Ends of the waves from one point of the first edge.
#[derive(Clone)]
struct WaveEnd {
    length_m: f64,
    spread: f64,
    wave: Wave,
    /// Directions of travel of the incident field at the first edge and of the received field at the end.
    travel: [DVec3; 2],
    /// Kernel √π·K of the edge at the end for a unit current along the ray, by received field.
    next: [f64; 2],
}

impl FaceWaves<'_> {
    /// Legs of the waves, in and out.
    fn legs(&self) -> [&Leg; 2] {
        let EdgeNode { transmit, receive, .. } = *self.node;
        if self.sense == Sense::Back { [receive, transmit] } else { [transmit, receive] }
    }

    /// Wave over the last face from a point of the first edge; `None` if an edge on the path launches none,
    /// or a face has no end.
    fn wave_from(&self, at_m: f64) -> Option<Wave> {
        let (first, others) = self.crossed.split_first()?;
        let mut wave = self.first_wave(first, at_m)?;
        for crossed in others {
            wave = self.next_wave(&wave, crossed)?;
        }
        Some(wave)
    }

    /// Wave excited by the incident field.
    fn first_wave(&self, crossed: &CrossedFace, at_m: f64) -> Option<Wave> {
        let [from, to] = self.legs();
        let x_m = crossed.edge.point_m(at_m);
        let [travel, back] = [from, to].map(|leg| leg.image.travel_direction_at(x_m));
        let view = crossed.edge.wedge.faces(travel, -back)?[crossed.face];
        let sent = from.mirrors.fields_at_node(travel, from.zenith_h);
        let received = to.mirrors.fields_at_node(back, to.zenith_h);
        let met = crossed.met_from(at_m, &view)?;
        Some(Wave {
            view,
            met,
            end_m: x_m + met.way_m * view.along_face(),
            way_m: met.way_m,
            current: EndCurrent::new(&view, travel, &sent, &received),
            arriving: [crossed.share; 2],
            before: WaveDecay::default(),
        })
    }

    /// A wave arriving at the edge of a wedge at the end of its face; `None` if the edge is silent.
    ///
    /// A wave grazing a conductor has the current 2H: E = ½J·n. Its own current up to the edge is already
    /// present, so the edge contributes the fringe of grazing incidence.
    fn arrival(&self, wave: &Wave, wedge: &Wedge) -> Option<Arrival> {
        let to = self.legs()[1];
        let (travel, back) = (wave.view.along_face(), to.image.travel_direction_at(wave.end_m));
        let faces = wedge.faces_from_face(travel, wave.view.normal, -back)?;
        let width = wave.view.sin_in / faces[0].sin_in;
        let received = to.mirrors.fields_at_node(back, to.zenith_h);
        Some(Arrival { faces, travel, field: 0.5 * wave.view.normal, out: -back, received, width })
    }

    /// Wave excited by an arriving one, over a face of the edge at which that ends.
    fn next_wave(&self, wave: &Wave, crossed: &CrossedFace) -> Option<Wave> {
        let Arrival { faces, travel, field, received, width, .. } =
            self.arrival(wave, &crossed.edge.wedge)?;
        let view = faces[crossed.face];
        let met = crossed.met_from(crossed.place_of(wave.end_m), &view)?;
        Some(Wave {
            view,
            met,
            end_m: wave.end_m + met.way_m * view.along_face(),
            way_m: wave.way_m + met.way_m,
            current: EndCurrent::new(&view, travel, &[field; 2], &received),
            arriving: [0, 1].map(|q| crossed.share * self.share_of_next(wave) * width * wave.ray(q)),
            before: wave.before.then(wave.current.falloff_root(wave.met.way_m)),
        })
    }

    /// Weight of the waves excited by this one: 0 to 1, the same at all frequencies of a band.
    fn share_of_next(&self, wave: &Wave) -> f64 {
        (wave.strength(self.node.edges.band.middle_per_m()) / self.faintest - 1.0).clamp(0.0, 1.0)
    }

    /// Parts of a span whose waves excite others, determined at a few positions.
    fn significant_spans(&self, [from_m, to_m]: [f64; 2]) -> Vec<[f64; 2]> {
        let is_loud = |at_m: f64| self.wave_from(at_m).is_some_and(|wave| self.share_of_next(&wave) > 0.0);
        let inset_m = INSET * (to_m - from_m);
        let place = |i: u32| from_m + inset_m + (to_m - from_m - 2.0 * inset_m) * f64::from(i) / LOUD_LOOKS;
        let mut spans: Vec<[f64; 2]> = Vec::new();
        let (mut before, mut start) = (is_loud(place(0)), from_m);
        for i in 1..=LOUD_LOOKS as u32 {
            let now = is_loud(place(i));
            if now != before {
                let change_m = change_between([place(i - 1), place(i)], |at_m| is_loud(at_m) == before);
                if before {
                    spans.push([start, change_m]);
                }
                (before, start) = (now, change_m);
            }
        }
        if before {
            spans.push([start, to_m]);
        }
        spans
    }

    /// Kernel √π·K of the edge where the face ends, for a wave arriving along the face with unit current, per
    /// length of the preceding edge; by received field.
    fn next_edge(&self, wave: &Wave) -> [f64; 2] {
        let wedge = wave.met.edge.map(|edge| &self.node.edges.edges[edge as usize].wedge);
        let Some(at) = wedge.and_then(|wedge| self.arrival(wave, wedge)) else { return [0.0; 2] };
        let [one, other] =
            at.faces.map(|f| f.coefficients([f.incident(at.travel, at.field)], at.out, at.received));
        [0, 1].map(|p| at.width * (one[p][0] + other[p][0]))
    }

    /// Divides a span where rays along the last face change from one end to the next; parts that meet none
    /// are left out.
    fn runs(&self, span_m: [f64; 2]) -> Vec<ExitSpan> {
        let inset_m = INSET * (span_m[1] - span_m[0]);
        let mut cuts = vec![span_m[0]];
        cuts.extend(self.changes_m(span_m));
        cuts.push(span_m[1]);
        let wide = cuts.windows(2).filter(|pair| pair[1] - pair[0] > 4.0 * inset_m);
        wide.flat_map(|pair| self.runs_between(pair[0], pair[1], inset_m)).collect()
    }

    /// Runs of a part of the span: divided again if, for near antennas, rays do not change at the expected
    /// position.
    fn runs_between(&self, from_m: f64, to_m: f64, inset_m: f64) -> Vec<ExitSpan> {
        let looks =
            RUN_LOOKS.map(|share| (from_m + share * (to_m - from_m)).clamp(from_m + inset_m, to_m - inset_m));
        let exits = looks.map(|at_m| self.exit_from(at_m));
        let mut runs = Vec::new();
        let mut start_m = from_m;
        for (look, exit) in looks.windows(2).zip(exits.windows(2)) {
            let (mut at_m, mut now) = (look[0], exit[0]);
            for _ in 0..ENDS_BETWEEN {
                if now == exit[1] {
                    break;
                }
                let change_m = change_between([at_m, look[1]], |at_m| self.exit_from(at_m) == now);
                runs.push(([start_m, change_m], now));
                start_m = change_m;
                at_m = (change_m + inset_m).min(look[1]);
                now = self.exit_from(at_m);
            }
        }
        runs.push(([start_m, to_m], exits[RUN_LOOKS.len() - 1]));
        runs.into_iter().filter_map(|(span_m, exit)| Some(ExitSpan { span_m, exit: exit? })).collect()
    }

    fn exit_from(&self, at_m: f64) -> Option<usize> {
        self.wave_from(at_m).map(|wave| wave.met.end)
    }

    /// Positions on the first edge from which rays over all faces meet a corner of the last face's ends. A
    /// ray's position on a later edge is a linear function of that on the first for a distant antenna, and
    /// nearly so for a near one.
    fn changes_m(&self, span_m: [f64; 2]) -> Vec<f64> {
        let Some(last) = self.crossed.last() else { return Vec::new() };
        let [from, middle, to] = [0.01, 0.5, 0.99].map(|share| span_m[0] + share * (span_m[1] - span_m[0]));
        let start = |wave: &Wave| last.place_of(wave.end_m - wave.met.way_m * wave.view.along_face());
        let waves = [from, middle, to].map(|at_m| self.wave_from(at_m));
        let [Some(one), Some(in_middle), Some(other)] = waves else { return Vec::new() };
        let slope = (start(&other) - start(&one)) / (to - from);
        if slope.abs() < 1e-9 {
            return Vec::new();
        }
        let place = |on_last_m: f64| from + (on_last_m - start(&one)) / slope;
        let ends_m = [0, 1].map(|end| start(&one) + slope * (span_m[end] - from));
        let span_of_last_m = [ends_m[0].min(ends_m[1]), ends_m[0].max(ends_m[1])];
        let mut changes: Vec<f64> = last
            .ends
            .changes_m(last.direction(&in_middle.view), span_of_last_m)
            .into_iter()
            .map(place)
            .collect();
        changes.sort_by(f64::total_cmp);
        changes
    }
}

impl Wave {
    /// Current arriving at the end of the last face at a wavenumber, for the transmitted field that excites
    /// most of it, whatever its polarization: a bound on the contribution of the edge there.
    fn strength(&self, wavenumber_per_m: f64) -> f64 {
        let ray = self.ray(0).hypot(self.ray(1));
        let falloff = edge_wave(self.current.falloff_root(self.met.way_m) * wavenumber_per_m.sqrt());
        ray * (self.before.at(wavenumber_per_m) * falloff).norm()
    }

    /// Current along the ray without decay, for a transmitted field.
    fn ray(&self, q: usize) -> f64 {
        self.arriving[q] * self.current.along_ray[q]
    }
}

impl Integrand for FaceWaves<'_> {
    type Sample = Option<WaveEnd>;

    fn sample(&self, at_m: f64) -> Option<WaveEnd> {
        let wave = self.wave_from(at_m)?;
        let [from, to] = self.legs().map(|leg| leg.image);
        let (x_m, reference_m) = (self.node.edge.point_m(at_m), self.reference_m);
        let length_m = length_difference_m(from, x_m, reference_m)
            + wave.way_m
            + length_difference_m(to, wave.end_m, reference_m);
        let spread = spread(from, x_m, reference_m) * spread(to, wave.end_m, reference_m);
        let (next, travel) =
            (self.next_edge(&wave), [from.travel_direction_at(x_m), to.travel_direction_at(wave.end_m)]);
        Some(WaveEnd { length_m, spread, wave, travel, next })
    }

    fn length_m(sample: &Option<WaveEnd>) -> f64 {
        sample.as_ref().map_or(0.0, |ended| ended.length_m)
    }

    fn weights(&self, sample: &Option<WaveEnd>, wavenumber_per_m: f64) -> [Complex64; 4] {
        let Some(WaveEnd { wave, spread, travel, next, .. }) = sample else { return [Complex64::ZERO; 4] };
        let (beyond, falloff) = wave.current.beyond(wave.met.way_m, wavenumber_per_m);
        let before = 0.5 * spread * wave.before.at(wavenumber_per_m);
        let of = |p: usize, q: usize| {
            before * (next[p] * wave.ray(q) * falloff - wave.arriving[q] * beyond[2 * p + q])
        };
        let weights = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(p, q)| of(p, q));
        let [vv, vh, hv, hh] = over_surfaces(weights, self.legs(), *travel, wavenumber_per_m);
        match self.sense {
            Sense::Forth => [vv, vh, hv, hh],
            Sense::Back => [vv, hv, vh, hh],
            Sense::Both => [2.0 * vv, vh + hv, vh + hv, 2.0 * hh],
        }
    }

    fn turning_m(&self) -> f64 {
        turning_length_m(self.node.legs())
    }

    fn exit(&self, sample: &Option<WaveEnd>) -> Option<WaveExit> {
        let Wave { end_m, way_m, .. } = sample.as_ref()?.wave;
        let towards = if self.sense == Sense::Back { ExitLeg::Transmit } else { ExitLeg::Receive };
        Some(WaveExit { end_m, way_m, towards })
    }
}
