//! Paths that stand for a part of a frame: which belong together, and their share of the echo at every
//! sample.

use artifact::Radar;
use artifact::paths::{Path, Span};

/// Paths by the part of the frame that they stand for, in their order within each; those that stand for all
/// of it come first.
pub(crate) fn by_span(mut paths: Vec<&Path>) -> Vec<(Option<Span>, Vec<&Path>)> {
    paths.sort_by_key(|path| order(path));
    let groups = paths.chunk_by(|a, b| order(a) == order(b));
    groups.map(|group| (group[0].curve.span, group.to_vec())).collect()
}

/// Sort key that paths of one part of the frame have in common.
fn order(path: &Path) -> Option<[u64; 4]> {
    let of =
        |span: Span| [span.moments.into(), span.first_s.to_bits(), span.step_s.to_bits(), span.moment.into()];
    path.curve.span.map(of)
}

/// Share of every sample of a chirp whose first is taken at `start_s`.
pub(crate) fn shares_of_row(radar: &Radar, span: &Span, start_s: f64) -> Vec<f64> {
    let time_s = |sample: u32| start_s + f64::from(sample) / radar.waveform.sample_rate_hz;
    (0..radar.waveform.samples).map(|sample| span.share(time_s(sample))).collect()
}
