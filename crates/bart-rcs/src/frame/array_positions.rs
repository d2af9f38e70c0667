//! Positions on the array: the row along which paths are traced, and the pairs of elements with which a
//! frame's paths are checked.

use crate::bodies::motion::RigidMotion;
use artifact::Radar;
use artifact::paths::ArraySpan;
use artifact::scene::Pose;
use glam::{DMat3, DVec3};
use radar::aperture::axes;

/// Row of elements along which an array is widest, relative to the radar's position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ArrayRow {
    /// Unit vector along the row, world.
    pub(crate) axis: DVec3,
    /// Maximum distance of the row's elements, or of the midpoints of their pairs, from the radar's position
    /// along it.
    pub(crate) half_m: f64,
    pub(crate) ends: RowEnds,
}

/// Elements that form a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RowEnds {
    /// The transmitters; all receivers are near the radar's position.
    Transmitters,
    /// The receivers.
    Receivers,
    /// Both ends: the midpoint of a transmitter and a receiver counts.
    Both,
}

/// Ratio of widths from which only the wider row is traced.
const WIDER: f64 = 2.0;

impl RowEnds {
    /// Factors by which transmitter and receiver move with a position along the row.
    pub(crate) fn moves(self) -> [f64; 2] {
        match self {
            Self::Transmitters => [1.0, 0.0],
            Self::Receivers => [0.0, 1.0],
            Self::Both => [1.0, 1.0],
        }
    }

    /// Weights of the transmitter's and the receiver's position in a position along the row.
    pub(crate) fn weights(self) -> [f64; 2] {
        match self {
            Self::Both => [0.5, 0.5],
            _ => self.moves(),
        }
    }
}

impl ArrayRow {
    /// Row of a scene's array.
    pub(crate) fn of(radar: &Radar) -> Self {
        let [right, _ahead, up] = axes(radar);
        let [across, upright] = [right, up].map(|axis| Self::along(axis, radar));
        if upright.half_m > across.half_m { upright } else { across }
    }

    fn along(axis: DVec3, radar: &Radar) -> Self {
        let centre = DVec3::from_array(radar.position_m);
        let half = |elements: &[[f64; 3]]| {
            let away = elements.iter().map(|m| axis.dot(DVec3::from_array(*m) - centre).abs());
            away.fold(0.0, f64::max)
        };
        let [tx, rx] = [half(&radar.array.tx_m), half(&radar.array.rx_m)];
        let (half_m, ends) = match (tx, rx) {
            _ if tx > WIDER * rx => (tx, RowEnds::Transmitters),
            _ if rx > WIDER * tx => (rx, RowEnds::Receivers),
            _ => (0.5 * (tx + rx), RowEnds::Both),
        };
        Self { axis, half_m, ends }
    }

    /// Part of the array represented by one place of a grid, relative to the radar's position.
    pub(super) fn span(&self, position_m: DVec3, (place, steps): (u32, u32)) -> ArraySpan {
        let [transmit, receive] = self.ends.weights().map(|weight| (weight * self.axis).to_array());
        let step_m = 2.0 * self.half_m / f64::from(steps);
        let first_m = position_m.dot(self.axis) - self.half_m;
        ArraySpan { transmit, receive, first_m, step_m, places: steps + 1, place }
    }
}

/// Share of their root mean square by which distances from the radar's position may differ and still count as
/// equal.
const SAME_DISTANCE_SHARE: f64 = 0.1;
/// Minimum ratio by which a pair must show more change to be preferred to the first one.
const MORE: f64 = 1.01;
/// Distance below which elements see the same of a body, which is then traced only from their midpoint: half
/// the work. Not so in the cross polarization, which may consist mostly of the rotation of a wave from one
/// element to the other.
const TOGETHER_M: f64 = 0.05;
/// Distance below which elements count as coincident.
const ONE_PLACE_M: f64 = 1e-6;

/// Transmitter and receiver of the array with which a frame's paths are checked: among pairs whose midpoint
/// is about as far from the radar's position as the root mean square over all pairs, and which are equally
/// far apart. As with time, errors proportional to a distance are there as large as over the whole array.
///
/// Of such pairs, the one is taken that sees, at the moment of the check, the largest change of aspect of the
/// bodies relative to the array's centre at the frame's middle: from an element that a body passes at its own
/// pace nothing would seem to change. If the elements are near each other both are placed at their midpoint.
///
/// In the cross polarization each end is as far off as the root mean square of its own elements: for the most
/// frequent separation one end would be at the centre, where the effect of its distance vanishes.
///
/// For a wide array a second pair is returned, on the other side, since what its ends see differs by more
/// than one pair reveals.
pub(super) fn checked_from_m(
    radar: &Radar,
    poses: &[Pose],
    [middle_s, check_s]: [f64; 2],
) -> ([DVec3; 2], Option<[DVec3; 2]>) {
    let centre_m = DVec3::from_array(radar.position_m);
    let pairs_m = pairs_m(radar);
    let rms = |of: &dyn Fn(&[DVec3; 2]) -> f64| {
        (pairs_m.iter().map(|pair| of(pair).powi(2)).sum::<f64>() / pairs_m.len().max(1) as f64).sqrt()
    };
    let away_m = |pair: &[DVec3; 2]| middle_m(pair).distance(centre_m);
    let apart_m = |pair: &[DVec3; 2]| pair[0].distance(pair[1]);
    let [away_rms_m, apart_rms_m] = [rms(&away_m), rms(&apart_m)];
    let of_ends_m = [0, 1].map(|end| rms(&|pair: &[DVec3; 2]| pair[end].distance(centre_m)));
    let (sent, heard) = radar.array.polarization.indices();
    let is_wide = apart_rms_m > if sent == heard { TOGETHER_M } else { ONE_PLACE_M };
    let miss = |pair: &[DVec3; 2]| {
        if sent != heard {
            return [0, 1].map(|end| (pair[end].distance(centre_m) - of_ends_m[end]).abs()).iter().sum();
        }
        let of_distance = if is_wide { (apart_m(pair) - apart_rms_m).abs() } else { 0.0 };
        (away_m(pair) - away_rms_m).abs() + of_distance
    };
    let least = pairs_m.iter().map(miss).fold(f64::INFINITY, f64::min);
    let alike = pairs_m.iter().copied().filter(|pair| miss(pair) <= least + SAME_DISTANCE_SHARE * away_rms_m);
    let turned = |pair: &[DVec3; 2]| -> f64 {
        poses.iter().map(|pose| turned(pose, [(centre_m, middle_s), (middle_m(pair), check_s)])).sum()
    };
    let more =
        |best: [DVec3; 2], pair: [DVec3; 2]| if turned(&pair) > MORE * turned(&best) { pair } else { best };
    let pair = alike.reduce(more).unwrap_or([centre_m; 2]);
    if !is_wide {
        return ([middle_m(&pair); 2], None);
    }
    let opposite_m = 2.0 * centre_m - middle_m(&pair);
    let away = |pair: &[DVec3; 2]| middle_m(pair).distance(opposite_m) + miss(pair);
    (pair, pairs_m.iter().copied().min_by(|a, b| away(a).total_cmp(&away(b))))
}

fn middle_m([tx_m, rx_m]: &[DVec3; 2]) -> DVec3 {
    0.5 * (*tx_m + *rx_m)
}

fn pairs_m(radar: &Radar) -> Vec<[DVec3; 2]> {
    let of_tx = |tx: &[f64; 3]| {
        let pair = |rx: &[f64; 3]| [DVec3::from_array(*tx), DVec3::from_array(*rx)];
        radar.array.rx_m.iter().map(pair).collect::<Vec<_>>()
    };
    radar.array.tx_m.iter().flat_map(of_tx).collect()
}

/// Square of the angle between a body's aspects from two positions at two moments, over that of its distance:
/// near bodies contribute most of the echo.
fn turned(pose: &Pose, views: [(DVec3, f64); 2]) -> f64 {
    let [(from, near_m), (to, _)] = views.map(|(place_m, seconds)| {
        let away_m = place_m - RigidMotion::of(pose, seconds).origin_m;
        let body_from_world = DMat3::from_rotation_z(-(pose.yaw_rad + pose.yaw_radps * seconds));
        (body_from_world * away_m.normalize_or_zero(), away_m.length())
    });
    from.distance_squared(to) / near_m.max(f64::MIN_POSITIVE).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::radar::Polarization;
    use radar::aperture::Preset;
    use radar::paper;

    fn pose(vx_mps: f64) -> Pose {
        Pose {
            position_m: [0.0, 20.0, 0.0],
            yaw_rad: 0.0,
            yaw_radps: 0.0,
            velocity_mps: [vx_mps, 0.0, 0.0],
            acceleration_mps2: [0.0; 3],
        }
    }

    fn radar(array: Preset) -> Radar {
        paper::radar([0.0, 0.0, 6.0], paper::waveform(256, 128), array.elements())
    }

    fn checked_m(array: Preset, poses: &[Pose]) -> [DVec3; 2] {
        checked_from_m(&radar(array), poses, [5e-3, 8e-3]).0
    }

    #[test]
    fn the_row_of_an_array_is_where_it_is_widest_across_or_upright() {
        let across = ArrayRow::of(&radar(Preset::TwelveBySixteen));
        let upright =
            |elements: [Vec<[f64; 2]>; 2]| elements.map(|e| e.iter().map(|[x, y]| [*y, *x]).collect());
        let turned = upright(Preset::TwelveBySixteen.elements());
        let turned = ArrayRow::of(&paper::radar([0.0, 0.0, 6.0], paper::waveform(256, 128), turned));
        assert!(across.axis.x.abs() > 0.999 && turned.axis.z.abs() > 0.999, "{across:?}, {turned:?}");
        assert!((across.half_m - turned.half_m).abs() < 1e-9 && across.ends == turned.ends);
    }

    /// A body that moves to the right shows its left side: more of it from an element left of the centre, the
    /// former aspect from one to the right, which it passes at its own pace.
    #[test]
    fn a_frame_is_checked_from_the_side_that_its_bodies_leave() {
        for array in [Preset::ThreeByFour, Preset::TwelveBySixteen] {
            for vx_mps in [3.0, -3.0] {
                let place_m = middle_m(&checked_m(array, &[pose(vx_mps)]));
                assert!(place_m.x * vx_mps < 0.0, "{vx_mps} m/s: {place_m}");
            }
            assert_eq!(checked_m(array, &[pose(0.0)]), checked_m(array, &[]), "the first of those alike");
        }
    }

    #[test]
    fn a_wide_array_is_checked_with_a_pair_that_is_as_far_apart_as_most() {
        let [tx_m, rx_m] = checked_m(Preset::ThreeByFour, &[]);
        assert_eq!(tx_m, rx_m, "elements of 23 mm stand together");
        let [tx_m, rx_m] = checked_m(Preset::TwelveBySixteen, &[]);
        // Transmitters 16 half wavelengths apart: 12 of them are 101 mm rms from receivers around the centre.
        assert!((0.08..0.13).contains(&tx_m.distance(rx_m)), "{}", tx_m.distance(rx_m));
        let (first, second) = checked_from_m(&radar(Preset::TwelveBySixteen), &[], [5e-3, 8e-3]);
        let [first, second] = [first, second.unwrap()].map(|pair| middle_m(&pair).x);
        assert!(first * second < 0.0 && (first + second).abs() < 0.02, "{first} and {second} m");
    }

    #[test]
    fn a_cross_polarized_array_is_checked_with_a_pair_however_narrow_it_is() {
        let pairs_m = |array: Preset| {
            let mut radar = radar(array);
            radar.array.polarization = Polarization::Vh;
            checked_from_m(&radar, &[], [5e-3, 8e-3])
        };
        let ([tx_m, rx_m], second) = pairs_m(Preset::ThreeByFour);
        assert!(tx_m != rx_m && second.is_some());
        assert_eq!(pairs_m(Preset::OneByOne).1, None, "one element is one place");
    }

    #[test]
    fn ways_are_traced_along_the_wider_row() {
        let half_wavelength_m = 1.93e-3;
        let row = ArrayRow::of(&radar(Preset::TwelveBySixteen));
        assert_eq!(row.ends, RowEnds::Transmitters);
        assert!((row.half_m / half_wavelength_m - 88.0).abs() < 1.0 && row.axis.x.abs() > 0.999);
    }
}
