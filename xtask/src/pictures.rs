//! Pictures: drawn once as SVG, put into the report as they are and onto disk as PNG.

mod colours;
mod svg;
mod axes;
mod raster;
mod heat_map;
mod polar;
mod rdm;
mod points;
mod plan_view;
mod common_view;
mod lines;

use crate::chain::{Chain, FrameProducts};
use crate::commands::export::rdm_exr;
use crate::failure::Failure;
use crate::output;
use artifact::cube::CubeHeader;
use artifact::points::PointsFrame;
use artifact::rdm::RdmFrame;
use std::path::Path;

pub(crate) use colours::heat;
pub(crate) use common_view::common_view;
pub(crate) use heat_map::{HeatMap, Shape};
pub(crate) use lines::{Line, LinePlot, Scale};
pub(crate) use polar::PolarPlot;
pub(crate) use svg::Svg;

/// What is drawn of one frame.
pub(crate) struct FrameFigures {
    pub(crate) plan: Svg,
    pub(crate) rdm: Svg,
    pub(crate) profile: Svg,
    pub(crate) points: Svg,
}

/// Draws one frame.
pub(crate) fn figures(chain: &Chain, frame: &FrameProducts) -> Result<FrameFigures, Failure> {
    let (header, points) = (&chain.cube_header.in_frame(frame.rdm.index), &frame.result.points);
    Ok(FrameFigures {
        plan: plan_view::of_frame(&frame.view, &frame.result),
        rdm: rdm::draw(header, &frame.rdm, points)?,
        profile: rdm::range_profile(header, &frame.rdm)?,
        points: points::draw(header, points),
    })
}

/// `scene-NNNN.png`, `rdm-NNNN.png`, `points-NNNN.png` and `rdm-NNNN.exr` of one frame.
pub(crate) fn write_frame(
    figures: &FrameFigures,
    header: &CubeHeader,
    rdm: &RdmFrame,
    folder: &Path,
) -> Result<(), Failure> {
    let place = |name: &str, kind: &str| folder.join(format!("{name}-{:04}.{kind}", rdm.index));
    write_png(&place("scene", "png"), &figures.plan)?;
    write_png(&place("rdm", "png"), &figures.rdm)?;
    write_png(&place("points", "png"), &figures.points)?;
    rdm_exr(header, rdm, &place("rdm", "exr"))
}

/// Map and points of one frame: what can be drawn without truth.
pub(crate) fn of_map(header: &CubeHeader, rdm: &RdmFrame, points: &PointsFrame, folder: &Path) -> Result<(), Failure> {
    let (header, number) = (&header.in_frame(rdm.index), rdm.index);
    write_png(&folder.join(format!("rdm-{number:04}.png")), &rdm::draw(header, rdm, points)?)?;
    write_png(&folder.join(format!("points-{number:04}.png")), &points::draw(header, points))?;
    rdm_exr(header, rdm, &folder.join(format!("rdm-{number:04}.exr")))
}

/// An SVG as PNG.
pub(crate) fn write_png(file: &Path, picture: &Svg) -> Result<(), Failure> {
    let bytes = raster::png(picture).map_err(|e| Failure::system(file, "draw", e))?;
    output::write_file(file, &bytes)
}

/// Grey levels, row-major, as PNG.
pub(crate) fn write_gray(file: &Path, width: u32, height: u32, pixels: Vec<u8>) -> Result<(), Failure> {
    let image = image::GrayImage::from_raw(width, height, pixels);
    let image =
        image.ok_or_else(|| Failure::refused(format!("{}: the picture is not {width} × {height}", file.display())))?;
    let bytes = raster::encode(image.into()).map_err(|e| Failure::system(file, "encode", e))?;
    output::write_file(file, &bytes)
}
