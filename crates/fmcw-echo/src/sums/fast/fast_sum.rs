//! A cube by transforms: the tones of all paths at once, and the slowly varying part at a few instants.
//!
//! x(n, m) = Σ_groups Σ_i shape_i(n, m)·Σ_p value_p(instant i)·e^{j2π(α_p n + β_p m)}: see `smooth_part.rs`
//! for the outer sum, `tone_grid.rs` for the inner. Values are exact at their instants, for every pair of
//! elements. Links are processed in fixed blocks, one thread each, so the result is the same for any number
//! of threads.

use crate::links::multiplexing::{element_factor, row};
use crate::sums::direct_sum::{DirectSum, is_received};
use crate::sums::fast::equidistant_chirps::EquidistantChirps;
use crate::sums::fast::groups::{Group, groups, paths_min};
use crate::sums::fast::instants::{Instant, Link, ReceivingRadar, Tone};
use crate::sums::fast::kernel::CELLS_MAX;
use crate::sums::fast::scalar::{Scalar, rounded};
use crate::sums::fast::smooth_part::{SmoothPart, SmoothPartRequest, cycles_of};
use crate::sums::fast::tone_grid::{SETS, ToneGrid};
use crate::sums::spans::{FrameSpan, by_span};
use artifact::paths::Path;
use artifact::radar::{Multiplexing, Pattern};
use artifact::{Accuracy, Radar};
use num_complex::{Complex, Complex32, Complex64};
use rayon::prelude::*;

/// Noise-free cube, √W, `[channel][chirp][sample]`, with an error of `accuracy` relative to its root mean
/// square, provided that paths do not cancel each other.
pub fn cube(radar: &Radar, centre_frequency_hz: f64, paths: &[Path], accuracy: Accuracy) -> Vec<Complex64> {
    if accuracy.amplitude() >= SINGLE {
        let cube = cube_in::<f32>(radar, centre_frequency_hz, paths, accuracy.amplitude());
        cube.into_iter().map(f32::stored).collect()
    } else {
        cube_in::<f64>(radar, centre_frequency_hz, paths, accuracy.amplitude())
    }
}

/// Computes the cube like [`cube`], in the precision in which it is stored.
pub(crate) fn single_cube(
    radar: &Radar,
    centre_frequency_hz: f64,
    paths: &[Path],
    accuracy: Accuracy,
) -> Vec<Complex32> {
    if accuracy.amplitude() >= SINGLE {
        return cube_in::<f32>(radar, centre_frequency_hz, paths, accuracy.amplitude());
    }
    let cube = cube_in::<f64>(radar, centre_frequency_hz, paths, accuracy.amplitude());
    cube.into_iter().map(|value| Complex32::new(value.re as f32, value.im as f32)).collect()
}

/// Maximum memory needed besides the cube, its paths and their arranged copies, bytes.
pub(crate) fn memory_estimate_bytes(radar: &Radar, accuracy: Accuracy) -> u64 {
    let [links, chirps, samples] =
        [radar.virtual_channels() as u64, radar.waveform.chirps.into(), radar.waveform.samples.into()];
    let is_single = accuracy.amplitude() >= SINGLE;
    let value = if is_single { size_of::<Complex32>() } else { size_of::<Complex64>() } as u64;
    // Single-precision sums are the cube itself, except for links that are summed and chirps that are
    // interleaved.
    let are_the_cube = is_single && is_link_by_link(radar) && radar.schedule.is_uniform();
    // With codes: the sums of one slot after the other, and the cube into which they are interleaved.
    let laid = if radar.array.multiplexing == Multiplexing::Bpm { radar.cube_channels() as u64 } else { 0 };
    let sums = if are_the_cube { 0 } else { (links + laid) * chirps * samples * value };
    let grid = 2 * chirps * (2 * samples + CELLS_MAX as u64) * SETS as u64 * value;
    let of_a_set = 4 * chirps * samples * value;
    sums + (grid + of_a_set) * rayon::current_num_threads() as u64
}

/// Minimum error for single-precision sums, which suffice down to −100 dB: rounding of 6e-8 for each of some
/// hundred additions.
const SINGLE: f64 = 1e-5;
/// Maximum number of instants of one group; a group that needs more is halved.
const INSTANTS_MAX: usize = 12;

/// Sums sets of chirps at equal steps one after the other and interleaves them.
fn cube_in<T: Scalar>(
    radar: &Radar,
    centre_frequency_hz: f64,
    paths: &[Path],
    error: f64,
) -> Vec<Complex<T>> {
    let (chirps, samples) = (radar.waveform.chirps as usize, radar.waveform.samples as usize);
    let mut receiving_radars: Vec<ReceivingRadar<'_>> = EquidistantChirps::of(radar)
        .into_iter()
        .map(|steps| ReceivingRadar::new(radar, centre_frequency_hz, steps))
        .collect();
    if receiving_radars.len() == 1 {
        return part_of_cube(&receiving_radars.remove(0), paths, error);
    }
    let mut cube = vec![Complex::new(T::zero(), T::zero()); radar.cube_channels() * chirps * samples];
    for receiving in &receiving_radars {
        let rows = part_of_cube::<T>(receiving, paths, error);
        for (r, row) in rows.chunks_exact(samples).enumerate() {
            let [channel, chirp] = receiving.steps.place(r);
            cube[(channel * chirps + chirp) * samples..][..samples].copy_from_slice(row);
        }
    }
    cube
}

/// Rows of chirps at equal steps.
fn part_of_cube<T: Scalar>(receiving: &ReceivingRadar<'_>, paths: &[Path], error: f64) -> Vec<Complex<T>> {
    let radar = receiving.radar;
    let links = links(radar);
    let heard = paths.iter().filter(|path| is_received(radar, path));
    let (on_rims, others): (Vec<&Path>, Vec<&Path>) = heard.partition(|path| path.curve.rim.is_some());
    let heard = within_pattern(receiving, others, &links);
    let asked =
        SmoothPartRequest { error: 0.6 * error, instants_max: INSTANTS_MAX, paths_min: paths_min(error) };
    let length = receiving.steps.chirps * radar.waveform.samples as usize;
    let mut of_links = vec![Complex::new(T::zero(), T::zero()); links.len() * length];
    let mut alone: Vec<Path> = on_rims.into_iter().copied().collect();
    for (part, paths) in by_span(heard) {
        let part = CoveredSpan::of(receiving, &links, part);
        if part.receiving.steps.chirps == 0 {
            continue;
        }
        for group in groups(&part.receiving, &paths, &links, asked) {
            match &group.smooth {
                Some(smooth) => part.add_group(&group, smooth, &links, error, &mut of_links),
                None => alone.extend(group.paths.iter().copied()),
            }
        }
    }
    let mut cube = channels(receiving, of_links, length);
    if !alone.is_empty() {
        add_one_by_one(&DirectSum::new(radar, receiving.centre_frequency_hz, &alone), receiving, &mut cube);
    }
    cube
}

/// Paths without those that no pair of elements hears at the start, in the middle and at the end of the
/// frame: what lies outside the antenna pattern has no echo.
fn within_pattern<'p>(receiving: &ReceivingRadar<'_>, paths: Vec<&'p Path>, links: &[Link]) -> Vec<&'p Path> {
    if receiving.radar.array.pattern == Pattern::Isotropic {
        return paths;
    }
    let middle = receiving.middle();
    let end = Instant { chirp: 2.0 * middle.chirp, sample: 2.0 * middle.sample };
    let probes = [middle, Instant { chirp: 0.0, sample: 0.0 }, end];
    // Nearly every path within the pattern is heard by one pair at the middle of the frame.
    let one = [links[links.len() / 2]];
    let hears = |links: &[Link], path: &Path| {
        probes.iter().any(|at| {
            let mut is_heard = false;
            receiving.for_each_value(path, links, *at, &mut |_, value| {
                is_heard |= value.amplitude != Complex64::ZERO;
            });
            is_heard
        })
    };
    paths.into_par_iter().filter(|path| hears(&one, path) || hears(links, path)).collect()
}

fn add_one_by_one<T: Scalar>(
    direct: &DirectSum<'_>,
    receiving: &ReceivingRadar<'_>,
    cube: &mut [Complex<T>],
) {
    let (steps, samples) = (&receiving.steps, receiving.radar.waveform.samples as usize);
    cube.par_chunks_mut(samples).enumerate().for_each(|(r, total)| {
        let [channel, chirp] = steps.place(r);
        let values = direct.row(channel, chirp);
        total.iter_mut().zip(values).for_each(|(sum, value)| *sum = *sum + rounded(value));
    });
}

/// Links from every transmit element to every receive element.
fn links(radar: &Radar) -> Vec<Link> {
    let (transmitters, receivers) = (radar.array.tx_m.len(), radar.array.rx_m.len());
    (0..transmitters).flat_map(|tx| (0..receivers).map(move |rx| Link { tx, rx })).collect()
}

/// Part of a frame represented by some paths: their sum covers no other chirps and links.
struct CoveredSpan<'a> {
    receiving: ReceivingRadar<'a>,
    /// Share of every chirp and sample of the part, by transmitter; `None` if the paths represent the whole
    /// frame.
    over_time: Option<Vec<Vec<f64>>>,
    /// Share of every link; `None` if the paths represent the whole array.
    over_links: Option<Vec<f64>>,
    /// Number of chirps before the part, and of the whole frame.
    before: usize,
    chirps: usize,
}

impl<'a> CoveredSpan<'a> {
    fn of(whole: &ReceivingRadar<'a>, links: &[Link], part: FrameSpan) -> Self {
        let share = |link: &Link| part.share_of_pair(whole.transmission(*link, 0.0).ends_m());
        let over_links = (!part.of_whole_array()).then(|| links.iter().map(share).collect());
        Self { over_links, ..Self::of_time(whole, part.over_whole_array()) }
    }

    fn of_time(whole: &ReceivingRadar<'a>, part: FrameSpan) -> Self {
        let chirps = whole.steps.chirps;
        if part.is_whole() {
            let receiving = whole.during(&(0..chirps));
            return Self { receiving, over_time: None, over_links: None, before: 0, chirps };
        }
        let (radar, transmitters) = (whole.radar, 0..whole.radar.array.tx_m.len());
        let row = |tx: usize, chirp: usize| {
            part.shares_of_row(radar, &whole.transmission(Link { tx, rx: 0 }, chirp as f64))
        };
        let mut of_tx: Vec<Vec<Vec<f64>>> =
            transmitters.map(|tx| (0..chirps).map(|chirp| row(tx, chirp)).collect()).collect();
        let is_received =
            |chirp: &usize| of_tx.iter().any(|rows| rows[*chirp].iter().any(|share| *share != 0.0));
        let first = (0..chirps).find(is_received).unwrap_or(0);
        let end = (first..chirps).rev().find(is_received).map_or(first, |last| last + 1);
        let shares = of_tx.iter_mut().map(|rows| rows.drain(first..end).flatten().collect()).collect();
        let receiving = whole.during(&(first..end));
        Self { receiving, over_time: Some(shares), over_links: None, before: first, chirps }
    }

    /// Whether a link receives any of the part.
    fn is_received_by(&self, link: usize) -> bool {
        self.over_links.as_ref().is_none_or(|shares| shares[link] != 0.0)
    }

    /// Adds a group's echo to `[link][chirp][sample]` of the whole frame.
    fn add_group<T: Scalar>(
        &self,
        group: &Group<'_>,
        smooth: &SmoothPart,
        links: &[Link],
        error: f64,
        of_links: &mut [Complex<T>],
    ) {
        let receiving = &self.receiving;
        let modes = [receiving.steps.chirps, receiving.radar.waveform.samples as usize];
        let tones: Vec<Tone> = group.paths.par_iter().map(|path| receiving.tone(path)).collect();
        let grid = ToneGrid::<T>::new(&tones, modes, error);
        let ordered: Vec<&Path> = grid.order().map(|i| group.paths[i]).collect();
        let tones: Vec<Tone> = grid.order().map(|i| tones[i]).collect();
        let exact = DirectSum::for_moments(receiving.radar, receiving.centre_frequency_hz, &ordered);
        let sets: Vec<(usize, usize)> = (0..links.len())
            .flat_map(|link| (0..smooth.instants.len()).map(move |instant| (link, instant)))
            .collect();
        let [before, of_part, length] = [self.before, modes[0], self.chirps].map(|chirps| chirps * modes[1]);
        // The instants of one link lie in one block.
        let block = (SETS / smooth.instants.len()).max(1);
        let blocks =
            of_links.par_chunks_mut(block * length).zip(sets.par_chunks(block * smooth.instants.len()));
        blocks.for_each(|(of_block, sets)| {
            let first_link = sets[0].0;
            let heard = sets.iter().copied().filter(|(link, _)| self.is_received_by(*link));
            let sets: Vec<(usize, usize)> = heard.collect();
            if sets.is_empty() {
                return;
            }
            let strengths: Vec<Vec<Complex<T>>> = sets
                .par_iter()
                .map(|&(link, instant)| {
                    strengths(receiving, &exact, &tones, links[link], smooth.instants[instant])
                })
                .collect();
            grid.transform(&strengths, &mut |set, values| {
                let (link, instant) = sets[set];
                let shape = self.weighted(smooth.shape(instant, link, modes[0], modes[1]), links, link);
                let total = &mut of_block[(link - first_link) * length + before..][..of_part];
                let terms = values.iter().zip(&shape).map(|(value, shape)| *value * *shape);
                total.iter_mut().zip(terms).for_each(|(sum, term)| *sum = *sum + term);
            });
        });
    }

    /// A shape weighted by a link's shares.
    fn weighted<T: Scalar>(
        &self,
        mut shape: Vec<Complex<T>>,
        links: &[Link],
        link: usize,
    ) -> Vec<Complex<T>> {
        if let Some(of_tx) = &self.over_time {
            let shares = &of_tx[links[link].tx];
            shape.iter_mut().zip(shares).for_each(|(value, share)| *value = *value * T::of(*share));
        }
        if let Some(shares) = &self.over_links {
            shape.iter_mut().for_each(|value| *value = *value * T::of(shares[link]));
        }
        shape
    }
}

/// Values of all paths at an instant, with their tones removed.
fn strengths<T: Scalar>(
    receiving: &ReceivingRadar<'_>,
    exact: &DirectSum<'_>,
    tones: &[Tone],
    link: Link,
    at: Instant,
) -> Vec<Complex<T>> {
    let middle = receiving.middle();
    let cycles: Vec<f64> = tones.iter().map(|tone| cycles_of(*tone, at, middle)).collect();
    let transmission = receiving.transmission(link, at.chirp);
    exact.values(&transmission, at.sample, &cycles).into_iter().map(rounded).collect()
}

/// Whether every channel of a cube is one link.
fn is_link_by_link(radar: &Radar) -> bool {
    matches!(radar.array.multiplexing, Multiplexing::Simultaneous | Multiplexing::Tdm)
}

/// Channels from links; with Doppler division and codes a receiver's channel is the sum of all its links,
/// each rotated chirp by chirp.
fn channels<T: Scalar>(
    receiving: &ReceivingRadar<'_>,
    mut of_links: Vec<Complex<T>>,
    length: usize,
) -> Vec<Complex<T>> {
    let (radar, steps) = (receiving.radar, &receiving.steps);
    if is_link_by_link(radar) {
        for (link, values) in links(radar).iter().zip(of_links.chunks_exact_mut(length)) {
            let factor = element_factor(radar, link.tx, link.rx);
            if factor != Complex64::ONE {
                values.iter_mut().for_each(|value| *value = *value * rounded::<T>(factor));
            }
        }
        return of_links;
    }
    let (receivers, samples) = (radar.array.rx_m.len(), radar.waveform.samples as usize);
    let mut cube = vec![Complex::new(T::zero(), T::zero()); receivers * length];
    cube.par_chunks_mut(samples).enumerate().for_each(|(r, total)| {
        let [channel, chirp] = steps.place(r);
        for (tx, transmission) in row(radar, channel, chirp).iter().enumerate() {
            let start = tx * receivers * length + r * samples;
            let (values, turn) = (&of_links[start..start + samples], rounded::<T>(transmission.turn));
            total.iter_mut().zip(values).for_each(|(sum, value)| *sum = *sum + turn * *value);
        }
    });
    cube
}
