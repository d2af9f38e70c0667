//! S of a mesh over frequency and aspect, in memory, with the description that lies beside its file.

pub mod words; // of settings
mod requested; // body, axes and settings
mod figures; // S and the figures beside it
mod description; // content of `S.json`
mod described; // S with its description, and both as files

use crate::remarks;
use crate::stepwise::meshes;
use artifact::scene::Mesh;
use bart_rcs::{BartError, CancellationCheck, NoCheckpoint, RcsContext};
use pipeline::host::cancellation::Cancellation;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::processor_time::WorkClock;
use pipeline::host::progress::{self, Work};
use std::time::Instant;

pub(crate) use described::write_values;
pub use described::{DescribedTable, TableDescription};
pub(crate) use description::{TableTimings, describe};
pub(crate) use figures::RcsTable;
pub use requested::{DENSITY_PER_WAVELENGTH, RequestedReceiver, RequestedTable};

/// Makes the table of a mesh by BART, as the command `rcs` does.
///
/// # Errors
/// A request out of range, a mesh or materials that cannot be read, a mesh that cannot be traced, memory that
/// does not suffice; cancelled between two aspects.
pub fn rcs(
    requested: &RequestedTable,
    memory: Allowance,
    cancellation: &Cancellation,
) -> Result<DescribedTable, Failure> {
    let (start, clock) = (Instant::now(), WorkClock::start());
    let mesh = body(requested)?;
    let load = clock.seconds();
    let table = traced(&mesh, requested, (memory, &clock), cancellation);
    let table = table.map_err(|failure| failure.about(&requested.mesh))?;
    let json = describe(requested, &mesh, &table, &TableTimings::since(start, &clock, load));
    Ok(DescribedTable { description: TableDescription::of(json)?, amplitude_m: table.amplitude_m })
}

/// The mesh with the materials that were asked for and those of its asset.
fn body(requested: &RequestedTable) -> Result<Mesh, Failure> {
    let mesh = meshes::mesh(&requested.mesh, requested.unit_scale)?;
    let map =
        meshes::materials(requested.materials.as_deref(), requested.transmission, &requested.frequency_hz)?;
    meshes::dressed(mesh, &requested.mesh, &map, &requested.frequency_hz)
}

fn traced(
    mesh: &Mesh,
    requested: &RequestedTable,
    (memory, clock): (Allowance, &WorkClock),
    cancellation: &Cancellation,
) -> Result<RcsTable, Failure> {
    check_size(requested.shape())?;
    let request = requested.request();
    remarks::forward_scattering::remark(&request, mesh).into_iter().for_each(progress::note);
    let work = Work::begin("aspects");
    let is_cancelled = || cancellation.check().is_err();
    let surroundings = RcsContext {
        memory_limit: memory.limit(),
        checkpoint: &NoCheckpoint,
        progress: &work,
        clock_s: &|| clock.seconds(),
        cancellation: CancellationCheck::by(&is_cancelled),
    };
    bart_rcs::rcs_within(mesh, &request, &surroundings).map(RcsTable::of_bart).map_err(of_bart)
}

fn of_bart(error: BartError) -> Failure {
    match error {
        BartError::Cancelled => Failure::Cancelled,
        refused => Failure::refused(refused),
    }
}

/// Values of a table: 16 bytes each, a gibibyte and what measuring its errors takes beside.
const TABLE_LIMIT: usize = 1 << 26;

/// Refuses a table with too many values.
///
/// # Errors
/// The requested numbers of values.
pub(crate) fn check_size([frequencies, elevations, azimuths]: [usize; 3]) -> Result<(), Failure> {
    let values = frequencies.saturating_mul(elevations).saturating_mul(azimuths);
    match values > TABLE_LIMIT {
        true => Err(Failure::System(format!(
            "{frequencies} frequencies × {elevations} elevations × {azimuths} azimuths are {values} values; \
             a table has at most {TABLE_LIMIT}: make several"
        ))),
        false => Ok(()),
    }
}
