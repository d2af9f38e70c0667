//! Bodies and beams of one moment of a frame.

use crate::beams::beam::BeamTree;
use crate::beams::body_ways::BodyWays;
use crate::beams::image_tree::Received;
use crate::bodies::models::Models;
use crate::bodies::stand_off::check_stand;
use crate::bodies::world::World;
use crate::frame::path_plan::Plan;
use crate::geometry::antenna::Antenna;
use crate::joins::joint::Trees;
use crate::joins::scatterer::{Scatterer, ZenithH};
use crate::oversight::error::BartError;
use crate::oversight::progress::Phase;
use artifact::scene::SceneFrame;
use glam::DVec3;

/// Scene that a frame is traced from.
pub(crate) struct Scenery<'a> {
    pub(crate) models: &'a Models,
    pub(crate) frame: &'a SceneFrame,
    pub(crate) plan: &'a Plan<'a>,
}

/// Bodies and beams of one moment and place.
pub(crate) struct Snapshot {
    pub(crate) world: World,
    pub(crate) tree: BeamTree,
    /// Beams of the antenna with those of its image, where there is a road.
    received: Option<Received>,
}

impl Scenery<'_> {
    /// Everything, some `seconds` after the frame's first sample.
    pub(crate) fn at(&self, seconds: f64, place_m: DVec3) -> Result<Snapshot, BartError> {
        let (world, plan) = (self.world(seconds)?, self.plan);
        let (antenna, wavelength_m) = (Antenna::Point(place_m), plan.band.wavelength_m());
        let tree = BeamTree::trace_from_outside(&world, antenna, wavelength_m, &plan.trace, plan.progress)?;
        Ok(Snapshot::of(world, tree))
    }

    /// Bodies and beams of some ways alone, some `seconds` after the frame's first sample.
    pub(crate) fn along(&self, ways: &BodyWays, seconds: f64, place_m: DVec3) -> Result<Snapshot, BartError> {
        let (world, plan) = (self.world(seconds)?, self.plan);
        let antenna = Antenna::Point(place_m);
        check_stand(&world, antenna, plan.band.wavelength_m())?;
        let tree = BeamTree::trace_along(&world, antenna, &plan.trace, ways, plan.progress)?;
        Ok(Snapshot::of(world, tree))
    }

    /// Whether some body is a wheel that turns.
    pub(crate) fn turns_wheels(&self) -> bool {
        !self.models.vehicles_of_wheels(self.plan.header).is_empty()
    }

    fn world(&self, seconds: f64) -> Result<World, BartError> {
        self.plan.progress.at(Phase::Building, 0, 0);
        World::posed(self.models, self.plan.header, self.frame, seconds)
    }
}

impl Snapshot {
    /// Beams of a world.
    pub(crate) fn of(world: World, tree: BeamTree) -> Self {
        let received = world.road().map(|_| Received::with_image(&world, &tree));
        Self { world, tree, received }
    }

    pub(crate) fn scatterer<'s>(&'s self, plan: &Plan<'s>, phase: Phase) -> Scatterer<'s> {
        let h = plan.zenith_h();
        let trees = self
            .received
            .as_ref()
            .map_or(Trees::Shared(&self.tree), |received| Trees::ByRoad(&self.tree, received));
        Scatterer::new(&self.world, trees, ZenithH { transmit: h, receive: h }).heard_by(phase, plan.progress)
    }

    pub(crate) fn bytes(&self) -> u64 {
        (self.world.bytes() + self.tree.bytes() + self.received.as_ref().map_or(0, Received::bytes)) as u64
    }
}
