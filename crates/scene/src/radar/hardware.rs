//! What of the radar is not ideal: errors of its elements in `[radar.array]`, converter and oscillator in
//! `[radar.receiver]`, and other radars, `[[radar.interferer]]`.

use crate::document::errors::Rule;
use crate::document::keys;
use crate::document::ranges::{COORDINATES_M, VELOCITIES_MPS};
use crate::document::section::Section;
use crate::wording::allowed::Allowed;
use artifact::radar::{Adc, ElementError, ElementSpread, Hardware, Interferer, PhaseNoise};
use artifact::units::watts_from_dbm;

/// Beyond this an element is dead or wrongly built: a decade of amplitude, a nanosecond (30 cm) of line.
const GAINS_DB: Allowed = Allowed::Between(-20.0, 20.0);
const PHASES_DEG: Allowed = Allowed::Between(-360.0, 360.0);
const DELAYS_PS: Allowed = Allowed::Between(0.0, 1000.0);

/// Errors of `transmitters` and `receivers` elements and the converter; ideal where the scene says nothing.
pub(crate) fn read_hardware(
    radar: &Section<'_>,
    receiver: &Section<'_>,
    array: &Section<'_>,
    [tx, rx]: [usize; 2],
) -> Hardware {
    Hardware {
        tx: read_elements(array, ["tx_gain_errors_db", "tx_phase_errors_deg", "tx_delays_ps"], tx),
        rx: read_elements(array, ["rx_gain_errors_db", "rx_phase_errors_deg", "rx_delays_ps"], rx),
        spread: ElementSpread {
            gain_db: array.number("gain_spread_db", Allowed::Between(0.0, 10.0)).unwrap_or(0.0),
            phase_rad: array
                .number("phase_spread_deg", Allowed::Between(0.0, 180.0))
                .unwrap_or(0.0)
                .to_radians(),
        },
        adc: read_adc(receiver),
        phase_noise: read_phase_noise(receiver),
        interferers: radar.sections(&keys::INTERFERER).iter().map(read_interferer).collect(),
    }
}

/// As many as there are elements, or none where no key is there.
fn read_elements(
    section: &Section<'_>,
    [gains, phases, delays]: [&'static str; 3],
    count: usize,
) -> Vec<ElementError> {
    let length = Allowed::Between(count as f64, count as f64);
    let listed = |key, allowed| section.numbers(key, length, allowed).unwrap_or(vec![0.0; count]);
    let (gains_db, phases_deg, delays_ps) =
        (listed(gains, GAINS_DB), listed(phases, PHASES_DEG), listed(delays, DELAYS_PS));
    if ![gains, phases, delays].iter().any(|key| section.has(key)) {
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
    let bits = section.integer("adc_bits", Allowed::Between(1.0, 24.0));
    let full_scale_dbm = section.number("full_scale_dbm", Allowed::Between(-300.0, 200.0));
    for (key, companion) in [("adc_bits", "full_scale_dbm"), ("full_scale_dbm", "adc_bits")] {
        if section.has(key) && !section.has(companion) {
            section.note(key, Rule::Alone { key, companion });
        }
    }
    bits.zip(full_scale_dbm)
        .map(|(bits, dbm)| Adc { bits: bits as u8, full_scale: watts_from_dbm(dbm).sqrt() })
}

/// Offsets from the carrier up to a terahertz, levels below the carrier's own.
fn read_phase_noise(section: &Section<'_>) -> Vec<PhaseNoise> {
    const KEY: &str = "phase_noise_dbc_hz";
    let (offsets, levels) = (Allowed::Above(0.0, 1e12), Allowed::Between(-300.0, 0.0));
    let told =
        section.pairs(KEY, Allowed::Between(1.0, 64.0), Allowed::Between(-300.0, 1e12)).unwrap_or_default();
    for (found, allowed) in told.iter().flat_map(|[offset, level]| [(*offset, offsets), (*level, levels)]) {
        if !allowed.holds(found) {
            section.note(KEY, Rule::OutOfRange { key: KEY, found, allowed });
        }
    }
    if !told.windows(2).all(|pair| pair[0][0] < pair[1][0]) {
        section.note(KEY, Rule::NotGrowing { key: KEY });
    }
    told.into_iter().map(|[offset_hz, dbc_per_hz]| PhaseNoise { offset_hz, dbc_per_hz }).collect()
}

/// Another radar; its waveform is by default like ours.
fn read_interferer(section: &Section<'_>) -> Interferer {
    for key in ["position_m", "eirp_dbm"] {
        section.require(key);
    }
    let number = |key, allowed, default| section.number(key, allowed).unwrap_or(default);
    // A tenth of a microsecond: more of its chirps in one of ours no radar sends.
    let (sweep_us, interval_us) = (
        number("sweep_us", Allowed::Between(0.1, 1e6), 50.0),
        number("chirp_interval_us", Allowed::Between(0.1, 1e6), 60.0),
    );
    if interval_us < sweep_us {
        section.note("chirp_interval_us", Rule::ChirpsOverlap { sweep_us, interval_us });
    }
    Interferer {
        position_m: section.vector("position_m", COORDINATES_M).unwrap_or_default(),
        velocity_mps: section.vector("velocity_mps", VELOCITIES_MPS).unwrap_or_default(),
        eirp_w: watts_from_dbm(number("eirp_dbm", Allowed::Between(-200.0, 200.0), 0.0)),
        start_frequency_hz: 1e9 * number("start_frequency_ghz", Allowed::Between(0.1, 1000.0), 77.0),
        slope_hz_per_s: 1e12 * number("slope_mhz_per_us", Allowed::Between(-1e4, 1e4), 12.5),
        sweep_s: 1e-6 * sweep_us,
        chirp_interval_s: 1e-6 * interval_us,
        offset_s: 1e-6 * number("offset_us", Allowed::Between(-1e9, 1e9), 0.0),
    }
}
