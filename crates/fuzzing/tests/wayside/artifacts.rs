//! Artifacts of every kind, and the commands that read them.

use crate::commands::{note, noted_of_content};
use crate::envelope::{Envelope, crafted};
use crate::sound;
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
use fuzzing::{Noise, Reader};
use std::path::{Path, PathBuf};

pub(crate) fn readers() -> Vec<Reader> {
    vec![
        of::<Scene>(60),
        of::<Paths>(60),
        of::<Rcs>(60),
        of::<Cube>(60),
        of::<Rdm>(60),
        of::<Points>(60),
        of::<Tracks>(60),
        of::<Dataset>(60),
        of::<Model>(60),
        of::<Classes>(60),
    ]
}

/// A kind of artifact with the commands that read it: `@F` is the changed one.
trait Kind: Schema {
    const COMMANDS: &'static [&'static str];

    /// Sound ones, of which one is changed.
    fn sound(folder: &Path) -> Vec<PathBuf>;
}

fn of<K: Kind>(cases: u64) -> Reader {
    Reader::refusing(K::NAME, cases, write::<K>, noted_of_content)
}

fn write<K: Kind>(noise: &mut Noise, folder: &Path) {
    let sound = K::sound(folder);
    let whole = std::fs::read(&sound[noise.below(sound.len())]).unwrap();
    // In a folder of its own: some commands read all that a folder holds.
    let file = format!("f/shard-0000.{}", K::NAME);
    std::fs::create_dir(folder.join("f")).unwrap();
    std::fs::write(folder.join(&file), crafted::<K>(noise, &whole)).unwrap();
    note(folder, &noise.pick(K::COMMANDS).replace("@F", &format!("@{file}")));
    // Whatever the command reads beside it.
    sound::of_run(folder, "frames.points");
    sound::profile(folder);
    sound::trees(folder);
    sound::network(folder);
    sound::dataset(folder);
}

impl Kind for Scene {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to json --out @O",
        "score @sound/run/frames.points --scene @F",
        "export @sound/run/frames.points --to kitti --scene @F --out @O-kitti",
        "score @sound/run/frames.points --scene @F --paths @sound/run/frames.paths",
    ];

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::of_run(folder, "scene.scene")]
    }
}

impl Kind for Paths {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to csv --out @O",
        "export @F --to json --out @O",
        "echo @sound/small.toml --paths @F --out @O",
        "score @sound/run/frames.points --scene @sound/run/scene.scene --paths @F",
    ];

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::of_run(folder, "frames.paths")]
    }
}

impl Kind for Rcs {
    const COMMANDS: &'static [&'static str] =
        &["inspect @F", "export @F --to npy --out @O.npy", "export @F --to json --out @O"];

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::of_run(folder, "frames.rcs")]
    }
}

impl Kind for Cube {
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

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::of_run(folder, "frames.cube")]
    }
}

impl Kind for Rdm {
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

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::of_run(folder, "frames.rdm")]
    }
}

impl Kind for Points {
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

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::of_run(folder, "frames.points")]
    }
}

impl Kind for Tracks {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to csv --out @O",
        "export @F --to json --out @O",
        "score @sound/run/frames.points --scene @sound/run/scene.scene --tracks @F",
    ];

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::of_run(folder, "frames.tracks")]
    }
}

impl Kind for Dataset {
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

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::dataset(folder)]
    }
}

impl Kind for Model {
    const COMMANDS: &'static [&'static str] = &[
        "inspect @F",
        "export @F --to json --out @O",
        "export @F --to safetensors --out @O",
        "classify @F @sound/run/frames.rdm",
        "classify @F @sound/d",
        "evaluate @F @sound/d",
        "run @sound/small.toml --no-cache --classifier @F --dry-run",
    ];

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::profile(folder), sound::trees(folder), sound::network(folder)]
    }
}

impl Kind for Classes {
    const COMMANDS: &'static [&'static str] = &["inspect @F", "export @F --to json --out @O"];

    fn sound(folder: &Path) -> Vec<PathBuf> {
        vec![sound::place(folder, "c.classes", |at| {
            let header = ClassesHeader { classes: Class::ALL.to_vec() };
            let frame = ClassesFrame { probabilities: vec![[0.1, 0.2, 0.3, 0.4]; 3] };
            let envelope = Envelope::new::<Classes>(&header, &[frame]);
            std::fs::write(at.join("sound/c.classes"), envelope.sealed()).unwrap();
        })]
    }
}
