//! Settings of a device as keys of a scene.

use super::chirp_program::{DeviceSettings, FromCommand, sampling_word};
use super::statements::Profile;
use crate::devices::Board;
use artifact::radar::Sampling;
use scene::{Place, ReadOptions, SceneError};
use std::path::{Path, PathBuf};

/// A key of a scene with its value from a configuration.
pub(super) struct Entry {
    /// Table of the key; empty for the scene itself.
    pub(super) table: &'static str,
    pub(super) key: &'static str,
    /// Text of the value in TOML.
    pub(super) value: String,
    /// Remark in the scene on where the value comes from.
    remark: String,
    /// Command that sets the value.
    command: Command,
}

/// Line and name of a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Command {
    line: usize,
    name: &'static str,
}

impl<T> From<&FromCommand<T>> for Command {
    fn from(told: &FromCommand<T>) -> Self {
        Self { line: told.line, name: told.name }
    }
}

/// Reason why a configuration makes no scene; the file is named before it.
#[derive(Debug, thiserror::Error)]
pub enum SceneTextError {
    /// No board was given, and the configuration names none: the places of the antennas are unknown.
    #[error("{}: no chip is named, and with it no antenna: --device xwr1243, xwr1443, xwr1642, xwr1843, xwr6843 or awr2243 names the board", .file.display())]
    NoBoard {
        /// File of the configuration.
        file: PathBuf,
    },
    /// The scene would break rules of scenes.
    #[error("{}", .0.join("\n"))]
    Broken(
        /// A line for each fault, with the configuration, the place in it and the rule.
        Vec<String>,
    ),
}

/// Text of a scene file with the radar of these settings; `from` is the configuration's name.
///
/// # Errors
/// The board is unknown; a scene cannot have some of the settings.
pub fn scene_text(settings: &DeviceSettings, from: &Path) -> Result<String, SceneTextError> {
    let board = settings.board.ok_or_else(|| SceneTextError::NoBoard { file: from.to_owned() })?;
    let draft = draft(settings, board, from);
    let options = ReadOptions::names_only();
    match scene::read_text(from, &draft.text, &options) {
        Ok(_) => Ok(draft.text),
        Err(errors) => {
            Err(SceneTextError::Broken(errors.0.iter().map(|error| draft.explain(error, from)).collect()))
        }
    }
}

/// A scene that is not written yet.
#[derive(Default)]
struct Draft {
    text: String,
    /// Command from which each line comes.
    commands: Vec<Option<Command>>,
}

impl Draft {
    fn line(&mut self, text: &str, command: Option<Command>) {
        self.text.push_str(text);
        self.text.push('\n');
        self.commands.push(command);
    }

    fn key_line(&mut self, told: &str, remark: &str, command: Option<Command>) {
        self.line(&format!("{told:<31} # {remark}"), command);
    }

    /// A broken rule of the scene with its place in the configuration.
    fn explain(&self, error: &SceneError, from: &Path) -> String {
        let line = error.position.map_or(0, |position| position.line as usize);
        let command = line.checked_sub(1).and_then(|index| *self.commands.get(index)?);
        let at = command.map_or_else(String::new, |Command { line, name }| format!("{line}: {name}:"));
        let table = if let Place::Table(name) = error.place { format!(" [{name}]:") } else { String::new() };
        format!("{}:{at}{table} {}", from.display(), error.rule)
    }
}

fn draft(settings: &DeviceSettings, board: Board, from: &Path) -> Draft {
    let mut draft = Draft::default();
    let frame = &settings.frame;
    let asked = match frame.value.frames {
        0 => "frames without end".to_owned(),
        count => format!("{count} frames"),
    };
    let file = from.file_name().unwrap_or_default().to_string_lossy().replace(char::is_control, "?");
    draft.line(
        &format!("# The radar of {file} on an {} board, made by `wayside scene-from`.", board.name()),
        None,
    );
    let import = format!("Import its recordings with --config {file} --device {}", board.name());
    draft.line(&format!("# {import}: they tell lanes and order of I and Q."), None);
    draft.line(&format!("name = {}", serde_json::Value::from(name_of(from))), None);
    draft.key_line("frames = 1", &format!("{} of line {} asks for {asked}", frame.name, frame.line), None);
    let interval = frame_interval(settings);
    draft.line(&format!("{} = {}", interval.key, interval.value), Some(interval.command));
    draft.line("", None);
    draft.line("[radar]", None);
    let remark = "where the board stands: yours to say, as boresight_az_deg";
    draft.key_line("position_m = [0.0, 0.0, 1.0]", remark, None);
    let mut table = "";
    for entry in entries(settings) {
        if entry.table != table {
            table = entry.table;
            draft.line("", None);
            draft.line(&format!("[{table}]"), None);
        }
        draft.key_line(&format!("{} = {}", entry.key, entry.value), &entry.remark, Some(entry.command));
    }
    noise(&mut draft, settings, board);
    draft.line("", None);
    draft.line("[dsp]", None);
    draft.key_line("assumed_height_m = 1.0", "as high as the board, until you say otherwise", None);
    draft
}

/// Noise of the receivers: a scene without it has none, and recordings imported with it would be assumed
/// noise-free.
fn noise(draft: &mut Draft, settings: &DeviceSettings, board: Board) {
    let profile = &settings.profile.value;
    let (figure_db, sheet) = board.noise_figure(profile.start_ghz.max(profile.last_sample_ghz()));
    draft.line("", None);
    draft.line("[noise]", None);
    let remark = format!("typical, data sheet {sheet}; a recording's own level is taken from its map");
    draft.key_line(&format!("noise_figure_db = {}", decimal(figure_db)), &remark, None);
}

/// Name of the scene: that of the file, as far as it is valid for scenes and folders.
fn name_of(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let kept = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' };
    let name: String = stem.chars().take(64).map(kept).collect();
    if name.is_empty() { "radar".to_owned() } else { name }
}

/// Key of the frame interval, which is outside tables.
pub(super) fn frame_interval(settings: &DeviceSettings) -> Entry {
    let frame = &settings.frame;
    entry("", "frame_interval_s", decimal(frame.value.period_ms / 1e3), String::new(), frame.into())
}

/// Keys of the radar, table by table; those of the antennas if a board is known.
pub(super) fn entries(settings: &DeviceSettings) -> Vec<Entry> {
    let mut all = of_waveform(settings);
    if let Some(board) = settings.board {
        all.extend(of_array(settings, board));
    }
    let turns: Vec<String> = settings.turns.iter().map(|tx| format!("TX{}", tx + 1)).collect();
    let (word, remark) = match &turns[..] {
        [lone] => ("simultaneous", format!("{lone} alone")),
        _ => ("tdm", format!("{} in turn", turns.join(", "))),
    };
    let of_frame = Command::from(&settings.frame);
    all.push(entry("radar.array", "multiplexing", format!("\"{word}\""), remark, of_frame));
    let word = sampling_word(settings.sampling);
    let parts = match settings.sampling {
        Sampling::Complex => "I and Q",
        Sampling::Real => "I alone",
    };
    let taken = if settings.converter.is_none() { ": taken, the file does not say" } else { "" };
    let remark = format!("{parts}, {} bits{taken}", settings.bits);
    let of_profile = Command::from(&settings.profile);
    all.push(entry("radar.receiver", "sampling", format!("\"{word}\""), remark, of_profile));
    all
}

fn of_waveform(settings: &DeviceSettings) -> Vec<Entry> {
    let Profile {
        start_ghz, idle_us, adc_start_us, ramp_end_us, slope_mhz_per_us, samples, rate_ksps, ..
    } = settings.profile.value;
    let sampled_us = 1e3 * f64::from(samples) / rate_ksps;
    let told = decimal;
    let ramped_ghz = 1e-3 * slope_mhz_per_us * adc_start_us;
    let of =
        |key, value, remark| entry("radar.waveform", key, value, remark, Command::from(&settings.profile));
    vec![
        of(
            "start_frequency_ghz",
            told(start_ghz + ramped_ghz),
            format!("{} GHz, and {} µs of ramp before the first sample", told(start_ghz), told(adc_start_us)),
        ),
        of(
            "slope_mhz_per_us",
            told(slope_mhz_per_us),
            format!("{} of line {}", settings.profile.name, settings.profile.line),
        ),
        of("sample_rate_msps", told(1e-3 * rate_ksps), String::from("of each receiver")),
        of("samples", samples.to_string(), String::from("of a chirp")),
        of(
            "idle_us",
            told(idle_us + ramp_end_us - sampled_us),
            format!(
                "{} µs idle and {} µs of ramp, less {} µs of samples",
                told(idle_us),
                told(ramp_end_us),
                told(sampled_us)
            ),
        ),
        entry(
            "radar.waveform",
            "chirps",
            settings.chirps.to_string(),
            format!("of each transmitter: {} of line {}", settings.frame.name, settings.frame.line),
            Command::from(&settings.frame),
        ),
    ]
}

fn of_array(settings: &DeviceSettings, board: Board) -> [Entry; 2] {
    let [tx, rx] = board.elements();
    let list = |all: &[[f64; 2]], which: &[usize]| {
        let pair = |i: &usize| all.get(*i).map(|[x, y]| format!("[{x:?}, {y:?}]"));
        format!("[{}]", which.iter().filter_map(pair).collect::<Vec<_>>().join(", "))
    };
    let of_channels = Command::from(&settings.channels);
    [
        entry(
            "radar.array",
            "tx_half_wavelengths",
            list(&tx, &settings.turns),
            format!("of the {}", board.name()),
            of_channels,
        ),
        entry(
            "radar.array",
            "rx_half_wavelengths",
            list(&rx, &settings.channels.value.receivers),
            "rightwards, seen from behind the board".to_owned(),
            of_channels,
        ),
    ]
}

fn entry(table: &'static str, key: &'static str, value: String, remark: String, command: Command) -> Entry {
    Entry { table, key, value, remark, command }
}

/// A number to 1e-9, finer than any device's values, with a decimal point.
pub(super) fn decimal(number: f64) -> String {
    let digits = format!("{number:.9}");
    let short = digits.trim_end_matches('0');
    if short.ends_with('.') { format!("{short}0") } else { short.to_owned() }
}
