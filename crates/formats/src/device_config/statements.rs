//! Commands of both kinds of configuration files, and conversion of their arguments to numbers.

use crate::devices::{Board, IqOrder, Lanes};
use artifact::radar::Sampling;

/// Rule that a configuration breaks, with its line from 1 if it has one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) line: Option<usize>,
    pub(super) rule: String,
}

/// A command with its line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Statement {
    pub(super) line: usize,
    /// Name as written in the file.
    pub(super) name: &'static str,
    pub(super) setting: Setting,
}

/// Meaning of a command.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Setting {
    /// A reset: earlier commands do not count.
    Flush,
    Board(Board),
    /// Board that a comment names, and what it calls it.
    Platform(Platform),
    /// Transmitters and receivers that are switched on, bit by bit.
    Channels {
        transmitters: u32,
        receivers: u32,
    },
    Converter {
        bits: u32,
        sampling: Sampling,
    },
    Order(IqOrder),
    /// Samples of the converter that are passed on.
    Buffer(Sampling),
    /// Words between the samples of a recording.
    Stream(Option<&'static str>),
    Lanes(Lanes),
    Profile(Profile),
    Chirps(Chirps),
    Frame(Frame),
}

/// Board that the comment of a generator names (`% Platform:xWR68xx`).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Platform {
    pub(super) name: String,
    /// Digits of the family that it names: `68` of `xWR68xx_AOP`.
    pub(super) family: String,
    /// Whether its antennas are in or on the package.
    pub(super) is_on_package: bool,
}

impl Platform {
    pub(super) fn of(name: &str) -> Self {
        let family = name.chars().skip_while(|c| !c.is_ascii_digit()).take_while(char::is_ascii_digit);
        let upper = name.to_ascii_uppercase();
        let is_on_package = ["AOP", "ODS"].iter().any(|kind| upper.contains(kind));
        Self { name: name.to_owned(), family: family.collect(), is_on_package }
    }
}

/// Form of a chirp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Profile {
    pub(super) id: u32,
    /// Start frequency of the ramp.
    pub(super) start_ghz: f64,
    pub(super) idle_us: f64,
    /// Time from the beginning of the ramp to the first sample.
    pub(super) adc_start_us: f64,
    /// Time from the beginning of the ramp to its end.
    pub(super) ramp_end_us: f64,
    pub(super) slope_mhz_per_us: f64,
    pub(super) samples: u32,
    pub(super) rate_ksps: f64,
    /// Whether a transmitter has another phase than the others.
    pub(super) shifts_phases: bool,
}

impl Profile {
    /// Time from the beginning of the ramp to the end of the last sample.
    pub(super) fn sampled_until_us(&self) -> f64 {
        self.adc_start_us + 1e3 * f64::from(self.samples) / self.rate_ksps
    }

    /// Frequency at the end of the last sample.
    pub(super) fn last_sample_ghz(&self) -> f64 {
        self.start_ghz + 1e-3 * self.slope_mhz_per_us * self.sampled_until_us()
    }
}

/// Indices, from 0, of the arguments of a profile whose positions differ between file kinds.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProfileColumns {
    /// Index of the first of the transmitters' phases, and of the argument after the last.
    pub(super) phases: [usize; 2],
    pub(super) slope: usize,
    pub(super) samples: usize,
    pub(super) rate: usize,
}

/// Chirps with a common form and choice of transmitters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Chirps {
    pub(super) first: u32,
    pub(super) last: u32,
    pub(super) profile: u32,
    /// Active transmitters, as a bit mask.
    pub(super) transmitters: u32,
}

/// Chirps of a frame, repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub(super) first: u32,
    pub(super) last: u32,
    pub(super) loops: u32,
    /// Number of frames; 0: unlimited.
    pub(super) frames: u32,
    pub(super) period_ms: f64,
}

/// Largest number of chirps in a device.
pub(super) const CHIRPS_MAX: u32 = 512;

/// Arguments of a command.
pub(super) struct Arguments<'a> {
    pub(super) line: usize,
    pub(super) name: &'static str,
    pub(super) words: Vec<&'a str>,
}

impl Arguments<'_> {
    /// The command with these arguments.
    pub(super) fn statement(&self, setting: Setting) -> Statement {
        Statement { line: self.line, name: self.name, setting }
    }

    /// A rule that this command breaks.
    pub(super) fn fault(&self, rule: impl std::fmt::Display) -> Fault {
        Fault { line: Some(self.line), rule: format!("{}: {rule}", self.name) }
    }

    /// Refuses fewer arguments than the command has.
    pub(super) fn at_least(&self, count: usize) -> Result<(), Fault> {
        let found = self.words.len();
        if found >= count {
            Ok(())
        } else {
            Err(self.fault(format!("it has {count} numbers, {found} are here")))
        }
    }

    /// Refuses more arguments than the command has: they belong to another command of the same name.
    pub(super) fn at_most(&self, count: usize) -> Result<(), Fault> {
        let found = self.words.len();
        if found <= count {
            return Ok(());
        }
        Err(self
            .fault(format!("it has {count} numbers, {found} are here: those of other devices are not read")))
    }

    /// The argument at an index, from 0, as a number.
    pub(super) fn number(&self, index: usize, what: &str) -> Result<f64, Fault> {
        let word = self.words.get(index).copied().unwrap_or_default();
        let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| self.fault(format!("{what} is `{word}`, not a number")))
    }

    /// The argument at an index as a whole number up to `most`; `0x` begins hexadecimal digits.
    pub(super) fn whole(&self, index: usize, what: &str, most: u32) -> Result<u32, Fault> {
        let word = self.words.get(index).copied().unwrap_or_default();
        let number = match word.strip_prefix("0x") {
            Some(digits) => u32::from_str_radix(digits, 16).ok(),
            None => word.parse::<u32>().ok(),
        };
        number
            .filter(|number| *number <= most)
            .ok_or_else(|| self.fault(format!("{what} is `{word}`, not a whole number from 0 to {most}")))
    }

    /// Refuses a number that is not 0.
    pub(super) fn none(&self, index: usize, what: &str) -> Result<(), Fault> {
        match self.number(index, what)? {
            0.0 => Ok(()),
            other => {
                Err(self
                    .fault(format!("{what} is {other}: chirps that differ from their profile are not read")))
            }
        }
    }

    /// Meaning of the code of a converter's bits at an index, and of its format: real, complex, or complex
    /// with its image band.
    pub(super) fn converter(&self, bits: usize, format: u32) -> Result<Setting, Fault> {
        let bits = [12, 14, 16][self.whole(bits, "the converter's bits", 2)? as usize];
        let sampling = match format {
            0 => Sampling::Real,
            1 | 2 => Sampling::Complex,
            3 => return Err(self.fault("format 3, pseudo real, is not read: 0, real, and 1 and 2, complex")),
            other => return Err(self.fault(format!("the format of samples is {other}, not from 0 to 2"))),
        };
        Ok(Setting::Converter { bits, sampling })
    }

    /// Whether any of these arguments, phases of transmitters, is not 0.
    pub(super) fn shifts_phases(&self, words: std::ops::Range<usize>) -> Result<bool, Fault> {
        let mut shifts = false;
        for index in words {
            shifts |= self.number(index, "the phase of a transmitter")? != 0.0;
        }
        Ok(shifts)
    }

    /// A profile in the usual units, GHz, µs, MHz/µs and ksps.
    pub(super) fn profile(&self, columns: ProfileColumns) -> Result<Setting, Fault> {
        let number = |index, what| self.number(index, what);
        self.sound_profile(Profile {
            id: self.whole(0, "the profile's number", 3)?,
            start_ghz: number(1, "the start frequency")?,
            idle_us: number(2, "the idle time")?,
            adc_start_us: number(3, "the time of the first sample")?,
            ramp_end_us: number(4, "the ramp's end")?,
            slope_mhz_per_us: number(columns.slope, "the slope")?,
            samples: self.whole(columns.samples, "the number of samples", u32::from(u16::MAX))?,
            rate_ksps: number(columns.rate, "the sample rate")?,
            shifts_phases: self.shifts_phases(columns.phases[0]..columns.phases[1])?,
        })
    }

    /// Refuses a form of chirps that no device sends.
    pub(super) fn sound_profile(&self, profile: Profile) -> Result<Setting, Fault> {
        let Profile { slope_mhz_per_us, rate_ksps, samples, idle_us, adc_start_us, ramp_end_us, .. } =
            profile;
        if slope_mhz_per_us == 0.0 || rate_ksps <= 0.0 || samples == 0 {
            return Err(self.fault("slope, sample rate and samples must not be 0"));
        }
        if idle_us < 0.0 || adc_start_us < 0.0 {
            return Err(self.fault("times must not be negative"));
        }
        let end_us = profile.sampled_until_us();
        // Times have a resolution of 10 ns.
        if end_us > ramp_end_us + 0.01 {
            return Err(self.fault(format!(
                "the last sample is taken {end_us:.2} µs into the ramp, which ends after {ramp_end_us} µs"
            )));
        }
        Ok(Setting::Profile(profile))
    }
}
