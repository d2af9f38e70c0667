//! Errors of a scene file: facts as fields, turned into a sentence in one place.

use crate::document::toml_text::TooDeep;
use crate::measured::calibration::CalibrationFileError;
use crate::measured::pattern_table::PatternFileError;
use crate::mesh::MeshError;
use crate::openmaterial::OpenMaterialError;
use crate::recording::fcd::FcdError;
use crate::recording::net::NetError;
use crate::wording::allowed_range::AllowedRange;
use crate::wording::number::WrittenNumber;
use artifact::bounded::ReadFault;
use artifact::message::truncated;
use radar::lattice::TooManyDirections;
use std::fmt;
use std::path::PathBuf;

/// The broken rules of a scene file, in the order of the file, never empty: the first hundred, and the number
/// of further ones.
#[derive(Debug)]
pub struct SceneErrors(pub Vec<SceneError>, pub u64);

impl SceneErrors {
    /// Whether only the system failed (a file is missing or unreadable) and no content is at fault.
    pub fn is_system(&self) -> bool {
        self.0.iter().all(|error| error.rule.is_system())
    }
}

impl fmt::Display for SceneErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut lines: Vec<String> = self.0.iter().map(SceneError::to_string).collect();
        lines.extend((self.1 > 0).then(|| format!("and {} more", self.1)));
        f.write_str(&truncated(&lines.join("\n")))
    }
}

impl std::error::Error for SceneErrors {}

/// One broken rule.
#[derive(Debug)]
pub struct SceneError {
    /// The scene file.
    pub file: PathBuf,
    /// Line and column in the file; `None` if the file could not be read at all, and for a change without a
    /// position in it.
    pub position: Option<Position>,
    /// The table or target concerned.
    pub place: Place,
    /// Rule that the scene breaks.
    pub rule: Rule,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file.display())?;
        if let Some(position) = self.position {
            write!(f, "{}:{}:", position.line, position.column)?;
        }
        match &self.place {
            Place::Scene => write!(f, " {}", self.rule),
            Place::Table(name) => write!(f, " [{name}]: {}", self.rule),
            Place::Target(id) => write!(f, " target `{id}`: {}", self.rule),
            Place::Clutter(id) => write!(f, " clutter `{id}`: {}", self.rule),
            Place::Radar(id) => write!(f, " radar `{id}`: {}", self.rule),
            Place::Material(name) => write!(f, " material `{name}`: {}", self.rule),
        }
    }
}

impl std::error::Error for SceneError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.rule {
            Rule::File(error) => Some(error),
            Rule::Depth(error) => Some(error),
            Rule::Mesh(error) => Some(error),
            Rule::Traffic(error) => Some(error),
            Rule::Net(error) => Some(error),
            Rule::Pattern(error) => Some(error),
            Rule::Calibration(error) => Some(error),
            Rule::Directions(error) => Some(error),
            Rule::Other(error) => Some(error.as_ref()),
            _ => None,
        }
    }
}

/// A place in a text file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line number, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

/// Part of a scene that a rule concerns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// The file, or its keys outside any table.
    Scene,
    /// A table, by its dotted name.
    Table(&'static str),
    /// A target, by its id or, without one, its number from 1 (`#2`).
    Target(String),
    /// A piece of clutter, by its id or number.
    Clutter(String),
    /// One of several radars, by its id or number.
    Radar(String),
    /// A material, by its name.
    Material(String),
}

/// An axis of a range-Doppler map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MapAxis {
    /// Axis of chirps.
    Doppler,
    /// Axis of samples.
    Range,
}

impl fmt::Display for MapAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Doppler => "Doppler",
            Self::Range => "range",
        })
    }
}

/// Broken rules of a scene.
#[derive(Debug, thiserror::Error)]
pub enum Rule {
    /// The scene file cannot be read, is longer than a page of text, or is not text.
    #[error("{0}")]
    File(#[source] ReadFault),
    /// The text is not TOML.
    #[error("not valid TOML: {message}")]
    Syntax {
        /// The parser's words.
        message: String,
    },
    /// A value is nested too deeply.
    #[error("{0}")]
    Depth(#[source] TooDeep),
    /// A change of a value that has no place in the file.
    #[error("`{key}`: {obstacle}")]
    Change {
        /// Key of the change, or its beginning.
        key: String,
        /// Reason why there is no such place.
        obstacle: String,
    },
    /// A key that does not exist here.
    #[error("unknown key `{found}`{}{}", nearest_key(.nearest), of_table(.home))]
    UnknownKey {
        /// Key in the file.
        found: String,
        /// Key with a similar spelling, or the key for another program's name.
        nearest: Option<&'static str>,
        /// Heading of the table of `nearest`, if it is another table.
        home: Option<&'static str>,
    },
    /// A key that exists in other tables.
    #[error("unknown key `{found}` here; it belongs into {}", either(.tables))]
    WrongTable {
        /// Key in the file.
        found: String,
        /// Headings of the tables that have the key, as in the file, the likeliest first.
        tables: Vec<&'static str>,
    },
    /// A key that exists, but does not apply here.
    #[error("key `{key}` has no meaning for {owner}")]
    Misplaced {
        /// Name of the key in the file.
        key: &'static str,
        /// Kind of body, model or setting to which the key does not apply.
        owner: &'static str,
    },
    /// A required key.
    #[error("key `{key}` is missing")]
    Missing {
        /// Name of the missing key.
        key: &'static str,
    },
    /// A value of the wrong type.
    #[error("`{key}` must be {expected}, is {found}")]
    WrongType {
        /// Name of the key.
        key: &'static str,
        /// Type of value that the key takes.
        expected: &'static str,
        /// Type of value in the file.
        found: &'static str,
    },
    /// A list of the wrong length.
    #[error("`{key}` must have {expected} values, has {found}")]
    WrongLength {
        /// Name of the key.
        key: &'static str,
        /// Number of values that the key takes.
        expected: AllowedRange,
        /// Number of values in the file.
        found: usize,
    },
    /// A number outside the allowed range, or not finite.
    #[error("`{key}` must be a number {allowed}, is {}", WrittenNumber(*.found))]
    OutOfRange {
        /// Name of the key.
        key: &'static str,
        /// Number as read.
        found: f64,
        /// Numbers that the key accepts.
        allowed: AllowedRange,
    },
    /// A whole number of more than 63 bits.
    #[error("`{key}` must be a whole number up to {}", i64::MAX)]
    BeyondWholeNumbers {
        /// Name of the key.
        key: &'static str,
    },
    /// A word that is not one of a list.
    #[error("`{key}` cannot be `{found}`; it can be {}{others}", quoted(.known))]
    UnknownWord {
        /// Name of the key.
        key: &'static str,
        /// Word in the file.
        found: String,
        /// Words that the key takes.
        known: Vec<&'static str>,
        /// End of the sentence: other words that it accepts.
        others: &'static str,
    },
    /// Two keys that exclude one another.
    #[error("`{key}` and `{other}` exclude one another")]
    Contradiction {
        /// Key at the place of the error.
        key: &'static str,
        /// Key that excludes it.
        other: &'static str,
    },
    /// A key that requires another one.
    #[error("`{key}` needs `{companion}` beside it")]
    Alone {
        /// Key that is given.
        key: &'static str,
        /// Required key that is not given.
        companion: &'static str,
    },
    /// Pairs out of order.
    #[error("the first numbers of the pairs of `{key}` must grow")]
    NotGrowing {
        /// Name of the key.
        key: &'static str,
    },
    /// Names are used as file names, table cells and JSON.
    #[error(
        "`{key}` must be 1 to 64 letters, digits, spaces or any of `-_.+()`, and not begin with a dot or space; is `{found}`"
    )]
    BadName {
        /// Name of the key.
        key: &'static str,
        /// Name in the file.
        found: String,
    },
    /// Two bodies of one name.
    #[error("id `{id}` is taken by the one in line {first_line}")]
    DuplicateId {
        /// Id that both bodies have.
        id: String,
        /// Line of the body that had the id first.
        first_line: u32,
    },
    /// A tone measures no range.
    #[error("`slope_mhz_per_us` must not be 0: a tone tells no range")]
    NoSlope,
    /// A sweep that ends at zero or below, or beyond any radar's frequencies.
    #[error("the sweep ends at {} GHz; with `slope_mhz_per_us` it must end {allowed} GHz", WrittenNumber(*.end_ghz))]
    SweepTooLong {
        /// Frequency of the last sample, GHz.
        end_ghz: f64,
        /// Frequencies at which the sweep may end, GHz.
        allowed: AllowedRange,
    },
    /// A phase rotation from chirp to chirp is not equivalent to a velocity if the chirp intervals vary.
    #[error("`stagger_us` and the multiplexing `{multiplexing}` exclude one another")]
    StaggeredDivision {
        /// Word for the multiplexing in the file.
        multiplexing: &'static str,
    },
    /// A cube beyond the memory of the stages.
    #[error(
        "{channels} channels × {chirps} chirps × {samples} samples are more than {limit} values in a frame"
    )]
    CubeTooLarge {
        /// Number of channels of a map.
        channels: u64,
        /// Number of chirps of each transmitter.
        chirps: u64,
        /// Number of samples of each chirp.
        samples: u64,
        /// Largest number of values in a frame.
        limit: u64,
    },
    /// An array with more directions than are searched.
    #[error("{0}")]
    Directions(#[source] TooManyDirections),
    /// Another radar's chirps that would overlap.
    #[error("`chirp_interval_us` is {interval_us}, shorter than a chirp of {sweep_us} µs")]
    ChirpsOverlap {
        /// Duration of a chirp, µs.
        sweep_us: f64,
        /// Time from the start of one chirp to that of the next, µs.
        interval_us: f64,
    },
    /// Another radar at the place of this one.
    #[error("it is {away_m} m from the radar, nearer than {limit_m} m")]
    InterfererNear {
        /// Distance from the radar, m.
        away_m: f64,
        /// Least distance, m.
        limit_m: f64,
    },
    /// Phase noise over a frame longer than is supported.
    #[error("with phase noise a frame lasts at most {limit} sample intervals, this one {samples:.0}")]
    OscillatorTooLong {
        /// Sample intervals in the frame, pauses included.
        samples: f64,
        /// Largest number of them.
        limit: usize,
    },
    /// Frames that would overlap.
    #[error("`frame_interval_s` is {interval_s}, shorter than a frame of {duration_s} s")]
    FramesOverlap {
        /// Requested frame interval, s.
        interval_s: f64,
        /// Duration of one frame, s.
        duration_s: f64,
    },
    /// The CFAR window is larger than the map.
    #[error("guard and training cells need {needed} cells of {axis}, the map has {cells}")]
    WindowTooLarge {
        /// Axis of the map along which the window is too large.
        axis: MapAxis,
        /// 2·(guard + training) + 1.
        needed: u64,
        /// Number of cells of the map along that axis.
        cells: u64,
    },
    /// A CFAR window that estimates nothing.
    #[error("`training_cells` are none: noise cannot be estimated")]
    NoTrainingCells,
    /// Lanes that share ground.
    #[error("lanes {first} and {second} overlap: centres {distance_m} m apart, {width_m} m wide")]
    LanesOverlap {
        /// Number of one of the lanes.
        first: usize,
        /// Number of the other lane.
        second: usize,
        /// Distance between the lanes' centres, m.
        distance_m: f64,
        /// Width of a lane, m.
        width_m: f64,
    },
    /// A lane in a scene without lanes.
    #[error(
        "lane {0} does not exist: the scene has no lanes; beside [traffic] they are said in [intersection]"
    )]
    NoLanes(u64),
    /// A network that cannot be used.
    #[error("{0}")]
    Net(#[source] NetError),
    /// A lane that the intersection does not have.
    #[error("lane {lane} does not exist; lanes are numbered 1 to {lanes}")]
    UnknownLane {
        /// Number of the lane that is asked for.
        lane: u64,
        /// Number of lanes.
        lanes: usize,
    },
    /// No radar was selected although there are several.
    #[error(
        "the scene has several radars, and is read as one of them has it: {}; choose one by --radar, in a study and in Python by `radar`",
        quoted(.known)
    )]
    WhichRadar {
        /// Names of the scene's radars.
        known: Vec<String>,
    },
    /// A radar that the scene does not have.
    #[error("there is no radar `{found}`; {}", those_there(.known))]
    UnknownRadar {
        /// Name of the radar that is asked for.
        found: String,
        /// Names of those in the scene; none if `[radar]` is the only one.
        known: Vec<String>,
    },
    /// A point at the antenna.
    #[error(
        "a point target must be a wavelength of {wavelength_m} m or more from every element of the radar's array, is {distance_m} m"
    )]
    AtTheAntenna {
        /// Distance from the nearest element.
        distance_m: f64,
        /// Wavelength of the sweep's centre frequency.
        wavelength_m: f64,
    },
    /// Neither a file of a known format nor one of the project's own models.
    #[error("model `{found}` is neither a .glb, .gltf, .stl, .obj or .xoma file nor one of the project's {own}{}", nearest_key(.nearest))]
    UnknownModel {
        /// Name of the model in the file.
        found: String,
        /// Group of the project's own models that it could be from: vehicles or street furniture.
        own: &'static str,
        /// Model with a similar spelling.
        nearest: Option<&'static str>,
    },
    /// Models that exceed the memory of the stages.
    #[error(
        "the models up to this one have more than {limit} triangles together, the most that a scene may have"
    )]
    TooManyTriangles {
        /// Largest number of triangles of a scene.
        limit: usize,
    },
    /// The name is not in the table of permittivities.
    #[error("there is no substance `{found}`{}; docs/materials.md has them all", nearest_key(.nearest))]
    UnknownSubstance {
        /// Name of the substance in the file.
        found: String,
        /// Substance with a similar spelling.
        nearest: Option<&'static str>,
    },
    /// A file of materials was refused or could not be read.
    #[error("{0}")]
    Materials(#[source] SceneErrors),
    /// A file of OpenMATERIAL 3D was refused or could not be read.
    #[error("{0}")]
    OpenMaterial(#[source] Box<OpenMaterialError>),
    /// A table of an antenna pattern was refused or could not be read.
    #[error("{0}")]
    Pattern(#[source] PatternFileError),
    /// A file of measured errors was refused or could not be read.
    #[error("{0}")]
    Calibration(#[source] CalibrationFileError),
    /// A recording interval that ends before it begins.
    #[error("`end_s` is {end_s}, before `begin_s`, which is {begin_s}")]
    EndsBeforeItBegins {
        /// Time of the first frame, s.
        begin_s: f64,
        /// Time of the last frame, s.
        end_s: f64,
    },
    /// The name is not a type of OSI's moving objects.
    #[error("OSI has no type `{found}` of moving objects{}", nearest_key(.nearest))]
    UnknownObjectType {
        /// Name of the type in the file.
        found: String,
        /// Type with a similar spelling.
        nearest: Option<&'static str>,
    },
    /// Two names of one type of OSI's moving objects.
    #[error("`{found}` is one of two names here of the type `{told}`")]
    SameObjectType {
        /// Name of the type in the file.
        found: String,
        /// Name under which its objects are recorded.
        told: String,
    },
    /// A recording of traffic was refused or could not be read.
    #[error("{0}")]
    Traffic(#[source] FcdError),
    /// A mesh file was refused or could not be read.
    #[error("{0}")]
    Mesh(#[source] MeshError),
    /// A rule of a file that is no scene.
    #[error("{0}")]
    Other(#[source] Box<dyn std::error::Error + Send + Sync>),
}

impl Rule {
    /// Whether the system is at fault, not the content of a file.
    pub fn is_system(&self) -> bool {
        match self {
            Self::File(error) => error.is_system(),
            Self::Mesh(error) => error.is_system(),
            Self::Traffic(error) => error.is_system(),
            Self::Net(error) => error.is_system(),
            Self::Materials(errors) => errors.is_system(),
            Self::OpenMaterial(error) => error.is_system(),
            Self::Pattern(error) => error.is_system(),
            Self::Calibration(error) => error.is_system(),
            _ => false,
        }
    }
}

fn nearest_key(nearest: &Option<&'static str>) -> String {
    nearest.map_or(String::new(), |nearest| format!("; the nearest is `{nearest}`"))
}

fn of_table(home: &Option<&'static str>) -> String {
    home.map_or(String::new(), |home| format!(" of {home}"))
}

/// Alternatives in a sentence: `a, b or c`.
fn either(alternatives: &[&str]) -> String {
    match alternatives {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [others @ .., last] => format!("{} or {last}", others.join(", ")),
    }
}

fn quoted(words: &[impl fmt::Display]) -> String {
    words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ")
}

fn those_there(radars: &[String]) -> String {
    match radars {
        [] => "the only one is that of [radar], without a name".to_owned(),
        radars => format!("there are {}", quoted(radars)),
    }
}
