//! Evaluation boards: their antennas, data lanes and bands.

use crate::devices::{Board, Lanes};
use radar::aperture::Elements;
use std::ops::RangeInclusive;

/// Band of a family: the start frequencies of its chirps, and the unit of its frequency codes.
pub(super) struct Band {
    /// Lowest and highest frequency, GHz.
    pub(super) ghz: RangeInclusive<f64>,
    /// Unit of a start frequency's code, GHz.
    pub(super) start_step_ghz: f64,
    /// Unit of a slope's code, MHz/µs.
    pub(super) slope_step_mhz_per_us: f64,
}

impl Board {
    /// The board of a chip named in a log: `AR1642`, `XWR6843`.
    pub(super) fn of_chip(name: &str) -> Option<Self> {
        let digits: String = name.chars().filter(char::is_ascii_digit).collect();
        match digits.as_str() {
            "1243" => Some(Self::Xwr1243),
            "1443" => Some(Self::Xwr1443),
            "1642" => Some(Self::Xwr1642),
            "1843" => Some(Self::Xwr1843),
            "6843" => Some(Self::Xwr6843),
            "2243" => Some(Self::Awr2243),
            _ => None,
        }
    }

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xwr1243 => "xwr1243",
            Self::Xwr1443 => "xwr1443",
            Self::Xwr1642 => "xwr1642",
            Self::Xwr1843 => "xwr1843",
            Self::Xwr6843 => "xwr6843",
            Self::Awr2243 => "awr2243",
        }
    }

    /// Transmit and receive elements by their numbers, in half wavelengths of the band's middle: receivers
    /// half a wavelength apart; TX1 and the last transmitter two wavelengths apart in their row; with three
    /// transmitters, TX2 in the middle and half a wavelength higher (user's guides of the boards: SPRUIM4,
    /// SWRU507, SWRU521, SWRU546).
    pub(super) fn elements(self) -> [Elements; 2] {
        let receivers = radar::aperture::row(4, 1.0);
        match self {
            Self::Xwr1642 => [radar::aperture::row(2, 4.0), receivers],
            Self::Xwr1243 | Self::Xwr1443 | Self::Xwr1843 | Self::Xwr6843 | Self::Awr2243 => {
                [vec![[0.0, 0.0], [2.0, 1.0], [4.0, 0.0]], receivers]
            }
        }
    }

    /// Number of lanes for recording by a DCA1000EVM (SWRA581, data formats of the DCA1000).
    pub(super) fn lanes(self) -> Lanes {
        match self {
            Self::Xwr1243 | Self::Xwr1443 | Self::Awr2243 => Lanes::Four,
            Self::Xwr1642 | Self::Xwr1843 | Self::Xwr6843 => Lanes::Two,
        }
    }

    /// Noise figure in dB for chirps up to a frequency, with its data sheet: typical values of the table "RF
    /// Specification", for a 77 GHz device by its two oscillators, below 77 GHz and above.
    pub(super) fn noise_figure(self, highest_ghz: f64) -> (f64, &'static str) {
        let ([below, above], sheet) = match self {
            Self::Xwr1243 => ([14.0, 15.0], "SWRS188"),
            Self::Xwr1443 => ([14.0, 15.0], "SWRS202"),
            Self::Xwr1642 => ([14.0, 15.0], "SWRS203"),
            Self::Xwr1843 => ([14.0, 15.0], "SWRS222"),
            Self::Awr2243 => ([12.0, 13.0], "SWRS223"),
            Self::Xwr6843 => ([12.0, 12.0], "SWRS219"),
        };
        (if highest_ghz > 77.0 { above } else { below }, sheet)
    }

    /// Frequency codes count 3.6 GHz/2²⁶ for a 77 GHz device and 2.7 GHz/2²⁶ for a 60 GHz one, slopes 900
    /// times that per microsecond (mmWave radar interface control document, profile configuration).
    pub(super) fn band(self) -> Band {
        let of = |ghz, oscillator_ghz: f64| {
            let start_step_ghz = oscillator_ghz / f64::from(1 << 26);
            Band { ghz, start_step_ghz, slope_step_mhz_per_us: 900.0 * 1e3 * start_step_ghz }
        };
        match self {
            Self::Xwr6843 => of(57.0..=64.0, 2.7),
            _ => of(76.0..=81.0, 3.6),
        }
    }
}
