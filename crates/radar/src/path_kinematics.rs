//! Apparent place of a path's node in the frame's middle, seen from the radar's position, and the share of
//! the frame that the path stands for.

use artifact::paths::Path;
use artifact::radar::Radar;
use glam::DVec3;

/// The one-way leg from an antenna to a node as it appears from there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// Length of the leg, m.
    pub length_m: f64,
    /// Rate of change of the length, m/s: positive where it grows.
    pub rate_mps: f64,
    /// Unit vector away from the radar.
    pub direction: DVec3,
}

/// The legs from the transmitter and from the receiver in the frame's middle; of a wheel those of its hub.
pub fn legs(radar: &Radar, path: &Path) -> [Leg; 2] {
    let curve = &path.curve;
    [
        leg(radar, path.apparent_tx_m, path.apparent_tx_mps, curve.apparent_tx_mps2),
        leg(radar, path.apparent_rx_m, path.apparent_rx_mps, curve.apparent_rx_mps2),
    ]
}

/// Mean over the frame of a path's share of the echo: 1 where it stands for all of it.
pub fn mean_share(radar: &Radar, path: &Path) -> f64 {
    const INSTANTS: u32 = 128;
    let Some(span) = path.curve.span else { return 1.0 };
    let seconds = |i: u32| (f64::from(i) + 0.5) / f64::from(INSTANTS) * radar.frame_duration_s();
    (0..INSTANTS).map(|i| span.share(seconds(i))).sum::<f64>() / f64::from(INSTANTS)
}

fn leg(radar: &Radar, apparent_m: [f64; 3], apparent_mps: [f64; 3], apparent_mps2: [f64; 3]) -> Leg {
    let middle_s = radar.frame_middle_s();
    let gained = DVec3::from(apparent_mps2) * middle_s;
    let velocity = DVec3::from(apparent_mps) + gained;
    let at_middle = DVec3::from(apparent_m) + (velocity - 0.5 * gained) * middle_s;
    let away = at_middle - DVec3::from(radar.position_m);
    let length_m = away.length();
    Leg { length_m, rate_mps: away.dot(velocity) / length_m, direction: away / length_m }
}
