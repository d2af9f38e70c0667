//! Ground truth of OSI as the steps of a recording: moving objects by the centres of their bounding boxes.

use crate::recording::fcd::{FcdError, FcdRule, FcdStep, FcdVehicle, RecordedVelocity, RecordingPlace};
use crate::recording::step_order::StepOrder;
use interchange::traffic::{GroundTruthReader, TraceError, TraceRule, TrafficObject};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

pub(crate) use interchange::traffic::{canonical_type_name, type_names};

/// Messages of a trace, in order.
pub(crate) struct TraceReader {
    file: PathBuf,
    messages: GroundTruthReader,
    order: StepOrder,
    /// Sizes of the objects of the last step, by id.
    sizes_m: HashMap<String, [f64; 3]>,
}

impl TraceReader {
    /// Opens a trace, `.osi` or MCAP.
    pub(crate) fn open(file: &Path) -> Result<Self, FcdError> {
        let messages = GroundTruthReader::open(file).map_err(broken)?;
        Ok(Self { file: file.to_owned(), messages, order: StepOrder::default(), sizes_m: HashMap::new() })
    }

    /// The next step; `None` after the last. `front_m` of its vehicles is the middle of the box's lower side,
    /// `line` the number of the message.
    pub(crate) fn next_step(&mut self) -> Result<Option<FcdStep>, FcdError> {
        let Some(told) = self.messages.next_step().map_err(broken)? else { return Ok(None) };
        let sizes = told.objects.iter().filter_map(|object| Some((object.id.clone(), object.size_m?)));
        self.sizes_m = sizes.collect();
        let vehicles = told.objects.into_iter().map(|object| vehicle(object, told.message)).collect();
        let step = FcdStep { time_s: told.time_s, line: told.message, vehicles };
        step.checked(&mut self.order).map_err(|(message, rule)| self.error_at(message, rule))?;
        Ok(Some(step))
    }

    /// Length, width and height of an object of the last step.
    pub(crate) fn size_m(&self, id: &str) -> Option<[f64; 3]> {
        self.sizes_m.get(id).copied()
    }

    /// An error of this trace at a message.
    pub(crate) fn error_at(&self, message: u64, rule: FcdRule) -> FcdError {
        let place = RecordingPlace::Message(message);
        FcdError { file: self.file.clone(), place, rule: Box::new(rule) }
    }
}

fn vehicle(object: TrafficObject, message: u64) -> FcdVehicle {
    FcdVehicle {
        id: object.id,
        kind: object.kind,
        front_m: object.foot_m,
        angle_deg: 90.0 - object.yaw_rad.to_degrees(),
        velocity: object
            .velocity_mps
            .map_or(RecordedVelocity::Unknown, |velocity_mps| RecordedVelocity::Vector { velocity_mps }),
        line: message,
    }
}

fn broken(error: TraceError) -> FcdError {
    let (place, rule) = match error.rule {
        TraceRule::Unreadable(cause) => (RecordingPlace::File, FcdRule::Unreadable(cause)),
        other => (RecordingPlace::Message(error.message), FcdRule::Trace(other.to_string())),
    };
    FcdError { file: error.file, place, rule: Box::new(rule) }
}
