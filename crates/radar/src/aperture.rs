//! Positions of an antenna's elements and its orientation: aperture axes, rows of elements, mounting.

use artifact::radar::{Array, Radar};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Elements in half wavelengths, [right, up] as seen along the boresight.
pub type Elements = Vec<[f64; 2]>;

/// Unit vectors to the right (horizontal), ahead along the boresight, and up, for a boresight azimuth (from
/// +y towards +x) and elevation (above the horizon), rad.
pub fn boresight_axes(azimuth_rad: f64, elevation_rad: f64) -> [DVec3; 3] {
    let [x, y] = horizontal(azimuth_rad);
    let (sin_el, cos_el) = elevation_rad.sin_cos();
    let right = DVec3::new(y, -x, 0.0);
    let ahead = DVec3::new(x * cos_el, y * cos_el, sin_el);
    [right, ahead, right.cross(ahead)]
}

/// Horizontal unit vector, [x, y], towards an azimuth counted from +y towards +x, rad.
pub fn horizontal(azimuth_rad: f64) -> [f64; 2] {
    let (x, y) = azimuth_rad.sin_cos();
    [x, y]
}

/// Yaw of a radar's boresight, counted like that of bodies from +x towards +y, rad.
pub fn boresight_yaw_rad(radar: &Radar) -> f64 {
    FRAC_PI_2 - radar.boresight_az_rad
}

/// Aperture axes of a radar: right, ahead, up.
pub fn axes(radar: &Radar) -> [DVec3; 3] {
    boresight_axes(radar.boresight_az_rad, radar.boresight_el_rad)
}

/// Amplitude gain of an element towards a unit direction, relative to boresight; `axes` are those of the
/// radar ([`axes`]).
pub fn pattern_amplitude(radar: &Radar, axes: &[DVec3; 3], direction: DVec3) -> f64 {
    radar.array.pattern.amplitude(axes.map(|axis| axis.dot(direction)))
}

/// A horizontal row of `count` elements with equal `spacing` in half wavelengths.
pub fn row(count: u8, spacing: f64) -> Elements {
    (0..count).map(|i| [f64::from(i) * spacing, 0.0]).collect()
}

/// Two columns by four rows at 0, 1, 4, 6 half wavelengths: a Golomb ruler, all differences from 1 to 6
/// (physics.md §7).
pub fn golomb_rows() -> Elements {
    [0.0, 1.0, 4.0, 6.0].iter().flat_map(|up| [[0.0, *up], [1.0, *up]]).collect()
}

/// A named array, transmit by receive elements (physics.md §7).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// One transmitter, one receiver.
    OneByOne,
    /// One transmitter, a row of four receivers.
    OneByFour,
    /// Three transmitters by four receivers, a filled virtual row of twelve: the array of the paper.
    ThreeByFour,
    /// Six transmitters by two columns of four receivers, which also resolve elevation.
    SixByEight,
    /// Twelve transmitters by sixteen receivers, a filled virtual row of 192.
    TwelveBySixteen,
}

impl Preset {
    /// All presets with their names, from the smallest to the largest.
    pub const ALL: [(&str, Self); 5] = [
        ("1x1", Self::OneByOne),
        ("1x4", Self::OneByFour),
        ("3x4", Self::ThreeByFour),
        ("6x8", Self::SixByEight),
        ("12x16", Self::TwelveBySixteen),
    ];

    /// Transmit and receive elements.
    pub fn elements(self) -> [Elements; 2] {
        match self {
            Self::OneByOne => [row(1, 1.0), row(1, 1.0)],
            Self::OneByFour => [row(1, 1.0), row(4, 1.0)],
            Self::ThreeByFour => [row(3, 4.0), row(4, 1.0)],
            Self::SixByEight => [row(6, 2.0), golomb_rows()],
            Self::TwelveBySixteen => [row(12, 16.0), row(16, 1.0)],
        }
    }
}

/// World positions of a row's elements, m; their mean, the row's phase centre, is at the radar's position.
pub fn world_positions_m(radar: &Radar, elements: &[[f64; 2]]) -> Vec<[f64; 3]> {
    let [right, _, up] = axes(radar);
    let half_wavelength_m = 0.5 * radar.waveform.wavelength_m();
    let count = elements.len().max(1) as f64;
    let mean = |axis: usize| elements.iter().map(|element| element[axis]).sum::<f64>() / count;
    let centre = [mean(0), mean(1)];
    let in_plane = |e: &[f64; 2]| right * (e[0] - centre[0]) + up * (e[1] - centre[1]);
    elements
        .iter()
        .map(|e| (DVec3::from(radar.position_m) + in_plane(e) * half_wavelength_m).into())
        .collect()
}

/// Radar with its elements placed according to position, boresight, wavelength and the element positions in
/// half wavelengths.
pub fn mounted(radar: Radar) -> Radar {
    let array = Array {
        tx_m: world_positions_m(&radar, &radar.array.tx_half_wavelengths),
        rx_m: world_positions_m(&radar, &radar.array.rx_half_wavelengths),
        ..radar.array.clone()
    };
    Radar { array, ..radar }
}

/// The same radar at another height (m) and tilt (rad above the horizon), with its elements placed anew.
pub fn remounted(radar: &Radar, height_m: f64, boresight_el_rad: f64) -> Radar {
    let [x_m, y_m, _] = radar.position_m;
    mounted(Radar { position_m: [x_m, y_m, height_m], boresight_el_rad, ..radar.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    #[test]
    fn the_axes_are_right_handed_and_follow_azimuth_and_elevation() {
        let near = |a: DVec3, b: [f64; 3]| assert!((a - DVec3::from(b)).length() < 1e-15, "{a} {b:?}");
        let [right, ahead, up] = boresight_axes(0.0, 0.0);
        near(right, [1.0, 0.0, 0.0]);
        near(ahead, [0.0, 1.0, 0.0]);
        near(up, [0.0, 0.0, 1.0]);
        // Looking towards +x, and 45° up: the up axis leans back towards −x.
        let [right, ahead, up] = boresight_axes(FRAC_PI_2, FRAC_PI_4);
        let half = 0.5_f64.sqrt();
        near(right, [0.0, -1.0, 0.0]);
        near(ahead, [half, 0.0, half]);
        near(up, [-half, 0.0, half]);
    }

    #[test]
    fn the_virtual_rows_of_the_presets_are_filled_or_golomb() {
        let virtual_places = |preset: Preset, axis: usize| -> Vec<i64> {
            let [tx, rx] = preset.elements();
            let sums = tx.iter().flat_map(|t| rx.iter().map(move |r| (t[axis] + r[axis]) as i64));
            let mut places: Vec<i64> = sums.collect();
            places.sort_unstable();
            places.dedup();
            places
        };
        assert_eq!(virtual_places(Preset::ThreeByFour, 0), (0..12).collect::<Vec<_>>());
        assert_eq!(virtual_places(Preset::TwelveBySixteen, 0), (0..192).collect::<Vec<_>>());
        assert_eq!(virtual_places(Preset::SixByEight, 0), (0..12).collect::<Vec<_>>());
        assert_eq!(virtual_places(Preset::SixByEight, 1), [0, 1, 4, 6]);
    }
}
