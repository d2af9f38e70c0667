//! `rcs`: scattering amplitude of a mesh over frequency, elevation and azimuth.

mod answer;
mod aspect_geometry;
mod sampling;
mod silhouette;
mod isar;
mod pictures;
mod references;
#[cfg(test)]
mod test_request;

use crate::program::cli::RcsArguments;
use crate::program::interrupt;
use crate::program::option_words::MethodWord;
use crate::program::terminal;
use crate::remarks;
use crate::stepwise::{self, RcsTable, RequestedReceiver, RequestedTable, TableTimings};
use artifact::envelope::fingerprint;
use artifact::scene::Mesh;
use artifact::settings::{Edges, NodeRule, SmallParts, Surface};
use bart_rcs::{CancellationCheck, RcsContext, RcsRequest};
use formats::sidecar;
use pipeline::chain::stages::Stage;
use pipeline::host::checkpoint::Checkpoint;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::memory::Allowance;
use pipeline::host::processor_time::WorkClock;
use pipeline::host::progress::{self, Work};
use sampling::Samplings;
use serde_json::Value;
use std::time::Instant;

pub(crate) fn run(arguments: &RcsArguments, memory: Allowance) -> Result<(), Failure> {
    let (start, clock) = (Instant::now(), WorkClock::start());
    std::iter::once(&arguments.mesh)
        .chain(&arguments.materials)
        .for_each(|file| artifact::inputs::register_path(file));
    check(arguments)?;
    let requested = requested_table(arguments);
    stepwise::check_size(requested.shape())?;
    let request = requested.request();
    let mesh = progress::during(format!("reading {}", arguments.mesh.display()), || {
        dressed(stepwise::mesh(&arguments.mesh, arguments.unit_scale)?, arguments, &request)
    })?;
    remark(&mesh, &request);
    claim(arguments)?;
    let load = clock.seconds();
    let checkpoint =
        progress::during("looking for an earlier run of this", || checkpoint(arguments, &mesh, &request));
    interrupt::declare_saved_as("aspects", checkpoint.watch());
    let table = match arguments.method {
        MethodWord::Bart => traced(&mesh, &request, &checkpoint, &clock, memory)?,
        MethodWord::Po | MethodWord::Sbr => {
            references::answer(arguments, &mesh, &request, &checkpoint, &clock)?
        }
    };
    stepwise::write_values(&arguments.out, requested.shape(), &table.amplitude_m)?;
    let table = RcsTable { cached: checkpoint.aspects(), ..table };
    let samplings = arguments.pictures.then(|| Samplings::of(&mesh, &request));
    let timings = TableTimings::since(start, &clock, load);
    let mut described = stepwise::describe(&requested, &mesh, &table, &timings);
    described["pictures"] = samplings.as_ref().map_or(Value::Null, Samplings::json);
    sidecar::write_of_table(&arguments.out, &described)?;
    checkpoint.finish();
    if let Some(samplings) = &samplings {
        let _under_way = Work::begin("pictures");
        pictures::write(&arguments.out, &mesh, &request, samplings, &table.amplitude_m)?;
        pictures::write_facets(&arguments.out, &mesh, &request, &table.amplitude_m)?;
    }
    let written = samplings.as_ref().map(|_| pictures::written(&request));
    pictures::remark_on_others(&arguments.out, &written.unwrap_or_default());
    answer::tell(&table, &requested, &mesh, &arguments.out);
    for warning in samplings.iter().flat_map(Samplings::warnings) {
        terminal::line(format!("pictures: {warning}"));
    }
    Ok(())
}

/// Refuses options that do not apply to the method; notes an accuracy that is requested from a reference.
fn check(arguments: &RcsArguments) -> Result<(), Failure> {
    let refused = |rule: &str| Err(Failure::System(format!("{}: {rule}", arguments.mesh.display())));
    match arguments.method {
        MethodWord::Bart if arguments.density.is_some() => refused("--density is for --method po and sbr"),
        MethodWord::Po if arguments.bounces.is_some_and(|bounces| bounces > 1) => {
            refused("--bounces is for --method bart and sbr: po has single reflections alone")
        }
        MethodWord::Po | MethodWord::Sbr if arguments.nodes == Some(NodeRule::OwnEdge) => refused(
            "--nodes own-edge is for --method bart: po and sbr weigh no facets, and take middle or exit",
        ),
        MethodWord::Po | MethodWord::Sbr if arguments.detail == SmallParts::Statistical => {
            refused("--detail statistical is for --method bart")
        }
        MethodWord::Po | MethodWord::Sbr if arguments.edges == Edges::FirstOrder => {
            refused("--edges on is for --method bart")
        }
        MethodWord::Po | MethodWord::Sbr if arguments.surface == Surface::Smooth => {
            refused("--surface smooth is for --method bart: po and sbr take facets as they are")
        }
        MethodWord::Po | MethodWord::Sbr if arguments.accuracy_db.is_some() => {
            progress::note(
                "note: --accuracy-db is for --method bart: --density is what a reference is exact by",
            );
            Ok(())
        }
        MethodWord::Bart | MethodWord::Po | MethodWord::Sbr => Ok(()),
    }
}

/// Refuses, before the work, results that cannot be written or that would replace an input.
fn claim(arguments: &RcsArguments) -> Result<(), Failure> {
    sidecar::claim_table(&arguments.out)?;
    if arguments.pictures {
        files::claim(&pictures::places(&arguments.out))?;
        pictures::refuse_foreign(&arguments.out)?;
    }
    Ok(())
}

/// Checkpoint of this table, made by these sources.
fn checkpoint(arguments: &RcsArguments, mesh: &Mesh, request: &RcsRequest) -> Checkpoint {
    let sources = Stage::BartRcs.sources();
    let method = format!("{:?} {:?} {request:?}", arguments.method, arguments.density());
    let checkpoint = Checkpoint::open(&arguments.out, &fingerprint(&(sources, mesh, method)));
    if checkpoint.aspects() > 0 {
        let of = request.elevation_rad.len() * request.azimuth_rad.len();
        progress::note(format!("resumed: {} of {of} aspects were there", checkpoint.aspects()));
    }
    checkpoint
}

fn traced(
    mesh: &Mesh,
    request: &RcsRequest,
    checkpoint: &Checkpoint,
    clock: &WorkClock,
    memory: Allowance,
) -> Result<RcsTable, Failure> {
    let work = Work::resumed("aspects", checkpoint.aspects());
    let (memory_limit, clock_s) = (memory.limit(), &|| clock.seconds());
    // An interrupt ends the program; aspects that are done are in the checkpoint.
    let cancellation = CancellationCheck::NEVER;
    let surroundings = RcsContext { memory_limit, checkpoint, progress: &work, clock_s, cancellation };
    bart_rcs::rcs_within(mesh, request, &surroundings).map(RcsTable::of_bart).map_err(Failure::refused)
}

/// Notes materials whose permittivities belong to other frequencies, and a receiver behind the body.
fn remark(mesh: &Mesh, request: &RcsRequest) {
    remarks::forward_scattering::remark(request, mesh).into_iter().for_each(progress::note);
    let ends = [f64::min, f64::max].map(|end| request.frequency_hz.iter().copied().reduce(end));
    if let [Some(lowest_hz), Some(highest_hz)] = ends {
        remarks::of_materials(mesh.makeup.materials.iter(), [lowest_hz, highest_hz])
            .into_iter()
            .for_each(progress::note);
    }
}

/// The mesh with the requested materials and those of its asset.
fn dressed(mesh: Mesh, arguments: &RcsArguments, request: &RcsRequest) -> Result<Mesh, Failure> {
    let (table, transmission) = (arguments.materials.as_deref(), arguments.transmission);
    let map = stepwise::materials(table, transmission, &request.frequency_hz)?;
    let mesh = stepwise::dressed(mesh, &arguments.mesh, &map, &request.frequency_hz)?;
    remarks::without_entry([&mesh].into_iter(), &map).into_iter().for_each(progress::note);
    Ok(mesh)
}

/// The table that the arguments ask for.
fn requested_table(arguments: &RcsArguments) -> RequestedTable {
    RequestedTable {
        mesh: arguments.mesh.clone(),
        unit_scale: arguments.unit_scale,
        materials: arguments.materials.clone(),
        transmission: arguments.transmission,
        method: format!("{:?}", arguments.method).to_lowercase(),
        density_per_wavelength: arguments.density(),
        frequency_hz: arguments.freq_ghz.values.iter().map(|f| f * 1e9).collect(),
        elevation_deg: arguments.el_deg.values.clone(),
        azimuth_deg: arguments.az_deg.values.clone(),
        range_m: arguments.range_m,
        receiver: receiver(arguments),
        polarization: arguments.pol,
        bounces: arguments.bounces(),
        nodes: arguments.nodes(),
        sides: arguments.sides,
        edges: arguments.edges,
        surface: arguments.surface,
        small_parts: arguments.detail,
        accuracy_db: arguments.accuracy_db(),
    }
}

fn receiver(arguments: &RcsArguments) -> Option<RequestedReceiver> {
    let (azimuth_deg, elevation_deg) = (arguments.rx_az_deg?, arguments.rx_el_deg?);
    Some(RequestedReceiver { azimuth_deg, elevation_deg, range_m: arguments.rx_range_m })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests unwrap what they made")]

    use super::*;
    use crate::program::cli::{Arguments, Command};
    use clap::Parser;

    #[test]
    fn a_command_that_says_nothing_asks_for_what_a_request_over_its_axes_has() {
        let words = "wayside rcs m.glb --freq-ghz 77 --az-deg 0 --out s.npy";
        let Command::Rcs(arguments) = Arguments::try_parse_from(words.split(' ')).unwrap().command else {
            unreachable!("`rcs` was asked for");
        };
        assert_eq!(requested_table(&arguments).request(), RcsRequest::over(vec![77e9], vec![0.0], vec![0.0]));
    }
}
