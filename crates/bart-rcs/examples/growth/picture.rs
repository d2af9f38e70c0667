//! Cost over what grows, side by side, drawn from the table alone.

use std::fmt::Write as _;

/// Sides of a plot, and the room left of one for its numbers.
const SIDE: f64 = 230.0;
const ROOM: f64 = 74.0;
const TOP: f64 = 92.0;
/// Least room between two numbers of an axis.
const GAP: f64 = 6.0;

/// A sweep as a table has it: (value, processor seconds).
struct Sweep {
    name: String,
    unit: String,
    points: Vec<(f64, f64)>,
}

/// Colours by day and by night; the broken line is cost in proportion.
const STYLE: &str = "text{fill:#1b1f23;font:12px 'Ubuntu',system-ui,sans-serif}.head{font-size:14px;font-weight:600}.paper{fill:#fff}\
.ink{fill:none;stroke:#444}.faint{stroke:#ddd}.cost{stroke:#0072b2;fill:none;stroke-width:1.8}.mark{fill:#0072b2}\
.linear{stroke:#a86e00;fill:none;stroke-width:1.4;stroke-dasharray:5 4}\
@media (prefers-color-scheme:dark){text{fill:#e6e9ec}.paper{fill:#14171a}.ink{stroke:#9aa4ae}.faint{stroke:#333a41}.cost{stroke:#56b4e9}\
.mark{fill:#56b4e9}.linear{stroke:#f0b429}}";

/// Processor seconds over each sweep's value, both logarithmic.
pub(crate) fn picture(csv: &str) -> Option<String> {
    let sweeps = read(csv)?;
    let seconds = || sweeps.iter().flat_map(|s| s.points.iter().map(|p| p.1.log10()));
    let span =
        [seconds().fold(f64::INFINITY, f64::min).floor(), seconds().fold(f64::NEG_INFINITY, f64::max).ceil()];
    let (width, height) = (ROOM + (SIDE + ROOM) * sweeps.len() as f64 - 30.0, TOP + SIDE + 84.0);
    let title = "How the cost of one aspect of a car grows";
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\" \
         aria-label=\"{title}\"><title>{title}</title><style>{STYLE}</style>\n\
         <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n\
         <text class=\"head\" x=\"10\" y=\"22\">{title}</text>\n\
         <text x=\"10\" y=\"42\">Processor seconds, both axes by powers of ten. Better is lower, and flatter: a line less steep than the broken \
         one grows more slowly than what is counted below it.</text>\n"
    );
    for (number, sweep) in sweeps.iter().enumerate() {
        plot(&mut svg, ROOM + (SIDE + ROOM) * number as f64, sweep, span)?;
    }
    let y = height - 14.0;
    let _ = writeln!(
        svg,
        "<polyline class=\"cost\" points=\"10,{y} 34,{y}\"/><circle class=\"mark\" cx=\"22\" cy=\"{y}\" r=\"3.5\"/>\
         <text x=\"40\" y=\"{}\">measured</text><polyline class=\"linear\" points=\"120,{y} 144,{y}\"/>\
         <text x=\"150\" y=\"{}\">in proportion to the first value</text>\n</svg>",
        y + 4.0,
        y + 4.0
    );
    Some(svg)
}

fn plot(svg: &mut String, left: f64, sweep: &Sweep, [low, high]: [f64; 2]) -> Option<()> {
    let (first, last) = (sweep.points.first()?, sweep.points.last()?);
    let x = |value: f64| left + SIDE * (value / first.0).log10() / (last.0 / first.0).log10();
    let y = |seconds: f64| TOP + SIDE - SIDE * (seconds.log10() - low) / (high - low);
    let bottom = TOP + SIDE;
    for decade in low as i32..=high as i32 {
        let at = y(10.0_f64.powi(decade));
        let seconds = if decade < 0 {
            format!("{:.*}", -decade as usize, 10.0_f64.powi(decade))
        } else {
            format!("{:.0}", 10.0_f64.powi(decade))
        };
        let _ = writeln!(
            svg,
            "<line class=\"faint\" x1=\"{left}\" y1=\"{at:.1}\" x2=\"{}\" y2=\"{at:.1}\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{seconds} s</text>",
            left + SIDE,
            left - 5.0,
            at + 4.0
        );
    }
    let _ =
        writeln!(svg, "<rect class=\"ink\" x=\"{left}\" y=\"{TOP}\" width=\"{SIDE}\" height=\"{SIDE}\"/>");
    let _ = writeln!(svg, "<text x=\"{left}\" y=\"{}\">{}</text>", TOP - 10.0, heading(sweep));
    // In proportion, as far as the plot reaches.
    let reach = (10.0_f64.powf(high) / first.1).min(last.0 / first.0);
    let (from, to) = ([x(first.0), y(first.1)], [x(first.0 * reach), y(first.1 * reach)]);
    let _ = writeln!(
        svg,
        "<polyline class=\"linear\" points=\"{:.1},{:.1} {:.1},{:.1}\"/>",
        from[0], from[1], to[0], to[1]
    );
    let mut line = String::new();
    let mut free_from = f64::NEG_INFINITY;
    for (value, seconds) in &sweep.points {
        let (px, py, words) = (x(*value), y(*seconds), grouped(*value));
        let _ = write!(line, "{px:.1},{py:.1} ");
        let _ = writeln!(svg, "<circle class=\"mark\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"3.5\"/>");
        let half = 3.8 * words.len() as f64;
        if px - half > free_from + GAP {
            let _ = writeln!(
                svg,
                "<text x=\"{px:.1}\" y=\"{}\" text-anchor=\"middle\">{words}</text>",
                bottom + 18.0
            );
            free_from = px + half;
        }
    }
    let _ = writeln!(svg, "<polyline class=\"cost\" points=\"{line}\"/>");
    Some(())
}

fn heading(sweep: &Sweep) -> String {
    match (sweep.name.as_str(), sweep.unit.as_str()) {
        ("orders", _) => "over the highest bounce order".into(),
        (name, "1") => format!("over the number of {name}"),
        (name, unit) => format!("over {name}, {unit}"),
    }
}

/// Thousands apart.
fn grouped(value: f64) -> String {
    let digits = format!("{value}");
    let letters: Vec<char> = digits.chars().collect();
    let parts: Vec<String> = letters.rchunks(3).rev().map(|part| part.iter().collect()).collect();
    if digits.contains('.') { digits } else { parts.join(",") }
}

fn read(csv: &str) -> Option<Vec<Sweep>> {
    let mut sweeps: Vec<Sweep> = vec![];
    for line in csv.lines().skip(1) {
        let [name, value, unit, _beams, seconds] = line.split(',').collect::<Vec<_>>()[..] else {
            return None;
        };
        let point = (value.parse().ok()?, seconds.parse().ok()?);
        match sweeps.iter_mut().find(|sweep| sweep.name == name) {
            Some(sweep) => sweep.points.push(point),
            None => sweeps.push(Sweep { name: name.into(), unit: unit.into(), points: vec![point] }),
        }
    }
    (!sweeps.is_empty()).then_some(sweeps)
}
