//! The `.cfg` of the mmWave SDK: a command a line, numbers apart by blanks, `%` before remarks (mmWave SDK
//! User Guide, release 3.6, "Configuration (.cfg) File Format"). What says nothing about chirps, channels and
//! samples is passed over.

use super::statements::{
    Arguments, CHIRPS_MAX, Chirps, Fault, Frame, Platform, ProfileColumns, Setting, Statement,
};
use crate::devices::IqOrder;
use artifact::radar::Sampling;

/// Commands of a file in their order.
pub(super) fn statements(text: &str) -> Result<Vec<Statement>, Fault> {
    let mut all = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if let Some(setting) = platform(line) {
            all.push(Statement { line: index + 1, name: "% Platform", setting });
        }
        let mut words = line.split('%').next().unwrap_or_default().split_whitespace();
        let Some((name, read)) = words.next().and_then(command) else { continue };
        let arguments = Arguments { line: index + 1, name, words: words.collect() };
        all.extend(read(&arguments)?.into_iter().map(|setting| arguments.statement(setting)));
    }
    Ok(all)
}

/// The board in a comment of the generator of such files.
fn platform(line: &str) -> Option<Setting> {
    let name = line.trim_start().strip_prefix('%')?.trim_start().strip_prefix("Platform")?;
    let name = name.trim_start().strip_prefix(':')?.split_whitespace().next()?;
    Some(Setting::Platform(Platform::of(name)))
}

/// Meanings of a command's words; none of what says nothing.
type CommandParser = fn(&Arguments<'_>) -> Result<Vec<Setting>, Fault>;

fn command(name: &str) -> Option<(&'static str, CommandParser)> {
    const COMMANDS: [(&str, CommandParser); 14] = [
        ("flushCfg", |_| Ok(vec![Setting::Flush])),
        ("dfeDataOutputMode", mode),
        ("channelCfg", channels),
        ("adcCfg", converter),
        ("adcbufCfg", buffer),
        ("lvdsStreamCfg", stream),
        ("profileCfg", profile),
        ("chirpCfg", chirps),
        ("frameCfg", frame),
        ("bpmCfg", bpm),
        ("advFrameCfg", advanced),
        ("subFrameCfg", advanced),
        ("chirpComnCfg", low_power),
        ("chirpTimingCfg", low_power),
    ];
    COMMANDS.into_iter().find(|(known, _)| *known == name)
}

fn mode(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    match arguments.whole(0, "the mode", 4)? {
        1 => Ok(vec![]),
        3 => Err(arguments.fault("mode 3, advanced frames, is not read: frameCfg alone")),
        other => Err(arguments.fault(format!("mode {other} is not read: 1, frames of chirps, alone"))),
    }
}

fn channels(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    arguments.at_least(2)?;
    arguments.at_most(3)?;
    let (receivers, transmitters) = (
        arguments.whole(0, "the mask of receivers", 15)?,
        arguments.whole(1, "the mask of transmitters", 15)?,
    );
    if arguments.words.len() > 2 && arguments.number(2, "the cascade")? != 0.0 {
        return Err(arguments.fault("cascades of devices are not read"));
    }
    Ok(vec![Setting::Channels { transmitters, receivers }])
}

fn converter(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    Ok(vec![arguments.converter(0, arguments.whole(1, "the format of samples", u32::MAX)?)?])
}

/// Sub-frame, format (0 complex, 1 real), order (1: Q in the low half, so that it comes first).
fn buffer(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    // Releases before 2.0 have no sub-frame.
    let format = if arguments.words.len() >= 5 { 1 } else { 0 };
    let sampling = match arguments.whole(format, "the format of samples", 1)? {
        0 => Sampling::Complex,
        _ => Sampling::Real,
    };
    let order = match arguments.whole(format + 1, "the order of I and Q", 1)? {
        0 => IqOrder::InPhaseFirst,
        _ => IqOrder::QuadratureFirst,
    };
    Ok(vec![Setting::Buffer(sampling), Setting::Order(order)])
}

/// Sub-frame, header, format of the hardware's stream (0 nothing, 1 samples, 4 samples between parameters and
/// quality of the chirp), stream of the software (the same guide, `lvdsStreamCfg`).
fn stream(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    arguments.at_least(4)?;
    let header = arguments.whole(1, "the switch of the header", 1)?;
    let format = arguments.whole(2, "the format of the stream", u32::from(u8::MAX))?;
    let software = arguments.whole(3, "the switch of the software's stream", 1)?;
    let between = match (header, format, software) {
        (_, _, 1) => Some("words of the software"),
        (_, 0, _) | (0, 1, _) => None,
        (_, 1, _) => Some("a header for each chirp"),
        _ => Some("parameters and quality of each chirp"),
    };
    Ok(vec![Setting::Stream(between)])
}

fn profile(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    arguments.at_least(14)?;
    let columns = ProfileColumns { phases: [6, 7], slope: 7, samples: 9, rate: 10 };
    Ok(vec![arguments.profile(columns)?])
}

fn chirps(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    arguments.at_least(8)?;
    for (index, what) in [(3, "the start frequency's"), (4, "the slope's"), (5, "the idle time's")] {
        arguments.none(index, &format!("{what} change"))?;
    }
    arguments.none(6, "the first sample's change")?;
    Ok(vec![Setting::Chirps(Chirps {
        first: arguments.whole(0, "the first chirp", CHIRPS_MAX - 1)?,
        last: arguments.whole(1, "the last chirp", CHIRPS_MAX - 1)?,
        profile: arguments.whole(2, "the profile's number", 3)?,
        transmitters: arguments.whole(7, "the mask of transmitters", 15)?,
    })])
}

/// Chirps, loops, frames, period, trigger, its delay; later devices have the number of samples before the
/// period.
fn frame(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    arguments.at_least(5)?;
    arguments.at_most(7)?;
    Ok(vec![Setting::Frame(Frame {
        first: arguments.whole(0, "the first chirp", CHIRPS_MAX - 1)?,
        last: arguments.whole(1, "the last chirp", CHIRPS_MAX - 1)?,
        loops: arguments.whole(2, "the number of loops", u32::from(u16::MAX))?,
        frames: arguments.whole(3, "the number of frames", u32::from(u16::MAX))?,
        period_ms: arguments.number(4, "the frame's period")?,
    })])
}

fn bpm(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    match arguments.whole(1, "the switch", 1)? {
        0 => Ok(vec![]),
        _ => Err(arguments.fault("transmitters told apart by binary phases are not read: in turn alone")),
    }
}

fn advanced(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    Err(arguments.fault("advanced frames of sub-frames are not read: frameCfg alone"))
}

fn low_power(arguments: &Arguments<'_>) -> Result<Vec<Setting>, Fault> {
    Err(arguments.fault("the commands of xWRL devices are not read: profileCfg, chirpCfg and frameCfg alone"))
}
