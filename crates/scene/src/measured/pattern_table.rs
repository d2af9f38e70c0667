//! `pattern_file` of `[radar.array]`: gain over direction as in data sheets, a table or two cuts.
//!
//! ```text
//! az_deg, el_deg, gain_db     the first line
//! -90, 0, -24.5               one direction a line, in any order; # begins a comment
//! ```
//!
//! Lines for every pair of some azimuths and elevations are a table. Otherwise every line lies on one of the
//! two cuts, el_deg = 0 or az_deg = 0, and the gain elsewhere is the sum of both in dB less that at the
//! crossing.

use crate::measured::table_text;
use artifact::bounded::{self, ReadFault};
use artifact::radar::PatternTable;
use artifact::units::amplitude_from_db;
use std::path::{Path, PathBuf};

/// Reads the table in a file.
///
/// # Errors
/// The first rule that the file breaks, with its line.
pub(crate) fn read_pattern_table(file: &Path) -> Result<PatternTable, PatternFileError> {
    let at = |line, rule| PatternFileError { file: file.to_owned(), line, rule };
    let text = text_of(file).map_err(|rule| at(0, rule))?;
    let mut lines = table_text::lines(&text);
    let Some((first, heading)) = lines.next() else { return Err(at(1, PatternRule::NoHeading)) };
    if heading.split(',').map(str::trim).ne(COLUMNS) {
        return Err(at(first, PatternRule::NoHeading));
    }
    let direction = |(number, line)| direction(number, line).map_err(|rule| at(number, rule));
    let directions: Vec<Direction> = lines.map(direction).collect::<Result<_, _>>()?;
    table(&directions).map_err(|(line, rule)| at(line, rule))
}

/// Reason why a pattern file is refused.
#[derive(Debug, thiserror::Error)]
#[error("{}: {rule}", table_text::place(file, *line))]
pub struct PatternFileError {
    /// Path as the scene names it.
    pub file: PathBuf,
    /// Line of the file, from 1; 0 if no line is at fault.
    pub line: u32,
    /// Rule that the file breaks.
    pub rule: PatternRule,
}

/// Broken rules of a pattern file.
#[derive(Debug, thiserror::Error)]
pub enum PatternRule {
    /// The file cannot be read, or has more bytes than any table of the allowed size.
    #[error("{0}")]
    File(#[source] ReadFault),
    /// The first line is that of another table, or no heading.
    #[error("the first line must be `az_deg,el_deg,gain_db`")]
    NoHeading,
    /// A line is not three numbers.
    #[error("must be three numbers az_deg,el_deg,gain_db, is `{found}`")]
    NotNumbers {
        /// Text of the line.
        found: String,
    },
    /// An angle or a gain outside its range.
    #[error("{column} must lie within ±{limit}, is {found}")]
    OutOfRange {
        /// Name of the column.
        column: &'static str,
        /// Value in the file.
        found: f64,
        /// Largest magnitude that the column may hold.
        limit: f64,
    },
    /// A direction with two gains.
    #[error("direction {azimuth_deg}, {elevation_deg} has another gain in line {first_line}")]
    ToldTwice {
        /// Azimuth of the direction.
        azimuth_deg: f64,
        /// Elevation of the direction.
        elevation_deg: f64,
        /// Line of its first gain.
        first_line: u32,
    },
    /// A cubic needs three values.
    #[error("{column} takes {found} values; one or at least three are needed")]
    TooFew {
        /// Name of the axis.
        column: &'static str,
        /// Number of different values on the axis.
        found: usize,
    },
    /// The directions form neither a table nor cuts.
    #[error(
        "not every pair of azimuth and elevation is there, and this direction lies on neither cut, el_deg = 0 or az_deg = 0"
    )]
    NeitherTableNorCuts,
    /// Cuts that do not cross.
    #[error("the cuts el_deg = 0 and az_deg = 0 need a line for 0,0, where they cross")]
    NoCrossing,
    /// A table too large for the headers of artifacts.
    #[error("{azimuths} azimuths × {elevations} elevations are more than {limit} values")]
    TooLarge {
        /// Number of azimuths of the table.
        azimuths: usize,
        /// Number of elevations of the table.
        elevations: usize,
        /// Largest number of values in a table.
        limit: usize,
    },
}

impl PatternFileError {
    /// Whether the system failed, not the content of the file.
    pub fn is_system(&self) -> bool {
        matches!(&self.rule, PatternRule::File(error) if error.is_system())
    }
}

const COLUMNS: [&str; 3] = ["az_deg", "el_deg", "gain_db"];
/// Largest magnitude in each column. Below −200 dB nothing is left of an echo in f32.
const LIMITS: [f64; 3] = [180.0, 90.0, 200.0];
/// Largest table: a degree all around is 361 × 181 values; every later artifact contains them.
const VALUES_MAX: usize = 1 << 16;
const LIMIT_BYTES: u64 = 16 << 20;

type Fault = (u32, PatternRule);

/// A line of the file.
#[derive(Debug, Clone, Copy)]
struct Direction {
    line: u32,
    azimuth_deg: f64,
    elevation_deg: f64,
    gain_db: f64,
}

fn text_of(file: &Path) -> Result<String, PatternRule> {
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(PatternRule::File)?;
    // Text that is not UTF-8 is not a number either, and is refused at its line.
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn direction(line: u32, text: &str) -> Result<Direction, PatternRule> {
    let not_numbers = || PatternRule::NotNumbers { found: text.chars().take(80).collect() };
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    let numbers: [f64; 3] = numbers.map_err(|_| not_numbers())?.try_into().map_err(|_| not_numbers())?;
    for ((found, limit), column) in numbers.into_iter().zip(LIMITS).zip(COLUMNS) {
        // NaN is in no range.
        if !(-limit..=limit).contains(&found) {
            return Err(PatternRule::OutOfRange { column, found, limit });
        }
    }
    // −0 becomes 0, so that directions can be compared by their bits.
    let [azimuth_deg, elevation_deg, gain_db] = numbers.map(|number| number + 0.0);
    Ok(Direction { line, azimuth_deg, elevation_deg, gain_db })
}

fn table(directions: &[Direction]) -> Result<PatternTable, Fault> {
    let told = distinct(directions)?;
    let axis = |of: fn(&Direction) -> f64| {
        let mut values: Vec<f64> = told.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    };
    let (azimuths, elevations) = (axis(|d| d.azimuth_deg), axis(|d| d.elevation_deg));
    check_values(&told, COLUMNS[0], &azimuths, |d| d.azimuth_deg)?;
    check_values(&told, COLUMNS[1], &elevations, |d| d.elevation_deg)?;
    let values = azimuths.len() * elevations.len();
    if values > VALUES_MAX {
        let (azimuths, elevations) = (azimuths.len(), elevations.len());
        return Err((0, PatternRule::TooLarge { azimuths, elevations, limit: VALUES_MAX }));
    }
    let gains_db = if told.len() == values { row_by_row(&told) } else { from_cuts(&told)? };
    let radians = |degrees: Vec<f64>| degrees.into_iter().map(f64::to_radians).collect();
    Ok(PatternTable {
        azimuth_rad: radians(azimuths),
        elevation_rad: radians(elevations),
        amplitude: gains_db.into_iter().map(amplitude_from_db).collect(),
    })
}

/// Refuses an axis without values, and one with two, at the first line of the value with fewer lines, or of
/// the later value if both have equally many.
fn check_values(
    told: &[Direction],
    column: &'static str,
    values: &[f64],
    of: fn(&Direction) -> f64,
) -> Result<(), Fault> {
    let lines_of = |value: &f64| told.iter().filter(|d| of(d) == *value).map(|d| d.line).collect::<Vec<_>>();
    let rule = PatternRule::TooFew { column, found: values.len() };
    let ends = match values {
        [] => return Err((0, rule)),
        [one, other] => [lines_of(one), lines_of(other)],
        _ => return Ok(()),
    };
    let first = |lines: &Vec<u32>| lines.iter().min().copied().unwrap_or_default();
    let fewest = ends.iter().map(|lines| (lines.len(), std::cmp::Reverse(first(lines)))).min();
    Err((fewest.map_or(0, |(_, line)| line.0), rule))
}

/// Directions sorted by elevation, each once.
fn distinct(directions: &[Direction]) -> Result<Vec<Direction>, Fault> {
    let mut sorted = directions.to_vec();
    sorted.sort_by(|a, b| {
        let by_elevation = a.elevation_deg.total_cmp(&b.elevation_deg);
        by_elevation.then(a.azimuth_deg.total_cmp(&b.azimuth_deg)).then(a.line.cmp(&b.line))
    });
    let is_same =
        |a: &Direction, b: &Direction| [a.elevation_deg, a.azimuth_deg] == [b.elevation_deg, b.azimuth_deg];
    let twice =
        sorted.windows(2).find(|pair| is_same(&pair[0], &pair[1]) && pair[0].gain_db != pair[1].gain_db);
    if let Some([first, second]) = twice {
        let Direction { line, azimuth_deg, elevation_deg, .. } = *second;
        return Err((line, PatternRule::ToldTwice { azimuth_deg, elevation_deg, first_line: first.line }));
    }
    sorted.dedup_by(|next, kept| is_same(next, kept));
    Ok(sorted)
}

fn row_by_row(sorted: &[Direction]) -> Vec<f64> {
    sorted.iter().map(|direction| direction.gain_db).collect()
}

/// Gains beside the cuts: the sum of both less that at their crossing.
fn from_cuts(sorted: &[Direction]) -> Result<Vec<f64>, Fault> {
    if let Some(stray) = sorted.iter().find(|d| d.azimuth_deg != 0.0 && d.elevation_deg != 0.0) {
        return Err((stray.line, PatternRule::NeitherTableNorCuts));
    }
    let along_azimuth: Vec<&Direction> = sorted.iter().filter(|d| d.elevation_deg == 0.0).collect();
    let along_elevation = sorted.iter().filter(|d| d.azimuth_deg == 0.0);
    let crossing =
        along_azimuth.iter().find(|d| d.azimuth_deg == 0.0).ok_or((0, PatternRule::NoCrossing))?.gain_db;
    let row = |up: &Direction| {
        along_azimuth.iter().map(move |d| d.gain_db + up.gain_db - crossing).collect::<Vec<_>>()
    };
    Ok(along_elevation.flat_map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::radar::Pattern;

    fn read(text: &str) -> Result<PatternTable, String> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("p.csv");
        std::fs::write(&file, text).unwrap();
        read_pattern_table(&file).map_err(|error| {
            let text = error.to_string();
            text[text.find("p.csv").unwrap()..].to_owned()
        })
    }

    /// The gain at the given directions of cos², whose cuts are cos² and which is their product.
    fn lines(directions: impl Iterator<Item = [i32; 2]>) -> String {
        let gain_db = |[az, el]: [i32; 2]| {
            40.0 * (f64::from(az).to_radians().cos() * f64::from(el).to_radians().cos()).max(1e-5).log10()
        };
        let line = |d: [i32; 2]| format!("{}, {}, {}\n", d[0], d[1], gain_db(d));
        directions.fold("# a horn\naz_deg, el_deg, gain_db\n".to_owned(), |text, d| text + &line(d))
    }

    #[test]
    fn cuts_and_a_whole_table_of_the_cosine_are_the_same_pattern() {
        let steps = || (-90..=90).step_by(5);
        let whole = read(&lines(steps().flat_map(|az| steps().map(move |el| [az, el])))).unwrap();
        let cuts = read(&lines(steps().map(|az| [az, 0]).chain(steps().map(|el| [0, el])))).unwrap();
        assert_eq!(whole.azimuth_rad, cuts.azimuth_rad);
        assert_eq!((cuts.azimuth_rad.len(), cuts.elevation_rad.len()), (37, 37));
        // The gains are told in f64 decimals; beyond cos = 1e-5 the test's own floor of −200 dB is all that
        // differs.
        let missed =
            whole.amplitude.iter().zip(&cuts.amplitude).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(missed < 1e-9, "{missed:e}");
        let ahead = Pattern::Table(cuts).amplitude([0.0, 1.0, 0.0]);
        assert!((ahead - 1.0).abs() < 1e-14, "{ahead}");
    }

    /// Nothing is told of line 0, which no file has.
    #[test]
    fn a_file_that_cannot_be_read_is_named_without_a_line() {
        let folder = tempfile::tempdir().unwrap();
        let told = read_pattern_table(&folder.path().join("none.csv")).unwrap_err().to_string();
        assert!(told.contains("none.csv: ") && !told.contains(":0:"), "{told}");
    }

    #[test]
    fn a_broken_file_is_refused_with_its_line_and_the_rule() {
        const HEADING: &str = "az_deg,el_deg,gain_db\n";
        let cases = [
            ("", "p.csv:1: the first line must be `az_deg,el_deg,gain_db`"),
            ("az_deg,gain_db\n0,1\n", "p.csv:1: the first line must be"),
            ("0,0,0\n", "p.csv:1: the first line must be"),
            (&format!("{HEADING}0,0\n"), "p.csv:2: must be three numbers az_deg,el_deg,gain_db, is `0,0`"),
            (&format!("{HEADING}\n0,0,x\n"), "p.csv:3: must be three numbers"),
            (&format!("{HEADING}181,0,0\n"), "p.csv:2: az_deg must lie within ±180, is 181"),
            (&format!("{HEADING}0,0,NaN\n"), "p.csv:2: gain_db must lie within ±200, is NaN"),
            (
                &format!("{HEADING}0,0,0\n1,0,0\n0,-0,1\n"),
                "p.csv:4: direction 0, 0 has another gain in line 2",
            ),
            (&format!("{HEADING}0,0,0\n1,0,0\n"), "p.csv:3: az_deg takes 2 values; one or at least three"),
            (&format!("{HEADING}0,-9,0\n7,0,0\n0,0,0\n0,9,0\n"), "p.csv:3: az_deg takes 2 values"),
            (&format!("{HEADING}-9,0,0\n0,0,0\n9,0,0\n0,4,0\n"), "p.csv:5: el_deg takes 2 values"),
            (HEADING, "p.csv: az_deg takes 0 values"),
            (&format!("{HEADING}-9,0,0\n0,0,0\n9,0,0\n0,-9,0\n0,9,0\n5,5,0\n"), "p.csv:7: not every pair"),
            (&format!("{HEADING}-9,0,0\n3,0,0\n9,0,0\n0,-9,0\n0,9,0\n0,8,0\n"), "p.csv: the cuts"),
        ];
        for (text, expected) in cases {
            let got = read(text).unwrap_err();
            assert!(got.starts_with(expected), "{text:?}: {got}");
        }
    }
}
