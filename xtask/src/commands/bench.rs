//! `bench`: our way beside a rival in one run, as a ratio; it asserts nothing.

mod cases;

use crate::cli::BenchArguments;
use crate::failure::Failure;
use crate::output;
use artifact::units::db_from_amplitude;
use serde_json::{Value, json};

/// One comparison.
pub(crate) struct Comparison {
    pub(crate) name: String,
    pub(crate) ours_s: f64,
    pub(crate) rival: String,
    pub(crate) rival_s: f64,
    /// Of ours against the rival's result, relative amplitude.
    pub(crate) error: Option<f64>,
    pub(crate) work: String,
}

pub(crate) fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    output::claim(arguments.out.as_slice())?;
    let comparisons = cases::all(arguments)?;
    for c in &comparisons {
        let ratio = c.rival_s / c.ours_s;
        output::line(format!(
            "{}: {:.3} s, {} {:.3} s, ratio {ratio:.1} ({})",
            c.name, c.ours_s, c.rival, c.rival_s, c.work
        ));
    }
    let Some(file) = &arguments.out else { return Ok(()) };
    let list: Vec<Value> = comparisons.iter().map(json).collect();
    let text = serde_json::to_string_pretty(&list).map_err(Failure::refused)?;
    output::write_file(file, text.as_bytes())
}

fn json(c: &Comparison) -> Value {
    json!({
        "name": c.name, "ours_s": c.ours_s, "rival": c.rival, "rival_s": c.rival_s, "ratio": c.rival_s / c.ours_s,
        "error_db": c.error.map(db_from_amplitude), "work": c.work,
    })
}
