//! `[radar]`: where the radar stands, what it sends, and its link. Its antenna array is in `array.rs`.

use crate::document::errors::Rule;
use crate::document::keys;
use crate::document::ranges::COORDINATES_M;
use crate::document::section::Section;
use crate::models::library::Models;
use crate::radar::array::read_array;
use crate::radar::hardware::read_hardware;
use crate::radar::waveform::read_waveform;
use crate::wording::allowed::Allowed;
use artifact::radar::{Hardware, Link, Multiplexing, Radar, Sampling};
use artifact::units::watts_from_dbm;
use radar::aperture::mounted;

/// Values of a frame's cube: at 8 bytes each one GiB, of which the stages hold a few.
const CUBE_LIMIT: u64 = 1 << 27;

/// The radar of a scene, defaults where it says nothing.
pub(crate) fn read_radar(section: &Section<'_>, models: &mut Models) -> Radar {
    let waveform_section = section.section(&keys::WAVEFORM);
    let receiver = section.section(&keys::RECEIVER);
    let words = [("complex", Sampling::Complex), ("real", Sampling::Real)];
    let sampling = receiver.word("sampling", &words).unwrap_or(Sampling::Complex);
    let (waveform, schedule) = read_waveform(&waveform_section, sampling);
    let array_section = section.section(&keys::ARRAY);
    let mut radar = mounted(Radar {
        position_m: section.vector("position_m", COORDINATES_M).unwrap_or([0.0, 0.0, 6.0]),
        boresight_az_rad: degrees(section, "boresight_az_deg", 360.0),
        boresight_el_rad: degrees(section, "boresight_el_deg", 90.0),
        waveform,
        schedule,
        array: read_array(&array_section, models),
        link: read_link(&section.section(&keys::LINK)),
        hardware: Hardware::default(),
    });
    let elements = [radar.array.tx_m.len(), radar.array.rx_m.len()];
    radar.hardware = read_hardware(section, &receiver, &array_section, elements);
    check_cube(&waveform_section, &radar);
    let divided = match radar.array.multiplexing {
        Multiplexing::Ddm => Some("ddm"),
        Multiplexing::Bpm => Some("bpm"),
        Multiplexing::Simultaneous | Multiplexing::Tdm => None,
    };
    if let Some(multiplexing) = divided.filter(|_| !radar.schedule.is_uniform()) {
        waveform_section.note("stagger_us", Rule::StaggeredDivision { multiplexing });
    }
    radar
}

fn degrees(section: &Section<'_>, key: &'static str, limit: f64) -> f64 {
    section.number(key, Allowed::Between(-limit, limit)).unwrap_or(0.0).to_radians()
}

fn read_link(section: &Section<'_>) -> Link {
    let transmit_power_dbm =
        section.number("transmit_power_dbm", Allowed::Between(-200.0, 200.0)).unwrap_or(12.0);
    let antenna_gain_db = section.number("antenna_gain_dbi", Allowed::Between(-100.0, 100.0)).unwrap_or(10.0);
    Link { transmit_power_w: watts_from_dbm(transmit_power_dbm), antenna_gain_db }
}

fn check_cube(section: &Section<'_>, radar: &Radar) {
    let channels = radar.map_channels() as u64;
    let (chirps, samples) = (u64::from(radar.waveform.chirps), u64::from(radar.waveform.samples));
    if channels * chirps * samples > CUBE_LIMIT {
        section.note("samples", Rule::CubeTooLarge { channels, chirps, samples, limit: CUBE_LIMIT });
    }
}

/// Frames and the time from one to the next; a single frame may last longer than that.
pub(crate) fn read_frames(root: &Section<'_>, radar: &Radar) -> (u32, f64) {
    let frames = root.integer("frames", Allowed::Between(1.0, 1e6)).unwrap_or(1) as u32;
    let interval_s = root.number("frame_interval_s", Allowed::Above(0.0, 1e4)).unwrap_or(0.1);
    let duration_s = radar.cycle_duration_s();
    // A recording has as many frames as fit into it.
    let are_several = frames > 1 || (root.has("traffic") && !root.has("frames"));
    if are_several && interval_s < duration_s {
        root.note("frame_interval_s", Rule::FramesOverlap { interval_s, duration_s });
    }
    (frames * radar.schedule.sub_frames(), interval_s)
}
