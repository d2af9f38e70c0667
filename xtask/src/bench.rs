//! `bench`: compares our methods with rival programs in one run, as ratios; asserts nothing.

mod comparison;
mod cases;
mod predictions;
mod programs;

use crate::cli::BenchArguments;
use artifact::units::db_from_amplitude;
pub(crate) use cases::{CHARTED, QUICK, all as comparisons};
pub(crate) use comparison::Comparison;
pub(crate) use predictions::{PredictedCost, RATIOS, Spread, cost_of_random};
use programs::MissingProgram;
use serde_json::{Value, json};
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::program::terminal;

pub(crate) fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    if arguments.predictions {
        return predictions::run(arguments);
    }
    files::claim(arguments.out.as_slice())?;
    let comparisons = cases::all(if arguments.quick { cases::QUICK } else { cases::FULL })?;
    comparisons.iter().for_each(|comparison| terminal::line(line(comparison)));
    let Some(file) = &arguments.out else { return Ok(()) };
    let list: Vec<Value> = comparisons.iter().map(json).collect();
    let text = serde_json::to_string_pretty(&list).map_err(Failure::refused)?;
    files::write_file(file, text.as_bytes())
}

fn line(c: &Comparison) -> String {
    let ours = format!("{}: {:.4} s", c.name, c.ours_s);
    match &c.rival {
        Ok((rival, rival_s)) => {
            let error =
                c.error.map(|e| format!(", {:.0} dB from it", db_from_amplitude(e))).unwrap_or_default();
            format!("{ours}, {rival} {rival_s:.4} s, ratio {:.1}{error} ({})", rival_s / c.ours_s, c.work)
        }
        Err(MissingProgram { program, advice }) => {
            format!("{ours}, {program} is not here: {advice} ({})", c.work)
        }
    }
}

fn json(c: &Comparison) -> Value {
    let rival = c.rival.as_ref().ok();
    json!({
        "name": c.name, "ours_s": c.ours_s,
        "rival": rival.map(|(rival, _)| rival), "rival_s": rival.map(|(_, seconds)| seconds),
        "ratio": rival.map(|(_, seconds)| seconds / c.ours_s),
        "error_db": c.error.map(db_from_amplitude), "work": c.work,
        "note": c.rival.as_ref().err().map(|missing| &missing.advice),
    })
}
