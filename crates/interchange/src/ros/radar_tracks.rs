//! Tracks as `radar_msgs/RadarTracks` in world coordinates: the middle of the box, its length and width, and
//! the variances of place and velocity. Values that are not estimated have the message's mark for unknown,
//! −1.

use crate::measured::box_covariance::middle_covariance;
use crate::measured::frame_names::WORLD;
use crate::ros::cdr::Cdr;
use artifact::tracks::{Track, TrackState, TracksFrame};

/// The message's value for an unknown variance.
const UNKNOWN: f64 = -1.0;
/// The message's class for objects without a class of their own, moving or at rest.
const NO_CLASSIFICATION: u16 = 0;

/// Encodes the confirmed and coasting tracks of a frame.
pub(crate) fn message(frame: &TracksFrame) -> Vec<u8> {
    let believed: Vec<&Track> =
        frame.tracks.iter().filter(|track| track.state != TrackState::Tentative).collect();
    let mut message = Cdr::stamped(frame.time_s, WORLD);
    message.count(believed.len());
    believed.into_iter().for_each(|track| put(&mut message, track));
    message.finish()
}

fn put(message: &mut Cdr, track: &Track) {
    let footprint = &track.footprint;
    let ([x, y], [vx, vy]) = (footprint.centre_m, track.velocity_mps);
    message.raw(&uuid(track.id));
    message.doubles(&[x, y, 0.0]);
    message.doubles(&[vx, vy, 0.0]);
    message.doubles(&[0.0; 3]);
    message.doubles(&[footprint.length_m, footprint.width_m, 0.0]);
    message.put(NO_CLASSIFICATION.to_le_bytes());
    let velocity =
        std::array::from_fn(|row| std::array::from_fn(|column| track.covariance[2 + row][2 + column]));
    message.floats(&upper_triangle(middle_covariance(track)));
    message.floats(&upper_triangle(velocity));
    message.floats(&[UNKNOWN; 6]);
    message.floats(&[UNKNOWN; 6]);
}

/// xx, xy, xz, yy, yz, zz of a covariance along x and y.
fn upper_triangle([[xx, xy], [_, yy]]: [[f64; 2]; 2]) -> [f64; 6] {
    [xx, xy, UNKNOWN, yy, UNKNOWN, UNKNOWN]
}

/// An identifier that is unique in the recording, and the same in every run.
fn uuid(id: u32) -> [u8; 16] {
    let mut uuid = [0; 16];
    uuid[12..].copy_from_slice(&id.to_be_bytes());
    uuid
}
