//! S of a mesh over frequency and aspect, in memory.

use crate::remarks;
use crate::stepwise::meshes::far_field_from_m;
use artifact::scene::Mesh;
use artifact::{ErrorBudget, ModelError};
use bart_rcs::{BartError, CalledOff, NothingKept, RcsRequest, Surroundings};
use num_complex::Complex64;
use pipeline::host::call_off::CallOff;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::processor_time::WorkClock;
use pipeline::host::progress::{self, Work};

/// S in metres with its errors.
pub struct RcsTable {
    /// Number of frequencies, elevations and azimuths.
    pub shape: [usize; 3],
    /// Scattering amplitude S, row-major `[frequency, elevation, azimuth]`, phase at the body's origin.
    pub amplitude_m: Vec<Complex64>,
    /// Numerical error over the table.
    pub error: ErrorBudget,
    /// Errors of the physical model.
    pub model_error: ModelError,
    /// Range from which on a table of infinite range holds, 2D²/λ.
    pub far_field_from_m: f64,
}

/// Makes the table of a mesh by BART, as the command `rcs` does.
///
/// # Errors
/// A request out of range, a mesh that cannot be traced, memory that does not suffice; called off between two
/// aspects.
pub fn rcs(
    mesh: &Mesh,
    request: &RcsRequest,
    memory: Allowance,
    call_off: &CallOff,
) -> Result<RcsTable, Failure> {
    let shape = [request.frequency_hz.len(), request.elevation_rad.len(), request.azimuth_rad.len()];
    check_size(shape)?;
    remarks::forward_scattering::remark(request).into_iter().for_each(progress::note);
    let (work, clock) = (Work::begin("aspects"), WorkClock::start());
    let is_called_off = || call_off.check().is_err();
    let surroundings = Surroundings {
        memory_limit: memory.limit(),
        keeper: &NothingKept,
        progress: &work,
        clock_s: &|| clock.seconds(),
        called_off: CalledOff::by(&is_called_off),
    };
    let result = bart_rcs::rcs_within(mesh, request, &surroundings).map_err(of_bart)?;
    Ok(RcsTable {
        shape,
        amplitude_m: result.amplitude_m,
        error: result.error,
        model_error: result.model_error,
        far_field_from_m: far_field_from_m(mesh, &request.frequency_hz),
    })
}

fn of_bart(error: BartError) -> Failure {
    match error {
        BartError::CalledOff => Failure::CalledOff,
        refused => Failure::refused(refused),
    }
}

/// Values of a table: 16 bytes each, a gibibyte and what measuring its errors takes beside.
const TABLE_LIMIT: usize = 1 << 26;

/// Refuses a table with too many values.
///
/// # Errors
/// The requested numbers of values.
pub fn check_size([frequencies, elevations, azimuths]: [usize; 3]) -> Result<(), Failure> {
    let values = frequencies.saturating_mul(elevations).saturating_mul(azimuths);
    match values > TABLE_LIMIT {
        true => Err(Failure::System(format!(
            "{frequencies} frequencies × {elevations} elevations × {azimuths} azimuths are {values} values; \
             a table has at most {TABLE_LIMIT}: make several"
        ))),
        false => Ok(()),
    }
}
