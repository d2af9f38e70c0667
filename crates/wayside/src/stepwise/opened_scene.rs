//! A scene that was read and planned, as input of its stages.

use artifact::Provenance;
use artifact::cube::CubeHeader;
use artifact::scene::SceneHeader;
use artifact::settings::EchoMode;
use pipeline::chain::expectation::{Expectation, rates};
use pipeline::chain::link::Chain;
use pipeline::chain::loading::{self, LoadedScene, SceneSource, provenance};
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::outcome::summary::RadarSummary;
use pipeline::planning::{self, PlannedScene};
use scene::PhysicsKeys;

/// Ids of the radars of a scene; empty if it has one.
///
/// # Errors
/// The scene file cannot be read.
pub fn radars(source: &SceneSource) -> Result<Vec<String>, Failure> {
    scene::radars(&source.file).map_err(loading::scene_failure)
}

/// Names and hashes of all files of a scene, the scene file first.
///
/// # Errors
/// A file cannot be read.
pub fn inputs(source: &SceneSource) -> Result<Vec<(String, String)>, Failure> {
    let (model, radar) = (source.model.clone(), source.radar.clone());
    let options = scene::ReadOptions { model, radar, meshes: scene::MeshLoading::Whole };
    loading::hashes(&scene::inputs(&source.file, &options).map_err(loading::scene_failure)?)
}

/// A scene in memory, with its meshes.
pub struct OpenedScene {
    loaded: LoadedScene,
    memory: Allowance,
    is_looked_at: bool,
    said: PhysicsKeys,
}

/// Expected time and memory of all frames of a scene, as printed by `run --dry-run`.
pub struct Cost {
    /// Number of frames.
    pub frames: u32,
    /// Expected processor time of all threads together, s.
    pub processor_s: f64,
    /// Interval of the processor time that nine of ten runs are meant to keep, s.
    pub processor_between_s: [f64; 2],
    /// Expected wall-clock time, s.
    pub wall_s: f64,
    /// Number of working threads.
    pub threads: usize,
    /// Expected peak memory, MiB.
    pub expected_memory_mib: f64,
    /// Upper limit of the peak memory, MiB.
    pub memory_mib: f64,
}

impl OpenedScene {
    /// Reads a scene with all of its files, and chooses its physics if it requests that.
    ///
    /// # Errors
    /// Every broken rule, with file and place.
    pub fn of(source: &SceneSource, memory: Allowance) -> Result<Self, Failure> {
        let PlannedScene { loaded, is_looked_at, said, .. } = planning::scene(source, None, memory)?;
        Ok(Self { loaded, memory, is_looked_at, said })
    }

    /// The scene as every stage reads it.
    pub fn header(&self) -> &SceneHeader {
        &self.loaded.header
    }

    /// Whether its echo was looked at for a plan, by all threads.
    pub fn is_looked_at(&self) -> bool {
        self.is_looked_at
    }

    /// Header of the scene's cubes.
    pub fn cube_header(&self) -> CubeHeader {
        self.chain().cube_header().clone()
    }

    /// Parameters of the radar in standard terms.
    pub fn radar(&self) -> RadarSummary {
        RadarSummary::of(&self.loaded.header)
    }

    /// Estimates the cost of all frames without running them.
    ///
    /// # Errors
    /// A body that cannot be traced.
    pub fn cost(&self) -> Result<Cost, Failure> {
        let (model, frames) = (loading::model(None)?, self.header().frames);
        let chain = Chain::of(self.header(), None, model.as_ref(), self.memory);
        let plans: Vec<_> = (0..frames).map(|index| chain.plan(index)).collect();
        let expected = Expectation::of(&chain, None, &plans)?;
        let threads = rayon::current_num_threads();
        Ok(Cost {
            frames,
            processor_s: expected.seconds,
            processor_between_s: [expected.seconds / rates::SPREAD, expected.seconds * rates::SPREAD],
            wall_s: rates::wall_seconds(expected.seconds, threads),
            threads,
            expected_memory_mib: expected.expected_memory_mib,
            memory_mib: expected.memory_mib,
        })
    }

    /// The scene with an echo from paths, whatever its setting.
    pub(crate) fn by_paths(&self) -> Self {
        let mut header = self.loaded.header.clone();
        header.fidelity.echo = EchoMode::Paths;
        let LoadedScene { cached, seconds, ref files, .. } = self.loaded;
        let loaded = LoadedScene { header, cached, seconds, files: files.clone() };
        Self { loaded, said: self.said.clone(), ..*self }
    }

    pub(crate) fn chain(&self) -> Chain<'_> {
        Chain::of(&self.loaded.header, None, None, self.memory)
    }

    /// Physics that its file specifies.
    pub(crate) fn said(&self) -> &PhysicsKeys {
        &self.said
    }

    /// Names and hashes of its files, the scene file first.
    pub fn files(&self) -> &[(String, String)] {
        &self.loaded.files
    }

    pub(crate) fn provenance(&self, stage: Stage) -> Provenance {
        provenance(stage, &self.loaded.header, self.loaded.files.clone())
    }
}
