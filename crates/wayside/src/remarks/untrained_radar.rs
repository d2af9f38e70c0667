//! Radars unlike those in the training of the shipped classifier (`docs/classification.md`, the model card).

use artifact::scene::SceneHeader;
use artifact::settings::Noise;

/// Range cells accepted beside those of the training, which have 0.24 m, m.
const RANGE_CELLS_M: [f64; 2] = [0.16, 0.36];
/// Carriers of the 77 GHz band, Hz.
const CARRIERS_HZ: [f64; 2] = [76e9, 81e9];
/// Heights over the road, a metre beyond those of the training, m.
const HEIGHTS_M: [f64; 2] = [3.5, 8.0];

/// Remark on classes in a scene with vehicles and a radar unlike those of the shipped model's training:
/// answers still come with probabilities.
pub(crate) fn remark(header: &SceneHeader) -> Option<String> {
    let has_vehicles = header.targets.iter().any(|target| target.kind.class().is_some());
    let unlike = unlike(header);
    (has_vehicles && !unlike.is_empty()).then(|| {
        format!(
            "note: classes and their probabilities are not to be relied on: the classifier that ships has not \
             learned from {} (docs/classification.md, model card)",
            unlike.join(", ")
        )
    })
}

/// Properties of the scene that the training did not cover.
fn unlike(header: &SceneHeader) -> Vec<String> {
    let waveform = &header.radar.waveform;
    let is_off = |value: f64, [least, most]: [f64; 2]| !(least..=most).contains(&value);
    let (cell_m, carrier_hz) = (waveform.range_resolution_m(), waveform.centre_frequency_hz());
    let height_m = header.radar.position_m[2];
    [
        is_off(cell_m, RANGE_CELLS_M).then(|| format!("range cells of {cell_m:.2} m (0.24 m)")),
        is_off(carrier_hz, CARRIERS_HZ)
            .then(|| format!("a carrier of {:.1} GHz (77 GHz)", carrier_hz * 1e-9)),
        is_off(height_m, HEIGHTS_M).then(|| format!("a radar at {height_m:.1} m (4.5 to 7 m over the road)")),
        matches!(header.noise, Noise::Absent).then(|| "echoes without noise".to_owned()),
        (header.fidelity.bounces < 2).then(|| "bodies of one bounce".to_owned()),
    ]
    .into_iter()
    .flatten()
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header() -> SceneHeader {
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        scene::read(&file, &scene::ReadOptions::names_only()).unwrap()
    }

    #[test]
    fn a_radar_that_the_shipped_model_knows_is_passed_over() {
        assert_eq!(remark(&header()), None);
    }

    #[test]
    fn what_the_shipped_model_has_not_learned_from_is_told() {
        let mut header = header();
        header.radar.waveform.slope_hz_per_s *= 0.25;
        header.noise = Noise::Absent;
        let told = remark(&header).unwrap();
        assert!(told.contains("range cells of 0.96 m (0.24 m), echoes without noise"), "{told}");
        header.targets.clear();
        assert_eq!(remark(&header), None, "no vehicle, no class");
    }
}
