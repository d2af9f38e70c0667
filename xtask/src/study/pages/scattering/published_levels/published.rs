//! Published levels of a car: 3GPP TR 38.901 (Release 19), Table 7.9.2.1-4, monostatic, as in NIST's public
//! channel model (`getSigmaRCS.m`, 2025).

/// Faces of a car to which an aspect is assigned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sector {
    Front,
    Sides,
    Rear,
}

pub(super) const SECTORS: [Sector; 3] = [Sector::Front, Sector::Sides, Sector::Rear];

impl Sector {
    /// Sector of an azimuth from the front: each extends 45° to either side of its face.
    pub(super) fn of(azimuth_deg: f64) -> Self {
        match from_front_deg(azimuth_deg) {
            ..45.0 => Self::Front,
            45.0..135.0 => Self::Sides,
            _ => Self::Rear,
        }
    }
}

/// Lobe of a face: its middle and width at 3 dB in azimuth and zenith angle, degrees, its level in dBsm and
/// its largest decrease, dB.
struct Lobe {
    azimuth_deg: [f64; 2],
    zenith_deg: [f64; 2],
    level_dbsm: f64,
    most_db: f64,
}

fn lobe(sector: Sector) -> Lobe {
    let of =
        |azimuth_deg, zenith_deg, level_dbsm, most_db| Lobe { azimuth_deg, zenith_deg, level_dbsm, most_db };
    match sector {
        Sector::Front => of([0.0, 40.54], [71.75, 29.13], 15.52, 8.45),
        Sector::Sides => of([90.0, 26.90], [79.70, 44.42], 20.75, 13.68),
        Sector::Rear => of([180.0, 36.32], [79.65, 36.73], 14.56, 7.50),
    }
}

/// Level of a car at an aspect, dBsm: that of its face, reduced by the angle between the aspect and the
/// face's middle.
pub(super) fn published_dbsm(azimuth_deg: f64, elevation_deg: f64) -> f64 {
    let lobe = lobe(Sector::of(azimuth_deg));
    let fall = |at_deg: f64, [middle_deg, width_deg]: [f64; 2]| {
        (12.0 * ((at_deg - middle_deg) / width_deg).powi(2)).min(lobe.most_db)
    };
    let falls =
        fall(90.0 - elevation_deg, lobe.zenith_deg) + fall(from_front_deg(azimuth_deg), lobe.azimuth_deg);
    lobe.level_dbsm - falls.min(lobe.most_db)
}

/// Angle from the front, 0 to 180 degrees.
fn from_front_deg(azimuth_deg: f64) -> f64 {
    let around = azimuth_deg.rem_euclid(360.0);
    around.min(360.0 - around)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_has_its_level_in_the_middle_of_its_lobe_and_the_floor_off_it() {
        for (azimuth_deg, zenith_deg, dbsm) in
            [(0.0, 71.75, 15.52), (90.0, 79.70, 20.75), (270.0, 79.70, 20.75), (180.0, 79.65, 14.56)]
        {
            assert!((published_dbsm(azimuth_deg, 90.0 - zenith_deg) - dbsm).abs() < 1e-9, "{azimuth_deg}");
        }
        // Half a width off the middle is 3 dB down, far off the floor of 7.07 dBsm.
        assert!((published_dbsm(90.0 + 13.45, 10.3) - 17.75).abs() < 1e-6);
        assert!((published_dbsm(-50.0, 10.3) - 7.07).abs() < 1e-6);
    }
}
