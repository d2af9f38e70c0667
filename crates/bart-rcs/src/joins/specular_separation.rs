//! Separation of the lit polygons of a double reflection from its specular point, and its consequence for the
//! integration.
//!
//! On the specular the reflection has a point of stationary phase on the lit polygon, and the integral over
//! the polygon is right on either facet. Off it the phase varies over the polygon; of physical optics with
//! the near field of each facet on the other, only the ends of the currents at the own edges of both facets
//! remain (asymptotically; docs/decisions/node-rule.md), and a polygon contains only a share of each of them.
//! With g the minimum gradient of the length L₁ + L₂ on the lit part, v the variance of lit positions along
//! it and h = 1/L₁ + 1/L₂ the bend of the length, polygons retain
//!
//! ```text
//! e^{−X}      X = k²g²/(1/v + kh)
//! ```
//! which is e^{−k²σ²} with σ the standard deviation of the length for plane waves, and for spherical ones
//! indicates whether the specular point is farther off than a Fresnel zone. The ends receive 1 − e^{−X}.

/// Separation for the node on one facet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct NodeSeparation {
    /// Minimum squared gradient of the length on the lit part.
    pub(crate) gradient_squared: f64,
    /// Variance of lit positions along that gradient, m².
    pub(crate) variance_m2: f64,
    /// Bend 1/L₁ + 1/L₂ of the length, 1/m.
    pub(crate) bend_per_m: f64,
    /// Lit area across the wave, m².
    pub(crate) across_m2: f64,
}

/// Separation for a sequence of two facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpecularSeparation {
    /// Nodes on the first and on the second facet.
    pub(crate) nodes: [NodeSeparation; 2],
    /// Clearness of the line of sight between both facets and both ends: 1 if everything is lit that the two
    /// alone would light, 0 if more than a little of it is hidden.
    pub(crate) clear: f64,
    /// Highest requested wavenumber.
    pub(crate) highest_per_m: f64,
}

impl SpecularSeparation {
    /// No separation: integration over polygons only.
    pub(crate) const NONE: Self = Self {
        nodes: [NodeSeparation { gradient_squared: 0.0, variance_m2: 0.0, bend_per_m: 0.0, across_m2: 0.0 };
            2],
        clear: 0.0,
        highest_per_m: 0.0,
    };

    /// Weight of the polygons.
    pub(crate) fn of_polygons(&self, wavenumber_per_m: f64) -> f64 {
        1.0 - self.of_ends(wavenumber_per_m)
    }

    /// Weight of the ends at own edges.
    pub(crate) fn of_ends(&self, wavenumber_per_m: f64) -> f64 {
        if self.clear == 0.0 {
            return 0.0;
        }
        self.clear * self.presence(wavenumber_per_m) * -(-self.exponent(wavenumber_per_m)).exp_m1()
    }

    /// Bound on the derivative of the logarithm of both weights with respect to the wavenumber, m: over a
    /// band they vary as if their lengths had this spread.
    pub(crate) fn turning_m(&self) -> f64 {
        /// Beyond e⁻³⁶ the remainder is negligible.
        const MOST_EXPONENT: f64 = 36.0;
        let exponent =
            if self.clear == 0.0 { 0.0 } else { self.exponent(self.highest_per_m).min(MOST_EXPONENT) };
        2.0 * exponent / self.highest_per_m.max(f64::MIN_POSITIVE)
    }

    /// Exponent X, the mean over both nodes weighted by lit area.
    fn exponent(&self, k: f64) -> f64 {
        let of = |node: &NodeSeparation| {
            let spread_m2 = node.variance_m2 / (1.0 + k * node.bend_per_m * node.variance_m2);
            node.across_m2 * k * k * node.gradient_squared * spread_m2
        };
        let all_m2: f64 = self.nodes.iter().map(|node| node.across_m2).sum();
        self.nodes.iter().map(of).sum::<f64>() / all_m2.max(f64::MIN_POSITIVE)
    }

    /// Presence of both nodes: a vanishing sequence keeps its polygons, which vanish as well.
    fn presence(&self, k: f64) -> f64 {
        let least_m2 = self.nodes[0].across_m2.min(self.nodes[1].across_m2);
        let zones = k * k * least_m2 / (4.0 * std::f64::consts::PI * std::f64::consts::PI);
        zones / (1.0 + zones)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(gradient: f64, bend_per_m: f64) -> NodeSeparation {
        let variance_m2 = 0.04 * 0.04 / 12.0;
        NodeSeparation { gradient_squared: gradient * gradient, variance_m2, bend_per_m, across_m2: 1.6e-3 }
    }

    fn separation(gradient: f64, bend_per_m: f64) -> SpecularSeparation {
        SpecularSeparation { nodes: [node(gradient, bend_per_m); 2], clear: 1.0, highest_per_m: 1613.8 }
    }

    #[test]
    fn polygons_keep_the_specular_and_lose_what_is_parted_from_it_by_its_own_spread() {
        let k = 1613.8;
        assert_eq!(separation(0.0, 0.0).of_polygons(k), 1.0);
        let sigma_m = 0.1 * 0.04 / 12.0_f64.sqrt();
        let presence = separation(0.1, 0.0).presence(k);
        let asked = 1.0 - presence * (1.0 - (-(k * sigma_m).powi(2)).exp());
        assert!((separation(0.1, 0.0).of_polygons(k) - asked).abs() < 1e-14 && presence > 0.99);
    }

    #[test]
    fn a_bent_wave_is_parted_by_its_fresnel_zone_where_that_is_narrower_than_what_is_lit() {
        let k = 1613.8;
        let wide = NodeSeparation { variance_m2: 1e3, ..node(0.01, 0.08) };
        let separation = SpecularSeparation { nodes: [wide; 2], ..separation(0.0, 0.0) };
        // k g²/h.
        assert!((separation.exponent(k) / (k * 1e-4 / 0.08) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_sequence_with_one_node_or_out_of_sight_keeps_its_polygons() {
        let one =
            SpecularSeparation { nodes: [node(1.0, 0.0), NodeSeparation::default()], ..separation(0.0, 0.0) };
        let hidden = SpecularSeparation { clear: 0.0, ..separation(1.0, 0.0) };
        assert_eq!([one.of_polygons(1613.8), hidden.of_polygons(1613.8)], [1.0, 1.0]);
        assert_eq!(SpecularSeparation::NONE.of_polygons(1613.8), 1.0);
    }
}
