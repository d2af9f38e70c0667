//! Beam trees: what an antenna lights, and what these facets light as mirrors.
//!
//! A beam is a convex lit polygon on a facet, seen straight from the antenna's image behind the facets before it.
//! Frequency and polarization enter later, in the integration.

use crate::antenna::Antenna;
use crate::error::BartError;
use crate::world::World;
use artifact::settings::Sides;
use glam::DVec3;
use std::ops::Range;

/// What a tree shall hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceSettings {
    /// Highest number of facets in a beam's sequence: 1 is what the antenna lights directly.
    pub max_order: u8,
    /// Which sides of a facet scatter.
    pub sides: Sides,
    /// Beams of less area across the wave (area·cosθ) are dropped, and counted in [`Audit`]; m².
    ///
    /// A beam scatters at most |S| = √(4π)/λ · area·cosθ · R²/(L₁L₂), so a bound on S over the expected number of dropped
    /// beams gives this bound. Physics §2 has λ²/100 · accuracy.
    pub least_area_m2: f64,
    /// Beams of less area across the wave are kept but not reflected further; m², at least `least_area_m2`.
    pub least_mirror_area_m2: f64,
}

/// A convex lit polygon at the end of a sequence of mirrors.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// Index of the beam that was reflected into this one; `None` at order 1.
    pub parent: Option<u32>,
    /// Facets in the sequence, this one included.
    pub order: u8,
    /// Index into [`World::facets`].
    pub facet: u32,
    /// Unit normal of the facet on the lit side.
    pub lit_normal: DVec3,
    /// The antenna mirrored in the facets before this one: it lights `facet` straight.
    pub image: Antenna,
    /// Corners in the tree's vertices.
    pub(crate) polygon: Range<u32>,
}

/// Every beam of one antenna.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamTree {
    /// Where it was traced from.
    pub antenna: Antenna,
    /// Parents before children; by order, parent, facet and piece.
    pub beams: Vec<Beam>,
    /// Corners of all polygons, world metres.
    pub(crate) vertices_m: Vec<DVec3>,
    /// What became of the power.
    pub audit: Audit,
}

/// Where the power of a tree went, by order (index 0 is order 1).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Audit {
    /// One entry per order traced.
    pub orders: Vec<OrderAudit>,
}

/// Where the power of one order went.
///
/// "Section" is what an antenna's wave front loses to a polygon: the solid angle at a finite range, sr, or the area across
/// the direction, m². A mirror leaves it as it is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OrderAudit {
    /// Beams kept.
    pub beams: u64,
    /// Area of the polygons kept, m².
    pub lit_area_m2: f64,
    /// Section of the beams kept.
    pub lit_section: f64,
    /// Section of the beams of the order before that were reflected; at order 1 the section kept and dropped.
    pub incident_section: f64,
    /// Section that met no facet: incident − lit − dropped; 0 at order 1.
    pub escaped_section: f64,
    /// Polygons given up for their size.
    pub dropped: u64,
    /// Their area, m².
    pub dropped_area_m2: f64,
    /// Their area across the wave, Σ area·cosθ, m²: |S| dropped ≤ √(4π)/λ · this · R²/(L₁L₂).
    pub dropped_across_m2: f64,
    /// Their section.
    pub dropped_section: f64,
    /// Beams of this order kept but too small to be reflected further.
    pub unreflected: u64,
    /// Their area across the wave, m².
    pub unreflected_across_m2: f64,
}

impl BeamTree {
    /// Everything that `antenna` lights, up to `settings.max_order`.
    pub fn trace(_world: &World, antenna: Antenna, _settings: &TraceSettings) -> Result<Self, BartError> {
        if !antenna.is_sound() {
            return Err(BartError::AntennaNotFinite);
        }
        Ok(Self { antenna, beams: Vec::new(), vertices_m: Vec::new(), audit: Audit::default() })
    }

    /// The lit polygon: convex, counter-clockwise about the lit normal, world metres.
    pub fn polygon(&self, beam: &Beam) -> &[DVec3] {
        &self.vertices_m[beam.polygon.start as usize..beam.polygon.end as usize]
    }

    /// Facets from the antenna to this beam, its own last: indices into [`World::facets`].
    pub fn sequence(&self, beam: &Beam) -> Vec<u32> {
        let up = |b: &&Beam| b.parent.map(|parent| &self.beams[parent as usize]);
        let mut facets: Vec<u32> = std::iter::successors(Some(beam), up).map(|b| b.facet).collect();
        facets.reverse();
        facets
    }
}
