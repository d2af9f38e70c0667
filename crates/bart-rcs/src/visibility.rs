//! What an antenna sees: every facet clipped to the view, less what other facets hide, as convex polygons.
//!
//! For each facet the hierarchy proposes what may stand in front. The facet's polygon is then cut by one occluder after
//! the other, the largest first, and every piece carries on only those that may still reach it: a facet behind a dense mesh
//! costs the outline of its shadow, not the number of facets in front.

use crate::antenna::Antenna;
use crate::clip::{Corner, Split, doubled_area, perimeter_m, split};
use crate::plane::Plane;
use crate::section::section;
use crate::shadow::{Cover, Hides, Mirror, Scale, Seen, Shadow};
use crate::world::{Walk, World};
use artifact::settings::Sides;
use glam::DVec3;
use rayon::prelude::*;
use std::ops::{ControlFlow, Range};

/// Where one looks from, and through which hole.
#[derive(Debug, Clone)]
pub(crate) struct View {
    /// The antenna or its image.
    pub(crate) antenna: Antenna,
    /// The facet that reflects; `None` looks straight and all round.
    pub(crate) mirror: Option<Mirror>,
    /// Planes around the view, positive inside: through the antenna and the hole's edges, and the mirror's own.
    pub(crate) window: Vec<Plane>,
}

/// A way to find what a view shows. Both give the same parts up to how they are cut.
pub(crate) trait Visibility {
    /// What an antenna sees straight, one entry per facet that it sees any of, in the order of the facets.
    fn direct(world: &World, antenna: Antenna, scale: &Scale) -> Vec<Parts>;
    /// What a reflected beam meets.
    fn reflected(world: &World, view: &View, scale: &Scale, buffers: &mut Buffers) -> Parts;
}

/// By the bodies' hierarchies.
pub(crate) struct ByHierarchy;

/// Lit polygons of one view.
#[derive(Debug, Clone, Default)]
pub(crate) struct Parts {
    /// By facet, then piece.
    pub(crate) parts: Vec<Part>,
    /// Their corners.
    pub(crate) corners: Vec<Corner>,
}

/// A lit polygon.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    /// Index into the world's facets.
    pub(crate) facet: u32,
    /// Unit, on the lit side.
    pub(crate) lit_normal: DVec3,
    /// In [`Parts::corners`]; empty where the polygon is nothing but rounding.
    pub(crate) corners: Range<usize>,
    /// m².
    pub(crate) area_m2: f64,
    /// Area across the wave, area·cosθ at the middle, m².
    pub(crate) across_m2: f64,
    /// Solid angle, sr, or area across the direction, m².
    pub(crate) section: f64,
}

/// Memory that is used again from view to view.
#[derive(Default)]
pub(crate) struct Buffers {
    walk: Walk,
    found: Vec<u32>,
    shadows: Vec<Shadow>,
    slot_of_facet: Vec<u32>,
    cutter: Cutter,
}

/// Beams with more facets than this in view walk the hierarchy again for each of them; below, trying all pairs is cheaper
/// than the walks (one walk costs about as much as a hundred pairs).
const MANY_IN_VIEW: usize = 96;
const NO_SLOT: u32 = u32::MAX;

impl Visibility for ByHierarchy {
    fn direct(world: &World, antenna: Antenna, scale: &Scale) -> Vec<Parts> {
        let view = View { antenna, mirror: None, window: Vec::new() };
        let shadow_of = |(index, facet)| Shadow::of(index as u32, facet, antenna, None, scale.tolerance_m);
        let shadows: Vec<Shadow> = world.facets().par_iter().enumerate().filter_map(shadow_of).collect();
        let mut slot_of_facet = vec![NO_SLOT; world.facets().len()];
        (0..).zip(&shadows).for_each(|(slot, shadow)| slot_of_facet[shadow.facet as usize] = slot);
        let table = Table { shadows: &shadows, slot_of_facet: &slot_of_facet };
        let lit = |(walk, cutter): &mut (Walk, Cutter), slot: u32| {
            let mut parts = Parts::default();
            see_facet(world, &view, scale, &table, slot, (walk, cutter), &mut parts);
            parts
        };
        let slots = (0..shadows.len() as u32).into_par_iter().with_min_len(64);
        let seen: Vec<Parts> = slots.map_init(Default::default, lit).collect();
        seen.into_iter().filter(|parts| !parts.parts.is_empty()).collect()
    }

    fn reflected(world: &World, view: &View, scale: &Scale, buffers: &mut Buffers) -> Parts {
        buffers.gather(world, view, scale);
        let Buffers { walk, shadows, slot_of_facet, cutter, .. } = buffers;
        let table = Table { shadows, slot_of_facet };
        let mut parts = Parts::default();
        for slot in 0..shadows.len() as u32 {
            see_facet(world, view, scale, &table, slot, (walk, cutter), &mut parts);
        }
        shadows.iter().for_each(|shadow| slot_of_facet[shadow.facet as usize] = NO_SLOT);
        parts
    }
}

impl Buffers {
    /// Shadows of all facets that reach into the view, in the order of the facets.
    fn gather(&mut self, world: &World, view: &View, scale: &Scale) {
        self.slot_of_facet.resize(world.facets().len(), NO_SLOT);
        self.found.clear();
        let found = |facet| {
            self.found.push(facet);
            ControlFlow::Continue(())
        };
        let _ = world.visit_inside(&view.window, DVec3::ZERO, &mut self.walk, found);
        self.found.sort_unstable();
        let mirror = view.mirror.as_ref().map(|mirror| (mirror, world.facet(mirror.facet)));
        let shadow_of = |&facet: &u32| Shadow::of(facet, world.facet(facet), view.antenna, mirror, scale.tolerance_m);
        self.shadows.clear();
        self.shadows.extend(self.found.iter().filter_map(shadow_of));
        for (slot, shadow) in (0..).zip(&self.shadows) {
            self.slot_of_facet[shadow.facet as usize] = slot;
        }
    }
}

/// Shadows of what is in view.
struct Table<'a> {
    shadows: &'a [Shadow],
    slot_of_facet: &'a [u32],
}

/// The polygon of a facet that the view's window leaves, its range in `corners`; `None` where it leaves none.
pub(crate) fn clip_to_window(
    world: &World,
    view: &View,
    target: &Shadow,
    scale: &Scale,
    corners: &mut Vec<Corner>,
    distances_m: &mut Vec<f64>,
) -> Option<Range<usize>> {
    if scale.sides == Sides::One && target.seen == Seen::Back {
        return None;
    }
    corners.clear();
    corners.extend(target.polygon(world.facet(target.facet)));
    view.window.iter().try_fold(0..3, |polygon, plane| {
        match split(corners, polygon.clone(), plane, scale.tolerance_m, distances_m) {
            Split::Inside => Some(polygon),
            Split::Outside => None,
            Split::Cut { inside, .. } => Some(inside),
        }
    })
}

impl Parts {
    /// Adds a lit polygon. One that is thinner than rounding keeps its area, for the books, and loses its corners.
    pub(crate) fn push(&mut self, target: &Shadow, antenna: Antenna, polygon: &[Corner], scale: &Scale) {
        let area_m2 = area_m2(polygon, target.front.normal);
        let start = self.corners.len();
        if area_m2 > scale.tolerance_m * perimeter_m(polygon) {
            self.corners.extend_from_slice(polygon);
        }
        let middle = polygon.iter().map(|c| c.point_m).sum::<DVec3>() / polygon.len() as f64;
        let towards = antenna.towards(middle).try_normalize().unwrap_or(DVec3::ZERO);
        self.parts.push(Part {
            facet: target.facet,
            lit_normal: target.front.normal,
            corners: start..self.corners.len(),
            area_m2,
            across_m2: area_m2 * towards.dot(target.front.normal).abs(),
            section: section(antenna, polygon.iter().map(|c| c.point_m)),
        });
    }
}

/// Area of a polygon about a unit normal, m².
fn area_m2(polygon: &[Corner], normal: DVec3) -> f64 {
    0.5 * doubled_area(polygon.iter().map(|c| c.point_m)).dot(normal).max(0.0)
}

/// Appends what is seen of the facet in `slot`.
fn see_facet(
    world: &World,
    view: &View,
    scale: &Scale,
    table: &Table,
    slot: u32,
    (walk, cutter): (&mut Walk, &mut Cutter),
    parts: &mut Parts,
) {
    let target = &table.shadows[slot as usize];
    let Some(polygon) = clip_to_window(world, view, target, scale, &mut cutter.corners, &mut cutter.distances_m) else {
        return;
    };
    if find_occluders(world, view, scale, table, target, &cutter.corners[polygon.clone()], walk, &mut cutter.occluders)
        == Cover::Whole
    {
        return;
    }
    cutter.cut(polygon, table.shadows, scale, |polygon| parts.push(target, view.antenna, polygon, scale));
}

/// An occluder of one target.
#[derive(Debug, Clone, Copy)]
struct Occluder {
    /// In the table of shadows.
    slot: u32,
    hides: Hides,
    apparent_size: f64,
}

/// Collects what may hide some of the polygon, the largest first; `Whole` where one facet hides all of it.
fn find_occluders(
    world: &World,
    view: &View,
    scale: &Scale,
    table: &Table,
    target: &Shadow,
    polygon: &[Corner],
    walk: &mut Walk,
    occluders: &mut Vec<Occluder>,
) -> Cover {
    occluders.clear();
    let suspect = |slot: u32| suspect(world, scale, table, target, polygon, slot, occluders);
    let end = if view.mirror.is_some() && table.shadows.len() <= MANY_IN_VIEW {
        (0..table.shadows.len() as u32).try_for_each(suspect)
    } else {
        walk_towards(world, view, table, target, polygon, walk, suspect)
    };
    if end.is_break() {
        return Cover::Whole;
    }
    occluders.sort_unstable_by(|a, b| b.apparent_size.total_cmp(&a.apparent_size).then(a.slot.cmp(&b.slot)));
    Cover::Partial
}

/// Takes a facet among the occluders if it may hide some of the polygon; breaks if it hides all of it.
fn suspect(
    world: &World,
    scale: &Scale,
    table: &Table,
    target: &Shadow,
    polygon: &[Corner],
    slot: u32,
    occluders: &mut Vec<Occluder>,
) -> ControlFlow<()> {
    let shadow = &table.shadows[slot as usize];
    if shadow.facet == target.facet || shadow.cover(Hides::AllInItsCone, polygon, scale.tolerance_m) == Cover::Apart {
        return ControlFlow::Continue(());
    }
    let (own, other) = (world.facet(shadow.facet), world.facet(target.facet));
    let hides = shadow.hides(own, target, other, scale);
    if hides == Hides::Nothing || is_beside(polygon, &own.corners_m, scale.tolerance_m) {
        return ControlFlow::Continue(());
    }
    match shadow.cover(hides, polygon, scale.tolerance_m) {
        Cover::Apart => {}
        Cover::Partial => occluders.push(Occluder { slot, hides, apparent_size: shadow.apparent_size }),
        Cover::Whole => return ControlFlow::Break(()),
    }
    ControlFlow::Continue(())
}

/// Calls `suspect` with all that may stand between the antenna and a polygon of the target, about from the antenna on.
fn walk_towards(
    world: &World,
    view: &View,
    table: &Table,
    target: &Shadow,
    polygon: &[Corner],
    walk: &mut Walk,
    mut suspect: impl FnMut(u32) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let mut planes = [target.front; 16];
    let mut n = 1;
    if let Antenna::Point(p) = view.antenna {
        // Nearer to the facet's plane than the antenna is.
        planes[n] = Plane { normal: -target.front.normal, offset_m: -target.front.normal.dot(p) };
        n += 1;
    }
    // Fewer planes only find more facets.
    for corner in polygon.iter().take(planes.len() - n) {
        planes[n] = corner.edge;
        n += 1;
    }
    planes[..n].reverse();
    let nearer = view.antenna.towards(polygon[0].point_m);
    world.visit_inside(&planes[..n], nearer, walk, |facet| match table.slot_of_facet[facet as usize] {
        NO_SLOT => ControlFlow::Continue(()),
        slot => suspect(slot),
    })
}

/// Whether a triangle lies wholly outside one of the planes through the antenna and the polygon's edges.
fn is_beside(polygon: &[Corner], corners_m: &[DVec3; 3], tolerance_m: f64) -> bool {
    polygon.iter().any(|corner| corners_m.iter().all(|&c| corner.edge.distance_m(c) <= tolerance_m))
}

/// Subtracts occluders from a polygon.
#[derive(Default)]
struct Cutter {
    /// Polygons, those of the open pieces first.
    corners: Vec<Corner>,
    distances_m: Vec<f64>,
    occluders: Vec<Occluder>,
    /// Lists of indices into `occluders`, those of the open pieces first.
    lists: Vec<u32>,
    open: Vec<Piece>,
}

/// A polygon and the occluders that may still reach it.
#[derive(Debug, Clone)]
struct Piece {
    polygon: Range<usize>,
    list: Range<usize>,
}

impl Cutter {
    /// Calls `lit` with every piece of `corners[polygon]` that no occluder hides.
    fn cut(&mut self, polygon: Range<usize>, shadows: &[Shadow], scale: &Scale, mut lit: impl FnMut(&[Corner])) {
        self.lists.clear();
        self.lists.extend(0..self.occluders.len() as u32);
        self.open.clear();
        self.open.push(Piece { polygon, list: 0..self.lists.len() });
        while let Some(piece) = self.open.pop() {
            // What was appended after this piece belonged to pieces that are done.
            self.corners.truncate(piece.polygon.end);
            self.lists.truncate(piece.list.end);
            let list = piece.list.end..self.lists.len();
            let Some(list) = self.still_reaching(&piece, shadows, scale).map(|end| list.start..end) else { continue };
            if !self.subtract_first_of(list, piece.polygon.clone(), shadows, scale) {
                lit(&self.corners[piece.polygon]);
            }
        }
    }

    /// Appends the piece's occluders that still reach it and gives the end of the list; `None` where one hides it all.
    fn still_reaching(&mut self, piece: &Piece, shadows: &[Shadow], scale: &Scale) -> Option<usize> {
        let polygon = &self.corners[piece.polygon.clone()];
        for i in piece.list.clone() {
            let index = self.lists[i];
            let occluder = &self.occluders[index as usize];
            let shadow = &shadows[occluder.slot as usize];
            match shadow.cover(occluder.hides, polygon, scale.tolerance_m) {
                Cover::Apart => {}
                Cover::Partial => self.lists.push(index),
                Cover::Whole => return None,
            }
        }
        Some(self.lists.len())
    }

    /// Opens the parts of the polygon outside the first occluder that really overlaps it; `false` where none does.
    fn subtract_first_of(
        &mut self,
        list: Range<usize>,
        polygon: Range<usize>,
        shadows: &[Shadow],
        scale: &Scale,
    ) -> bool {
        for i in list.clone() {
            let occluder = self.occluders[self.lists[i] as usize];
            let (open, corners) = (self.open.len(), self.corners.len());
            if self.open_outside_parts(
                shadows[occluder.slot as usize].planes(occluder.hides),
                polygon.clone(),
                i + 1..list.end,
                scale,
            ) {
                return true;
            }
            self.open.truncate(open);
            self.corners.truncate(corners);
        }
        false
    }

    /// Cuts the polygon by an occluder's planes, one after the other; `false` where nothing but rounding is hidden.
    fn open_outside_parts(
        &mut self,
        planes: impl Iterator<Item = Plane>,
        mut polygon: Range<usize>,
        list: Range<usize>,
        scale: &Scale,
    ) -> bool {
        for plane in planes {
            match split(&mut self.corners, polygon.clone(), &plane, scale.tolerance_m, &mut self.distances_m) {
                Split::Inside => {}
                Split::Outside => return false,
                Split::Cut { inside, outside } => {
                    self.open.push(Piece { polygon: outside, list: list.clone() });
                    polygon = inside;
                }
            }
        }
        let hidden = &self.corners[polygon];
        let doubled = doubled_area(hidden.iter().map(|c| c.point_m)).length();
        doubled > 2.0 * scale.tolerance_m * perimeter_m(hidden)
    }
}
