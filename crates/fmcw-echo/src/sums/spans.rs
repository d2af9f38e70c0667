//! Paths that represent a part of a frame or of the array: their grouping, and their share of the echo at
//! every sample.

use crate::links::multiplexing::Transmission;
use artifact::Radar;
use artifact::paths::{ArraySide, ArraySpan, Curve, Path, Span};

/// Part of a frame and of the array represented by paths: of a path's curve, the fields that tell it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FrameSpan {
    part: Curve,
}

/// Numbers that tell two parts from each other.
type Key = (Option<[u64; 4]>, Option<[u64; 10]>, Option<[u64; 7]>);

impl FrameSpan {
    pub(crate) fn of(path: &Path) -> Self {
        let Curve { span, array_span, array_side, .. } = path.curve;
        Self { part: Curve { span, array_span, array_side, ..Curve::default() } }
    }

    /// Whether it is the whole frame and array.
    pub(crate) fn is_whole(&self) -> bool {
        self.part.span.is_none() && self.of_whole_array()
    }

    /// The same part of the frame for the whole array.
    pub(crate) fn over_whole_array(self) -> Self {
        Self { part: Curve { array_span: None, array_side: None, ..self.part } }
    }

    /// Whether it is all of the array.
    pub(crate) fn of_whole_array(&self) -> bool {
        self.part.array_span.is_none() && self.part.array_side.is_none()
    }

    /// Sort key common to the paths of one part.
    fn key(&self) -> Key {
        let of_time = |span: Span| {
            [span.moments.into(), span.first_s.to_bits(), span.step_s.to_bits(), span.moment.into()]
        };
        let of_array = |span: ArraySpan| {
            let ([a, b, c], [d, e, f]) = (span.transmit, span.receive);
            let [a, b, c, d, e, f, first, step] =
                [a, b, c, d, e, f, span.first_m, span.step_m].map(f64::to_bits);
            [span.places.into(), a, b, c, d, e, f, first, step, span.place.into()]
        };
        let of_side = |side: ArraySide| {
            let ([a, b, c], [d, e, f]) = (side.transmit, side.receive);
            [a, b, c, d, e, f, side.from_m].map(f64::to_bits)
        };
        (self.part.span.map(of_time), self.part.array_span.map(of_array), self.part.array_side.map(of_side))
    }

    /// Share of a pair of a transmit and a receive element, at any time.
    pub(crate) fn share_of_pair(&self, ends_m: [[f64; 3]; 2]) -> f64 {
        self.part.share_of_pair(ends_m)
    }

    /// Share of every sample of a chirp between a transmit and a receive element.
    pub(crate) fn shares_of_row(&self, radar: &Radar, transmission: &Transmission) -> Vec<f64> {
        let time_s = |sample: u32| transmission.start_s + f64::from(sample) / radar.waveform.sample_rate_hz;
        let over_time = |sample: u32| self.part.span.map_or(1.0, |span| span.share(time_s(sample)));
        let over_array = self.share_of_pair(transmission.ends_m());
        (0..radar.waveform.samples).map(|sample| over_array * over_time(sample)).collect()
    }

    /// Transmissions of one row that have the same share: all of them, which start at one time, or one pair
    /// of elements at a time.
    pub(crate) fn alike<'t>(&self, row: &'t [Transmission]) -> std::slice::Chunks<'t, Transmission> {
        row.chunks(if self.of_whole_array() { row.len().max(1) } else { 1 })
    }
}

/// Paths grouped by the part that they represent, in their order within each; those that represent everything
/// come first.
pub(crate) fn by_span(mut paths: Vec<&Path>) -> Vec<(FrameSpan, Vec<&Path>)> {
    paths.sort_by_key(|path| FrameSpan::of(path).key());
    let groups = paths.chunk_by(|a, b| FrameSpan::of(a).key() == FrameSpan::of(b).key());
    groups.map(|group| (FrameSpan::of(group[0]), group.to_vec())).collect()
}
