//! Numbers of frequencies and azimuths that a range profile and an image need to show a body without
//! ambiguity.
//!
//! Frequencies Δf apart repeat every c/2Δf in range, azimuths Δφ apart every λ/2Δφ across it (λ/Δφ with a
//! fixed receiver): a longer or wider body overlaps with itself.

use crate::program::commands::rcs::aspect_geometry::AspectGeometry;
use artifact::scene::Mesh;
use artifact::units::SPEED_OF_LIGHT_MPS;
use bart_rcs::RcsRequest;
use serde_json::{Value, json};

/// Sampling of one axis of a table, compared with the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sampling {
    /// Extent that a picture shows before it repeats.
    pub(super) unambiguous_m: f64,
    /// Largest extent of the body along the picture's axis over the aspects.
    pub(super) body_m: f64,
    pub(super) values: usize,
    /// Number of values over the same span from which on the body is unambiguous.
    pub(super) needed: usize,
}

/// Both axes of the cut at the first elevation, if they have more than one value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Samplings {
    pub(super) range: Option<Sampling>,
    pub(super) cross_range: Option<Sampling>,
}

impl Samplings {
    pub(super) fn of(mesh: &Mesh, request: &RcsRequest) -> Self {
        let [range_m, cross_m] = extents(mesh, request);
        let [band_hz, span_rad] = [&request.frequency_hz, &request.azimuth_rad].map(|axis| span(axis));
        let wavelength_m = SPEED_OF_LIGHT_MPS / centre(&request.frequency_hz);
        let sampling = |values: usize, unit: f64, body_m: f64| {
            (values > 1 && unit.is_finite()).then(|| Sampling {
                unambiguous_m: unit * (values - 1) as f64,
                body_m,
                values,
                // The factor absorbs rounding, a part in 10⁹.
                needed: (body_m / unit * (1.0 - 1e-9)).ceil() as usize + 1,
            })
        };
        Self {
            range: sampling(request.frequency_hz.len(), SPEED_OF_LIGHT_MPS / (2.0 * band_hz), range_m),
            cross_range: sampling(
                request.azimuth_rad.len(),
                wavelength_m / (AspectGeometry::of(request, 0.0).moving() * span_rad),
                cross_m,
            ),
        }
    }

    /// Value of `pictures` in `S.json`.
    pub(super) fn json(&self) -> Value {
        let told = |axis: Option<Sampling>, name: &str| {
            axis.map(|s| {
                json!({ name: s.values, "needed": s.needed, "unambiguous_m": s.unambiguous_m,
                    "body_m": s.body_m, "ambiguous": s.is_ambiguous() })
            })
        };
        json!({ "range": told(self.range, "frequencies"), "cross_range": told(self.cross_range, "azimuths") })
    }

    /// A sentence for each axis on which the body overlaps with itself.
    pub(super) fn warnings(&self) -> Vec<String> {
        let range = self.range.filter(Sampling::is_ambiguous).map(|s| s.warning("range", "frequencies"));
        let cross =
            self.cross_range.filter(Sampling::is_ambiguous).map(|s| s.warning("cross-range", "azimuths"));
        range.into_iter().chain(cross).collect()
    }
}

impl Sampling {
    pub(super) fn is_ambiguous(&self) -> bool {
        self.values < self.needed
    }

    fn warning(&self, axis: &str, values: &str) -> String {
        format!(
            "ambiguous in {axis}: {} {values} show {:.2} m before they repeat, the body has {:.2} m: {} {values} over \
             this span are needed",
            self.values, self.unambiguous_m, self.body_m, self.needed
        )
    }
}

/// Number of azimuths at which the body's extent is computed: between them it changes by 2 parts in 10⁴ at
/// most.
const LOOKS: usize = 181;

/// Largest extents in range and cross-range over azimuths.
fn extents(mesh: &Mesh, request: &RcsRequest) -> [f64; 2] {
    let every = request.azimuth_rad.len().div_ceil(LOOKS).max(1);
    let looks = request.azimuth_rad.iter().step_by(every).chain(request.azimuth_rad.last());
    let extents = looks.map(|azimuth_rad| AspectGeometry::of(request, *azimuth_rad).extent(mesh));
    let wider = |widest: f64, [low, high]: [f64; 2]| widest.max(high - low);
    extents.fold([0.0; 2], |[range_m, across_m], extent| {
        [wider(range_m, extent.range_m), wider(across_m, extent.across_m)]
    })
}

fn span(axis: &[f64]) -> f64 {
    axis.first().zip(axis.last()).map_or(0.0, |(first, last)| (last - first).abs())
}

/// The frequency whose wavelength represents all.
pub(super) fn centre(frequency_hz: &[f64]) -> f64 {
    frequency_hz[frequency_hz.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::commands::rcs::test_request::request_of;
    use bart_rcs::Standpoint;

    /// A box of 4 m × 2 m × 1 m that stands 10 m ahead of its origin.
    fn body() -> Mesh {
        let sides = [[8.0, 12.0], [-1.0, 1.0], [0.0, 1.0]];
        let corner = |i: usize| [0, 1, 2].map(|axis: usize| sides[axis][(i >> axis) & 1]);
        Mesh { vertices_m: (0..8).map(corner).collect(), ..Mesh::default() }
    }

    #[test]
    fn as_many_frequencies_and_azimuths_are_asked_for_as_show_the_body_once() {
        // c/2B of 1 GHz is 0.1499 m: 4 m are 26.7 of them, 28 frequencies; λ/2Δφ of 0.01 rad at 77 GHz is
        // 0.195 m.
        let frequencies: Vec<f64> = (0..9).map(|i| 76.5e9 + 1e9 * f64::from(i) / 8.0).collect();
        let samplings = Samplings::of(&body(), &request_of(&frequencies, &[0.0, 0.005, 0.01]));
        let (range, cross) = (samplings.range.unwrap(), samplings.cross_range.unwrap());
        println!("{range:?} {cross:?}");
        assert!((range.body_m - 4.0).abs() < 0.03, "the look along the body's axis, 0.01 rad aside at most");
        assert_eq!((range.values, range.needed, range.is_ambiguous()), (9, 28, true));
        assert_eq!((cross.values, cross.needed, cross.is_ambiguous()), (3, 12, true));
        assert_eq!(samplings.warnings().len(), 2);
        let enough: Vec<f64> = (0..28).map(|i| 76.5e9 + 1e9 * f64::from(i) / 27.0).collect();
        let samplings = Samplings::of(&body(), &request_of(&enough, &[0.0]));
        assert!(!samplings.range.unwrap().is_ambiguous() && samplings.cross_range.is_none());
        assert!(samplings.warnings().is_empty());
    }

    #[test]
    fn a_receiver_that_stands_still_halves_the_azimuths_that_show_a_body_once() {
        let request = request_of(&[77e9], &[0.0, 0.005, 0.01]);
        let receiver = Some(Standpoint { azimuth_rad: 1.0, elevation_rad: 0.0, range_m: f64::INFINITY });
        let [together, apart] = [request.clone(), RcsRequest { receiver, ..request }]
            .map(|request| Samplings::of(&body(), &request).cross_range.unwrap());
        println!("{together:?} {apart:?}");
        assert_eq!((together.needed, apart.needed), (12, 7));
        assert!((apart.body_m - together.body_m).abs() < 1e-12);
    }

    #[test]
    fn a_body_ahead_of_its_origin_is_nearer() {
        let extent = AspectGeometry::of(&request_of(&[77e9], &[0.0]), 0.0).extent(&body());
        assert!((extent.range_m[0] + 12.0).abs() < 1e-12 && (extent.range_m[1] + 8.0).abs() < 1e-12);
    }
}
