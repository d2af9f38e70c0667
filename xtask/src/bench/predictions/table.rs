//! The rows of a comparison as a file: one line per scene, from which earlier runs are read again.

use crate::bench::predictions::child::MeasuredCost;
use crate::bench::predictions::fit::CountedRun;
use crate::bench::predictions::row::PredictionRow;
use std::collections::BTreeMap;
use std::path::Path;
use wayside::chain::expectation::rates::{HELD_KINDS, SECONDS};
use wayside::chain::expectation::work::ITEMS;
use wayside::chain::memory_estimate::MemoryLoad;
use wayside::host::failure::Failure;
use wayside::host::files;

/// Columns of a scene's actual cost, which are read again.
const MEASURED_COLUMNS: [&str; 10] = [
    "taken_s",
    "taken_mib",
    "machine_speed",
    "paths",
    "beams",
    "moments",
    "traced_mib",
    "bart_rcs_s",
    "fmcw_echo_s",
    "dsp_s",
];
const PREDICTED_COLUMNS: &str = "said_s,said_mib,most_mib,look_s,at_once,signal_mib,facets,polygons,cells,changing,sliding,moving,\
                    through_sheets";

/// Reads the actual costs of scenes by name; none if the file does not exist yet.
pub(super) fn measured_costs(file: &Path) -> Result<BTreeMap<String, MeasuredCost>, Failure> {
    let text = match std::fs::read_to_string(file) {
        Ok(text) => text,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(BTreeMap::new()),
        Err(e) => return Err(Failure::system(file, "read", e)),
    };
    known(&text)
        .ok_or_else(|| Failure::refused(format!("{}: it is no table of this command", file.display())))
}

/// Reads the counted work and the actual cost of a table's scenes: seconds on the reference machine, and MiB.
pub(super) fn runs(file: &Path) -> Result<(Vec<CountedRun<ITEMS>>, Vec<CountedRun<HELD_KINDS>>), Failure> {
    let text = std::fs::read_to_string(file).map_err(|e| Failure::system(file, "read", e))?;
    timed_runs(&text).zip(held_runs(&text)).ok_or_else(|| {
        let rule = "it is no table of this command with a column of every kind of work that is counted today";
        Failure::refused(format!("{}: {rule}; run with --out it is written anew", file.display()))
    })
}

fn timed_runs(text: &str) -> Option<Vec<CountedRun<ITEMS>>> {
    let took = columns(text, ["taken_s", "machine_speed"])?;
    let counts = columns(text, SECONDS.map(|(kind, _)| format!("{kind:?}")))?;
    let run = |([processor_s, machine_speed], counts): ([f64; 2], [f64; ITEMS])| {
        let run = CountedRun { counts, taken: processor_s * machine_speed };
        run.is_finite().then_some(run)
    };
    took.into_iter().zip(counts).map(run).collect()
}

fn held_runs(text: &str) -> Option<Vec<CountedRun<HELD_KINDS>>> {
    let names = [
        "taken_mib",
        "Triangles",
        "at_once",
        "signal_mib",
        "facets",
        "polygons",
        "cells",
        "moving",
        "through_sheets",
    ];
    let run = |[taken, triangles, at_once, load @ ..]: [f64; 9]| {
        let [signal_mib, facets, beams, cells, moving_cells, beams_through_sheets] = load;
        let load = MemoryLoad {
            signal_mib,
            facets,
            beams,
            beams_through_sheets,
            cells,
            moving_cells,
            ..MemoryLoad::default()
        };
        let run = CountedRun { counts: load.held(triangles, at_once), taken };
        run.is_finite().then_some(run)
    };
    columns(text, names)?.into_iter().map(run).collect()
}

fn known(text: &str) -> Option<BTreeMap<String, MeasuredCost>> {
    let taken = columns(text, MEASURED_COLUMNS)?.into_iter().map(of_numbers);
    let place = text.lines().next()?.split(',').position(|column| column == "scene")?;
    let name = |line: &str| line.split(',').nth(place).map(str::to_owned);
    text.lines().skip(1).zip(taken).map(|(line, taken)| Some((name(line)?, taken))).collect()
}

/// Numbers of some columns, row by row; `None` if one is missing or not a number.
fn columns<const N: usize>(text: &str, names: [impl AsRef<str>; N]) -> Option<Vec<[f64; N]>> {
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next()?.split(',').collect();
    let places = names.map(|name| head.iter().position(|column| *column == name.as_ref()));
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let mut numbers = [0.0; N];
        for (number, place) in numbers.iter_mut().zip(places) {
            *number = cells.get(place?)?.parse().ok()?;
        }
        Some(numbers)
    };
    lines.map(row).collect()
}

fn of_numbers(numbers: [f64; MEASURED_COLUMNS.len()]) -> MeasuredCost {
    let [processor_s, peak_mib, machine_speed, paths, beams, moments, traced_mib, stages_s @ ..] = numbers;
    MeasuredCost { processor_s, peak_mib, machine_speed, paths, beams, moments, traced_mib, stages_s }
}

fn numbers(taken: &MeasuredCost) -> [f64; MEASURED_COLUMNS.len()] {
    let MeasuredCost { processor_s, peak_mib, machine_speed, paths, beams, moments, traced_mib, stages_s } =
        *taken;
    let [bart_rcs_s, fmcw_echo_s, dsp_s] = stages_s;
    [processor_s, peak_mib, machine_speed, paths, beams, moments, traced_mib, bart_rcs_s, fmcw_echo_s, dsp_s]
}

/// Writes all rows so far in place of the old ones.
pub(super) fn write(file: &Path, rows: &[PredictionRow]) -> Result<(), Failure> {
    let counts: Vec<String> = SECONDS.iter().map(|(kind, _)| format!("{kind:?}")).collect();
    let mut text =
        format!("scene,threads,{},{PREDICTED_COLUMNS},{}\n", MEASURED_COLUMNS.join(","), counts.join(","));
    rows.iter().for_each(|row| text += &line(row));
    files::overwrite(file, text.as_bytes())
}

fn line(row: &PredictionRow) -> String {
    let PredictionRow { scene, expected, look_s, load, at_once, taken } = row;
    let MemoryLoad { signal_mib, facets, beams, beams_through_sheets, cells, changing_cells, .. } = load;
    let MemoryLoad { sliding_tiles, moving_cells, .. } = load;
    let threads = scene.threads.map_or("all".into(), |n| n.to_string());
    let taken = numbers(taken).map(|number| format!("{number:.3}")).join(",");
    let counts: Vec<String> = expected.work.0.iter().map(|count| format!("{count:.1}")).collect();
    format!(
        "{},{threads},{taken},{:.3},{:.1},{:.1},{look_s:.2},{at_once},{signal_mib:.2},{facets:.0},{beams:.0},{cells:.0},\
         {changing_cells:.0},{sliding_tiles:.1},{moving_cells:.0},{beams_through_sheets:.0},{}\n",
        scene.name,
        expected.seconds,
        expected.expected_memory_mib,
        expected.memory_mib,
        counts.join(",")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_taken_is_read_again_whatever_was_said() {
        let text = "said_s,scene,taken_s,taken_mib,machine_speed,paths,beams,moments,traced_mib,bart_rcs_s,fmcw_echo_s,dsp_s,New\n\
                    9,random-1-000,1.5,80.5,0.75,3,4,9,5,0.5,0.25,0.125,7\n";
        let taken = known(text).unwrap()["random-1-000"];
        assert_eq!(numbers(&taken), [1.5, 80.5, 0.75, 3.0, 4.0, 9.0, 5.0, 0.5, 0.25, 0.125]);
        assert!(known("scene,taken_s\na,1\n").is_none() && known("").is_none());
    }

    #[test]
    fn counts_are_read_by_their_names_and_a_table_that_lacks_one_is_refused() {
        let kinds: Vec<String> = SECONDS.iter().rev().map(|(kind, _)| format!("{kind:?}")).collect();
        let counts: Vec<String> = (0..ITEMS).map(|count| format!("{count}.5")).collect();
        let head = format!("machine_speed,{},scene,taken_s", kinds.join(","));
        let runs_of = |head: &str| timed_runs(&format!("{head}\n0.5,{},x,3.0\n", counts.join(",")));
        let found = runs_of(&head).unwrap();
        assert_eq!((found.len(), found[0].taken), (1, 1.5));
        let backwards: Vec<f64> = (0..ITEMS).rev().map(|count| count as f64 + 0.5).collect();
        assert_eq!(found[0].counts.to_vec(), backwards);
        assert!(runs_of(&head.replacen(&kinds[2], "Other", 1)).is_none());
    }
}
