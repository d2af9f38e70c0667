//! Interactive view of the body of an `rcs` table: facets by their contributions at one aspect, the strongest
//! facet sequences as rays, level over azimuth. One file that opens from disk, like the report; the table's
//! drawings and strongest sequences stand for the view on paper and where no script runs.

use crate::report::page::{figure, sheet};
use crate::report::tables::{rounded, scrolled};
use crate::report::viewer::packed::Packed;
use crate::report::viewer::page_script::{json, scripts};
use artifact::scene::Mesh;
use artifact::units::db_from_power;
use bart_rcs::Contribution;
use maud::{Markup, html};
use plotting::layout::Figure;
use serde::Serialize;

/// A table's body, with its scattering at one aspect.
pub struct RcsView<'a> {
    /// The body.
    pub mesh: &'a Mesh,
    /// Name of the file that it came from.
    pub name: String,
    /// Facet sequences at the aspect, strongest first.
    pub parts: &'a [Contribution],
    /// Direction from the body to the radar, a unit vector in body axes.
    pub direction: [f64; 3],
    /// Direction from the body to the receiver: the same if the radar is monostatic.
    pub receiver_direction: [f64; 3],
    /// The aspect and its frequency, in words.
    pub aspect: String,
    /// Azimuth of the aspect, degrees.
    pub azimuth_deg: f64,
    /// S at the aspect, dBsm.
    pub level_dbsm: f64,
    /// Azimuths at the same elevation in degrees, and their levels at the same frequency.
    pub cut: Vec<[f64; 2]>,
    /// Drawings of the table, each with its caption.
    pub drawings: Vec<(String, Figure)>,
}

/// Longest extent of the body in the units of the page, equal for bodies of millimetres and of metres.
const EXTENT: f64 = 10.0;
/// Range of coloured levels below the strongest sequence.
const SPAN_DB: f64 = 40.0;
/// Number of facets in the page, the strongest: more make a page of more than ten megabytes.
const FACETS: usize = 200_000;
/// Number of sequences in the page.
const SEQUENCES: usize = 5_000;
/// Number of sequences in the page's table.
const SEQUENCES_TOLD: usize = 12;
/// Number of facets of a sequence in that table; a longer one ends with an ellipsis.
const FACETS_TOLD: usize = 12;
/// Length of a ray's first and last leg.
const LEG: f64 = 4.0;

/// Numbers of the page.
#[derive(Serialize)]
struct RcsPage {
    corners: Packed,
    triangles: Packed,
    /// Numbers of the facets in the mesh.
    numbers: Packed,
    levels: Packed,
    #[serde(rename = "box")]
    bounds: [[f64; 3]; 2],
    direction: [f64; 3],
    azimuth_deg: f64,
    rays: Rays,
    strongest_dbsm: f64,
    /// Powers of all sequences relative to the strongest.
    all_power: f64,
    all_sequences: usize,
    cut: Cut,
}

/// Sequences, strongest first.
#[derive(Serialize)]
struct Rays {
    orders: Packed,
    levels_db: Packed,
    corners: Packed,
    places: Packed,
    facet_counts: Packed,
    facets: Packed,
}

#[derive(Serialize)]
struct Cut {
    azimuths_deg: Vec<f64>,
    levels_dbsm: Vec<f64>,
}

/// The page as text; an error of serde's if a number is not finite.
pub fn page(view: &RcsView<'_>) -> Result<String, serde_json::Error> {
    let numbers = json(&view.numbers())?;
    Ok(sheet(&view.name, content(view, &numbers)))
}

impl RcsView<'_> {
    fn strongest(&self) -> f64 {
        self.parts.first().map_or(1.0, |part| part.amplitude_m.norm_sqr())
    }

    fn numbers(&self) -> RcsPage {
        let transform = PageTransform::of(self.mesh);
        let powers = powers_of_facets(self.mesh, self.parts);
        let shown = shown(&powers);
        let corners: Vec<f64> = self.mesh.vertices_m.iter().flat_map(|v| transform.of_m(*v)).collect();
        let triangles: Vec<u32> = shown.iter().flat_map(|t| self.mesh.triangles[*t as usize]).collect();
        let levels: Vec<u8> = shown.iter().map(|t| level(powers[*t as usize], self.strongest())).collect();
        let all: f64 = self.parts.iter().map(|part| part.amplitude_m.norm_sqr()).sum();
        RcsPage {
            corners: Packed::steps(&corners, 5e-4),
            triangles: Packed::numbers(&triangles),
            numbers: Packed::numbers(&shown),
            levels: Packed::bytes(&levels),
            bounds: transform.bounds(),
            direction: self.direction,
            azimuth_deg: self.azimuth_deg,
            rays: self.rays(&transform),
            strongest_dbsm: db_from_power(self.strongest()),
            all_power: all / self.strongest(),
            all_sequences: self.parts.len(),
            cut: Cut {
                azimuths_deg: self.cut.iter().map(|point| point[0]).collect(),
                levels_dbsm: self.cut.iter().map(|point| point[1].max(-200.0)).collect(),
            },
        }
    }

    fn rays(&self, transform: &PageTransform) -> Rays {
        let parts = &self.parts[..self.parts.len().min(SEQUENCES)];
        let ways: Vec<Vec<[f64; 3]>> = parts.iter().map(|part| self.way(transform, part)).collect();
        let bytes = |of: fn(&Contribution) -> usize| {
            Packed::bytes(&parts.iter().map(|part| of(part).min(255) as u8).collect::<Vec<_>>())
        };
        let db = |part: &Contribution| db_from_power(part.amplitude_m.norm_sqr() / self.strongest());
        let facets: Vec<u32> =
            parts.iter().flat_map(|part| part.triangles.iter().copied().take(255)).collect();
        Rays {
            orders: bytes(|part| part.points_m.len()),
            levels_db: Packed::steps(
                &parts.iter().map(|part| db(part).max(-300.0)).collect::<Vec<_>>(),
                0.05,
            ),
            corners: Packed::bytes(&ways.iter().map(|way| way.len().min(255) as u8).collect::<Vec<_>>()),
            places: Packed::steps(&ways.concat().concat(), 5e-4),
            facet_counts: bytes(|part| part.triangles.len()),
            facets: Packed::numbers(&facets),
        }
    }

    /// Course of the ray: from the radar's side over the touched points and out to the receiver's.
    fn way(&self, transform: &PageTransform, part: &Contribution) -> Vec<[f64; 3]> {
        let points: Vec<[f64; 3]> =
            part.points_m.iter().take(250).map(|p| transform.of_m(p.to_array())).collect();
        let out = |from: &[f64; 3], along: [f64; 3]| [0, 1, 2].map(|i| from[i] + LEG * along[i]);
        match (points.first(), points.last()) {
            (Some(first), Some(last)) => {
                let ends = [out(first, self.direction), out(last, self.receiver_direction)];
                [vec![ends[0]], points.clone(), vec![ends[1]]].concat()
            }
            _ => vec![],
        }
    }
}

/// Transform of places of the body to the units of the page.
struct PageTransform {
    low_m: [f64; 3],
    high_m: [f64; 3],
    scale: f64,
}

impl PageTransform {
    fn of(mesh: &Mesh) -> Self {
        let [low_m, high_m] = mesh.bounds_m();
        let extent_m = mesh.size_m().into_iter().fold(0.0, f64::max);
        Self { low_m, high_m, scale: EXTENT / extent_m.max(f64::MIN_POSITIVE) }
    }

    fn of_m(&self, place_m: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.scale * (place_m[axis] - 0.5 * (self.low_m[axis] + self.high_m[axis])))
    }

    fn bounds(&self) -> [[f64; 3]; 2] {
        [self.of_m(self.low_m), self.of_m(self.high_m)]
    }
}

/// Power of the sequences that each triangle takes part in.
pub fn powers_of_facets(mesh: &Mesh, parts: &[Contribution]) -> Vec<f64> {
    let mut power = vec![0.0; mesh.triangles.len()];
    for part in parts {
        part.triangles.iter().for_each(|t| power[*t as usize] += part.amplitude_m.norm_sqr());
    }
    power
}

/// Facets in the page, in order: all, or those with the largest contributions.
fn shown(powers: &[f64]) -> Vec<u32> {
    let mut facets: Vec<u32> = (0..powers.len() as u32).collect();
    if facets.len() > FACETS {
        facets.sort_by(|a, b| powers[*b as usize].total_cmp(&powers[*a as usize]).then(a.cmp(b)));
        facets.truncate(FACETS);
        facets.sort_unstable();
    }
    facets
}

/// Level of a facet: 0 if it returns nothing within the span, else one plus its decibels above the span's
/// lower end.
fn level(power: f64, strongest: f64) -> u8 {
    let db = db_from_power(power / strongest) + SPAN_DB;
    if power > 0.0 && db >= 0.0 { 1 + db.min(SPAN_DB).round() as u8 } else { 0 }
}

/// Instructions for reading and moving the view.
const HOW: &str = "Facets from −40 to 0 dB of the strongest sequence, by the powers of all sequences that they \
                   take part in, without their phases. Lines are sequences, coloured by their bounces. Drag \
                   turns the view, with the right button or Shift moves it; the wheel comes nearer once the \
                   picture was clicked. A click on a facet lists its sequences.";

/// The view's own scripts, in the order in which they use each other.
const SCRIPT: [&str; 4] = [
    include_str!("viewer/script/map.js"),
    include_str!("viewer/script/cuts.js"),
    include_str!("viewer/script/listening.js"),
    include_str!("viewer/script/rcs_view.js"),
];

fn content(view: &RcsView<'_>, numbers: &str) -> Markup {
    let left_out = view.mesh.triangles.len().saturating_sub(FACETS);
    html! {
        p.lead { (view.aspect) ": " (format!("{:.1} dBsm", view.level_dbsm).replace('-', "−")) " from "
            (view.parts.len()) " facet sequences." }
        noscript { p.made { "Scripts are disabled; the drawings and the table below show the same levels." } }
        section #viewer hidden {
            (controls())
            div.viewer-scene {
                div #viewer-space-place {
                    canvas #viewer-space tabindex="0" role="img" aria-label="The body in three dimensions" {}
                }
                div #viewer-panel aria-live="polite" {}
            }
            p.made { i #viewer-scale {} (HOW) }
            @if left_out > 0 { p.made { (left_out) " facets that return least are not shown." } }
            @if view.cut.len() > 1 {
                div.viewer-maps { div { canvas #viewer-cut role="img" aria-label="Level over azimuth" {} } }
            }
        }
        section {
            h2 { "The table" }
            @for (caption, drawing) in &view.drawings { (figure(caption, drawing)) }
            h3 { (STRONGEST) }
            (strongest_sequences(view.parts))
        }
        (scripts(numbers, &SCRIPT))
    }
}

/// Heading of the sequences' table.
const STRONGEST: &str = "Strongest facet sequences";

/// Table of the strongest sequences, with the numbers of their facets in the mesh.
fn strongest_sequences(parts: &[Contribution]) -> Markup {
    let shown = &parts[..parts.len().min(SEQUENCES_TOLD)];
    let table = html! { table {
        thead { tr { th { "rank" } th { "bounces" } th { "level, dBsm" } th.words { "facets" } } }
        tbody {
            @for (rank, part) in (1..).zip(shown) {
                tr { td { (rank) } td { (part.points_m.len()) }
                    td { (rounded(db_from_power(part.amplitude_m.norm_sqr()), 1)) } td.words { (facets(part)) } }
            }
        }
    } };
    scrolled(STRONGEST, table)
}

/// Numbers of a sequence's facets, in words.
fn facets(part: &Contribution) -> String {
    let numbers: Vec<String> = part.triangles.iter().take(FACETS_TOLD).map(u32::to_string).collect();
    let rest = if part.triangles.len() > FACETS_TOLD { ", …" } else { "" };
    numbers.join(", ") + rest
}

fn controls() -> Markup {
    let layers = [("body", "body"), ("rays", "sequences")];
    let places = [("side", "from the side"), ("radar", "from the radar"), ("above", "from above")];
    html! {
        div.viewer-controls {
            label { "down to " input #viewer-level type="range" min="-40" max="0" value="-20" step="1";
                output #viewer-level-told {} }
        }
        div.viewer-controls {
            @for (name, words) in layers {
                label { input type="checkbox" data-layer=(name) checked; " " (words) }
            }
            @for (place, words) in places { button type="button" data-place=(place) { (words) } }
            span #viewer-orders {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::viewer::page_script::reads_as_the_source_does;
    use glam::DVec3;
    use num_complex::Complex64;
    use plotting::svg::Svg;

    fn plate() -> Mesh {
        let vertices_m = vec![[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0], [0.0, 2.0, 1.0]];
        Mesh { vertices_m, triangles: vec![[0, 1, 2], [1, 3, 2]], ..Mesh::default() }
    }

    fn part(triangle: u32, amplitude: f64) -> Contribution {
        let amplitude_m = Complex64::new(amplitude, 0.0);
        let points_m = vec![DVec3::new(0.0, 1.0, 0.5)];
        Contribution { triangles: vec![triangle], edge_m: None, points_m, amplitude_m }
    }

    #[test]
    fn the_script_reads_as_the_rest_of_the_source_does() {
        reads_as_the_source_does(&SCRIPT);
    }

    #[test]
    fn levels_are_whole_decibels_over_the_foot_and_nothing_below_it() {
        assert_eq!([1.0, 0.1, 1e-4, 0.9e-4, 0.0].map(|power| level(power, 1.0)), [41, 31, 1, 0, 0]);
        assert_eq!(level(3.0, 1.0), 41);
    }

    #[test]
    fn a_body_of_any_size_is_ten_units_long_about_the_middle() {
        let transform = PageTransform::of(&plate());
        assert_eq!(transform.bounds(), [[0.0, -5.0, -2.5], [0.0, 5.0, 2.5]]);
    }

    fn view<'a>(mesh: &'a Mesh, parts: &'a [Contribution]) -> RcsView<'a> {
        RcsView {
            mesh,
            name: "</script>.npy".into(),
            parts,
            direction: [1.0, 0.0, 0.0],
            receiver_direction: [0.0, 0.0, 1.0],
            aspect: "77.000 GHz".into(),
            azimuth_deg: 0.0,
            level_dbsm: 6.0,
            cut: vec![[0.0, f64::NEG_INFINITY]],
            drawings: vec![(
                "Its caption.".into(),
                Figure::draw(|layout| Svg::new("cut", layout.width_px(), 9.0)),
            )],
        }
    }

    #[test]
    fn a_ray_comes_from_the_radar_and_goes_to_the_receiver() {
        let (mesh, parts) = (plate(), [part(0, 1.0)]);
        let way = view(&mesh, &parts).way(&PageTransform::of(&mesh), &parts[0]);
        assert_eq!(way, [[LEG, 0.0, 0.0], [0.0; 3], [0.0, 0.0, LEG]]);
    }

    #[test]
    fn the_page_tells_all_sequences_and_no_name_ends_its_script() {
        let (mesh, parts) = (plate(), [part(1, 2.0), part(0, 1.0)]);
        let view = view(&mesh, &parts);
        let numbers = view.numbers();
        assert_eq!((numbers.all_sequences, numbers.all_power), (2, 1.25));
        assert_eq!(numbers.cut.levels_dbsm, [-200.0]);
        let page = page(&view).unwrap();
        assert_eq!(page.matches("</script>").count(), 2);
        assert!(!page.contains("viewer-cut\" role"), "one azimuth has no cut");
    }

    #[test]
    fn drawings_and_sequences_stand_outside_of_the_view_which_is_hidden_without_scripts() {
        let (mesh, mut parts) = (plate(), vec![part(1, 2.0); 20]);
        parts[0].triangles = (0..30).map(|number| number % 2).collect();
        let page = page(&view(&mesh, &parts)).unwrap();
        let behind = page.split("<h2>The table</h2>").nth(1).unwrap();
        let beside = behind.split("<script").next().unwrap();
        assert_eq!((beside.matches("<svg").count(), beside.matches("Its caption.").count()), (2, 1));
        assert_eq!(beside.matches("<tr>").count(), 1 + SEQUENCES_TOLD);
        assert!(beside.contains(">0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, …<") && beside.contains(">6.0<"));
        assert!(page.contains("<noscript>"));
    }
}
