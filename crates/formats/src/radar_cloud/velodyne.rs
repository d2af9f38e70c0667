//! Rows of View-of-Delft's radar clouds: seven float32 per detection: x, y, z, RCS, v_r, v_r compensated for
//! the vehicle's own motion, and the number of its scan, 0 the current one.

use crate::radar_cloud::cloud_error::CloudError;
use crate::radar_cloud::{DETECTION_LIMIT, Detection};
use glam::DVec3;

/// Bytes of a row.
const ROW_BYTES: usize = 28;

/// Bytes of detections; the radar is at rest, so that both velocities are equal.
pub(crate) fn to_bytes(detections: &[Detection]) -> Vec<u8> {
    let row = |seen: &Detection| {
        let DVec3 { x, y, z } = seen.place_m;
        [x, y, z, seen.section_dbsm, seen.velocity_mps, seen.velocity_mps, 0.0]
    };
    detections.iter().flat_map(row).flat_map(|value| (value as f32).to_le_bytes()).collect()
}

/// Detections of a file. Velocities are relative to the radar, as measured.
///
/// # Errors
/// The file ends within a row, has too many rows, or one with invalid numbers.
pub(crate) fn of_bytes(bytes: &[u8]) -> Result<Vec<Detection>, CloudError> {
    if !bytes.len().is_multiple_of(ROW_BYTES) {
        return Err(CloudError::PartOfRow(bytes.len()));
    }
    if bytes.len() / ROW_BYTES > DETECTION_LIMIT {
        return Err(CloudError::TooManyDetections { limit: DETECTION_LIMIT });
    }
    bytes.chunks_exact(ROW_BYTES).enumerate().map(|(number, row)| of_row(number, row)).collect()
}

fn of_row(number: usize, row: &[u8]) -> Result<Detection, CloudError> {
    let value = |column: usize| {
        let bytes: [u8; 4] = std::array::from_fn(|byte| row[4 * column + byte]);
        f64::from(f32::from_le_bytes(bytes))
    };
    let place_m = DVec3::new(value(0), value(1), value(2));
    let seen = Detection { place_m, section_dbsm: value(3), velocity_mps: value(4) };
    seen.is_sound().then_some(seen).ok_or(CloudError::UnsoundRow(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen() -> Detection {
        Detection { place_m: DVec3::new(30.0, -2.5, -5.25), section_dbsm: 10.5, velocity_mps: -9.75 }
    }

    #[test]
    fn rows_come_back_as_they_went() {
        let bytes = to_bytes(&[seen(), seen()]);
        assert_eq!(bytes.len(), 56);
        assert_eq!(of_bytes(&bytes).unwrap(), [seen(), seen()]);
        assert_eq!(of_bytes(&[]).unwrap(), []);
    }

    #[test]
    fn rows_that_are_cut_off_many_or_no_numbers_are_refused() {
        assert!(of_bytes(&to_bytes(&[seen()])[1..]).is_err_and(|e| e.to_string().contains("whole rows")));
        let strange = Detection { velocity_mps: f64::NAN, ..seen() };
        assert!(of_bytes(&to_bytes(&[seen(), strange])).is_err_and(|e| e.to_string().starts_with("row 1")));
        assert!(
            of_bytes(&vec![0; ROW_BYTES * (DETECTION_LIMIT + 1)])
                .is_err_and(|e| e.to_string().contains("most"))
        );
    }
}
