//! The artifacts and pictures of a run, written frame by frame and put in place when whole.

use crate::chain::{Chain, FrameProducts, Scattering};
use crate::commands::load::provenance;
use crate::failure::Failure;
use crate::labels;
use crate::pictures::{self, FrameFigures, Svg};
use crate::report;
use crate::stages::Stage;
use crate::truth;
use artifact::cube::Cube;
use artifact::paths::Paths;
use artifact::points::{Points, PointsFrame, PointsHeader};
use artifact::rcs::Rcs;
use artifact::rdm::Rdm;
use artifact::scene::{Scene, SceneFrame, SceneHeader};
use artifact::settings::EchoMode;
use artifact::tracks::{Tracks, TracksFrame, TracksHeader};
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
    tracks: Writer<Tracks>,
    figures: Figures,
}

/// Pictures for the report.
#[derive(Default)]
pub(crate) struct Figures {
    /// Of the first frames, in order.
    pub(crate) frames: Vec<FrameFigures>,
    /// Number and view from above of every n-th frame of a long scene.
    pub(crate) strip: Vec<(u32, Svg)>,
    /// What was seen in the first frames, to be laid beside what other radars saw.
    pub(crate) seen: Vec<Seen>,
}

/// What one radar saw of one frame, and what there was.
pub(crate) struct Seen {
    pub(crate) view: SceneHeader,
    pub(crate) scene: SceneFrame,
    pub(crate) points: PointsFrame,
}

enum ScatteringWriter {
    Paths(Writer<Paths>),
    Tables(Writer<Rcs>),
}

impl Products {
    pub(crate) fn create(chain: &Chain, out: &Path, inputs: &[(String, String)]) -> Result<Self, Failure> {
        let from = |stage| provenance(stage, chain.header, inputs.to_vec());
        let (targets, classes) = (chain.targets(), chain.classes_of_targets());
        let with_truth = PointsHeader { targets, classes, ..chain.points_header() };
        let followed = TracksHeader { cube: Some(chain.cube_header.clone()) };
        Ok(Self {
            out: out.to_owned(),
            scene: Writer::create(&out.join("scene.scene"), &from(Stage::Scene), chain.header)?,
            scattering: ScatteringWriter::create(chain, out, &from(Stage::BartRcs))?,
            cube: Writer::create(&out.join("frames.cube"), &from(Stage::FmcwEcho), &chain.cube_header)?,
            rdm: Writer::create(&out.join("frames.rdm"), &from(Stage::Dsp), &chain.cube_header)?,
            points: Writer::create(&out.join("frames.points"), &from(Stage::Dsp), &with_truth)?,
            tracks: Writer::create(&out.join("frames.tracks"), &from(Stage::Dsp), &followed)?,
            figures: Figures::default(),
        })
    }

    /// Writes one frame; its points learn here whose they are, when nothing can look at it any more.
    pub(crate) fn write(
        &mut self,
        chain: &Chain,
        mut frame: FrameProducts,
        tracks: &TracksFrame,
    ) -> Result<(), Failure> {
        join_truth(chain, &mut frame)?;
        self.scene.write(&frame.result.scene)?;
        self.cube.write(&frame.cube)?;
        self.rdm.write(&frame.rdm)?;
        self.points.write(&frame.result.points)?;
        self.tracks.write(tracks)?;
        let figures = pictures::figures(chain, &frame)?;
        pictures::write_frame(&figures, &chain.cube_header, &frame.rdm, &self.out.join("pictures"))?;
        let number = frame.result.scene.index;
        if report::is_in_strip(number, chain.header.frames) {
            self.figures.strip.push((number, figures.plan.clone()));
        }
        if self.figures.frames.len() < report::FRAMES_DRAWN {
            self.figures.frames.push(figures);
            let (scene, points) = (frame.result.scene.clone(), frame.result.points.clone());
            self.figures.seen.push(Seen { view: frame.view.clone(), scene, points });
        }
        self.scattering.write(chain.counted_through(frame.scattering))
    }

    /// Puts every artifact in its place and hands out the figures.
    pub(crate) fn finish(self) -> Result<Figures, Failure> {
        self.scene.finish()?;
        self.scattering.finish()?;
        self.cube.finish()?;
        self.rdm.finish()?;
        self.points.finish()?;
        self.tracks.finish()?;
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

    fn write(&mut self, scattering: Scattering) -> Result<(), Failure> {
        match (self, scattering) {
            (Self::Paths(writer), Scattering::Paths(frame)) => Ok(writer.write(&frame)?),
            (Self::Tables(writer), Scattering::Tables(frame)) => Ok(writer.write(&frame)?),
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

fn join_truth(chain: &Chain, frame: &mut FrameProducts) -> Result<(), Failure> {
    let result = &mut frame.result;
    let truths = truth::truths(&frame.view.in_frame(result.scene.index), &result.scene, result.paths.as_ref());
    let bodies = scene::bodies_in_view(chain.header, result.scene.index);
    let chosen = truth::assign(&frame.view.dsp.road, &truths, &result.points.objects);
    for point in &mut result.points.points {
        let target = chosen.iter().position(|c| c.is_some() && c.map(|o| o as u32) == point.object);
        point.target = target.and_then(|t| bodies.get(t).copied());
    }
    let Some(paths) = &result.paths else { return Ok(()) };
    let paths = &chain.with_ground(paths)?;
    let header = chain.cube_header.in_frame(result.scene.index);
    let noise = dsp::noise_power(&header, &frame.rdm).map_err(Failure::refused)?;
    labels::label(&header, paths, noise, &mut result.points.points).map_err(Failure::refused)?;
    for label in result.points.points.iter_mut().filter_map(|point| point.label.as_mut()) {
        label.target = bodies.get(label.target as usize).copied().unwrap_or(label.target);
    }
    Ok(())
}
