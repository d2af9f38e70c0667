//! Faults of a mesh file.

use crate::openmaterial::OpenMaterialError;
use crate::wording::number::WrittenNumber;
use artifact::bounded::ReadFault;
use artifact::message::truncated;
use std::fmt;
use std::path::PathBuf;

/// A mesh file that was refused or could not be read.
#[derive(Debug)]
pub struct MeshError {
    /// File of the mesh.
    pub file: PathBuf,
    /// Place in the file.
    pub place: MeshPlace,
    /// Fault at that place.
    pub fault: MeshFault,
}

impl MeshError {
    /// Whether the system failed (the file or a buffer beside it is missing or unreadable), not the content.
    pub fn is_system(&self) -> bool {
        match &self.fault {
            MeshFault::Unread(error) | MeshFault::BufferUnread { error, .. } => error.is_system(),
            MeshFault::Asset(error) => error.is_system(),
            _ => false,
        }
    }

    /// The error of a file that replaces a target's model: no key gives its unit.
    pub(crate) fn of_replacement(self) -> Self {
        let fault = match self.fault {
            MeshFault::Size { size_m, least_m, most_m } => {
                MeshFault::ReplacementSize { size_m, least_m, most_m }
            }
            other => other,
        };
        Self { fault, ..self }
    }

    /// The whole sentence, with quotations of the file at any length.
    fn sentence(&self) -> String {
        let (file, fault) = (self.file.display(), &self.fault);
        match self.place {
            // The fault names the file itself.
            MeshPlace::File if matches!(fault, MeshFault::Asset(_)) => fault.to_string(),
            MeshPlace::File => format!("{file}: {fault}"),
            MeshPlace::Line(line) => format!("{file}:{line}: {fault}"),
            MeshPlace::Facet(facet) => format!("{file}: facet {facet}: {fault}"),
            MeshPlace::Buffer(i) => format!("{file}: buffers[{i}]: {fault}"),
            MeshPlace::View(i) => format!("{file}: bufferViews[{i}]: {fault}"),
            MeshPlace::Accessor(i) => format!("{file}: accessors[{i}]: {fault}"),
            MeshPlace::Node(i) => format!("{file}: nodes[{i}]: {fault}"),
            MeshPlace::Primitive { mesh, primitive } => {
                format!("{file}: meshes[{mesh}].primitives[{primitive}]: {fault}")
            }
        }
    }
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&truncated(&self.sentence()))
    }
}

impl std::error::Error for MeshError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.fault)
    }
}

/// A place in a mesh file; glTF's arrays count from 0, lines and facets from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshPlace {
    /// The whole file.
    File,
    /// A line of text.
    Line(u64),
    /// A facet of STL.
    Facet(u64),
    /// A glTF buffer.
    Buffer(usize),
    /// A glTF buffer view.
    View(usize),
    /// A glTF accessor.
    Accessor(usize),
    /// A glTF node.
    Node(usize),
    /// A glTF primitive.
    Primitive {
        /// Index of its mesh.
        mesh: usize,
        /// Index in that mesh.
        primitive: usize,
    },
}

/// Broken rules of a mesh file.
#[derive(Debug, thiserror::Error)]
pub enum MeshFault {
    /// An asset of OpenMATERIAL 3D was refused or could not be read.
    #[error("{0}")]
    Asset(#[source] Box<OpenMaterialError>),
    /// The file cannot be read, or exceeds the size limit.
    #[error("{0}")]
    Unread(#[source] ReadFault),
    /// A buffer beside the file cannot be read, or exceeds the size limit.
    #[error("buffer file {} {error}", path.display())]
    BufferUnread {
        /// Expected path of the buffer.
        path: PathBuf,
        /// Reason why it was not read.
        #[source]
        error: ReadFault,
    },
    /// The buffers together exceed the size limit.
    #[error("has buffers of more than {limit} bytes together, the most that are read")]
    BuffersTooLong {
        /// Largest number of bytes.
        limit: u64,
    },
    /// The file has more values than any model needs.
    #[error("its JSON has more than {limit} values, the most that are read")]
    TooManyValues {
        /// Largest number of values.
        limit: usize,
    },
    /// The file has more positions and normals than triangles can use.
    #[error("has more than {limit} positions and normals, the most that are read")]
    TooManyVectors {
        /// Largest number of vectors.
        limit: usize,
    },
    /// The file shows too many primitives: a small file can show one mesh through many nodes.
    #[error("shows more than {limit} primitives, the most that are read")]
    TooManyPrimitives {
        /// Largest number of primitives.
        limit: usize,
    },
    /// Polygons so concave that cutting them costs more than the later stages.
    #[error(
        "has polygons so dented that cutting them takes more than {limit} comparisons: write it as triangles"
    )]
    TooDented {
        /// Largest number of comparisons.
        limit: u64,
    },
    /// The file's extension indicates no known format.
    #[error("is not a .glb, .gltf, .stl, .obj or .xoma file by its name")]
    UnknownFormat,
    /// The container of binary glTF is damaged.
    #[error("is not binary glTF 2.0: {0}")]
    Container(#[source] gltf::Error),
    /// The file is shorter than its own header.
    #[error("is cut off: {found} bytes where at least {needed} belong")]
    CutOff {
        /// Bytes in the file.
        found: u64,
        /// Bytes needed according to its header.
        needed: u64,
    },
    /// The text ends within a solid.
    #[error("is cut off: it ends without `endsolid`")]
    Unfinished,
    /// The file is longer than its own header says.
    #[error(
        "is longer than its header says: {said} facets take {needed} bytes, it has {found}, which hold {there}"
    )]
    TooLong {
        /// Number of facets in the header.
        said: u64,
        /// Bytes of that many facets and the header.
        needed: u64,
        /// Number of facets that fit into the file.
        there: u64,
        /// Bytes in the file.
        found: u64,
    },
    /// The JSON of glTF is invalid.
    #[error("is not glTF: {0}")]
    Json(#[source] serde_json::Error),
    /// The file is of another major version.
    #[error("is glTF {found}; version 2 is read")]
    Version {
        /// Version of glTF in the file.
        found: String,
    },
    /// An extension is required that is needed for understanding the geometry.
    #[error("needs the extension `{0}`, which is not supported")]
    Extension(String),
    /// Geometry compressed by an extension, which is named.
    #[error("is compressed by `{0}`; write it without compression")]
    Compressed(String),
    /// A reference to a missing item.
    #[error("refers to {what} {index} of {count}")]
    NoSuch {
        /// Kind of the item.
        what: &'static str,
        /// Index of the item, from 0.
        index: usize,
        /// Number of such items.
        count: usize,
    },
    /// A buffer is neither in the file nor beside it.
    #[error("has no data: neither `uri` nor a binary chunk")]
    BufferMissing,
    /// A URI that neither names a file nor holds data.
    #[error("`uri` is neither base64 data nor a relative path")]
    BadUri,
    /// A URI that leads out of the folder of its glTF.
    #[error(
        "`uri` may name files in the folder of this one and below it alone: no absolute path, no `..`, \
         no `\\`, no `:`"
    )]
    UriOutside,
    /// A buffer, view or accessor that ends beyond its container.
    #[error("ends at byte {end} of {bytes}")]
    Outside {
        /// End of the part, bytes.
        end: u64,
        /// Size of the whole, bytes.
        bytes: u64,
    },
    /// Elements that overlap, or a stride that is too small.
    #[error("byte stride {stride} is less than the {element} bytes of an element")]
    Stride {
        /// Stride of the view, bytes.
        stride: u64,
        /// Size of an element of the accessor, bytes.
        element: u64,
    },
    /// An accessor of the wrong kind.
    #[error("must hold {expected}")]
    AccessorType {
        /// Kind of elements that the accessor must hold.
        expected: &'static str,
    },
    /// An accessor without elements.
    #[error("holds nothing")]
    Empty,
    /// An accessor without a view.
    #[error("has neither a buffer view nor a moderate number of sparse values")]
    NoView,
    /// Indices of sparse values that do not rise, or are too large.
    #[error("sparse indices must rise and stay below {count}; found {index}")]
    Sparse {
        /// Number of elements of the accessor.
        count: usize,
        /// Index at fault.
        index: usize,
    },
    /// Vertices are missing.
    #[error("has no attribute POSITION")]
    NoPositions,
    /// Number of normals unequal to that of vertices.
    #[error("has {normals} normals for {vertices} vertices")]
    NormalCount {
        /// Number of normals in NORMAL.
        normals: usize,
        /// Number of vertices in POSITION.
        vertices: usize,
    },
    /// A primitive mode that glTF does not have.
    #[error("has an unknown mode")]
    Mode,
    /// Corners are left over after the last triangle.
    #[error("{0} corners are no whole triangles")]
    Corners(usize),
    /// A facet of STL that is no triangle.
    #[error("a facet of {0} vertices is no triangle")]
    FacetCorners(usize),
    /// A polygon with too many corners.
    #[error("is a polygon of {corners} corners; at most {limit} are cut into triangles")]
    TooManyCorners {
        /// Number of corners.
        corners: usize,
        /// Largest number of corners.
        limit: usize,
    },
    /// A reference to a missing vertex.
    #[error("vertex index {index} is out of range: there are {vertices} vertices")]
    VertexIndex {
        /// Index as read; OBJ counts from 1 or, negative, from the end.
        index: i64,
        /// Number of vertices.
        vertices: usize,
    },
    /// NaN or infinity in a position.
    #[error("vertex {0} is not finite")]
    Vertex(usize),
    /// NaN or infinity in a normal.
    #[error("normal {0} is not finite")]
    Normal(usize),
    /// A node with two parents, or its own ancestor.
    #[error("is reached twice: nodes must form trees")]
    NodeTwice,
    /// A transform that is no affine map.
    #[error("its transform is not finite and affine")]
    Transform,
    /// Shapes that depend on joints or weights.
    #[error("has {0}, which is not supported: apply it and write the mesh anew")]
    Deformed(&'static str),
    /// Text that cannot be parsed.
    #[error("expected {expected}, found `{found}`")]
    Expected {
        /// Words required by the format.
        expected: &'static str,
        /// Words in the file.
        found: String,
    },
    /// The file is not text.
    #[error("is not UTF-8 text")]
    NotText,
    /// The file contains nothing that scatters.
    #[error("has no triangle with area ({degenerate} without)")]
    NoTriangles {
        /// Number of triangles dropped for lack of area.
        degenerate: u64,
    },
    /// The file exceeds the number of triangles that the stages support.
    #[error("has more than {limit} triangles")]
    TooManyTriangles {
        /// Largest number of triangles.
        limit: usize,
    },
    /// More materials than 16-bit numbers allow.
    #[error("has more than 65535 materials")]
    TooManyMaterials,
    /// The model's size is implausible in metres.
    #[error("is {} m large, not {} to {} m: say how many metres a unit is, by `unit_scale` (of `rcs` by --unit-scale)", WrittenNumber(*.size_m), WrittenNumber(*.least_m), WrittenNumber(*.most_m))]
    Size {
        /// Longest side of the bounding box.
        size_m: f64,
        /// Smallest size accepted as metres.
        least_m: f64,
        /// Largest size accepted as metres.
        most_m: f64,
    },
    /// The size in metres of a file that replaces a target's model is implausible.
    #[error(
        "is {} m large, not {} to {} m, and `--model` takes files in metres, whatever `unit_scale` the target \
         has: name the file as the target's `model`, with its own `unit_scale`",
        WrittenNumber(*.size_m), WrittenNumber(*.least_m), WrittenNumber(*.most_m)
    )]
    ReplacementSize {
        /// Longest side of the bounding box.
        size_m: f64,
        /// Smallest size accepted as metres.
        least_m: f64,
        /// Largest size accepted as metres.
        most_m: f64,
    },
}

/// A fault with its place; the caller knows the file.
#[derive(Debug)]
pub(crate) struct LocatedFault {
    pub place: MeshPlace,
    pub fault: MeshFault,
}

impl MeshPlace {
    pub(crate) fn fault(self, fault: MeshFault) -> LocatedFault {
        LocatedFault { place: self, fault }
    }
}
