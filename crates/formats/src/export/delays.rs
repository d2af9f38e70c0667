//! Delay of a path for tables.

use artifact::Radar;
use artifact::paths::Path;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;

/// Delay and its rate (s/s) at the array's centre at the frame's middle; `radar` is that of the frame's own
/// sub-frame ([`Radar::in_frame`]).
pub fn delay_at_middle(radar: &Radar, path: &Path) -> (f64, f64) {
    let centre = DVec3::from(radar.position_m);
    let middle_s = radar.frame_middle_s();
    let leg = |x: [f64; 3], v: [f64; 3], a: [f64; 3]| {
        let gained = DVec3::from(a) * middle_s;
        let velocity = DVec3::from(v) + gained;
        let away = DVec3::from(x) + (velocity - 0.5 * gained) * middle_s - centre;
        (away.length(), away.dot(velocity) / away.length())
    };
    let (there_m, there_mps) = leg(path.apparent_tx_m, path.apparent_tx_mps, path.curve.apparent_tx_mps2);
    let (back_m, back_mps) = leg(path.apparent_rx_m, path.apparent_rx_mps, path.curve.apparent_rx_mps2);
    ((there_m + back_m) / SPEED_OF_LIGHT_MPS, (there_mps + back_mps) / SPEED_OF_LIGHT_MPS)
}
