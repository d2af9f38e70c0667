//! Faults of a mesh file.

use crate::openmaterial::OpenMaterialError;
use crate::wording::number::WrittenNumber;
use artifact::bounded::ReadFault;
use artifact::sentence::readable;
use std::fmt;
use std::path::PathBuf;

/// A mesh file that was refused or could not be read.
#[derive(Debug)]
pub struct MeshError {
    /// The file.
    pub file: PathBuf,
    /// Place in the file.
    pub place: MeshPlace,
    /// Fault at that place.
    pub fault: MeshFault,
}

impl MeshError {
    /// Whether the machine failed (the file or a buffer beside it is missing or unreadable), not the content.
    pub fn is_system(&self) -> bool {
        match &self.fault {
            MeshFault::Unread(error) | MeshFault::BufferUnread { error, .. } => error.is_system(),
            MeshFault::Asset(error) => error.is_system(),
            _ => false,
        }
    }

    /// The whole sentence, with words of the file however long they are.
    fn sentence(&self) -> String {
        let (file, fault) = (self.file.display(), &self.fault);
        match self.place {
            // It names the file itself.
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
        f.write_str(&readable(&self.sentence()))
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

/// The rules of a mesh file, broken.
#[derive(Debug, thiserror::Error)]
pub enum MeshFault {
    /// An asset of OpenMATERIAL 3D was refused or could not be read.
    #[error("{0}")]
    Asset(#[source] Box<OpenMaterialError>),
    /// The file cannot be read, or is longer than what is read.
    #[error("{0}")]
    Unread(#[source] ReadFault),
    /// A buffer beside the file cannot be read, or is longer than what is read.
    #[error("buffer file {} {error}", path.display())]
    BufferUnread {
        /// Path at which it was looked for.
        path: PathBuf,
        /// Reason that it was not read.
        #[source]
        error: ReadFault,
    },
    /// The buffers have more bytes than are read.
    #[error("has buffers of more than {limit} bytes together, the most that are read")]
    BuffersTooLong {
        /// Most bytes that are read.
        limit: u64,
    },
    /// The file has more values than any model needs.
    #[error("its JSON has more than {limit} values, the most that are read")]
    TooManyValues {
        /// Most values that are read.
        limit: usize,
    },
    /// The file has more positions and normals than triangles can use.
    #[error("has more than {limit} positions and normals, the most that are read")]
    TooManyVectors {
        /// Most vectors that are read.
        limit: usize,
    },
    /// A small file can show one mesh through many nodes.
    #[error("shows more than {limit} primitives, the most that are read")]
    TooManyPrimitives {
        /// Most primitives that are read.
        limit: usize,
    },
    /// Polygons whose dents cost more than the stages that follow.
    #[error(
        "has polygons so dented that cutting them takes more than {limit} comparisons: write it as triangles"
    )]
    TooDented {
        /// Most comparisons that are made.
        limit: u64,
    },
    /// The format cannot be told by the file's extension.
    #[error("is not a .glb, .gltf, .stl, .obj or .xoma file by its name")]
    UnknownFormat,
    /// The container of binary glTF.
    #[error("is not binary glTF 2.0: {0}")]
    Container(#[source] gltf::Error),
    /// The file is shorter than its own header.
    #[error("is cut off: {found} bytes where at least {needed} belong")]
    CutOff {
        /// Bytes in the file.
        found: u64,
        /// Bytes needed for what its header says.
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
        /// Facets by the header.
        said: u64,
        /// Bytes of as many facets and the header.
        needed: u64,
        /// Facets that the file has room for.
        there: u64,
        /// Bytes in the file.
        found: u64,
    },
    /// The JSON of glTF.
    #[error("is not glTF: {0}")]
    Json(#[source] serde_json::Error),
    /// The file is of another major version.
    #[error("is glTF {found}; version 2 is read")]
    Version {
        /// Version as written.
        found: String,
    },
    /// An extension is required without which the geometry cannot be understood.
    #[error("needs the extension `{0}`, which is not supported")]
    Extension(String),
    /// Compressed geometry.
    #[error("is compressed by `{0}`; write it without compression")]
    Compressed(String),
    /// A reference into nothing.
    #[error("refers to {what} {index} of {count}")]
    NoSuch {
        /// Kind of what is referred to.
        what: &'static str,
        /// Index that is referred to, from 0.
        index: usize,
        /// Number of those that there are.
        count: usize,
    },
    /// A buffer is neither in the file nor beside it.
    #[error("has no data: neither `uri` nor a binary chunk")]
    BufferMissing,
    /// A URI that names no file and holds no data.
    #[error("`uri` is neither base64 data nor a relative path")]
    BadUri,
    /// A URI that leads out of the folder of its glTF.
    #[error(
        "`uri` may name files in the folder of this one and below it alone: no absolute path, no `..`, \
         no `\\`, no `:`"
    )]
    UriOutside,
    /// A buffer, view or accessor that ends behind what holds it.
    #[error("ends at byte {end} of {bytes}")]
    Outside {
        /// End of the part, bytes.
        end: u64,
        /// Size of the whole, bytes.
        bytes: u64,
    },
    /// Elements that overlap or leave no room.
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
        /// Kind that its use needs.
        expected: &'static str,
    },
    /// An accessor without elements.
    #[error("holds nothing")]
    Empty,
    /// An accessor without a view.
    #[error("has neither a buffer view nor a moderate number of sparse values")]
    NoView,
    /// Indices of sparse values.
    #[error("sparse indices must rise and stay below {count}; found {index}")]
    Sparse {
        /// Number of elements of the accessor.
        count: usize,
        /// Index that does not rise, or is not below.
        index: usize,
    },
    /// Vertices are missing.
    #[error("has no attribute POSITION")]
    NoPositions,
    /// Normals that do not match.
    #[error("has {normals} normals for {vertices} vertices")]
    NormalCount {
        /// Number of normals in NORMAL.
        normals: usize,
        /// Number of vertices in POSITION.
        vertices: usize,
    },
    /// A kind of primitive that glTF does not have.
    #[error("has an unknown mode")]
    Mode,
    /// Corners are left over.
    #[error("{0} corners are no whole triangles")]
    Corners(usize),
    /// A polygon beyond what is cut into triangles.
    #[error("is a polygon of {corners} corners; at most {limit} are cut into triangles")]
    TooManyCorners {
        /// Corners of the polygon.
        corners: usize,
        /// Most corners that are cut.
        limit: usize,
    },
    /// A corner that is no vertex.
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
    /// Text that cannot be understood.
    #[error("expected {expected}, found `{found}`")]
    Expected {
        /// Words that the format expects.
        expected: &'static str,
        /// Words in the file.
        found: String,
    },
    /// The file is not text.
    #[error("is not UTF-8 text")]
    NotText,
    /// The file has nothing that could scatter.
    #[error("has no triangle with area ({degenerate} without)")]
    NoTriangles {
        /// Triangles that were dropped for want of area.
        degenerate: u64,
    },
    /// The file has more triangles than the stages can carry.
    #[error("has more than {limit} triangles")]
    TooManyTriangles {
        /// Most triangles that are read.
        limit: usize,
    },
    /// Materials are numbered with 16 bits.
    #[error("has more than 65535 materials")]
    TooManyMaterials,
    /// The model's size is not one in metres.
    #[error("is {} m large, not {} to {} m: say how many metres a unit is, by `unit_scale` (of `rcs` by --unit-scale)", WrittenNumber(*.size_m), WrittenNumber(*.least_m), WrittenNumber(*.most_m))]
    Size {
        /// Longest side of the bounding box.
        size_m: f64,
        /// Smallest size that is taken for metres.
        least_m: f64,
        /// Largest size that is taken for metres.
        most_m: f64,
    },
}

/// A fault with its place; the file is known further out.
#[derive(Debug)]
pub(crate) struct Located {
    pub place: MeshPlace,
    pub fault: MeshFault,
}

impl MeshPlace {
    pub(crate) fn fault(self, fault: MeshFault) -> Located {
        Located { place: self, fault }
    }
}
