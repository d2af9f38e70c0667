//! FINUFFT's two-dimensional transforms of the same tones, by a script.

use artifact::paths::Path;
use artifact::radar::Radar;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use std::f64::consts::TAU;
use std::io::Write;
use std::process::{Command, Stdio};

/// Prints the seconds of as many transforms as the sum takes at -60 dB: 12 channels at 4 instants.
pub(crate) fn print_seconds(radar: &Radar, paths: &[Path]) {
    let tones: Vec<u8> = paths.iter().flat_map(|path| tone(radar, path)).flat_map(f32::to_le_bytes).collect();
    let script = include_str!("finufft.py");
    let mut command = Command::new("python3");
    command
        .args(["-c", script, "48", "1e-3"])
        .arg(rayon::current_num_threads().to_string())
        .stdin(Stdio::piped());
    let given = command.spawn().and_then(|mut child| {
        if let Some(pipe) = child.stdin.as_mut() {
            pipe.write_all(&tones)?;
        }
        drop(child.stdin.take());
        child.wait()
    });
    if let Err(error) = given {
        println!("skipped: python3 ({error})");
    }
}

/// Phase from sample to sample and from chirp to chirp in the middle of the frame, rad in [-π, π).
fn tone(radar: &Radar, path: &Path) -> [f32; 2] {
    let wave = &radar.waveform;
    let middle_s = 0.5 * f64::from(wave.chirps) * wave.chirp_interval_s;
    let of = |at_m: [f64; 3], velocity_mps: [f64; 3]| {
        let way = DVec3::from(at_m) + middle_s * DVec3::from(velocity_mps) - DVec3::from(radar.position_m);
        (way.length(), way.normalize_or_zero().dot(DVec3::from(velocity_mps)))
    };
    let (transmitted, received) =
        (of(path.apparent_tx_m, path.apparent_tx_mps), of(path.apparent_rx_m, path.apparent_rx_mps));
    let delay_s = (transmitted.0 + received.0) / SPEED_OF_LIGHT_MPS;
    let rate = (transmitted.1 + received.1) / SPEED_OF_LIGHT_MPS;
    let cycles = [
        wave.slope_hz_per_s * delay_s / wave.sample_rate_hz,
        wave.centre_frequency_hz() * rate * wave.chirp_interval_s,
    ];
    cycles.map(|cycles| (TAU * (cycles - cycles.round())) as f32)
}
