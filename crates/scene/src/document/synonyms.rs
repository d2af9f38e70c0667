//! Names of keys in other programs and data sheets, too different from ours to be found by spelling.

use crate::document::keys::key::Table;

/// Common names, each with the keys that they mean, the likelier first if several tables have one.
const SYNONYMS: [(&str, &[&str]); 86] = [
    ("tilt_deg", &["boresight_el_deg"]),
    ("tilt", &["boresight_el_deg"]),
    ("downtilt_deg", &["boresight_el_deg"]),
    ("pitch_deg", &["boresight_el_deg"]),
    ("pitch", &["boresight_el_deg"]),
    ("elevation_deg", &["boresight_el_deg"]),
    ("elevation", &["boresight_el_deg"]),
    ("el_deg", &["boresight_el_deg"]),
    ("pan_deg", &["boresight_az_deg"]),
    ("azimuth_deg", &["boresight_az_deg"]),
    ("azimuth", &["boresight_az_deg"]),
    ("az_deg", &["boresight_az_deg"]),
    ("yaw_deg", &["boresight_az_deg"]),
    ("yaw", &["yaw_deg", "boresight_az_deg"]),
    ("heading_deg", &["yaw_deg", "boresight_az_deg"]),
    ("heading", &["yaw_deg", "boresight_az_deg"]),
    ("orientation_deg", &["yaw_deg", "boresight_az_deg"]),
    ("rotation_deg", &["yaw_deg", "boresight_az_deg"]),
    ("angle_deg", &["yaw_deg"]),
    ("mount_height_m", &["position_m"]),
    ("height_m", &["position_m"]),
    ("location_m", &["position_m"]),
    ("xyz_m", &["position_m"]),
    ("x_m", &["position_m"]),
    ("z_m", &["position_m"]),
    ("range_m", &["position_m"]),
    ("speed_mps", &["velocity_mps"]),
    ("speed", &["velocity_mps"]),
    ("speed_kmh", &["velocity_mps"]),
    ("v_mps", &["velocity_mps"]),
    ("rcs_dbsm", &["rcs_m2"]),
    ("rcs_db", &["rcs_m2"]),
    ("sigma_m2", &["rcs_m2"]),
    ("type", &["kind", "model"]),
    ("shape", &["kind", "model"]),
    ("file", &["model", "fcd"]),
    ("mesh", &["model"]),
    ("path", &["model", "fcd"]),
    ("vehicle", &["model"]),
    ("scale", &["unit_scale"]),
    ("units", &["unit_scale"]),
    ("name", &["id"]),
    ("label", &["class", "id"]),
    ("bandwidth_mhz", &["slope_mhz_per_us"]),
    ("bandwidth_ghz", &["slope_mhz_per_us"]),
    ("bandwidth", &["slope_mhz_per_us"]),
    ("chirp_rate", &["slope_mhz_per_us"]),
    ("ramp_slope", &["slope_mhz_per_us"]),
    ("carrier_ghz", &["start_frequency_ghz"]),
    ("frequency_ghz", &["start_frequency_ghz"]),
    ("fc_ghz", &["start_frequency_ghz"]),
    ("f0_ghz", &["start_frequency_ghz"]),
    ("adc_rate_msps", &["sample_rate_msps"]),
    ("fs_msps", &["sample_rate_msps"]),
    ("num_samples", &["samples"]),
    ("n_samples", &["samples"]),
    ("adc_samples", &["samples"]),
    ("num_chirps", &["chirps"]),
    ("n_chirps", &["chirps"]),
    ("loops", &["chirps"]),
    ("pri_us", &["idle_us"]),
    ("chirp_time_us", &["idle_us"]),
    ("chirp_interval_us", &["idle_us"]),
    ("ramp_time_us", &["idle_us", "sweep_us"]),
    ("num_frames", &["frames"]),
    ("n_frames", &["frames"]),
    ("frame_rate_hz", &["frame_interval_s"]),
    ("fps", &["frame_interval_s"]),
    ("dt_s", &["frame_interval_s"]),
    ("period_s", &["frame_interval_s"]),
    ("duration_s", &["frames"]),
    ("max_bounces", &["bounces"]),
    ("reflections", &["bounces"]),
    ("max_depth", &["bounces"]),
    ("order", &["bounces"]),
    ("diffraction", &["edges"]),
    ("goal", &["for"]),
    ("purpose", &["for"]),
    ("pfa", &["false_alarm_rate"]),
    ("cfar", &["detector"]),
    ("window", &["range_window"]),
    ("power_dbm", &["transmit_power_dbm", "eirp_dbm"]),
    ("gain_dbi", &["antenna_gain_dbi"]),
    ("nf_db", &["noise_figure_db"]),
    ("mimo", &["multiplexing"]),
    ("material", &["substance", "materials"]),
];

/// The key of `table` meant by another program's name.
pub(crate) fn synonym_in_table(found: &str, table: &Table) -> Option<&'static str> {
    synonyms(found).find(|key| table.has(key))
}

/// Keys of any table meant by another program's name, the likelier first.
pub(crate) fn synonyms(found: &str) -> impl Iterator<Item = &'static str> + use<> {
    let found = found.to_ascii_lowercase();
    let row = SYNONYMS.iter().find(|(word, _)| *word == found);
    row.into_iter().flat_map(|(_, keys)| keys.iter().copied())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::keys::TABLES;
    use std::collections::BTreeSet;

    #[test]
    fn every_synonym_is_of_a_key_that_there_is_and_told_once() {
        let words: BTreeSet<&str> = SYNONYMS.iter().map(|(word, _)| *word).collect();
        assert_eq!(words.len(), SYNONYMS.len());
        for key in SYNONYMS.iter().flat_map(|(_, keys)| *keys) {
            assert!(TABLES.iter().any(|table| table.has(key)), "{key}");
        }
    }
}
