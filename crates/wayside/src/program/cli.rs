//! Command-line arguments. `docs/interface.md` describes their meaning and guarantees their defaults.

use crate::program::export_formats::help_on_formats;
#[cfg(feature = "classifier")]
use crate::program::learning_cli::LearningCommand;
use crate::program::option_words::{
    AxesWord, EDGES, FormatWord, MethodWord, NODES, POLARIZATIONS, SIDES, SURFACES, TRANSMISSION, boards,
    iq_orders, lanes, one_of,
};
use crate::program::suggestion::suggest;
use crate::program::terminal::{self, Results};
use crate::program::values::{Axis, Place, Shard};
use crate::program::values::{
    accuracy_db, azimuth_deg, azimuths, density, elevation_deg, elevations, frequencies, place, range,
};
use crate::program::values::{full_scale, scale, shard, step};
use crate::stepwise::bounds::BOUNCES;
use artifact::material::Transmission;
use artifact::radar::Polarization;
use artifact::seed::SEEDS;
use artifact::settings::{Edges, NodeRule, Sides, Surface};
use clap::{Args, Parser, Subcommand};
use formats::devices::{Board, IqOrder, Lanes};
use pipeline::chain::cache::CacheLocation;
use pipeline::chain::loading::SceneSource;
use std::path::PathBuf;

/// From a 3D model to a vehicle class: scattering at 77 GHz, FMCW echoes, detection, classification.
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
    /// Threads to use; the result does not depend on it, to the byte.
    #[arg(long, global = true, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Memory that tracing may take; what cannot fit is refused with figures [default: nine tenths of what is
    /// free].
    #[arg(long, global = true, value_name = "MIB", value_parser = clap::value_parser!(u64).range(1..=1 << 24))]
    pub memory_limit: Option<u64>,
    /// No progress and no notes beside the results.
    #[arg(long, global = true)]
    pub quiet: bool,
}

impl Command {
    /// Returns whether the command's results are files or only lines of standard output.
    pub fn results(&self) -> Results {
        match self {
            #[cfg(feature = "classifier")]
            Self::Learning(command) => command.results(),
            Self::Score(_) | Self::Inspect(_) | Self::Cache(_) => Results::Lines,
            _ => Results::Files,
        }
    }
}

/// Parses the arguments of this process; returns them and the name of the command. Ends the program with exit
/// code 2 on wrong arguments, 0 after `--help`. Option values may begin with a minus.
pub fn parse_or_exit<P: Parser>() -> (P, String) {
    let matches = with_negative_values(P::command()).try_get_matches();
    let matches = matches.unwrap_or_else(|told| tell_and_exit(&suggest::<P>(told)));
    let command = matches.subcommand_name().unwrap_or_default().to_owned();
    (P::from_arg_matches(&matches).unwrap_or_else(|e| e.exit()), command)
}

/// Prints help, the version or an error and exits; help and version are results, errors are not.
fn tell_and_exit(told: &clap::Error) -> ! {
    let printed = told.print();
    if !told.use_stderr() {
        terminal::finish(printed);
    }
    std::process::exit(told.exit_code())
}

fn with_negative_values(command: clap::Command) -> clap::Command {
    command.mut_subcommands(with_negative_values).mut_args(|a| {
        if a.get_action().takes_values() && !a.is_positional() { a.allow_hyphen_values(true) } else { a }
    })
}

/// Commands of the program.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// A scene file to every stage's artifacts, summary.json, report.html and pictures.
    Run(RunArguments),
    /// A mesh to its scattering amplitude over frequency and aspect (.npy).
    Rcs(Box<RcsArguments>),
    /// A scene file to the scattering paths of each frame.
    Paths(PathsArguments),
    /// A scene file, and paths if given, to radar cubes.
    Echo(EchoArguments),
    /// Radar cubes to range-Doppler maps, points and tracks.
    Dsp(DspArguments),
    /// Datasets, training, classes.
    #[cfg(feature = "classifier")]
    #[command(flatten)]
    Learning(LearningCommand),
    /// A study to the design of a radar to take, with tables, picture and report; resumes where it stopped.
    Sweep(SweepArguments),
    /// Points and tracks of any program, and a scene, to what was found, missed and false (JSON).
    Score(ScoreArguments),
    /// Samples from anywhere (.npy, DCA1000 .bin, SigMF, .mat) to a radar cube; clouds of other programs to
    /// points.
    Import(Box<ImportArguments>),
    /// A board's configuration (mmWave SDK .cfg, mmWave Studio log or script) to a scene file with its radar.
    SceneFrom(SceneFromArguments),
    /// Radar cubes of a reflector at a known place to the errors of the array's channels, for `calibration`
    /// of [dsp].
    Calibrate(CalibrateArguments),
    /// Any artifact to a format that others read.
    Export(ExportArguments),
    /// Header, provenance, shape, units and a sanity line of any artifact.
    Inspect(InspectArguments),
    /// Writes the project's own vehicles (.glb) and their manifest.
    Vehicles(VehiclesArguments),
    /// Lists what the cache holds, stage by stage.
    Cache(CacheCommandArguments),
}

#[derive(Debug, Clone, Args)]
pub(crate) struct SceneArguments {
    /// Scene file.
    #[arg(value_name = "SCENE.toml")]
    pub(crate) scene: PathBuf,
    /// Replaces the model of every target.
    #[arg(long, value_name = "FILE.glb")]
    pub(crate) model: Option<PathBuf>,
    /// Through which of several radars; `run` takes them all in turn where none is said.
    #[arg(long, value_name = "ID")]
    pub(crate) radar: Option<String>,
    /// Replaces the scene's seed.
    #[arg(long, value_parser = clap::value_parser!(u64).range(SEEDS))]
    pub(crate) seed: Option<u64>,
    /// Replaces the scene's accuracy, dB; what the scene does not say itself of the physics is chosen by it.
    #[arg(long, value_name = "DB", value_parser = accuracy_db)]
    pub(crate) accuracy_db: Option<f64>,
}

#[derive(Debug, Clone, Args)]
pub(crate) struct CacheArguments {
    /// Folder of cached frames [default: .cache of the project's folder; outside of it the user's cache
    /// folder].
    #[arg(long, value_name = "DIR")]
    pub(crate) cache: Option<PathBuf>,
    /// Largest size of the cache; the oldest frames go first.
    #[arg(long, value_name = "MIB", default_value_t = 8192, value_parser = clap::value_parser!(u64).range(..=1 << 40))]
    pub(crate) cache_limit_mib: u64,
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
        CacheLocation { folder: self.cache.clone(), limit_mib: self.cache_limit_mib }
    }
}

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Folder of all results [default: out/ and the scene's name].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Model of the classifier [default: the one that ships with the program].
    #[arg(long, value_name = "FILE.model")]
    pub(crate) classifier: Option<PathBuf>,
    /// Says what would be done, in which time and memory, and does nothing.
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Says why each stage runs or not.
    #[arg(long)]
    pub(crate) explain: bool,
    /// Neither reads nor writes the cache.
    #[arg(long, conflicts_with_all = ["cache", "cache_limit_mib"])]
    pub(crate) no_cache: bool,
    #[command(flatten)]
    pub(crate) cache: CacheArguments,
}

/// Arguments of `rcs`.
#[derive(Debug, Args)]
pub struct RcsArguments {
    /// Mesh (.glb, .gltf, .stl, .obj, .xoma) or the name of an own vehicle.
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// Frequencies, GHz: one number or START:STOP:N.
    #[arg(long, value_parser = frequencies)]
    pub(crate) freq_ghz: Axis,
    /// Azimuths, degrees; 0 looks at the front of the body.
    #[arg(long, value_parser = azimuths, default_value = "0:360:361")]
    pub(crate) az_deg: Axis,
    /// Elevations above the horizon, degrees.
    #[arg(long, value_parser = elevations, default_value = "0")]
    pub(crate) el_deg: Axis,
    /// Antenna to the mesh's origin, m, or inf.
    #[arg(long, value_parser = range, default_value = "inf")]
    pub(crate) range_m: f64,
    /// First letter receives, second transmits.
    #[arg(long, default_value = "vv", value_parser = one_of(POLARIZATIONS))]
    pub(crate) pol: Polarization,
    /// Highest bounce order [default: 3].
    #[arg(long, value_parser = clap::value_parser!(u8).range(BOUNCES))]
    pub(crate) bounces: Option<u8>,
    /// Beam tracing, or one of the slow references.
    #[arg(long, value_enum, default_value = "bart")]
    pub(crate) method: MethodWord,
    /// Samples or rays per wavelength of the references [default: 6].
    #[arg(long, value_parser = density)]
    pub(crate) density: Option<f64>,
    /// Diffraction by edges (physical theory of diffraction).
    #[arg(long, default_value = "off", value_parser = one_of(EDGES))]
    pub(crate) edges: Edges,
    /// Facet on which a multiple reflection is integrated [default: own-edge; of the references middle].
    #[arg(long, value_parser = one_of(NODES))]
    pub(crate) nodes: Option<NodeRule>,
    /// Surface that the facets stand for: themselves, or the curved skin that the vertex normals tell of.
    #[arg(long, default_value = "flat", value_parser = one_of(SURFACES))]
    pub(crate) surface: Surface,
    /// Table of what the mesh's materials stand for (docs/materials.md); without it everything conducts.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) materials: Option<PathBuf>,
    /// Whether waves are followed through sheets.
    #[arg(long, default_value = "off", value_parser = one_of(TRANSMISSION), requires = "materials")]
    pub(crate) transmission: Transmission,
    /// Sides from which a facet scatters.
    #[arg(long, default_value = "two", value_parser = one_of(SIDES))]
    pub(crate) sides: Sides,
    /// Fixed receiver: azimuth, degrees.
    #[arg(long, value_parser = azimuth_deg, requires = "rx_el_deg")]
    pub(crate) rx_az_deg: Option<f64>,
    /// Fixed receiver: elevation, degrees.
    #[arg(long, value_parser = elevation_deg, requires = "rx_az_deg")]
    pub(crate) rx_el_deg: Option<f64>,
    /// Fixed receiver: distance, m [default: that of the transmitter].
    #[arg(long, value_parser = range, requires = "rx_az_deg")]
    pub(crate) rx_range_m: Option<f64>,
    /// Relative amplitude error allowed, dB [default: -40].
    #[arg(long, value_parser = accuracy_db)]
    pub(crate) accuracy_db: Option<f64>,
    /// Metres per unit of the mesh file.
    #[arg(long, value_parser = scale)]
    pub(crate) unit_scale: Option<f64>,
    /// Pictures beside the result: level over azimuth and frequency, range profile, ISAR image, the facets
    /// that make the level.
    #[arg(long)]
    pub(crate) pictures: bool,
    /// Result; S.json is written beside it.
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
        self.density.unwrap_or(6.0)
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
    /// Result.
    #[arg(long, value_name = "F.paths")]
    pub(crate) out: PathBuf,
}

/// Arguments of `echo`.
#[derive(Debug, Args)]
pub struct EchoArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Paths to use instead of tracing them.
    #[arg(long, value_name = "F.paths")]
    pub(crate) paths: Option<PathBuf>,
    /// Result.
    #[arg(long, value_name = "F.cube")]
    pub(crate) out: PathBuf,
}

/// Arguments of `dsp`.
#[derive(Debug, Args)]
pub struct DspArguments {
    /// Radar cubes.
    #[arg(value_name = "F.cube")]
    pub(crate) cube: PathBuf,
    /// Scene whose [dsp] replaces the settings that the cubes carry.
    #[arg(long, value_name = "SCENE.toml")]
    pub(crate) scene: Option<PathBuf>,
    /// Name of one of that scene's radars, where it has several.
    #[arg(long, value_name = "ID", requires = "scene")]
    pub(crate) radar: Option<String>,
    /// Folder of the maps and points.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Pictures too.
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
    /// Makes no runs: writes the results of all of them, or says how many lack.
    #[arg(long, conflicts_with = "shard")]
    pub(crate) conclude: bool,
    /// Replaces the study's seed.
    #[arg(long, value_parser = clap::value_parser!(u64).range(SEEDS))]
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
    /// Samples: complex64 [frame, channel, chirp, sample]; or a DCA1000EVM's .bin, or a .sigmf-meta, of
    /// receivers; or a .mat of UWCR, or a folder of them. Where the result is F.points: a cloud of
    /// View-of-Delft (.bin) or nuScenes (.pcd), or a folder of them.
    #[arg(value_name = "F.npy")]
    pub(crate) array: PathBuf,
    /// √W of one step of integer samples, where no file beside them says it; without either they are counted
    /// in steps.
    #[arg(long, value_name = "SQRT_W", value_parser = step)]
    pub(crate) step: Option<f32>,
    /// Largest part of a sample, in the file's numbers, where these are a converter's steps: levels are told
    /// against it, in dBFS [default: of 16-bit integers 32768].
    #[arg(long, value_name = "STEPS", value_parser = full_scale, conflicts_with = "step")]
    pub(crate) full_scale: Option<f64>,
    /// Configuration of the board (mmWave SDK .cfg, mmWave Studio log or script): what the scene does not say
    /// of the radar, and a check of what it says.
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
    /// Evaluation board of that configuration [default: that of the chip which it names].
    #[arg(long, value_parser = boards(), requires = "config")]
    pub(crate) device: Option<Board>,
    /// Lanes by which a DCA1000EVM recorded [default: those of the configuration, else two].
    #[arg(long, value_parser = lanes())]
    pub(crate) layout: Option<Lanes>,
    /// Part of a DCA1000EVM's complex samples that comes first [default: that of the configuration, else I].
    #[arg(long, value_parser = iq_orders())]
    pub(crate) iq_order: Option<IqOrder>,
    /// Scene that tells the radar and the processing.
    #[arg(long, value_name = "SCENE.toml")]
    pub(crate) scene: PathBuf,
    /// Name of one of that scene's radars, where it has several.
    #[arg(long, value_name = "ID")]
    pub(crate) radar: Option<String>,
    /// Result.
    #[arg(long, value_name = "F.cube|F.points")]
    pub(crate) out: PathBuf,
}

/// Arguments of `scene-from`.
#[derive(Debug, Args)]
pub struct SceneFromArguments {
    /// Configuration of the board: mmWave SDK .cfg, mmWave Studio log or script.
    #[arg(value_name = "FILE")]
    pub(crate) config: PathBuf,
    /// Evaluation board, with its antennas [default: that of the chip which the file names].
    #[arg(long, value_parser = boards())]
    pub(crate) device: Option<Board>,
    /// Result.
    #[arg(long, value_name = "SCENE.toml")]
    pub(crate) out: PathBuf,
}

/// Arguments of `calibrate`.
#[derive(Debug, Args)]
pub struct CalibrateArguments {
    /// Radar cubes of the reflector, at rest.
    #[arg(value_name = "F.cube")]
    pub(crate) cube: PathBuf,
    /// Place of the reflector, world metres.
    #[arg(long, value_name = "X,Y,Z", value_parser = place)]
    pub(crate) at_m: Place,
    /// Result.
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
    /// Whether a map's .png has axes in metres and m/s and a scale in dB, or is the paper's grey picture.
    #[arg(long, value_enum, default_value = "off")]
    pub(crate) axes: AxesWord,
    /// Scene of these frames, the scene.scene of their run, of which a training set's boxes are made
    /// [default: no labels].
    #[arg(long, value_name = "F.scene")]
    pub(crate) scene: Option<PathBuf>,
    /// Result.
    #[arg(long, value_name = "PATH")]
    pub(crate) out: PathBuf,
}

/// Arguments of `score`.
#[derive(Debug, Args)]
pub struct ScoreArguments {
    /// Points with their objects.
    #[arg(value_name = "F.points")]
    pub(crate) points: PathBuf,
    /// Ground truth: the scene of these points, the scene.scene of its run.
    #[arg(long, value_name = "F.scene")]
    pub(crate) scene: PathBuf,
    /// The paths of their echoes; without them every body in range is to be found, also one that is hidden.
    #[arg(long, value_name = "F.paths")]
    pub(crate) paths: Option<PathBuf>,
    /// Tracks of the same frames [default: those of the objects by the tracker of `dsp`].
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
    /// Folder of the vehicles.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// 0 gives the nominal dimensions, others spread them over real ranges.
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u64).range(SEEDS))]
    pub(crate) seed: u64,
    /// Number of vehicles of each model: the first is that of the seed, the others have seeds of their own,
    /// which the manifest tells.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub(crate) count: u64,
}

/// Arguments of `cache`.
#[derive(Debug, Args)]
pub struct CacheCommandArguments {
    #[command(flatten)]
    pub(crate) location: CacheArguments,
    /// Empties it.
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
            assert!(told.contains("is not in 0..=9223372036854775807"), "{command}: {told}");
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
