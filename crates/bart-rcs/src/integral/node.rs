//! Node of a path: a lit polygon with the legs of both its ends.

use crate::geometry::antenna::Antenna;
use crate::geometry::clip::doubled_area;
use crate::integral::leg_surfaces::LegSurfaces;
use crate::integral::polarization::{Mirrors, polarization_vectors};
use crate::surface::bend::Bend;
use artifact::material::Material;
use glam::DVec3;
use radar::complex_vector::ComplexVector;

/// A value and a bound on its error, in the value's unit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Estimate<T> {
    pub(crate) value: T,
    pub(crate) error: f64,
}

/// One leg of a path as seen by its node.
#[derive(Debug, Clone)]
pub(crate) struct Leg {
    /// Image of the antenna in the facets between.
    pub(crate) image: Antenna,
    /// The facets between as perfect mirrors.
    pub(crate) mirrors: Mirrors,
    /// Materials of these facets and of the sheets between, where they matter.
    pub(crate) steps: LegSurfaces,
    /// Vector ĥ straight above and below.
    pub(crate) zenith_h: DVec3,
}

impl Leg {
    /// Fields that arrive for transmitted unit v and h, given the direction of travel at the node.
    pub(crate) fn arriving_fields(&self, travel: DVec3, wavenumber_per_m: f64) -> [ComplexVector; 2] {
        if self.steps.is_perfect() {
            return self.mirrors.fields_at_node(travel, self.zenith_h).map(ComplexVector::from);
        }
        let to_antenna = self.mirrors.antenna_direction(travel);
        let sent = polarization_vectors(to_antenna, self.zenith_h);
        self.steps.carry(sent, -to_antenna, wavenumber_per_m)
    }
}

impl Leg {
    /// Maximum share of a transmitted field that can remain at a point.
    fn strength(&self, at_m: DVec3, wavenumber_per_m: f64) -> f64 {
        let to_antenna = self.mirrors.antenna_direction(self.image.travel_direction_at(at_m));
        self.steps.strength(-to_antenna, wavenumber_per_m)
    }
}

/// Projection of the current at the node onto the receiver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bracket {
    /// Mean of both directions of travel: S(b1, b2) = S(b2, b1)ᵀ.
    Symmetrised,
    /// Current excited by the transmitter: reciprocal only in the specular direction.
    Plain,
}

/// A lit polygon with its two legs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node<'a> {
    /// Corners of a convex polygon, counter-clockwise about `normal`, world metres.
    pub(crate) corners_m: &'a [DVec3],
    /// Unit normal on the lit side.
    pub(crate) normal: DVec3,
    /// Material of the polygon's facet; `None` for a perfect conductor.
    pub(crate) material: Option<&'a Material>,
    /// Skin that is integrated over, where it differs from the polygon.
    pub(crate) bend: Option<Bend>,
    pub(crate) transmit: &'a Leg,
    pub(crate) receive: &'a Leg,
    pub(crate) bracket: Bracket,
}

impl Node<'_> {
    /// Whether the return leg equals the outgoing one, so that values of one leg hold for both.
    pub(crate) fn is_one_way(&self) -> bool {
        std::ptr::eq(self.transmit, self.receive)
    }

    /// Accuracy to request of the integral so that its error is `accuracy` of an unattenuated one: an
    /// attenuation to a tenth via the road or glass permits ten times the relative error.
    pub(crate) fn accuracy(&self, at_m: DVec3, wavenumbers_per_m: &[f64], accuracy: f64) -> f64 {
        let middle_per_m = wavenumbers_per_m.get(wavenumbers_per_m.len() / 2).copied().unwrap_or(0.0);
        let legs = [self.transmit, self.receive].map(|leg| leg.strength(at_m, middle_per_m));
        // Coefficients vary over a polygon, so no accuracy coarser than a half is requested.
        let strength = (legs[0] * legs[1]).clamp(1e-6, 1.0);
        (accuracy / strength).min(accuracy.max(0.5))
    }

    /// Ratio of the relative error allowed for this curved facet to that of one of area `common_m2`: all
    /// smaller ones together may err by as much as one of those.
    ///
    /// With N facets of root mean square area a, N·a·e is added to the bound Σ Aᵢ·e of the sum, and less than
    /// the same power if errors have independent phases. Slivers, whose skins turn within millimetres, would
    /// otherwise need as many tiles as panels.
    pub(crate) fn allowance(&self, common_m2: f64) -> f64 {
        (common_m2 / (0.5 * doubled_area(self.corners_m.iter().copied()).length())).max(1.0)
    }
}
