//! Imperfections and interference of the radar: errors of its elements in `[radar.array]`, converter and
//! oscillator in `[radar.receiver]`, and other radars, `[[radar.interferer]]`.

use crate::document::errors::Rule;
use crate::document::keys::array;
use crate::document::keys::key::Key;
use crate::document::keys::kinds::PerElement;
use crate::document::keys::receiver::{
    ADC_BITS, CHIRP_INTERVAL, EIRP, FULL_SCALE, INTERFERER, OFFSET, PHASE_NOISE, POSITION, SLOPE,
    START_FREQUENCY, SWEEP, VELOCITY,
};
use crate::document::section::Section;
use artifact::radar::{
    Adc, ElementError, ElementSpread, Hardware, Interferer, OSCILLATOR_SAMPLES_LIMIT, PhaseNoise, Radar,
};
use artifact::units::watts_from_dbm;
use glam::DVec3;

/// Reads the errors of a mounted radar's elements, its converter, oscillator and interferers; the default is
/// ideal.
pub(crate) fn read_hardware(
    radar: &Section<'_>,
    receiver: &Section<'_>,
    elements: &Section<'_>,
    mounted: &Radar,
) -> Hardware {
    let [tx, rx] = [mounted.array.tx_m.len(), mounted.array.rx_m.len()];
    let interferer = |section: &Section<'_>| read_interferer(section, mounted.position_m);
    Hardware {
        tx: read_elements(elements, [array::TX_GAIN_ERRORS, array::TX_PHASE_ERRORS, array::TX_DELAYS], tx),
        rx: read_elements(elements, [array::RX_GAIN_ERRORS, array::RX_PHASE_ERRORS, array::RX_DELAYS], rx),
        spread: ElementSpread {
            gain_db: elements.or_default(&array::GAIN_SPREAD),
            phase_rad: elements.or_default(&array::PHASE_SPREAD).to_radians(),
        },
        adc: read_adc(receiver),
        phase_noise: read_phase_noise(receiver, mounted),
        interferers: radar.sections(&INTERFERER).iter().map(interferer).collect(),
    }
}

/// Reads as many errors as there are elements, or none without any of the keys.
fn read_elements(section: &Section<'_>, keys: [Key<PerElement>; 3], count: usize) -> Vec<ElementError> {
    let [gains_db, phases_deg, delays_ps] =
        keys.map(|key| section.of_elements(&key, count).unwrap_or(vec![0.0; count]));
    if !keys.iter().any(|key| section.has(key.name)) {
        return vec![];
    }
    let element = |i: usize| ElementError {
        gain_db: gains_db[i],
        phase_rad: phases_deg[i].to_radians(),
        delay_s: delays_ps[i] * 1e-12,
    };
    (0..count).map(element).collect()
}

fn read_adc(section: &Section<'_>) -> Option<Adc> {
    let (bits, full_scale_dbm) = (section.read(&ADC_BITS), section.read(&FULL_SCALE));
    for (key, companion) in [(ADC_BITS.name, FULL_SCALE.name), (FULL_SCALE.name, ADC_BITS.name)] {
        if section.has(key) && !section.has(companion) {
            section.note(key, Rule::Alone { key, companion });
        }
    }
    bits.zip(full_scale_dbm)
        .map(|(bits, dbm)| Adc { bits: bits as u8, full_scale: watts_from_dbm(dbm).sqrt() })
}

fn read_phase_noise(section: &Section<'_>, radar: &Radar) -> Vec<PhaseNoise> {
    let (key, each) = (PHASE_NOISE.name, PHASE_NOISE.takes.pair.each);
    let told = section.read(&PHASE_NOISE).unwrap_or_default();
    for (found, allowed) in told.iter().flat_map(|pair| pair.iter().copied().zip(each)) {
        if !allowed.holds(found) {
            section.note(key, Rule::OutOfRange { key, found, allowed });
        }
    }
    if !told.windows(2).all(|pair| pair[0][0] < pair[1][0]) {
        section.note(key, Rule::NotGrowing { key });
    }
    let duration_s = |index: u32| radar.in_frame(index).frame_duration_s();
    let longest_s = (0..radar.schedule.sub_frames()).map(duration_s).fold(0.0, f64::max);
    let samples = longest_s * radar.waveform.sample_rate_hz;
    if section.has(key) && samples > OSCILLATOR_SAMPLES_LIMIT as f64 {
        section.note(key, Rule::OscillatorTooLong { samples, limit: OSCILLATOR_SAMPLES_LIMIT });
    }
    told.into_iter().map(|[offset_hz, dbc_per_hz]| PhaseNoise { offset_hz, dbc_per_hz }).collect()
}

/// Least distance of another radar, m: nearer, its wave is not in the far field.
const NEAREST_M: f64 = 1.0;

/// Reads another radar; its waveform is by default like ours.
fn read_interferer(section: &Section<'_>, radar_m: [f64; 3]) -> Interferer {
    for key in [POSITION.name, EIRP.name] {
        section.require(key);
    }
    let (sweep_us, interval_us) = (section.or_default(&SWEEP), section.or_default(&CHIRP_INTERVAL));
    if interval_us < sweep_us {
        section.note(CHIRP_INTERVAL.name, Rule::ChirpsOverlap { sweep_us, interval_us });
    }
    let position_m = section.read(&POSITION);
    let away_m = position_m.map(|place_m| DVec3::from(place_m).distance(radar_m.into()));
    if let Some(away_m) = away_m.filter(|away_m| *away_m < NEAREST_M) {
        section.note(POSITION.name, Rule::InterfererNear { away_m, limit_m: NEAREST_M });
    }
    Interferer {
        position_m: position_m.unwrap_or_default(),
        velocity_mps: section.or_default(&VELOCITY),
        eirp_w: watts_from_dbm(section.read(&EIRP).unwrap_or_default()),
        start_frequency_hz: 1e9 * section.or_default(&START_FREQUENCY),
        slope_hz_per_s: 1e12 * section.or_default(&SLOPE),
        sweep_s: 1e-6 * sweep_us,
        chirp_interval_s: 1e-6 * interval_us,
        offset_s: 1e-6 * section.or_default(&OFFSET),
    }
}
