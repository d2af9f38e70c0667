//! Expected time and memory of a run: the work of its stages, counted before it begins, at rates that were
//! measured on many scenes.

pub mod machine_speed;
pub mod rates;
mod counting;
mod tracer_work;
pub mod work;

use crate::chain::cache::Cache;
use crate::chain::link::Chain;
use crate::chain::plan::FramePlan;
use crate::host::failure::Failure;
use work::WorkCounts;

/// Expected work, time and memory of all frames of a run.
pub struct Expectation {
    /// Counts of the work by kind.
    pub work: WorkCounts,
    /// Processor seconds at the speed of the machine, all threads together.
    pub seconds: f64,
    /// Part of these seconds that the program's start takes, once for however many scenes.
    pub start_seconds: f64,
    /// Counts of what is expected to be held ([`Load::held`](crate::chain::memory_estimate::Load::held)).
    pub held: [f64; rates::HELD_KINDS],
    /// Memory that is expected to be held when most is, MiB.
    pub expected_memory_mib: f64,
    /// Memory held at most, MiB, frames that are computed side by side together.
    pub memory_mib: f64,
}

impl Expectation {
    /// Expects the frames of these plans on this machine.
    pub fn of(chain: &Chain, cache: Option<&Cache>, plans: &[FramePlan]) -> Result<Self, Failure> {
        Self::at_speed(chain, cache, plans, machine_speed::of_this_machine(cache)?)
    }

    /// Expects the frames of these plans on a machine of the given speed; 1 is the machine of the rates.
    pub fn at_speed(
        chain: &Chain,
        cache: Option<&Cache>,
        plans: &[FramePlan],
        machine_speed: f64,
    ) -> Result<Self, Failure> {
        let work = counting::of_run(chain, cache, plans)?;
        let seconds = rates::reference_seconds(&work) / machine_speed;
        let start_seconds = rates::SECONDS[work::WorkKind::Run as usize].1 / machine_speed;
        let (memory_mib, held) = chain.memory_of_run(plans)?;
        let expected_memory_mib = rates::expected_mib(&held).min(memory_mib);
        Ok(Self { work, seconds, start_seconds, held, expected_memory_mib, memory_mib })
    }
}

/// Lines about the plans: the stages that run in each frame, and the expected time and memory of all.
pub fn lines(chain: &Chain, cache: Option<&Cache>, plans: &[FramePlan]) -> Result<Vec<String>, Failure> {
    let of_frame = |plan: &FramePlan| {
        let running: Vec<&str> =
            plan.steps.iter().filter(|(_, why)| why.is_some()).map(|(stage, _)| stage.name()).collect();
        let stages = if running.is_empty() { "nothing".into() } else { running.join(", ") };
        format!("frame {}: runs {stages}", plan.index)
    };
    let mut lines: Vec<String> = plans.iter().map(of_frame).collect();
    let expected = Expectation::of(chain, cache, plans)?;
    let threads = rayon::current_num_threads();
    lines.push(format!(
        "{} frames: {} s, {} to {} s of processor time; about {} s on {threads} threads; about {:.0} \
         MiB, at most {:.0} MiB",
        plans.len(),
        told(expected.seconds),
        told(expected.seconds / rates::SPREAD),
        told(expected.seconds * rates::SPREAD),
        told(rates::wall_seconds(expected.seconds, threads)),
        expected.expected_memory_mib,
        expected.memory_mib,
    ));
    Ok(lines)
}

/// Text of seconds to two digits.
fn told(seconds: f64) -> String {
    let digits = (1.0 - seconds.max(0.1).log10().floor()).max(0.0) as usize;
    format!("{seconds:.digits$}")
}
