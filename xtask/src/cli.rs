//! Arguments of the developer commands beside those of `wayside`.

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;
use wayside::program::cli::General;
use wayside::program::terminal::ResultKind;
use wayside::program::values::{Shard, shard};

/// From a 3D model to a vehicle class: scattering at 77 GHz, FMCW echoes, detection, classification.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version, max_term_width = 110)]
pub(crate) struct Arguments {
    /// Command to carry out.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Options of every command.
    #[command(flatten)]
    pub(crate) general: General,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Commands of `wayside`.
    #[command(flatten)]
    Wayside(wayside::program::cli::Command),
    /// Renews the figures of a page of docs/; without a name, lists all studies and the age of their pages.
    Study(PageArguments),
    /// Measures speed against accuracy: chart.csv, pictures, a page.
    Chart(ChartArguments),
    /// Finds conditions in which each method fails: atlas.csv, pictures, a page.
    Atlas(AtlasArguments),
    /// Measures levels of detail, their error and cost: levels-of-detail.csv, a picture, a page.
    Levels(StudyArguments),
    /// Runs benchmarks as ratios measured in one run.
    Bench(BenchArguments),
    /// Computes checksums of every file that a program makes of every scene and of ten tables, and compares
    /// them with those of another version.
    Bytes(BytesArguments),
    /// Counts the source by crate: files, code, dependencies between files, cycles of them, crowded folders.
    House,
    /// Writes the outputs of the keys of scenes: tables of docs/scenes.md, docs/scene.schema.json.
    SceneKeys,
    /// Adds logs of fuzz tests to fixtures/fuzz.csv, and renews the table of docs/validation/fuzz.md.
    FuzzLedger(FuzzLedgerArguments),
    /// Makes an archive of the program with its scenes and all licences.
    Dist(DistArguments),
    /// Runs every check of the project, cheapest first.
    Ci(CiArguments),
}

impl Command {
    /// Kind of results that the command leaves.
    pub(crate) fn results(&self) -> ResultKind {
        match self {
            Self::Wayside(command) => command.results(),
            Self::Study(PageArguments { name: None, .. }) => ResultKind::Lines,
            Self::Study(_)
            | Self::Chart(_)
            | Self::Atlas(_)
            | Self::Levels(_)
            | Self::Bytes(_)
            | Self::SceneKeys
            | Self::Dist(_)
            | Self::FuzzLedger(_) => ResultKind::Files,
            Self::Bench(_) | Self::House | Self::Ci(_) => ResultKind::Lines,
        }
    }
}

/// Arguments of `study`.
#[derive(Debug, Default, Args)]
pub(crate) struct PageArguments {
    /// Name of the study [default: lists all].
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Fewer and smaller cases; docs/ stays unchanged.
    #[arg(long, requires = "name")]
    pub(crate) quick: bool,
    /// File of the page instead of docs/; for `chart`, `atlas` and `levels` a folder.
    #[arg(long, value_name = "F", requires = "name")]
    pub(crate) out: Option<PathBuf>,
    /// Makes every Nth row from the Kth on, keeps it in out/, and writes no page (`planner`, `predictions`).
    #[arg(long, value_name = "K/N", value_parser = shard, requires = "name", conflicts_with = "out")]
    pub(crate) shard: Option<Shard>,
    /// Makes no row; the page has those kept in out/, and the number of missing ones (`planner`,
    /// `predictions`).
    #[arg(long, requires = "name", conflicts_with_all = ["quick", "shard"])]
    pub(crate) kept: bool,
    /// Processor minutes of `search` [default: 2].
    #[arg(long, value_name = "M", requires = "name")]
    pub(crate) minutes: Option<f64>,
    /// Seed of `search`'s cases [default: 1].
    #[arg(long, value_name = "N", requires = "name")]
    pub(crate) seed: Option<u64>,
    /// Only the contests of `search` with this word in their names [default: all].
    #[arg(long, value_name = "WORD", requires = "name")]
    pub(crate) contest: Option<String>,
}

/// Arguments of `chart`, `atlas` and `levels`.
#[derive(Debug, Clone, Args)]
pub(crate) struct StudyArguments {
    /// Fewer and smaller cases.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Folder of the table and pictures [default: out/ and the study's name].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Renews the page in docs/ too.
    #[arg(long)]
    pub(crate) docs: bool,
    /// Redraws the pictures of an earlier table and computes nothing.
    #[arg(long, value_name = "F.csv", conflicts_with = "quick")]
    pub(crate) table: Option<PathBuf>,
}

/// Arguments of `chart`.
#[derive(Debug, Args)]
pub(crate) struct ChartArguments {
    #[command(flatten)]
    pub(crate) of_all: StudyArguments,
    /// Prints the changes since this earlier chart.csv: errors to their last digit, seconds beyond noise.
    #[arg(long, value_name = "F.csv")]
    pub(crate) against: Option<PathBuf>,
    /// Only the parts with this word in their names: scattering of a body, synthesis of so many paths, frames
    /// of a scene and answers of it, estimates, outside; a page in docs/ then claims no sources.
    #[arg(long, value_name = "WORD", conflicts_with = "table")]
    pub(crate) only: Option<String>,
}

/// Arguments of `atlas`.
#[derive(Debug, Args)]
pub(crate) struct AtlasArguments {
    #[command(flatten)]
    pub(crate) of_all: StudyArguments,
    /// Only the functions with this word in their names, as printed by the run.
    #[arg(long, value_name = "WORD", conflicts_with_all = ["docs", "table"])]
    pub(crate) only: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct BenchArguments {
    /// Fewer and smaller cases.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Instead: compares predictions of `run --dry-run` with the actual cost of random scenes (a table,
    /// F.csv).
    #[arg(long)]
    pub(crate) predictions: bool,
    /// Seed of the random scenes.
    #[arg(long, default_value_t = 2, requires = "predictions")]
    pub(crate) seed: u64,
    /// Number of random scenes.
    #[arg(long, default_value_t = 100, requires = "predictions")]
    pub(crate) scenes: u64,
    /// Scene files to run beside the random ones; each counts six times in fitting rates.
    #[arg(long, value_name = "SCENE.toml", requires = "predictions")]
    pub(crate) with: Vec<PathBuf>,
    /// Tables of other seeds for fitting the rates, with the counts in them.
    #[arg(long, value_name = "F.csv", requires = "predictions")]
    pub(crate) fit_with: Vec<PathBuf>,
    /// Result.
    #[arg(long, value_name = "F.json")]
    pub(crate) out: Option<PathBuf>,
}

/// Arguments of `bytes`.
#[derive(Debug, Args)]
pub(crate) struct BytesArguments {
    /// The program to run [default: this one].
    #[arg(long, value_name = "FILE")]
    pub(crate) program: Option<PathBuf>,
    /// An earlier list; exit code 1 if anything differs from it.
    #[arg(long, value_name = "F.txt")]
    pub(crate) against: Option<PathBuf>,
    /// Only this scene or table; may be given several times.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// Result: one line per file.
    #[arg(long, value_name = "F.txt")]
    pub(crate) out: PathBuf,
}

/// Arguments of `fuzz-ledger`.
#[derive(Debug, Args)]
pub(crate) struct FuzzLedgerArguments {
    /// Logs of fuzz tests (WAYSIDE_FUZZ_LOG).
    #[arg(value_name = "LOG")]
    pub(crate) logs: Vec<PathBuf>,
}

/// Arguments of `dist`.
#[derive(Debug, Args)]
pub(crate) struct DistArguments {
    /// Platform of the program, as `rustc` names it [default: this one].
    #[arg(long, value_name = "TRIPLE")]
    pub(crate) target: Option<String>,
    /// Folder of the archive [default: out/dist].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Instead of an archive, writes the licences of all that is linked into the Python package to this
    /// folder; wheels take them from crates/wayside-python/licences.
    #[arg(long, value_name = "DIR", conflicts_with = "out")]
    pub(crate) licences: Option<PathBuf>,
}

/// Arguments of `ci`.
#[derive(Debug, Args)]
pub(crate) struct CiArguments {
    /// Runs the cheap checks of all, then lints and tests of this crate alone; or one check beside them all,
    /// by name: `engines`, `install`, `osi`, `sets`, `python`, `report`, `site`, or the last six as `beside`.
    #[arg(long, value_name = "CRATE")]
    pub(crate) only: Option<String>,
}
