//! nuScenes' radar clouds: Point Cloud Data 0.7, binary, eighteen fields, x ahead and y left of the sensor.

use crate::radar_cloud::cloud_error::CloudError;
use crate::radar_cloud::{DETECTION_LIMIT, Detection};
use glam::DVec3;

/// A row to write: a detection with further values of its dataset.
pub(crate) struct Row {
    pub(crate) seen: Detection,
    /// Number of the detection in its cloud.
    pub(crate) id: i16,
    /// Code of motion: 0 moves, 1 is at rest, 4 is not known.
    pub(crate) dynamics: i8,
    /// Code of ambiguity: 1 ambiguous, 3 unambiguous.
    pub(crate) ambiguity: i8,
}

const FIELDS: &str = "x y z dyn_prop id rcs vx vy vx_comp vy_comp is_quality_valid ambig_state x_rms y_rms \
                      invalid_state pdh0 vx_rms vy_rms";
const SIZES: &str = "4 4 4 1 2 4 4 4 4 4 1 1 1 1 1 1 1 1";
const TYPES: &str = "F F F I I F F F F F I I I I I I I I";

/// A file of a cloud. Without detections it has one row of NaN, as in the dataset's own files; a line break
/// follows the last row, as the dataset's reader requires.
pub(crate) fn to_bytes(rows: &[Row]) -> Vec<u8> {
    let count = rows.len().max(1);
    let ones = ["1"; 18].join(" ");
    let mut bytes = format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {FIELDS}\nSIZE {SIZES}\nTYPE {TYPES}\n\
         COUNT {ones}\nWIDTH {count}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA binary\n"
    )
    .into_bytes();
    rows.iter().for_each(|row| append(&mut bytes, row));
    if rows.is_empty() {
        append(&mut bytes, &Row { seen: NOTHING, id: 0, dynamics: 0, ambiguity: 0 });
    }
    bytes.push(b'\n');
    bytes
}

/// The detection in an empty cloud.
const NOTHING: Detection = Detection { place_m: DVec3::NAN, section_dbsm: f64::NAN, velocity_mps: f64::NAN };

/// Code for an unknown standard error of the dataset's sensor.
const ERROR_NOT_TOLD: i8 = 31;

fn append(bytes: &mut Vec<u8>, row: &Row) {
    let DVec3 { x, y, z } = row.seen.place_m;
    let [vx, vy] = [x, y].map(|along| row.seen.velocity_mps * along / x.hypot(y));
    let floats = |bytes: &mut Vec<u8>, values: &[f64]| {
        values.iter().for_each(|value| bytes.extend((*value as f32).to_le_bytes()));
    };
    floats(bytes, &[x, y, z]);
    bytes.extend(row.dynamics.to_le_bytes());
    bytes.extend(row.id.to_le_bytes());
    floats(bytes, &[row.seen.section_dbsm, vx, vy, vx, vy]);
    let codes = [1, row.ambiguity, ERROR_NOT_TOLD, ERROR_NOT_TOLD, 0, 0, ERROR_NOT_TOLD, ERROR_NOT_TOLD];
    codes.iter().for_each(|code: &i8| bytes.extend(code.to_le_bytes()));
}

/// Detections of a file with any further fields; rows whose place is NaN are skipped.
///
/// # Errors
/// A truncated head, missing fields, a number of rows other than in the head, and rows with invalid numbers.
pub(crate) fn of_bytes(bytes: &[u8]) -> Result<Vec<Detection>, CloudError> {
    let (head, rows) = head_and_rows(bytes)?;
    let layout = Layout::of(&head)?;
    let told = layout.points.checked_mul(layout.row_bytes).filter(|told| *told <= rows.len());
    if told.is_none() {
        return Err(CloudError::TooFewRows { points: layout.points, bytes: rows.len() });
    }
    if layout.points > DETECTION_LIMIT {
        return Err(CloudError::TooManyDetections { limit: DETECTION_LIMIT });
    }
    let rows = rows.chunks_exact(layout.row_bytes).take(layout.points).enumerate();
    rows.filter_map(|(number, row)| layout.detection(number, row)).collect()
}

/// Largest head, bytes.
const HEAD_BYTES: usize = 65_536;

/// Lines of the head, up to the one with the format of the rows, and the bytes after it.
fn head_and_rows(bytes: &[u8]) -> Result<(Vec<Vec<&str>>, &[u8]), CloudError> {
    let (mut lines, mut at) = (vec![], 0);
    while let Some(length) = bytes[at..].iter().take(HEAD_BYTES).position(|byte| *byte == b'\n') {
        let line = std::str::from_utf8(&bytes[at..at + length]).map_err(|_| CloudError::NoText)?;
        at += length + 1;
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_last = words.first() == Some(&"DATA");
        if !line.starts_with('#') {
            lines.push(words);
        }
        if is_last {
            return Ok((lines, &bytes[at..]));
        }
        if at > HEAD_BYTES {
            break;
        }
    }
    Err(CloudError::EndsInHead)
}

/// Position and type of a field in a row.
#[derive(Clone, Copy)]
struct Field {
    at: usize,
    kind: char,
    bytes: usize,
}

/// Positions of the fields that are read.
struct Layout {
    points: usize,
    row_bytes: usize,
    /// x, y, z, rcs, vx, vy.
    fields: [Field; 6],
}

impl Layout {
    fn of(head: &[Vec<&str>]) -> Result<Self, CloudError> {
        let words = |key: &'static str| {
            let line = head.iter().find(|words| words.first() == Some(&key));
            line.map(|words| &words[1..]).ok_or(CloudError::NoLine(key))
        };
        if words("DATA")? != ["binary"] {
            return Err(CloudError::NotBinary);
        }
        let (names, sizes, kinds) = (words("FIELDS")?, words("SIZE")?, words("TYPE")?);
        if sizes.len() != names.len()
            || kinds.len() != names.len()
            || words("COUNT")? != vec!["1"; names.len()]
        {
            return Err(CloudError::UnequalFields);
        }
        let points = words("POINTS")?.first().and_then(|count| count.parse().ok());
        let points = points.ok_or(CloudError::NoPointCount)?;
        let mut fields = Vec::with_capacity(names.len());
        let mut row_bytes = 0;
        for (kind, size) in kinds.iter().zip(sizes) {
            let field = field(row_bytes, kind, size)?;
            row_bytes += field.bytes;
            fields.push(field);
        }
        let place = |name: &str| names.iter().position(|known| *known == name).map(|at| fields[at]);
        let asked = ["x", "y", "z", "rcs", "vx", "vy"];
        let found = asked.map(|name| place(name).ok_or(CloudError::NoField(name)));
        let [x, y, z, rcs, vx, vy] = found;
        Ok(Self { points, row_bytes, fields: [x?, y?, z?, rcs?, vx?, vy?] })
    }

    /// The detection of a row; `None` if its place is NaN.
    fn detection(&self, number: usize, row: &[u8]) -> Option<Result<Detection, CloudError>> {
        let [x, y, z, section_dbsm, vx, vy] = self.fields.map(|field| field.value(row));
        if x.is_nan() || y.is_nan() {
            return None;
        }
        let velocity_mps = (vx * x + vy * y) / x.hypot(y);
        let seen = Detection { place_m: DVec3::new(x, y, z), section_dbsm, velocity_mps };
        let is_sound = seen.is_sound().then_some(seen);
        Some(is_sound.ok_or(CloudError::UnsoundPoint(number)))
    }
}

fn field(at: usize, kind: &str, size: &str) -> Result<Field, CloudError> {
    match (kind, size) {
        ("F", "4" | "8") | ("I" | "U", "1" | "2" | "4" | "8") => {
            let bytes = if size == "8" { 8 } else { usize::from(size.as_bytes()[0] - b'0') };
            Ok(Field { at, kind: char::from(kind.as_bytes()[0]), bytes })
        }
        _ => Err(CloudError::UnknownField { kind: kind.to_owned(), size: size.to_owned() }),
    }
}

impl Field {
    fn value(self, row: &[u8]) -> f64 {
        let mut wide = [0; 8];
        wide[..self.bytes].copy_from_slice(&row[self.at..self.at + self.bytes]);
        let unused_bits = 64 - 8 * self.bytes as u32;
        match (self.kind, self.bytes) {
            ('F', 4) => f64::from(f32::from_bits(u64::from_le_bytes(wide) as u32)),
            ('F', _) => f64::from_le_bytes(wide),
            ('I', _) => (i64::from_le_bytes(wide) << unused_bits >> unused_bits) as f64,
            _ => u64::from_le_bytes(wide) as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row() -> Row {
        let seen =
            Detection { place_m: DVec3::new(30.0, -40.0, 0.5), section_dbsm: 10.5, velocity_mps: -9.75 };
        Row { seen, id: 7, dynamics: 4, ambiguity: 3 }
    }

    #[test]
    fn clouds_come_back_as_they_went_and_an_empty_one_is_empty() {
        let bytes = to_bytes(&[row(), row()]);
        let found = of_bytes(&bytes).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].place_m, row().seen.place_m);
        // Parts of the velocity are rounded to 24 bits each.
        assert!((found[1].velocity_mps + 9.75).abs() < 4.0 * 9.75 * f64::from(f32::EPSILON));
        assert_eq!(bytes.len() - bytes.windows(7).position(|w| w == b"binary\n").unwrap() - 7, 2 * 43 + 1);
        assert_eq!(of_bytes(&to_bytes(&[])).unwrap(), []);
    }

    /// The file is as the set's description has it: fields in its order, other types where they fit.
    #[test]
    fn a_cloud_by_hand_is_read_by_the_names_of_its_fields() {
        let head = "# .PCD v0.7\nVERSION 0.7\nFIELDS vx vy x y z rcs id\nSIZE 8 4 4 4 2 1 4\nTYPE F F F F I I U\n\
                    COUNT 1 1 1 1 1 1 1\nWIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA binary\n";
        let mut bytes = head.as_bytes().to_vec();
        bytes.extend(3.0_f64.to_le_bytes());
        [0.0_f32, 10.0, 0.0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        bytes.extend((-2_i16).to_le_bytes());
        bytes.extend((-5_i8).to_le_bytes());
        bytes.extend(9_u32.to_le_bytes());
        let expected =
            Detection { place_m: DVec3::new(10.0, 0.0, -2.0), section_dbsm: -5.0, velocity_mps: 3.0 };
        assert_eq!(of_bytes(&bytes).unwrap(), [expected]);
    }

    #[test]
    fn heads_that_are_cut_off_or_tell_of_something_else_are_refused() {
        let whole = String::from_utf8_lossy(&to_bytes(&[row()])).into_owned();
        for (from, to, why) in [
            ("DATA binary", "DATA ascii", "not binary"),
            ("POINTS 1", "POINTS 2", "behind it"),
            ("POINTS 1", "POINTS 99999999999999999999", "no number"),
            ("POINTS 1", "POINTS 18446744073709551615", "behind it"),
            ("vx_rms", "", "same fields"),
            (" rcs ", " mass ", "no field rcs"),
            ("TYPE F", "TYPE Q", "not known"),
            ("COUNT 1", "COUNT 2", "same fields"),
            ("DATA", "DATE", "no line DATA"),
        ] {
            let found = of_bytes(whole.replace(from, to).as_bytes());
            assert!(found.as_ref().is_err_and(|e| e.to_string().contains(why)), "{from} -> {to}: {found:?}");
        }
        assert!(of_bytes(&vec![b'x'; 1 << 20]).is_err() && of_bytes(b"").is_err());
    }
}
