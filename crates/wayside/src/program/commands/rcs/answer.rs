//! Answer of `rcs` on the console: the table's level and its errors.

use crate::program::terminal;
use crate::stepwise::{RcsTable, RequestedTable, far_field_from_m};
use artifact::scene::Mesh;
use artifact::units::{db_from_amplitude, db_from_power};
use bart_rcs::MirrorRefinement;
use pipeline::outcome::verdict::RequestSource;
use std::path::Path;

/// Prints level and errors of the table in a file.
pub(super) fn tell(table: &RcsTable, requested: &RequestedTable, mesh: &Mesh, out: &Path) {
    let powers = || table.amplitude_m.iter().map(|s| s.norm_sqr());
    let mean = powers().sum::<f64>() / table.amplitude_m.len().max(1) as f64;
    let (mean, peak) = (db_from_power(mean), db_from_power(powers().fold(0.0, f64::max)));
    terminal::line(format!("{}: mean {mean:.2} dBsm, peak {peak:.2} dBsm", out.display()));
    if table.vanishes {
        return terminal::line(VANISHES);
    }
    table.verdict(requested.accuracy_db).lines(RequestSource::Options).into_iter().for_each(terminal::line);
    terminal::line(of_model(table));
    if let Some(dropped) = table.dropped_at_most {
        terminal::line(format!("dropped beams scatter at most: {}", decibels(dropped)));
    }
    if let Some(MirrorRefinement { least_area_m2, traced_again: again @ 1.. }) = table.mirrors {
        terminal::line(format!(
            "{again} aspects traced again with smaller mirrors, from {:.1e} mm² on",
            1e6 * least_area_m2
        ));
    }
    if requested.range_m.is_infinite() {
        terminal::line(warning(table, far_field_from_m(mesh.size_m(), &requested.frequency_hz)));
    }
}

/// Sentence about an S that is zero by symmetry.
const VANISHES: &str = "S vanishes in this polarization: it is nothing but rounding beside the other ones, \
                        and no error can be relative to it";

/// Sentence about the errors of the physical model.
fn of_model(table: &RcsTable) -> String {
    let told = |e: Option<f64>| e.map_or("not estimated".into(), decibels);
    let (nodes, bounces) = (told(table.model_error.nodes), told(table.model_error.bounces));
    let by_order = table.node_spread.iter().enumerate().skip(1);
    let by_order: Vec<String> = by_order.map(|(i, e)| format!("order {} {}", i + 1, decibels(*e))).collect();
    let by_order = if by_order.is_empty() { String::new() } else { format!(" ({})", by_order.join(", ")) };
    let left_out = [("edges", table.model_error.edges), ("transmission", table.model_error.transmission)];
    let estimated = left_out.into_iter().filter_map(|(name, error)| error.map(|error| (name, error)));
    let others: String =
        estimated.map(|(name, error)| format!(", {name} left out {}", decibels(error))).collect();
    format!("model: spread of node rules {nodes}{by_order}, first order left out {bounces}{others}")
}

/// Warning of every run that makes a far-field table: the range from which on it holds, and its error at
/// shorter ranges.
fn warning(table: &RcsTable, from_m: f64) -> String {
    let Some(error) = &table.far_field else {
        return format!("far field: right from 2D²/λ = {from_m:.0} m on; its error near by was not measured");
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

/// Text of an amplitude ratio in dB.
fn decibels(ratio: f64) -> String {
    if ratio > 0.0 { format!("{:.1} dB", db_from_amplitude(ratio)) } else { "none".into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::ModelError;

    #[test]
    fn edges_and_transmission_that_are_left_out_are_told_where_they_are_estimated() {
        let told = |model_error: ModelError| {
            of_model(&RcsTable { model_error, node_spread: vec![0.0], ..RcsTable::default() })
        };
        let without = ModelError { nodes: Some(0.1), ..ModelError::default() };
        let begin = "model: spread of node rules -20.0 dB, first order left out not estimated";
        assert_eq!(told(without), begin);
        let with = ModelError { edges: Some(1e4), transmission: Some(0.0), ..without };
        assert_eq!(told(with), format!("{begin}, edges left out 80.0 dB, transmission left out none"));
    }
}
