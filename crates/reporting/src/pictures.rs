//! Pictures: drawn once as SVG, embedded in the report, and written to disk as PNG.

pub(crate) mod field_of_view;
pub(crate) mod lane_sides;
mod bodies;
mod off_map_marks;
mod detection_marks;
mod ground;
mod rdm;
mod exr;
mod plan_view;
mod points;
pub mod radar_frame;
mod common_view;

use artifact::cube::CubeHeader;
use artifact::points::PointsFrame;
use artifact::rdm::RdmFrame;
use evaluation::{FrameTruth, Truth};
use pipeline::chain::link::{Chain, FrameProducts};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use plotting::layout::{Figure, Layout};
use plotting::raster::{self, Pixels};
use plotting::svg::Svg;
use rdm::{MapOverlay, TrueEcho};
use std::path::{Path, PathBuf};

pub use common_view::common_view;
pub use exr::rdm_exr;

/// Pictures of one frame.
pub struct FrameFigures {
    /// The scene from above.
    pub plan: Figure,
    pub(crate) rdm: Figure,
    pub(crate) profile: Figure,
    pub(crate) points: Figure,
}

/// One frame with its truth, ready to be drawn in any form.
pub struct FrameDrawing<'a> {
    frame: &'a FrameProducts,
    header: CubeHeader,
    /// Objects that belong to no body.
    false_objects: Vec<usize>,
    echoes: Vec<TrueEcho>,
    bodies: Vec<bodies::Body>,
}

impl<'a> FrameDrawing<'a> {
    /// Prepares a frame with the truth that its pictures show.
    pub fn of(chain: &Chain, frame: &'a FrameProducts, truth: &FrameTruth) -> Self {
        let is_false = |index: &usize| truth.pairing.body_of(*index).is_none();
        Self {
            frame,
            header: chain.cube_header().in_frame(frame.rdm.index),
            false_objects: (0..frame.result.points.objects.len()).filter(is_false).collect(),
            echoes: true_echoes(frame, truth),
            bodies: bodies::bodies(&frame.view, &frame.result.scene),
        }
    }

    /// All drawings of a report.
    pub fn figures(&self) -> Result<FrameFigures, Failure> {
        Ok(FrameFigures {
            plan: self.plan(),
            rdm: Figure::try_draw(|layout| self.map(layout))?,
            profile: Figure::try_draw(|layout| rdm::range_profile(&self.header, &self.frame.rdm, layout))?,
            points: Figure::draw(|layout| self.points(layout)),
        })
    }

    /// The scene from above.
    pub fn plan(&self) -> Figure {
        Figure::draw(|layout| self.plan_in(layout))
    }

    /// Drawings written to disk: the scene from above, its map and its points, in page form.
    pub fn on_disk(&self) -> Result<[Svg; 3], Failure> {
        Ok([self.plan_in(Layout::Wide), self.map(Layout::Wide)?, self.points(Layout::Wide)])
    }

    fn plan_in(&self, layout: Layout) -> Svg {
        plan_view::of_frame(&self.frame.view, &self.frame.result, &self.false_objects, layout)
    }

    fn map(&self, layout: Layout) -> Result<Svg, Failure> {
        let points = Some(&self.frame.result.points);
        let over = MapOverlay { points, false_objects: Some(&self.false_objects), truth: &self.echoes };
        rdm::draw(&self.header, &self.frame.rdm, &over, layout)
    }

    fn points(&self, layout: Layout) -> Svg {
        points::draw(&self.header, &self.frame.result.points, &self.bodies, layout)
    }
}

impl FrameFigures {
    /// Drawings of [`FrameDrawing::on_disk`].
    pub fn on_disk(&self) -> [&Svg; 3] {
        [&self.plan.wide, &self.rdm.wide, &self.points.wide]
    }
}

/// True range and radial velocity of each body's echo; bodies without an echo are left out.
fn true_echoes(frame: &FrameProducts, truth: &FrameTruth) -> Vec<TrueEcho> {
    let named = frame.view.targets.iter().zip(&truth.truths).filter(|(_, truth)| truth.returns_echo);
    let echo = |(target, truth): (&artifact::scene::Target, &Truth)| TrueEcho {
        name: target.id.clone(),
        range_m: truth.echo.map_or(truth.range_m, |e| e.range_m),
        radial_velocity_mps: truth.echo.map_or(truth.radial_velocity_mps, |e| e.radial_velocity_mps),
    };
    named.map(echo).collect()
}

/// Writes `scene-NNNN.png`, `rdm-NNNN.png`, `points-NNNN.png` and `rdm-NNNN.exr` of one frame.
pub fn write_frame(
    drawings: [&Svg; 3],
    header: &CubeHeader,
    rdm: &RdmFrame,
    folder: &Path,
) -> Result<(), Failure> {
    let [plan, map, points, levels] = places_of_frame(rdm.index, folder);
    [plan, map, points].iter().zip(drawings).try_for_each(|(place, drawing)| write_png(place, drawing))?;
    rdm_exr(header, rdm, &levels)
}

/// Files of the pictures of one frame.
pub fn places_of_frame(index: u32, folder: &Path) -> [PathBuf; 4] {
    let kinds = [("scene", "png"), ("rdm", "png"), ("points", "png"), ("rdm", "exr")];
    kinds.map(|(name, kind)| folder.join(format!("{name}-{index:04}.{kind}")))
}

/// Map and points of one frame: the pictures that need no truth.
pub fn of_map(
    header: &CubeHeader,
    rdm: &RdmFrame,
    points: &PointsFrame,
    folder: &Path,
) -> Result<(), Failure> {
    let header = &header.in_frame(rdm.index);
    let over = MapOverlay { points: Some(points), ..MapOverlay::default() };
    let [map, cloud, levels] = names_of_map(rdm.index).map(|name| folder.join(name));
    write_png(&map, &rdm::draw(header, rdm, &over, Layout::Wide)?)?;
    write_png(&cloud, &points::draw(header, points, &[], Layout::Wide))?;
    rdm_exr(header, rdm, &levels)
}

/// Names of the pictures of [`of_map`]: map, points, levels of the map.
pub fn names_of_map(number: u32) -> [String; 3] {
    [("rdm", "png"), ("points", "png"), ("rdm", "exr")]
        .map(|(kind, ending)| format!("{kind}-{number:04}.{ending}"))
}

/// Writes a map with axes and no marks.
pub fn write_map(file: &Path, header: &CubeHeader, rdm: &RdmFrame) -> Result<(), Failure> {
    write_png(file, &rdm::draw(&header.in_frame(rdm.index), rdm, &MapOverlay::default(), Layout::Wide)?)
}

/// Writes an SVG as PNG.
pub fn write_png(file: &Path, picture: &Svg) -> Result<(), Failure> {
    let bytes = raster::render_png(picture).map_err(|e| Failure::system(file, "draw", e))?;
    files::write_file(file, &bytes)
}

/// Whether a file that begins with this kilobyte is a picture of this program: a PNG that names it, or an
/// OpenEXR file with the layer of its maps.
pub fn is_own(head: &[u8]) -> bool {
    let layer = exr::LAYER.as_bytes();
    let is_map = || head.windows(layer.len()).any(|bytes| bytes == layer);
    raster::is_own_png(head) || (head.starts_with(&exr::MAGIC) && is_map())
}

/// Writes grey levels, row-major, as PNG.
pub fn write_gray(file: &Path, size: [usize; 2], pixels: &[u8]) -> Result<(), Failure> {
    let bytes =
        raster::encode_png(Pixels::Grey, size, pixels).map_err(|e| Failure::system(file, "encode", e))?;
    files::write_file(file, &bytes)
}
