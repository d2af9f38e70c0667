//! Pairing of bodies with detected objects, common to estimates, metrics, the console and the report.
//!
//! An object is paired by its distance, seen from above, to the nearest part of a body's outline: the radar
//! sees the side that faces it, and for a bus seen from the front that is 6 m before its middle. It must move
//! as the body does there: a ghost of two other bodies within the outline is not the body. Bodies and objects
//! are paired one to one with the least sum of squares, as in GOSPA, with two differences: half a metre
//! counts as zero, so that the strongest of a body's parts is chosen, and velocities that the map folds onto
//! the body's have a cost, so that an object in the right fold is preferred.
//!
//! The setting for static echoes determines the rest: an object marked as at rest is paired with no vehicle,
//! and does not count as false if it belongs to nobody; a body whose echoes were removed does not count as
//! missed.

use crate::metrics::gospa::{Gospa, gospa_by_costs};
use crate::truth::Truth;
use artifact::Radar;
use artifact::points::Object;
use artifact::scene::SceneHeader;
use artifact::settings::StaticEchoes;
use artifact::tracks::Track;
use glam::{DVec2, DVec3};
use ndarray::{Array2, Axis};
use radar::doppler_ambiguity::folded_mps;
use radar::lattice::resolves_azimuth;

/// Largest distance between an object and the outline of its body: an object in the middle of the next lane,
/// 3.75 m away, is 2.9 m from the side of a car.
pub const GATE_M: f64 = 3.0;

/// Largest difference between an object's radial velocity and that of its body seen at the object's place, as
/// the map folds it. At a position error equal to the gate at 30 m, a body that crosses at 14 m/s differs by
/// 1.4 m/s; parts of one object differ by a metre a second (`cluster_velocity_mps`).
/// If a Doppler cell is wider than twice that, half of it is used instead: a frame of one chirp measures no
/// velocity.
pub const VELOCITY_GATE_MPS: f64 = 2.0;

/// Distance up to which an object counts as on a body's outline, as good as any within: two range cells of
/// Table 2's narrowest band, and the error of directions at 30 m.
const ON_OUTLINE_M: f64 = 0.5;

/// Additional distance of an object in another fold than the body's.
const OTHER_FOLD_M: f64 = 2.0;

/// Largest difference between the radial velocities of a track that coasts and of a body whose echoes were
/// removed. The track keeps the velocity at which its body was last seen: one that brakes by 4.5 m/s² is 0.9
/// m/s slower a frame later, after 0.2 s.
const COASTING_MPS: f64 = 1.0;

/// Limits of a radar's measurements of places and velocities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasurementLimits {
    /// The radar's position, m.
    pub position_m: DVec3,
    /// Maximum unambiguous range, m.
    pub range_max_m: f64,
    /// Velocity span: velocities that differ by it look alike.
    pub velocity_span_mps: f64,
    /// Largest difference between the radial velocities of an object and its body.
    pub velocity_gate_mps: f64,
    /// Whether the array measures azimuths. Otherwise bodies are paired by range alone.
    pub resolves_azimuth: bool,
    /// Velocity up to which echoes, as the map folds them, may have been removed; `None` if none are.
    pub removed_to_mps: Option<f64>,
}

/// Distance and difference of radial velocity of an object from a body.
struct Separation {
    distance_m: f64,
    velocity_mps: f64,
}

impl MeasurementLimits {
    /// Squared distance by which a body's object is chosen, m². Objects on the outline count as within: a
    /// strong echo of a front, measured a hand's breadth before it, is preferred to a weak one of the load.
    /// An echo in the right fold is preferred to a ghost within the outline that has the same velocity only
    /// by folding.
    fn cost_m2(&self, separation: &Separation) -> f64 {
        let is_folded = separation.velocity_mps.abs() > self.velocity_gate_mps;
        let of_fold_m2 = if is_folded { OTHER_FOLD_M.powi(2) } else { 0.0 };
        (separation.distance_m - ON_OUTLINE_M).max(0.0).powi(2) + of_fold_m2
    }

    /// The limits of a scene's radar with its settings.
    pub fn of(header: &SceneHeader) -> Self {
        let (radar, removes) = (&header.radar, header.dsp.static_echoes == StaticEchoes::Remove);
        // Half a Doppler cell, and as much again for the velocity error of a weak echo.
        let removed_to_mps = removes.then(|| radar.velocity_resolution_mps());
        Self { removed_to_mps, ..Self::of_radar(radar) }
    }

    /// The limits of a radar among bodies whose velocities are unknown: they are paired by place alone, and
    /// none counts as removed.
    pub(crate) fn by_place(radar: &Radar) -> Self {
        Self { velocity_gate_mps: f64::INFINITY, ..Self::of_radar(radar) }
    }

    fn of_radar(radar: &Radar) -> Self {
        Self {
            removed_to_mps: None,
            position_m: DVec3::from(radar.position_m),
            range_max_m: radar.waveform.range_max_m(),
            velocity_span_mps: 2.0 * radar.velocity_max_mps(),
            velocity_gate_mps: velocity_gate_mps(radar),
            resolves_azimuth: resolves_azimuth(radar),
        }
    }

    fn separation(&self, truth: &Truth, object: &Object) -> Separation {
        Separation {
            distance_m: self.distance_m(truth, object).abs(),
            velocity_mps: object.radial_velocity_mps - self.radial_velocity_mps(truth, object),
        }
    }

    /// Squared distance from the outline to an object that moves as the body does; infinite for others.
    fn square_m2(&self, separation: &Separation) -> f64 {
        let moves_alike = self.folded_mps(separation.velocity_mps).abs() <= self.velocity_gate_mps;
        if moves_alike { separation.distance_m.powi(2) } else { f64::INFINITY }
    }

    /// Radial velocity of a body seen at the object's place, or, if that is unknown, at its own.
    fn radial_velocity_mps(&self, truth: &Truth, object: &Object) -> f64 {
        let sight = (DVec3::from(object.position_m) - self.position_m).normalize_or_zero();
        if self.resolves_azimuth { truth.velocity_mps.dot(sight) } else { truth.radial_velocity_mps }
    }

    /// Distance of an object from a body's outline, or, without azimuths, of their ranges.
    fn distance_m(&self, truth: &Truth, object: &Object) -> f64 {
        let radar_m = self.position_m.truncate();
        if self.resolves_azimuth {
            return truth.outline.distance_m(ground_position(object));
        }
        let range_m = ground_position(object).distance(radar_m);
        let [near_m, far_m] = truth.outline.ranges_m(radar_m);
        range_m.clamp(near_m, far_m) - range_m
    }

    fn folded_mps(&self, velocity_mps: f64) -> f64 {
        folded_mps(velocity_mps, self.velocity_span_mps)
    }

    /// Whether a track that coasts has the radial velocity of a body whose echoes are removed, to
    /// [`COASTING_MPS`] or a Doppler cell. A velocity that is not resolved is compared as the map folds it.
    fn moves_on_with(&self, truth: &Truth, track: &Track) -> bool {
        let away_m = DVec2::from(track.footprint.centre_m) - self.position_m.truncate();
        let sight = away_m.normalize_or_zero();
        let of_body_mps = match self.resolves_azimuth {
            true => truth.velocity_mps.truncate().dot(sight),
            false => truth.radial_velocity_mps,
        };
        let apart_mps = DVec2::from(track.velocity_mps).dot(sight) - of_body_mps;
        let apart_mps = if track.velocity_resolved { apart_mps } else { self.folded_mps(apart_mps) };
        apart_mps.abs() <= COASTING_MPS.max(self.removed_to_mps.unwrap_or(0.0))
    }

    /// Whether all of a body's echoes are at rest and removed.
    fn removes(&self, truth: &Truth) -> bool {
        let velocity_mps = truth.echo.map_or(truth.radial_velocity_mps, |echo| echo.radial_velocity_mps);
        self.removed_to_mps.is_some_and(|limit_mps| self.folded_mps(velocity_mps).abs() <= limit_mps)
    }
}

/// Largest difference between the radial velocities of an object and its body.
fn velocity_gate_mps(radar: &Radar) -> f64 {
    VELOCITY_GATE_MPS.max(0.5 * radar.velocity_resolution_mps())
}

/// Bodies of a frame with their objects.
#[derive(Debug, Clone, PartialEq)]
pub struct Pairing {
    /// Limits by which they were paired.
    pub(crate) limits: MeasurementLimits,
    /// Index of each truth's object, in the order of the truths.
    pub object_of: Vec<Option<usize>>,
    /// Truths that should be found, in order: rows of `squares_m2`.
    pub expected: Vec<usize>,
    /// Truths that should be found if their echoes had not been removed as echoes at rest.
    pub removed: Vec<usize>,
    /// Objects marked as at rest that belong to nobody.
    pub stationary: Vec<usize>,
    /// Squared distances, `[truth, object]`, from the outlines of `expected` to the objects that are not
    /// stationary; infinite if they do not move alike.
    pub squares_m2: Array2<f64>,
    /// GOSPA of `squares_m2`, with the objects' indices in the frame.
    pub gospa: Gospa,
}

impl Pairing {
    /// Pairs truths with objects; only truths that should be found get one: no clutter, nothing hidden or
    /// beyond the maximum unambiguous range.
    pub fn of(truths: &[Truth], objects: &[Object], limits: &MeasurementLimits) -> Self {
        let detectable: Vec<usize> =
            (0..truths.len()).filter(|t| truths[*t].is_detectable(limits.range_max_m)).collect();
        let separations = Array2::from_shape_fn((detectable.len(), objects.len()), |(row, o)| {
            limits.separation(&truths[detectable[row]], &objects[o])
        });
        let squares_m2 = separations.map(|separation| limits.square_m2(separation));
        let all = gospa_by_costs(
            squares_m2.view(),
            separations.map(|separation| limits.cost_m2(separation)).view(),
            GATE_M,
        );
        let mut object_of = vec![None; truths.len()];
        detectable.iter().zip(&all.chosen).for_each(|(truth, object)| object_of[*truth] = *object);
        let is_removed =
            |row: &usize| all.chosen[*row].is_none() && limits.removes(&truths[detectable[*row]]);
        let (gone, kept): (Vec<usize>, Vec<usize>) = (0..detectable.len()).partition(is_removed);
        let is_stationary =
            |o: &usize| objects[*o].stationary == Some(true) && !all.chosen.contains(&Some(*o));
        let (stationary, moving): (Vec<usize>, Vec<usize>) = (0..objects.len()).partition(is_stationary);
        Self {
            limits: *limits,
            object_of,
            squares_m2: squares_m2.select(Axis(0), &kept).select(Axis(1), &moving),
            gospa: all.without(&gone, stationary.len()),
            expected: kept.into_iter().map(|row| detectable[row]).collect(),
            removed: gone.into_iter().map(|row| detectable[row]).collect(),
            stationary,
        }
    }

    /// Body of an object.
    pub fn body_of(&self, object: usize) -> Option<usize> {
        self.object_of.iter().position(|own| *own == Some(object))
    }

    /// Whether a track without an object in this frame may follow a body whose echoes were removed: it is no
    /// farther from the body than `far_m`, and its velocity is that of the body.
    pub(crate) fn follows_removed(&self, truths: &[Truth], track: &Track, far_m: f64) -> bool {
        let middle_m = DVec2::from(track.footprint.centre_m);
        let is_it = |truth: &Truth| {
            truth.position_m.truncate().distance(middle_m) <= far_m && self.limits.moves_on_with(truth, track)
        };
        track.objects.is_empty() && self.removed.iter().any(|body| is_it(&truths[*body]))
    }

    /// Whether a track has objects in this frame, and only stationary ones.
    pub fn is_stationary(&self, track: &Track) -> bool {
        !track.objects.is_empty()
            && track.objects.iter().all(|object| self.stationary.contains(&(*object as usize)))
    }
}

/// Position of an object seen from above.
pub fn ground_position(object: &Object) -> DVec2 {
    DVec2::new(object.position_m[0], object.position_m[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_object::{body, object_at};
    use artifact::scene::Role;
    use glam::DVec3;

    fn objects_of(truths: &[Truth], objects: &[Object]) -> Vec<Option<usize>> {
        Pairing::of(truths, objects, &LIMITS).object_of
    }

    const LIMITS: MeasurementLimits = MeasurementLimits {
        position_m: DVec3::ZERO,
        range_max_m: 100.0,
        velocity_span_mps: 20.0,
        velocity_gate_mps: VELOCITY_GATE_MPS,
        resolves_azimuth: true,
        removed_to_mps: None,
    };

    #[test]
    fn an_array_that_tells_no_azimuth_finds_a_body_by_its_range() {
        // Of the body, 8 m beside the boresight, ranges are 40.6 to 44.9 m.
        let truths = [body(4.0, [8.0, 42.0])];
        let by_range = MeasurementLimits { resolves_azimuth: false, ..LIMITS };
        let paired = |range_m, limits: &MeasurementLimits| {
            Pairing::of(&truths, &[object_at([0.0, range_m])], limits).object_of == [Some(0)]
        };
        assert_eq!(
            [37.0, 42.0, 47.0, 48.5].map(|range_m| paired(range_m, &by_range)),
            [false, true, true, false]
        );
        assert!(!paired(42.0, &LIMITS), "8 m beside it, where azimuths are told");
    }

    #[test]
    fn objects_at_rest_that_are_nobodys_are_told_apart_from_false_ones() {
        let told = |stationary, object| Object { stationary, ..object };
        let objects = [
            told(Some(true), object_at([2.0, 40.0])),
            told(Some(true), object_at([12.0, 30.0])),
            told(Some(false), object_at([12.0, 50.0])),
        ];
        let pairing = Pairing::of(&[body(4.0, [2.0, 42.0])], &objects, &LIMITS);
        assert_eq!(
            (&pairing.object_of, &pairing.stationary),
            (&vec![Some(0)], &vec![1]),
            "a vehicle that waits is found"
        );
        assert_eq!(
            (pairing.gospa.missed, pairing.gospa.false_ones, pairing.squares_m2.dim()),
            (0, 1, (1, 2))
        );
        let unmarked = objects.map(|object| told(None, object));
        let pairing = Pairing::of(&[body(4.0, [2.0, 42.0])], &unmarked, &LIMITS);
        assert_eq!(
            (pairing.stationary.len(), pairing.gospa.false_ones, pairing.squares_m2.dim()),
            (0, 2, (1, 3))
        );
    }

    #[test]
    fn a_body_whose_echoes_were_removed_is_not_missed_and_one_that_moves_is() {
        let drives = |truth: Truth| Truth { radial_velocity_mps: -8.0, ..truth };
        let truths = [body(4.0, [2.0, 42.0]), drives(body(4.0, [5.75, 30.0])), body(4.0, [9.5, 20.0])];
        let object = object_at([9.5, 20.0]);
        let removing = MeasurementLimits { removed_to_mps: Some(0.25), ..LIMITS };
        let pairing = Pairing::of(&truths, &[object], &removing);
        assert_eq!(
            (&pairing.removed, &pairing.expected),
            (&vec![0], &vec![1, 2]),
            "what has an object is found"
        );
        assert_eq!((pairing.gospa.missed, &pairing.gospa.chosen), (1, &vec![None, Some(0)]));
        let blind = |truth: Truth| Truth { radial_velocity_mps: -20.0, ..truth };
        assert_eq!(
            Pairing::of(&[blind(body(4.0, [2.0, 42.0]))], &[], &removing).removed,
            [0],
            "a span away looks alike"
        );
        assert!(Pairing::of(&truths, &[object], &LIMITS).removed.is_empty());
    }

    #[test]
    fn a_ghost_within_the_outline_that_moves_otherwise_is_not_the_body_and_an_aliased_echo_is() {
        // At rest; strongest first.
        let truths = [body(8.0, [2.0, 34.0])];
        let moving = |object: Object, by_mps: f64| Object { radial_velocity_mps: by_mps, ..object };
        let ghost = moving(object_at([2.0, 36.0]), -9.5);
        assert_eq!(objects_of(&truths, &[ghost, object_at([2.0, 29.5])]), [Some(1)]);
        // A span away.
        assert_eq!(objects_of(&truths, &[ghost, moving(object_at([2.0, 29.5]), 20.4)]), [Some(1)]);
    }

    #[test]
    fn a_radar_of_few_chirps_finds_a_body_within_half_its_doppler_cell() {
        let truths = [body(8.0, [2.0, 34.0])];
        let object = Object { radial_velocity_mps: 4.9, ..object_at([2.0, 30.0]) };
        assert_eq!(objects_of(&truths, &[object]), [None]);
        let mut radar = radar::paper::radar(
            [0.0; 3],
            radar::paper::waveform(64, 1),
            [radar::aperture::row(1, 1.0), radar::aperture::row(4, 1.0)],
        );
        // One chirp tells no velocity; 0 is shown of every body.
        let limits =
            |radar: &Radar| MeasurementLimits { velocity_gate_mps: velocity_gate_mps(radar), ..LIMITS };
        assert_eq!(Pairing::of(&truths, &[object], &limits(&radar)).object_of, [Some(0)]);
        radar.waveform.chirps = 128;
        assert_eq!(Pairing::of(&truths, &[object], &limits(&radar)).object_of, [None]);
    }

    #[test]
    fn an_echo_in_the_right_fold_is_taken_before_a_ghost_within_the_outline() {
        // At rest, its front at 30 m; the map folds 20 m/s onto rest.
        let truths = [body(8.0, [2.0, 34.0])];
        let ghost = Object { radial_velocity_mps: -19.5, ..object_at([2.0, 36.0]) };
        assert_eq!(objects_of(&truths, &[ghost, object_at([2.0, 29.5])]), [Some(1)]);
        assert_eq!(objects_of(&truths, &[ghost]), [Some(0)], "alone it is what is seen of the body");
    }

    #[test]
    fn of_a_bodys_parts_the_strongest_is_taken_though_it_is_told_before_the_front() {
        let truths = [body(8.0, [2.0, 34.0])];
        let [front, load] = [object_at([2.0, 29.6]), object_at([2.0, 36.0])];
        assert_eq!(objects_of(&truths, &[front, load]), [Some(0)], "strongest first");
        assert_eq!(objects_of(&truths, &[load, front]), [Some(0)]);
        assert_eq!(objects_of(&truths, &[object_at([2.0, 29.0]), load]), [Some(1)], "a metre is a distance");
    }

    #[test]
    fn a_bus_seen_from_the_front_is_found_though_its_middle_is_six_metres_behind() {
        assert_eq!(objects_of(&[body(12.0, [2.0, 50.0])], &[object_at([2.0, 43.5])]), [Some(0)]);
    }

    #[test]
    fn the_best_assignment_is_taken_not_the_nearest_pairs() {
        // Nearest first would give the object between them to the second body and leave the first without.
        let truths = [body(4.0, [2.0, 38.0]), body(4.0, [2.0, 44.0])];
        let objects = [object_at([2.0, 41.5]), object_at([2.0, 47.0])];
        assert_eq!(objects_of(&truths, &objects), [Some(0), Some(1)]);
    }

    #[test]
    fn what_is_clutter_or_hidden_or_out_of_range_has_no_object_however_near() {
        let near = || body(4.0, [2.0, 40.0]);
        let none = [
            Truth { role: Role::Clutter, ..near() },
            Truth { returns_echo: false, ..near() },
            body(4.0, [2.0, 101.0]),
        ];
        let objects = [object_at([2.0, 40.0]), object_at([2.0, 101.0])];
        assert_eq!(objects_of(&none, &objects), [None; 3]);
    }

    #[test]
    fn an_object_beyond_the_gate_is_nobodys() {
        let truths = [body(4.0, [2.0, 40.0])];
        assert_eq!(objects_of(&truths, &[object_at([2.0, 34.9]), object_at([6.1, 40.0])]), [None]);
        assert_eq!(objects_of(&truths, &[object_at([5.9, 40.0])]), [Some(0)]);
    }
}
