use artifact::ArtifactError;
use artifact::dataset::Split;
use artifact::settings::Class;
use std::path::PathBuf;

/// Faults of crops, settings, a dataset or a model.
#[derive(Debug, thiserror::Error)]
pub enum ClassifierError {
    /// A dataset or model file broke a rule, or a system error.
    #[error(transparent)]
    Artifact(#[from] ArtifactError),
    /// The size of a crop differs from its format.
    #[error("crop {index} has {found} pixels, its format says {side} x {side}")]
    CropPixels {
        /// Index of the crop in the input.
        index: usize,
        /// Number of pixels.
        found: usize,
        /// Side in the format.
        side: u32,
    },
    /// A dataset without images for the network.
    #[error("sample {index} has no crop: its dataset was made with `crops = false`")]
    NoCrop {
        /// Index of the sample in the input.
        index: usize,
    },
    /// A setting is outside its range.
    #[error("{setting} must be {rule}, is {found}")]
    Setting {
        /// Name of the setting.
        setting: &'static str,
        /// Range of the setting, in words.
        rule: &'static str,
        /// Value of the setting.
        found: f64,
    },
    /// Shards of different datasets.
    #[error(
        "{}: differs from {}: all shards of a dataset have one format of crops",
        shard.display(),
        first.display()
    )]
    ShardFormat {
        /// The differing shard.
        shard: PathBuf,
        /// Shard that it is compared with.
        first: PathBuf,
    },
    /// A scene in two splits: its samples are similar, so a test would know its answers.
    #[error("scene {scene} is in split {first:?} and in split {second:?}: a scene belongs to one")]
    SceneInTwoSplits {
        /// The scene.
        scene: u64,
        /// Split of the scene's first sample.
        first: Split,
        /// Split of another sample of the scene.
        second: Split,
    },
    /// A duplicate sample.
    #[error("sample `{0}` is there twice")]
    SampleTwice(String),
    /// A sample in two datasets: one of them was extended, or made from the same recipe.
    #[error("sample `{0}` is in another of the folders too; each is taken once")]
    SampleInTwoDatasets(String),
    /// An image in two splits: a scene was made twice, or a file was copied.
    #[error("samples `{first}` and `{second}` show the same pixels in different splits")]
    CropInTwoSplits {
        /// Id of the earlier sample.
        first: String,
        /// Id of the sample with the same pixels.
        second: String,
    },
    /// A model of another layout than this program supports.
    #[error("the model's network is `{found}`, this program builds `{known}`")]
    Architecture {
        /// Layout in the model.
        found: String,
        /// Layout that this program builds.
        known: &'static str,
    },
    /// A model with other classes, or in another order.
    #[error("the model answers {found:?}, this program knows {:?}", Class::ALL)]
    Classes {
        /// Classes in the model.
        found: Vec<Class>,
    },
    /// The header does not have three numbers of channels, each from 1 to the limit.
    #[error("the model has channels {found:?}, needed are three numbers from 1 to {limit}")]
    Channels {
        /// Channels in the model.
        found: Vec<u32>,
        /// Largest number of channels.
        limit: u32,
    },
    /// The weights are not a safetensors file.
    #[error("the weights are no safetensors file: {0}")]
    Safetensors(#[from] safetensors::SafeTensorError),
    /// The weights lack a tensor of the network.
    #[error("the weights lack the tensor `{0}`")]
    TensorMissing(String),
    /// The weights contain an unknown tensor.
    #[error("the network has no place for the tensor `{0}`")]
    TensorUnknown(String),
    /// The shape of a tensor differs from the header's.
    #[error("tensor `{name}` has the shape {found:?}, the model's header tells {expected:?}")]
    TensorShape {
        /// Name of the tensor.
        name: String,
        /// Shape in the weights.
        found: Vec<usize>,
        /// Shape according to the header.
        expected: Vec<usize>,
    },
    /// A tensor of another type than 32-bit floats.
    #[error("tensor `{name}` holds {found}, needed is F32")]
    TensorType {
        /// Name of the tensor.
        name: String,
        /// Type in the weights.
        found: safetensors::Dtype,
    },
    /// An impossible parameter: not finite, or a negative variance.
    #[error("tensor `{name}`, element {index}: {value} is no possible parameter")]
    TensorValue {
        /// Name of the tensor.
        name: String,
        /// Index of the element, row-major.
        index: usize,
        /// Value as found.
        value: f32,
    },
    /// A class without training examples.
    #[error("no sample of a {} to learn from", class.name())]
    MissingClass {
        /// The class.
        class: Class,
    },
    /// Weights of another learner than the header's.
    #[error("the weights are not those of the learner that the model's header tells")]
    OtherWeights,
    /// Trees with an unknown feature, or features in another order.
    #[error("the model asks for the feature `{found}` where this program makes `{known}`")]
    Feature {
        /// Feature in the model.
        found: String,
        /// Feature expected here.
        known: String,
    },
    /// A malformed tree.
    #[error("tree {tree} breaks a rule: {rule}")]
    Tree {
        /// Number of the tree.
        tree: usize,
        /// Violated rule of trees.
        rule: &'static str,
    },
    /// A malformed network over range cells.
    #[error("network {member} breaks a rule: {rule}")]
    ProfileNetwork {
        /// Number of the network.
        member: usize,
        /// Violated rule of networks.
        rule: &'static str,
    },
    /// The artifact holds no weights, or more than one set.
    #[error("the model holds {found} sets of weights, needed is one")]
    WeightSets {
        /// Sets in the artifact.
        found: u64,
    },
}
