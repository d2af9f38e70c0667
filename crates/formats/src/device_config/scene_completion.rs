//! A scene whose radar is that of a configuration: the configuration completes the scene, and values in both
//! must agree.

use super::chirp_program::{DeviceSettings, sampling_word};
use super::scene_tables::{Entry, decimal, entries, frame_interval};
use artifact::Radar;
use artifact::bounded;
use artifact::radar::Multiplexing;
use artifact::scene::SceneHeader;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use pipeline::host::toml_text;
use std::path::{Path, PathBuf};

/// A configuration with its file.
pub struct ConfigFile<'a> {
    /// The file, for errors.
    pub file: &'a Path,
    /// Settings that it holds.
    pub settings: &'a DeviceSettings,
}

/// The scene's radar and settings, its models unopened, completed by the configuration.
///
/// # Errors
/// Faults of the scene, and differences between scene and configuration.
pub fn scene_with(
    file: &Path,
    radar: Option<&str>,
    configured: &ConfigFile<'_>,
) -> Result<SceneHeader, Failure> {
    let changes = changes(file, radar, configured.settings)?;
    let header = loading::radar_changed(file, radar, &changes).map_err(|failure| {
        // A scene that is valid by itself is not at fault.
        match loading::radar_only(file, radar) {
            Ok(_) => failure.named_in(configured.file),
            Err(_) => failure,
        }
    })?;
    match contradiction(&header, configured.settings) {
        None => Ok(header),
        Some(Contradiction { key, scenes, configs, line }) => Err(Failure::Refused(format!(
            "{}: {key} is {scenes}; {}:{line} has {configs}",
            file.display(),
            configured.file.display()
        ))),
    }
}

/// Files that this reading opens: the scene, the pattern and the calibration that it names, and the
/// configuration.
///
/// # Errors
/// Faults of the scene.
pub fn files_with(
    file: &Path,
    radar: Option<&str>,
    configured: &ConfigFile<'_>,
) -> Result<Vec<PathBuf>, Failure> {
    let changes = changes(file, radar, configured.settings)?;
    let of_scene = scene::inputs_without_models(file, &changes, radar).map_err(loading::scene_failure)?;
    Ok([of_scene, vec![configured.file.to_owned()]].concat())
}

/// Changes that add the configuration's values to a scene's radar.
fn changes(
    file: &Path,
    radar: Option<&str>,
    settings: &DeviceSettings,
) -> Result<Vec<scene::Change>, Failure> {
    let keys = SceneKeys::of(file, radar)?;
    let change = |Entry { table, key, value, .. }: Entry| {
        let key = if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") };
        scene::Change { key, value }
    };
    let all = std::iter::once(frame_interval(settings)).chain(entries(settings));
    Ok(all.filter(|entry| !keys.contains(entry.table, entry.key)).map(change).collect())
}

/// Keys present in a scene file.
struct SceneKeys {
    /// Tables of the radar.
    radar: Vec<toml::Table>,
    /// Names of the keys outside tables.
    keys: Vec<String>,
}

/// Largest file; the scene's own reader reports a longer one.
const LIMIT_BYTES: u64 = 4 << 20;

impl SceneKeys {
    fn of(file: &Path, radar: Option<&str>) -> Result<Self, Failure> {
        let text = bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
        // The scene's reader refuses text that is not TOML, with its place.
        let document: toml::Table = toml_text::read(&text).unwrap_or_default();
        let own = document.get("radars").and_then(toml::Value::as_array).into_iter().flatten();
        let is_asked =
            |entry: &&toml::Value| radar.is_some() && entry.get("id").and_then(toml::Value::as_str) == radar;
        let tables = document.get("radar").into_iter().chain(own.filter(is_asked));
        let radar = tables.filter_map(toml::Value::as_table).cloned().collect();
        Ok(Self { radar, keys: document.keys().cloned().collect() })
    }

    /// Whether a key, or an alternative to it, is present.
    fn contains(&self, table: &str, key: &str) -> bool {
        if table.is_empty() {
            return self.keys.iter().any(|said| said == key);
        }
        let table = table.strip_prefix("radar.").unwrap_or(table);
        let keys: &[&str] = match key {
            "idle_us" => &["idle_us", "sub_frame_idle_us"],
            "tx_half_wavelengths" | "rx_half_wavelengths" => {
                &["preset", "tx_half_wavelengths", "rx_half_wavelengths"]
            }
            _ => &[key],
        };
        let has =
            |radar: &toml::Table, key: &str| radar.get(table).is_some_and(|table| table.get(key).is_some());
        self.radar.iter().any(|radar| keys.iter().any(|key| has(radar, key)))
    }
}

/// A value that differs between scene and configuration.
struct Contradiction {
    key: &'static str,
    scenes: String,
    configs: String,
    line: usize,
}

fn contradiction(header: &SceneHeader, settings: &DeviceSettings) -> Option<Contradiction> {
    let radar = &header.radar;
    of_schedule(radar, settings)
        .or_else(|| of_numbers(header, settings))
        .or_else(|| of_array(radar, settings))
        .or_else(|| of_sampling(radar, settings))
}

/// Refuses staggered chirps: frames of a configuration have a single chirp interval.
fn of_schedule(radar: &Radar, settings: &DeviceSettings) -> Option<Contradiction> {
    let us = |all: &[f64]| format!("{:?}", all.iter().map(|s| (s * 1e9).round() / 1e3).collect::<Vec<_>>());
    let said = |key, scenes| {
        let configs = "frames whose chirps follow each other at one interval".to_owned();
        Some(Contradiction { key, scenes, configs, line: settings.frame.line })
    };
    let schedule = &radar.schedule;
    if schedule.sub_frames() > 1 {
        let intervals = us(&schedule.sub_frame_intervals_s);
        return said("radar.waveform.sub_frame_idle_us", format!("one of chirp intervals of {intervals} µs"));
    }
    let key = "radar.waveform.stagger_us";
    if schedule.is_uniform() { None } else { said(key, "not 0 throughout".to_owned()) }
}

fn of_sampling(radar: &Radar, settings: &DeviceSettings) -> Option<Contradiction> {
    let (scenes, configs) = (radar.waveform.sampling, settings.sampling);
    (scenes != configs).then(|| Contradiction {
        key: "radar.receiver.sampling",
        scenes: sampling_word(scenes).into(),
        configs: sampling_word(configs).into(),
        line: settings.profile.line,
    })
}

/// Compares numbers to within a millionth, because people round what a device has in steps.
fn of_numbers(header: &SceneHeader, settings: &DeviceSettings) -> Option<Contradiction> {
    let (w, p) = (&header.radar.waveform, &settings.profile.value);
    let start_ghz = p.start_ghz + 1e-3 * p.slope_mhz_per_us * p.adc_start_us;
    let interval_us = p.idle_us + p.ramp_end_us;
    let (profile, frame) = (settings.profile.line, settings.frame.line);
    let numbers = [
        ("radar.waveform.start_frequency_ghz", w.start_frequency_hz / 1e9, start_ghz, profile),
        ("radar.waveform.slope_mhz_per_us", w.slope_hz_per_s / 1e12, p.slope_mhz_per_us, profile),
        ("radar.waveform.sample_rate_msps", w.sample_rate_hz / 1e6, p.rate_ksps / 1e3, profile),
        ("radar.waveform.samples", f64::from(w.samples), f64::from(p.samples), profile),
        ("the chirp interval in µs", w.chirp_interval_s * 1e6, interval_us, profile),
        ("radar.waveform.chirps", f64::from(w.chirps), f64::from(settings.chirps), frame),
        ("frame_interval_s", header.frame_interval_s, settings.frame.value.period_ms / 1e3, frame),
    ];
    numbers
        .into_iter()
        .find(|(_, a, b, _)| (a - b).abs() > 1e-6 * b.abs())
        .map(|(key, a, b, line)| Contradiction { key, scenes: decimal(a), configs: decimal(b), line })
}

/// Compares elements relative to the mean of their row, as a scene places them.
fn of_array(radar: &Radar, settings: &DeviceSettings) -> Option<Contradiction> {
    let line = settings.channels.line;
    let array = &radar.array;
    let said = |key, scenes: String, configs: String| Contradiction { key, scenes, configs, line };
    let [tx, rx] = [settings.turns.len(), settings.channels.value.receivers.len()];
    let counts = [array.tx_m.len(), array.rx_m.len()];
    if counts != [tx, rx] {
        let told = |[tx, rx]: [usize; 2]| format!("{tx} transmitters and {rx} receivers");
        return Some(said("radar.array", told(counts), told([tx, rx])));
    }
    if tx > 1 && array.multiplexing != Multiplexing::Tdm {
        let word = format!("{:?}", array.multiplexing).to_lowercase();
        return Some(said("radar.array.multiplexing", word, "transmitters in turn, tdm".into()));
    }
    let [tx, rx] = settings.board?.elements();
    let pick = |all: &[[f64; 2]], which: &[usize]| which.iter().map(|i| all[*i]).collect::<Vec<_>>();
    let pairs = [
        ("radar.array.tx_half_wavelengths", &array.tx_half_wavelengths, pick(&tx, &settings.turns)),
        (
            "radar.array.rx_half_wavelengths",
            &array.rx_half_wavelengths,
            pick(&rx, &settings.channels.value.receivers),
        ),
    ];
    pairs
        .into_iter()
        .find(|(_, a, b)| are_apart(a, b))
        .map(|(key, a, b)| said(key, format!("{a:?}"), format!("{b:?}")))
}

fn are_apart(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
    let centred = |all: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let mean = |axis: usize| all.iter().map(|e| e[axis]).sum::<f64>() / all.len().max(1) as f64;
        let (x, y) = (mean(0), mean(1));
        all.iter().map(|e| [e[0] - x, e[1] - y]).collect()
    };
    // A thousandth of half a wavelength changes a phase by 0.2°.
    centred(a).iter().zip(centred(b)).any(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]) > 1e-3)
}
