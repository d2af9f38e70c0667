//! A table of electromagnetic properties (`_emp.xompt`): permittivity and permeability over wavelength,
//! temperature and humidity, evaluated at one frequency.

use crate::openmaterial::error::{OpenMaterialError, OpenMaterialFault};
use crate::openmaterial::file_reader::FileReader;
use crate::openmaterial::node::Node;
use crate::wording::allowed_range::AllowedRange::{self, Above, Between};
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::Complex64;
use std::path::Path;

/// Preferred temperature: the nearest to 20 °C is used, as in the project's own table of substances.
const TEMPERATURE_K: f64 = 293.15;
/// Preferred humidity: the nearest to a half is used.
const HUMIDITY_PERCENT: f64 = 50.0;

/// Distance beyond the ends of a table, in parts of the frequency, up to which its last value holds: with a
/// relaxation, the steepest dispersion of a dielectric, ε″ changes by no more than the frequency, and
/// literature's values are known to ±10 %.
const BEYOND: f64 = 0.1;

/// Difference of the permeability from 1 above which a substance counts as magnetic.
const MAGNETIC: f64 = 0.01;

/// Conductivity from which on a substance counts as a conductor: it absorbs 0.03 dB at normal incidence.
const METAL_S_PER_M: f64 = 1e6;

const VACUUM_F_PER_M: f64 = 8.854_187_812_8e-12;

/// Ranges of a row's values, as in the standard except for the wavelength, which it ends at 17 mm.
const WAVELENGTHS_M: AllowedRange = Between(1e-9, 1e5);
const TEMPERATURES_K: AllowedRange = Between(0.0, 1e5);
const HUMIDITIES_PERCENT: AllowedRange = Between(0.0, 100.0);
const ANY: AllowedRange = Between(-1e30, 1e30);
const LOSSES: AllowedRange = Between(0.0, 1e30);

/// Ranges of a dielectric, as for `permittivity` in a scene.
const DIELECTRIC: AllowedRange = Between(1.0, 1e6);

/// A row with a permittivity.
#[derive(Clone, Copy)]
struct Row {
    /// Frequency; `None` if the row holds for all.
    frequency_hz: Option<f64>,
    /// Differences from the requested conditions.
    off: [f64; 2],
    permeability: Complex64,
    permittivity: Complex64,
}

/// Reads the permittivity ε′ − jε″ of a table at a frequency; `None` is a conductor.
pub(super) fn read(
    file: &Path,
    frequency_hz: f64,
    reader: &mut FileReader,
) -> Result<Option<Complex64>, OpenMaterialError> {
    let value = reader.read(file)?;
    let table = Node::root(file, &value).need("electromagneticProperties")?;
    let mut rows = vec![];
    for row in table.list()? {
        rows.extend(read_row(&row)?);
    }
    if rows.is_empty() {
        return Err(table.error(OpenMaterialFault::NoPermittivity));
    }
    let curve = curve(rows).map_err(|fault| table.error(fault))?;
    at(&curve, frequency_hz).and_then(|row| radio(&row, frequency_hz)).map_err(|fault| table.error(fault))
}

/// Reads a row; `None` if it has no permittivity.
fn read_row(row: &Node<'_>) -> Result<Option<Row>, OpenMaterialError> {
    let cells =
        row.tuple::<7>("a list of seven numbers: wavelength, temperature, humidity, μ′, μ″, ε′, ε″")?;
    let [wavelength, temperature, humidity, mu, mu_loss, epsilon, epsilon_loss] = cells;
    let wavelength_m = within(&wavelength, "the wavelength in m", WAVELENGTHS_M)?;
    let temperature_k = within(&temperature, "the temperature in K", TEMPERATURES_K)?;
    let humidity_percent = within(&humidity, "the humidity in %", HUMIDITIES_PERCENT)?;
    let mu = within(&mu, "μ′", ANY)?.unwrap_or(1.0);
    let mu_loss = within(&mu_loss, "μ″ of μ′ − jμ″", LOSSES)?.unwrap_or(0.0);
    let epsilon = within(&epsilon, "ε′", ANY)?;
    let epsilon_loss = within(&epsilon_loss, "ε″ of ε′ − jε″", LOSSES)?;
    let off = |found: Option<f64>, asked: f64| found.map_or(0.0, |found| (found - asked).abs());
    Ok(epsilon.zip(epsilon_loss).map(|(real, loss)| Row {
        frequency_hz: wavelength_m.map(|wavelength_m| SPEED_OF_LIGHT_MPS / wavelength_m),
        off: [off(temperature_k, TEMPERATURE_K), off(humidity_percent, HUMIDITY_PERCENT)],
        permeability: Complex64::new(mu, -mu_loss),
        permittivity: Complex64::new(real, -loss),
    }))
}

fn within(
    cell: &Node<'_>,
    what: &'static str,
    allowed: AllowedRange,
) -> Result<Option<f64>, OpenMaterialError> {
    match cell.number_or_null()? {
        Some(found) if !allowed.holds(found) => {
            Err(cell.error(OpenMaterialFault::OutOfRange { what, found, allowed }))
        }
        number => Ok(number),
    }
}

/// The rows nearest to the requested conditions, one per frequency, ascending; the first of equally near
/// rows. A single row without a frequency represents all.
fn curve(mut rows: Vec<Row>) -> Result<Vec<Row>, OpenMaterialFault> {
    let without = rows.iter().filter(|row| row.frequency_hz.is_none()).count();
    if without != 0 && without != rows.len() {
        return Err(OpenMaterialFault::MixedWavelengths);
    }
    let frequency_hz = |row: &Row| row.frequency_hz.unwrap_or(0.0);
    rows.sort_by(|a, b| {
        let [[warm_a, wet_a], [warm_b, wet_b]] = [a.off, b.off];
        frequency_hz(a)
            .total_cmp(&frequency_hz(b))
            .then(warm_a.total_cmp(&warm_b))
            .then(wet_a.total_cmp(&wet_b))
    });
    rows.dedup_by(|next, first| frequency_hz(next) == frequency_hz(first));
    Ok(rows)
}

/// The curve at a frequency: interpolated linearly over frequency, and constant a little beyond the ends.
fn at(curve: &[Row], frequency_hz: f64) -> Result<Row, OpenMaterialFault> {
    let known = |row: &Row| row.frequency_hz.unwrap_or(frequency_hz);
    let above = curve.partition_point(|row| known(row) < frequency_hz);
    match (above.checked_sub(1).and_then(|below| curve.get(below)), curve.get(above)) {
        (Some(low), Some(high)) => Ok(between(low, high, frequency_hz)),
        (Some(end), None) | (None, Some(end)) if is_near(known(end), frequency_hz) => Ok(*end),
        _ => {
            let ends = [curve.first(), curve.last()].map(|row| row.map_or(0.0, known));
            let [low_hz, high_hz] = ends;
            let (asked_hz, percent) = (frequency_hz, 100.0 * BEYOND);
            Err(OpenMaterialFault::OtherFrequencies { low_hz, high_hz, asked_hz, percent })
        }
    }
}

fn is_near(end_hz: f64, frequency_hz: f64) -> bool {
    (end_hz - frequency_hz).abs() <= BEYOND * frequency_hz
}

fn between(low: &Row, high: &Row, frequency_hz: f64) -> Row {
    let [from_hz, to_hz] = [low, high].map(|row| row.frequency_hz.unwrap_or(frequency_hz));
    let share = if to_hz > from_hz { (frequency_hz - from_hz) / (to_hz - from_hz) } else { 1.0 };
    let mixed = |low: Complex64, high: Complex64| low * (1.0 - share) + high * share;
    Row {
        permeability: mixed(low.permeability, high.permeability),
        permittivity: mixed(low.permittivity, high.permittivity),
        ..*high
    }
}

/// Radio properties of a row: a conductor by its conductivity σ = 2πf·ε₀·ε″, else a dielectric.
fn radio(row: &Row, frequency_hz: f64) -> Result<Option<Complex64>, OpenMaterialFault> {
    let Row { permeability, permittivity, .. } = *row;
    let loss = -permittivity.im;
    let conductivity_s_per_m = std::f64::consts::TAU * frequency_hz * VACUUM_F_PER_M * loss;
    if conductivity_s_per_m >= METAL_S_PER_M {
        return Ok(None);
    }
    if (permeability - 1.0).norm() > MAGNETIC {
        return Err(OpenMaterialFault::Magnetic([permeability.re, -permeability.im]));
    }
    let found = permittivity.re;
    match (DIELECTRIC.holds(found), DIELECTRIC.holds(loss.max(1.0))) {
        (false, _) => Err(OpenMaterialFault::OutOfRange { what: "ε′ there", found, allowed: DIELECTRIC }),
        (_, false) => {
            Err(OpenMaterialFault::OutOfRange { what: "ε″ there", found: loss, allowed: Above(0.0, 1e6) })
        }
        (true, true) => Ok(Some(permittivity)),
    }
}
