//! What mmWave Studio leaves: its log (`… API:ProfileConfig,0,1435384036,…,`, numbers as the device gets
//! them: codes of frequencies, 10 ns, 5 ns) and its Lua scripts (`ar1.ProfileConfig(0, 77, 100, …)`, numbers
//! as a person gives them).
//!
//! A log has every attempt; what counts is what was told last before the last start of the sensor.

use super::statements::{
    Arguments, CHIRPS_MAX, Chirps, Fault, Frame, Profile, ProfileColumns, Statement, Told,
};
use crate::devices::{Board, IqOrder, Lanes};

/// Whether a text is a log or a script, not a `.cfg`.
pub(super) fn is_one(text: &str) -> bool {
    text.lines().any(|line| line.contains("API:") || line.contains("ar1."))
}

/// Commands in their order, up to the last start of the sensor; `board` is the one that was asked for.
pub(super) fn statements(text: &str, board: Option<Board>) -> Result<Vec<Statement>, Fault> {
    let lines: Vec<&str> = text.lines().collect();
    let starts = |line: &&str| call(line).is_some_and(|(name, ..)| STARTS.contains(&name));
    let end = lines.iter().rposition(starts).unwrap_or(lines.len());
    let mut reader = LogReader { board, asked: board.is_some() };
    let mut all = Vec::new();
    for (index, line) in lines[..end].iter().enumerate() {
        let Some((name, form, words)) = call(line) else { continue };
        let Some(name) = COMMANDS.into_iter().find(|known| known.eq_ignore_ascii_case(name)) else {
            refuse_cascade(name, index + 1)?;
            continue;
        };
        let words = words.ok_or_else(|| Fault {
            line: Some(index + 1),
            rule: format!("{name}: the call does not end in its line"),
        })?;
        let arguments = Arguments { line: index + 1, name, words };
        all.extend(reader.read(form, &arguments)?.into_iter().map(|told| arguments.statement(told)));
    }
    Ok(all)
}

/// Calls after which samples are recorded.
const STARTS: [&str; 2] = ["SensorStart", "StartFrame"];

const COMMANDS: [&str; 14] = [
    "select_chip_version",
    "SelectChipVersion",
    "deviceVariantSelection",
    "ChanNAdcConfig",
    "ChannelConfig",
    "AdcOutConfig",
    "DataFmtConfig",
    "LaneConfig",
    "ProfileConfig",
    "ChirpConfig",
    "FrameConfig",
    "AdvancedFrameConfig",
    "BpmChirpConfig",
    "DynChirpConfig",
];

/// A line of the log, or a call of a script.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Log,
    Script,
}

/// Name and words of the call in a line; words are `None` where it does not end there.
fn call(line: &str) -> Option<(&str, Form, Option<Vec<&str>>)> {
    if let Some((_, call)) = line.split_once("API:") {
        let (name, words) = call.split_once(',').unwrap_or((call, ""));
        return Some((name.trim(), Form::Log, Some(words_of(words))));
    }
    let code = line.split("--").next().unwrap_or_default();
    let (_, call) = code.split_once("ar1.")?;
    let (name, behind) = call.split_once('(')?;
    Some((name.trim(), Form::Script, behind.split_once(')').map(|(words, _)| words_of(words))))
}

fn words_of(list: &str) -> Vec<&str> {
    let words = list.split(',').map(|word| word.trim().trim_matches('"'));
    words.filter(|word| !word.is_empty()).collect()
}

fn refuse_cascade(name: &str, line: usize) -> Result<(), Fault> {
    if COMMANDS.iter().any(|known| name.strip_suffix("_mult") == Some(known)) {
        return Err(Fault { line: Some(line), rule: format!("{name}: cascades of devices are not read") });
    }
    Ok(())
}

/// Reader of calls that knows the board whose codes they are.
struct LogReader {
    board: Option<Board>,
    /// Whether the board was asked for: then no chip of the log takes its place.
    asked: bool,
}

impl LogReader {
    fn read(&mut self, form: Form, arguments: &Arguments<'_>) -> Result<Vec<Told>, Fault> {
        let log = form == Form::Log;
        let told = match arguments.name {
            "select_chip_version" | "SelectChipVersion" | "deviceVariantSelection" => {
                return Ok(self.chip(arguments).into_iter().collect());
            }
            "ChanNAdcConfig" => return channels_and_converter(arguments).map(Vec::from),
            "ChannelConfig" => channels(arguments)?,
            "AdcOutConfig" => arguments.converter([0, 1])?,
            "DataFmtConfig" if log => order(arguments)?,
            "LaneConfig" if log => lanes(arguments)?,
            "ProfileConfig" if log => self.profile_of_codes(arguments)?,
            "ProfileConfig" => profile(arguments)?,
            "ChirpConfig" => chirps(arguments, form)?,
            "FrameConfig" => frame(arguments, form)?,
            // The log repeats every frame as an advanced one of one sub-frame.
            "AdvancedFrameConfig" if arguments.words.first() != Some(&"1") => {
                return Err(arguments.fault("frames of several sub-frames are not read"));
            }
            "BpmChirpConfig" => {
                return Err(arguments.fault("binary phases are not read: transmitters in turn alone"));
            }
            "DynChirpConfig" => {
                return Err(arguments.fault("chirps that are changed on the way are not read"));
            }
            _ => return Ok(vec![]),
        };
        Ok(vec![told])
    }

    fn chip(&mut self, arguments: &Arguments<'_>) -> Option<Told> {
        let board = Board::of_chip(arguments.words.first().copied().unwrap_or_default());
        if !self.asked {
            self.board = board;
        }
        board.map(Told::Board)
    }

    fn profile_of_codes(&self, arguments: &Arguments<'_>) -> Result<Told, Fault> {
        arguments.at_least(11)?;
        let Some(board) = self.board else {
            return Err(arguments
                .fault("codes of frequencies are those of a device that is not named before: --device"));
        };
        let (band, number) = (board.band(), |index, what| arguments.number(index, what));
        arguments.sound_profile(Profile {
            id: arguments.whole(0, "the profile's number", 3)?,
            start_ghz: number(1, "the code of the start frequency")? * band.start_step_ghz,
            idle_us: number(2, "the idle time")? / 100.0,
            adc_start_us: number(3, "the time of the first sample")? / 100.0,
            ramp_end_us: number(4, "the ramp's end")? / 100.0,
            slope_mhz_per_us: number(7, "the code of the slope")? * band.slope_step_mhz_per_us,
            samples: arguments.whole(9, "the number of samples", u32::from(u16::MAX))?,
            rate_ksps: number(10, "the sample rate")?,
        })
    }
}

/// TX0 … TX2, RX0 … RX3, bits, format.
fn channels_and_converter(arguments: &Arguments<'_>) -> Result<[Told; 2], Fault> {
    arguments.at_least(9)?;
    let mask = |from: usize, count: usize| -> Result<u32, Fault> {
        (0..count).try_fold(0, |mask, bit| {
            Ok(mask | u32::from(arguments.number(from + bit, "the switch of a channel")? != 0.0) << bit)
        })
    };
    let channels = Told::Channels { transmitters: mask(0, 3)?, receivers: mask(3, 4)? };
    Ok([channels, arguments.converter([7, 8])?])
}

fn channels(arguments: &Arguments<'_>) -> Result<Told, Fault> {
    arguments.at_least(2)?;
    Ok(Told::Channels {
        transmitters: arguments.whole(0, "the mask of transmitters", 15)?,
        receivers: arguments.whole(1, "the mask of receivers", 15)?,
    })
}

/// Receivers, bits, format, order of I and Q, interleaving.
fn order(arguments: &Arguments<'_>) -> Result<Told, Fault> {
    Ok(Told::Order(match arguments.whole(3, "the order of I and Q", 1)? {
        0 => IqOrder::InPhaseFirst,
        _ => IqOrder::QuadratureFirst,
    }))
}

fn lanes(arguments: &Arguments<'_>) -> Result<Told, Fault> {
    match arguments.whole(0, "the mask of lanes", 15)? {
        3 => Ok(Told::Lanes(Lanes::Two)),
        15 => Ok(Told::Lanes(Lanes::Four)),
        other => Err(arguments.fault(format!("lanes {other:#b} are not read: two (3) and four (15) alone"))),
    }
}

/// Three transmitters have their power and three their phase each before the slope.
fn profile(arguments: &Arguments<'_>) -> Result<Told, Fault> {
    arguments.at_least(15)?;
    arguments.profile(ProfileColumns { slope: 11, samples: 13, rate: 14 })
}

/// Transmitters are a mask in the log, switches in a script.
fn chirps(arguments: &Arguments<'_>, form: Form) -> Result<Told, Fault> {
    arguments.at_least(8)?;
    for index in 3..7 {
        arguments.none(index, "a change of the profile")?;
    }
    let transmitters = match form {
        Form::Log => arguments.whole(7, "the mask of transmitters", 15)?,
        Form::Script => (0..3.min(arguments.words.len() - 7)).try_fold(0, |mask, bit| {
            Ok(mask | arguments.whole(7 + bit, "the switch of a transmitter", 1)? << bit)
        })?,
    };
    Ok(Told::Chirps(Chirps {
        first: arguments.whole(0, "the first chirp", CHIRPS_MAX - 1)?,
        last: arguments.whole(1, "the last chirp", CHIRPS_MAX - 1)?,
        profile: arguments.whole(2, "the profile's number", 3)?,
        transmitters,
    }))
}

/// The period is in steps of 5 ns in a log, in milliseconds in a script.
fn frame(arguments: &Arguments<'_>, form: Form) -> Result<Told, Fault> {
    arguments.at_least(5)?;
    let period = arguments.number(4, "the frame's period")?;
    Ok(Told::Frame(Frame {
        first: arguments.whole(0, "the first chirp", CHIRPS_MAX - 1)?,
        last: arguments.whole(1, "the last chirp", CHIRPS_MAX - 1)?,
        frames: arguments.whole(2, "the number of frames", u32::from(u16::MAX))?,
        loops: arguments.whole(3, "the number of loops", u32::from(u16::MAX))?,
        period_ms: if form == Form::Log { period * 5e-6 } else { period },
    }))
}
