//! Description of a table of S: the content of `S.json`, as `docs/interface.md` has it.

use crate::stepwise::meshes::far_field_from_m;
use crate::stepwise::tables::figures::RcsTable;
use crate::stepwise::tables::requested::RequestedTable;
use artifact::scene::Mesh;
use artifact::units::db_from_amplitude;
use bart_rcs::{FarFieldError, MirrorRefinement, Spread};
use pipeline::host::memory::peak_mib;
use pipeline::host::processor_time::{ClockKind, WorkClock};
use pipeline::outcome::error_figures::{ErrorFigures, ModelErrorFigures};
use pipeline::outcome::verdict::RequestSource;
use serde_json::{Value, json};
use std::time::Instant;

/// Duration of making a table, s.
pub(crate) struct TableTimings {
    /// Time for reading the mesh.
    load: f64,
    /// Wall-clock time.
    total: f64,
    /// Processor time of all threads; `None` where the system does not report it.
    processor_total: Option<f64>,
    /// Clock of all times but the totals.
    clock: ClockKind,
}

impl TableTimings {
    /// Time from `start` until now, of which reading the mesh took `load` seconds.
    pub(crate) fn since(start: Instant, clock: &WorkClock, load: f64) -> Self {
        Self {
            load,
            total: start.elapsed().as_secs_f64(),
            processor_total: (clock.kind() == ClockKind::Processor).then(|| clock.seconds()),
            clock: clock.kind(),
        }
    }
}

/// Content of `S.json`, without pictures.
pub(crate) fn describe(
    requested: &RequestedTable,
    mesh: &Mesh,
    table: &RcsTable,
    timings: &TableTimings,
) -> Value {
    let (read, of) = (mesh.statistics, table.seconds);
    let spread: Vec<f64> = table.node_spread.iter().map(|e| db_from_amplitude(*e)).collect();
    let from_m = || far_field_from_m(mesh.size_m(), &requested.frequency_hz);
    json!({
        "axes": requested.axes(),
        "unit": "m",
        "settings": requested.settings(),
        "mesh": { "triangles_read": read.triangles_read, "degenerate": read.degenerate,
            "open_edges": read.open_edges, "triangles_traced": mesh.triangles.len(),
            "size_m": mesh.size_m() },
        "seconds": { "load": timings.load, "build": of.build, "trace": of.trace, "integrate": of.integrate,
            "check": of.check, "total": timings.total, "processor_total": timings.processor_total,
            "counted": timings.clock.name() },
        "cached": table.cached,
        "beams": table.beams,
        "peak_memory_mib": peak_mib(),
        "vanishes": table.vanishes,
        "accuracy": table.verdict(requested.accuracy_db).for_summary(RequestSource::Options),
        "error_db": ErrorFigures::of(&table.error),
        "model_error_db": ModelErrorFigures::of(&table.model_error),
        "node_spread_db": spread,
        "dropped_at_most_db": table.dropped_at_most.map(db_from_amplitude),
        "mirrors": table.mirrors.map(mirrors),
        "far_field_from_m": requested.range_m.is_infinite().then(from_m),
        "far_field_error": table.far_field.as_ref().map(far_field_error),
        "pictures": null,
    })
}

fn mirrors(of: MirrorRefinement) -> Value {
    json!({ "least_area_m2": of.least_area_m2, "traced_again": of.traced_again })
}

fn far_field_error(error: &FarFieldError) -> Value {
    let complex =
        |of: fn(&Spread) -> f64| error.complex.iter().map(|s| db_from_amplitude(of(s))).collect::<Vec<_>>();
    let level = |of: fn(&Spread) -> f64| error.level_db.iter().map(of).collect::<Vec<_>>();
    json!({
        "range_m": error.range_m,
        "complex_db": complex(|s| s.median), "complex_worst_db": complex(|s| s.worst),
        "level_db": level(|s| s.median), "level_worst_db": level(|s| s.worst),
        "aspects": error.aspects, "frequencies": error.frequencies,
    })
}
