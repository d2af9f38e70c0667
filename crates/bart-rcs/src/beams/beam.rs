//! Beam trees: the facets lit by an antenna, and those lit by them as mirrors.
//!
//! A beam is a convex lit polygon on a facet, seen along straight lines from the antenna's image behind the
//! preceding facets. Frequency and polarization enter later, in the integration.

use crate::beams::body_sequences::BodySequences;
use crate::beams::brute_force::BruteForceVisibility;
use crate::beams::occlusion::lit_parts::{LitPart, LitParts};
use crate::beams::occlusion::view::{Mirror, View};
use crate::beams::sheets::split_at_sheets;
use crate::beams::visibility::{Buffers, BvhVisibility, Visibility};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::geometry::border::BorderLine;
use crate::geometry::plane::Plane;
use crate::run_control::error::BartError;
use crate::run_control::memory::BYTES_PER_SHEET;
use crate::run_control::progress::{NoProgress, Phase, Progress};
use artifact::settings::Sides;
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Settings of a beam tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceSettings {
    /// Maximum number of facets in a beam's sequence; 1 is what the antenna lights directly.
    pub max_order: u8,
    /// Sides of a facet that scatter.
    pub sides: Sides,
    /// Area across the wave (area·cosθ) below which beams are dropped, and counted in [`Audit`]; m².
    ///
    /// A beam scatters at most |S| = √(4π)/λ · area·cosθ · R²/(L₁L₂), so a bound on S over the expected
    /// number of dropped beams gives this bound. Physics §2 has λ²/100 · accuracy.
    pub least_area_m2: f64,
    /// Area across the wave below which beams are kept but not reflected further; m², at least
    /// `least_area_m2`.
    pub least_mirror_area_m2: f64,
}

/// A convex lit polygon at the end of a sequence of mirrors.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// Index of the beam that was reflected into this one; `None` at order 1.
    pub parent: Option<u32>,
    /// Number of facets in the sequence, this one included.
    pub order: u8,
    /// Index into [`World::facets`].
    pub facet: u32,
    /// Unit normal of the facet on the lit side.
    pub lit_normal: DVec3,
    /// Image of the antenna in the preceding facets, from which straight lines lead to `facet`.
    pub image: Antenna,
    /// Area of the polygon across the wave, area·cosθ at its centre, m².
    pub across_m2: f64,
    /// Solid angle from the image, sr, or area across the direction, m².
    pub section: f64,
    /// Sheets passed by the wave since the preceding mirror, in its order: indices into [`World::facets`].
    pub sheets: Vec<u32>,
    /// Range of the corners in the tree's vertices.
    pub(crate) polygon: Range<u32>,
}

/// All beams of one antenna.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamTree {
    /// Antenna from which the tree was traced.
    pub antenna: Antenna,
    /// Beams, parents before children; sorted by order, parent, facet and piece.
    pub beams: Vec<Beam>,
    /// Corners of all polygons, world metres.
    pub(crate) vertices_m: Vec<DVec3>,
    /// Border of a polygon from each vertex to the next: what ends the polygon there.
    pub(crate) borders: Vec<BorderLine>,
    /// Total number of sheets passed on the paths of all beams.
    pub(crate) passed: usize,
    /// Power kept, dropped and lost.
    pub audit: Audit,
}

/// Power of a tree by order (index 0 is order 1): kept, dropped and lost.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Audit {
    /// Audit of each order traced.
    pub orders: Vec<OrderAudit>,
}

/// Power of one order: kept, dropped and lost.
///
/// "Section" is the part of an antenna's wave front intercepted by a polygon: the solid angle at a finite
/// range, sr, or the area across the direction, m². A mirror preserves it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OrderAudit {
    /// Number of beams kept.
    pub beams: u64,
    /// Area of the kept polygons, m².
    pub lit_area_m2: f64,
    /// Sum of [`Beam::section`] over the beams kept: sr for an antenna at a finite range, m² for one
    /// infinitely far away, like all sections here.
    pub lit_section: f64,
    /// Section of the preceding order's reflected beams; at order 1 the section kept and dropped.
    pub incident_section: f64,
    /// Section that met no facet, or another body if paths between bodies are left out: incident − lit −
    /// dropped; 0 at order 1.
    pub escaped_section: f64,
    /// Number of polygons dropped for their size.
    pub dropped: u64,
    /// Area of the dropped polygons, m².
    pub dropped_area_m2: f64,
    /// Area across the wave of the dropped polygons, Σ area·cosθ, m²: |S| dropped ≤ √(4π)/λ · this ·
    /// R²/(L₁L₂).
    pub dropped_across_m2: f64,
    /// Sum of the squares of these areas, m⁴: with independent phases the square of the scattered amplitude
    /// is proportional to it.
    pub dropped_across_squared_m4: f64,
    /// Section of the dropped polygons.
    pub dropped_section: f64,
    /// Number of beams of this order kept but too small to be reflected further.
    pub unreflected: u64,
    /// Area across the wave of the beams that are not reflected further, m².
    pub unreflected_across_m2: f64,
    /// Sum of the squares of these areas, m⁴.
    pub unreflected_across_squared_m4: f64,
    /// Sum of the fourth powers of these areas, m⁸.
    pub(crate) unreflected_across_fourth_m8: f64,
}

impl BeamTree {
    /// Traces everything lit by `antenna`, up to `settings.max_order`.
    pub fn trace(world: &World, antenna: Antenna, settings: &TraceSettings) -> Result<Self, BartError> {
        Self::trace_with_progress(world, antenna, settings, &NoProgress)
    }

    /// Traces like [`BeamTree::trace`], and reports to `progress`.
    pub(crate) fn trace_with_progress(
        world: &World,
        antenna: Antenna,
        settings: &TraceSettings,
        progress: &dyn Progress,
    ) -> Result<Self, BartError> {
        trace_by::<BvhVisibility>(world, Growth::new(antenna, settings, progress))
    }

    /// Traces only the given sequences of bodies; others are not followed beyond their first facet. For the
    /// given ones the tree is complete.
    pub(crate) fn trace_sequences(
        world: &World,
        antenna: Antenna,
        settings: &TraceSettings,
        ways: &BodySequences,
        progress: &dyn Progress,
    ) -> Result<Self, BartError> {
        trace_by::<BvhVisibility>(
            world,
            Growth { ways: Some(ways), ..Growth::new(antenna, settings, progress) },
        )
    }

    /// Traces by the slow, obvious method, clipping every facet against every other. For tests.
    pub fn trace_by_brute_force(
        world: &World,
        antenna: Antenna,
        settings: &TraceSettings,
    ) -> Result<Self, BartError> {
        trace_by::<BruteForceVisibility>(world, Growth::new(antenna, settings, &NoProgress))
    }

    /// Lit polygon: convex, counter-clockwise about the lit normal, world metres.
    pub fn polygon(&self, beam: &Beam) -> &[DVec3] {
        &self.vertices_m[beam.polygon.start as usize..beam.polygon.end as usize]
    }

    /// Borders of the lit polygon from each of its corners to the next.
    pub(crate) fn borders(&self, beam: &Beam) -> &[BorderLine] {
        &self.borders[beam.polygon.start as usize..beam.polygon.end as usize]
    }

    /// Facets from the antenna to this beam, its own last, as indices into [`World::facets`].
    pub fn sequence(&self, beam: &Beam) -> Vec<u32> {
        let mut facets: Vec<u32> = self.mirror_chain(beam).map(|b| b.facet).collect();
        facets.reverse();
        facets
    }

    /// Bodies from the antenna to this beam, its own last.
    pub(crate) fn bodies(&self, world: &World, beam: &Beam) -> Vec<u32> {
        let mut bodies: Vec<u32> = self.mirror_chain(beam).map(|b| world.facet(b.facet).id.body).collect();
        bodies.reverse();
        bodies
    }

    /// A beam, that of its mirror, and so on back to the antenna.
    pub(crate) fn mirror_chain<'a>(&'a self, beam: &'a Beam) -> impl Iterator<Item = &'a Beam> {
        std::iter::successors(Some(beam), |b| b.parent.map(|parent| &self.beams[parent as usize]))
    }

    /// Approximate memory, bytes.
    pub fn bytes(&self) -> usize {
        self.beams.len() * size_of::<Beam>()
            + self.vertices_m.len() * (size_of::<DVec3>() + size_of::<BorderLine>())
            + self.passed * BYTES_PER_SHEET
    }

    /// Number of sheets on the path of a beam.
    pub(crate) fn passed(&self, beam: &Beam) -> usize {
        self.mirror_chain(beam).map(|of_way| of_way.sheets.len()).sum()
    }
}

fn trace_by<V: Visibility>(world: &World, mut growth: Growth<'_>) -> Result<BeamTree, BartError> {
    if !growth.tree.antenna.is_sound() {
        return Err(BartError::AntennaNotFinite);
    }
    grow_to::<V>(world, growth.settings.max_order, &mut growth)?;
    Ok(growth.tree)
}

/// A tree that is grown as its orders are needed.
pub(crate) struct GrowingTree<'a> {
    world: &'a World,
    growth: Growth<'a>,
}

impl<'a> GrowingTree<'a> {
    /// A tree without any order yet.
    pub(crate) fn new(
        world: &'a World,
        antenna: Antenna,
        settings: &'a TraceSettings,
        progress: &'a dyn Progress,
    ) -> Result<Self, BartError> {
        if antenna.is_sound() {
            Ok(Self { world, growth: Growth::new(antenna, settings, progress) })
        } else {
            Err(BartError::AntennaNotFinite)
        }
    }

    /// Traces up to an order, which must not exceed that of the settings.
    pub(crate) fn grow_to(&mut self, order: u8) -> Result<(), BartError> {
        grow_to::<BvhVisibility>(self.world, order.min(self.growth.settings.max_order), &mut self.growth)
    }

    pub(crate) fn tree(&self) -> &BeamTree {
        &self.growth.tree
    }
}

fn grow_to<V: Visibility>(world: &World, order: u8, growth: &mut Growth<'_>) -> Result<(), BartError> {
    let done = growth.tree.audit.orders.len() as u8;
    if done == 0 && order > 0 {
        let antenna = growth.tree.antenna;
        growth.begin_order(world);
        growth.progress.at(Phase::Tracing, 0, 0);
        let view = View::direct(world, growth.settings.sides, antenna);
        let seen: Vec<LitParts> =
            V::direct(&view).into_par_iter().map(|parts| split_at_sheets(&view, parts)).collect();
        for parts in seen {
            growth.take(None, antenna, 1, parts)?;
        }
        growth.check_memory(world, 1)?;
        growth.end_order(None);
    }
    (done.max(1) + 1..=order).try_for_each(|order| grow_order::<V>(world, order, growth))
}

/// Number of beams reflected at a time, so that intermediate results stay small beside the tree.
const BATCH: usize = 4096;

/// Reflects every beam of the preceding order.
fn grow_order<V: Visibility>(world: &World, order: u8, growth: &mut Growth) -> Result<(), BartError> {
    let parents = growth.begin_order(world);
    let mut incident_section = 0.0;
    let pool = Mutex::default();
    for (number, batch) in parents.chunks(BATCH).enumerate() {
        growth.progress.at(Phase::Tracing, number * BATCH, parents.len());
        let reflect = |lent: &mut PooledBuffers<'_>, &index: &u32| {
            let view = growth.view(world, index)?;
            Some((index, view.antenna, split_at_sheets(&view, V::reflected(&view, &mut lent.buffers))))
        };
        let met: Vec<_> = batch.par_iter().map_init(|| PooledBuffers::from(&pool), reflect).collect();
        for (parent, image, parts) in met.into_iter().flatten() {
            incident_section += growth.tree.beams[parent as usize].section;
            growth.take(Some(parent), image, order, parts)?;
        }
        growth.check_memory(world, order)?;
    }
    growth.end_order(Some(incident_section));
    Ok(())
}

/// Pool of reusable buffers: each has an entry for every facet of the world, and allocating them for every
/// part of every batch was a fifth of the work on two million facets.
struct PooledBuffers<'p> {
    buffers: Buffers,
    pool: &'p Mutex<Vec<Buffers>>,
}

impl<'p> PooledBuffers<'p> {
    fn from(pool: &'p Mutex<Vec<Buffers>>) -> Self {
        let buffers = pool.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default();
        Self { buffers, pool }
    }
}

impl Drop for PooledBuffers<'_> {
    fn drop(&mut self) {
        let buffers = std::mem::take(&mut self.buffers);
        self.pool.lock().unwrap_or_else(PoisonError::into_inner).push(buffers);
    }
}

/// A tree during growth, with data needed only for its last orders.
pub(crate) struct Growth<'a> {
    pub(crate) tree: BeamTree,
    pub(crate) settings: &'a TraceSettings,
    progress: &'a dyn Progress,
    /// Sequences of bodies that are followed; `None` for all.
    ways: Option<&'a BodySequences>,
    /// Edges of the last two orders' polygons, from vertex `first_edge` of the tree on.
    edges: Vec<(Plane, BorderLine)>,
    first_edge: usize,
    /// Index of the last order's first beam.
    first_beam: usize,
    audit: OrderAudit,
}

impl<'a> Growth<'a> {
    pub(crate) fn new(antenna: Antenna, settings: &'a TraceSettings, progress: &'a dyn Progress) -> Self {
        let tree = BeamTree {
            antenna,
            beams: Vec::new(),
            vertices_m: Vec::new(),
            borders: Vec::new(),
            passed: 0,
            audit: Audit::default(),
        };
        let (edges, audit) = (Vec::new(), OrderAudit::default());
        Self { tree, settings, progress, ways: None, edges, first_edge: 0, first_beam: 0, audit }
    }

    /// Starts an order; returns the beams of the preceding order that are to be reflected.
    pub(crate) fn begin_order(&mut self, world: &World) -> Vec<u32> {
        let last = self.first_beam..self.tree.beams.len();
        let first_edge = self.tree.beams.get(last.start).map_or(0, |beam| beam.polygon.start as usize);
        self.edges.drain(..first_edge.saturating_sub(self.first_edge).min(self.edges.len()));
        self.first_edge = first_edge;
        self.first_beam = last.end;
        self.audit = OrderAudit::default();
        let least = self.settings.least_mirror_area_m2;
        let is_on_a_way = |index: usize| {
            let bodies = || self.tree.bodies(world, &self.tree.beams[index]);
            self.ways.is_none_or(|ways| ways.continue_from(&bodies()))
        };
        let reflected = |&index: &usize| self.tree.beams[index].across_m2 >= least && is_on_a_way(index);
        last.filter(reflected).map(|index| index as u32).collect()
    }

    /// View from a beam of the preceding order as a mirror; `None` for a beam of an older order.
    pub(crate) fn view<'w>(&'w self, world: &'w World, index: u32) -> Option<View<'w>> {
        let beam = &self.tree.beams[index as usize];
        let facet = world.facet(beam.facet);
        let front = if beam.lit_normal == facet.plane.normal { facet.plane } else { -facet.plane };
        let start = (beam.polygon.start as usize).checked_sub(self.first_edge)?;
        let edges = self.edges.get(start..start + beam.polygon.len())?;
        let opening_m = self.tree.polygon(beam);
        Some(View::reflected(
            world,
            self.settings.sides,
            beam.image,
            Mirror { facet, front },
            edges,
            opening_m,
        ))
    }

    /// Adds the lit parts of one view.
    pub(crate) fn take(
        &mut self,
        parent: Option<u32>,
        image: Antenna,
        order: u8,
        parts: LitParts,
    ) -> Result<(), BartError> {
        let passed = parent.map_or(0, |parent| self.tree.passed(&self.tree.beams[parent as usize]));
        for part in &parts.parts {
            if part.corners.is_empty() || part.across_m2 < self.settings.least_area_m2 {
                self.audit.drop(part);
                continue;
            }
            let start = self.tree.vertices_m.len();
            let corners = &parts.corners[part.corners.clone()];
            self.tree.vertices_m.extend(corners.iter().map(|corner| corner.point_m));
            self.tree.borders.extend(corners.iter().map(|corner| corner.border));
            self.edges.extend(corners.iter().map(|corner| (corner.edge, corner.border)));
            let &LitPart { facet, lit_normal, across_m2, section, ref sheets, .. } = part;
            let sheets = sheets.clone();
            self.tree.passed += passed + sheets.len();
            let polygon = index(start)?..index(self.tree.vertices_m.len())?;
            self.tree.beams.push(Beam {
                parent,
                order,
                facet,
                lit_normal,
                image,
                across_m2,
                section,
                sheets,
                polygon,
            });
            self.audit.keep(part, self.settings);
        }
        Ok(())
    }

    /// Refuses a tree that exceeds the world's limit.
    fn check_memory(&self, world: &World, order: u8) -> Result<(), BartError> {
        let bytes = self.tree.bytes() + self.edges.capacity() * size_of::<(Plane, BorderLine)>();
        world.memory_limit().check_tree(order, self.tree.beams.len(), bytes)
    }

    /// Completes the audit of an order.
    fn end_order(&mut self, incident_section: Option<f64>) {
        let mut audit = std::mem::take(&mut self.audit);
        let found = audit.lit_section + audit.dropped_section;
        audit.incident_section = incident_section.unwrap_or(found);
        audit.escaped_section = audit.incident_section - found;
        self.tree.audit.orders.push(audit);
    }
}

impl OrderAudit {
    /// Area across the wave of dropped polygons and of mirrors that were not followed: its sum, m², and the
    /// sum of its squares, m⁴, those of mirrors times their scattering share. The last order is not reflected
    /// at all: nothing is missing behind its mirrors.
    pub(crate) fn dropped_sections(&self, mirrors: Mirroring) -> [f64; 2] {
        match mirrors {
            Mirroring::Followed { share: MirrorShare { mean, spread } } => [
                self.dropped_across_m2 + self.unreflected_across_m2,
                self.dropped_across_squared_m4
                    + mean * self.unreflected_across_squared_m4
                    + spread * self.unreflected_across_fourth_m8.sqrt(),
            ],
            Mirroring::Last => [self.dropped_across_m2, self.dropped_across_squared_m4],
        }
    }

    fn keep(&mut self, part: &LitPart, settings: &TraceSettings) {
        self.beams += 1;
        self.lit_area_m2 += part.area_m2;
        self.lit_section += part.section;
        if part.across_m2 < settings.least_mirror_area_m2 {
            self.unreflected += 1;
            self.unreflected_across_m2 += part.across_m2;
            self.unreflected_across_squared_m4 += part.across_m2.powi(2);
            self.unreflected_across_fourth_m8 += part.across_m2.powi(4);
        }
    }

    fn drop(&mut self, part: &LitPart) {
        self.dropped += 1;
        self.dropped_area_m2 += part.area_m2;
        self.dropped_across_m2 += part.across_m2;
        self.dropped_across_squared_m4 += part.across_m2.powi(2);
        self.dropped_section += part.section;
    }
}

/// Whether an order's beams are reflected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Mirroring {
    /// Sufficiently large mirrors are followed; the others scatter this share of the maximum power that they
    /// could.
    Followed {
        share: MirrorShare,
    },
    Last,
}

/// Share of the maximum power that mirrors could scatter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MirrorShare {
    /// Mean over mirrors.
    pub(crate) mean: f64,
    /// Excess of a single mirror over the mean, with a probability of 5 %: a mean does not describe few
    /// mirrors.
    pub(crate) spread: f64,
}

impl Audit {
    /// Sum of [`OrderAudit::dropped_sections`] over the first `needed` orders; `share` gives the mirror share
    /// of each, counted from 1.
    pub(crate) fn dropped_sections(&self, needed: u8, share: impl Fn(u8) -> MirrorShare) -> [f64; 2] {
        let mirrors = |order: u8| {
            if order < needed { Mirroring::Followed { share: share(order) } } else { Mirroring::Last }
        };
        let of = |(order, audit): (u8, &OrderAudit)| audit.dropped_sections(mirrors(order));
        (1..=needed).zip(&self.orders).map(of).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]])
    }
}

/// Converts a count of vertices or beams to 32 bits.
fn index(count: usize) -> Result<u32, BartError> {
    u32::try_from(count).map_err(|_| BartError::TreeTooLarge { vertices: count })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_control::memory::{JOINED_PER_TREE, MemoryLimit};
    use artifact::scene::Mesh;

    /// A corner of 2 × 20 × 20 squares.
    fn corner() -> World {
        let mut mesh = Mesh::default();
        for (u, v) in [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::Z)] {
            for i in 0..400 {
                let at = 0.05 * (f64::from(i % 20) * u + f64::from(i / 20) * v);
                let first = mesh.vertices_m.len() as u32;
                mesh.vertices_m
                    .extend([at, at + 0.05 * u, at + 0.05 * (u + v), at + 0.05 * v].map(|c| c.to_array()));
                mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            }
        }
        World::of_mesh(&mesh).unwrap()
    }

    fn trace(world: &World) -> Result<BeamTree, BartError> {
        let settings =
            TraceSettings { max_order: 3, sides: Sides::Two, least_area_m2: 0.0, least_mirror_area_m2: 0.0 };
        BeamTree::trace(world, Antenna::Point(DVec3::new(8.0, 3.0, 7.0)), &settings)
    }

    #[test]
    fn a_tree_that_outgrows_its_limit_is_given_up_with_figures() {
        let whole = trace(&corner()).unwrap();
        let needed = 8 * (1 + JOINED_PER_TREE) * whole.bytes() as u64;
        assert_eq!(trace(&corner().within(MemoryLimit::of_bytes(needed))).unwrap(), whole);
        let refused = trace(&corner().within(MemoryLimit::of_bytes(whole.bytes() as u64)));
        let Err(BartError::BeamsTakeTooMuchMemory { order, beams, bytes, limit_bytes }) = refused else {
            panic!("{refused:?}")
        };
        assert!(order >= 1 && beams > 0 && bytes > limit_bytes);
    }
}
