//! `[radar]`: position, waveform and link of the radar. Its antenna array is in `array.rs`.

use crate::document::errors::Rule;
use crate::document::keys::array::{ARRAY, TX};
use crate::document::keys::radar::{
    ANTENNA_GAIN, BORESIGHT_AZ, BORESIGHT_EL, LINK, POSITION, TRANSMIT_POWER,
};
use crate::document::keys::receiver::{RECEIVER, SAMPLING};
use crate::document::keys::scene::{FRAME_INTERVAL, FRAMES, TRAFFIC_KEY};
use crate::document::keys::waveform::{SAMPLES, STAGGER, WAVEFORM};
use crate::document::section::Section;
use crate::models::library::Models;
use crate::radar::array::read_array;
use crate::radar::hardware::read_hardware;
use crate::radar::waveform::read_waveform;
use artifact::cube::CUBE_LIMIT;
use artifact::radar::{Hardware, Link, Multiplexing, Radar};
use artifact::units::watts_from_dbm;
use radar::aperture::mounted;
use radar::lattice::check_directions;

/// Reads the radar of a scene, with defaults for omitted keys.
pub(crate) fn read_radar(section: &Section<'_>, models: &mut Models) -> Radar {
    let waveform_section = section.section(&WAVEFORM);
    let receiver = section.section(&RECEIVER);
    let (waveform, schedule) = read_waveform(&waveform_section, receiver.or_default(&SAMPLING));
    let array_section = section.section(&ARRAY);
    let mut radar = mounted(Radar {
        position_m: section.or_default(&POSITION),
        boresight_az_rad: section.or_default(&BORESIGHT_AZ).to_radians(),
        boresight_el_rad: section.or_default(&BORESIGHT_EL).to_radians(),
        waveform,
        schedule,
        array: read_array(&array_section, models),
        link: read_link(&section.section(&LINK)),
        hardware: Hardware::default(),
    });
    radar.hardware = read_hardware(section, &receiver, &array_section, &radar);
    check_cube(&waveform_section, &radar);
    if let Err(error) = check_directions(&radar) {
        array_section.note(TX.name, Rule::Directions(error));
    }
    let divided = match radar.array.multiplexing {
        Multiplexing::Ddm => Some("ddm"),
        Multiplexing::Bpm => Some("bpm"),
        Multiplexing::Simultaneous | Multiplexing::Tdm => None,
    };
    if let Some(multiplexing) = divided.filter(|_| !radar.schedule.is_uniform()) {
        waveform_section.note(STAGGER.name, Rule::StaggeredDivision { multiplexing });
    }
    radar
}

fn read_link(section: &Section<'_>) -> Link {
    let transmit_power_dbm = section.or_default(&TRANSMIT_POWER);
    let antenna_gain_db = section.or_default(&ANTENNA_GAIN);
    Link { transmit_power_w: watts_from_dbm(transmit_power_dbm), antenna_gain_db }
}

fn check_cube(section: &Section<'_>, radar: &Radar) {
    let channels = radar.map_channels() as u64;
    let (chirps, samples) = (u64::from(radar.waveform.chirps), u64::from(radar.waveform.samples));
    if channels * chirps * samples > CUBE_LIMIT {
        section.note(SAMPLES.name, Rule::CubeTooLarge { channels, chirps, samples, limit: CUBE_LIMIT });
    }
}

/// Number of frames and their interval; a single frame may last longer than the interval.
pub(crate) fn read_frames(root: &Section<'_>, radar: &Radar) -> (u32, f64) {
    let frames = root.or_default(&FRAMES) as u32;
    let interval_s = root.or_default(&FRAME_INTERVAL);
    let duration_s = radar.cycle_duration_s();
    // A recording has as many frames as fit into it.
    let are_several = frames > 1 || (root.has(TRAFFIC_KEY.name) && !root.has(FRAMES.name));
    if are_several && interval_s < duration_s {
        root.note(FRAME_INTERVAL.name, Rule::FramesOverlap { interval_s, duration_s });
    }
    (frames * radar.schedule.sub_frames(), interval_s)
}
