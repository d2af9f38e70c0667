//! Command-line arguments. `docs/interface.md` describes their meaning and guarantees their defaults.

use crate::program::exit_codes;
use crate::program::export_formats::help_on_formats;
#[cfg(feature = "classifier")]
use crate::program::learning_cli::LearningCommand;
use crate::program::numbers::whole;
use crate::program::option_words::{AxesWord, FormatWord, MethodWord, boards, iq_orders, lanes, one_of};
use crate::program::suggestion::suggest;
use crate::program::terminal::{self, ResultKind};
use crate::program::values::{Axis, Shard, WorldPosition};
use crate::program::values::{
    accuracy_db, azimuth_deg, azimuths, bounces, density, elevation_deg, elevations, frequencies, place,
    range, scene_accuracy_db,
};
use crate::program::values::{full_scale, scale, shard, step, vehicle_name};
use crate::stepwise::DENSITY_PER_WAVELENGTH;
use crate::stepwise::table_words::{EDGES, NODES, POLARIZATIONS, SIDES, SMALL_PARTS, SURFACES, TRANSMISSION};
use artifact::material::Transmission;
use artifact::radar::Polarization;
use artifact::seed::SEEDS;
use artifact::settings::{Edges, NodeRule, Sides, SmallParts, Surface};
use clap::{Args, Parser, Subcommand};
use formats::devices::{Board, IqOrder, Lanes};
use pipeline::chain::cache::CacheLocation;
use pipeline::chain::loading::SceneSource;
use std::path::PathBuf;
use std::process::ExitCode;

/// Radar simulator for traffic: scattering at 77 GHz, FMCW echoes, detection, tracking, classification.
#[derive(Debug, Parser)]
#[command(name = "wayside", bin_name = "wayside", version, max_term_width = 110)]
pub(crate) struct Arguments {
    /// Command to carry out.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Options that every command has.
    #[command(flatten)]
    pub(crate) general: General,
}

/// Options of every command.
#[derive(Debug, Clone, Args)]
pub struct General {
    /// Number of threads; results are identical for any number.
    #[arg(long, global = true, value_parser = whole(1..=1024_u16, 4))]
    pub threads: Option<u16>,
    /// Memory limit for tracing; frames that would exceed it are refused with figures [default: nine tenths
    /// of the free memory].
    #[arg(long, global = true, value_name = "MIB", value_parser = whole(1..=1_u64 << 24, 4096))]
    pub memory_limit: Option<u64>,
    /// Suppress progress and notes.
    #[arg(long, global = true)]
    pub quiet: bool,
}

impl Command {
    /// Returns whether the command's results are files or only lines of standard output.
    pub fn results(&self) -> ResultKind {
        match self {
            #[cfg(feature = "classifier")]
            Self::Learning(command) => command.results(),
            Self::Score(_) | Self::Inspect(_) | Self::Cache(_) => ResultKind::Lines,
            _ => ResultKind::Files,
        }
    }
}

/// Parses the arguments of this process; returns them and the name of the command. Option values may begin
/// with a minus.
///
/// # Errors
/// The exit code after wrong arguments, 2, and after `--help` or `--version`, 0, which were printed.
pub fn parsed<P: Parser>() -> Result<(P, String), ExitCode> {
    let matches = with_negative_values(P::command()).try_get_matches();
    let matches = matches.map_err(|error| printed(&suggest::<P>(error)))?;
    let command = matches.subcommand_name().unwrap_or_default().to_owned();
    let arguments = P::from_arg_matches(&matches).map_err(|error| printed(&error))?;
    Ok((arguments, command))
}

/// Prints help, the version or an error; help and version are results, errors are not.
fn printed(told: &clap::Error) -> ExitCode {
    let printed = told.print();
    if told.use_stderr() {
        return ExitCode::from(exit_codes::WRONG_USAGE);
    }
    terminal::record_print_result(printed);
    exit_codes::of(Ok(()))
}

fn with_negative_values(command: clap::Command) -> clap::Command {
    command.mut_subcommands(with_negative_values).mut_args(|a| {
        if a.get_action().takes_values() && !a.is_positional() { a.allow_hyphen_values(true) } else { a }
    })
}

/// Commands of the program.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run all stages on a scene; write artifacts, summary.json, report.html and pictures.
    Run(RunArguments),
    /// Compute the scattering amplitude of a mesh over frequency and aspect (.npy).
    Rcs(Box<RcsArguments>),
    /// Trace the scattering paths of each frame of a scene.
    Paths(PathsArguments),
    /// Synthesize the radar cubes of a scene, optionally from traced paths.
    Echo(EchoArguments),
    /// Process radar cubes into range-Doppler maps, points and tracks.
    Dsp(DspArguments),
    /// Datasets, training, classes.
    #[cfg(feature = "classifier")]
    #[command(flatten)]
    Learning(LearningCommand),
    /// Compare radar designs by a study; write tables, a chart and a report; resumes where it stopped.
    Sweep(SweepArguments),
    /// Score points and tracks of any program against a scene: found, missed and false (JSON).
    Score(ScoreArguments),
    /// Import samples (.npy, DCA1000 .bin, SigMF, .mat) as a radar cube, or foreign point clouds as points.
    Import(Box<ImportArguments>),
    /// Write a scene file with the radar of a board configuration (mmWave SDK .cfg, mmWave Studio log or
    /// script).
    SceneFrom(SceneFromArguments),
    /// Measure the channel errors of an array from cubes of a reflector at a known place, for `calibration`
    /// of [dsp].
    Calibrate(CalibrateArguments),
    /// Export an artifact to a format that other programs read.
    Export(ExportArguments),
    /// Print header, provenance, shape, units and a sanity line of an artifact.
    Inspect(InspectArguments),
    /// Write the built-in vehicles (.glb) and their manifest.
    Vehicles(VehiclesArguments),
    /// List the contents of the cache by stage.
    Cache(CacheCommandArguments),
}

#[derive(Debug, Clone, Args)]
pub(crate) struct SceneArguments {
    /// Scene file.
    #[arg(value_name = "SCENE.toml")]
    pub(crate) scene: PathBuf,
    /// Replace the model of every target.
    #[arg(long, value_name = "FILE.glb")]
    pub(crate) model: Option<PathBuf>,
    /// Radar to use where the scene has several [default: `run` takes all in turn].
    #[arg(long, value_name = "ID")]
    pub(crate) radar: Option<String>,
    /// Replace the scene's seed.
    #[arg(long, value_parser = whole(SEEDS, 7))]
    pub(crate) seed: Option<u64>,
    /// Replace the scene's accuracy, dB, and choose by it all physics that the scene leaves open.
    #[arg(long, value_name = "DB", value_parser = scene_accuracy_db)]
    pub(crate) accuracy_db: Option<f64>,
}

#[derive(Debug, Clone, Args)]
pub(crate) struct CacheArguments {
    /// Cache folder [default: .cache in the project's folder; outside the project, the user's cache folder].
    #[arg(long, value_name = "DIR")]
    pub(crate) cache: Option<PathBuf>,
    /// Maximum size of the cache, MiB; the oldest frames are removed first [default: 8192].
    #[arg(long, value_name = "MIB", value_parser = whole(0..=1_u64 << 40, 8192))]
    pub(crate) cache_limit_mib: Option<u64>,
}

impl SceneArguments {
    /// The scene in the chain's type: file, model, radar and seed.
    pub(crate) fn source(&self) -> SceneSource {
        let Self { scene, model, radar, seed, accuracy_db } = self.clone();
        SceneSource { file: scene, model, radar, seed, accuracy_db }
    }
}

impl CacheArguments {
    /// The cache in the chain's type: folder and limit, MiB.
    pub(crate) fn location(&self) -> CacheLocation {
        let default = CacheLocation::default();
        let limit_mib = self.cache_limit_mib.unwrap_or(default.limit_mib);
        CacheLocation { folder: self.cache.clone(), limit_mib }
    }
}

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Output folder [default: out/ and the scene's name].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Classifier model [default: the built-in one].
    #[arg(long, value_name = "FILE.model")]
    pub(crate) classifier: Option<PathBuf>,
    /// Print the plan with predicted time and memory, and stop.
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Explain why each stage runs or is taken from the cache.
    #[arg(long)]
    pub(crate) explain: bool,
    /// Neither read nor write the cache.
    #[arg(long, conflicts_with_all = ["cache", "cache_limit_mib"])]
    pub(crate) no_cache: bool,
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `rcs`.
#[derive(Debug, Args)]
pub struct RcsArguments {
    /// Mesh (.glb, .gltf, .stl, .obj, .xoma) or the name of a built-in vehicle.
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// Frequencies, GHz: one number or START:STOP:N.
    #[arg(long, value_parser = frequencies)]
    pub(crate) freq_ghz: Axis,
    /// Azimuths, degrees; 0 faces the front of the body.
    #[arg(long, value_parser = azimuths, default_value = "0:360:361")]
    pub(crate) az_deg: Axis,
    /// Elevations above the horizon, degrees.
    #[arg(long, value_parser = elevations, default_value = "0")]
    pub(crate) el_deg: Axis,
    /// Distance from the antenna to the mesh's origin, m, or inf.
    #[arg(long, value_parser = range, default_value = "inf")]
    pub(crate) range_m: f64,
    /// Polarization: first letter received, second transmitted.
    #[arg(long, default_value = "vv", value_parser = one_of(POLARIZATIONS))]
    pub(crate) pol: Polarization,
    /// Highest bounce order [default: 3].
    #[arg(long, value_parser = bounces)]
    pub(crate) bounces: Option<u8>,
    /// Method: beam tracing or one of the slow references.
    #[arg(long, value_enum, default_value = "bart")]
    pub(crate) method: MethodWord,
    /// Samples or rays per wavelength of the references [default: 6].
    #[arg(long, value_parser = density)]
    pub(crate) density: Option<f64>,
    /// Diffraction by edges (physical theory of diffraction).
    #[arg(long, default_value = "off", value_parser = one_of(EDGES))]
    pub(crate) edges: Edges,
    /// Facet on which a multiple reflection is integrated [default: own-edge; for the references, middle].
    #[arg(long, value_parser = one_of(NODES))]
    pub(crate) nodes: Option<NodeRule>,
    /// Surface model: flat facets, or the curved skin that the vertex normals define.
    #[arg(long, default_value = "flat", value_parser = one_of(SURFACES))]
    pub(crate) surface: Surface,
    /// Small parts that the mesh lacks: none, or random ones with the published floor of a car
    /// (docs/decisions/small-parts.md).
    #[arg(long, default_value = "mesh", value_parser = one_of(SMALL_PARTS))]
    pub(crate) detail: SmallParts,
    /// Table of the mesh's materials (docs/materials.md); without it everything is a perfect conductor.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) materials: Option<PathBuf>,
    /// Whether to trace waves through sheets.
    #[arg(long, default_value = "off", value_parser = one_of(TRANSMISSION), requires = "materials")]
    pub(crate) transmission: Transmission,
    /// Sides from which a facet scatters.
    #[arg(long, default_value = "two", value_parser = one_of(SIDES))]
    pub(crate) sides: Sides,
    /// Azimuth of a fixed receiver, degrees.
    #[arg(long, value_parser = azimuth_deg, requires = "rx_el_deg")]
    pub(crate) rx_az_deg: Option<f64>,
    /// Elevation of a fixed receiver, degrees.
    #[arg(long, value_parser = elevation_deg, requires = "rx_az_deg")]
    pub(crate) rx_el_deg: Option<f64>,
    /// Distance of a fixed receiver, m [default: the transmitter's].
    #[arg(long, value_parser = range, requires = "rx_az_deg")]
    pub(crate) rx_range_m: Option<f64>,
    /// Allowed relative amplitude error, dB [default: -40].
    #[arg(long, value_parser = accuracy_db)]
    pub(crate) accuracy_db: Option<f64>,
    /// Metres per unit of the mesh file.
    #[arg(long, value_parser = scale)]
    pub(crate) unit_scale: Option<f64>,
    /// Draw level over azimuth and frequency, range profile, ISAR image and the contributing facets.
    #[arg(long)]
    pub(crate) pictures: bool,
    /// Output file; S.json is written beside it.
    #[arg(long, value_name = "S.npy")]
    pub(crate) out: PathBuf,
}

impl RcsArguments {
    /// Highest bounce order.
    pub(crate) fn bounces(&self) -> u8 {
        self.bounces.unwrap_or(3)
    }

    /// Facet on which a multiple reflection is integrated.
    pub(crate) fn nodes(&self) -> NodeRule {
        self.nodes.unwrap_or(match self.method {
            MethodWord::Bart => NodeRule::OwnEdge,
            MethodWord::Po | MethodWord::Sbr => NodeRule::Middle,
        })
    }

    /// Samples or rays per wavelength of the references.
    pub(crate) fn density(&self) -> f64 {
        self.density.unwrap_or(DENSITY_PER_WAVELENGTH)
    }

    /// Allowed relative amplitude error, dB.
    pub(crate) fn accuracy_db(&self) -> f64 {
        self.accuracy_db.unwrap_or(-40.0)
    }
}

/// Arguments of `paths`.
#[derive(Debug, Args)]
pub struct PathsArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Output file.
    #[arg(long, value_name = "F.paths")]
    pub(crate) out: PathBuf,
}

/// Arguments of `echo`.
#[derive(Debug, Args)]
pub struct EchoArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Traced paths to use instead of tracing anew.
    #[arg(long, value_name = "F.paths")]
    pub(crate) paths: Option<PathBuf>,
    /// Output file.
    #[arg(long, value_name = "F.cube")]
    pub(crate) out: PathBuf,
}

/// Arguments of `dsp`.
#[derive(Debug, Args)]
pub struct DspArguments {
    /// Radar cubes.
    #[arg(value_name = "F.cube")]
    pub(crate) cube: PathBuf,
    /// Scene whose [dsp] replaces the settings in the cubes.
    #[arg(long, value_name = "SCENE.toml")]
    pub(crate) scene: Option<PathBuf>,
    /// Name of one of that scene's radars, where it has several.
    #[arg(long, value_name = "ID", requires = "scene")]
    pub(crate) radar: Option<String>,
    /// Output folder.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Draw pictures too.
    #[arg(long)]
    pub(crate) pictures: bool,
}

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// Study.
    #[arg(value_name = "STUDY.toml")]
    pub(crate) study: PathBuf,
    /// Folder of all results.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Part K of N.
    #[arg(long, value_name = "K/N", value_parser = shard, default_value = "1/1")]
    pub(crate) shard: Shard,
    /// Make no runs; write the results of all runs, or report how many are missing.
    #[arg(long, conflicts_with = "shard")]
    pub(crate) conclude: bool,
    /// Replace the study's seed.
    #[arg(long, value_parser = whole(SEEDS, 7))]
    pub(crate) seed: Option<u64>,
    /// Model of the classifier [default: the one shipped with the program].
    #[arg(long, value_name = "FILE.model")]
    pub(crate) classifier: Option<PathBuf>,
    /// Neither reads nor writes the cache.
    #[arg(long, conflicts_with_all = ["cache", "cache_limit_mib"])]
    pub(crate) no_cache: bool,
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `import`.
#[derive(Debug, Args)]
pub struct ImportArguments {
    /// Samples: a .npy of complex64 [frame, channel, chirp, sample] or a RADDet tensor [range, azimuth,
    /// Doppler]; a DCA1000EVM's .bin; a .sigmf-meta; a .mat of UWCR; or a folder of .npy or .mat files. For
    /// --out F.points: a cloud of View-of-Delft (.bin) or nuScenes (.pcd), or a folder of them.
    #[arg(value_name = "F.npy")]
    pub(crate) array: PathBuf,
    /// Size of one step of integer samples, √W; otherwise taken from the file beside them, or samples stay in
    /// steps.
    #[arg(long, value_name = "SQRT_W", value_parser = step)]
    pub(crate) step: Option<f32>,
    /// Full scale of the ADC in the file's numbers; levels are then in dBFS [default: 32768 for 16-bit
    /// integers].
    #[arg(long, value_name = "STEPS", value_parser = full_scale, conflicts_with = "step")]
    pub(crate) full_scale: Option<f64>,
    /// Board configuration (mmWave SDK .cfg, mmWave Studio log or script); it supplies what the scene leaves
    /// open and checks the rest.
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
    /// Evaluation board of the configuration [default: the board of the chip that it names].
    #[arg(long, value_parser = boards(), requires = "config")]
    pub(crate) device: Option<Board>,
    /// Lane layout of the DCA1000EVM recording [default: the configuration's, else two lanes].
    #[arg(long, value_parser = lanes())]
    pub(crate) layout: Option<Lanes>,
    /// Order of I and Q in complex DCA1000EVM samples [default: the configuration's, else I first].
    #[arg(long, value_parser = iq_orders())]
    pub(crate) iq_order: Option<IqOrder>,
    /// Scene with the radar and its processing.
    #[arg(long, value_name = "SCENE.toml")]
    pub(crate) scene: PathBuf,
    /// Name of one of that scene's radars, where it has several.
    #[arg(long, value_name = "ID")]
    pub(crate) radar: Option<String>,
    /// Output file.
    #[arg(long, value_name = "F.cube|F.points")]
    pub(crate) out: PathBuf,
}

/// Arguments of `scene-from`.
#[derive(Debug, Args)]
pub struct SceneFromArguments {
    /// Board configuration: mmWave SDK .cfg, mmWave Studio log or script.
    #[arg(value_name = "FILE")]
    pub(crate) config: PathBuf,
    /// Evaluation board, which fixes the antennas [default: the board of the chip that the file names].
    #[arg(long, value_parser = boards())]
    pub(crate) device: Option<Board>,
    /// Output file.
    #[arg(long, value_name = "SCENE.toml")]
    pub(crate) out: PathBuf,
}

/// Arguments of `calibrate`.
#[derive(Debug, Args)]
pub struct CalibrateArguments {
    /// Radar cubes of the reflector, at rest.
    #[arg(value_name = "F.cube")]
    pub(crate) cube: PathBuf,
    /// Position of the reflector in world coordinates, m.
    #[arg(long, value_name = "X,Y,Z", value_parser = place)]
    pub(crate) at_m: WorldPosition,
    /// Output file.
    #[arg(long, value_name = "F.csv")]
    pub(crate) out: PathBuf,
}

/// Arguments of `export`.
#[derive(Debug, Args)]
#[command(after_help = help_on_formats())]
pub struct ExportArguments {
    /// Artifact.
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Format.
    #[arg(long)]
    pub(crate) to: FormatWord,
    /// Draw a map's .png with axes in m and m/s and a dB scale, or as the paper's grey picture.
    #[arg(long, value_enum, default_value = "off")]
    pub(crate) axes: AxesWord,
    /// Scene of these frames (scene.scene of their run) for the labels of a training set [default: no
    /// labels].
    #[arg(long, value_name = "F.scene")]
    pub(crate) scene: Option<PathBuf>,
    /// Output file.
    #[arg(long, value_name = "PATH")]
    pub(crate) out: PathBuf,
}

/// Arguments of `score`.
#[derive(Debug, Args)]
pub struct ScoreArguments {
    /// Points with their objects.
    #[arg(value_name = "F.points")]
    pub(crate) points: PathBuf,
    /// Ground truth: the scene of these points (scene.scene of their run).
    #[arg(long, value_name = "F.scene")]
    pub(crate) scene: Option<PathBuf>,
    /// Ground truth in place of a scene: labels of a set, KITTI's or View-of-Delft's folder label_2 (calib
    /// beside it) or the folder of nuScenes' tables. Bodies are paired by place alone.
    #[arg(long, value_name = "DIR", conflicts_with = "scene")]
    pub(crate) labels: Option<PathBuf>,
    /// Paths of the echoes; without them every body in range counts as detectable, even a hidden one.
    #[arg(long, value_name = "F.paths", conflicts_with = "labels")]
    pub(crate) paths: Option<PathBuf>,
    /// Tracks of the same frames [default: `dsp`'s tracker applied to the objects].
    #[arg(long, value_name = "F.tracks")]
    pub(crate) tracks: Option<PathBuf>,
}

/// Arguments of `inspect`.
#[derive(Debug, Args)]
pub struct InspectArguments {
    /// Artifact.
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
}

/// Arguments of `vehicles`.
#[derive(Debug, Args)]
pub struct VehiclesArguments {
    /// Vehicles to write [default: all].
    #[arg(value_name = "NAME", value_parser = vehicle_name)]
    pub(crate) names: Vec<&'static str>,
    /// Output folder.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Seed of the dimensions: 0 gives nominal ones, others draw from real ranges.
    #[arg(long, default_value_t = 0, value_parser = whole(SEEDS, 7))]
    pub(crate) seed: u64,
    /// Number of vehicles of each model: the first uses the seed, the others seeds of their own, listed in
    /// the manifest.
    #[arg(long, default_value_t = 1, value_parser = whole(1..=1_000_000_u64, 10))]
    pub(crate) count: u64,
}

/// Arguments of `cache`.
#[derive(Debug, Args)]
pub struct CacheCommandArguments {
    #[command(flatten)]
    pub(crate) location: CacheArguments,
    /// Empty the cache.
    #[arg(long)]
    pub(crate) clear: bool,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::suggestion::SYNONYMS;
    use clap::{CommandFactory, FromArgMatches};

    #[test]
    fn the_command_line_is_consistent_and_takes_values_that_begin_with_a_minus() {
        let command = with_negative_values(Arguments::command());
        command.clone().debug_assert();
        let words = "wayside rcs m.glb --freq-ghz 77 --az-deg -10:10:21 --accuracy-db -60 --out s.npy";
        let matches = command.try_get_matches_from(words.split(' ')).unwrap();
        let parsed = Arguments::from_arg_matches(&matches).unwrap();
        let Command::Rcs(rcs) = parsed.command else { panic!("not rcs") };
        assert_eq!((rcs.az_deg.values[0], rcs.accuracy_db()), (-10.0, -60.0));
    }

    #[test]
    fn a_misspelt_command_and_another_programs_word_are_told_the_command_that_is_meant() {
        for (typed, expected) in [
            ("rnu", Some("run")),
            ("rsc", Some("rcs")),
            ("simulate", Some("run")),
            ("Info", Some("inspect")),
            ("xyzzy", None),
        ] {
            let error = Arguments::command().try_get_matches_from(["wayside", typed]).unwrap_err();
            let told = suggest::<Arguments>(error).render().to_string();
            match expected {
                Some(name) => assert!(told.contains(&format!("'{name}'")), "{typed}: {told}"),
                None => assert!(!told.contains("similar"), "{typed}: {told}"),
            }
        }
    }

    #[cfg(feature = "classifier")]
    #[test]
    fn commands_take_the_seeds_that_a_scene_takes_and_refuse_others_with_the_range() {
        let commands =
            ["run s", "sweep s --out d", "vehicles --out d", "dataset r --out d", "train d --out m"];
        for command in commands {
            let parsed = |seed: u64| {
                let words = format!("wayside {command} --seed {seed}");
                Arguments::command().try_get_matches_from(words.split(' '))
            };
            assert!(parsed(*SEEDS.end()).is_ok(), "{command}");
            let told = parsed(SEEDS.end() + 1).unwrap_err().render().to_string();
            assert!(told.contains("it must be from 0 to 9223372036854775807"), "{command}: {told}");
        }
    }

    #[test]
    fn every_synonym_is_of_a_command() {
        let commands = Arguments::command();
        // `cargo xtask` has two more.
        for (_, command) in SYNONYMS.iter().filter(|(_, command)| !["bench", "ci"].contains(command)) {
            assert!(commands.find_subcommand(command).is_some(), "{command}");
        }
    }
}
