//! Located points of a map and the objects that they form.
//!
//! There is one point per detected cell, as in the paper's clouds (14, 15, 18 points for a car; its flow
//! sends every cell that passes the detector to the angle FFT). The cells under one main lobe (of the
//! point-spread function; about 3 × 3 with Hann windows) are one measurement: its peak is interpolated
//! between cells, the others lie at their cells' centres. Objects are formed from peaks alone.

use crate::ambiguity::ambiguous_velocities::{ambiguity_mps, folds_are_observable, is_unambiguous};
use crate::ambiguity::time_division_folds::{ChosenFold, FoldResiduals};
use crate::detection::censored::recover_masked;
use crate::detection::empty_band::fold_is_certain;
use crate::detection::peaks::Peak;
use crate::direction::angle::{Direction, Snapshot, VirtualArray};
use crate::direction::directional_peaks::BeamformedMap;
use crate::direction::multipath_ghost::{self, multipath_ghost};
use crate::direction::point_sources::sources_on_lobe;
use crate::direction::position::{WorldPosition, world_position};
use crate::error::DspError;
use crate::estimation::isolation::{Neighbours, single_echo_fits};
use crate::estimation::point_echo::PointEcho;
use crate::estimation::refinement::refined;
use crate::objects::cluster_point::ClusterPoint;
use crate::objects::clusters::clusters;
use crate::objects::stationary::{FoldCertainty, is_at_rest};
use crate::objects::velocity_steps::DopplerAxis;
use crate::plan::Plan;
use crate::spectrum::axes::Axes;
use crate::spectrum::map_cells::MapCells;
use crate::spectrum::window::amplitude;
use artifact::points::{Object, Point, PointsFrame};
use artifact::rdm::RdmFrame;
use artifact::settings::{Angle, DspSettings, StaticEchoes, Window};
use artifact::units::{LOWEST_DB, db_from_power};
use num_complex::Complex32;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// Points of a map, strongest first, and objects in the order of their strongest peaks; isolated peaks are
/// refined on the map's original samples, if given (`refinement.rs`).
///
/// Only the map and its radar's settings are used. A vehicle is one object, whose points share its index; a
/// detection without a detected neighbour, as produced by noise, is a point without object. Detected cells on
/// sidelobes yield no points.
pub(crate) fn locate_points(
    plan: &Plan,
    map: &RdmFrame,
    samples: Option<&[Complex32]>,
) -> Result<PointsFrame, DspError> {
    let (levels, thresholds, array) = (plan.levels(map)?, &plan.thresholds, &plan.array);
    let (power, finder) = (levels.power(), &thresholds.finder);
    let noise = levels.noise() * array.division().map_channels as f64;
    let noise_threshold = thresholds.of_known_noise * noise;
    let mask = recover_masked(&thresholds.censoring, power, &map.mask, noise_threshold);
    let mut peaks = finder.peaks(power, &map.values, &mask, noise_threshold);
    let mut slopes = finder.slopes(power, &mask, &peaks);
    let context = FrameContext { plan, axes: array.cells(), array, map, noise };
    let velocities_mps = context.summit_velocities(&slopes, &peaks);
    let mut on_slopes = BeamformedMap { map, array, finder }.on_slopes(&slopes, &peaks, &velocities_mps);
    // A beam has the noise of one channel; powers of peaks have that of all.
    on_slopes.iter_mut().for_each(|peak| peak.power += noise - context.channel_noise());
    let own: BTreeSet<[usize; 2]> = on_slopes.iter().map(|peak| [peak.row, peak.column]).collect();
    slopes.retain(|(cell, peak)| {
        own.contains(cell) || !finder.is_sidelobe((*cell, power[*cell]), &peaks[*peak], noise_threshold)
    });
    peaks.extend(on_slopes);
    let mut located_echoes = context.resolve_folds_by_object(context.locate_all(&peaks), &peaks);
    context.mark_ghosts(&mut located_echoes);
    if let Some(samples) = samples {
        refine_isolated(&context, samples, &peaks, &mut located_echoes);
    }
    // Nearer cells are not tested; if the range axis is a circle, their lobes reach past its other end.
    located_echoes.retain(|s| s.range_m >= plan.settings.nearest_m);
    if plan.settings.static_echoes == StaticEchoes::Remove {
        located_echoes.retain(|s| !context.is_at_rest(s));
    }
    let groups = context.groups(&located_echoes);
    let on_slopes: Vec<Vec<Point>> = slopes
        .par_iter()
        .map(|(cell, peak)| {
            context.points(&located_echoes, &groups, (power[[cell[0], cell[1]]], *cell), &peaks[*peak])
        })
        .collect();
    let mut points = on_slopes.concat();
    points.retain(|point| point.range_m >= plan.settings.nearest_m);
    let objects = groups.iter().enumerate().map(|(index, group)| {
        let members: Vec<&LocatedEcho> =
            group.iter().map(|i| &located_echoes[*i]).filter(|s| s.peak.is_detected()).collect();
        let own: Vec<&Point> = points.iter().filter(|p| p.object == Some(index as u32)).collect();
        context.object(&members, &own)
    });
    let objects = objects.collect();
    Ok(PointsFrame { index: map.index, time_s: map.time_s, points: strongest_first(points), objects })
}

/// Points by decreasing strength; those of equal strength in the order of the map.
fn strongest_first(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| b.snr_db.total_cmp(&a.snr_db));
    points
}

/// Half width of a main lobe for a window like Hann's.
const LOBE_CELLS: usize = 2;

/// An echo of a peak, or of a cell on its slope, with the result from its channels.
#[derive(Clone)]
struct LocatedEcho {
    /// Peak of the echo, with its own power if the cell contains several echoes.
    peak: Peak,
    range_m: f64,
    radial_velocity_mps: f64,
    snapshot: Snapshot,
    direction: Direction,
    position: WorldPosition,
    /// Residuals of the folds of the echo's cell, if time division resolves them.
    folds: Option<FoldResiduals>,
    /// Azimuths of the two bodies between which a peak's wave travelled, rad; `None` if it travelled to one
    /// and back.
    two_ways_rad: Option<[f64; 2]>,
}

/// Inputs of every step; `noise` is summed over channels.
struct FrameContext<'a> {
    plan: &'a Plan,
    axes: &'a Axes,
    array: &'a VirtualArray,
    map: &'a RdmFrame,
    noise: f64,
}

impl FrameContext<'_> {
    /// Tests every peak's channels for a wave with different directions of departure and arrival.
    fn mark_ghosts(&self, located_echoes: &mut [LocatedEcho]) {
        // Echoes of one cell share its channels, and the strongest comes first.
        let mut of_cells: BTreeMap<[usize; 2], &LocatedEcho> = BTreeMap::new();
        for s in located_echoes.iter() {
            of_cells.entry(s.cell()).or_insert(s);
        }
        let found: BTreeMap<[usize; 2], Option<[f64; 2]>> =
            of_cells.into_par_iter().map(|(cell, s)| (cell, self.two_ways_rad(s))).collect();
        located_echoes.iter_mut().for_each(|s| s.two_ways_rad = found.get(&s.cell()).copied().flatten());
    }

    fn two_ways_rad(&self, s: &LocatedEcho) -> Option<[f64; 2]> {
        let found = multipath_ghost(self.array, &s.snapshot, s.range_m, s.direction, self.channel_noise());
        let azimuth = |direction| world_position(self.array, direction, s.range_m).azimuth_rad;
        found.map(|two| two.directions.map(azimuth))
    }

    /// Azimuths of the two bodies for a cell on the slope of a peak, from its strongest echo: those of the
    /// peak if the echo is the peak's, seen in the same beam. Another echo may lie there without a peak of
    /// its own.
    fn on_slope_of(&self, owner: &LocatedEcho, strongest: &LocatedEcho) -> Option<[f64; 2]> {
        let apart_beams = (owner.direction.right - strongest.direction.right).abs() / self.array.beams()[0];
        if apart_beams < 0.5 { owner.two_ways_rad } else { self.two_ways_rad(strongest) }
    }

    /// Echoes of all peaks, strongest first.
    fn locate_all(&self, peaks: &[Peak]) -> Vec<LocatedEcho> {
        by_strength(peaks.par_iter().map(|peak| self.locate(*peak)).collect())
    }

    /// Echoes of one cell, at least one, at the likeliest fold of its velocity.
    fn locate(&self, peak: Peak) -> Vec<LocatedEcho> {
        let shown_mps = self.axes.wrapped(self.axes.velocity_at(peak.fine_row));
        let range_m = self.range_m(&peak, shown_mps);
        let cell = [peak.row, peak.column];
        let of_cell = || FoldResiduals::of_cell(self.array, self.map, cell, (shown_mps, range_m));
        let folds = folds_are_observable(&self.plan.radar).then(of_cell);
        let velocity_mps = folds.as_ref().map_or(shown_mps, |folds| self.choice(folds).velocity_mps);
        self.locate_at_velocity(peak, velocity_mps, folds)
    }

    /// Echoes of one cell, at least one, at a known velocity.
    fn locate_at_velocity(
        &self,
        peak: Peak,
        radial_velocity_mps: f64,
        folds: Option<FoldResiduals>,
    ) -> Vec<LocatedEcho> {
        let range_m = self.range_m(&peak, radial_velocity_mps);
        self.locate_at(peak, (range_m, radial_velocity_mps), &peak, folds)
    }

    /// Echoes of one cell, at least one, at a known range and velocity, given the peak on whose slope it
    /// lies.
    fn locate_at(
        &self,
        peak: Peak,
        (range_m, radial_velocity_mps): (f64, f64),
        summit: &Peak,
        folds: Option<FoldResiduals>,
    ) -> Vec<LocatedEcho> {
        let snapshot = self.array.snapshot(self.map, [peak.row, peak.column], radial_velocity_mps);
        let found = self.directions(&snapshot, ([peak.row, peak.column], range_m), summit);
        let echoes = found.into_iter().map(|(direction, share)| LocatedEcho {
            peak: Peak { power: self.power_of_share(peak.power, share), ..peak },
            range_m,
            radial_velocity_mps,
            snapshot: snapshot.clone(),
            direction,
            position: world_position(self.array, direction, range_m),
            folds: folds.clone(),
            two_ways_rad: None,
        });
        echoes.collect()
    }

    /// Power of a share of a cell's echo with the noise of the whole cell, which is subtracted later.
    fn power_of_share(&self, power: f64, share: f64) -> f64 {
        if share == 1.0 { power } else { self.noise + share * (power - self.noise).max(0.0) }
    }

    /// Velocity of each peak on whose slope a cell lies, at its likeliest fold; `None` for other peaks, and
    /// where folds are not observable.
    fn summit_velocities(&self, slopes: &[([usize; 2], usize)], peaks: &[Peak]) -> Vec<Option<f64>> {
        if !folds_are_observable(&self.plan.radar) {
            return vec![None; peaks.len()];
        }
        let summits: BTreeSet<usize> = slopes.iter().map(|(_, peak)| *peak).collect();
        let of = |(index, peak): (usize, &Peak)| {
            let shown_mps = self.axes.wrapped(self.axes.velocity_at(peak.fine_row));
            let at = (shown_mps, self.range_m(peak, shown_mps));
            let folds = || FoldResiduals::of_cell(self.array, self.map, [peak.row, peak.column], at);
            summits.contains(&index).then(|| self.choice(&folds()).velocity_mps)
        };
        peaks.par_iter().enumerate().map(of).collect()
    }

    fn range_m(&self, peak: &Peak, velocity_mps: f64) -> f64 {
        self.axes.range_of(peak.fine_column, velocity_mps)
    }

    fn choice(&self, folds: &FoldResiduals) -> ChosenFold {
        folds.best_fold(self.channel_noise())
    }

    /// Noise power of one channel in a cell.
    fn channel_noise(&self) -> f64 {
        self.noise / self.array.division().map_channels as f64
    }

    /// SNR of the transmit–receive pairs, dB: the mean noise is subtracted from the cell, and unused codes
    /// contain nothing else.
    fn snr_db(&self, power: f64) -> f64 {
        let division = self.array.division();
        let pairs = division.pairs() as f64 / division.map_channels as f64;
        snr_db(power - (1.0 - pairs) * self.noise, pairs * self.noise)
    }

    /// Moves the peaks of each object to the one fold that explains all of them best.
    fn resolve_folds_by_object(&self, located_echoes: Vec<LocatedEcho>, peaks: &[Peak]) -> Vec<LocatedEcho> {
        let mut moved: BTreeMap<[usize; 2], (f64, Option<FoldResiduals>)> = BTreeMap::new();
        for group in self.groups(&located_echoes) {
            let members: Vec<&LocatedEcho> = group.iter().map(|index| &located_echoes[*index]).collect();
            let Some(choice) = merged_folds(&members).map(|folds| self.choice(&folds)) else {
                return located_echoes;
            };
            for member in members {
                let velocity_mps = self.axes.unwrapped(member.radial_velocity_mps, choice.velocity_mps);
                moved.entry(member.cell()).or_insert_with(|| (velocity_mps, member.folds.clone()));
            }
        }
        let again = |peak: &Peak| match moved.get(&[peak.row, peak.column]) {
            Some((velocity_mps, folds)) => self.locate_at_velocity(*peak, *velocity_mps, folds.clone()),
            None => self.locate(*peak),
        };
        by_strength(peaks.par_iter().map(again).collect())
    }

    /// Indices of the peaks of each object, including those hidden from the detector.
    fn groups(&self, located_echoes: &[LocatedEcho]) -> Vec<Vec<usize>> {
        let members: Vec<ClusterPoint> = located_echoes.iter().map(|s| self.member(s)).collect();
        let axis =
            DopplerAxis { span_mps: 2.0 * self.axes.velocity_max_mps, cell_mps: self.axes.velocity_cell_mps };
        let mut groups = clusters(&members, &self.plan.settings, axis);
        groups.retain(|group| is_supported(&self.plan.settings, located_echoes, group));
        groups
    }

    fn member(&self, s: &LocatedEcho) -> ClusterPoint {
        let [cross_m, _] = self.plan.settings.road.across_along_m(s.position.position_m.to_array());
        ClusterPoint {
            range_m: s.range_m,
            radial_velocity_mps: s.radial_velocity_mps,
            cross_m,
            cross_error_m: s.range_m * self.cosine_error(s.peak.power),
            power: s.peak.power,
            place_m: (s.position.position_m - self.array.position_m()).truncate(),
        }
    }

    /// Cramér–Rao bound of the direction cosine of an isolated echo, with its power and the noise summed over
    /// channels, for a filled row with beamwidth λ/D: σ = √6/(2π)·λ/D/√(channels·signal over noise); 0 for an
    /// array without extent.
    fn cosine_error(&self, power: f64) -> f64 {
        let beam = self.array.beams()[0];
        if beam.is_finite() { 6f64.sqrt() / TAU * beam / self.over_noise(power).max(1.0).sqrt() } else { 0.0 }
    }

    /// Power ratio of a cell to one channel's noise, summed over channels.
    fn over_noise(&self, power: f64) -> f64 {
        power / self.noise.max(f64::MIN_POSITIVE) * self.array.division().map_channels as f64
    }

    /// Velocity of this map unfolded to be nearest to one with a resolved fold, else within the map's span.
    fn unfolded(&self, velocity_mps: f64, near: &LocatedEcho) -> f64 {
        match near.folds {
            Some(_) => self.axes.unwrapped(velocity_mps, near.radial_velocity_mps),
            None => self.axes.wrapped(velocity_mps),
        }
    }

    /// Amplitude in a cell of a peak's echo seen from farther away, as a function of metres: along the range
    /// lobe, and as 1/R² on the way.
    fn lobe(&self, [row, column]: [usize; 2], range_m: f64, summit: &Peak) -> impl Fn(f64) -> f64 {
        let ([of_rows, of_columns], cell_m) = (&self.plan.thresholds.tapers, self.axes.range_cell_m);
        let [rows, own_rows] = [row, summit.row].map(|row| summit.fine_row - row as f64);
        let [columns, own_columns] = [column, summit.column].map(|column| summit.fine_column - column as f64);
        let own = amplitude(of_rows, own_rows) * amplitude(of_columns, own_columns);
        let scale = summit.power.sqrt() * amplitude(of_rows, rows) / own;
        let from_m = range_m.max(cell_m);
        move |farther_m: f64| {
            let spread = (from_m / (from_m + farther_m)).powi(2);
            scale * spread * amplitude(of_columns, columns + farther_m / cell_m)
        }
    }

    /// Directions of the echoes of a cell on a peak's slope, and their shares of its power.
    fn directions(
        &self,
        snapshot: &Snapshot,
        (cell, range_m): ([usize; 2], f64),
        summit: &Peak,
    ) -> Vec<(Direction, f64)> {
        match self.plan.settings.angle {
            Angle::Fft => vec![(self.array.direction(std::slice::from_ref(snapshot), range_m), 1.0)],
            Angle::MaximumLikelihood => {
                let lobe = self.lobe(cell, range_m, summit);
                let found = sources_on_lobe(self.array, snapshot, range_m, self.channel_noise(), lobe);
                let total: f64 = found.iter().map(|s| s.power).sum();
                let share = |power: f64| if total > 0.0 { power / total } else { 1.0 };
                found.into_iter().map(|s| (s.direction, share(s.power))).collect()
            }
        }
    }

    /// Points of a detected cell with this power.
    fn points(
        &self,
        located_echoes: &[LocatedEcho],
        groups: &[Vec<usize>],
        (power, cell): (f64, [usize; 2]),
        peak: &Peak,
    ) -> Vec<Point> {
        let object_of =
            |index: usize| groups.iter().position(|g| g.binary_search(&index).is_ok()).map(|o| o as u32);
        let seen = self.on_slope(located_echoes, power, cell, [peak.row, peak.column]);
        let point = |(echo, index): (LocatedEcho, usize)| Point {
            stationary: self.stationary([&located_echoes[index]].into_iter()),
            ..echo.point(self.snr_db(echo.peak.power), object_of(index))
        };
        seen.into_iter().map(point).collect()
    }

    /// Echoes of a detected cell, each with the peak's echo that it belongs to: its own, or the nearest
    /// across.
    fn on_slope(
        &self,
        located_echoes: &[LocatedEcho],
        power: f64,
        [row, column]: [usize; 2],
        peak: [usize; 2],
    ) -> Vec<(LocatedEcho, usize)> {
        let of_cell =
            |cell: [usize; 2]| (0..located_echoes.len()).filter(move |i| located_echoes[*i].cell() == cell);
        if of_cell([row, column]).next().is_some() {
            return of_cell([row, column]).map(|index| (located_echoes[index].clone(), index)).collect();
        }
        let is_over = |s: &LocatedEcho| s.is_over(self.axes.cells, [row, column], peak);
        let own = || (0..located_echoes.len()).filter(|i| is_over(&located_echoes[*i]));
        let across = |a: &LocatedEcho, b: &LocatedEcho| (a.direction.right - b.direction.right).abs();
        let Some(owner) = of_cell(peak).next() else { return vec![] };
        let velocity_mps = self.unfolded(self.axes.velocity_at(row as f64), &located_echoes[owner]);
        // A lobe across the end of the range axis is one echo: its cells stay on the side of their peak.
        let shown_m = self.axes.range_of(column as f64, velocity_mps);
        let owner_m = located_echoes[owner].range_m;
        let range_m = self.axes.between_ends(owner_m + self.axes.range_apart_m(shown_m, owner_m));
        let (cell, summit) = (Peak::at_centre(row, column, power), &located_echoes[owner].peak);
        let mut echoes = self.locate_at(cell, (range_m, velocity_mps), summit, None);
        let two_ways_rad =
            echoes.first().and_then(|strongest| self.on_slope_of(&located_echoes[owner], strongest));
        echoes.iter_mut().for_each(|echo| echo.two_ways_rad = two_ways_rad);
        let nearest = |s: &LocatedEcho| {
            own().min_by(|a, b| across(&located_echoes[*a], s).total_cmp(&across(&located_echoes[*b], s)))
        };
        echoes.into_iter().filter_map(|echo| nearest(&echo).map(|index| (echo, index))).collect()
    }
}

/// Combined folds of several cells of one body.
fn merged_folds(members: &[&LocatedEcho]) -> Option<FoldResiduals> {
    let mut folds = members.iter().filter_map(|member| member.folds.as_ref());
    let mut all = folds.next()?.clone();
    folds.for_each(|more| all.join(more));
    Some(all)
}

fn by_strength(of_peaks: Vec<Vec<LocatedEcho>>) -> Vec<LocatedEcho> {
    let mut located_echoes = of_peaks.concat();
    located_echoes.sort_by(|a, b| b.peak.power.total_cmp(&a.peak.power));
    located_echoes
}

/// Replaces the estimates of detected isolated peaks by refined ones.
fn refine_isolated(
    context: &FrameContext<'_>,
    samples: &[Complex32],
    peaks: &[Peak],
    located_echoes: &mut [LocatedEcho],
) {
    let plan = context.plan;
    let neighbours = Neighbours { plan, map: context.map, peaks, noise: context.noise };
    let sample_noise = context.noise / (plan.thresholds.bandwidth_cells * context.map.values.len() as f64);
    let cells: Vec<[usize; 2]> = located_echoes.iter().map(LocatedEcho::cell).collect();
    for echo in located_echoes.iter_mut() {
        let alone = cells.iter().filter(|other| **other == echo.cell()).count() == 1;
        let start = echo.point_echo();
        if !(alone && echo.peak.is_detected() && neighbours.bias_is_negligible(&echo.peak, start)) {
            continue;
        }
        let point = refined(plan, samples, start);
        if let Some(point) = point.filter(|point| single_echo_fits(plan, samples, point, sample_noise)) {
            echo.range_m = context.axes.on_axis(point.range_m);
            echo.radial_velocity_mps = context.unfolded(point.radial_velocity_mps, echo);
            echo.direction = point.direction;
            echo.position = world_position(context.array, point.direction, echo.range_m);
        }
    }
}

impl LocatedEcho {
    fn cell(&self) -> [usize; 2] {
        [self.peak.row, self.peak.column]
    }

    /// Whether the echo is that of a summit, or lies on that summit's slope within a main lobe of `cell`.
    fn is_over(&self, cells: MapCells, cell: [usize; 2], summit: [usize; 2]) -> bool {
        let is_near = cells.apart(self.cell(), cell).into_iter().all(|apart| apart <= LOBE_CELLS);
        self.cell() == summit || (self.peak.summit == summit && is_near)
    }

    fn point_echo(&self) -> PointEcho {
        PointEcho {
            range_m: self.range_m,
            radial_velocity_mps: self.radial_velocity_mps,
            direction: self.direction,
        }
    }

    fn point(&self, snr_db: f64, object: Option<u32>) -> Point {
        Point {
            range_m: self.range_m,
            radial_velocity_mps: self.radial_velocity_mps,
            azimuth_rad: self.position.azimuth_rad,
            elevation_rad: self.position.elevation_rad,
            height: self.position.height,
            position_m: self.position.position_m.to_array(),
            snr_db,
            two_ways_rad: self.two_ways_rad,
            stationary: None,
            object,
            target: None,
            label: None,
        }
    }
}

/// Signal-to-noise ratio, dB: the mean noise is subtracted from the cell, and the result kept at a hundredth
/// or more for the logarithm, since detections lie above the noise. Without noise it is the highest value,
/// 300 dB.
fn snr_db(power: f64, noise: f64) -> f64 {
    if noise > 0.0 { db_from_power((power / noise - 1.0).max(0.01)) } else { -LOWEST_DB }
}

/// Whether a group is more than an isolated cell. A window spreads an echo over neighbours that are at most 8
/// dB lower, while noise passes in single cells (at a rate of 1e-5, 0.3 per map): such a cell is a point, but
/// not an object. Without a window an echo at a bin's centre is isolated too.
fn is_supported(settings: &DspSettings, located_echoes: &[LocatedEcho], group: &[usize]) -> bool {
    let spreads = |window: Window| window != Window::Rect;
    let lone_is_noise = spreads(settings.range_window) || spreads(settings.doppler_window);
    let detected = group.iter().map(|i| &located_echoes[*i].peak).filter(|peak| peak.is_detected());
    detected.map(|peak| peak.cells).sum::<u32>() > u32::from(lone_is_noise)
}

impl FrameContext<'_> {
    /// Object of detected peaks, strongest first, and of the points on their slopes.
    fn object(&self, peaks: &[&LocatedEcho], points: &[&Point]) -> Object {
        let strongest = peaks[0];
        let near_strongest =
            |velocity_mps: f64| self.axes.unwrapped(velocity_mps, strongest.radial_velocity_mps);
        let weights: Vec<f64> = peaks.iter().map(|s| s.peak.power).collect();
        let range_m = weighted_mean(peaks.iter().map(|s| s.range_m), &weights);
        let velocity_mps =
            weighted_mean(peaks.iter().map(|s| near_strongest(s.radial_velocity_mps)), &weights);
        let position = world_position(self.array, self.direction(peaks, &weights, range_m), range_m);
        Object {
            range_m,
            radial_velocity_mps: self.unfolded(velocity_mps, strongest),
            velocity_resolved: self.is_resolved(peaks),
            azimuth_rad: position.azimuth_rad,
            height: position.height,
            position_m: position.position_m.to_array(),
            lane: self.plan.lanes.at(position.position_m.to_array()),
            snr_db: self.snr_db(strongest.peak.power),
            points: points.len() as u32,
            range_extent_m: extent(points.iter().map(|p| p.range_m)),
            velocity_extent_mps: extent(points.iter().map(|p| near_strongest(p.radial_velocity_mps))),
            ghost_share: multipath_ghost::is_detectable(self.array).then(|| {
                weighted_mean(peaks.iter().map(|s| f64::from(u8::from(s.two_ways_rad.is_some()))), &weights)
            }),
            stationary: self.stationary(peaks.iter().copied()),
        }
    }

    /// Whether the fold of a body's velocity is beyond doubt; the strongest of its peaks comes first. The
    /// empty band of Doppler division resolves the band, but not velocities a whole span away.
    fn is_resolved(&self, peaks: &[&LocatedEcho]) -> bool {
        match merged_folds(peaks) {
            Some(folds) => self.choice(&folds).is_certain,
            None => {
                let size = [self.axes.rows, self.axes.columns];
                let velocity_mps = self.axes.wrapped(peaks[0].radial_velocity_mps);
                fold_is_certain(self.array.division(), self.map, size, peaks[0].cell())
                    && is_unambiguous(velocity_mps, ambiguity_mps(&self.plan.radar))
            }
        }
    }

    /// Whether all peaks are at rest, if requested.
    fn stationary<'s>(&self, mut peaks: impl Iterator<Item = &'s LocatedEcho>) -> Option<bool> {
        (self.plan.settings.static_echoes != StaticEchoes::Keep)
            .then(|| peaks.all(|peak| self.is_at_rest(peak)))
    }

    fn is_at_rest(&self, s: &LocatedEcho) -> bool {
        let fold = if self.is_resolved(&[s]) { FoldCertainty::Resolved } else { FoldCertainty::Assumed };
        is_at_rest(&self.plan.radar, s.radial_velocity_mps, fold, self.over_noise(s.peak.power))
    }

    /// Common direction of all peaks: the strongest beam of their cells, or the mean of the echoes resolved
    /// in them.
    fn direction(&self, peaks: &[&LocatedEcho], weights: &[f64], range_m: f64) -> Direction {
        match (peaks, self.plan.settings.angle) {
            ([lone], _) => lone.direction,
            (_, Angle::Fft) => {
                self.array.direction(&peaks.iter().map(|s| s.snapshot.clone()).collect::<Vec<_>>(), range_m)
            }
            (_, Angle::MaximumLikelihood) => Direction {
                right: weighted_mean(peaks.iter().map(|s| s.direction.right), weights),
                up: strongest_up(peaks)
                    .map(|_| weighted_mean(peaks.iter().map(|s| s.direction.up.unwrap_or(0.0)), weights)),
            },
        }
    }
}

/// Elevation of the strongest echo, if the array measures it.
fn strongest_up(peaks: &[&LocatedEcho]) -> Option<f64> {
    peaks.first().and_then(|s| s.direction.up)
}

fn weighted_mean(values: impl Iterator<Item = f64>, weights: &[f64]) -> f64 {
    let weight: f64 = weights.iter().sum();
    values.zip(weights).map(|(v, w)| v * w).sum::<f64>() / weight
}

pub(crate) fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}
