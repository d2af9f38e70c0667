//! Objects that belong to no body, false or at rest, and what made each of them in truth.

use crate::chain::frame_result::FrameResult;
use artifact::points::{Label, Object};
use artifact::scene::{Role, SceneHeader};
use artifact::units::power_from_db;
use evaluation::{FrameTruth, GATE_M, Origin, place};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// What made an object that is no body's.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Cause {
    /// A way over several bodies, or one over several facets of a body that has its object elsewhere.
    Ghost {
        bodies: BTreeSet<u32>,
        bounces: u8,
    },
    /// Another object of a body that has one.
    Split {
        body: u32,
        bounces: u8,
    },
    /// The echo of a body that has no object, seen further from it than the gate.
    Misplaced {
        body: u32,
        bounces: u8,
    },
    /// What stands about, or with no body the road's own backscatter.
    Clutter {
        body: Option<u32>,
        bounces: Option<u8>,
    },
    Noise,
    /// Echoes of tables have no paths to tell by.
    Unknown,
}

impl Cause {
    fn name(&self) -> &'static str {
        match self {
            Self::Ghost { .. } => "ghost",
            Self::Split { .. } => "split",
            Self::Misplaced { .. } => "misplaced",
            Self::Clutter { .. } => "clutter",
            Self::Noise => "noise",
            Self::Unknown => "unknown",
        }
    }

    fn bodies(&self) -> Vec<u32> {
        match self {
            Self::Ghost { bodies, .. } => bodies.iter().copied().collect(),
            Self::Split { body, .. } | Self::Misplaced { body, .. } => vec![*body],
            Self::Clutter { body, .. } => body.iter().copied().collect(),
            Self::Noise | Self::Unknown => vec![],
        }
    }

    fn bounces(&self) -> Option<u8> {
        match self {
            Self::Ghost { bounces, .. } | Self::Split { bounces, .. } | Self::Misplaced { bounces, .. } => {
                Some(*bounces)
            }
            Self::Clutter { bounces, .. } => *bounces,
            Self::Noise | Self::Unknown => None,
        }
    }
}

/// `false_objects` of a frame of `summary.json`: nobody's, and not told to be at rest.
pub(crate) fn told(header: &SceneHeader, result: &FrameResult, truth: &FrameTruth) -> Value {
    let is_false =
        |index: &usize| truth.pairing.body_of(*index).is_none() && !truth.pairing.standing.contains(index);
    all_json(header, result, truth, (0..result.points.objects.len()).filter(is_false))
}

/// `stationary_objects`: nobody's as well, and told to be at rest.
pub(crate) fn standing(header: &SceneHeader, result: &FrameResult, truth: &FrameTruth) -> Value {
    all_json(header, result, truth, truth.pairing.standing.iter().copied())
}

fn all_json(
    header: &SceneHeader,
    result: &FrameResult,
    truth: &FrameTruth,
    objects: impl Iterator<Item = usize>,
) -> Value {
    let json = |index: usize| {
        object_json(header, index, &result.points.objects[index], &cause(header, result, truth, index))
    };
    objects.map(json).collect()
}

fn object_json(header: &SceneHeader, index: usize, object: &Object, cause: &Cause) -> Value {
    let id = |body: &u32| header.targets.get(*body as usize).map(|target| target.id.as_str());
    json!({
        "object": index,
        "x_m": object.position_m[0],
        "y_m": object.position_m[1],
        "range_m": object.range_m,
        "radial_velocity_mps": object.radial_velocity_mps,
        "snr_db": object.snr_db,
        "ghost_share": object.ghost_share,
        "cause": cause.name(),
        "bodies": cause.bodies().iter().filter_map(id).collect::<Vec<_>>(),
        "bounces": cause.bounces(),
    })
}

/// What most of the power of the object's points comes from.
fn cause(header: &SceneHeader, result: &FrameResult, truth: &FrameTruth, index: usize) -> Cause {
    let mut powers: BTreeMap<Cause, f64> = BTreeMap::new();
    let points = result.points.points.iter().zip(&truth.origins);
    for (point, origin) in points.filter(|(point, _)| point.object == Some(index as u32)) {
        let cause = of_point(header, truth, &result.points.objects[index], origin);
        *powers.entry(cause).or_default() += power_from_db(point.snr_db);
    }
    let strongest = powers.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
    strongest.map_or(Cause::Unknown, |(cause, _)| cause)
}

fn of_point(header: &SceneHeader, truth: &FrameTruth, object: &Object, origin: &Origin) -> Cause {
    let (label, bodies) = match origin {
        Origin::Noise => return Cause::Noise,
        Origin::Ground => return Cause::Clutter { body: None, bounces: None },
        Origin::Echo { label, bodies } => (label, bodies),
    };
    let (body, bounces) = (label.target, label.order);
    let is_clutter = header.targets.get(body as usize).is_some_and(|target| target.role == Role::Clutter);
    match bodies.len() {
        0 | 1 if is_clutter => Cause::Clutter { body: Some(body), bounces: Some(bounces) },
        0 | 1 => of_one_body(truth, object, label),
        _ => Cause::Ghost { bodies: bodies.clone(), bounces },
    }
}

/// An echo of one target alone, in an object that is not the target's.
fn of_one_body(truth: &FrameTruth, object: &Object, label: &Label) -> Cause {
    let (body, bounces) = (label.target, label.order);
    let has_object = truth.pairing.object_of.get(body as usize).is_some_and(Option::is_some);
    let is_there =
        truth.truths.get(body as usize).is_some_and(|t| t.outline.distance_m(place(object)) <= GATE_M);
    match (has_object, is_there) {
        (true, false) if bounces > 1 => Cause::Ghost { bodies: BTreeSet::from([body]), bounces },
        (true, _) => Cause::Split { body, bounces },
        (false, _) => Cause::Misplaced { body, bounces },
    }
}
