//! Bodies and beams at one moment of a frame.

pub(crate) mod nearest_surface; // nearest lit point of a body
pub(crate) mod sliding_outlines; // how fast outlines slide over their bodies

use crate::beams::beam::BeamTree;
use crate::beams::body_sequences::BodySequences;
use crate::beams::image_tree::RoadTree;
use crate::bodies::models::Models;
use crate::bodies::stand_off::check_antenna_position;
use crate::bodies::world::World;
use crate::frame::blends::axis::BlendAxis;
use crate::frame::path_plan::Plan;
use crate::geometry::antenna::Antenna;
use crate::joins::joint::Trees;
use crate::joins::scatterer::{Scatterer, ZenithH};
use crate::run_control::error::BartError;
use crate::run_control::memory::with_joints;
use crate::run_control::progress::Phase;
use artifact::scene::{Pose, SceneFrame};
use glam::DVec3;

/// Scene from which a frame is traced.
#[derive(Clone, Copy)]
pub(crate) struct TracedScene<'a> {
    pub(crate) models: &'a Models,
    pub(crate) frame: &'a SceneFrame,
    pub(crate) plan: &'a Plan<'a>,
    /// Memory of other moments and of paths held while one is traced, bytes.
    pub(crate) held_bytes: u64,
}

/// Another moment of the frame, or another position on the array.
#[derive(Clone, Copy)]
pub(crate) struct BlendNode<'a> {
    /// Sequences of bodies to trace; all of them if none are named.
    pub(crate) ways: Option<&'a BodySequences>,
    /// Time after the frame's first sample, s.
    pub(crate) seconds: f64,
    /// Positions of the transmitter and the receiver.
    pub(crate) ends_m: [DVec3; 2],
}

/// Bodies and beams at one moment and position.
pub(crate) struct Snapshot {
    pub(crate) world: World,
    pub(crate) tree: BeamTree,
    arriving: ReceiverBeams,
}

/// Beams of the receiver.
enum ReceiverBeams {
    /// Beams of the transmitter, which is at the same place.
    AsSent,
    /// Beams of the transmitter and of its image below the road.
    WithImage(RoadTree),
    /// Separate beams, at another place; over a road with those of its image.
    Apart(BeamTree),
}

impl TracedScene<'_> {
    /// All bodies and beams some `seconds` after the frame's first sample, from a transmitter to a receiver.
    pub(crate) fn at(&self, seconds: f64, ends_m: [DVec3; 2]) -> Result<Snapshot, BartError> {
        let (world, plan) = (self.world(seconds)?, self.plan);
        let wavelength_m = plan.band.wavelength_m();
        let traced = |place_m: DVec3| {
            let antenna = Antenna::Point(place_m);
            BeamTree::trace_from_outside(&world, antenna, wavelength_m, &plan.trace, plan.progress)
        };
        let (tree, apart) = of_ends(ends_m, traced)?;
        Ok(Snapshot::with_trees(world, tree, apart))
    }

    /// Bodies and beams of some sequences alone, some `seconds` after the frame's first sample.
    fn along(&self, ways: &BodySequences, seconds: f64, ends_m: [DVec3; 2]) -> Result<Snapshot, BartError> {
        let (world, plan) = (self.world(seconds)?, self.plan);
        let traced = |place_m: DVec3| {
            let antenna = Antenna::Point(place_m);
            check_antenna_position(&world, antenna, plan.band.wavelength_m())?;
            BeamTree::trace_sequences(&world, antenna, &plan.trace, ways, plan.progress)
        };
        let (tree, apart) = of_ends(ends_m, traced)?;
        Ok(Snapshot::with_trees(world, tree, apart))
    }

    /// Bodies and beams at a node.
    pub(crate) fn at_node(&self, node: &BlendNode<'_>) -> Result<Snapshot, BartError> {
        match node.ways {
            Some(ways) => self.along(ways, node.seconds, node.ends_m),
            None => self.at(node.seconds, node.ends_m),
        }
    }

    /// The same scene with more bytes held.
    pub(crate) fn with_held_bytes(&self, bytes: u64) -> Self {
        Self { held_bytes: self.held_bytes + bytes, ..*self }
    }

    /// Whether some body is a rotating wheel.
    pub(crate) fn turns_wheels(&self) -> bool {
        !self.models.vehicles_of_wheels(self.plan.header).is_empty()
    }

    /// Whether anything of the frame changes along an axis.
    pub(crate) fn changes_along(&self, axis: BlendAxis) -> bool {
        match axis {
            BlendAxis::Time => self.turns_wheels() || self.frame.poses.iter().any(moves),
            BlendAxis::Array => self.plan.row.half_m > 0.0,
        }
    }

    fn world(&self, seconds: f64) -> Result<World, BartError> {
        self.plan.progress.at(Phase::Building, 0, 0);
        let world = World::posed(self.models, self.plan.header, self.frame, seconds)?;
        let limit = world.memory_limit().shared(self.held_bytes, 1);
        Ok(world.within(limit))
    }
}

/// Beams of the transmitter, and those of the receiver if it is elsewhere.
fn of_ends(
    [tx_m, rx_m]: [DVec3; 2],
    traced: impl Fn(DVec3) -> Result<BeamTree, BartError>,
) -> Result<(BeamTree, Option<BeamTree>), BartError> {
    let apart = if tx_m == rx_m { None } else { Some(traced(rx_m)?) };
    Ok((traced(tx_m)?, apart))
}

fn moves(pose: &Pose) -> bool {
    let still = [0.0; 3];
    pose.velocity_mps != still || pose.acceleration_mps2 != still || pose.yaw_radps != 0.0
}

impl Snapshot {
    /// Beams of a world with transmitter and receiver at one place.
    pub(crate) fn of(world: World, tree: BeamTree) -> Self {
        Self::with_trees(world, tree, None)
    }

    /// Beams of a world, and those of a receiver at another place than the transmitter.
    fn with_trees(world: World, tree: BeamTree, apart: Option<BeamTree>) -> Self {
        let is_over_road = world.road().is_some();
        let arriving = match apart {
            None if is_over_road => ReceiverBeams::WithImage(RoadTree::with_image(&world, &tree)),
            None => ReceiverBeams::AsSent,
            Some(apart) if is_over_road => ReceiverBeams::Apart(RoadTree::with_image(&world, &apart).tree),
            Some(apart) => ReceiverBeams::Apart(apart),
        };
        Self { world, tree, arriving }
    }

    pub(crate) fn scatterer<'s>(&'s self, plan: &'s Plan<'s>, phase: Phase) -> Scatterer<'s> {
        let h = plan.zenith_h();
        let zenith_h = ZenithH { transmit: h, receive: h };
        Scatterer::new(&self.world, self.trees(), zenith_h)
            .with_progress(phase, plan.progress)
            .with_gains(&plan.gains)
    }

    fn trees(&self) -> Trees<'_> {
        match &self.arriving {
            ReceiverBeams::AsSent => Trees::Shared(&self.tree),
            ReceiverBeams::WithImage(received) => Trees::ByRoad(&self.tree, received),
            ReceiverBeams::Apart(apart) => Trees::Apart(&self.tree, apart),
        }
    }

    pub(crate) fn bytes(&self) -> u64 {
        (self.world.bytes() + self.trees().bytes()) as u64
    }

    /// Memory held in addition to another moment of the same models, including joints, bytes.
    pub(crate) fn bytes_beside(&self) -> u64 {
        self.world.placed_bytes() as u64 + with_joints(self.trees().bytes())
    }
}
