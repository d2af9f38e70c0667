//! Geometry at one instant: every facet of every body in world metres, and each body's hierarchy in its own
//! frame.

use crate::bodies::behind_array::BehindArray;
use crate::bodies::models::{BodyMesh, Models};
use crate::bodies::motion::{Motion, MovingPlane, RigidMotion};
use crate::bodies::separate_wheels::SeparateWheels;
use crate::geometry::antenna::Antenna;
use crate::geometry::bvh::Stack;
use crate::geometry::facet_geometry::FacetGeometry;
use crate::geometry::plane::Plane;
use crate::geometry::sweep::BeamSweep;
use crate::mesh::mesh_edges::Winding;
use crate::mesh::wedges::edge_band::{EdgeBand, PerBand};
use crate::mesh::wedges::world_edges::{BodyPlacement, WorldEdges};
use crate::run_control::error::BartError;
use crate::run_control::memory::MemoryLimit;
use crate::surface::bend::Bend;
use crate::surface::skin::Skin;
use crate::surface::skin_triangles::SkinTriangles;
use artifact::material::{Material, Road, Transmission};
use artifact::paths::Facet;
use artifact::scene::{Mesh, Pose, SceneFrame, SceneHeader, Target};
use artifact::settings::BetweenBodies;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Bodies posed at one instant. Facets are numbered through all bodies in the order of the targets.
pub struct World {
    facets: Vec<FacetGeometry>,
    bodies: Vec<Body>,
    /// Vehicle of each target.
    vehicles: Vec<u32>,
    /// Whether every body is a perfect conductor.
    is_conductor: bool,
    /// The road, if any: the second half of the bodies and facets are then images of the first.
    road: Option<Road>,
    /// Facets with transmission, ascending.
    sheets: Vec<u32>,
    /// Whether paths between bodies are traced.
    between_bodies: BetweenBodies,
    tolerance_m: f64,
    /// Memory limit of every tree.
    memory_limit: MemoryLimit,
    edges: PerBand<WorldEdges>,
}

impl World {
    /// World of all mesh targets of a frame towards which antennas have gain, `seconds_into_frame` after the
    /// frame's first sample.
    ///
    /// This builds the hierarchies of all meshes; for many frames a [`crate::Tracer`] builds them only once.
    pub fn at(header: &SceneHeader, frame: &SceneFrame, seconds_into_frame: f64) -> Result<Self, BartError> {
        let models = Models::build(header)?;
        let apart = SeparateWheels::of(&models, header, frame);
        Self::posed(&models, &apart.view, &apart.frame, seconds_into_frame)
    }

    /// Like [`World::at`], with models built before from the same header; rotating wheels are already
    /// separate bodies of the scene.
    pub(crate) fn posed(
        models: &Models,
        header: &SceneHeader,
        frame: &SceneFrame,
        seconds_into_frame: f64,
    ) -> Result<Self, BartError> {
        if frame.poses.len() != header.targets.len() {
            let (poses, targets) = (frame.poses.len(), header.targets.len());
            return Err(BartError::PosesDoNotMatch { frame: frame.index, poses, targets });
        }
        let vehicles = models.vehicles_of_wheels(header);
        let own = (0..).take(header.targets.len() - vehicles.len().min(header.targets.len()));
        let vehicles = own.chain(vehicles);
        let mut bodies = Vec::new();
        for ((index, vehicle), (target, pose)) in
            (0..).zip(vehicles).zip(header.targets.iter().zip(&frame.poses))
        {
            if let Some(model) = models.of(target)? {
                let body = Body::posed(index, model, pose, seconds_into_frame, &target.id)?;
                let body = Body { vehicle, ..body };
                if body.has_gain(header) {
                    bodies.push(body);
                }
            }
        }
        let world = Self::of_bodies(bodies, None)?.with_sheets(header.materials.transmission);
        let world = match &header.road {
            Some(road) => {
                world.check_above_road()?;
                world.over(road)?
            }
            None => world,
        };
        let limit = models.memory_limit.shared(world.bytes() as u64, 1);
        Ok(Self { between_bodies: header.fidelity.between_bodies, ..world.within(limit) })
    }

    /// World of a single mesh, with world axes equal to body axes; the target's index is 0.
    pub fn of_mesh(mesh: &Mesh) -> Result<Self, BartError> {
        Self::of_skin(mesh, Skin::Flat)
    }

    /// World of a single mesh with curved facets.
    pub fn of_skin(mesh: &Mesh, skin: Skin) -> Result<Self, BartError> {
        let body = Body::posed(0, Arc::new(BodyMesh::build(mesh, skin)?), &AT_ORIGIN, 0.0, &mesh.name)?;
        Ok(Self::of_bodies(vec![body], None)?.with_sheets(mesh.makeup.transmission))
    }

    /// Model of a single target in its own axes, like [`World::of_skin`] of its mesh.
    pub(crate) fn alone(
        model: Arc<BodyMesh>,
        target: &Target,
        transmission: Transmission,
    ) -> Result<Self, BartError> {
        let body = Body::posed(0, model, &AT_ORIGIN, 0.0, &target.id)?;
        Ok(Self::of_bodies(vec![body], None)?.with_sheets(transmission))
    }

    /// World of these bodies over a road, with their images below it.
    pub(crate) fn over(&self, road: &Road) -> Result<Self, BartError> {
        let images = self.bodies.iter().map(Body::below_road);
        let bodies = self.bodies.iter().cloned().chain(images).collect();
        Ok(Self { between_bodies: self.between_bodies, ..self.of_other_bodies(bodies, Some(road.clone()))? })
    }

    /// Refuses a body that lies completely below the road z = 0.
    pub(crate) fn check_above_road(&self) -> Result<(), BartError> {
        let below = self.facets.chunk_by(|a, b| a.id.body == b.id.body).find_map(|facets| {
            let heights_m = facets.iter().flat_map(|facet| facet.corners_m).map(|corner| corner.z);
            let highest_m = heights_m.fold(f64::NEG_INFINITY, f64::max);
            (highest_m < -self.tolerance_m).then_some((facets[0].id.body, highest_m))
        });
        below.map_or(Ok(()), |(target, highest_m)| {
            let body = self.bodies.iter().find(|body| body.target == target);
            let body = body.map_or(String::new(), |body| body.id.to_string());
            Err(BartError::BodyBelowRoad { body, highest_m })
        })
    }

    /// World of these bodies with paths between bodies traced.
    pub(crate) fn joined(&self) -> Result<Self, BartError> {
        self.of_other_bodies(self.bodies.clone(), self.road.clone())
    }

    /// World of other bodies, with this world's settings for sheets and memory.
    fn of_other_bodies(&self, bodies: Vec<Body>, road: Option<Road>) -> Result<Self, BartError> {
        let transmission =
            if self.sheets.is_empty() { Transmission::Ignored } else { Transmission::Followed };
        Ok(Self::of_bodies(bodies, road)?.with_sheets(transmission).within(self.memory_limit))
    }

    /// Whether paths over several bodies are left out.
    pub(crate) fn omits_inter_body_paths(&self) -> bool {
        let is_other = |body: &Body| body.vehicle != self.bodies[0].vehicle;
        self.between_bodies == BetweenBodies::LeftOut && self.bodies.iter().any(is_other)
    }

    /// Whether reflections from one facet to another are traced.
    pub(crate) fn is_followed(&self, from: &FacetGeometry, to: u32) -> bool {
        let (from, to) = (from.id.body, self.facet(to).id.body);
        self.between_bodies == BetweenBodies::Traced || from == to || self.vehicle(from) == self.vehicle(to)
    }

    /// Vehicle to which a wheel belongs; for other bodies the body itself.
    pub(crate) fn vehicle(&self, body: u32) -> u32 {
        self.vehicles.get(body as usize).copied().unwrap_or(body)
    }

    /// A facet by its index in [`World::facets`].
    pub fn facet(&self, index: u32) -> &FacetGeometry {
        &self.facets[index as usize]
    }

    /// All facets.
    pub fn facets(&self) -> &[FacetGeometry] {
        &self.facets
    }

    /// Whether everything is a perfect conductor.
    pub(crate) fn is_conductor(&self) -> bool {
        self.is_conductor
    }

    /// The road below which bodies have images, if any.
    pub(crate) fn road(&self) -> Option<&Road> {
        self.road.as_ref()
    }

    /// Whether a facet is an image below the road.
    pub(crate) fn is_image(&self, facet: u32) -> bool {
        facet as usize >= self.triangles()
    }

    /// Image of a facet below the road, or the facet of which it is the image; requires a road.
    pub(crate) fn image_of(&self, facet: u32) -> u32 {
        let half = self.triangles() as u32;
        if facet < half { facet + half } else { facet - half }
    }

    /// Number of facets without the images below the road.
    pub(crate) fn triangles(&self) -> usize {
        if self.road.is_some() { self.facets.len() / 2 } else { self.facets.len() }
    }

    /// Facets with transmission, ascending.
    pub(crate) fn sheets(&self) -> &[u32] {
        &self.sheets
    }

    /// Whether waves are transmitted through a facet.
    pub(crate) fn is_transparent(&self, facet: u32) -> bool {
        !self.sheets.is_empty() && self.sheets.binary_search(&facet).is_ok()
    }

    fn with_sheets(mut self, transmission: Transmission) -> Self {
        if transmission == Transmission::Followed && !self.is_conductor {
            let facets = 0..self.facets.len() as u32;
            let is_sheet =
                |&facet: &u32| self.lossy_material(facet).is_some_and(|material| material.is_sheet());
            self.sheets = facets.filter(is_sheet).collect();
        }
        self
    }

    /// Material of a facet; `None` for a perfect conductor.
    pub(crate) fn lossy_material(&self, facet: u32) -> Option<&Arc<Material>> {
        let body = self.body_of(facet).filter(|_| !self.is_conductor)?;
        body.mesh.material(facet - body.first_facet)
    }

    /// Whether the reflection of some body depends on frequency.
    pub(crate) fn is_dispersive(&self) -> bool {
        !self.is_conductor && self.bodies.iter().any(|body| body.mesh.has_layers())
    }

    /// Flat patch of a facet, identified by the patch's first facet.
    pub(crate) fn patch(&self, facet: u32) -> u32 {
        self.body_of(facet)
            .map_or(facet, |body| body.first_facet + body.mesh.patches.of_triangle(facet - body.first_facet))
    }

    /// Curvature of the surface that a facet belongs to, 1/m; 0 if it is flat.
    pub(crate) fn curvature_per_m(&self, facet: u32) -> f64 {
        self.body_of(facet).map_or(0.0, |body| body.mesh.patches.curvature_per_m(facet - body.first_facet))
    }

    /// Whether a patch continues beyond the facet's edge from corner `edge` to the next.
    pub(crate) fn is_inside_patch(&self, facet: u32, edge: usize) -> bool {
        self.body_of(facet).is_some_and(|body| body.mesh.patches.is_inside(facet - body.first_facet, edge))
    }

    /// Facet across the side from corner `side` to the next, and its winding; `None` if there is none or
    /// several.
    pub(crate) fn across(&self, facet: u32, side: usize) -> Option<(u32, Winding)> {
        let body = self.body_of(facet)?;
        let (triangle, winding) = body.mesh.neighbours.across(facet - body.first_facet, side)?;
        Some((body.first_facet + triangle, winding))
    }

    /// Motion of a point fixed to the body of a facet.
    pub(crate) fn motion(&self, facet: u32, at_m: DVec3) -> Motion {
        self.body_of(facet).map_or(Motion::REST, |body| body.motion.at(at_m))
    }

    /// Plane of a facet, and its motion.
    pub(crate) fn moving_plane(&self, facet: u32) -> MovingPlane {
        let body = self.body_of(facet).map_or(RigidMotion::REST, |body| body.motion);
        let mirror = self.facet(facet);
        MovingPlane { point_m: mirror.corners_m[0], normal: mirror.normal(), body }
    }

    /// Upper bound on the speed of all bodies' points except those of wheels, m/s.
    pub(crate) fn fastest_mps(&self) -> f64 {
        self.bodies.iter().filter(|body| !body.is_wheel()).map(Body::fastest_mps).fold(0.0, f64::max)
    }

    /// Maximum rate of rotation of all bodies except wheels, rad/s.
    pub(crate) fn fastest_turn_radps(&self) -> f64 {
        let bodies = self.bodies.iter().filter(|body| !body.is_wheel());
        bodies.map(|body| body.motion.turn_radps.z.abs()).fold(0.0, f64::max)
    }

    /// Maximum rate of rotation of all wheels, rad/s; 0 if none rotates.
    pub(crate) fn fastest_wheel_radps(&self) -> f64 {
        let wheels = self.bodies.iter().filter(|body| body.is_wheel());
        wheels.map(|wheel| wheel.motion.turn_radps.length()).fold(0.0, f64::max)
    }

    /// Speed of a wheel's facet around its hub, m/s; 0 if it belongs to no wheel.
    pub(crate) fn turning_mps(&self, facet: u32) -> f64 {
        let Some(body) = self.body_of(facet).filter(|body| body.is_wheel()) else { return 0.0 };
        let of_facet = body.motion.at(self.facet(facet).corners_m[0]);
        of_facet.velocity_mps.distance(body.motion.of_origin.velocity_mps)
    }

    /// Whether a body of this scene is a rotating wheel.
    pub(crate) fn is_wheel(&self, body: u32) -> bool {
        self.vehicle(body) != body
    }

    /// Distances below this are rounding, m: points this near to a plane count as on it.
    ///
    /// Rounding of a coordinate is ½ε of the largest, C; the plane through three rounded corners adds as much
    /// for each length of its triangle outside it, and a point constructed by a cut has it twice: 256 εC
    /// covers triangles seen from 60 of their own lengths away (3.4e-12 m at C = 60 m, far below the 3.9e-3 m
    /// of a wavelength).
    pub fn tolerance_m(&self) -> f64 {
        self.tolerance_m
    }

    /// Relative amplitude error to which facets approximate the skin; 0 if they are the surface.
    pub fn skin_error(&self) -> f64 {
        self.bodies.iter().map(|body| body.mesh.skin.error).fold(0.0, f64::max)
    }

    /// Skin over a facet; `None` if the facet is the surface.
    pub(crate) fn bend(&self, facet: u32) -> Option<Bend> {
        let body = self.body_of(facet)?;
        let heights_m = body.mesh.skin.heights_m.get((facet - body.first_facet) as usize)?;
        // Heights are along the normal by winding, which is reversed in the road's mirror.
        let up = if self.is_image(facet) { -1.0 } else { 1.0 };
        Bend::over(self.facet(facet), &heights_m.map(|h| up * h))
    }

    /// Root mean square area of the curved facets around this one, m²; 0 for a body without any.
    pub(crate) fn bent_area_m2(&self, facet: u32) -> f64 {
        self.body_of(facet).map_or(0.0, |body| body.mesh.skin.bent_area_m2)
    }

    /// Approximate memory, bytes.
    pub fn bytes(&self) -> usize {
        let models: usize = self.bodies.iter().map(|body| body.mesh.bytes()).sum();
        self.placed_bytes() + models
    }

    /// Memory of the posed facets, without the models shared by all moments of a frame, bytes.
    pub(crate) fn placed_bytes(&self) -> usize {
        self.facets.len() * size_of::<FacetGeometry>()
    }

    /// Edges that diffract at a wavenumber: those of its band.
    pub(crate) fn edges(&self, wavenumber_per_m: f64) -> &WorldEdges {
        self.edges_in(EdgeBand::of(wavenumber_per_m))
    }

    /// Edges that diffract in a band; computed when first requested, once per mesh. The band's middle decides
    /// which sides are thin, and which seams of rounded files are closed.
    pub(crate) fn edges_in(&self, band: EdgeBand) -> &WorldEdges {
        /// Distance negligible for any wave, in wavelengths: twice that path is a phase of 0.013.
        const UNTOLD_WAVELENGTHS: f64 = 1e-3;
        self.edges.get(band, &|| {
            let thin_m = 1.0 / band.middle_per_m();
            let negligible_m = UNTOLD_WAVELENGTHS * TAU * thin_m;
            let mut all = WorldEdges::for_facets(self.facets.len(), band);
            for body in &self.bodies {
                let place =
                    BodyPlacement { world_from_body: body.world_from_body, position_m: body.motion.origin_m };
                all.add(body.mesh.edges(band, negligible_m), &place, body.first_facet, thin_m);
            }
            all
        })
    }

    /// This world with a limit on the memory of one tree and its joints.
    pub fn within(self, limit: MemoryLimit) -> Self {
        Self { memory_limit: limit, ..self }
    }

    /// Limit on the memory of one tree and its joints.
    pub(crate) fn memory_limit(&self) -> MemoryLimit {
        self.memory_limit
    }

    /// Calls `visit` with every facet that may reach the positive side of all `planes` (world) and the region
    /// that a wave lights behind an `opening`, body by body and roughly from the far end of `nearer` on,
    /// until it breaks. It only proposes candidates.
    pub(crate) fn visit_inside(
        &self,
        planes: impl Iterator<Item = Plane>,
        opening: Option<(Antenna, &[DVec3])>,
        nearer: DVec3,
        walk: &mut VisitBuffers,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        walk.planes.clear();
        walk.planes.extend(planes);
        self.bodies.iter().try_for_each(|body| {
            walk.planes_in_body.clear();
            walk.planes_in_body
                .extend(walk.planes.iter().map(|plane| body.plane_in_body(plane, self.tolerance_m)));
            let body_from_world = body.world_from_body.transpose();
            let sweep = opening.map(|(antenna, opening_m)| {
                BeamSweep::behind(
                    opening_m,
                    antenna,
                    &body_from_world,
                    body.motion.origin_m,
                    self.tolerance_m,
                )
            });
            let nearer = body_from_world * nearer;
            let of_body = |triangle: u32| visit(body.first_facet + triangle);
            body.mesh.hierarchy.inside(&walk.planes_in_body, sweep.as_ref(), nearer, &mut walk.stack, of_body)
        })
    }

    /// Name of a facet's body: the target's id, or the name of a single mesh.
    pub(crate) fn id_of_body(&self, facet: u32) -> &str {
        self.body_of(facet).map_or("", |body| &body.id)
    }

    /// Whether any facets have transmission.
    pub(crate) fn has_sheets(&self) -> bool {
        !self.sheets.is_empty()
    }

    fn body_of(&self, facet: u32) -> Option<&Body> {
        let after = self.bodies.partition_point(|body| body.first_facet <= facet);
        after.checked_sub(1).map(|body| &self.bodies[body])
    }

    fn of_bodies(mut bodies: Vec<Body>, road: Option<Road>) -> Result<Self, BartError> {
        let mut facets: Vec<FacetGeometry> = Vec::new();
        for body in &mut bodies {
            let triangles = facets.len() + body.mesh.skin.triangles_m.len();
            let most = u32::MAX as usize;
            body.first_facet =
                u32::try_from(facets.len()).map_err(|_| BartError::TooManyTriangles { triangles, most })?;
            if triangles > most {
                return Err(BartError::TooManyTriangles { triangles, most });
            }
            facets.par_extend(body.facets());
        }
        let largest = facets.iter().flat_map(|f| f.corners_m).fold(0.0, |m, c| c.abs().max_element().max(m));
        let tolerance_m = 256.0 * f64::EPSILON * largest;
        facets.par_iter_mut().for_each(|facet| facet.refuse_if_thinner_than(4.0 * tolerance_m));
        let is_conductor = road.is_none() && bodies.iter().all(|body| body.mesh.materials.is_empty());
        let memory_limit = MemoryLimit::NONE;
        let targets = bodies.iter().map(|body| body.target + 1).max().unwrap_or(0);
        let mut vehicles: Vec<u32> = (0..targets).collect();
        bodies.iter().for_each(|body| vehicles[body.target as usize] = body.vehicle);
        Ok(Self {
            facets,
            bodies,
            vehicles,
            is_conductor,
            road,
            sheets: Vec::new(),
            between_bodies: BetweenBodies::Traced,
            tolerance_m,
            memory_limit,
            edges: PerBand::new(),
        })
    }
}

/// Buffers of [`World::visit_inside`].
#[derive(Default)]
pub(crate) struct VisitBuffers {
    planes: Vec<Plane>,
    planes_in_body: Vec<Plane>,
    stack: Stack,
}

const AT_ORIGIN: Pose = Pose {
    position_m: [0.0; 3],
    yaw_rad: 0.0,
    yaw_radps: 0.0,
    velocity_mps: [0.0; 3],
    acceleration_mps2: [0.0; 3],
};

/// A posed mesh.
#[derive(Clone)]
struct Body {
    target: u32,
    /// Target to which a wheel belongs; itself for other bodies.
    vehicle: u32,
    id: Arc<str>,
    mesh: Arc<BodyMesh>,
    world_from_body: DMat3,
    motion: RigidMotion,
    first_facet: u32,
}

impl Body {
    fn posed(
        target: u32,
        mesh: Arc<BodyMesh>,
        pose: &Pose,
        seconds: f64,
        id: &str,
    ) -> Result<Self, BartError> {
        let motion = RigidMotion::of(pose, seconds);
        let yaw_rad = pose.yaw_rad + pose.yaw_radps * seconds;
        if !(motion.is_finite() && yaw_rad.is_finite()) {
            return Err(BartError::PoseNotFinite { target: id.to_owned() });
        }
        let world_from_body = DMat3::from_rotation_z(yaw_rad);
        let body =
            Self { target, vehicle: target, id: id.into(), mesh, world_from_body, motion, first_facet: 0 };
        Ok(body.rolled(pose))
    }

    /// A wheel rotated by the distance rolled from the world's origin, in a frame that starts at a pose;
    /// other bodies are unchanged.
    fn rolled(self, pose: &Pose) -> Self {
        let Some(radius_m) = self.mesh.rolls_on_m else { return self };
        let ahead = self.world_from_body * DVec3::X;
        // In a bend the distance to the frame's start differs, but cannot be known from the frame.
        let start_m = DVec3::from_array(pose.position_m);
        let way_m = start_m.dot(DMat3::from_rotation_z(pose.yaw_rad) * DVec3::X)
            + (self.motion.origin_m - start_m).dot(ahead);
        let rolled_rad = (way_m / radius_m).rem_euclid(TAU);
        let motion = self.motion.rolling(self.world_from_body * DVec3::Y, radius_m);
        let world_from_body = self.world_from_body * DMat3::from_rotation_y(rolled_rad);
        Self { motion, world_from_body, ..self }
    }

    fn is_wheel(&self) -> bool {
        self.mesh.rolls_on_m.is_some()
    }

    /// Upper bound on the speed of its points: that of its origin, plus that of rotation at its reach.
    fn fastest_mps(&self) -> f64 {
        let speed_mps = self.motion.of_origin.velocity_mps.length();
        if self.motion.turn_radps == DVec3::ZERO {
            return speed_mps;
        }
        let reach =
            |corner: &DVec3| if self.is_wheel() { corner.length() } else { corner.truncate().length() };
        let reach_m = self.mesh.skin.triangles_m.iter().flatten().map(reach).fold(0.0, f64::max);
        speed_mps + self.motion.turn_radps.length() * reach_m
    }

    /// Whether antennas have gain towards any part of it, or of its image below the road, during a frame.
    fn has_gain(&self, header: &SceneHeader) -> bool {
        let speed_mps = self.fastest_mps()
            + self.motion.of_origin.acceleration_mps2.length() * header.radar.frame_duration_s();
        let Some(behind) = BehindArray::of(&header.radar, speed_mps) else { return true };
        let is_on = |body: &Self| {
            let corners = body.mesh.skin.triangles_m.iter().flatten();
            behind.holds(corners.map(|corner| body.motion.origin_m + body.world_from_body * *corner))
        };
        !is_on(self) || (header.road.is_some() && !is_on(&self.below_road()))
    }

    /// Image of the body in the plane z = 0, with windings reversed.
    fn below_road(&self) -> Self {
        Self {
            target: self.target,
            vehicle: self.vehicle,
            id: Arc::clone(&self.id),
            mesh: Arc::clone(&self.mesh),
            world_from_body: DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0)) * self.world_from_body,
            motion: self.motion.below_road(),
            first_facet: 0,
        }
    }

    fn facets(&self) -> impl IndexedParallelIterator<Item = FacetGeometry> {
        let SkinTriangles { triangles_m, triangle_of, .. } = &self.mesh.skin;
        triangles_m.par_iter().zip(triangle_of).map(|(corners_m, &triangle)| {
            let corners_m = corners_m.map(|corner| self.motion.origin_m + self.world_from_body * corner);
            FacetGeometry::of_triangle(corners_m, Facet { body: self.target, triangle })
        })
    }

    /// A world plane in this body's frame, moved back by `slack_m` to allow for rounding.
    fn plane_in_body(&self, plane: &Plane, slack_m: f64) -> Plane {
        let normal = self.world_from_body.transpose() * plane.normal;
        Plane { normal, offset_m: plane.offset_m - plane.normal.dot(self.motion.origin_m) - slack_m }
    }
}
