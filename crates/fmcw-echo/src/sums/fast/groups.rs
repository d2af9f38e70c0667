//! Paths that move alike, so that a few instants represent all of them.

use crate::sums::fast::instants::{Link, ReceivingRadar};
use crate::sums::fast::smooth_part::{SmoothPart, SmoothPartRequest};
use artifact::paths::Path;

/// Paths and their smooth part; `None` if no few instants suffice, or if there are too few paths for a
/// transform to pay off.
pub(crate) struct Group<'p> {
    pub(crate) paths: Vec<&'p Path>,
    pub(crate) smooth: Option<SmoothPart>,
}

/// Paths of one target each, halved by velocity and by range until a few instants represent their smooth
/// parts.
pub(crate) fn groups<'p>(
    receiving: &ReceivingRadar<'_>,
    paths: &[&'p Path],
    links: &[Link],
    asked: SmoothPartRequest,
) -> Vec<Group<'p>> {
    let mut by_target = paths.to_vec();
    by_target.sort_by_key(|path| path.target);
    by_target
        .chunk_by(|a, b| a.target == b.target)
        .flat_map(|paths| split(receiving, paths.to_vec(), links, asked))
        .collect()
}

/// Minimum number of paths of a group: fewer are summed one by one, since the transforms of a group's
/// instants cost as much, whatever the channels, chirps and samples. Measured with 3 × 4 elements, 128 chirps
/// of 256 samples: break-even at 32 paths for −40 dB, 40 for −60, 64 for −80, 100 for −100 and, in double
/// precision, 200 for −120 dB (`echo_speed -- 64 1`).
pub(crate) fn paths_min(error: f64) -> usize {
    match error {
        _ if error >= 1e-3 => 40,
        _ if error >= 1e-4 => 64,
        _ if error >= 1e-5 => 100,
        _ => 200,
    }
}

fn split<'p>(
    receiving: &ReceivingRadar<'_>,
    paths: Vec<&'p Path>,
    links: &[Link],
    asked: SmoothPartRequest,
) -> Vec<Group<'p>> {
    if paths.len() < asked.paths_min {
        return vec![Group { paths, smooth: None }];
    }
    if let Some(smooth) = SmoothPart::of(receiving, &paths, links, asked) {
        return vec![Group { paths, smooth: Some(smooth) }];
    }
    let (slow, fast) = halves(receiving, paths);
    [slow, fast].into_iter().flat_map(|half| split(receiving, half, links, asked)).collect()
}

/// Halves a set of paths at the median of the tone component that spreads over more of its cells: velocity
/// along chirps, range along samples.
fn halves<'p>(receiving: &ReceivingRadar<'_>, paths: Vec<&'p Path>) -> (Vec<&'p Path>, Vec<&'p Path>) {
    let waveform = &receiving.radar.waveform;
    let cells = |path: &Path| {
        let tone = receiving.tone(path);
        [tone.per_chirp * receiving.steps.chirps as f64, tone.per_sample * f64::from(waveform.samples)]
    };
    let mut of: Vec<([f64; 2], &Path)> = paths.into_iter().map(|path| (cells(path), path)).collect();
    let span = |axis: usize| {
        let all = of.iter().map(|(cells, _)| cells[axis]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    };
    let axis = usize::from(span(1) > span(0));
    of.sort_by(|a, b| a.0[axis].total_cmp(&b.0[axis]));
    let fast = of.split_off(of.len() / 2);
    let paths = |half: Vec<([f64; 2], &'p Path)>| half.into_iter().map(|(_, path)| path).collect();
    (paths(of), paths(fast))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sums::fast::equidistant_chirps::EquidistantChirps;
    use crate::sums::fast::test_path::path_by;
    use radar::aperture::Preset;
    use radar::paper;

    /// A lorry that passes 18 range cells of 6 cm in a frame of a tenth of a second.
    #[test]
    fn a_body_that_moves_by_many_range_cells_is_told_by_a_few_instants() {
        let waveform = paper::waveform(1024, 512);
        let radar = paper::radar([0.0, 0.0, 6.0], waveform, Preset::OneByOne.elements());
        let steps = EquidistantChirps::of(&radar).remove(0);
        let receiving = ReceivingRadar::new(&radar, radar.waveform.centre_frequency_hz(), steps);
        let fraction = |i: usize, step: f64| (i as f64 * step).fract() - 0.5;
        let path = |i: usize| {
            let at_m = [5.4 + 2.5 * fraction(i, 0.618_034), 32.0 + 7.0 * fraction(i, 0.732_051), 2.0];
            path_by(at_m, [0.0, -10.0, 0.0])
        };
        let paths: Vec<Path> = (1..=400).map(path).collect();
        let paths: Vec<&Path> = paths.iter().collect();
        let moved_cells = 10.0 * radar.frame_duration_s() / radar.waveform.range_resolution_m();
        assert!(moved_cells > 17.0, "{moved_cells}");
        let asked = SmoothPartRequest { error: 6e-4, instants_max: 12, paths_min: 40 };
        let groups = groups(&receiving, &paths, &[Link { tx: 0, rx: 0 }], asked);
        let told: usize = groups.iter().filter(|g| g.smooth.is_some()).map(|g| g.paths.len()).sum();
        assert!(told == paths.len(), "{told} of {} paths, {} groups", paths.len(), groups.len());
    }
}
