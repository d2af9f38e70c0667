//! A request that the tests of this folder share.

use bart_rcs::RcsRequest;

/// A plain far-field request over frequencies and azimuths.
pub(super) fn request_of(frequency_hz: &[f64], azimuth_rad: &[f64]) -> RcsRequest {
    RcsRequest { bounces: 1, ..RcsRequest::over(frequency_hz.to_vec(), vec![0.0], azimuth_rad.to_vec()) }
}
