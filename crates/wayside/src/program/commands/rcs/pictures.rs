//! Pictures of a table: level over azimuth and frequency, range profile, ISAR image, and the facets that make
//! the level.

use crate::program::commands::rcs::aspect_geometry::{AspectGeometry, Extent};
use crate::program::commands::rcs::isar::{self, Square, Summation};
use crate::program::commands::rcs::sampling::{Sampling, Samplings};
use crate::program::commands::rcs::silhouette;
use artifact::scene::Mesh;
use artifact::units::db_from_power;
use bart_rcs::{Contribution, RcsRequest, Standpoint, contributions};
use ndarray::{Array2, ArrayView2, ArrayView3, s};
use num_complex::Complex64;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use plotting::colours::inferno;
use plotting::heat_map::HeatMap;
use plotting::layout::{Figure, Layout};
use plotting::lines::{Line, LinePlot, Scale};
use plotting::marks::{Legend, Mark};
use plotting::polar::PolarPlot;
use plotting::svg::Svg;
use rayon::prelude::*;
use reporting::pictures::{is_own as is_own_picture, write_png};
use reporting::report;
use reporting::report::rcs_view::{self, RcsView};
use scene::{ColouredLine, ColouredMesh, coloured_glb};
use std::path::{Path, PathBuf};

/// Writes beside `S.npy` `S-polar.png` and `S-azimuth.png`, `S-frequency.png`, `S-profile.png`, `S-isar.png`,
/// each if its axes have more than one value. Cuts are at the first elevation; ambiguous axes are marked in
/// the labels.
pub(super) fn write(
    out: &Path,
    mesh: &Mesh,
    request: &RcsRequest,
    samplings: &Samplings,
    amplitude_m: &[Complex64],
) -> Result<(), Failure> {
    let table = table_of(request, amplitude_m)?;
    for name in drawn(request) {
        let drawing = match name {
            POLAR => polar(request, &table).draw(),
            AZIMUTH => over_azimuth(request, &table).draw(Layout::Wide),
            FREQUENCY => over_frequency(request, &table).draw(Layout::Wide),
            PROFILE => profile(mesh, request, samplings, &table).draw(Layout::Wide),
            _ => image(mesh, request, samplings, &table.slice(s![.., 0, ..]))?,
        };
        write_png(&beside(out, name), &drawing)?;
    }
    Ok(())
}

/// Values of S by frequency, elevation and azimuth.
fn table_of<'a>(
    request: &RcsRequest,
    amplitude_m: &'a [Complex64],
) -> Result<ArrayView3<'a, Complex64>, Failure> {
    let shape = (request.frequency_hz.len(), request.elevation_rad.len(), request.azimuth_rad.len());
    ArrayView3::from_shape(shape, amplitude_m).map_err(Failure::refused)
}

/// Names of the pictures for which the table's axes have enough values.
fn drawn(request: &RcsRequest) -> Vec<&'static str> {
    let (frequencies, azimuths) = (request.frequency_hz.len() > 1, request.azimuth_rad.len() > 1);
    let all = [
        (POLAR, azimuths),
        (AZIMUTH, azimuths),
        (FREQUENCY, frequencies),
        (PROFILE, frequencies),
        (ISAR, frequencies && azimuths),
    ];
    all.into_iter().filter_map(|(name, has_values)| has_values.then_some(name)).collect()
}

/// Names of all files beside a table with its pictures.
pub(super) fn written(request: &RcsRequest) -> Vec<&'static str> {
    drawn(request).into_iter().chain([FACETS, VIEW]).collect()
}

/// Notes pictures that an earlier run left beside the table and this one did not replace.
pub(super) fn remark_on_others(out: &Path, written: &[&str]) {
    let others = PICTURES.iter().chain([&FACETS, &VIEW]).filter(|name| !written.contains(name));
    let names = others.map(|name| beside(out, name)).filter(|place| place.is_file());
    let names: Vec<String> = names.map(|place| place.display().to_string()).collect();
    if !names.is_empty() {
        let names = names.join(", ");
        progress::note(format!("note: {names}: left by an earlier run, and not of this table"));
    }
}

/// Writes the contributions to the level at the middle aspect and the first frequency: `S-facets.glb`,
/// triangles coloured by the power of their sequences and the rays of the strongest sequences as lines, and
/// `S-view.html`, the same as an interactive view.
pub(super) fn write_facets(
    out: &Path,
    mesh: &Mesh,
    request: &RcsRequest,
    amplitude_m: &[Complex64],
) -> Result<(), Failure> {
    let aspect = middle_aspect(request);
    let parts = contributions(mesh, request, aspect).map_err(Failure::refused)?;
    let strongest = parts.first().map_or(1.0, |c| c.amplitude_m.norm_sqr());
    let colours = triangle_colours(mesh, &parts, strongest);
    let lines: Vec<ColouredLine> =
        parts.iter().take(LINES).map(|c| ray(request, aspect, c, strongest)).collect();
    let bytes = coloured_glb(&ColouredMesh { mesh, triangle_colours: &colours, lines: &lines });
    files::write_file(&beside(out, FACETS), &bytes)?;
    let drawings = drawings(request, &table_of(request, amplitude_m)?);
    let view = RcsView { drawings, ..view(out, mesh, request, amplitude_m, &parts) };
    let page = rcs_view::page(&view).map_err(Failure::refused)?;
    files::write_file(&beside(out, VIEW), page.as_bytes())
}

/// Drawings of a table's cut at the elevation of its middle aspect, with their captions; an axis of one value
/// has none.
fn drawings(request: &RcsRequest, table: &ArrayView3<Complex64>) -> Vec<(String, Figure)> {
    let elevation = request.elevation_rad.len() / 2;
    let at = format!("elevation {:.2}°", request.elevation_rad[elevation].to_degrees()).replace('-', "−");
    let cut = table.slice(s![.., elevation.., ..]);
    let [azimuth, frequency] = [over_azimuth(request, &cut), over_frequency(request, &cut)];
    let all = [
        ("azimuth", request.azimuth_rad.len(), azimuth),
        ("frequency", request.frequency_hz.len(), frequency),
    ];
    let drawn = all.into_iter().filter(|(_, values, _)| *values > 1);
    drawn
        .map(|(axis, _, plot)| {
            (format!("Level over {axis}, {at}."), Figure::draw(|layout| plot.draw(layout)))
        })
        .collect()
}

/// The view without its drawings.
fn view<'a>(
    out: &Path,
    mesh: &'a Mesh,
    request: &RcsRequest,
    amplitude_m: &[Complex64],
    parts: &'a [Contribution],
) -> RcsView<'a> {
    let aspect = middle_aspect(request);
    let radar = standpoint(request, aspect);
    let of_elevation = &amplitude_m[aspect - aspect % request.azimuth_rad.len()..];
    let cut = request.azimuth_rad.iter().zip(of_elevation).map(|(az, s)| [az.to_degrees(), dbsm(s)]);
    RcsView {
        mesh,
        name: out.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        parts,
        direction: radar.direction().to_array(),
        receiver_direction: request.receiver.unwrap_or(radar).direction().to_array(),
        aspect: aspect_name(request, &radar),
        azimuth_deg: radar.azimuth_rad.to_degrees(),
        level_dbsm: amplitude_m.get(aspect).map_or(f64::NAN, dbsm),
        cut: cut.collect(),
        drawings: vec![],
    }
}

/// Index of the middle azimuth at the middle elevation.
fn middle_aspect(request: &RcsRequest) -> usize {
    let [elevations, azimuths] = [request.elevation_rad.len(), request.azimuth_rad.len()];
    elevations / 2 * azimuths + azimuths / 2
}

/// Transmitter of an aspect; aspects are numbered elevation by elevation, azimuth by azimuth.
fn standpoint(request: &RcsRequest, aspect: usize) -> Standpoint {
    let azimuths = request.azimuth_rad.len();
    let (elevation_rad, azimuth_rad) =
        (request.elevation_rad[aspect / azimuths], request.azimuth_rad[aspect % azimuths]);
    Standpoint { azimuth_rad, elevation_rad, range_m: request.range_m }
}

fn aspect_name(request: &RcsRequest, radar: &Standpoint) -> String {
    let [elevation, azimuth] = [radar.elevation_rad, radar.azimuth_rad].map(f64::to_degrees);
    let seen = format!("elevation {elevation:.2}°, azimuth {azimuth:.2}°").replace('-', "−");
    format!("{}, {seen}", ghz(request.frequency_hz[0]))
}

/// Half the side of a square about the origin that holds the body, seen from above.
fn half_width_m(mesh: &Mesh) -> f64 {
    1.1 * mesh.vertices_m.iter().map(|v| v[0].hypot(v[1])).fold(0.1, f64::max)
}

/// Height over the origin of the middle between a body's lowest and highest place.
fn middle_height_m(mesh: &Mesh) -> f64 {
    let heights_m = || mesh.vertices_m.iter().map(|v| v[2]);
    0.5 * (heights_m().fold(f64::INFINITY, f64::min) + heights_m().fold(f64::NEG_INFINITY, f64::max))
}

/// Looks of all azimuths, with the body's extent in each.
fn looks(mesh: &Mesh, request: &RcsRequest) -> Vec<(AspectGeometry, Extent)> {
    let of = |azimuth_rad: &f64| {
        let look = AspectGeometry::of(request, *azimuth_rad);
        (look, look.extent(mesh))
    };
    request.azimuth_rad.par_iter().map(of).collect()
}

/// Number of drawn rays: more would hide the body.
const LINES: usize = 200;
/// Range of shown levels below the strongest sequence.
const SPAN_DB: f64 = 40.0;

/// Every file that can be written beside a table.
pub(super) fn places(out: &Path) -> Vec<PathBuf> {
    PICTURES.iter().chain([&FACETS, &VIEW]).map(|name| beside(out, name)).collect()
}

/// Refuses to replace pictures, a coloured mesh or a view that this program did not write.
pub(super) fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    let is_own_mesh = |head: &[u8]| head.starts_with(b"glTF") && holds(head, b"wayside");
    for place in places(out) {
        let is_own = |head: &[u8]| match place.extension().and_then(|ending| ending.to_str()) {
            Some("glb") => is_own_mesh(head),
            Some("html") => report::is_report(head),
            _ => is_own_picture(head),
        };
        files::refuse_foreign_head(&place, is_own)?;
    }
    Ok(())
}

fn holds(head: &[u8], mark: &[u8]) -> bool {
    head.windows(mark.len()).any(|bytes| bytes.eq_ignore_ascii_case(mark))
}

const POLAR: &str = "polar.png";
const AZIMUTH: &str = "azimuth.png";
const FREQUENCY: &str = "frequency.png";
const PROFILE: &str = "profile.png";
const ISAR: &str = "isar.png";
const PICTURES: [&str; 5] = [POLAR, AZIMUTH, FREQUENCY, PROFILE, ISAR];
const FACETS: &str = "facets.glb";
const VIEW: &str = "view.html";

fn beside(out: &Path, name: &str) -> PathBuf {
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    out.with_file_name(format!("{stem}-{name}"))
}

fn dbsm(s: &Complex64) -> f64 {
    db_from_power(s.norm_sqr())
}

fn ghz(frequency_hz: f64) -> String {
    format!("{:.3} GHz", 1e-9 * frequency_hz)
}

/// Indices of the first, middle and last frequency.
fn few(count: usize) -> Vec<usize> {
    let mut few = vec![0, count / 2, count.saturating_sub(1)];
    few.dedup();
    few
}

fn cuts(request: &RcsRequest, table: &ArrayView3<Complex64>) -> Vec<(String, Vec<[f64; 2]>)> {
    let cut = |f: usize| {
        let points =
            request.azimuth_rad.iter().enumerate().map(|(a, az)| [az.to_degrees(), dbsm(&table[[f, 0, a]])]);
        (ghz(request.frequency_hz[f]), points.collect())
    };
    few(request.frequency_hz.len()).into_iter().map(cut).collect()
}

fn polar(request: &RcsRequest, table: &ArrayView3<Complex64>) -> PolarPlot {
    let lines = cuts(request, table);
    let middle = lines.into_iter().nth(few(request.frequency_hz.len()).len() / 2).into_iter().collect();
    PolarPlot { title: "Radar cross section over azimuth".into(), unit: "dBsm".into(), lines: middle }
}

fn line_plot(title: &str, x_label: &str, y_label: &str, lines: Vec<Line>) -> LinePlot {
    LinePlot {
        title: title.into(),
        notes: vec![],
        x_label: x_label.into(),
        y_label: y_label.into(),
        x_scale: Scale::Linear,
        y_scale: Scale::Linear,
        lines,
    }
}

fn over_azimuth(request: &RcsRequest, table: &ArrayView3<Complex64>) -> LinePlot {
    let lines = cuts(request, table)
        .into_iter()
        .map(|(name, points)| Line { name, points, has_markers: false, tooltips: vec![] })
        .collect();
    line_plot("Radar cross section over azimuth", "azimuth, degrees", "|S|², dBsm", lines)
}

fn over_frequency(request: &RcsRequest, table: &ArrayView3<Complex64>) -> LinePlot {
    let line = |a: usize| Line {
        name: azimuth_name(request, a),
        points: request
            .frequency_hz
            .iter()
            .enumerate()
            .map(|(f, hz)| [1e-9 * hz, dbsm(&table[[f, 0, a]])])
            .collect(),
        has_markers: false,
        tooltips: vec![],
    };
    let lines = few(request.azimuth_rad.len()).into_iter().map(line).collect();
    line_plot("Radar cross section over frequency", "frequency, GHz", "|S|², dBsm", lines)
}

fn azimuth_name(request: &RcsRequest, azimuth: usize) -> String {
    format!("azimuth {:.2}°", request.azimuth_rad[azimuth].to_degrees()).replace('-', "−")
}

fn profile(
    mesh: &Mesh,
    request: &RcsRequest,
    samplings: &Samplings,
    table: &ArrayView3<Complex64>,
) -> LinePlot {
    let line = |a: usize| {
        let samples: Vec<Complex64> = table.slice(s![.., 0, a]).to_vec();
        let [low_m, high_m] = AspectGeometry::of(request, request.azimuth_rad[a]).extent(mesh).range_m;
        let profile = isar::range_profile(&request.frequency_hz, &samples, 0.5 * (low_m + high_m));
        let points = profile.iter().map(|(range_m, s)| [*range_m, dbsm(s)]).collect();
        Line { name: azimuth_name(request, a), points, has_markers: false, tooltips: vec![] }
    };
    let lines = few(request.azimuth_rad.len()).into_iter().map(line).collect();
    let range = Samplings { cross_range: None, ..*samplings };
    let label = format!("range beyond the origin, m{}", ambiguous(&range.warnings()));
    let plot = line_plot("Range profile", &label, "|S|² of a cell, dBsm", lines);
    LinePlot { notes: range.warnings().into_iter().map(capital).collect(), ..plot }
}

/// Addition to an axis's label if the body overlaps with itself.
fn ambiguous(warnings: &[String]) -> &'static str {
    if warnings.is_empty() { "" } else { AMBIGUOUS }
}

const AMBIGUOUS: &str = " (ambiguous)";

/// Additions to the labels of the body's axes, ahead and to the left: range is along the looks, cross-range
/// perpendicular to them.
fn axis_marks(request: &RcsRequest, samplings: &Samplings) -> [&'static str; 2] {
    let is_ambiguous = |of: &Option<Sampling>| of.as_ref().is_some_and(Sampling::is_ambiguous);
    let [range, cross] = [&samplings.range, &samplings.cross_range].map(is_ambiguous);
    let is_along = |part: fn(f64) -> f64| request.azimuth_rad.iter().any(|az| part(*az).abs() > OBLIQUE_SINE);
    let [cos, sin] = [f64::cos, f64::sin].map(is_along);
    let mark = |is_marked: bool| if is_marked { AMBIGUOUS } else { "" };
    [mark(range && cos || cross && sin), mark(range && sin || cross && cos)]
}

/// Sine of the angle between two directions up to which ambiguity across one does not show along the other.
const OBLIQUE_SINE: f64 = 0.3;

fn capital(sentence: String) -> String {
    let mut letters = sentence.chars();
    letters
        .next()
        .map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
        + "."
}

/// The image with the mesh's outline.
fn image(
    mesh: &Mesh,
    request: &RcsRequest,
    samplings: &Samplings,
    cut: &ArrayView2<Complex64>,
) -> Result<Svg, Failure> {
    let half_width_m = half_width_m(mesh);
    let square = Square { half_width_m, height_m: middle_height_m(mesh), samplings };
    let image = isar::image(&request.frequency_hz, &looks(mesh, request), cut, square);
    // Seen from above with the front up, the body's left is on the left.
    let levels_db: Array2<f64> = image.power_m2.slice(s![.., ..;-1]).mapv(db_from_power);
    let how = match image.sum {
        Summation::Coherent => "Azimuths added with their phases.",
        Summation::Incoherent => {
            "Azimuths too coarse for phases: profiles added in power, so that cross-range is blurred."
        }
    };
    let warnings = samplings.warnings();
    let [ahead, left] = axis_marks(request, samplings);
    let mut legend = Legend::default();
    legend.add_stacked(&[Mark::Backdrop, Mark::Line], "truthmap", "outline of the mesh from above");
    let map = HeatMap {
        title: "ISAR image (inverse synthetic aperture)".into(),
        notes: std::iter::once(how.to_owned()).chain(warnings.into_iter().map(capital)).collect(),
        x: (format!("to the body's left, m{left}"), [half_width_m, -half_width_m]),
        y: (format!("ahead, m{ahead}"), [-half_width_m, half_width_m]),
        levels_db,
        span_db: SPAN_DB,
        unit: "dBsm".into(),
        overlay: Some(silhouette::png(mesh, half_width_m)?),
        legend,
    };
    map.draw_square().map_err(Failure::refused)
}

/// Colour of each triangle by the power of its sequences per area, so that large and small triangles compare.
fn triangle_colours(mesh: &Mesh, parts: &[Contribution], strongest: f64) -> Vec<[u8; 3]> {
    let power = rcs_view::powers_of_facets(mesh, parts);
    power.iter().map(|p| if *p > 0.0 { colour(*p, strongest) } else { [40, 44, 52] }).collect()
}

/// Line from the transmitter's side, [`RAY_M`] long, over the touched points and equally far out to the
/// receiver's side.
fn ray(request: &RcsRequest, aspect: usize, part: &Contribution, strongest: f64) -> ColouredLine {
    let transmitter = standpoint(request, aspect);
    let [direction, back] =
        [transmitter, request.receiver.unwrap_or(transmitter)].map(|s| s.direction().to_array());
    let out = |from: &[f64; 3], along: [f64; 3]| [0, 1, 2].map(|i| from[i] + RAY_M * along[i]);
    let points: Vec<[f64; 3]> = part.points_m.iter().map(|p| p.to_array()).collect();
    let ends =
        points.first().zip(points.last()).map(|(first, last)| [out(first, direction), out(last, back)]);
    let points_m = ends.map_or(vec![], |[start, end]| [vec![start], points.clone(), vec![end]].concat());
    ColouredLine { points_m, colour: colour(part.amplitude_m.norm_sqr(), strongest) }
}

/// Drawn length of a ray's first and last leg.
const RAY_M: f64 = 1.5;

fn colour(power: f64, strongest: f64) -> [u8; 3] {
    inferno(1.0 + db_from_power(power / strongest) / SPAN_DB)
}
