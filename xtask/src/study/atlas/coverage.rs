//! Cases for each line of docs/physics.md §10, and for other questions to the atlas.

use crate::study::atlas::CaseRow;

/// A line with the cases that test it.
type Line = (&'static str, &'static [&'static str]);

/// Lines of docs/physics.md §10, then others.
const LINES: &[Line] = &[
    ("§10 far-field table: R < 2D²/λ", &["far-field table of a 1.5 m plate", "paths of the same plate"]),
    (
        "§10 PO alone: panels off normal, edge-on",
        &["strip of ten wavelengths, exact series", "plate seen nearly along itself"],
    ),
    ("§10 PO shadow: penumbra, creeping waves, ka < 10", &["level of spheres against Mie's series"]),
    ("§10 facets: q > 0.35", &["cylinder as flat strips, worst of five turns"]),
    ("§10 point facet", &["cylinder of few samples a facet"]),
    ("§10 mean-phase correction, off specular", &["near plate off its specular (pieces cancel)"]),
    ("§10 Gordon's formula, |w|D → 0", &["plate almost square to the wave (Gordon 0/0)"]),
    ("§10 joins: all nodes joined", &["right corners, one order alone"]),
    ("§10 exit node on curvature", &["top hat, order 2 alone"]),
    ("§10 non-90° corners", &["middle against exit node off 90°"]),
    (
        "§10 clipping: coplanar, touching, needle facets, 1 km",
        &[
            "every triangle there twice",
            "cube on a floor, its bottom in the floor's plane",
            "plate of needles and T-junctions",
            "mesh a kilometre from its origin",
        ],
    ),
    (
        "§10 SBR: few rays, glancing plates",
        &["square trihedral, order 3 alone", "plate seen 10° from its plane"],
    ),
    ("§10 open meshes, flipped normals", &["a tenth of the facets wound wrongly, open rim"]),
    ("§10 bounces: cavities", &["box without a front", "duct ten times as long as wide, shut at its end"]),
    ("§10 slabs: d unknown to λ/10", &["panes of glass, Fresnel's slab"]),
    ("§10 frozen paths: near lanes, long frames", &["frozen for a frame, lane 3 at 25 m"]),
    ("§10 low-rank NUFFT: wheels", &["points on rolling wheels against the formulas"]),
    ("§10 f32", &["samples of a point against the formulas"]),
    (
        "§10 aliasing in velocity and range",
        &["speed against v_max 8.78 m/s (experiment 3)", "range against R_max 61.4 m"],
    ),
    (
        "§10 CFAR: edges, two close targets, padding",
        &["false alarms by zone, asked 1e-2", "two points three cells apart"],
    ),
    ("§10 TDM: v unresolved", &["place of a point at −10 m/s, 3 transmitters"]),
    ("grazing incidence", &["plate seen nearly along itself", "plate seen 10° from its plane"]),
    (
        "caustics of concave bodies",
        &[
            "hollow mirror seen from its centre (a caustic)",
            "hollow mirror about its focus, dense sampling",
            "half tube from inside, rays of the same order",
        ],
    ),
    ("aspect steps of 1e-6°", &["aspects a millionth of a degree apart, largest jump"]),
    (
        "parts of ka < 3",
        &["level of small discs against Rayleigh's", "level of spheres against Mie's series"],
    ),
    ("near-tangent beams", &["beams almost along a wall of a corner"]),
    (
        "closed cavities whose order never ends",
        &[
            "antenna between two walls, orders without end",
            "closed box from outside: nothing gets in",
            "antenna in a body or within a wavelength of it",
        ],
    ),
    (
        "antenna near or inside",
        &[
            "antenna in a body or within a wavelength of it",
            "plate larger than its distance",
            "sphere of 10 cm from close by, geometrical optics",
        ],
    ),
    (
        "target at 0 m and at the maximum range",
        &["a target at the radar", "range of a point at the ends of the range axis, in cells"],
    ),
    (
        "velocity at the ambiguity",
        &["speed at the ambiguity, ±8.7774 m/s", "speed beyond the span of Doppler division, ±16.2 m/s"],
    ),
    ("two targets in one cell", &["two targets in one cell, 0.7 of a beam apart"]),
    ("100 dB of dynamic range", &["a point far below another, 5 m away"]),
    ("sparse-array grating lobes", &["grating lobes of a sparse array, two wavelengths apart"]),
    ("CFAR at clutter steps", &["false alarms on a step of the clutter by 30 dB"]),
    (
        "float overflow in long runs",
        &[
            "a point that has driven for long, against one that begins there",
            "levels at the limits of the keys: range of a lone point",
        ],
    ),
    ("a frame with no target", &["a frame without a target: objects"]),
    ("noise only", &["noise alone: tracks that are believed", "false alarms by zone, asked 1e-2"]),
    (
        "tiny training sets",
        &["tiny training sets: accuracy told against true", "labels by chance: accuracy told against true"],
    ),
    ("classes missing", &["training sets without all classes"]),
    (
        "vehicles overlapping",
        &[
            "bodies that stand in one another, dense sampling of both",
            "a body that is there twice, against once",
        ],
    ),
    (
        "TDM at speed",
        &[
            "place of a point at −10 m/s, 3 transmitters",
            "points at the limits of their keys against the formulas",
        ],
    ),
    (
        "several radars interfering",
        &["power of several crossing radars against closed forms", "a weak point beside crossing radars"],
    ),
    (
        "interferer at the same slope",
        &[
            "interferer of the same slope, its ghost against its formula",
            "objects of an empty road beside an interferer",
        ],
    ),
    ("saturated ADC", &["level of an echo beyond the converter's full scale"]),
    ("10⁴ targets", &["very many targets against the formulas"]),
    ("wheels", &["points on rolling wheels against the formulas"]),
    (
        "road at Brewster's angle",
        &[
            "sphere above a smooth road, Brewster's angle is 18.0°",
            "half-space of glass about its Brewster angle, 68.6°",
        ],
    ),
    (
        "curved walls facing each other",
        &["two round walls that face each other", "two hollow walls that face each other"],
    ),
    ("ducts", &["duct ten times as long as wide, shut at its end"]),
    ("meshes of few polygons, 10 dB below cars", &["smooth body of few polygons, mean |dB| of 24 aspects"]),
    (
        "vehicle larger than its distance",
        &["body longer than its distance, dense sampling", "plate larger than its distance"],
    ),
];

/// The table of the page: each line with its cases and all of their verdicts.
pub(super) fn table(rows: &[CaseRow]) -> String {
    let line =
        |(line, cases): &Line| format!("| {} | {} |\n", line.replace('|', "\\|"), verdict_text(cases, rows));
    let all: String = LINES.iter().map(line).collect();
    format!("| asked for | cases |\n| --- | --- |\n{all}")
}

fn verdict_text(cases: &[&str], rows: &[CaseRow]) -> String {
    let of = |case: &&str| {
        let own: Vec<&CaseRow> = rows.iter().filter(|row| row.case == *case).collect();
        let mut names: Vec<&str> = own.iter().map(|row| row.verdict.name()).collect();
        names.dedup();
        names.sort_unstable();
        names.dedup();
        let verdicts = if own.is_empty() { "not tried".to_owned() } else { names.join(", ") };
        format!("{} ({verdicts})", case.replace('|', "\\|"))
    };
    cases.iter().map(of).collect::<Vec<_>>().join("; ")
}

/// Cases of the lines without a row.
pub(super) fn missing(rows: &[CaseRow]) -> Vec<&'static str> {
    let is_tried = |case: &str| rows.iter().any(|row| row.case == case);
    LINES.iter().flat_map(|(_, cases)| cases.iter().copied()).filter(|case| !is_tried(case)).collect()
}
