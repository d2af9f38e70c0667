//! A labelled box in the axes of its sensor, and its conversion to the world.

use crate::levelled_axes::{LevelledAxes, wrapped};
use crate::radar_cloud::PLACE_LIMIT_M;
use crate::training_sets::labels::label_error::{LabelError, SIZE_LIMIT_M};
use evaluation::LabelledBox;
use glam::DVec3;

/// An upright box: x ahead, y to the left, z up of the sensor.
pub(super) struct SensorBox {
    /// Middle, m.
    pub(super) middle_m: DVec3,
    /// Length, width, height.
    pub(super) size_m: [f64; 3],
    /// Direction of its front; the part along z is left out.
    pub(super) front: DVec3,
}

impl SensorBox {
    /// The box in the world, for a sensor with these axes.
    ///
    /// # Errors
    /// Its size or place is none of a body that a radar sees, or no number.
    pub(super) fn in_world(&self, axes: &LevelledAxes, number: u32) -> Result<LabelledBox, LabelError> {
        if !self.size_m.iter().all(|side_m| (0.0..=SIZE_LIMIT_M).contains(side_m)) {
            return Err(LabelError::Size);
        }
        if !(0.0..=PLACE_LIMIT_M).contains(&self.middle_m.length()) {
            return Err(LabelError::Place);
        }
        Ok(LabelledBox {
            number,
            foot_m: axes.to_world(self.middle_m) - DVec3::Z * (0.5 * self.size_m[2]),
            size_m: self.size_m,
            yaw_rad: wrapped(self.front.y.atan2(self.front.x) + axes.yaw_rad),
        })
    }
}
