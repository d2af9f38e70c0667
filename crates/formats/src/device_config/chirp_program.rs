//! Settings of commands: which form of chirp is sent, by whom, how often.

use super::statements::{Chirps, Fault, Frame, Platform, Profile, Setting, Statement};
use crate::devices::{Board, IqOrder, Lanes};
use artifact::radar::Sampling;

/// Settings of a device, as its configuration tells them.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviceSettings {
    /// Requested board, else the one of the chip that the file names.
    pub(super) board: Option<Board>,
    pub(super) profile: FromCommand<Profile>,
    pub(super) frame: FromCommand<Frame>,
    pub(super) channels: FromCommand<Channels>,
    /// Transmitters by their numbers from 0, in the order of their chirps.
    pub(super) turns: Vec<usize>,
    /// Chirps of each transmitter in a frame.
    pub(super) chirps: u32,
    pub(super) sampling: Sampling,
    /// Bits of the converter.
    pub(super) bits: u32,
    /// Command that configures the converter; `None` if its bits are assumed.
    pub(super) converter: Option<&'static str>,
    /// Words between the samples of a recording.
    stream: Option<FromCommand<&'static str>>,
    lanes: Option<Lanes>,
    /// First part of a complex sample; `None` if the file does not specify it.
    pub iq_order: Option<IqOrder>,
    /// Remarks on the file, each with its line if it has one.
    pub(super) remarks: Vec<Remark>,
}

/// A remark on a valid configuration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Remark {
    pub(super) line: usize,
    pub(super) text: String,
}

/// A value with the command that set it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FromCommand<T> {
    pub(super) line: usize,
    pub(super) name: &'static str,
    pub(super) value: T,
}

/// Enabled receivers, by their numbers from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Channels {
    transmitters: u32,
    pub(super) receivers: Vec<usize>,
}

impl DeviceSettings {
    /// Bits of the converter.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// Layout of a capture card's recordings where it is not the one that is assumed of them otherwise.
    pub fn unusual_layout(&self) -> Option<&'static str> {
        let four = self.lanes() == Some(Lanes::Four);
        let swapped = self.iq_order == Some(IqOrder::QuadratureFirst) && self.sampling == Sampling::Complex;
        match (four, swapped) {
            (true, true) => Some("four lanes and Q before I"),
            (true, false) => Some("four lanes"),
            (false, true) => Some("Q before I"),
            (false, false) => None,
        }
    }

    /// Refuses settings by which a capture card's file holds more than samples.
    pub(super) fn check_stream(&self) -> Result<(), Fault> {
        let Some(stream) = &self.stream else { return Ok(()) };
        let between = stream.value;
        Err(stream.fault(format!("a recording has {between} between its samples; samples alone are read")))
    }

    /// Number of lanes in the file, else that of the board.
    pub fn lanes(&self) -> Option<Lanes> {
        self.lanes.or(self.board.map(Board::lanes))
    }
}

/// Settings of these commands, by the last of each kind.
pub(super) fn settings(statements: &[Statement], asked: Option<Board>) -> Result<DeviceSettings, Fault> {
    let from = statements.iter().rposition(|s| s.setting == Setting::Flush).unwrap_or(0);
    let program = Program(&statements[from..]);
    let frame = program.last("frameCfg or FrameConfig", |setting| match setting {
        Setting::Frame(frame) => Some(*frame),
        _ => None,
    })?;
    let channels = program.last("channelCfg, ChannelConfig or ChanNAdcConfig", |setting| match setting {
        Setting::Channels { transmitters, receivers } => {
            Some(Channels { transmitters: *transmitters, receivers: numbers(*receivers) })
        }
        _ => None,
    })?;
    let profile = program.profile(&frame)?;
    let turns = program.turns(&frame, &channels)?;
    let (converter, (bits, sampling)) = program.converter()?;
    if profile.value.shifts_phases && turns.len() > 1 {
        return Err(profile.fault("phases of several transmitters are not read: 0 alone"));
    }
    // Comments stand before the start that flushes the commands.
    let platform = Program(statements).find(|setting| match setting {
        Setting::Platform(platform) => Some(platform.clone()),
        _ => None,
    });
    let named = program.find(|setting| if let Setting::Board(board) = setting { Some(*board) } else { None });
    let mut settings = DeviceSettings {
        board: asked.or(named.as_ref().map(|named| named.value)),
        remarks: named.and_then(|named| of_another_chip(&named, asked?)).into_iter().collect(),
        chirps: frame.value.loops * (frame.value.last + 1 - frame.value.first) / turns.len() as u32,
        turns,
        lanes: program
            .find(|setting| if let Setting::Lanes(lanes) = setting { Some(*lanes) } else { None })
            .map(|l| l.value),
        iq_order: program
            .find(|setting| if let Setting::Order(order) = setting { Some(*order) } else { None })
            .map(|o| o.value),
        profile,
        frame,
        channels,
        sampling,
        bits,
        converter,
        stream: program.stream(),
    };
    check_period(&settings)?;
    check_board(&settings)?;
    if let (Some(platform), Some(board)) = (platform, settings.board) {
        check_platform(&platform, board)?;
        settings.remarks.extend(of_another_platform(&platform, board));
    }
    Ok(settings)
}

/// Word of a scene for samples.
pub(super) fn sampling_word(sampling: Sampling) -> &'static str {
    match sampling {
        Sampling::Complex => "complex",
        Sampling::Real => "real",
    }
}

/// The remark that the requested board has another chip than the file names.
fn of_another_chip(named: &FromCommand<Board>, asked: Board) -> Option<Remark> {
    let (name, chip, asked_name) = (named.name, named.value.name(), asked.name());
    let text = || format!("{name}: it names the chip of the {chip}; --device {asked_name} is taken");
    (named.value != asked).then(|| Remark { line: named.line, text: text() })
}

/// Refuses a board whose antennas are others than those of the board that is taken for it.
fn check_platform(platform: &FromCommand<Platform>, board: Board) -> Result<(), Fault> {
    if !platform.value.is_on_package {
        return Ok(());
    }
    let (name, board) = (&platform.value.name, board.name());
    Err(platform.fault(format!(
        "antennas of {name} are not those of the {board}: write a scene with its tx_half_wavelengths and \
         rx_half_wavelengths in [radar.array], and import by --config without --device"
    )))
}

/// The remark that a board was asked for which is of another family than the one that a comment names.
fn of_another_platform(platform: &FromCommand<Platform>, board: Board) -> Option<Remark> {
    let (Platform { name, family, .. }, board) = (&platform.value, board.name());
    let is_of_it =
        family.is_empty() || board.trim_start_matches(|c: char| !c.is_ascii_digit()).starts_with(family);
    let text = format!("its comment names the platform {name}; the {board} is taken");
    (!is_of_it).then_some(Remark { line: platform.line, text })
}

/// Numbers of the bits that are set.
fn numbers(mask: u32) -> Vec<usize> {
    (0..32).filter(|bit| mask >> bit & 1 == 1).collect()
}

/// Commands in force.
struct Program<'a>(&'a [Statement]);

impl Program<'_> {
    /// The last command with such a value.
    fn find<T>(&self, setting: impl Fn(&Setting) -> Option<T>) -> Option<FromCommand<T>> {
        let in_line =
            |s: &Statement| Some(FromCommand { line: s.line, name: s.name, value: setting(&s.setting)? });
        self.0.iter().rev().find_map(in_line)
    }

    fn last<T>(&self, names: &str, setting: impl Fn(&Setting) -> Option<T>) -> Result<FromCommand<T>, Fault> {
        self.find(setting).ok_or_else(|| Fault { line: None, rule: format!("there is no {names}") })
    }

    /// Words between the samples, if the last command about the stream adds some.
    fn stream(&self) -> Option<FromCommand<&'static str>> {
        let last =
            self.find(|setting| if let Setting::Stream(between) = setting { Some(*between) } else { None })?;
        last.value.map(|value| FromCommand { line: last.line, name: last.name, value })
    }

    /// Bits and samples of the converter, with the command that sets them; refused if a buffer passes on
    /// other samples.
    fn converter(&self) -> Result<(Option<&'static str>, (u32, Sampling)), Fault> {
        let setting = self.find(|setting| match setting {
            Setting::Converter { bits, sampling } => Some((*bits, *sampling)),
            _ => None,
        });
        let buffer =
            self.find(|setting| if let Setting::Buffer(sampling) = setting { Some(*sampling) } else { None });
        match (&setting, buffer) {
            (Some(setting), Some(buffer)) if setting.value.1 != buffer.value => {
                let [passed, made] = [buffer.value, setting.value.1].map(sampling_word);
                let FromCommand { line, name, .. } = setting;
                Err(buffer.fault(format!("its samples are {passed}, those of {name} of line {line} {made}")))
            }
            (Some(setting), _) => Ok((Some(setting.name), setting.value)),
            (None, buffer) => Ok((None, (16, buffer.map_or(Sampling::Complex, |buffer| buffer.value)))),
        }
    }

    /// Definition of a chirp by the last command for it.
    fn chirp(&self, index: u32, frame: &FromCommand<Frame>) -> Result<FromCommand<Chirps>, Fault> {
        let of_chirp = self.find(|setting| match setting {
            Setting::Chirps(chirps) if (chirps.first..=chirps.last).contains(&index) => Some(*chirps),
            _ => None,
        });
        of_chirp.ok_or_else(|| frame.fault(format!("it sends chirp {index}, which nothing defines before")))
    }

    /// The common profile of all chirps of a frame.
    fn profile(&self, frame: &FromCommand<Frame>) -> Result<FromCommand<Profile>, Fault> {
        let Frame { first, last, loops, .. } = frame.value;
        if last < first || loops == 0 {
            return Err(frame.fault(format!("chirps {first} to {last}, {loops} times, are none")));
        }
        let id = self.chirp(first, frame)?.value.profile;
        for index in first..=last {
            let chirp = self.chirp(index, frame)?;
            if chirp.value.profile != id {
                return Err(chirp.fault(format!("chirp {index} has profile {}, chirp {first} profile {id}: chirps of one form alone are read", chirp.value.profile)));
            }
        }
        self.last(&format!("profile {id}"), |setting| match setting {
            Setting::Profile(profile) if profile.id == id => Some(*profile),
            _ => None,
        })
    }

    /// Transmitters in the order of their chirps, each once: the frame's chirps must repeat this sequence.
    fn turns(
        &self,
        frame: &FromCommand<Frame>,
        channels: &FromCommand<Channels>,
    ) -> Result<Vec<usize>, Fault> {
        let Frame { first, last, .. } = frame.value;
        let mut sent = Vec::new();
        for index in first..=last {
            let chirp = self.chirp(index, frame)?;
            sent.push(lone_transmitter(index, &chirp, channels)?);
        }
        let mut turns: Vec<usize> = Vec::new();
        for tx in &sent {
            if turns.contains(tx) {
                break;
            }
            turns.push(*tx);
        }
        let are_whole = sent.len().is_multiple_of(turns.len())
            && sent.iter().enumerate().all(|(index, tx)| *tx == turns[index % turns.len()]);
        if are_whole {
            return Ok(turns);
        }
        let order: Vec<String> = sent.iter().map(|tx| format!("TX{}", tx + 1)).collect();
        Err(frame.fault(format!(
            "transmitters send in the order {}: they have to take turns, each as often as the others",
            order.join(", ")
        )))
    }
}

/// The single transmitter of a chirp.
fn lone_transmitter(
    index: u32,
    chirp: &FromCommand<Chirps>,
    channels: &FromCommand<Channels>,
) -> Result<usize, Fault> {
    let mask = chirp.value.transmitters;
    match numbers(mask)[..] {
        [tx] if channels.value.transmitters >> tx & 1 == 1 => Ok(tx),
        [tx] => Err(chirp.fault(format!(
            "chirp {index} is TX{}'s, which {} of line {} leaves off",
            tx + 1,
            channels.name,
            channels.line
        ))),
        [] => Err(chirp.fault(format!("nothing sends chirp {index}"))),
        _ => Err(chirp.fault(format!(
            "chirp {index} is sent by {} transmitters at once (mask {mask}): beams and binary phases are not read, transmitters in turn alone",
            mask.count_ones()
        ))),
    }
}

/// Refuses a frame whose period is shorter than its chirps, to within a millionth: times are coded in steps.
fn check_period(settings: &DeviceSettings) -> Result<(), Fault> {
    let (frame, profile) = (&settings.frame, &settings.profile.value);
    let chirps = f64::from(settings.chirps) * settings.turns.len() as f64;
    let (chirp_us, period_ms) = (profile.idle_us + profile.ramp_end_us, frame.value.period_ms);
    let sent_ms = 1e-3 * chirps * chirp_us;
    if period_ms >= sent_ms * (1.0 - 1e-6) {
        return Ok(());
    }
    Err(frame.fault(format!(
        "its period is {period_ms} ms; its {chirps} chirps of {chirp_us} µs take {:.3} ms",
        sent_ms
    )))
}

/// Refuses channels and frequencies that the board lacks.
fn check_board(settings: &DeviceSettings) -> Result<(), Fault> {
    if settings.channels.value.receivers.is_empty() {
        return Err(settings.channels.fault("no receiver is switched on"));
    }
    let Some(board) = settings.board else { return Ok(()) };
    let ([transmitters, _], name) = (board.elements(), board.name());
    if let Some(tx) = settings.turns.iter().find(|tx| **tx >= transmitters.len()) {
        let text = format!("TX{} sends; the {name} has {} transmitters", tx + 1, transmitters.len());
        return Err(settings.channels.fault(text));
    }
    let (band, profile) = (board.band().ghz, &settings.profile.value);
    let ends = [("chirps begin", profile.start_ghz), ("the last sample is taken", profile.last_sample_ghz())];
    // A code resolves a frequency to 54 Hz.
    let is_off = |(_, ghz): &(&str, f64)| *ghz < band.start() - 1e-6 || *ghz > band.end() + 1e-6;
    match ends.into_iter().find(is_off) {
        Some((place, ghz)) => Err(settings.profile.fault(format!(
            "{place} at {} GHz; the {name} sends from {} to {}",
            (ghz * 1e6).round() / 1e6,
            band.start(),
            band.end()
        ))),
        None => Ok(()),
    }
}

impl<T> FromCommand<T> {
    pub(super) fn fault(&self, rule: impl std::fmt::Display) -> Fault {
        Fault { line: Some(self.line), rule: format!("{}: {rule}", self.name) }
    }
}
