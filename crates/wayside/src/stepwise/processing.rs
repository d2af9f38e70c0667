//! Products of a receiver: maps of cubes, points and objects, tracks, classes.

use artifact::Provenance;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::points::{PointsFrame, PointsHeader};
use artifact::rdm::RdmFrame;
use artifact::settings::{Class, Refine};
use artifact::tracks::{TracksFrame, TracksHeader};
use dsp::{ROAD_TRAFFIC, Receiver, Tracker, has_noise};
use pipeline::chain::loaded_model::LoadedModel;
use pipeline::chain::stages::Stage;
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use radar::lattice::resolves_azimuth;
use reporting::console_lines::{WITHOUT_AZIMUTH, WITHOUT_NOISE, without_height};

/// Processing of the cubes of one radar, from the cubes alone.
pub struct Processing {
    header: CubeHeader,
    receiver: Receiver,
}

/// Refusal of maps without samples, whose settings refine points on samples.
const WITHOUT_SAMPLES: &str = "refine = \"on\" in [dsp] refines points on the samples, which maps of a file \
                               do not have: detect on maps of the cube";

/// Answer of a classifier about an object.
pub struct Classification {
    /// Probabilities of the classes, in the order of [`Processing::class_names`].
    pub probabilities: [f32; 4],
    /// Name of the predicted class, or "unknown".
    pub class_name: &'static str,
}

impl Processing {
    /// Makes the receiver of the cubes that a header describes.
    ///
    /// # Errors
    /// The radar or its settings allow no map or no threshold.
    pub fn of(header: &CubeHeader) -> Result<Self, Failure> {
        let receiver = Receiver::new(header).map_err(Failure::refused)?;
        Ok(Self { header: header.clone(), receiver })
    }

    /// Provenance of products of a cube with this provenance.
    pub fn provenance(&self, cube: &Provenance) -> Provenance {
        Provenance {
            stage: Stage::Dsp.name().into(),
            program_version: env!("CARGO_PKG_VERSION").into(),
            inputs: cube.inputs.clone(),
            settings: serde_json::to_string(&self.header.dsp).unwrap_or_default(),
            seed: cube.seed,
        }
    }

    /// Header of points, without ground truth.
    pub fn points_header(&self) -> PointsHeader {
        PointsHeader { cube: Some(self.header.clone()), targets: vec![], classes: vec![] }
    }

    /// Header of tracks.
    pub fn tracks_header(&self) -> TracksHeader {
        TracksHeader { cube: Some(self.header.clone()) }
    }

    /// Ranges of a map's columns in m, and velocities of its rows in m/s, of the first sub-frame.
    pub fn axes(&self) -> (Vec<f64>, Vec<f64>) {
        let first = self.header.in_frame(0);
        (dsp::range_axis_m(&first), dsp::velocity_axis_mps(&first))
    }

    /// Velocities of the rows of a frame's map in m/s, of its own sub-frame.
    pub fn velocities_mps(&self, frame: u32) -> Vec<f64> {
        dsp::velocity_axis_mps(&self.header.in_frame(frame))
    }

    /// Range-Doppler maps of all frames, with the cells that the detector tested and found.
    ///
    /// # Errors
    /// Samples that are not the radar's; cancelled between two frames.
    pub fn maps(&self, cubes: &[CubeFrame], cancellation: &Cancellation) -> Result<Vec<RdmFrame>, Failure> {
        each(cubes.iter(), cancellation, |cube| self.receiver.range_doppler(cube).map_err(Failure::refused))
    }

    /// Points and objects of all frames, the velocities of sub-frames resolved by each other.
    ///
    /// # Errors
    /// Maps and cubes that are not the radar's; cancelled between two frames.
    pub fn points(
        &self,
        maps: &[RdmFrame],
        cubes: &[CubeFrame],
        cancellation: &Cancellation,
    ) -> Result<Vec<PointsFrame>, Failure> {
        let detect = |(map, cube)| self.receiver.detect_refined(map, cube).map_err(Failure::refused);
        Ok(self.resolved(&each(maps.iter().zip(cubes), cancellation, detect)?))
    }

    /// Points and objects of maps without their samples, as [`Self::points`] finds them.
    ///
    /// # Errors
    /// Settings that refine points on the samples; maps that are not the radar's; cancelled between two
    /// frames.
    pub fn points_of_maps(
        &self,
        maps: &[RdmFrame],
        cancellation: &Cancellation,
    ) -> Result<Vec<PointsFrame>, Failure> {
        if self.header.dsp.refine == Refine::Isolated {
            return Err(Failure::refused(WITHOUT_SAMPLES));
        }
        let detect = |map| self.receiver.detect(map).map_err(Failure::refused);
        Ok(self.resolved(&each(maps.iter(), cancellation, detect)?))
    }

    /// Points with the velocities of sub-frames resolved by each other, cycle by cycle.
    fn resolved(&self, detected: &[PointsFrame]) -> Vec<PointsFrame> {
        let cycles = detected.chunks(self.receiver.frames_in_cycle());
        cycles.flat_map(|cycle| self.receiver.resolved(cycle.to_vec())).collect()
    }

    /// Sentences about missing properties of points, as printed by `dsp` and `run`: noise, azimuths, heights.
    pub fn remarks(&self, points: &[PointsFrame]) -> Vec<String> {
        let noise = (!has_noise(&self.header)).then(|| WITHOUT_NOISE.to_owned());
        let azimuths = (!resolves_azimuth(&self.header.radar)).then(|| WITHOUT_AZIMUTH.to_owned());
        let without = points.iter().map(PointsFrame::points_without_height).sum();
        let heights = without_height([without, points.iter().map(|frame| frame.points.len()).sum()]);
        noise.into_iter().chain(azimuths).chain(heights).collect()
    }

    /// Objects followed over the frames.
    ///
    /// # Errors
    /// Settings that nothing can be followed by; cancelled between two frames.
    pub fn tracks(
        &self,
        points: &[PointsFrame],
        cancellation: &Cancellation,
    ) -> Result<Vec<TracksFrame>, Failure> {
        let mut tracker = Tracker::new(&self.header, ROAD_TRAFFIC).map_err(Failure::refused)?;
        each(points.iter(), cancellation, |frame| tracker.step(frame).map_err(Failure::refused))
    }

    /// Classes of the objects of all frames, each with its index, objects in their order.
    ///
    /// # Errors
    /// A model that cannot answer about these maps; cancelled between two frames.
    pub fn classes(
        &self,
        model: &LoadedModel,
        maps: &[RdmFrame],
        points: &[PointsFrame],
        cancellation: &Cancellation,
    ) -> Result<Vec<(u32, Vec<Classification>)>, Failure> {
        let pairs = maps.iter().zip(points);
        each(pairs, cancellation, |(map, frame)| Ok((frame.index, self.classes_in(model, map, frame)?)))
    }

    fn classes_in(
        &self,
        model: &LoadedModel,
        map: &RdmFrame,
        points: &PointsFrame,
    ) -> Result<Vec<Classification>, Failure> {
        let rule = model.rule();
        let answered = |probabilities: [f32; 4]| Classification {
            class_name: rule.predict(&probabilities).name(),
            probabilities,
        };
        Ok(model.classify(&self.receiver, map, points)?.into_iter().map(answered).collect())
    }

    /// Names of the classes.
    pub fn class_names() -> [&'static str; 4] {
        Class::ALL.map(Class::name)
    }
}

/// Results of frames one after the other, told of as they are begun; none is begun once the work was called
/// off.
fn each<F, T>(
    frames: impl ExactSizeIterator<Item = F>,
    cancellation: &Cancellation,
    mut make: impl FnMut(F) -> Result<T, Failure>,
) -> Result<Vec<T>, Failure> {
    let of = frames.len();
    let make = |frame| cancellation.check().and_then(|()| make(frame));
    progress::counted("frames", frames, of).map(make).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    #[test]
    fn no_frame_is_begun_once_the_work_was_called_off() {
        let (cancellation, mut begun) = (Cancellation::default(), vec![]);
        let made = each([3, 4, 5, 6].iter(), &cancellation, |frame| {
            begun.push(*frame);
            if *frame == 4 {
                cancellation.cancel();
            }
            Ok(())
        });
        assert!(matches!(made, Err(Failure::Cancelled)));
        assert_eq!(begun, [3, 4]);
    }

    #[test]
    fn frames_are_told_of_as_they_are_begun() {
        let caller = progress::Caller::unique();
        let share = || progress::state_for(caller, Instant::now(), Duration::ZERO).map(|state| state.share);
        let shares = caller.during(|| each([0; 4].iter(), &Cancellation::default(), |_| Ok(share())));
        assert_eq!(shares.unwrap(), [Some(0.0), Some(0.25), Some(0.5), Some(0.75)]);
    }
}
