//! Work of the library beside the interpreter: on a thread of its own, so that Ctrl-C is heard at once and
//! progress is told, while other threads of Python go on.

use crate::arguments::numbers;
use crate::failure;
use pyo3::prelude::*;
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};
use wayside::host::progress::{self, Caller};
use wayside::{Cancellation, Failure};

/// Steps in which the work is looked at: Ctrl-C is heard within one.
const POLL_INTERVAL: Duration = Duration::from_millis(50);
/// Time that cancelled work has to end; a frame under way goes on behind it and is thrown away.
const ENDING: Duration = Duration::from_millis(500);

/// Process whose threads the library works with; 0 where it has none yet.
static WORKS_IN: AtomicU32 = AtomicU32::new(0);

/// Claims the threads that the library works with for this process.
///
/// # Errors
/// They were left in the process that this one was forked from: work would wait for them for ever.
pub(crate) fn claim_threads() -> PyResult<()> {
    let here = std::process::id();
    let _ = WORKS_IN.compare_exchange(0, here, Ordering::Relaxed, Ordering::Relaxed);
    has_threads()
}

fn has_threads() -> PyResult<()> {
    let works_in = WORKS_IN.load(Ordering::Relaxed);
    if works_in == 0 || works_in == std::process::id() {
        return Ok(());
    }
    let rule = "this process was forked from one in which wayside had worked, and has none of its threads: \
                begin processes by \"spawn\" or \"forkserver\", multiprocessing.get_context(\"spawn\"), or \
                before the first work";
    Err(pyo3::exceptions::PyRuntimeError::new_err(rule))
}

/// A listener of progress, and the share of the whole that the reported work is.
#[derive(Clone, Copy)]
pub(crate) struct ProgressListener<'a, 'py> {
    listener: Option<&'a Bound<'py, PyAny>>,
    from: f64,
    to: f64,
}

impl<'a, 'py> ProgressListener<'a, 'py> {
    /// Listener of the work as the whole.
    pub(crate) fn all(listener: Option<&'a Bound<'py, PyAny>>) -> Self {
        Self { listener, from: 0.0, to: 1.0 }
    }

    /// Listener of a part of this work, between these two shares of it.
    pub(crate) fn part(self, shares: [f64; 2]) -> Self {
        let [from, to] = shares.map(|share| self.of_whole(share));
        Self { from, to, ..self }
    }

    fn of_whole(self, share: f64) -> f64 {
        (self.from + share * (self.to - self.from)).min(self.to)
    }

    fn tell(self, text: &str, share: f64) -> PyResult<()> {
        let Some(listener) = self.listener else { return Ok(()) };
        listener.call1((text, self.of_whole(share))).map(drop)
    }

    /// Tells that the whole is done, where this was its last part.
    fn end(self) -> PyResult<()> {
        if self.to >= 1.0 { self.tell("done", 1.0) } else { Ok(()) }
    }
}

/// Carries work out, by all threads, while the interpreter does something else. `listener` is told what is
/// under way and its share, about twenty times a second, and once more at the end with a share of 1; the
/// share never falls. `files` are those that the work was given, first the one that a failure is about which
/// names none.
///
/// # Errors
/// Exceptions of failures, of Ctrl-C, and of the listener of progress; a process without threads.
pub(crate) fn carry_out<T: Send + 'static>(
    py: Python<'_>,
    files: &[Option<&Path>],
    listener: ProgressListener<'_, '_>,
    work: impl FnOnce(&Cancellation) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    claim_threads()?;
    read(py, files, listener, work)
}

/// Carries work out that needs no other threads, as [`carry_out`] does: a process may be forked after it.
///
/// # Errors
/// Those of [`carry_out`].
pub(crate) fn read<T: Send + 'static>(
    py: Python<'_>,
    files: &[Option<&Path>],
    listener: ProgressListener<'_, '_>,
    work: impl FnOnce(&Cancellation) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    has_threads()?;
    let cancellation = Cancellation::default();
    let (sender, mut results) = channel();
    let (asked, caller) = (cancellation.clone(), Caller::unique());
    let thread = std::thread::spawn(move || sender.send(caller.during(|| work(&asked))).is_ok());
    let mut told = 0.0;
    let result = loop {
        match receive_within(py, &mut results, POLL_INTERVAL) {
            Ok(result) => break result,
            Err(RecvTimeoutError::Disconnected) => return Err(panic_error(thread)),
            Err(RecvTimeoutError::Timeout) => poll(py, (listener, &mut told), caller).inspect_err(|_| {
                cancellation.cancel();
                let _ = receive_within(py, &mut results, ENDING);
            })?,
        }
    };
    let result = result.map_err(|failure| failure::exception_of(py, &failure, files))?;
    listener.end()?;
    Ok(result)
}

/// A result that comes within a time, for which the interpreter is let go.
fn receive_within<T: Send>(
    py: Python<'_>,
    results: &mut Receiver<Result<T, Failure>>,
    time: Duration,
) -> Result<Result<T, Failure>, RecvTimeoutError> {
    py.detach(move || results.recv_timeout(time))
}

/// Exception of a thread that ended without a result: a bug of the library.
fn panic_error(thread: std::thread::JoinHandle<bool>) -> PyErr {
    let said = thread.join().err().and_then(|panic| panic.downcast::<String>().ok());
    let said = said.map_or_else(|| "it says nothing".to_owned(), |text| *text);
    pyo3::exceptions::PyRuntimeError::new_err(format!("a bug of wayside: {said}"))
}

fn poll(
    py: Python<'_>,
    (listener, told): (ProgressListener<'_, '_>, &mut f64),
    caller: Caller,
) -> PyResult<()> {
    py.check_signals()?;
    let Some(state) = progress::state_for(caller, Instant::now(), Duration::ZERO) else { return Ok(()) };
    *told = told.max(state.share);
    listener.tell(&state.text, *told)
}

/// Sends the remarks of the library to the logger `wayside` from now on.
pub(crate) fn listen() {
    progress::listen(|text| {
        let tell = |py: Python<'_>| -> PyResult<()> {
            let logger = py.import("logging")?.call_method1("getLogger", ("wayside",))?;
            logger.call_method1("info", ("%s", text)).map(drop)
        };
        let _ = Python::try_attach(tell);
    });
}

/// Limits the threads that the library works with; once, before the first work.
#[pyfunction]
#[pyo3(signature = (threads))]
pub(crate) fn set_threads(threads: &Bound<'_, PyAny>) -> PyResult<()> {
    let threads = numbers::whole("threads", threads, &numbers::THREADS)? as usize;
    claim_threads()?;
    let built = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
    built.map_err(|error| failure::argument_error("threads", error))
}

/// Removes the temporary files of work that was called off and is still under way.
#[pyfunction]
pub(crate) fn withdraw() {
    drop(artifact::atomic_file::remove_all_temporaries()); // the interpreter may still end other work
}
