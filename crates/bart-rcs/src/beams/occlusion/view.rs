//! View of a world: viewpoint, opening and rules.

use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::geometry::border::BorderLine;
use crate::geometry::facet_geometry::FacetGeometry;
use crate::geometry::plane::Plane;
use artifact::settings::Sides;
use glam::DVec3;

/// A world as seen by an antenna or its image.
#[derive(Clone)]
pub(crate) struct View<'w> {
    /// World in view.
    pub(crate) world: &'w World,
    /// Sides of a facet that scatter.
    pub(crate) sides: Sides,
    /// Antenna or its image.
    pub(crate) antenna: Antenna,
    /// Reflecting facet; `None` for a direct view all round.
    pub(crate) mirror: Option<Mirror<'w>>,
    /// Planes through the antenna and the edges of the lit polygon on the mirror, positive inside, and what
    /// these edges end at.
    pub(crate) window: Vec<(Plane, BorderLine)>,
    /// Corners of the lit polygon on the mirror; empty without a mirror.
    pub(crate) opening_m: &'w [DVec3],
}

/// Mirror that a beam has just left.
#[derive(Clone, Copy)]
pub(crate) struct Mirror<'w> {
    /// The facet.
    pub(crate) facet: &'w FacetGeometry,
    /// Plane of the facet, positive on the lit side.
    pub(crate) front: Plane,
}

impl<'w> View<'w> {
    /// Direct view from the antenna, all round.
    pub(crate) fn direct(world: &'w World, sides: Sides, antenna: Antenna) -> Self {
        Self { world, sides, antenna, mirror: None, window: Vec::new(), opening_m: &[] }
    }

    /// View from the antenna's image through a lit polygon; the planes of its edges contain the antenna.
    pub(crate) fn reflected(
        world: &'w World,
        sides: Sides,
        lit_by: Antenna,
        mirror: Mirror<'w>,
        edges: &[(Plane, BorderLine)],
        opening_m: &'w [DVec3],
    ) -> Self {
        let window = edges
            .iter()
            .map(|(edge, border)| (edge.mirrored(&mirror.front), border.through_mirror(&mirror.front)))
            .collect();
        Self {
            world,
            sides,
            antenna: lit_by.mirrored(&mirror.front),
            mirror: Some(mirror),
            window,
            opening_m,
        }
    }

    /// Distances below this are rounding, m.
    pub(crate) fn tolerance_m(&self) -> f64 {
        self.world.tolerance_m()
    }

    /// The antenna and its opening, unless the view is all round.
    pub(crate) fn opening(&self) -> Option<(Antenna, &'w [DVec3])> {
        (!self.opening_m.is_empty()).then_some((self.antenna, self.opening_m))
    }

    /// Whether a facet reaches into the view: it is outside no plane of the window, and no edge has all of
    /// the window on its far side. Rejected facets touch the view in rounding at most.
    pub(crate) fn reaches(&self, facet: &FacetGeometry) -> bool {
        let tolerance_m = self.tolerance_m();
        let mut planes =
            self.window.iter().map(|(plane, _)| plane).chain(self.mirror.iter().map(|mirror| &mirror.front));
        planes.all(|plane| plane.extent_m(&facet.corners_m).1 > tolerance_m) && !self.is_beside_opening(facet)
    }

    /// Whether the visible part of a facet counts as lit; if paths between bodies are left out, a mirror
    /// lights only its own body, and others shade it.
    pub(crate) fn is_followed(&self, facet: u32) -> bool {
        self.mirror.is_none_or(|mirror| self.world.is_followed(mirror.facet, facet))
    }

    /// Whether one of the planes through the antenna and a facet's edges separates the facet from the
    /// mirror's lit polygon.
    fn is_beside_opening(&self, facet: &FacetGeometry) -> bool {
        let [a, b, c] = facet.corners_m;
        [(a, b, c), (b, c, a), (c, a, b)].into_iter().any(|(from, to, opposite)| {
            let normal = self.antenna.towards(from).cross(to - from);
            let side = normal.dot(opposite - from);
            // Minimum for a plane that is not mere rounding.
            let least = self.tolerance_m() * normal.length();
            side.abs() > least
                && !self.opening_m.is_empty()
                && self.opening_m.iter().all(|x| side.signum() * normal.dot(x - from) < -least)
        })
    }
}
