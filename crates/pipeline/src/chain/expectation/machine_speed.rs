//! Speed of this machine relative to the reference machine of the rates: a small table of a motorcycle,
//! traced until half a processor second is spent; once for each machine and build, kept in the cache.

use crate::chain::cache::Cache;
use crate::chain::keys::Key;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use crate::host::processor_time;
use artifact::{Accuracy, Schema};
use bart_rcs::RcsRequest;
use std::sync::OnceLock;

/// Speed of a machine as an artifact: no header, one record of one number.
struct MachineSpeed;

impl Schema for MachineSpeed {
    const NAME: &'static str = "speed";
    const VERSION: u32 = 1;
    const RECORD_LIMIT: u64 = 1 << 10;
    type Header = ();
    type Frame = f64;
}

/// Processor seconds of that work on the reference machine.
const REFERENCE_S: f64 = 0.64;
/// Least processor seconds of a measurement.
const MEASURED_S: f64 = 0.5;

/// Speed of this machine: 1 for the reference machine, 2 for one twice as fast; 1 where the system does not
/// report processor time.
pub fn of_this_machine(cache: Option<&Cache>) -> Result<f64, Failure> {
    let key = key();
    if let Some(known) = cache.and_then(|c| c.get::<MachineSpeed>(Stage::BartRcs, &key)).filter(is_sound) {
        return Ok(known);
    }
    // Once in a process, for any number of runs.
    static MEASURED: OnceLock<f64> = OnceLock::new();
    let speed = match MEASURED.get() {
        Some(speed) => *speed,
        None => *MEASURED.get_or_init({
            let speed = measured()?;
            move || speed
        }),
    };
    if let (Some(cache), true) = (cache, is_sound(&speed)) {
        cache.put::<MachineSpeed>(Stage::BartRcs, &key, &(), &speed);
    }
    Ok(speed)
}

fn is_sound(speed: &f64) -> bool {
    (1e-3..=1e3).contains(speed)
}

/// Key of the machine: the processor's name.
fn key() -> Key {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let processor = text.lines().find(|line| line.starts_with("model name")).unwrap_or_default();
    Key::of(Stage::BartRcs, vec![("machine", artifact::envelope::fingerprint(&processor))])
}

/// Measures the present speed of this machine; 1 where the system does not report processor time.
pub fn measured() -> Result<f64, Failure> {
    let Some(begin) = processor_time::of_process() else { return Ok(1.0) };
    let mesh = scene::vehicles::mesh("motorcycle-scooter", 0);
    let mesh =
        mesh.ok_or_else(|| Failure::refused("the motorcycle that speeds are measured with is missing"))?;
    let mut count = 0.0;
    loop {
        bart_rcs::rcs(&mesh, &request(), &|_, _| ()).map_err(Failure::refused)?;
        count += 1.0;
        let spent_s = processor_time::of_process().unwrap_or(f64::INFINITY) - begin;
        if spent_s >= MEASURED_S {
            return Ok(REFERENCE_S * count / spent_s);
        }
    }
}

fn request() -> RcsRequest {
    RcsRequest {
        range_m: 30.0,
        bounces: 2,
        accuracy: Accuracy::from_db(-20.0),
        ..RcsRequest::over(vec![77e9], vec![0.15], vec![0.4])
    }
}
