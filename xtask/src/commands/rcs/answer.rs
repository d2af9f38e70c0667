//! What `rcs` answers: the table and what is known of it.

use crate::cli::RcsArguments;
use crate::output;
use crate::summary::{error_db, model_error_db};
use artifact::scene::Mesh;
use artifact::units::{db_from_amplitude, db_from_power};
use artifact::{ErrorBudget, ModelError};
use bart_rcs::RcsResult;
use clap::ValueEnum;
use num_complex::Complex64;
use serde_json::{Value, json};
use std::path::Path;

/// S and the figures beside it, by whatever method.
pub(super) struct Answer {
    pub(super) amplitude_m: Vec<Complex64>,
    pub(super) beams: Vec<u64>,
    pub(super) build_seconds: f64,
    pub(super) trace_seconds: f64,
    pub(super) integrate_seconds: f64,
    pub(super) error: ErrorBudget,
    pub(super) model_error: ModelError,
    pub(super) node_spread: Vec<f64>,
    pub(super) dropped_at_most: Option<f64>,
}

impl Answer {
    pub(super) fn of_bart(result: RcsResult) -> Self {
        Self {
            amplitude_m: result.amplitude_m,
            beams: result.beams,
            build_seconds: result.seconds.build,
            trace_seconds: result.seconds.trace,
            integrate_seconds: result.seconds.integrate,
            error: result.error,
            model_error: result.model_error,
            node_spread: result.node_spread,
            dropped_at_most: Some(result.dropped_at_most),
        }
    }

    /// `S.json` of interface.md. `trace` and `integrate` add the work of all threads; `total` is wall time.
    pub(super) fn json(&self, arguments: &RcsArguments, mesh: &Mesh, load: f64, total: f64) -> Value {
        let s = mesh.statistics;
        let frequency_hz: Vec<f64> = arguments.freq_ghz.values.iter().map(|f| f * 1e9).collect();
        let spread: Vec<f64> = self.node_spread.iter().map(|e| db_from_amplitude(*e)).collect();
        json!({
            "axes": { "freq_hz": frequency_hz, "el_deg": arguments.el_deg.values, "az_deg": arguments.az_deg.values },
            "unit": "m",
            "settings": settings(arguments),
            "mesh": { "triangles_read": s.triangles_read, "degenerate": s.degenerate, "open_edges": s.open_edges,
                "triangles_traced": mesh.triangles.len() },
            "seconds": { "load": load, "build": self.build_seconds, "trace": self.trace_seconds,
                "integrate": self.integrate_seconds, "total": total },
            "beams": self.beams,
            "peak_memory_mib": crate::memory::peak_mib(),
            "error_db": error_db(&self.error),
            "model_error_db": model_error_db(&self.model_error),
            "node_spread_db": spread,
            "dropped_at_most_db": self.dropped_at_most.map(db_from_amplitude),
        })
    }

    /// Level and errors, for a person.
    pub(super) fn tell(&self, out: &Path) {
        let powers = || self.amplitude_m.iter().map(|s| s.norm_sqr());
        let mean = powers().sum::<f64>() / self.amplitude_m.len().max(1) as f64;
        let (mean, peak) = (db_from_power(mean), db_from_power(powers().fold(0.0, f64::max)));
        output::line(format!("{}: mean {mean:.2} dBsm, peak {peak:.2} dBsm", out.display()));
        let told = |e: Option<f64>| e.map_or("not estimated".into(), decibels);
        let total = told(self.error.total());
        let (nodes, bounces) = (told(self.model_error.nodes), told(self.model_error.bounces));
        let by_order = self.node_spread.iter().enumerate().skip(1);
        let by_order: Vec<String> = by_order.map(|(i, e)| format!("order {} {}", i + 1, decibels(*e))).collect();
        output::line(format!("numerical error {total}"));
        output::line(format!(
            "model: spread of node rules {nodes} ({}), first order left out {bounces}",
            by_order.join(", ")
        ));
        if let Some(dropped) = self.dropped_at_most {
            output::line(format!("dropped beams scatter at most: {}", decibels(dropped)));
        }
    }
}

/// An amplitude relative to the level.
fn decibels(ratio: f64) -> String {
    if ratio > 0.0 { format!("{:.1} dB", db_from_amplitude(ratio)) } else { "none".into() }
}

fn settings(arguments: &RcsArguments) -> Value {
    let lower = |word: &dyn std::fmt::Debug| format!("{word:?}").to_lowercase();
    let nodes = arguments.nodes.to_possible_value().map(|word| word.get_name().to_owned());
    let finite = |range: f64| if range.is_finite() { json!(range) } else { json!("inf") };
    json!({
        "mesh": arguments.mesh, "range_m": finite(arguments.range_m), "pol": lower(&arguments.pol),
        "bounces": arguments.bounces, "method": lower(&arguments.method), "edges": lower(&arguments.edges),
        "nodes": nodes, "surface": lower(&arguments.surface), "sides": lower(&arguments.sides),
        "materials": arguments.materials, "transmission": lower(&arguments.transmission),
        "accuracy_db": arguments.accuracy_db, "rx_az_deg": arguments.rx_az_deg, "rx_el_deg": arguments.rx_el_deg,
        "rx_range_m": arguments.rx_range_m.map(finite), "density_per_wavelength": arguments.density,
    })
}
