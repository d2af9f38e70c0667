//! Products of a receiver: maps of cubes, points and objects, tracks, classes.

use artifact::Provenance;
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::points::{PointsFrame, PointsHeader};
use artifact::rdm::RdmFrame;
use artifact::settings::Class;
use artifact::tracks::{TracksFrame, TracksHeader};
use dsp::{ROAD_TRAFFIC, Receiver, Tracker, has_noise};
use pipeline::chain::loaded_model::LoadedModel;
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;
use pipeline::outcome::console_lines::{WITHOUT_AZIMUTH, WITHOUT_NOISE, without_height};
use radar::lattice::tells_azimuth;

/// Processing of the cubes of one radar, from the cubes alone.
pub struct Processing {
    header: CubeHeader,
    receiver: Receiver,
}

/// Answer of a classifier about an object.
pub struct Answered {
    /// Probabilities of the classes, in the order of [`Processing::class_names`].
    pub probabilities: [f32; 4],
    /// Name of the predicted class, or "unknown".
    pub told: &'static str,
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

    /// Range-Doppler map of a frame, with the cells that the detector tested and found.
    ///
    /// # Errors
    /// Samples that are not the radar's.
    pub fn map(&self, cube: &CubeFrame) -> Result<RdmFrame, Failure> {
        self.receiver.range_doppler(cube).map_err(Failure::refused)
    }

    /// Points and objects of all frames, the velocities of sub-frames resolved by each other.
    ///
    /// # Errors
    /// Maps and cubes that are not the radar's.
    pub fn points(&self, maps: &[RdmFrame], cubes: &[CubeFrame]) -> Result<Vec<PointsFrame>, Failure> {
        let detect = |(map, cube)| self.receiver.detect_refined(map, cube).map_err(Failure::refused);
        let detected = maps.iter().zip(cubes).map(detect).collect::<Result<Vec<_>, _>>()?;
        let cycles = detected.chunks(self.receiver.frames_in_cycle());
        Ok(cycles.flat_map(|cycle| self.receiver.resolved(cycle.to_vec())).collect())
    }

    /// Sentences about missing properties of points, as printed by `dsp` and `run`: noise, azimuths, heights.
    pub fn remarks(&self, points: &[PointsFrame]) -> Vec<String> {
        let noise = (!has_noise(&self.header)).then(|| WITHOUT_NOISE.to_owned());
        let azimuths = (!tells_azimuth(&self.header.radar)).then(|| WITHOUT_AZIMUTH.to_owned());
        let without = points.iter().map(PointsFrame::points_without_height).sum();
        let heights = without_height([without, points.iter().map(|frame| frame.points.len()).sum()]);
        noise.into_iter().chain(azimuths).chain(heights).collect()
    }

    /// Objects followed over the frames.
    ///
    /// # Errors
    /// Settings that nothing can be followed by.
    pub fn tracks(&self, points: &[PointsFrame]) -> Result<Vec<TracksFrame>, Failure> {
        let mut tracker = Tracker::new(&self.header, ROAD_TRAFFIC).map_err(Failure::refused)?;
        points.iter().map(|frame| tracker.step(frame).map_err(Failure::refused)).collect()
    }

    /// Classes of the objects of a frame, in their order.
    ///
    /// # Errors
    /// A model that cannot answer about these maps.
    pub fn classes(
        &self,
        model: &LoadedModel,
        map: &RdmFrame,
        points: &PointsFrame,
    ) -> Result<Vec<Answered>, Failure> {
        let rule = model.rule();
        let answered =
            |probabilities: [f32; 4]| Answered { told: rule.told(&probabilities).name(), probabilities };
        Ok(model.classify(&self.receiver, map, points)?.into_iter().map(answered).collect())
    }

    /// Names of the classes.
    pub fn class_names() -> [&'static str; 4] {
        Class::ALL.map(Class::name)
    }
}
