//! Settings of a device as keys of a scene.

use super::chirp_program::DeviceSettings;
use super::statements::Profile;
use crate::devices::Board;
use artifact::radar::Sampling;
use std::path::Path;

/// A key of a scene with the value that a configuration gives it.
pub(super) struct Entry {
    pub(super) table: &'static str,
    pub(super) key: &'static str,
    /// Text of the value in TOML.
    pub(super) value: String,
    /// Reason for the value.
    remark: String,
}

/// No board was asked for, and the configuration names none: nothing says where the antennas are.
#[derive(Debug, thiserror::Error)]
#[error("no chip is named, and with it no antenna: --device")]
pub struct NoBoard;

/// Text of a scene file with the radar of these settings; `from` is the configuration's name.
///
/// # Errors
/// No board says where the antennas are.
pub fn scene_text(settings: &DeviceSettings, from: &Path) -> Result<String, NoBoard> {
    let board = settings.board.ok_or(NoBoard)?;
    let file = from.file_name().unwrap_or_default().to_string_lossy();
    let (stem, frame) = (name_of(from), &settings.frame);
    let asked = match frame.value.frames {
        0 => "frames without end".to_owned(),
        count => format!("{count} frames"),
    };
    let mut text = format!(
        "# The radar of {file} on an {} board, made by `wayside scene-from`.\n\
         name = {}\n\
         frames = 1                      # {} of line {} asks for {asked}\n\
         frame_interval_s = {}\n\n\
         [radar]\n\
         position_m = [0.0, 0.0, 1.0]    # where the board stands: yours to say, as boresight_az_deg\n",
        board.name(),
        serde_json::Value::from(stem),
        frame.name,
        frame.line,
        decimal(frame.value.period_ms / 1e3),
    );
    let mut table = "";
    for entry in entries(settings) {
        if entry.table != table {
            table = entry.table;
            text.push_str(&format!("\n[{table}]\n"));
        }
        let told = format!("{} = {}", entry.key, entry.value);
        text.push_str(&format!("{told:<31} # {}\n", entry.remark));
    }
    text.push_str(
        "\n[dsp]\nassumed_height_m = 1.0          # as high as the board, until you say otherwise\n",
    );
    Ok(text)
}

/// Name of the scene: that of the file, as far as it is one of a scene and of a folder.
fn name_of(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let kept = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' };
    let name: String = stem.chars().take(64).map(kept).collect();
    if name.is_empty() { "radar".to_owned() } else { name }
}

/// Keys of the radar, table by table; those of the antennas where a board is known.
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
    all.push(entry("radar.array", "multiplexing", format!("\"{word}\""), remark));
    let (word, parts) = match settings.sampling {
        Sampling::Complex => ("complex", "I and Q"),
        Sampling::Real => ("real", "I alone"),
    };
    let remark = format!("{parts}, {} bits", settings.bits);
    all.push(entry("radar.receiver", "sampling", format!("\"{word}\""), remark));
    all
}

fn of_waveform(settings: &DeviceSettings) -> Vec<Entry> {
    let Profile {
        start_ghz, idle_us, adc_start_us, ramp_end_us, slope_mhz_per_us, samples, rate_ksps, ..
    } = settings.profile.value;
    let sampled_us = 1e3 * f64::from(samples) / rate_ksps;
    let told = decimal;
    let ramped_ghz = 1e-3 * slope_mhz_per_us * adc_start_us;
    let of = |key, value, remark| entry("radar.waveform", key, value, remark);
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
        of(
            "chirps",
            settings.chirps.to_string(),
            format!("of each transmitter: {} of line {}", settings.frame.name, settings.frame.line),
        ),
    ]
}

fn of_array(settings: &DeviceSettings, board: Board) -> [Entry; 2] {
    let [tx, rx] = board.elements();
    let list = |all: &[[f64; 2]], which: &[usize]| {
        let pair = |i: &usize| all.get(*i).map(|[x, y]| format!("[{x:?}, {y:?}]"));
        format!("[{}]", which.iter().filter_map(pair).collect::<Vec<_>>().join(", "))
    };
    [
        entry(
            "radar.array",
            "tx_half_wavelengths",
            list(&tx, &settings.turns),
            format!("of the {}", board.name()),
        ),
        entry(
            "radar.array",
            "rx_half_wavelengths",
            list(&rx, &settings.channels.value.receivers),
            "rightwards, seen from behind the board".to_owned(),
        ),
    ]
}

fn entry(table: &'static str, key: &'static str, value: String, remark: String) -> Entry {
    Entry { table, key, value, remark }
}

/// A number to 1e-9, which is finer than any device tells it, with a point in it.
pub(super) fn decimal(number: f64) -> String {
    let digits = format!("{number:.9}");
    let short = digits.trim_end_matches('0');
    if short.ends_with('.') { format!("{short}0") } else { short.to_owned() }
}
