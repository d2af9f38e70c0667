//! Answer of `rcs`: the table with its properties and errors.

use crate::program::cli::RcsArguments;
use crate::program::option_words::{EDGES, NODES, POLARIZATIONS, SIDES, SURFACES, TRANSMISSION, word_of};
use crate::program::terminal;
use crate::stepwise::far_field_from_m;
use artifact::scene::Mesh;
use artifact::units::{db_from_amplitude, db_from_power};
use artifact::{Accuracy, ErrorBudget, ModelError};
use bart_rcs::{FarFieldError, Followed, RcsResult, Spread};
use num_complex::Complex64;
use pipeline::host::processor_time::Counted;
use pipeline::outcome::error_figures::{ErrorFigures, ModelErrorFigures};
use pipeline::outcome::verdict::{Asking, Verdict};
use serde_json::{Value, json};

/// Duration of the command, s.
pub(super) struct CommandTook {
    /// Time for reading the mesh.
    pub(super) load: f64,
    /// Wall-clock time.
    pub(super) total: f64,
    /// Processor time of all threads in this run; `None` where the system does not report it.
    pub(super) processor_total: Option<f64>,
    /// Clock of all times but the totals.
    pub(super) counted: Counted,
}

/// S and the figures beside it, by any method; figures that a method lacks keep their defaults.
#[derive(Default)]
pub(super) struct Answer {
    pub(super) amplitude_m: Vec<Complex64>,
    pub(super) beams: Vec<u64>,
    pub(super) build_seconds: f64,
    pub(super) trace_seconds: f64,
    pub(super) integrate_seconds: f64,
    pub(super) vanishes: bool,
    pub(super) error: ErrorBudget,
    pub(super) model_error: ModelError,
    pub(super) node_spread: Vec<f64>,
    pub(super) dropped_at_most: Option<f64>,
    pub(super) mirrors: Option<Followed>,
    pub(super) far_field: Option<FarFieldError>,
    pub(super) check_seconds: f64,
    /// Number of aspects that an interrupted run had done.
    pub(super) cached: usize,
}

impl Answer {
    pub(super) fn of_bart(result: RcsResult) -> Self {
        Self {
            amplitude_m: result.amplitude_m,
            beams: result.beams,
            build_seconds: result.seconds.build,
            trace_seconds: result.seconds.trace,
            integrate_seconds: result.seconds.integrate,
            vanishes: result.vanishes,
            error: result.error,
            model_error: result.model_error,
            node_spread: result.node_spread,
            dropped_at_most: Some(result.dropped_at_most),
            mirrors: Some(result.mirrors),
            far_field: result.far_field,
            check_seconds: result.seconds.check,
            cached: 0,
        }
    }

    /// Content of `S.json` as in interface.md.
    pub(super) fn json(&self, arguments: &RcsArguments, mesh: &Mesh, took: &CommandTook) -> Value {
        let s = mesh.statistics;
        let frequency_hz: Vec<f64> = arguments.freq_ghz.values.iter().map(|f| f * 1e9).collect();
        let spread: Vec<f64> = self.node_spread.iter().map(|e| db_from_amplitude(*e)).collect();
        json!({
            "axes": { "freq_hz": frequency_hz, "el_deg": arguments.el_deg.values, "az_deg": arguments.az_deg.values },
            "unit": "m",
            "settings": settings(arguments),
            "mesh": { "triangles_read": s.triangles_read, "degenerate": s.degenerate, "open_edges": s.open_edges,
                "triangles_traced": mesh.triangles.len(), "size_m": mesh.size_m() },
            "seconds": { "load": took.load, "build": self.build_seconds, "trace": self.trace_seconds,
                "integrate": self.integrate_seconds, "check": self.check_seconds, "total": took.total,
                "processor_total": took.processor_total, "counted": took.counted.name() },
            "cached": self.cached,
            "beams": self.beams,
            "peak_memory_mib": pipeline::host::memory::peak_mib(),
            "vanishes": self.vanishes,
            "accuracy": self.verdict(arguments).told(Asking::Options),
            "error_db": ErrorFigures::of(&self.error),
            "model_error_db": ModelErrorFigures::of(&self.model_error),
            "node_spread_db": spread,
            "dropped_at_most_db": self.dropped_at_most.map(db_from_amplitude),
            "mirrors": self.mirrors.map(|m| json!({ "least_area_m2": m.least_area_m2, "traced_again": m.traced_again })),
            "far_field_from_m": arguments.range_m.is_infinite().then(|| far_field_from_m(mesh, &frequency_hz)),
            "far_field_error": self.far_field.as_ref().map(far_field_error),
        })
    }

    fn verdict(&self, arguments: &RcsArguments) -> Verdict {
        Verdict::of(Accuracy::from_db(arguments.accuracy_db()), &self.error).beside(&self.model_error)
    }

    /// Prints level and errors.
    pub(super) fn tell(&self, arguments: &RcsArguments, mesh: &Mesh) {
        let out = &arguments.out;
        let powers = || self.amplitude_m.iter().map(|s| s.norm_sqr());
        let mean = powers().sum::<f64>() / self.amplitude_m.len().max(1) as f64;
        let (mean, peak) = (db_from_power(mean), db_from_power(powers().fold(0.0, f64::max)));
        terminal::line(format!("{}: mean {mean:.2} dBsm, peak {peak:.2} dBsm", out.display()));
        if self.vanishes {
            return terminal::line(VANISHES);
        }
        let told = |e: Option<f64>| e.map_or("not estimated".into(), decibels);
        let (nodes, bounces) = (told(self.model_error.nodes), told(self.model_error.bounces));
        let by_order = self.node_spread.iter().enumerate().skip(1);
        let by_order: Vec<String> =
            by_order.map(|(i, e)| format!("order {} {}", i + 1, decibels(*e))).collect();
        let by_order =
            if by_order.is_empty() { String::new() } else { format!(" ({})", by_order.join(", ")) };
        self.verdict(arguments).lines(Asking::Options).into_iter().for_each(terminal::line);
        terminal::line(format!(
            "model: spread of node rules {nodes}{by_order}, first order left out {bounces}"
        ));
        if let Some(dropped) = self.dropped_at_most {
            terminal::line(format!("dropped beams scatter at most: {}", decibels(dropped)));
        }
        if let Some(Followed { least_area_m2, traced_again: again @ 1.. }) = self.mirrors {
            terminal::line(format!(
                "{again} aspects traced again with smaller mirrors, from {:.1e} mm² on",
                1e6 * least_area_m2
            ));
        }
        if arguments.range_m.is_infinite() {
            terminal::line(self.warning(arguments, mesh));
        }
    }

    /// Warning of every run that makes a far-field table: the range from which on it holds, and its error at
    /// shorter ranges.
    fn warning(&self, arguments: &RcsArguments, mesh: &Mesh) -> String {
        let frequency_hz: Vec<f64> = arguments.freq_ghz.values.iter().map(|f| f * 1e9).collect();
        let from_m = far_field_from_m(mesh, &frequency_hz);
        let Some(error) = &self.far_field else {
            return format!(
                "far field: right from 2D²/λ = {from_m:.0} m on; its error near by was not measured"
            );
        };
        let listed = |digits: usize, of: &mut dyn Iterator<Item = f64>| {
            of.map(|value| format!("{value:.digits$}")).collect::<Vec<_>>().join(", ")
        };
        format!(
            "far field: right from 2D²/λ = {from_m:.0} m on; at {} m its complex error is {} dB and its level is off by {} dB \
             (medians of {} aspects; worst {} dB, {} dB)",
            listed(0, &mut error.range_m.iter().copied()),
            listed(1, &mut error.complex.iter().map(|s| db_from_amplitude(s.median))),
            listed(1, &mut error.level_db.iter().map(|s| s.median)),
            error.aspects,
            listed(1, &mut error.complex.iter().map(|s| db_from_amplitude(s.worst))),
            listed(1, &mut error.level_db.iter().map(|s| s.worst)),
        )
    }
}

/// Sentence about an S that is zero by symmetry.
const VANISHES: &str = "S vanishes in this polarization: it is nothing but rounding beside the other ones, \
                        and no error can be relative to it";

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

/// Text of an amplitude ratio in dB.
fn decibels(ratio: f64) -> String {
    if ratio > 0.0 { format!("{:.1} dB", db_from_amplitude(ratio)) } else { "none".into() }
}

fn settings(arguments: &RcsArguments) -> Value {
    let finite = |range: f64| if range.is_finite() { json!(range) } else { json!("inf") };
    // JSON is text; a path may not be.
    let materials = arguments.materials.as_ref().map(|file| file.to_string_lossy());
    json!({
        "mesh": arguments.mesh.to_string_lossy(), "range_m": finite(arguments.range_m), "pol": word_of(&POLARIZATIONS, arguments.pol),
        "bounces": arguments.bounces(), "method": format!("{:?}", arguments.method).to_lowercase(), "edges": word_of(&EDGES, arguments.edges),
        "nodes": word_of(&NODES, arguments.nodes()), "surface": word_of(&SURFACES, arguments.surface),
        "sides": word_of(&SIDES, arguments.sides),
        "materials": materials, "transmission": word_of(&TRANSMISSION, arguments.transmission),
        "accuracy_db": arguments.accuracy_db(), "rx_az_deg": arguments.rx_az_deg, "rx_el_deg": arguments.rx_el_deg,
        "rx_range_m": arguments.rx_range_m.map(finite), "density_per_wavelength": arguments.density(), "unit_scale": arguments.unit_scale,
    })
}
