//! Class `Scene`: a scene that was read, and everything that is made of it.

use crate::arguments::document;
use crate::arguments::document::Document;
use crate::arguments::numbers;
use crate::cube::Cube;
use crate::detections::Detections;
use crate::dictionaries;
use crate::failure;
use crate::paths::Paths;
use crate::range_doppler::RangeDoppler;
use crate::shared::handle::{Handle, opened_by, scene_source_exception};
use crate::shared::source_files::SourceFiles;
use crate::tracks::Tracks;
use crate::work::{ProgressListener, carry_out, claim_threads, read};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use wayside::host::memory::Allowance;
use wayside::stepwise::bounds::SCENE_ACCURACIES_DB;
use wayside::stepwise::{OpenedScene, echoes, echoes_of_paths, extensions, paths, radars};
use wayside::{CacheLocation, Cancellation, Failure, SceneSource, Settings};

/// A virtual traffic intersection and the radar that looks at it.
///
/// `source` is the path of a TOML file, or a dictionary with the same keys, whose files are seen from
/// `folder`. `radar` names one of several, `model` replaces the model of every target, `seed` and
/// `accuracy_db` the scene's; `memory_limit_mib` is the memory that tracing may take. Raises WaysideError
/// with every broken rule.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct Scene {
    handle: Py<Handle>,
}

impl Scene {
    fn read(&self) -> &Handle {
        self.handle.get()
    }

    /// Carries out work of the library on the opened scene.
    fn with_opened<T: Send + 'static>(
        &self,
        py: Python<'_>,
        listener: ProgressListener<'_, '_>,
        work: impl FnOnce(&OpenedScene, &Cancellation) -> Result<T, Failure> + Send + 'static,
    ) -> PyResult<T> {
        let opened = self.read().opened(py)?;
        let document = Arc::clone(&self.read().document);
        carry_out(py, &[self.read().message_path()], listener, move |cancellation| {
            work(&opened, cancellation).map_err(|failure| document.named_failure(failure))
        })
    }

    /// Cubes of all frames, of paths where these are given.
    fn cubes(
        &self,
        py: Python<'_>,
        of: Option<&Bound<'_, Paths>>,
        listener: ProgressListener<'_, '_>,
    ) -> PyResult<Cube> {
        let traced = of.map(|paths| Arc::clone(&paths.get().all));
        let recorded = self.with_opened(py, listener, move |opened, cancellation| match traced {
            Some(traced) => echoes_of_paths(opened, &traced, cancellation),
            None => echoes(opened, cancellation),
        })?;
        Cube::of(py, recorded)
    }

    /// Maps of all frames, with all that stands before them.
    fn maps(&self, py: Python<'_>, listener: ProgressListener<'_, '_>) -> PyResult<RangeDoppler> {
        let cube = self.cubes(py, None, listener.part(BEFORE_LAST))?;
        cube.maps(py, listener.part(LAST))
    }

    /// Points and objects of all frames, likewise.
    fn found(&self, py: Python<'_>, listener: ProgressListener<'_, '_>) -> PyResult<Detections> {
        let maps = self.maps(py, listener.part(BEFORE_LAST))?;
        maps.found(py, listener.part(LAST))
    }
}

/// Shares of the work between which all stages but the last one are, as a rule.
const BEFORE_LAST: [f64; 2] = [0.0, 0.95];
/// Shares of the work between which the last of its stages is, as a rule.
const LAST: [f64; 2] = [0.95, 1.0];

/// Opens a scene; nothing is opened of one that has several radars of which none was asked for.
fn opened(
    source: &SceneSource,
    memory: Allowance,
) -> Result<(SourceFiles, Option<Arc<OpenedScene>>), Failure> {
    let has_several = source.radar.is_none() && radars(source).is_ok_and(|ids| !ids.is_empty());
    let scene = if has_several { None } else { Some(opened_by(source, memory)?) };
    Ok((SourceFiles::of(source, scene.as_deref())?, scene))
}

/// The cache that was asked for: `True` is the default one, `False` none, a path that folder.
fn cache(asked: &Bound<'_, PyAny>) -> PyResult<Option<CacheLocation>> {
    if let Ok(is_used) = asked.extract::<bool>() {
        return Ok(is_used.then(CacheLocation::default));
    }
    Ok(Some(CacheLocation { folder: Some(asked.extract()?), ..CacheLocation::default() }))
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (source, *, folder=None, radar=None, model=None, seed=None, accuracy_db=None,
        memory_limit_mib=None, progress=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python, each with a name where it is given")]
    fn new(
        py: Python<'_>,
        source: &Bound<'_, PyAny>,
        folder: Option<PathBuf>,
        radar: Option<String>,
        model: Option<PathBuf>,
        seed: Option<&Bound<'_, PyAny>>,
        accuracy_db: Option<f64>,
        memory_limit_mib: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let accuracy_db =
            accuracy_db.map(|db| document::accuracy_db(db, &SCENE_ACCURACIES_DB)).transpose()?;
        let seed = seed.map(|seed| numbers::whole("seed", seed, &numbers::SEEDS)).transpose()?;
        let memory = Allowance::of(numbers::memory_mib(memory_limit_mib)?);
        let document = Arc::new(Document::of(source, folder)?);
        let source = SceneSource { file: document.file.clone(), model, radar, seed, accuracy_db };
        let asked = source.clone();
        let opened = read(py, &[document.message_path()], ProgressListener::all(progress), move |_| {
            Ok(opened(&asked, memory))
        })?;
        let refused =
            |failure| scene_source_exception(py, &document.named_failure(failure), &document, &source);
        let (source_files, scene) = opened.map_err(refused)?;
        if scene.as_ref().is_some_and(|scene| scene.is_looked_at()) {
            claim_threads()?;
        }
        Ok(Self { handle: Py::new(py, Handle { document, source, memory, source_files, scene })? })
    }

    /// Scene as other classes take it.
    #[getter]
    fn _handle(&self, py: Python<'_>) -> Py<Handle> {
        self.handle.clone_ref(py)
    }

    /// Text of the scene as TOML, which `wayside run` takes.
    #[getter]
    fn toml(&self) -> &str {
        &self.read().source_files.text
    }

    /// Name of the scene.
    #[getter]
    fn name(&self, py: Python<'_>) -> PyResult<String> {
        Ok(self.read().opened(py)?.header().name.clone())
    }

    /// Seed of the noise and of everything random.
    #[getter]
    fn seed(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.read().opened(py)?.header().seed)
    }

    /// Number of frames.
    #[getter]
    fn frames(&self, py: Python<'_>) -> PyResult<u32> {
        Ok(self.read().opened(py)?.header().frames)
    }

    /// Ids of the targets.
    #[getter]
    fn targets(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.read().opened(py)?.header().targets.iter().map(|target| target.id.clone()).collect())
    }

    /// Ids of several radars; empty where the scene has one.
    #[getter]
    fn radars(&self) -> Vec<String> {
        self.read().source_files.radars.clone()
    }

    /// The radar in the words of the field, as `radar` of summary.json: carrier_hz, bandwidth_hz,
    /// range_resolution_m, velocity_max_mps and more.
    #[getter]
    fn radar<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let told = serde_json::to_string(&self.read().opened(py)?.radar());
        dictionaries::json(py, &told.map_err(|error| failure::argument_error("radar", error))?)
    }

    /// Cost that a run of all frames is expected to have, before anything runs.
    ///
    /// frames, processor_s, processor_from_s, processor_to_s (nine of ten runs lie between), wall_s, threads,
    /// expected_memory_mib (held when most is), memory_mib (no more is held).
    fn cost<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let cost = self.with_opened(py, ProgressListener::all(None), |opened, _| opened.cost())?;
        let [from, to] = cost.processor_between_s;
        let told = PyDict::new(py);
        told.set_item("frames", cost.frames)?;
        told.set_item("processor_s", cost.processor_s)?;
        told.set_item("processor_from_s", from)?;
        told.set_item("processor_to_s", to)?;
        told.set_item("wall_s", cost.wall_s)?;
        told.set_item("threads", cost.threads)?;
        told.set_item("expected_memory_mib", cost.expected_memory_mib)?;
        told.set_item("memory_mib", cost.memory_mib)?;
        Ok(told)
    }

    /// Scattering paths of every frame, as `wayside paths` traces them.
    #[pyo3(signature = (*, progress=None))]
    fn trace(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Paths> {
        Ok(Paths { all: Arc::new(self.with_opened(py, ProgressListener::all(progress), paths)?) })
    }

    /// Radar cubes of every frame, as `wayside echo` makes them; of `paths` where they are given.
    #[pyo3(signature = (paths=None, *, progress=None))]
    fn echo(
        &self,
        py: Python<'_>,
        paths: Option<&Bound<'_, Paths>>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Cube> {
        self.cubes(py, paths, ProgressListener::all(progress))
    }

    /// Range-Doppler maps of every frame.
    #[pyo3(signature = (*, progress=None))]
    fn range_doppler(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<RangeDoppler> {
        self.maps(py, ProgressListener::all(progress))
    }

    /// Points and objects of every frame.
    #[pyo3(signature = (*, progress=None))]
    fn detect(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Detections> {
        self.found(py, ProgressListener::all(progress))
    }

    /// Points of every frame, as `Detections.points`.
    #[pyo3(signature = (*, progress=None))]
    fn points<'py>(
        &self,
        py: Python<'py>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.found(py, ProgressListener::all(progress))?.points(py)
    }

    /// Objects of every frame, as `Detections.objects`.
    #[pyo3(signature = (*, progress=None))]
    fn objects<'py>(
        &self,
        py: Python<'py>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.found(py, ProgressListener::all(progress))?.objects(py)
    }

    /// Objects followed over the frames.
    #[pyo3(signature = (*, progress=None))]
    fn track(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Tracks> {
        let listener = ProgressListener::all(progress);
        self.found(py, listener.part(BEFORE_LAST))?.tracked(py, listener.part(LAST))
    }

    /// Classes of the objects, as `Detections.classify`.
    #[pyo3(signature = (model=None, *, progress=None))]
    fn classify<'py>(
        &self,
        py: Python<'py>,
        model: Option<PathBuf>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let listener = ProgressListener::all(progress);
        self.found(py, listener.part(BEFORE_LAST))?.classified(py, model, listener.part(LAST))
    }

    /// Runs everything and writes the files of `wayside run` into the folder `out`.
    ///
    /// Returns summary.json as a dictionary. `cache`: None or False for none, True for the default one, or a
    /// folder. `classifier` is a file or a folder of `wayside train`; the one that ships where it is left
    /// out.
    #[pyo3(signature = (out, *, cache=None, classifier=None, progress=None))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        out: PathBuf,
        cache: Option<&Bound<'py, PyAny>>,
        classifier: Option<PathBuf>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let Handle { document, memory, .. } = self.read();
        extensions::check_folder(&out)
            .map_err(|failure| failure::exception_of(py, &failure, &[Some(&out)]))?;
        let (scene, memory, folder) = (self.read().source_again(py)?, *memory, out.clone());
        let (document, model) = (Arc::clone(document), classifier.clone());
        let cache = cache.map(self::cache).transpose()?.flatten();
        let of_cache = cache.as_ref().and_then(|cache| cache.folder.clone());
        let files = [self.read().message_path(), Some(out.as_path()), model.as_deref(), of_cache.as_deref()];
        carry_out(py, &files, ProgressListener::all(progress), move |cancellation| {
            let of_file = Settings::of(&scene.file, folder);
            let cancellation = cancellation.clone();
            let settings = Settings { scene, cache, classifier, memory, cancellation, ..of_file };
            wayside::run(&settings).map(drop).map_err(|failure| document.named_failure(failure))
        })?;
        dictionaries::json(py, &std::fs::read_to_string(out.join("summary.json"))?)
    }

    fn __repr__(&self) -> String {
        let name = self.read().scene.as_ref().map(|opened| opened.header().name.clone());
        format!("<wayside.Scene {}>", name.unwrap_or_else(|| "of several radars".to_owned()))
    }
}
