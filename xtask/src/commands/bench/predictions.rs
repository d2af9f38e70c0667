//! `bench --predictions`: what is said of a run before it begins, beside what it takes, over random scenes.

mod child;
mod fit;
mod random_scenes;

use crate::cache::project_root;
use crate::chain::Chain;
use crate::cli::{BenchArguments, SceneArguments};
use crate::commands::load;
use crate::expectation::{Expectation, work::Item};
use crate::failure::Failure;
use crate::output;
use crate::plan::FramePlan;
use child::Taken;
use random_scenes::RandomScene;
use serde_json::Value;
use std::path::Path;

/// One scene.
struct Row {
    scene: RandomScene,
    expected: Expectation,
    taken: Taken,
    /// What the memory of its largest frame goes into.
    held: Held,
    /// Paths of all frames, and seconds of its stages by the clock: bart_rcs, fmcw_echo, dsp.
    paths: f64,
    stages_s: [f64; 3],
}

/// Of the frame whose tracing is expected to hold most.
struct Held {
    at_once: usize,
    signal_mib: f64,
    facets: f64,
    beams: f64,
    cells: f64,
}

pub(super) fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    let mut rows = Vec::new();
    for number in 0..arguments.scenes {
        let scene = random_scenes::scene(arguments.seed, number, &project_root());
        if let Some(row) = row(scene, folder.path())? {
            output::line(line(&row));
            rows.push(row);
        }
        // Hours of work are not lost with its last scene.
        arguments.out.iter().try_for_each(|file| output::write_file(file, csv(&rows).as_bytes()))?;
    }
    quantiles(&rows).into_iter().for_each(output::line);
    let runs: Vec<fit::Run> = rows.iter().map(Row::at_reference_speed).collect();
    output::line("rates that would have told these scenes best:");
    for (item, rate) in Item::ALL.iter().zip(fit::rates(&runs, Expectation::rates())) {
        output::line(format!("    (Item::{item:?}, {rate:.2e}),"));
    }
    Ok(())
}

impl Row {
    fn at_reference_speed(&self) -> fit::Run {
        fit::Run { work: self.expected.work, seconds: self.taken.processor_s * self.expected.machine_speed }
    }
}

/// Of what was said over what was taken.
fn quantiles(rows: &[Row]) -> Vec<String> {
    let told = |name: &str, ratio: &dyn Fn(&Row) -> f64| {
        let mut ratios: Vec<f64> = rows.iter().map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| ratios.get((share * (ratios.len().max(1) - 1) as f64).round() as usize).copied();
        let at = [0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0].map(|share| at(share).unwrap_or(f64::NAN));
        let within = ratios.iter().filter(|ratio| (0.5..=2.0).contains(*ratio)).count();
        let told: Vec<String> = at.iter().map(|ratio| format!("{ratio:.2}")).collect();
        let of = ratios.len();
        format!(
            "{name}, said over taken: quantiles 0, 5, 25, 50, 75, 95, 100 %: {}; {within} of {of} within a factor of 2",
            told.join(" ")
        )
    };
    vec![
        told("seconds", &|row| row.expected.seconds / row.taken.processor_s),
        told("memory", &|row| row.expected.memory_mib / row.taken.peak_mib),
    ]
}

fn row(scene: RandomScene, folder: &Path) -> Result<Option<Row>, Failure> {
    let file = folder.join("random.toml");
    output::write_file(&file, scene.text.as_bytes())?;
    let (expected, held) = expected(&file)?;
    let out = folder.join("out");
    let Some(taken) = child::run(&file, &out, scene.threads)? else { return Ok(None) };
    let text = std::fs::read(out.join("summary.json")).map_err(|e| Failure::system(&out, "read", e))?;
    let summary: Value = serde_json::from_slice(&text).map_err(Failure::refused)?;
    let frames = || summary["frames"].as_array().into_iter().flatten();
    let paths = frames().filter_map(|frame| frame["paths"].as_f64()).sum();
    let seconds = |stage: &str| frames().filter_map(|frame| frame["stage_seconds"][stage].as_f64()).sum();
    let stages_s = ["bart_rcs", "fmcw_echo", "dsp"].map(seconds);
    Ok(Some(Row { scene, expected, taken, held, paths, stages_s }))
}

/// As `run --dry-run` says it.
fn expected(file: &Path) -> Result<(Expectation, Held), Failure> {
    let arguments = SceneArguments { scene: file.to_owned(), model: None, radar: None, seed: None };
    let loaded = load::scene(&arguments, None)?;
    let model = load::model(None)?;
    let chain = Chain::of(&loaded.header, None, model.as_ref());
    let plans: Vec<FramePlan> = (0..loaded.header.frames).map(|index| chain.plan(index)).collect();
    Ok((Expectation::of(&chain, None, &plans)?, held(&chain, &plans)?))
}

fn held(chain: &Chain, plans: &[FramePlan]) -> Result<Held, Failure> {
    let (at_once, signal_mib) = (chain.side_by_side(plans)?, crate::memory::mib(chain.signal_bytes()));
    let mut most = Held { at_once, signal_mib, facets: 0.0, beams: 0.0, cells: 0.0 };
    for plan in plans {
        let look = chain.looks.of(chain, plan.index)?;
        most.facets = most.facets.max(look.facets * look.work.facets);
        most.beams = most.beams.max(look.facets * (look.work.beams[0] + look.work.beams[1]));
        most.cells = most.cells.max(look.cells * look.work.smaller_cells);
    }
    Ok(most)
}

fn line(row: &Row) -> String {
    let Taken { processor_s, peak_mib } = row.taken;
    let Expectation { seconds, memory_mib, .. } = row.expected;
    format!(
        "{}: {seconds:.1} s said, {processor_s:.1} s taken, × {:.2}; {memory_mib:.0} MiB said, {peak_mib:.0} held, × {:.2}",
        row.scene.name,
        seconds / processor_s,
        memory_mib / peak_mib
    )
}

const HELD: &str = "at_once,signal_mib,facets,beams,cells,paths,bart_rcs_s,fmcw_echo_s,dsp_s";

fn csv(rows: &[Row]) -> String {
    let counts: Vec<String> = Item::ALL.iter().map(|item| format!("{item:?}")).collect();
    let mut text = format!("scene,threads,said_s,taken_s,said_mib,taken_mib,{HELD},{}\n", counts.join(","));
    for Row { scene, expected, taken, held, paths, stages_s } in rows {
        let Held { at_once, signal_mib, facets, beams, cells } = held;
        let [bart_rcs_s, fmcw_echo_s, dsp_s] = stages_s;
        let threads = scene.threads.map_or("all".into(), |n| n.to_string());
        let counts: Vec<String> = expected.work.0.iter().map(|count| format!("{count:.0}")).collect();
        text += &format!(
            "{},{threads},{:.3},{:.3},{:.1},{:.1},{at_once},{signal_mib:.1},{facets:.0},{beams:.0},{cells:.0},{paths},\
             {bart_rcs_s:.3},{fmcw_echo_s:.3},{dsp_s:.3},{}\n",
            scene.name,
            expected.seconds,
            taken.processor_s,
            expected.memory_mib,
            taken.peak_mib,
            counts.join(",")
        );
    }
    text
}
