//! A table of S with its description, and both as files: `S.npy` and `S.json`.

use crate::stepwise::extensions;
use crate::stepwise::meshes::far_field_from_m;
use formats::npy_stream::NpyStream;
use formats::sidecar;
use num_complex::Complex64;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::outcome::error_figures::{ErrorFigures, ModelErrorFigures};
use serde_json::{Value, from_value};
use std::path::Path;

/// S in metres with its description.
pub struct DescribedTable {
    /// Scattering amplitude S, row-major `[frequency, elevation, azimuth]`, phase at the body's origin.
    pub amplitude_m: Vec<Complex64>,
    /// Axes, range and errors of S.
    pub description: TableDescription,
}

/// Content of `S.json`, of which the axes, the range and the errors are read.
pub struct TableDescription {
    /// Axis 0, Hz.
    pub frequency_hz: Vec<f64>,
    /// Axis 1: elevations of the antenna above the horizon, degrees.
    pub elevation_deg: Vec<f64>,
    /// Axis 2: azimuths of the antenna, degrees.
    pub azimuth_deg: Vec<f64>,
    /// Distance from the antenna to the mesh's origin, m; infinite for the far field.
    pub range_m: f64,
    /// Range from which on a table of infinite range holds, 2D²/λ, m.
    pub far_field_from_m: f64,
    /// Numerical errors, dB relative to the table.
    pub error: ErrorFigures,
    /// Errors of the physical model, dB relative to the table.
    pub model_error: ModelErrorFigures,
    json: Value,
}

impl TableDescription {
    /// Reads a description.
    ///
    /// # Errors
    /// The first key that is missing or holds something else.
    pub(super) fn of(json: Value) -> Result<Self, Failure> {
        let frequency_hz = numbers(&json, "/axes/freq_hz")?;
        let size_m = part(&json, "/mesh/size_m", from_value::<[f64; 3]>)?;
        Ok(Self {
            elevation_deg: numbers(&json, "/axes/el_deg")?,
            azimuth_deg: numbers(&json, "/axes/az_deg")?,
            range_m: part(&json, "/settings/range_m", finite_or_not)?,
            far_field_from_m: far_field_from_m(size_m, &frequency_hz),
            error: part(&json, "/error_db", from_value)?,
            model_error: part(&json, "/model_error_db", from_value)?,
            frequency_hz,
            json,
        })
    }

    /// Reads the description beside a table, `S.json` of `S.npy`.
    ///
    /// # Errors
    /// The file is missing, no JSON, or lacks what a table has.
    pub fn read(table: &Path) -> Result<Self, Failure> {
        let place = sidecar::of_table(table);
        std::fs::metadata(&place).map_err(|error| Failure::system(&place, "read", error))?;
        let json = sidecar::read(&place).ok_or_else(|| Failure::refused("it is no JSON").about(&place))?;
        Self::of(json).map_err(|failure| failure.about(&place))
    }

    /// Number of frequencies, elevations and azimuths.
    pub fn shape(&self) -> [usize; 3] {
        [self.frequency_hz.len(), self.elevation_deg.len(), self.azimuth_deg.len()]
    }

    /// Writes S of this description to `table` and the description beside it, as the command `rcs` does.
    ///
    /// # Errors
    /// The file has the ending of another format; a file beside it that is no table's; an error of the
    /// system.
    pub fn write(&self, table: &Path, amplitude_m: &[Complex64]) -> Result<(), Failure> {
        extensions::check(table, "npy")?;
        sidecar::claim_table(table)?;
        let written = write_values(table, self.shape(), amplitude_m)
            .and_then(|()| sidecar::write_of_table(table, &self.json));
        files::release(&[table.to_owned(), sidecar::of_table(table)]);
        written
    }
}

/// Writes S as NumPy's array `[frequency, elevation, azimuth]`; its earlier description is removed before.
///
/// # Errors
/// The description beside it is no table's; an error of the system.
pub(crate) fn write_values(file: &Path, shape: [usize; 3], amplitude_m: &[Complex64]) -> Result<(), Failure> {
    NpyStream::write::<Complex64>(file, &shape, |stream| {
        stream.append(amplitude_m)?;
        sidecar::remove_outdated_table(file)
    })
}

/// Value at a place of a description, `/axes/freq_hz`.
fn part<T>(
    json: &Value,
    place: &str,
    read: impl FnOnce(Value) -> serde_json::Result<T>,
) -> Result<T, Failure> {
    let told = json.pointer(place).cloned().unwrap_or(Value::Null);
    let key = place.trim_start_matches('/').replace('/', ".");
    read(told).map_err(|error| Failure::refused(format!("`{key}` of a table: {error}")))
}

fn numbers(json: &Value, place: &str) -> Result<Vec<f64>, Failure> {
    part(json, place, from_value)
}

/// A distance in m; JSON has no infinite number, but the word "inf".
fn finite_or_not(told: Value) -> serde_json::Result<f64> {
    if told == "inf" { Ok(f64::INFINITY) } else { from_value(told) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn told() -> Value {
        json!({
            "axes": { "freq_hz": [76e9, 77e9], "el_deg": [5.0], "az_deg": [0.0, 0.1, 0.2] },
            "settings": { "range_m": "inf" }, "mesh": { "size_m": [4.0, 2.0, 1.0] },
            "error_db": ErrorFigures { total: Some(-40.5), ..ErrorFigures::default() },
            "model_error_db": ModelErrorFigures { nodes: Some(-20.0), ..ModelErrorFigures::default() },
        })
    }

    #[test]
    fn a_table_is_read_back_as_it_was_written_and_may_be_written_again() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("S.npy");
        let description = TableDescription::of(told()).unwrap();
        let values = vec![Complex64::new(1.0, -2.0); 6];
        for _ in 0..2 {
            description.write(&file, &values).unwrap();
        }
        let read = TableDescription::read(&file).unwrap();
        assert_eq!((read.shape(), read.range_m, read.json), ([2, 1, 3], f64::INFINITY, told()));
        assert_eq!((read.error.total, read.model_error.nodes), (Some(-40.5), Some(-20.0)));
        // 2D²/λ, D² = 21 m².
        assert_eq!(read.far_field_from_m, 42.0 * 77e9 / artifact::units::SPEED_OF_LIGHT_MPS);
    }

    #[test]
    fn a_description_that_lacks_something_is_refused_with_file_and_key() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("S.npy");
        let told_of = |text: &str| {
            std::fs::write(folder.path().join("S.json"), text).unwrap();
            TableDescription::read(&file).err().unwrap().to_string()
        };
        let missing = TableDescription::read(&file).err().unwrap();
        assert!(matches!(missing, Failure::System(_)), "{missing}");
        assert!(told_of("{").ends_with("S.json: it is no JSON"));
        let lacking = told_of(r#"{"axes": {"freq_hz": [1e9]}}"#);
        assert!(lacking.contains("S.json: `mesh.size_m` of a table: "), "{lacking}");
    }

    #[test]
    fn a_file_of_others_beside_a_table_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("S.json"), "[1]").unwrap();
        let description = TableDescription::of(told()).unwrap();
        let refused = description.write(&folder.path().join("S.npy"), &[Complex64::ONE; 6]).unwrap_err();
        assert!(refused.to_string().contains("does not belong to S.npy"), "{refused}");
        assert!(!folder.path().join("S.npy").exists());
    }
}
