//! Objects that belong to no body, false or at rest, with their true causes.

use crate::chain::frame_result::FrameResult;
use artifact::points::{Label, Object, Point};
use artifact::scene::{Role, SceneHeader};
use artifact::units::power_from_db;
use dsp::gamma_tail;
use evaluation::{FrameTruth, GATE_M, Origin, ground_position};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// An object that belongs to no body.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FalseObject {
    /// Index of the object among the frame's objects, as in `.points`.
    pub object: usize,
    /// Place along world x, m.
    pub x_m: f64,
    /// Place along world y, m.
    pub y_m: f64,
    /// Range from the radar, m.
    pub range_m: f64,
    /// Radial velocity, positive when the range grows, m/s.
    pub radial_velocity_mps: f64,
    /// Signal-to-noise ratio of the object's strongest cell, dB.
    pub snr_db: f64,
    /// Share of the power of the object's peaks that travelled between two bodies; `None` where the array
    /// cannot measure it.
    pub ghost_share: Option<f64>,
    /// Cause of most of the power of the object's points.
    pub cause: Cause,
    /// Ids of the bodies that made the object.
    pub bodies: Vec<String>,
    /// Bounces of the wave that made the object; `None` if no path did.
    pub bounces: Option<u8>,
}

impl FalseObject {
    /// The cause in words, with the bodies and bounces that it names: the same for a console and a page.
    pub fn cause_in_words(&self) -> String {
        let bodies = self.bodies.join(" and ");
        let bounces = match self.bounces {
            None => String::new(),
            Some(1) => ", 1 bounce".into(),
            Some(many) => format!(", {many} bounces"),
        };
        match self.cause {
            Cause::Ghost => format!("multipath ghost by {bodies}{bounces}"),
            Cause::Split => format!("split off {bodies}, which already has an object"),
            Cause::Misplaced => format!("echo of {bodies}, too far from it in position or velocity{bounces}"),
            Cause::Clutter if bodies.is_empty() => "clutter: the road's own backscatter".into(),
            Cause::Clutter => format!("clutter: {bodies}"),
            Cause::Interference => "interference by another radar".into(),
            Cause::Receiver => "receiver: ADC or phase noise".into(),
            cause @ (Cause::Noise | Cause::Unknown) => cause.name().into(),
        }
    }
}

/// Cause of an object that belongs to no body.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// A path over several bodies, or one over several facets of a body whose object is elsewhere.
    Ghost,
    /// A further object of a body that already has one.
    Split,
    /// The echo of a body that has no object, seen further from it than the gate.
    Misplaced,
    /// The echo of a clutter body, or, without a body, the road's own backscatter.
    Clutter,
    /// A false alarm, without a path.
    Noise,
    /// Another radar of the scene: no path, and a level above that of noise.
    Interference,
    /// A converter that clips or rounds, or phase noise: no path, no other radar, and a level above that of
    /// noise.
    Receiver,
    /// Unknown: echoes of tables, which have no paths; or no path, a level above that of noise, and an
    /// ideal receiver.
    #[default]
    Unknown,
}

impl Cause {
    /// Name of the cause, as in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ghost => "ghost",
            Self::Split => "split",
            Self::Misplaced => "misplaced",
            Self::Clutter => "clutter",
            Self::Noise => "noise",
            Self::Interference => "interference",
            Self::Receiver => "receiver",
            Self::Unknown => "unknown",
        }
    }
}

/// A cause with the responsible bodies and bounces.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Attribution {
    cause: Cause,
    bodies: BTreeSet<u32>,
    bounces: Option<u8>,
}

impl Attribution {
    fn by(cause: Cause, body: u32, bounces: u8) -> Self {
        Self { cause, bodies: BTreeSet::from([body]), bounces: Some(bounces) }
    }
}

/// Objects of a frame that belong to no body, without those marked as at rest.
pub(crate) fn moving(header: &SceneHeader, result: &FrameResult, truth: &FrameTruth) -> Vec<FalseObject> {
    let is_false =
        |index: &usize| truth.pairing.body_of(*index).is_none() && !truth.pairing.stationary.contains(index);
    let objects = (0..result.points.objects.len()).filter(is_false);
    objects.map(|index| object(header, result, truth, index)).collect()
}

/// Objects of a frame that belong to no body and are marked as at rest.
pub(crate) fn stationary(header: &SceneHeader, result: &FrameResult, truth: &FrameTruth) -> Vec<FalseObject> {
    truth.pairing.stationary.iter().map(|index| object(header, result, truth, *index)).collect()
}

fn object(header: &SceneHeader, result: &FrameResult, truth: &FrameTruth, index: usize) -> FalseObject {
    let (object, Attribution { cause, bodies, bounces }) =
        (&result.points.objects[index], attribute(header, result, truth, index));
    let id = |body: &u32| header.targets.get(*body as usize).map(|target| target.id.clone());
    FalseObject {
        object: index,
        x_m: object.position_m[0],
        y_m: object.position_m[1],
        range_m: object.range_m,
        radial_velocity_mps: object.radial_velocity_mps,
        snr_db: object.snr_db,
        ghost_share: object.ghost_share,
        cause,
        bodies: bodies.iter().filter_map(id).collect(),
        bounces,
    }
}

/// Finds the cause of most of the power of the object's points.
fn attribute(header: &SceneHeader, result: &FrameResult, truth: &FrameTruth, index: usize) -> Attribution {
    let mut powers: BTreeMap<Attribution, f64> = BTreeMap::new();
    let points = result.points.points.iter().zip(&truth.origins);
    for (point, origin) in points.filter(|(point, _)| point.object == Some(index as u32)) {
        let attribution = of_point(header, truth, &result.points.objects[index], (point, origin));
        *powers.entry(attribution).or_default() += power_from_db(point.snr_db);
    }
    let strongest = powers.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
    strongest.map(|(attribution, _)| attribution).unwrap_or_default()
}

fn of_point(
    header: &SceneHeader,
    truth: &FrameTruth,
    object: &Object,
    (point, origin): (&Point, &Origin),
) -> Attribution {
    let (label, bodies) = match origin {
        Origin::Noise => return Attribution { cause: of_no_path(header, point), ..Attribution::default() },
        Origin::Ground => return Attribution { cause: Cause::Clutter, ..Attribution::default() },
        Origin::Echo { label, bodies } => (label, bodies),
    };
    let (body, bounces) = (label.target, label.order);
    let is_clutter = header.targets.get(body as usize).is_some_and(|target| target.role == Role::Clutter);
    match bodies.len() {
        0 | 1 if is_clutter => Attribution::by(Cause::Clutter, body, bounces),
        0 | 1 => of_one_body(truth, object, label),
        _ => Attribution { cause: Cause::Ghost, bodies: bodies.clone(), bounces: Some(bounces) },
    }
}

/// Cause of a point that no path explains.
fn of_no_path(header: &SceneHeader, point: &Point) -> Cause {
    let hardware = &header.radar.hardware;
    match point {
        _ if noise_reaches(header, point.snr_db) => Cause::Noise,
        _ if !hardware.interferers.is_empty() => Cause::Interference,
        _ if hardware.adc.is_some() || !hardware.phase_noise.is_empty() => Cause::Receiver,
        _ => Cause::Unknown,
    }
}

/// Whether noise alone reaches such a level in more than one of a million maps. The power of a cell, summed
/// over M channels, is a sum of M exponential variables: it exceeds M·(1 + ρ) times their mean with
/// probability Q(M, M(1 + ρ)), where ρ is the level over the noise.
fn noise_reaches(header: &SceneHeader, snr_db: f64) -> bool {
    let (radar, channels) = (&header.radar, header.radar.virtual_channels());
    let cells = f64::from(radar.waveform.samples) * f64::from(radar.waveform.chirps);
    let in_a_map = cells * gamma_tail(channels, channels as f64 * (1.0 + power_from_db(snr_db)));
    in_a_map > 1e-6
}

/// Cause of an echo of one target alone in an object that does not belong to the target.
fn of_one_body(truth: &FrameTruth, object: &Object, label: &Label) -> Attribution {
    let (body, bounces) = (label.target, label.order);
    let has_object = truth.pairing.object_of.get(body as usize).is_some_and(Option::is_some);
    let is_there = truth
        .truths
        .get(body as usize)
        .is_some_and(|t| t.outline.distance_m(ground_position(object)) <= GATE_M);
    let cause = match (has_object, is_there) {
        (true, false) if bounces > 1 => Cause::Ghost,
        (true, _) => Cause::Split,
        (false, _) => Cause::Misplaced,
    };
    Attribution::by(cause, body, bounces)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_names_the_bodies_and_the_bounces_that_tell_it() {
        let of = |cause, bodies: &[&str], bounces| {
            let bodies = bodies.iter().map(|id| (*id).to_owned()).collect();
            FalseObject { cause, bodies, bounces, ..FalseObject::default() }.cause_in_words()
        };
        for (told, words) in [
            (of(Cause::Ghost, &["a", "b"], Some(2)), "multipath ghost by a and b, 2 bounces"),
            (of(Cause::Split, &["a"], Some(1)), "split off a, which already has an object"),
            (
                of(Cause::Misplaced, &["a"], Some(1)),
                "echo of a, too far from it in position or velocity, 1 bounce",
            ),
            (of(Cause::Clutter, &["rail"], Some(1)), "clutter: rail"),
            (of(Cause::Clutter, &[], None), "clutter: the road's own backscatter"),
            (of(Cause::Noise, &[], None), "noise"),
            (of(Cause::Unknown, &[], None), "unknown"),
        ] {
            assert_eq!(told, words);
        }
    }
}
