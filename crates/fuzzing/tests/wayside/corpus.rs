//! Corpus: valid files to be changed, made in the folder `sound` when they are first asked for.

use crate::commands::execute;
use crate::envelope::{Envelope, encoded};
use artifact::dataset::{Crop, CropFormat, Dataset, Sample, Split};
use artifact::model::{Learner, Model, ModelHeader, NetworkShape, Weights};
use artifact::settings::Class;
use artifact::signature::{Signature, SignatureCell};
use classifier::{ARCHITECTURE, Layout, Parameters, Values};
use std::path::{Path, PathBuf};

/// A scene that takes a tenth of a second: a small radar, a plate and a point.
pub(crate) const SMALL_SCENE: &str = "name = \"small\"\nseed = 3\nframes = 2\n\
[radar.waveform]\nsamples = 32\nchirps = 16\n[radar.array]\npreset = \"1x4\"\n[noise]\n\
noise_figure_db = 12.0\n\
[dsp]\ntraining_cells = [3, 6]\n[fidelity]\nbounces = 1\n\
[[target]]\nkind = \"mesh\"\nid = \"plate\"\nclass = \"car\"\nmodel = \"plate.obj\"\n\
position_m = [-2.0, 20.0, 0.0]\nvelocity_mps = [0.0, -3.0, 0.0]\n\
[[target]]\nkind = \"point\"\nid = \"reflector\"\nrcs_m2 = 100.0\nposition_m = [2.0, 15.0, 1.0]\n\
velocity_mps = [0.0, 0.0, 0.0]\n";

const PLATE: &str = "v 0 -0.5 0\nv 0 0.5 0\nv 0 0.5 0.5\nv 0 -0.5 0.5\nf 1 2 3 4\n";

/// A study of two designs.
pub(crate) const STUDY: &str = "scene = \"sound/small.toml\"\nrepeats = 2\n[[vary]]\n\
key = \"radar.array.preset\"\n\
values = [\"1x4\", \"3x4\"]\n[goal]\nmetric = \"coverage\"\n";

/// A recipe of two scenes.
pub(crate) const RECIPE: &str = "scene = \"sound/base.toml\"\nseed = 1\nscenes_per_class = 2\n\
range_m = [25.0, 45.0]\n\
speed_mps = [1.0, 5.0]\nlanes = [1, 2]\n[models]\ncar = [\"sound/plate.obj\"]\n";

const BASE: &str = "name = \"base\"\n[radar.waveform]\nsamples = 64\nchirps = 16\n[radar.array]\n\
preset = \"1x4\"\n\
[dsp]\ntraining_cells = [3, 6]\n[fidelity]\nbounces = 1\n";

/// A sound file or folder of this name, made where it is not there yet.
pub(crate) fn place(folder: &Path, name: &str, make: fn(&Path)) -> PathBuf {
    let place = folder.join("sound").join(name);
    if !place.exists() {
        texts(folder);
        make(folder);
    }
    place
}

/// Scenes and a mesh.
pub(crate) fn texts(folder: &Path) {
    let sound = folder.join("sound");
    std::fs::create_dir_all(&sound).unwrap();
    let tables = SMALL_SCENE.replace("bounces = 1", "bounces = 1\necho = \"rcs-table\"");
    for (name, text) in [
        ("small.toml", SMALL_SCENE),
        ("plate.obj", PLATE),
        ("tables.toml", &tables),
        ("base.toml", BASE),
        ("study.toml", &STUDY.replace("sound/", "")),
        ("recipe.toml", &RECIPE.replace("sound/", "")),
    ] {
        std::fs::write(sound.join(name), text).unwrap();
    }
}

/// Carries out a command that makes something sound.
pub(crate) fn run_ok(folder: &Path, words: &str) {
    execute(folder, words).unwrap_or_else(|failure| panic!("{words}: {failure}"));
}

/// An artifact of a run of the small scene.
pub(crate) fn of_run(folder: &Path, file: &str) -> PathBuf {
    place(folder, &format!("run/{file}"), |at| {
        run_ok(at, "run @sound/small.toml --no-cache --out @sound/run");
        run_ok(at, "run @sound/tables.toml --no-cache --out @sound/tables");
        let rcs = at.join("sound/tables/frames.rcs");
        std::fs::copy(rcs, at.join("sound/run/frames.rcs")).unwrap();
    })
}

/// Points of a run with their labels in the layouts of both sets, `kitti` and `nuscenes`.
pub(crate) fn labels(folder: &Path) {
    of_run(folder, "frames.points");
    place(folder, "kitti", |at| exported(at, "kitti"));
    place(folder, "nuscenes", |at| exported(at, "nuscenes"));
}

fn exported(folder: &Path, set: &str) {
    let points = "@sound/run/frames.points --scene @sound/run/scene.scene";
    run_ok(folder, &format!("export {points} --to {set} --out @sound/{set}"));
}

/// The model that ships, with its first trees alone.
pub(crate) fn trees(folder: &Path) -> PathBuf {
    place(folder, "trees.model", |at| {
        let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/classifier.model");
        let mut envelope = Envelope::parse(&std::fs::read(shipped).unwrap());
        let weights: Weights = envelope.decoded(2).unwrap();
        let Weights::Trees(mut trees) = weights else { panic!("trees ship") };
        trees.trees.truncate(3);
        envelope.records[2] = encoded(&Weights::Trees(trees));
        std::fs::write(at.join("sound/trees.model"), envelope.to_file_bytes()).unwrap();
    })
}

/// Networks over range cells, trained for moments on the sound dataset.
pub(crate) fn profile(folder: &Path) -> PathBuf {
    dataset(folder);
    place(folder, "profile.model", |at| {
        run_ok(at, "train @sound/d --learner profile --out @sound/profile");
        std::fs::copy(at.join("sound/profile/weights.model"), at.join("sound/profile.model")).unwrap();
    })
}

const FORMAT: CropFormat =
    CropFormat { side: 16, range_span_m: 24.0, velocity_span_mps: 8.0, floor_db: 0.0, ceiling_db: 50.0 };

/// The smallest network.
pub(crate) fn network(folder: &Path) -> PathBuf {
    place(folder, "network.model", |at| {
        let shape = NetworkShape {
            format: FORMAT,
            architecture: ARCHITECTURE.into(),
            channels: vec![1, 2, 1],
            input_side: 8,
        };
        let header = ModelHeader {
            classes: Class::ALL.to_vec(),
            learner: Learner::CropNetwork(shape),
            least_probability: 0.5,
            frame_correlation: 0.5,
            attributions: vec!["nobody".into()],
        };
        let layout = Layout::of(&header).unwrap();
        let tensor = |(name, shape): (String, Vec<usize>)| {
            let values = vec![0.25; shape.iter().product()];
            (name, Values { shape, values })
        };
        let parameters = Parameters::new(layout.tensors().into_iter().map(tensor).collect());
        let weights = parameters.to_weights().unwrap();
        let envelope = Envelope::new::<Model>(&header, &[weights]);
        std::fs::write(at.join("sound/network.model"), envelope.to_file_bytes()).unwrap();
    })
}

/// A shard of samples of four classes.
pub(crate) fn dataset(folder: &Path) -> PathBuf {
    place(folder, "d/shard-0000.dataset", |at| {
        let samples: Vec<Sample> = (0..24).map(sample).collect();
        let envelope = Envelope::new::<Dataset>(&FORMAT, &samples);
        std::fs::create_dir_all(at.join("sound/d")).unwrap();
        std::fs::write(at.join("sound/d/shard-0000.dataset"), envelope.to_file_bytes()).unwrap();
    })
}

fn sample(number: u64) -> Sample {
    let class = number as usize % 4;
    let cell =
        |i: u32| SignatureCell { level_db: (10 + i) as f32, coherence: 0.5, ..SignatureCell::default() };
    let cells = (0..4 + 2 * class as u32).map(cell).collect();
    let signature = Signature { range_m: 40.0, cell_m: 0.12, points: 1, cells, ..Signature::default() };
    Sample {
        id: format!("scene-{number}"),
        signature,
        crop: Some(Crop { pixels: vec![class as u8; 256], range_m: 40.0, radial_velocity_mps: 0.0 }),
        class: Some(Class::ALL[class]),
        model: format!("model-{}", number % 8),
        variant: number % 3,
        scene: number,
        target: 0,
        frame: 0,
        split: [Split::Train, Split::Train, Split::Validation, Split::Test][number as usize / 4 % 4],
        range_m: 40.0,
        radial_velocity_mps: 0.0,
        lane: Some(2),
        seed: number,
    }
}
