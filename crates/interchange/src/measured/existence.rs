//! Probability that a detection is not noise, from a single frame.

use artifact::Radar;
use artifact::units::power_from_db;

/// Probability e^{−E} that a map of noise alone has no cell as strong: E is the number of its cells times the
/// probability that the mean power of M channels of noise exceeds its expectation by the factor ρ, Σ_{k<M}
/// (Mρ)^k/k!·e^{−Mρ}, with ρ the signal-to-noise ratio plus 1, the cell's own noise.
pub(crate) fn existence(radar: &Radar, snr_db: f64) -> f64 {
    let channels = radar.virtual_channels().max(1);
    let level = channels as f64 * (power_from_db(snr_db) + 1.0);
    let cells = radar.waveform.range_cells() as f64 * f64::from(radar.waveform.chirps);
    (-cells * tail_probability(channels, level)).exp()
}

/// Probability that a sum of `count` exponential variables of mean 1 exceeds a level.
fn tail_probability(count: usize, level: f64) -> f64 {
    let log_level = level.max(f64::MIN_POSITIVE).ln();
    let (mut total, mut log_factorial) = (0.0, 0.0);
    for k in 0..count {
        log_factorial += if k > 0 { (k as f64).ln() } else { 0.0 };
        total += (k as f64 * log_level - log_factorial - level).exp();
    }
    total.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use radar::aperture::Preset;
    use radar::paper;

    #[test]
    fn a_cell_of_one_channel_holds_its_noise_beside_the_echo() {
        let radar = paper::radar([0.0; 3], paper::waveform(256, 128), Preset::OneByOne.elements());
        for snr_db in [8.0, 10.0, 12.0] {
            let alarms = 256.0 * 128.0 * (-(1.0 + power_from_db(snr_db))).exp();
            assert!((existence(&radar, snr_db) - (-alarms).exp()).abs() < 1e-12, "{snr_db}");
        }
    }

    #[test]
    fn one_channel_is_exponential_and_the_middle_of_many_is_their_mean() {
        for level in [0.5, 3.0, 40.0] {
            let told = tail_probability(1, level) / (-level).exp();
            assert!((told - 1.0).abs() < 1e-12, "{level}");
        }
        // The median of a gamma variable lies a third below its shape, to 0.03 of it (Choi 1994).
        assert!((tail_probability(16, 16.0 - 1.0 / 3.0) - 0.5).abs() < 0.01);
        assert_eq!(tail_probability(12, 1e9), 0.0);
    }
}
