//! Receivers behind the lit side of a body.

use artifact::scene::Mesh;
use bart_rcs::{RcsRequest, Standpoint};
use glam::DVec3;

/// Remark on a bistatic table whose receiver is more than a right angle from the transmitter: currents on lit
/// facets that face away from the receiver radiate towards it too, and are neglected.
pub(crate) fn remark(request: &RcsRequest, mesh: &Mesh) -> Option<String> {
    let [low_m, high_m] = mesh.bounds_m().map(DVec3::from_array);
    let widest_deg = widest_bistatic_angle_deg(request, 0.5 * (low_m + high_m))?;
    (widest_deg > 90.0 + 1e-9).then(|| {
        format!(
            "note: the bistatic angle is {widest_deg:.0}° at most: forward scattering, the field that makes a \
             body's shadow, is not modelled. Beyond 90° S has only the facets that both antennas see, and no \
             printed error tells of the others (docs/bart.md §11)"
        )
    })
}

/// Greatest angle between transmitter and receiver, seen from the body's centre; `None` if the receiver is
/// the transmitter.
fn widest_bistatic_angle_deg(request: &RcsRequest, centre_m: DVec3) -> Option<f64> {
    let receiver = seen_from(centre_m, &request.receiver?);
    let aspects = request
        .elevation_rad
        .iter()
        .flat_map(|elevation| request.azimuth_rad.iter().map(move |azimuth| (*azimuth, *elevation)));
    let cosines = aspects.map(|(azimuth_rad, elevation_rad)| {
        let transmitter = Standpoint { azimuth_rad, elevation_rad, range_m: request.range_m };
        seen_from(centre_m, &transmitter).dot(receiver)
    });
    cosines.reduce(f64::min).map(|cosine| cosine.clamp(-1.0, 1.0).acos().to_degrees())
}

/// Unit vector from a place to an antenna; zero if the antenna is there.
fn seen_from(place_m: DVec3, antenna: &Standpoint) -> DVec3 {
    match antenna.range_m.is_finite() {
        true => (antenna.range_m * antenna.direction() - place_m).normalize_or_zero(),
        false => antenna.direction(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_receiver_behind_the_body_is_told_that_forward_scattering_is_left_out() {
        let seen_from = |azimuth_deg: f64| {
            let receiver =
                Standpoint { azimuth_rad: azimuth_deg.to_radians(), elevation_rad: 0.0, range_m: 10.0 };
            let request = RcsRequest::over(vec![24.1e9], vec![0.0], vec![0.0, 0.1]);
            remark(&RcsRequest { receiver: Some(receiver), ..request }, &plate(0.0))
        };
        assert_eq!(seen_from(90.0), None);
        let told = seen_from(180.0).unwrap();
        assert!(told.contains("bistatic angle is 180°") && told.contains("forward scattering"), "{told}");
        assert_eq!(remark(&RcsRequest::over(vec![77e9], vec![0.0], vec![3.0]), &plate(0.0)), None);
    }

    /// A square of 0.3 m across x.
    fn plate(x_m: f64) -> Mesh {
        let vertices_m =
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[y, z]| [x_m, 0.15 * y, 0.15 * z]);
        let triangles = vec![[0, 1, 2], [0, 2, 3]];
        Mesh { vertices_m: vertices_m.to_vec(), triangles, ..Mesh::default() }
    }

    #[test]
    fn a_body_away_from_its_origin_is_told_of_antennas_on_its_either_side() {
        let at = |range_m: f64| Standpoint { azimuth_rad: 0.0, elevation_rad: 0.0, range_m };
        let request = RcsRequest {
            range_m: 5.0,
            receiver: Some(at(15.0)),
            ..RcsRequest::over(vec![77e9], vec![0.0], vec![0.0])
        };
        assert!(remark(&request, &plate(10.0)).is_some_and(|told| told.contains("bistatic angle is 180°")));
        assert_eq!(remark(&request, &plate(0.0)), None);
    }
}
