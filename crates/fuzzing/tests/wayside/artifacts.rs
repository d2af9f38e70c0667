//! Artifacts of every kind, and the commands that read them.

use crate::commands::{run_scheduled_on_content, schedule};
use crate::corpus;
use crate::envelope::{Envelope, mutated_artifact};
use artifact::Schema;
use artifact::classes::{Classes, ClassesFrame, ClassesHeader};
use artifact::cube::Cube;
use artifact::dataset::Dataset;
use artifact::model::Model;
use artifact::paths::Paths;
use artifact::points::Points;
use artifact::rcs::Rcs;
use artifact::rdm::Rdm;
use artifact::scene::Scene;
use artifact::settings::Class;
use artifact::tracks::Tracks;
use fuzzing::{FuzzRng, Reader};
use std::path::{Path, PathBuf};

pub(crate) fn readers() -> Vec<Reader> {
    vec![
        reader::<Scene>(60),
        reader::<Paths>(60),
        reader::<Rcs>(60),
        reader::<Cube>(60),
        reader::<Rdm>(60),
        reader::<Points>(60),
        reader::<Tracks>(60),
        reader::<Dataset>(60),
        reader::<Model>(60),
        reader::<Classes>(60),
    ]
}

/// A kind of artifact with the commands that read it: `@F` is the changed one.
trait ArtifactKind: Schema {
    const COMMANDS: &'static [&'static str];

    /// Sound ones, of which one is changed.
    fn corpus(folder: &Path) -> Vec<PathBuf>;
}

fn reader<K: ArtifactKind>(cases: u64) -> Reader {
    Reader::refusing(K::NAME, cases, write::<K>, run_scheduled_on_content)
}

fn write<K: ArtifactKind>(rng: &mut FuzzRng, folder: &Path) {
    let sound = K::corpus(folder);
    let whole = std::fs::read(&sound[rng.below(sound.len())]).unwrap();
    // In a folder of its own: some commands read all that a folder holds.
    let file = format!("f/shard-0000.{}", K::NAME);
    std::fs::create_dir(folder.join("f")).unwrap();
    std::fs::write(folder.join(&file), mutated_artifact::<K>(rng, &whole)).unwrap();
    schedule(folder, &rng.choose(K::COMMANDS).replace("@F", &format!("@{file}")));
    // Whatever the command reads beside it.
    corpus::of_run(folder, "frames.points");
    corpus::profile(folder);
    corpus::trees(folder);
    corpus::network(folder);
    corpus::dataset(folder);
}

impl ArtifactKind for Scene {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to json --out @O",
        "score @sound/run/frames.points --scene @F",
        "export @sound/run/frames.points --to kitti --scene @F --out @O-kitti",
        "score @sound/run/frames.points --scene @F --paths @sound/run/frames.paths",
    ];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::of_run(folder, "scene.scene")]
    }
}

impl ArtifactKind for Paths {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to csv --out @O",
        "export @F --to json --out @O",
        "echo @sound/small.toml --paths @F --out @O",
        "score @sound/run/frames.points --scene @sound/run/scene.scene --paths @F",
    ];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::of_run(folder, "frames.paths")]
    }
}

impl ArtifactKind for Rcs {
    const COMMANDS: &'static [&'static str] =
        &["inspect @F", "export @F --to npy --out @O.npy", "export @F --to json --out @O"];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::of_run(folder, "frames.rcs")]
    }
}

impl ArtifactKind for Cube {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "dsp @F --out @O",
        "dsp @F --pictures --out @O",
        "export @F --to npy --out @O.npy",
        "export @F --to sigmf --out @O",
        "export @F --to dca1000 --out @O.bin",
        "export @F --to uwcr --out @O-set",
        "calibrate @F --at-m=2,15,1 --out @O.csv",
    ];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::of_run(folder, "frames.cube")]
    }
}

impl ArtifactKind for Rdm {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to npy --out @O.npy",
        "export @F --to exr --out @O.exr",
        "export @F --to png --out @O.png",
        "export @F --to png --axes on --out @O.png",
        "export @F --to raddet --scene @sound/run/scene.scene --out @O-raddet",
        "export @F --to carrada --out @O-carrada",
        "classify @sound/profile.model @F",
        "classify @sound/trees.model @F",
        "classify @sound/network.model @F",
    ];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::of_run(folder, "frames.rdm")]
    }
}

impl ArtifactKind for Points {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to csv --out @O",
        "export @F --to pcd --out @O",
        "export @F --to ply --out @O",
        "export @F --to kitti --scene @sound/run/scene.scene --out @O-kitti",
        "export @F --to nuscenes --out @O-nuscenes",
        "export @F --to json --out @O",
        "score @F --scene @sound/run/scene.scene",
        "score @F --scene @sound/run/scene.scene --paths @sound/run/frames.paths --tracks \
         @sound/run/frames.tracks",
    ];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::of_run(folder, "frames.points")]
    }
}

impl ArtifactKind for Tracks {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to csv --out @O",
        "export @F --to json --out @O",
        "score @sound/run/frames.points --scene @sound/run/scene.scene --tracks @F",
    ];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::of_run(folder, "frames.tracks")]
    }
}

impl ArtifactKind for Dataset {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to csv --out @O",
        "export @F --to npy --out @O.npy",
        "export @F --to png --out @O",
        "classify @sound/profile.model @F",
        "classify @sound/trees.model @F",
        "classify @sound/network.model @f",
        "evaluate @sound/profile.model @f",
        "evaluate @sound/trees.model @f",
        "evaluate @sound/network.model @f --out @O",
        "train @f --learner trees --out @O",
        "train @sound/d @f --out @O",
        "protocols @f --learner trees --seeds 1",
    ];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::dataset(folder)]
    }
}

impl ArtifactKind for Model {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to json --out @O",
        "export @F --to safetensors --out @O",
        "classify @F @sound/run/frames.rdm",
        "classify @F @sound/d",
        "evaluate @F @sound/d",
        "run @sound/small.toml --no-cache --classifier @F --dry-run",
    ];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::profile(folder), corpus::trees(folder), corpus::network(folder)]
    }
}

impl ArtifactKind for Classes {
    const COMMANDS: &'static [&'static str] = &["inspect @F", "export @F --to json --out @O"];

    fn corpus(folder: &Path) -> Vec<PathBuf> {
        vec![corpus::place(folder, "c.classes", |at| {
            let header = ClassesHeader { classes: Class::ALL.to_vec() };
            let frame = ClassesFrame { probabilities: vec![[0.1, 0.2, 0.3, 0.4]; 3] };
            let envelope = Envelope::new::<Classes>(&header, &[frame]);
            std::fs::write(at.join("sound/c.classes"), envelope.to_file_bytes()).unwrap();
        })]
    }
}
