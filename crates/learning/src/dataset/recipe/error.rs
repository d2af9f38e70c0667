//! Broken rules of a recipe.

use artifact::seed::SEEDS;
use artifact::settings::Class;
use pipeline::host::toml_text::TomlFault;

/// Reason why a recipe, or a manifest of vehicles that it names, is refused; whoever read it knows the file.
#[derive(Debug, thiserror::Error)]
pub(super) enum RecipeError {
    /// The text does not say what a recipe or a manifest says.
    #[error(transparent)]
    Text(#[from] TomlFault),

    /// Neither of the two keys for base scenes is given.
    #[error("scene or scenes: name the base scene, or several")]
    NoBaseScene,
    /// Both keys for base scenes are given.
    #[error("scene and scenes: give one of the two keys, not both")]
    BaseScenesTwice,

    /// A base scene of several radars: a recipe's scenes have one.
    #[error(
        "{key}: {scene} has several radars ([[radars]]: {}), and a recipe takes scenes of one; name a copy \
         of it without [[radars]], with what the entry of that radar says in [radar]",
        radars.join(", ")
    )]
    SeveralRadars { key: &'static str, scene: String, radars: Vec<String> },

    /// A span beyond its bounds, or with its ends exchanged.
    #[error(
        "{key} must be [least, greatest], {}, at most {most}, is [{}, {}]",
        at_least(*least),
        found[0],
        found[1]
    )]
    Span { key: &'static str, least: f64, most: f64, found: [f64; 2] },
    /// A seed that no scene takes.
    #[error("{key} must be from {} to {}, is {found}", SEEDS.start(), SEEDS.end())]
    Seed { key: &'static str, found: u64 },
    /// No variant of a vehicle, or no scene, is asked for.
    #[error("vehicle_seeds and scenes_per_class must be at least 1")]
    NoSeedsOrScenes,
    /// More scenes of a class than a dataset has.
    #[error("scenes_per_class must be at most {limit}, is {found}")]
    TooManyScenes { limit: u32, found: u32 },
    /// Shards without scenes.
    #[error("scenes_per_shard must be at least 1")]
    EmptyShards,
    /// A scene of no frames, or of too many.
    #[error("frames must be from 1 to {limit}, is {found}")]
    Frames { limit: u32, found: u32 },
    /// A scene of no vehicles or of too many, or counts with their ends exchanged.
    #[error("vehicles_per_scene must be [least, most], from 1 to {limit}, is {found:?}")]
    Vehicles { limit: u32, found: [u32; 2] },
    /// A share that is none.
    #[error("queue_share must be from 0 to 1, is {0}")]
    QueueShare(f64),
    /// Ranges that no lane of a base scene is near enough for.
    #[error(
        "range_m must reach beyond {least_m:.2} m, the nearest that a vehicle of these lanes is to the radar \
         of {scene}, ends at {found_m}"
    )]
    TooNear { scene: String, least_m: f64, found_m: f64 },
    /// No lanes, or one that a base scene does not have.
    #[error("lanes must be some of the scene's ({scene}), are {found:?}")]
    Lanes { scene: String, found: Vec<u8> },
    /// More noise in a base scene that has none.
    #[error("extra_noise_db: {scene} has no noise that could grow")]
    NoNoise { scene: String },
    /// Frames that follow each other faster than the radar makes them, or hours apart.
    #[error("frame_interval_s must be from {cycle_s} (a frame of {scene}) to 10000, is {found_s}")]
    FrameInterval { scene: String, cycle_s: f64, found_s: f64 },

    /// A manifest's vehicle whose name leads out of the manifest's folder.
    #[error("vehicle: name `{name}` is no name of a file in this folder")]
    NameOfNoFile { name: String },
    /// An own vehicle under the key of another class.
    #[error("models.{}: `{name}` is a {}", class.name(), own.name())]
    VehicleOfAnotherClass { class: Class, name: String, own: Class },
    /// A folder of models that cannot be read.
    #[error("models.{}: `{name}`: {cause}", class.name())]
    UnreadableFolder {
        class: Class,
        name: String,
        #[source]
        cause: std::io::Error,
    },
    /// A folder of models without any.
    #[error("models.{}: `{name}`: the folder holds no .glb", class.name())]
    NoMeshInFolder { class: Class, name: String },
    /// A word that names no model.
    #[error(
        "models.{}: `{name}` is no mesh file (.glb, .gltf, .stl, .obj, .xoma), no folder and none of {own:?}",
        class.name()
    )]
    NoModel {
        class: Class,
        name: String,
        /// Names of the project's own vehicles.
        own: Vec<&'static str>,
    },
    /// A class that is named without a model.
    #[error("models.{}: name at least one", .0.name())]
    EmptyClass(Class),
    /// No class has a model.
    #[error("models: name at least one of a class, or a folder with a manifest as `vehicles`")]
    NoModels,
    /// Models that a split by name could not part.
    #[error("models.{}: two different models are called `{name}`", class.name())]
    NameOfTwoModels { class: Class, name: String },
}

/// Lower end of a span; the least positive number stands for all of them.
fn at_least(least: f64) -> String {
    if least == f64::MIN_POSITIVE { "positive".into() } else { format!("at least {least}") }
}
