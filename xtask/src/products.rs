//! The artifacts and pictures of a run, written frame by frame and put in place when whole.

use crate::chain::{Chain, FrameProducts, Scattering};
use crate::commands::load::provenance;
use crate::failure::Failure;
use crate::pictures::{self, FrameFigures};
use crate::report;
use crate::stages::Stage;
use crate::truth;
use artifact::cube::Cube;
use artifact::paths::Paths;
use artifact::points::{Points, PointsHeader};
use artifact::rcs::Rcs;
use artifact::rdm::Rdm;
use artifact::scene::Scene;
use artifact::settings::EchoMode;
use artifact::{Provenance, Writer};
use std::path::{Path, PathBuf};

/// Open writers of all artifacts of a run.
pub(crate) struct Products {
    out: PathBuf,
    scene: Writer<Scene>,
    scattering: ScatteringWriter,
    cube: Writer<Cube>,
    rdm: Writer<Rdm>,
    points: Writer<Points>,
    /// For the report; only of the first frames.
    pub(crate) figures: Vec<FrameFigures>,
}

enum ScatteringWriter {
    Paths(Writer<Paths>),
    Tables(Writer<Rcs>),
}

impl Products {
    pub(crate) fn create(chain: &Chain, out: &Path, inputs: &[(String, String)]) -> Result<Self, Failure> {
        let from = |stage| provenance(stage, chain.header, inputs.to_vec());
        let with_truth = PointsHeader { targets: chain.targets(), ..chain.points_header() };
        Ok(Self {
            out: out.to_owned(),
            scene: Writer::create(&out.join("scene.scene"), &from(Stage::Scene), chain.header)?,
            scattering: ScatteringWriter::create(chain, out, &from(Stage::BartRcs))?,
            cube: Writer::create(&out.join("frames.cube"), &from(Stage::FmcwEcho), &chain.cube_header)?,
            rdm: Writer::create(&out.join("frames.rdm"), &from(Stage::Dsp), &chain.cube_header)?,
            points: Writer::create(&out.join("frames.points"), &from(Stage::Dsp), &with_truth)?,
            figures: Vec::new(),
        })
    }

    /// Writes one frame; its points learn here whose they are, when nothing can look at it any more.
    pub(crate) fn write(&mut self, chain: &Chain, frame: &mut FrameProducts) -> Result<(), Failure> {
        join_truth(chain, frame);
        self.scene.write(&frame.result.scene)?;
        self.scattering.write(&frame.scattering)?;
        self.cube.write(&frame.cube)?;
        self.rdm.write(&frame.rdm)?;
        self.points.write(&frame.result.points)?;
        let figures = pictures::figures(chain, frame)?;
        pictures::write_frame(&figures, &chain.cube_header, &frame.rdm, &self.out.join("pictures"))?;
        if self.figures.len() < report::FRAMES_DRAWN {
            self.figures.push(figures);
        }
        Ok(())
    }

    /// Puts every artifact in its place and hands out the figures.
    pub(crate) fn finish(self) -> Result<Vec<FrameFigures>, Failure> {
        self.scene.finish()?;
        self.scattering.finish()?;
        self.cube.finish()?;
        self.rdm.finish()?;
        self.points.finish()?;
        Ok(self.figures)
    }
}

impl ScatteringWriter {
    fn create(chain: &Chain, out: &Path, from: &Provenance) -> Result<Self, Failure> {
        Ok(match chain.header.fidelity.echo {
            EchoMode::Paths => Self::Paths(Writer::create(&out.join("frames.paths"), from, &chain.paths_header())?),
            EchoMode::RcsTable => Self::Tables(Writer::create(&out.join("frames.rcs"), from, &chain.rcs_header())?),
        })
    }

    fn write(&mut self, scattering: &Scattering) -> Result<(), Failure> {
        match (self, scattering) {
            (Self::Paths(writer), Scattering::Paths(frame)) => Ok(writer.write(frame)?),
            (Self::Tables(writer), Scattering::Tables(frame)) => Ok(writer.write(frame)?),
            _ => Err(Failure::refused("the frame's kind of scattering is not the scene's")),
        }
    }

    fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Paths(writer) => Ok(writer.finish()?),
            Self::Tables(writer) => Ok(writer.finish()?),
        }
    }
}

fn join_truth(chain: &Chain, frame: &mut FrameProducts) {
    let result = &mut frame.result;
    let header = chain.header.in_frame(result.scene.index);
    let truths = truth::truths(&header, &result.scene, result.paths.as_ref());
    let chosen = truth::assign(&truths, &result.points.objects);
    for point in &mut result.points.points {
        let target = chosen.iter().position(|c| c.is_some() && c.map(|o| o as u32) == point.object);
        point.target = target.map(|t| t as u32);
    }
}
