//! Processor time, all threads together: other work beside does not count.

/// Processor time of the process, from `/proc/self/task/*/schedstat` (nanoseconds on a processor come
/// first).
pub(crate) fn processor_seconds() -> Result<f64, Box<dyn std::error::Error>> {
    let mut nanoseconds = 0;
    for task in std::fs::read_dir("/proc/self/task")? {
        let text = std::fs::read_to_string(task?.path().join("schedstat"))?;
        nanoseconds += text.split_whitespace().next().map_or(Ok(0), str::parse::<u64>)?;
    }
    Ok(nanoseconds as f64 * 1e-9)
}
