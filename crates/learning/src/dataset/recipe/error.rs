//! Broken rules of a recipe.

use artifact::settings::Class;
use scene::Rule;

/// Rule that only a recipe breaks, or a manifest of vehicles that it names; whoever read it knows the file.
#[derive(Debug, thiserror::Error)]
pub(super) enum RecipeError {
    /// Neither of the two keys for base scenes is given.
    #[error("`scene` or `scenes` is missing: name the base scene, or several")]
    NoBaseScene,
    /// Both keys for base scenes are given.
    #[error("`scene` and `scenes` exclude one another: name one base scene, or several")]
    BaseScenesTwice,

    /// A base scene of several radars: a recipe's scenes have one.
    #[error(
        "`{key}`: {scene} has several radars ([[radars]]: {}), and a recipe takes scenes of one; name a copy \
         of it without [[radars]], with what the entry of that radar says in [radar]",
        radars.join(", ")
    )]
    SeveralRadars { key: &'static str, scene: String, radars: Vec<String> },

    /// A span with its ends exchanged.
    #[error("`{key}` must be [least, greatest], is [{}, {}]", found[0], found[1])]
    EndsExchanged { key: &'static str, found: [f64; 2] },
    /// Ranges that no lane of a base scene is near enough for.
    #[error(
        "`range_m` must reach beyond {least_m:.2} m, the nearest that a vehicle of these lanes is to the \
         radar of {scene}, ends at {found_m}"
    )]
    TooNear { scene: String, least_m: f64, found_m: f64 },
    /// A lane that a base scene does not have.
    #[error("`lanes`: {scene} has no lane {found}; {}", those_there(known))]
    Lane { scene: String, found: u8, known: Vec<u8> },
    /// More noise in a base scene that has none.
    #[error("`extra_noise_db`: {scene} has no noise that could grow")]
    NoNoise { scene: String },
    /// Small parts in a base scene of tables.
    #[error("`statistical_share`: {scene} has echo = \"rcs-table\", which knows no small parts")]
    PartsOfTables { scene: String },
    /// Frames that follow each other faster than the radar makes them.
    #[error("`frame_interval_s` must be {cycle_s} or more (a frame of {scene}), is {found_s}")]
    FrameInterval { scene: String, cycle_s: f64, found_s: f64 },

    /// Several frames at the interval of a base scene whose single frame may last longer than it.
    #[error(
        "`frames` follow each other every {found_s} s, the frame_interval_s of {scene}, whose frame lasts \
         {cycle_s}: name a `frame_interval_s` of {cycle_s} or more"
    )]
    FramesOverlap { scene: String, cycle_s: f64, found_s: f64 },

    /// A manifest's vehicle whose name leads out of the manifest's folder.
    #[error("`name` must be that of a .glb in this folder, without the ending, is `{name}`")]
    NameOfNoFile { name: String },
    /// An own vehicle under the key of another class.
    #[error("`{}`: `{name}` is a {}", class.name(), own.name())]
    VehicleOfAnotherClass { class: Class, name: String, own: Class },
    /// A folder of models that cannot be read.
    #[error("`{}`: `{name}`: {cause}", class.name())]
    UnreadableFolder {
        class: Class,
        name: String,
        #[source]
        cause: std::io::Error,
    },
    /// A folder of models without any.
    #[error("`{}`: `{name}`: the folder holds no .glb", class.name())]
    NoMeshInFolder { class: Class, name: String },
    /// A word that names no model.
    #[error(
        "`{}`: `{name}` is no mesh file (.glb, .gltf, .stl, .obj, .xoma), no folder and none of {own:?}",
        class.name()
    )]
    NoModel {
        class: Class,
        name: String,
        /// Names of the project's own vehicles.
        own: Vec<&'static str>,
    },
    /// No class has a model.
    #[error("name at least one of a class, or a folder with a manifest as `vehicles`")]
    NoModels,
    /// Models that a split by name could not part.
    #[error("`{}`: two different models are called `{name}`", class.name())]
    NameOfTwoModels { class: Class, name: String },
}

impl From<RecipeError> for Rule {
    fn from(error: RecipeError) -> Self {
        Self::Other(Box::new(error))
    }
}

fn those_there(lanes: &[u8]) -> String {
    match lanes {
        [] => "it has none".to_owned(),
        lanes => format!("it has {}", lanes.iter().map(u8::to_string).collect::<Vec<_>>().join(", ")),
    }
}
