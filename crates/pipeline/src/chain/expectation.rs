//! Expected time and memory of a run: the work of its stages, counted in advance, at rates measured on many
//! scenes.

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
    /// Part of these seconds that the program's start takes, once for any number of scenes.
    pub start_seconds: f64,
    /// Counts of the expected contents of memory
    /// ([`MemoryLoad::held`](crate::chain::memory_estimate::MemoryLoad::held)).
    pub held: [f64; rates::HELD_KINDS],
    /// Expected peak memory, MiB.
    pub expected_memory_mib: f64,
    /// Upper limit of the peak memory, MiB, of all frames computed side by side.
    pub memory_mib: f64,
}

impl Expectation {
    /// Estimates the frames of these plans on this machine.
    pub fn of(chain: &Chain, cache: Option<&Cache>, plans: &[FramePlan]) -> Result<Self, Failure> {
        Self::at_speed(chain, cache, plans, machine_speed::of_this_machine(cache)?)
    }

    /// Estimates the frames of these plans on a machine of the given speed; 1 is the reference machine of the
    /// rates.
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

/// Expected time and memory of consecutive runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedTotal {
    frames: usize,
    seconds: f64,
    start_seconds: f64,
    expected_memory_mib: f64,
    memory_mib: f64,
}

impl ExpectedTotal {
    /// Total of one run of the given number of frames.
    pub fn of(expected: &Expectation, frames: usize) -> Self {
        let Expectation { seconds, start_seconds, expected_memory_mib, memory_mib, .. } = *expected;
        Self { frames, seconds, start_seconds, expected_memory_mib, memory_mib }
    }

    /// Total of both runs: the program starts once, and the first run frees its memory before the second
    /// begins.
    pub fn and(self, next: Self) -> Self {
        Self {
            frames: self.frames + next.frames,
            seconds: self.seconds + next.seconds - next.start_seconds,
            start_seconds: self.start_seconds,
            expected_memory_mib: self.expected_memory_mib.max(next.expected_memory_mib),
            memory_mib: self.memory_mib.max(next.memory_mib),
        }
    }

    /// The last line of a dry run.
    pub fn line(&self) -> String {
        let threads = rayon::current_num_threads();
        format!(
            "{} frames: {} s, {} to {} s of processor time; about {} s on {threads} threads; about {:.0} \
             MiB, at most {:.0} MiB",
            self.frames,
            rounded(self.seconds),
            rounded(self.seconds / rates::SPREAD),
            rounded(self.seconds * rates::SPREAD),
            rounded(rates::wall_seconds(self.seconds, threads)),
            self.expected_memory_mib,
            self.memory_mib,
        )
    }
}

/// Lines about the stages that run in each frame; neighbouring frames with the same stages share a line.
pub fn lines(plans: &[FramePlan]) -> Vec<String> {
    let running = |plan: &FramePlan| -> Vec<&'static str> {
        plan.steps.iter().filter(|(_, why)| why.is_some()).map(|(stage, _)| stage.name()).collect()
    };
    let alike = plans.chunk_by(|a, b| running(a) == running(b));
    let line = |plans: &[FramePlan]| {
        let [first, .., last] = plans else {
            return plans.first().map(|plan| format!("frame {}: runs {}", plan.index, named(&running(plan))));
        };
        Some(format!("frames {} to {}: runs {}", first.index, last.index, named(&running(first))))
    };
    alike.filter_map(line).collect()
}

fn named(stages: &[&str]) -> String {
    if stages.is_empty() { "nothing".into() } else { stages.join(", ") }
}

/// Text of seconds to two digits.
fn rounded(seconds: f64) -> String {
    let digits = (1.0 - seconds.max(0.1).log10().floor()).max(0.0) as usize;
    format!("{seconds:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_one_after_the_other_start_once_and_hold_what_the_largest_holds() {
        let of = |frames, seconds, memory_mib| ExpectedTotal {
            frames,
            seconds,
            start_seconds: 0.5,
            expected_memory_mib: 0.5 * memory_mib,
            memory_mib,
        };
        assert_eq!(of(2, 3.0, 400.0).and(of(5, 2.0, 700.0)), of(7, 4.5, 700.0));
        assert!(of(7, 4.5, 700.0).line().starts_with("7 frames: 4.5 s, "));
    }
}
