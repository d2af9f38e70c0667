//! The sessions of a scene's stages: tracer, synthesizer and receiver, each made when the first frame needs
//! it, and used for every frame.

use crate::chain::keys::{cube_header, echo_header};
use crate::host::failure::Failure;
use crate::host::memory::{self, Allowance};
use crate::host::progress::Work;
use artifact::cube::CubeHeader;
use artifact::scene::SceneHeader;
use artifact::settings::EchoMode;
use bart_rcs::MemoryLimit;
use std::sync::OnceLock;

/// A session of a stage, or the error by which the stage refused the scene.
type Session<T, E> = OnceLock<Result<T, E>>;

/// Sessions of the stages of one scene.
pub(super) struct StageSessions<'a> {
    header: &'a SceneHeader,
    /// The radar and its processing, as the detection stage takes them.
    pub(super) cube_header: CubeHeader,
    echo_header: CubeHeader,
    tracer: Session<bart_rcs::Tracer, bart_rcs::BartError>,
    limited: OnceLock<bart_rcs::Tracer>,
    synthesizer: Session<fmcw_echo::Synthesizer, fmcw_echo::EchoError>,
    receiver: Session<dsp::Receiver, dsp::DspError>,
}

impl<'a> StageSessions<'a> {
    /// Makes the sessions of a scene, none of them started.
    pub(super) fn of(header: &'a SceneHeader) -> Self {
        Self {
            header,
            cube_header: cube_header(header),
            echo_header: echo_header(header),
            tracer: OnceLock::new(),
            limited: OnceLock::new(),
            synthesizer: OnceLock::new(),
            receiver: OnceLock::new(),
        }
    }

    /// Uses an existing tracer of the same meshes.
    pub(super) fn tracing_by(self, tracer: bart_rcs::Tracer) -> Self {
        Self { tracer: OnceLock::from(Ok(tracer)), ..self }
    }

    /// Tracer without a memory limit, for looks; refused where the bodies at rest do not fit into the allowed
    /// memory.
    pub(super) fn unlimited_tracer(&self, memory: Allowance) -> Result<&bart_rcs::Tracer, Failure> {
        let triangles = self.header.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        memory.check(memory::mib(bart_rcs::memory_estimate_bytes(triangles, 0, 0)))?;
        let build = || {
            let _under_way = Work::begin("building the hierarchies of the meshes");
            bart_rcs::Tracer::new(self.header)
        };
        self.tracer.get_or_init(build).as_ref().map_err(Failure::refused)
    }

    /// Tracer of the frames, limited to a frame's share of the memory.
    pub(super) fn tracer(
        &self,
        memory: Allowance,
        share_of_a_frame: impl FnOnce() -> MemoryLimit,
    ) -> Result<&bart_rcs::Tracer, Failure> {
        let tracer = self.unlimited_tracer(memory)?;
        Ok(self.limited.get_or_init(|| tracer.clone().within(share_of_a_frame())))
    }

    /// Synthesizer that makes cubes of the scene's paths, with the road's own backscatter, which neither
    /// `.paths` nor tables contain.
    pub(super) fn synthesizer(&self) -> Result<&fmcw_echo::Synthesizer, Failure> {
        let SceneHeader { radar, backscatter, seed, fidelity, .. } = self.header;
        let build = || {
            let heard = backscatter.as_ref().filter(|_| fidelity.echo == EchoMode::Paths);
            let draw = |road| fmcw_echo::ground::paths(radar, road, *seed);
            let ground = heard.map(draw).transpose()?.unwrap_or_default();
            let accuracy = fmcw_echo::sum_accuracy(fidelity.accuracy);
            fmcw_echo::Synthesizer::new(&self.echo_header, *seed, accuracy, ground)
        };
        self.synthesizer.get_or_init(build).as_ref().map_err(Failure::refused)
    }

    /// Receiver that makes maps and points of the scene's cubes.
    pub(super) fn receiver(&self) -> Result<&dsp::Receiver, Failure> {
        self.receiver.get_or_init(|| dsp::Receiver::new(&self.cube_header)).as_ref().map_err(Failure::refused)
    }
}
