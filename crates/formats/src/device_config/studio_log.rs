//! Files of mmWave Studio: its log (`… API:ProfileConfig,0,1435384036,…,`, numbers as sent to the device:
//! codes of frequencies, 10 ns, 5 ns) and its Lua scripts (`ar1.ProfileConfig(0, 77, 100, …)`, numbers in
//! user units).
//!
//! A log contains every attempt; the last commands before the last start of the sensor count.

use super::lua_calls::{self, LuaCall};
use super::statements::{
    Arguments, CHIRPS_MAX, Chirps, Fault, Frame, Profile, ProfileColumns, Setting, Statement,
};
use crate::devices::{Board, IqOrder, Lanes};
use std::collections::BTreeMap;
use std::ops::Range;

/// Whether a text is a log or a script, not a `.cfg`, whose remarks begin with `%`.
pub(super) fn is_one(text: &str) -> bool {
    let mut code = text.lines().map(|line| line.split('%').next().unwrap_or_default());
    code.any(|code| code.contains("API:") || code.contains("ar1."))
}

/// Commands in order, up to the last start of the sensor, with the lines of those in branches of a script;
/// `board` is the requested one.
pub(super) fn statements(text: &str, board: Option<Board>) -> Result<(Vec<Statement>, Vec<usize>), Fault> {
    let code = lua_calls::code_of(text);
    let mut calls = calls(text, &code);
    let end = calls.iter().rposition(Call::starts_the_sensor).unwrap_or(calls.len());
    calls.truncate(end);
    let mut reader = LogReader { board, asked: board.is_some() };
    check_branches(&calls, &reader)?;
    let (mut all, mut in_branches) = (Vec::new(), Vec::new());
    for call in &calls {
        let Some(name) = call.command() else {
            refuse_unread(call, &calls)?;
            continue;
        };
        let arguments = Arguments { line: call.line, name, words: call.words()? };
        all.extend(
            reader.read(call.form, &arguments)?.into_iter().map(|setting| arguments.statement(setting)),
        );
        in_branches.extend((call.branch > 0).then_some(call.line));
    }
    in_branches.dedup();
    Ok((all, in_branches))
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
    "DataPathConfig",
    "LaneConfig",
    "LVDSLaneConfig",
    "ProfileConfig",
    "ChirpConfig",
    "FrameConfig",
    "AdvancedFrameConfig",
];

/// Parts of the names, in lower case, of calls that change chirps in unsupported ways.
const UNREAD: [(&str, &str); 6] = [
    ("advanceframe", "advanced frames of sub-frames are not read: FrameConfig alone"),
    ("advchirp", "tables of chirps' parameters are not read: ChirpConfig alone"),
    ("perchirpphaseshift", "phases of transmitters are not read"),
    ("dynchirp", "chirps that are changed on the way are not read"),
    ("dynperchirp", "chirps that are changed on the way are not read"),
    ("bpmchirp", "binary phases are not read: transmitters in turn alone"),
];

/// A line of the log, or a call of a script.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Log,
    Script,
}

/// A call of either form.
struct Call<'a> {
    line: usize,
    form: Form,
    name: &'a str,
    /// Branch of a script, 0 outside of all.
    branch: usize,
    words: CallArguments<'a>,
}

enum CallArguments<'a> {
    Log(&'a str),
    Script(LuaCall<'a>),
}

fn calls<'a>(text: &'a str, code: &'a str) -> Vec<Call<'a>> {
    let of_log = |(index, (line, code)): (usize, (&'a str, &str))| {
        let (_, call) = line.split_at(code.find("API:")? + "API:".len());
        let (name, words) = call.split_once(',').unwrap_or((call, ""));
        let words = CallArguments::Log(words);
        Some(Call { line: index + 1, form: Form::Log, name: name.trim(), branch: 0, words })
    };
    let of_script = |call: LuaCall<'a>| {
        let LuaCall { line, name, branch, .. } = call;
        Call { line, form: Form::Script, name, branch, words: CallArguments::Script(call) }
    };
    let mut all: Vec<Call<'_>> = text.lines().zip(code.lines()).enumerate().filter_map(of_log).collect();
    all.extend(lua_calls::calls(text, code).into_iter().map(of_script));
    all.sort_by_key(|call| call.line);
    all
}

impl<'a> Call<'a> {
    /// Whether the call starts the sensor; a start within a function does not count, because it is unknown
    /// where the function is called.
    fn starts_the_sensor(&self) -> bool {
        let is_in_function = matches!(&self.words, CallArguments::Script(call) if call.is_in_function);
        STARTS.contains(&self.name) && !is_in_function
    }

    /// Name of the command for the call.
    fn command(&self) -> Option<&'static str> {
        COMMANDS.into_iter().find(|known| known.eq_ignore_ascii_case(self.name))
    }

    fn words(&self) -> Result<Vec<&'a str>, Fault> {
        match &self.words {
            CallArguments::Log(list) => Ok(words_of(list)),
            CallArguments::Script(call) => call.words().ok_or_else(|| self.fault("the call does not end")),
        }
    }

    fn fault(&self, rule: impl std::fmt::Display) -> Fault {
        Fault { line: Some(self.line), rule: format!("{}: {rule}", self.name) }
    }
}

fn words_of(list: &str) -> Vec<&str> {
    let words = list.split(',').map(|word| word.trim().trim_matches('"'));
    words.filter(|word| !word.is_empty()).collect()
}

/// Refuses commands of a script that occur twice with other arguments, once in another branch of `if`: it is
/// unknown which of them runs.
fn check_branches(calls: &[Call<'_>], reader: &LogReader) -> Result<(), Fault> {
    let mut told: BTreeMap<(&str, Vec<&str>), &Call<'_>> = BTreeMap::new();
    for call in calls.iter().filter(|call| call.form == Form::Script) {
        let Some(name) = call.command().filter(|name| !(reader.asked && CHIPS.contains(name))) else {
            continue;
        };
        let words = call.words()?;
        let of = words.iter().copied().take(slots(name)).collect();
        let other = told.insert((name, of), call).filter(|other| other.branch != call.branch);
        let Some(other) = other else { continue };
        if other.words()? != words {
            return Err(call.fault(format!(
                "line {} has it with other numbers, and one of the two stands in a branch of `if`: {FLOW}",
                other.line
            )));
        }
    }
    Ok(())
}

/// Number of arguments that identify the configured item, such as one of several profiles or chirps.
fn slots(name: &str) -> usize {
    match name {
        "ProfileConfig" => 1,
        "ChirpConfig" => 2,
        _ => 0,
    }
}

/// Refuses an unsupported call that changes chirps.
fn refuse_unread(call: &Call<'_>, calls: &[Call<'_>]) -> Result<(), Fault> {
    let name = call.name.to_ascii_lowercase();
    if name.ends_with("_mult") {
        return Err(call.fault("cascades of devices are not read"));
    }
    let Some((part, rule)) = UNREAD.into_iter().find(|(part, _)| name.contains(part)) else {
        return Ok(());
    };
    let is_idle = part == "perchirpphaseshift" && call.words()?.iter().skip(2).all(|phase| *phase == "0");
    if is_idle {
        return Ok(());
    }
    let plain = calls.iter().find(|other| other.command() == Some("FrameConfig"));
    match plain.filter(|_| part == "advanceframe") {
        Some(plain) => Err(call.fault(format!("{rule}; FrameConfig stands in line {}: {FLOW}", plain.line))),
        None => Err(call.fault(rule)),
    }
}

/// Advice for a script with two commands of which only one can run.
const FLOW: &str = "control flow is not followed, leave out the branch that does not run";

/// Commands that name the chip.
const CHIPS: [&str; 3] = ["select_chip_version", "SelectChipVersion", "deviceVariantSelection"];

/// Reader of calls, with the board that defines their codes.
struct LogReader {
    board: Option<Board>,
    /// Whether the board was requested: then no chip of the log replaces it.
    asked: bool,
}

impl LogReader {
    fn read(&mut self, form: Form, arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
        let log = form == Form::Log;
        let setting = match arguments.name {
            "select_chip_version" | "SelectChipVersion" | "deviceVariantSelection" => {
                return Ok(self.chip(arguments).into_iter().collect());
            }
            "ChanNAdcConfig" => return channels_and_converter(arguments).map(Vec::from),
            "ChannelConfig" => channels(arguments)?,
            "AdcOutConfig" => arguments.converter(0, arguments.whole(1, FORMAT, u32::MAX)?)?,
            "DataFmtConfig" if log => order(arguments)?,
            "DataPathConfig" => data_path(arguments)?,
            "LaneConfig" if log => lanes(arguments, arguments.whole(0, "the mask of lanes", 15)?)?,
            "LVDSLaneConfig" if !log => lanes(arguments, mask(arguments, 1..5, "the switch of a lane")?)?,
            "ProfileConfig" if log => self.profile_of_codes(arguments)?,
            "ProfileConfig" => profile(arguments)?,
            "ChirpConfig" => chirps(arguments, form)?,
            "FrameConfig" => frame(arguments, form)?,
            // The log repeats every frame as an advanced one with one sub-frame.
            "AdvancedFrameConfig" if arguments.words.first() != Some(&"1") => {
                return Err(arguments.fault("frames of several sub-frames are not read"));
            }
            _ => return Ok(vec![]),
        };
        Ok(vec![setting])
    }

    fn chip(&mut self, arguments: &Arguments<'_>) -> Option<Setting> {
        let board = Board::of_chip(arguments.words.first().copied().unwrap_or_default());
        if !self.asked {
            self.board = board;
        }
        board.map(Setting::Board)
    }

    fn profile_of_codes(&self, arguments: &Arguments<'_>) -> Result<Setting, Fault> {
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
            shifts_phases: arguments.shifts_phases(6..7)?,
        })
    }
}

/// TX0 … TX2, RX0 … RX3, bits, format, modes; the upper 16 bits of RX3, of the format and of the modes
/// specify other settings: pins of a cascade, the reduction of the full scale, and whether there is a
/// cascade.
fn channels_and_converter(arguments: &Arguments<'_>) -> Result<[Setting; 2], Fault> {
    arguments.at_least(9)?;
    let what = "the switch of a channel";
    let channels = Setting::Channels {
        transmitters: mask(arguments, 0..3, what)?,
        receivers: mask(arguments, 3..7, what)?,
    };
    if arguments.words.len() > 9 && arguments.whole(9, "the modes", u32::MAX)? >> 16 != 0 {
        return Err(arguments.fault("cascades of devices are not read"));
    }
    Ok([channels, arguments.converter(7, arguments.whole(8, FORMAT, u32::MAX)? & 0xffff)?])
}

const FORMAT: &str = "the format of samples";

/// Bit mask from words that each switch one bit, in their lower 16 bits.
fn mask(arguments: &Arguments<'_>, words: Range<usize>, what: &str) -> Result<u32, Fault> {
    (0..).zip(words).try_fold(0, |mask, (bit, index)| {
        Ok(mask | u32::from(arguments.whole(index, what, u32::MAX)? & 0xffff != 0) << bit)
    })
}

fn channels(arguments: &Arguments<'_>) -> Result<Setting, Fault> {
    arguments.at_least(2)?;
    if arguments.words.len() > 2 && arguments.number(2, "the cascade")? != 0.0 {
        return Err(arguments.fault("cascades of devices are not read"));
    }
    Ok(Setting::Channels {
        transmitters: arguments.whole(0, "the mask of transmitters", 15)?,
        receivers: arguments.whole(1, "the mask of receivers", 15)?,
    })
}

/// Receivers, bits, format, order of I and Q, interleaving.
fn order(arguments: &Arguments<'_>) -> Result<Setting, Fault> {
    Ok(Setting::Order(match arguments.whole(3, "the order of I and Q", 1)? {
        0 => IqOrder::InPhaseFirst,
        _ => IqOrder::QuadratureFirst,
    }))
}

/// Interface, contents of packets 0 and 1, each in the lower bits of its word (a script has sizes above
/// them): samples alone are 1, nothing is 0, and the others have parameters (CP) or quality (CQ) of the
/// chirp: CP and samples, samples and CP, all three, CP and CQ, CQ and CP (mmWaveLink, `rlDevDataPathCfg_t`).
fn data_path(arguments: &Arguments<'_>) -> Result<Setting, Fault> {
    const BETWEEN: [u32; 5] = [0b000110, 0b001001, 0b110110, 0b001110, 0b001011];
    let mut between = None;
    for index in 0..arguments.words.len().min(3) {
        let content = arguments.whole(index, "the content of a packet", u32::MAX)? & 0b111111;
        if BETWEEN.contains(&content) {
            between = Some("parameters and quality of each chirp");
        }
    }
    Ok(Setting::Stream(between))
}

fn lanes(arguments: &Arguments<'_>, mask: u32) -> Result<Setting, Fault> {
    match mask {
        3 => Ok(Setting::Lanes(Lanes::Two)),
        15 => Ok(Setting::Lanes(Lanes::Four)),
        other => Err(arguments.fault(format!("lanes {other:#b} are not read: two (3) and four (15) alone"))),
    }
}

/// Profile with the powers and phases of three transmitters before the slope.
fn profile(arguments: &Arguments<'_>) -> Result<Setting, Fault> {
    arguments.at_least(15)?;
    arguments.profile(ProfileColumns { phases: [8, 11], slope: 11, samples: 13, rate: 14 })
}

/// Chirps with transmitters as a mask in the log, as switches in a script.
fn chirps(arguments: &Arguments<'_>, form: Form) -> Result<Setting, Fault> {
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
    Ok(Setting::Chirps(Chirps {
        first: arguments.whole(0, "the first chirp", CHIRPS_MAX - 1)?,
        last: arguments.whole(1, "the last chirp", CHIRPS_MAX - 1)?,
        profile: arguments.whole(2, "the profile's number", 3)?,
        transmitters,
    }))
}

/// Frame with the period in steps of 5 ns in a log, in milliseconds in a script.
fn frame(arguments: &Arguments<'_>, form: Form) -> Result<Setting, Fault> {
    arguments.at_least(5)?;
    let period = arguments.number(4, "the frame's period")?;
    Ok(Setting::Frame(Frame {
        first: arguments.whole(0, "the first chirp", CHIRPS_MAX - 1)?,
        last: arguments.whole(1, "the last chirp", CHIRPS_MAX - 1)?,
        frames: arguments.whole(2, "the number of frames", u32::from(u16::MAX))?,
        loops: arguments.whole(3, "the number of loops", u32::from(u16::MAX))?,
        period_ms: if form == Form::Log { period * 5e-6 } else { period },
    }))
}
