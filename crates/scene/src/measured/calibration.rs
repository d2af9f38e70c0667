//! `calibration` of `[dsp]`: the measured errors of a radar's channels.
//!
//! ```text
//! tx,rx,gain_db,phase_deg     the first line
//! 0,0,1.25,-14.2              one transmit–receive pair a line, counted from 0, in any order; # comments
//! ```

use crate::measured::table_text;
use artifact::bounded::{self, ReadFault};
use artifact::units::amplitude_from_db;
use num_complex::Complex64;
use std::path::{Path, PathBuf};

/// Factors that correct the errors in a file, tx·N_rx + rx, of mean power 1: noise keeps its level.
///
/// # Errors
/// The first rule that the file breaks, with its line.
pub(crate) fn read_calibration(
    file: &Path,
    [transmitters, receivers]: [usize; 2],
) -> Result<Vec<Complex64>, CalibrationFileError> {
    let at = |line, rule| CalibrationFileError { file: file.to_owned(), line, rule };
    let text = bounded::read_text(file, LIMIT_BYTES).map_err(|error| at(0, CalibrationRule::File(error)))?;
    let mut lines = table_text::lines(&text);
    let heading = lines.next().filter(|(_, heading)| heading.split(',').map(str::trim).eq(COLUMNS));
    let (_, _) = heading.ok_or_else(|| at(1, CalibrationRule::NoHeading))?;
    let mut factors = vec![None; transmitters * receivers];
    for (number, line) in lines {
        let (pair @ [tx, rx], error) = pair_and_error(line).map_err(|rule| at(number, rule))?;
        if tx >= transmitters || rx >= receivers {
            return Err(at(number, CalibrationRule::NoSuchPair { tx, rx, transmitters, receivers }));
        }
        if factors[tx * receivers + rx].replace(1.0 / error).is_some() {
            return Err(at(number, CalibrationRule::ToldTwice { tx: pair[0], rx: pair[1] }));
        }
    }
    let missing = |i: usize| at(0, CalibrationRule::Missing { tx: i / receivers, rx: i % receivers });
    let told = factors.into_iter().enumerate().map(|(i, factor)| factor.ok_or_else(|| missing(i)));
    let factors: Vec<Complex64> = told.collect::<Result<_, _>>()?;
    let power = factors.iter().map(|factor| factor.norm_sqr()).sum::<f64>() / factors.len().max(1) as f64;
    Ok(factors.into_iter().map(|factor| factor / power.sqrt()).collect())
}

/// Reason why a calibration file is refused.
#[derive(Debug, thiserror::Error)]
#[error("{}: {rule}", table_text::place(file, *line))]
pub struct CalibrationFileError {
    /// Path as the scene names it.
    pub file: PathBuf,
    /// Line of the file, from 1; 0 if no line is at fault.
    pub line: u32,
    /// Rule that the file breaks.
    pub rule: CalibrationRule,
}

impl CalibrationFileError {
    /// Whether the system failed, not the content of the file.
    pub fn is_system(&self) -> bool {
        matches!(&self.rule, CalibrationRule::File(error) if error.is_system())
    }
}

/// Broken rules of a calibration file.
#[derive(Debug, thiserror::Error)]
pub enum CalibrationRule {
    /// The file cannot be read, has more bytes than any table of an array, or is not text.
    #[error("{0}")]
    File(#[source] ReadFault),
    /// The first line is that of another table, or no heading.
    #[error("the first line must be `tx,rx,gain_db,phase_deg`")]
    NoHeading,
    /// A line is not two whole numbers and two numbers in their ranges.
    #[error(
        "must be tx,rx,gain_db,phase_deg: two counts from 0, a gain within ±60, a phase within ±360; is `{found}`"
    )]
    NotNumbers {
        /// Text of the line.
        found: String,
    },
    /// A pair of another array.
    #[error(
        "there is no pair {tx},{rx}: the array has {transmitters} transmit and {receivers} receive elements, counted from 0"
    )]
    NoSuchPair {
        /// Index of the pair's transmit element, from 0.
        tx: usize,
        /// Index of the pair's receive element, from 0.
        rx: usize,
        /// Number of transmit elements of the scene's array.
        transmitters: usize,
        /// Number of receive elements of the scene's array.
        receivers: usize,
    },
    /// A pair with two lines.
    #[error("the pair {tx},{rx} is told twice")]
    ToldTwice {
        /// Index of the pair's transmit element, from 0.
        tx: usize,
        /// Index of the pair's receive element, from 0.
        rx: usize,
    },
    /// A pair without a line.
    #[error("the pair {tx},{rx} is missing")]
    Missing {
        /// Index of the pair's transmit element, from 0.
        tx: usize,
        /// Index of the pair's receive element, from 0.
        rx: usize,
    },
}

/// Largest file in bytes: 256 × 256 pairs, a line of 256 bytes each.
const LIMIT_BYTES: u64 = 16 << 20;
const COLUMNS: [&str; 4] = ["tx", "rx", "gain_db", "phase_deg"];

fn pair_and_error(line: &str) -> Result<([usize; 2], Complex64), CalibrationRule> {
    let parts: Vec<&str> = line.split(',').map(str::trim).collect();
    let numbers = || -> Option<([usize; 2], [f64; 2])> {
        let [tx, rx, gain_db, phase_deg] = parts[..] else { return None };
        Some(([tx.parse().ok()?, rx.parse().ok()?], [gain_db.parse().ok()?, phase_deg.parse().ok()?]))
    };
    // NaN is in no range.
    let fits = |[gain_db, phase_deg]: [f64; 2]| gain_db.abs() <= 60.0 && phase_deg.abs() <= 360.0;
    match numbers() {
        Some((pair, error)) if fits(error) => {
            Ok((pair, Complex64::from_polar(amplitude_from_db(error[0]), error[1].to_radians())))
        }
        _ => Err(CalibrationRule::NotNumbers { found: line.chars().take(80).collect() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<Complex64>, String> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("c.csv");
        std::fs::write(&file, text).unwrap();
        read_calibration(&file, [2, 1]).map_err(|error| {
            let text = error.to_string();
            text[text.find("c.csv").unwrap()..].to_owned()
        })
    }

    #[test]
    fn factors_undo_what_the_file_tells_up_to_one_common_gain() {
        let factors =
            read("# measured\ntx,rx,gain_db,phase_deg\n1,0,-6.0206,-30\n0,0,0,90 # the first\n").unwrap();
        // Undone: ×1 turned by −90°, ×2 turned by 30°; over √((1 + 4)/2).
        let scale = 2.5_f64.sqrt();
        assert!((factors[0] * scale - Complex64::new(0.0, -1.0)).norm() < 1e-5);
        assert!((factors[1] * scale - Complex64::from_polar(2.0, 30_f64.to_radians())).norm() < 1e-5);
    }

    #[test]
    fn a_broken_calibration_is_refused_with_its_line_and_the_rule() {
        const HEADING: &str = "tx,rx,gain_db,phase_deg\n";
        for (text, expected) in [
            ("", "c.csv:1: the first line must be `tx,rx,gain_db,phase_deg`"),
            (&format!("{HEADING}0,0,1\n"), "c.csv:2: must be tx,rx,gain_db,phase_deg"),
            (&format!("{HEADING}0,0,nan,0\n"), "c.csv:2: must be tx,rx,gain_db,phase_deg"),
            (
                &format!("{HEADING}0,1,0,0\n"),
                "c.csv:2: there is no pair 0,1: the array has 2 transmit and 1 receive",
            ),
            (&format!("{HEADING}0,0,0,0\n0,0,0,0\n"), "c.csv:3: the pair 0,0 is told twice"),
            (&format!("{HEADING}0,0,0,0\n"), "c.csv: the pair 1,0 is missing"),
        ] {
            let got = read(text).unwrap_err();
            assert!(got.starts_with(expected), "{text:?}: {got}");
        }
    }
}
