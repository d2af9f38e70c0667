//! The node of a path: a lit polygon with the legs of both its ends.

use crate::geometry::antenna::Antenna;
use crate::geometry::clip::doubled_area;
use crate::integral::polarization::{Mirrors, polarization_vectors};
use crate::integral::steps::Steps;
use crate::surface::bend::Bend;
use artifact::material::Material;
use glam::DVec3;
use radar::complex_vector::ComplexVector;

/// A value and a bound of its error, in the value's unit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Estimate<T> {
    pub(crate) value: T,
    pub(crate) error: f64,
}

/// One end of a path as its node sees it.
#[derive(Debug, Clone)]
pub(crate) struct Leg {
    /// The antenna mirrored in the facets between.
    pub(crate) image: Antenna,
    /// The facets between as perfect mirrors.
    pub(crate) mirrors: Mirrors,
    /// Materials of these facets and of the sheets between, where they matter.
    pub(crate) steps: Steps,
    /// Vector ĥ straight above and below.
    pub(crate) zenith_h: DVec3,
}

impl Leg {
    /// The fields that arrive of sent unit v and h, for the direction of travel at the node.
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
    /// Largest share of a field that was sent that may be left at a point.
    fn strength(&self, at_m: DVec3, wavenumber_per_m: f64) -> f64 {
        let to_antenna = self.mirrors.antenna_direction(self.image.travel_direction_at(at_m));
        self.steps.strength(-to_antenna, wavenumber_per_m)
    }
}

/// Projection of the current at the node on the receiver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bracket {
    /// Mean of both directions of travel: S(b1, b2) = S(b2, b1)ᵀ.
    Symmetrised,
    /// The current excited by the transmitter: reciprocal at the specular only.
    Plain,
}

/// A lit polygon with its two legs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node<'a> {
    /// Corners of a convex polygon, counter-clockwise about `normal`, world metres.
    pub(crate) corners_m: &'a [DVec3],
    /// Unit normal on the lit side.
    pub(crate) normal: DVec3,
    /// Material of the polygon's facet; `None` is a perfect conductor.
    pub(crate) material: Option<&'a Material>,
    /// The skin that is integrated over where it is not the polygon itself.
    pub(crate) bend: Option<Bend>,
    pub(crate) transmit: &'a Leg,
    pub(crate) receive: &'a Leg,
    pub(crate) bracket: Bracket,
}

impl Node<'_> {
    /// Whether a wave goes back by the very way that it came: what is of one leg is of both.
    pub(crate) fn is_one_way(&self) -> bool {
        std::ptr::eq(self.transmit, self.receive)
    }

    /// Accuracy to ask of the integral so that its error is `accuracy` of an unweakened one: what arrives
    /// over the road or through glass at a tenth may be wrong by ten times as much of itself.
    pub(crate) fn accuracy(&self, at_m: DVec3, wavenumbers_per_m: &[f64], accuracy: f64) -> f64 {
        let middle_per_m = wavenumbers_per_m.get(wavenumbers_per_m.len() / 2).copied().unwrap_or(0.0);
        let legs = [self.transmit, self.receive].map(|leg| leg.strength(at_m, middle_per_m));
        // Coefficients change over a polygon; half of itself is left as the least that is asked.
        let strength = (legs[0] * legs[1]).clamp(1e-6, 1.0);
        (accuracy / strength).min(accuracy.max(0.5))
    }

    /// Ratio of the relative error that this bent facet may have to that of one of `common_m2`: smaller ones
    /// may err by as much, in all, as one of those.
    ///
    /// With N facets of the root mean square area a, N·a·e is added to the bound Σ Aᵢ·e of the sum, and less
    /// than the same power where errors have phases of their own. Slivers, whose skins turn within
    /// millimetres, take as many tiles as panels do otherwise.
    pub(crate) fn allowance(&self, common_m2: f64) -> f64 {
        (common_m2 / (0.5 * doubled_area(self.corners_m.iter().copied()).length())).max(1.0)
    }
}
