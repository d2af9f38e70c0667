//! S of a mesh over frequency and aspect, in memory, with the description that lies beside its file.

pub mod words; // of settings
mod asked; // body, axes and settings
mod figures; // S and the figures beside it
mod description; // content of `S.json`
mod described; // S with its description, and both as files

use crate::remarks;
use crate::stepwise::meshes;
use artifact::scene::Mesh;
use bart_rcs::{BartError, CalledOff, NothingKept, Surroundings};
use pipeline::host::call_off::CallOff;
use pipeline::host::failure::Failure;
use pipeline::host::memory::Allowance;
use pipeline::host::processor_time::WorkClock;
use pipeline::host::progress::{self, Work};
use std::time::Instant;

pub use asked::{AskedReceiver, AskedTable, DENSITY_PER_WAVELENGTH};
pub(crate) use described::write_values;
pub use described::{DescribedTable, TableDescription};
pub(crate) use description::{TableTook, describe};
pub(crate) use figures::RcsTable;

/// Makes the table of a mesh by BART, as the command `rcs` does.
///
/// # Errors
/// A request out of range, a mesh or materials that cannot be read, a mesh that cannot be traced, memory that
/// does not suffice; called off between two aspects.
pub fn rcs(asked: &AskedTable, memory: Allowance, call_off: &CallOff) -> Result<DescribedTable, Failure> {
    let (start, clock) = (Instant::now(), WorkClock::start());
    let mesh = body(asked)?;
    let load = clock.seconds();
    let table = traced(&mesh, asked, (memory, &clock), call_off);
    let table = table.map_err(|failure| failure.about(&asked.mesh))?;
    let json = describe(asked, &mesh, &table, &TableTook::since(start, &clock, load));
    Ok(DescribedTable { description: TableDescription::of(json)?, amplitude_m: table.amplitude_m })
}

/// The mesh with the materials that were asked for and those of its asset.
fn body(asked: &AskedTable) -> Result<Mesh, Failure> {
    let mesh = meshes::mesh(&asked.mesh, asked.unit_scale)?;
    let map = meshes::materials(asked.materials.as_deref(), asked.transmission, &asked.frequency_hz)?;
    meshes::dressed(mesh, &asked.mesh, &map, &asked.frequency_hz)
}

fn traced(
    mesh: &Mesh,
    asked: &AskedTable,
    (memory, clock): (Allowance, &WorkClock),
    call_off: &CallOff,
) -> Result<RcsTable, Failure> {
    check_size(asked.shape())?;
    let request = asked.request();
    remarks::forward_scattering::remark(&request).into_iter().for_each(progress::note);
    let work = Work::begin("aspects");
    let is_called_off = || call_off.check().is_err();
    let surroundings = Surroundings {
        memory_limit: memory.limit(),
        keeper: &NothingKept,
        progress: &work,
        clock_s: &|| clock.seconds(),
        called_off: CalledOff::by(&is_called_off),
    };
    bart_rcs::rcs_within(mesh, &request, &surroundings).map(RcsTable::of_bart).map_err(of_bart)
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
