//! Check of a report in a browser: pixels of its view, clicks on vehicles, sliders, a telephone, paper, no
//! script. It needs Node and Chromium; without them it is skipped with a message.

use crate::ci::commands::{Tally, run_checked, run_tests, skip, succeeds};
use crate::project::{project_root, this_program};
use std::ffi::{OsStr, OsString};
use std::process::Command;
use wayside::host::failure::Failure;

/// Script of the check, relative to the project's root.
const SCRIPT: &str = "xtask/browser/check.mjs";
/// Names of the browser, in the order of trial; `CHROMIUM` overrides them.
const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];
/// Scene of the report: two vehicles with two bounces and a point target, two frames, as coarse as the check
/// allows.
const SCENE: &str = r#"name = "report"
frames = 2
frame_interval_s = 0.5

[noise]
noise_figure_db = 12.0

[fidelity]
accuracy_db = -10.0
bounces = 2
measured_every = 2

[[target]]
kind = "mesh"
id = "car-1"
class = "car"
model = "car-suv"
lane = 2
y_m = 32.0
velocity_mps = [0.0, -10.0, 0.0]

[[target]]
kind = "mesh"
id = "motorcycle-1"
class = "motorcycle"
model = "motorcycle-street"
lane = 1
y_m = 27.0
velocity_mps = [0.0, -4.0, 0.0]

[[target]]
kind = "point"
id = "reflector"
rcs_m2 = 10.0
position_m = [-6.0, 36.0, 1.0]
"#;

/// Study of the view: four designs, two situations, of the same scene with one frame and one bounce.
const STUDY: &str = r#"scene = "simple.toml"
repeats = 1

[[vary]]
name = "array"
key = "radar.array.preset"
values = ["1x4", "3x4"]

[[vary]]
name = "height"
key = "radar.position_m"
values = [[0.0, 0.0, 5.0], [0.0, 0.0, 7.0]]
labels = ["5 m", "7 m"]

[[condition]]
name = "lane"
key = "target.1.lane"
values = [1, 3]

[goal]
metric = "coverage"
"#;

/// Table of the view.
const TABLE: [&str; 8] = [
    "rcs",
    "motorcycle-street",
    "--freq-ghz=77",
    "--az-deg=0:90:10",
    "--el-deg=5",
    "--bounces=2",
    "--accuracy-db=-10",
    "--pictures",
];

pub(crate) fn check(tally: &mut Tally) -> Result<(), Failure> {
    let node = std::env::var_os("NODE").unwrap_or("node".into());
    if !answers(&node) {
        return skip(tally, "no Node for the report's check (NODE names it)");
    }
    let mut named = std::env::var_os("CHROMIUM").into_iter().chain(BROWSERS.map(OsString::from));
    let Some(browser) = named.find(|name| answers(name)) else {
        return skip(tally, "no Chromium for the report's check (CHROMIUM names it)");
    };
    let folder = project_root().join("target/report");
    let write = |failed| Failure::system(&folder, "write", failed);
    std::fs::create_dir_all(&folder).map_err(write)?;
    std::fs::write(folder.join("scene.toml"), SCENE).map_err(write)?;
    // This program carries out the commands of `wayside`.
    let program = this_program()?;
    let mut run = Command::new(program);
    run.arg("run").arg(folder.join("scene.toml")).arg("--out").arg(folder.join("out"));
    run_checked(run.arg("--cache").arg(folder.join("cache")).arg("--quiet"))?;
    let program = run.get_program().to_owned();
    let mut table = Command::new(program);
    table.args(TABLE).arg("--out").arg(folder.join("out/S.npy"));
    run_checked(table.arg("--quiet"))?;
    let simple = SCENE.replace("frames = 2", "frames = 1").replace("bounces = 2", "bounces = 1");
    std::fs::write(folder.join("simple.toml"), simple).map_err(write)?;
    std::fs::write(folder.join("study.toml"), STUDY).map_err(write)?;
    let mut study = Command::new(table.get_program());
    study.arg("sweep").arg(folder.join("study.toml")).arg("--out").arg(folder.join("out/study"));
    run_checked(study.args(["--no-cache", "--quiet"]))?;
    let mut look = Command::new(node);
    let pages = ["report.html", "S-view.html", "study/report.html"].map(|name| folder.join("out").join(name));
    run_tests(look.arg(SCRIPT).arg(browser).args(pages), tally)
}

/// Whether a program exists and runs.
fn answers(program: &OsStr) -> bool {
    succeeds(Command::new(program).arg("--version"))
}
