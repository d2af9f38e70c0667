//! Values that differ between sub-frames, for sidecars.

use artifact::cube::CubeHeader;
use serde_json::Value;

/// The value for a radar's frames; with sub-frames a list of such values, one per sub-frame.
pub(crate) fn of_sub_frames(header: &CubeHeader, of: impl Fn(&CubeHeader) -> Value) -> Value {
    match header.radar.schedule.sub_frames() {
        1 => of(header),
        count => (0..count).map(|index| of(&header.in_frame(index))).collect(),
    }
}
