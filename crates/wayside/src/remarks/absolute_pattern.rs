//! Antenna patterns that contain a gain of their own beside the gain they are relative to.

use artifact::pattern::Pattern;
use artifact::radar::Radar;

/// Ripple above the peak gain that measured tables may have, dB.
const OVER_PEAK_DB: f64 = 3.0;

/// Remark on a table whose peak is well above the elements' gain: it is in dBi, as in data sheets, and the
/// gain counts twice.
pub(super) fn remark(radar: &Radar) -> Option<String> {
    let Pattern::Table(table) = &radar.array.pattern else { return None };
    let peak_db = 20.0 * table.amplitude.iter().copied().fold(0.0, f64::max).log10();
    let gain_db = radar.link.antenna_gain_db;
    (peak_db > OVER_PEAK_DB && gain_db > 0.0).then(|| {
        format!(
            "note: pattern_file reaches {peak_db:.1} dB over antenna_gain_dbi = {gain_db}, {:.1} dBi in all: \
             where it tells dBi, antenna_gain_dbi is 0",
            peak_db + gain_db
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::pattern::PatternTable;

    #[test]
    fn a_pattern_in_dbi_over_a_gain_is_remarked_on_and_one_that_peaks_at_it_is_not() {
        let options = scene::ReadOptions::names_only();
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/experiment-1.toml");
        let mut radar = scene::read(&file, &options).unwrap().radar;
        let mut told = |peak_db: f64, gain_db: f64| {
            let amplitude = [-20.0, peak_db, -20.0].map(|db: f64| 10.0_f64.powf(db / 20.0)).to_vec();
            let table =
                PatternTable { azimuth_rad: vec![-1.0, 0.0, 1.0], elevation_rad: vec![0.0], amplitude };
            radar.array.pattern = Pattern::Table(table);
            radar.link.antenna_gain_db = gain_db;
            remark(&radar)
        };
        assert_eq!(
            told(13.0, 10.0).unwrap(),
            "note: pattern_file reaches 13.0 dB over antenna_gain_dbi = 10, 23.0 dBi in all: where it tells \
             dBi, antenna_gain_dbi is 0"
        );
        assert_eq!(told(0.4, 10.0), None);
        assert_eq!(told(13.0, 0.0), None);
    }
}
