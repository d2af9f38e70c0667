//! Paths of small parts that meshes lack, each a point fixed to its body.

use crate::frame::cells::path_cells::{motions, padded};
use crate::frame::path_plan::Plan;
use crate::joins::scatterer::Scatterer;
use crate::joins::small_parts::{SmallScatterer, small_scatterers};
use artifact::paths::{Curve, Path};
use artifact::settings::SmallParts;
use artifact::units::amplitude_ratio;

/// Paths of the small parts drawn on what both ends see at the frame's middle; none unless requested.
pub(crate) fn small_part_paths(scatterer: &Scatterer<'_>, plan: &Plan<'_>) -> Vec<Path> {
    if plan.header.fidelity.small_parts == SmallParts::OfMesh {
        return Vec::new();
    }
    let settings = plan.meetings();
    let joints = scatterer.joints(1, settings.nodes, settings.least_area_m2);
    let small = small_scatterers(scatterer, &joints, (plan.header.seed, settings.wavenumber_per_m));
    small.iter().map(|part| path_of(scatterer, part, plan.middle_s)).collect()
}

/// Path of a scatterer in its state some `seconds` after the frame's first sample.
fn path_of(scatterer: &Scatterer<'_>, part: &SmallScatterer, seconds: f64) -> Path {
    let facet = scatterer.world.facet(scatterer.trees.transmit().beams[part.beams[0] as usize].facet).id;
    let [motion, _] = motions(scatterer, part.beams[0], part.beams[1], part.at_m);
    let (at_m, mps) = motion.after(part.at_m, -seconds);
    let acceleration_mps2 = motion.acceleration_mps2.to_array();
    let curve = Curve {
        apparent_tx_mps2: acceleration_mps2,
        apparent_rx_mps2: acceleration_mps2,
        ..Curve::default()
    };
    let point = Path::of_point(at_m.to_array(), mps.to_array(), part.amplitude_m);
    Path { target: facet.body, order: 1, facets: padded(&[facet]), curve, ..point }
}

/// Ratio of the paths' power, with independent phases, to a power |S|² over the frame, as an amplitude.
pub(crate) fn relative_to(power_m2: f64, small: &[Path], plan: &Plan<'_>) -> f64 {
    let (view, reception) = (plan.check_view(), plan.reception());
    let (p, q) = reception.element;
    let of_path = |path: &Path| {
        let (spread, _) = view.spread_and_length_m(path);
        (reception.gains.of_path(path) * spread).powi(2) * path.amplitude_m[p][q].norm_sqr()
    };
    amplitude_ratio(small.iter().map(of_path).sum(), power_m2)
}
