//! One run of the program as a separate process, so that its processor time and peak size are its own.

use crate::processes::{ProcessCosts, costs_of};
use crate::project::this_program;
use artifact::Reader;
use artifact::paths::{Paths, PathsFrame};
use std::path::Path;
use std::process::Command;
use wayside::chain::expectation::machine_speed;
use wayside::host::failure::Failure;
use wayside::outcome::summary::{Stage, Summary};

/// Costs of a run, and the counts of its tracer.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeasuredCost {
    pub(super) processor_s: f64,
    pub(super) peak_mib: f64,
    /// Speed of the machine during the run, which depends on other load.
    pub(super) machine_speed: f64,
    /// Number of paths, and of lit polygons at the frames' middles, over all frames.
    pub(super) paths: f64,
    pub(super) beams: f64,
    /// Largest number of traced moments of a frame.
    pub(super) moments: f64,
    /// Largest memory reported by a frame's tracer.
    pub(super) traced_mib: f64,
    /// Wall-clock seconds of bart_rcs, fmcw_echo, dsp.
    pub(super) stages_s: [f64; 3],
}

/// Runs `run` on a scene without a cache; `None` if the system does not report the costs of a process.
pub(super) fn run(scene: &Path, out: &Path, threads: Option<u16>) -> Result<Option<MeasuredCost>, Failure> {
    let machine_speed = machine_speed::measured()?;
    let mut command = Command::new(this_program()?);
    command.arg("run").arg(scene).arg("--out").arg(out).args(["--no-cache", "--quiet"]);
    command.args(threads.iter().flat_map(|n| ["--threads".to_owned(), n.to_string()]));
    let _ = std::fs::remove_dir_all(out);
    let Some(costs) = costs_of(&mut command, scene.display())? else { return Ok(None) };
    Ok(Some(MeasuredCost { machine_speed, ..read_costs(out, costs)? }))
}

fn read_costs(
    out: &Path,
    ProcessCosts { processor_s, peak_mib }: ProcessCosts,
) -> Result<MeasuredCost, Failure> {
    let summary = Summary::read(&out.join("summary.json"))?;
    let seconds = |stage| summary.frames.iter().filter_map(|frame| frame.stage_seconds.get(&stage)).sum();
    let stages_s = [Stage::BartRcs, Stage::FmcwEcho, Stage::Dsp].map(seconds);
    let mut taken = MeasuredCost {
        processor_s,
        peak_mib,
        machine_speed: 1.0,
        paths: 0.0,
        beams: 0.0,
        moments: 1.0,
        traced_mib: 0.0,
        stages_s,
    };
    // A scene of tables has no paths.
    let file = out.join("frames.paths");
    if file.is_file() {
        for frame in Reader::<Paths>::open_own(&file)? {
            taken.add(&frame?);
        }
    }
    Ok(taken)
}

impl MeasuredCost {
    fn add(&mut self, frame: &PathsFrame) {
        self.paths += frame.paths.len() as f64;
        self.beams += frame.trace.beams.iter().sum::<u64>() as f64;
        let moments = frame.trace.fineness.as_ref().map_or(1, |fineness| fineness.moments);
        self.moments = self.moments.max(f64::from(moments));
        self.traced_mib = self.traced_mib.max(wayside::host::memory::mib(frame.trace.bytes));
    }
}
