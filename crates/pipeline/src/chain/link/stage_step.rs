//! One stage's step of a frame: taken from the cache, or computed and stored there, with its time.

use crate::chain::cache::Cache;
use crate::chain::keys::Key;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use artifact::Schema;
use std::time::Instant;

/// A stage's value of a frame.
pub(super) struct Step<T> {
    pub(super) value: T,
    /// Whether it came from the cache.
    pub(super) cached: bool,
}

impl<T> Step<T> {
    pub(super) fn map<U>(self, convert: impl FnOnce(T) -> U) -> Step<U> {
        Step { value: convert(self.value), cached: self.cached }
    }
}

/// Frames of the stages of one scene in the cache, if there is one.
pub(super) struct StageFrames<'a> {
    pub(super) cache: Option<&'a Cache>,
    /// Last stage whose frames are read from and written to the cache.
    pub(super) cached_to: Stage,
    /// Name of the scene.
    pub(super) scene: &'a str,
}

impl StageFrames<'_> {
    /// Takes a stage's frame from the cache, or computes and stores it.
    pub(super) fn step<S: Schema>(
        &self,
        stage: Stage,
        (frame, key): (u32, &Key),
        header: &S::Header,
        compute: impl FnOnce() -> Result<S::Frame, Failure>,
    ) -> Result<Step<S::Frame>, Failure> {
        // The lookup is repeated even if the plan found nothing: an equal frame of this run may have stored
        // it since.
        let cache = self.cache.filter(|_| stage <= self.cached_to);
        if let Some(value) = cache.and_then(|cache| cache.get::<S>(stage, key)) {
            return Ok(Step { value, cached: true });
        }
        let value = compute()?;
        if let Some(cache) = cache {
            cache.put::<S>(stage, key, header, &value);
            cache.remember_key(stage, self.scene, frame, key);
        }
        Ok(Step { value, cached: false })
    }
}

/// Seconds of each stage of a frame, and which of them came from the cache.
#[derive(Default)]
pub(super) struct StageTimes {
    pub(super) seconds: Vec<(Stage, f64)>,
    pub(super) cached: Vec<Stage>,
}

impl StageTimes {
    /// Runs a stage's step and records its wall-clock time.
    pub(super) fn time<T>(
        &mut self,
        stage: Stage,
        work: impl FnOnce() -> Result<Step<T>, Failure>,
    ) -> Result<T, Failure> {
        let start = Instant::now();
        let step = work()?;
        self.seconds.push((stage, start.elapsed().as_secs_f64()));
        if step.cached {
            self.cached.push(stage);
        }
        Ok(step.value)
    }
}
