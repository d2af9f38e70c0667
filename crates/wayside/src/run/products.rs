//! Artifacts and pictures of a run, written frame by frame and put in place when complete.

use artifact::cube::Cube;
use artifact::paths::Paths;
use artifact::points::{Label, Points};
use artifact::rcs::Rcs;
use artifact::rdm::Rdm;
use artifact::scene::{Scene, SceneHeader};
use artifact::settings::EchoMode;
use artifact::tracks::{Tracks, TracksFrame, TracksHeader};
use artifact::{Provenance, Writer};
use evaluation::FrameTruth;
use pipeline::chain::frame_result::Scattering;
use pipeline::chain::link::{Chain, FrameProducts, artifact_headers};
use pipeline::chain::loading::provenance;
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;
use reporting::pictures::radar_frame::RadarFrame;
use reporting::pictures::{self, FrameDrawing};
use reporting::report;
use reporting::report::figures::Figures;
use std::path::{Path, PathBuf};

const SCENE: &str = "scene.scene";
const CUBE: &str = "frames.cube";
const RDM: &str = "frames.rdm";
pub(super) const POINTS: &str = "frames.points";
pub(super) const TRACKS: &str = "frames.tracks";

pub(super) fn scattering_name(echo: EchoMode) -> &'static str {
    match echo {
        EchoMode::Paths => "frames.paths",
        EchoMode::RcsTable => "frames.rcs",
    }
}

/// Names of the artifacts of a run.
pub(crate) fn artifacts(header: &SceneHeader) -> [&'static str; 6] {
    [SCENE, scattering_name(header.fidelity.echo), CUBE, RDM, POINTS, TRACKS]
}

/// Files of a run beside its summary and its report: every artifact, and the pictures of the first frame,
/// which represent those of all frames.
pub(crate) fn places(header: &SceneHeader, out: &Path) -> Vec<PathBuf> {
    let pictures = pictures::places_of_frame(0, &out.join("pictures"));
    artifacts(header).into_iter().map(|name| out.join(name)).chain(pictures).collect()
}

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

enum ScatteringWriter {
    Paths(Writer<Paths>),
    Tables(Writer<Rcs>),
}

impl Products {
    pub(crate) fn create(chain: &Chain, out: &Path, inputs: &[(String, String)]) -> Result<Self, Failure> {
        let from = |stage| provenance(stage, chain.header, inputs.to_vec());
        let with_truth = artifact_headers::points_header_with_truth(chain.header, chain.cube_header());
        let followed = TracksHeader { cube: Some(chain.cube_header().clone()) };
        Ok(Self {
            out: out.to_owned(),
            scene: Writer::create(&out.join(SCENE), &from(Stage::Scene), chain.header)?,
            scattering: ScatteringWriter::create(chain, out, &from(Stage::BartRcs))?,
            cube: Writer::create(&out.join(CUBE), &from(Stage::FmcwEcho), chain.cube_header())?,
            rdm: Writer::create(&out.join(RDM), &from(Stage::Dsp), chain.cube_header())?,
            points: Writer::create(&out.join(POINTS), &from(Stage::Dsp), &with_truth)?,
            tracks: Writer::create(&out.join(TRACKS), &from(Stage::Dsp), &followed)?,
            figures: Figures { artifacts: artifacts(chain.header).to_vec(), ..Figures::default() },
        })
    }

    /// Writes one frame; its points receive their true origins here, when no processing can use them any
    /// more.
    pub(crate) fn write(
        &mut self,
        chain: &Chain,
        mut frame: FrameProducts,
        truth: &FrameTruth,
        tracks: &TracksFrame,
    ) -> Result<(), Failure> {
        self.figures.viewer.take(chain, &frame, truth, tracks)?;
        join_truth(truth, &mut frame);
        self.scene.write(&frame.result.scene)?;
        self.cube.write(&frame.cube)?;
        self.rdm.write(&frame.rdm)?;
        self.points.write(&frame.result.points)?;
        self.tracks.write(tracks)?;
        self.draw(chain, &frame, truth)?;
        self.scattering.write(frame.result.scattering.numbered_as_in(chain.header))
    }

    /// Writes the pictures of a frame, and keeps those that the report shows: in a long run most frames have
    /// none there, and are drawn in one form only.
    fn draw(&mut self, chain: &Chain, frame: &FrameProducts, truth: &FrameTruth) -> Result<(), Failure> {
        let (drawing, folder) = (FrameDrawing::of(chain, frame, truth), self.out.join("pictures"));
        let write = |drawings| pictures::write_frame(drawings, chain.cube_header(), &frame.rdm, &folder);
        let number = frame.result.scene.index;
        if report::is_in_strip(number, chain.header.frames) {
            self.figures.strip.push((number, drawing.plan()));
        }
        if self.figures.frames.len() >= report::FRAMES_DRAWN {
            return write(drawing.on_disk()?.each_ref());
        }
        let figures = drawing.figures()?;
        write(figures.on_disk())?;
        self.figures.frames.push(figures);
        let (scene, points) = (frame.result.scene.clone(), frame.result.points.clone());
        self.figures.radar_frames.push(RadarFrame { view: frame.view.clone(), scene, points });
        Ok(())
    }

    /// Puts every artifact in its place and returns the figures.
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
        let echo = chain.header.fidelity.echo;
        let place = out.join(scattering_name(echo));
        Ok(match echo {
            EchoMode::Paths => {
                Self::Paths(Writer::create(&place, from, &artifact_headers::paths_header(chain.header))?)
            }
            EchoMode::RcsTable => {
                Self::Tables(Writer::create(&place, from, &artifact_headers::rcs_header(chain.header))?)
            }
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

fn join_truth(truth: &FrameTruth, frame: &mut FrameProducts) {
    let points = &mut frame.result.points.points;
    for point in points.iter_mut() {
        let body = point.object.and_then(|object| truth.pairing.body_of(object as usize));
        point.target = body.map(|body| truth.number_of(body));
    }
    for (point, origin) in points.iter_mut().zip(&truth.origins) {
        point.label =
            origin.label().map(|label| Label { target: truth.number_of(label.target as usize), ..label });
    }
}
