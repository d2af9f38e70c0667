//! Receivers behind the lit side of a body.

use bart_rcs::{RcsRequest, Standpoint};

/// Remark on a bistatic table whose receiver is more than a right angle from the transmitter: currents on lit
/// facets that face away from the receiver radiate towards it too, and are neglected.
pub(crate) fn remark(request: &RcsRequest) -> Option<String> {
    let widest_deg = widest_bistatic_angle_deg(request)?;
    (widest_deg > 90.0 + 1e-9).then(|| {
        format!(
            "note: the bistatic angle is {widest_deg:.0}° at most: forward scattering, the field that makes a \
             body's shadow, is not modelled. Beyond 90° S has only the facets that both antennas see, and no \
             printed error tells of the others (docs/bart.md §11)"
        )
    })
}

/// Greatest angle between transmitter and receiver, seen from the body's origin; `None` if the receiver is
/// the transmitter.
fn widest_bistatic_angle_deg(request: &RcsRequest) -> Option<f64> {
    let receiver = request.receiver?.direction();
    let aspects = request
        .elevation_rad
        .iter()
        .flat_map(|elevation| request.azimuth_rad.iter().map(move |azimuth| (*azimuth, *elevation)));
    let cosines = aspects.map(|(azimuth_rad, elevation_rad)| {
        let transmitter = Standpoint { azimuth_rad, elevation_rad, range_m: request.range_m };
        transmitter.direction().dot(receiver)
    });
    cosines.reduce(f64::min).map(|cosine| cosine.clamp(-1.0, 1.0).acos().to_degrees())
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
            remark(&RcsRequest { receiver: Some(receiver), ..request })
        };
        assert_eq!(seen_from(90.0), None);
        let told = seen_from(180.0).unwrap();
        assert!(told.contains("bistatic angle is 180°") && told.contains("forward scattering"), "{told}");
        assert_eq!(remark(&RcsRequest::over(vec![77e9], vec![0.0], vec![3.0])), None);
    }
}
