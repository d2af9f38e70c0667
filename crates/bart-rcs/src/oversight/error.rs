//! Faults of a body or an antenna.

/// Reason that a scene cannot be traced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BartError {
    /// Whoever asked for the work called it off.
    #[error("called off")]
    CalledOff,
    /// A choice of the interface that this version does not have.
    #[error("{choice} is not built yet; docs/interface.md says what is")]
    NotBuilt {
        /// Choice as the user writes it.
        choice: &'static str,
    },
    /// A coordinate is NaN or infinite.
    #[error("mesh `{mesh}`: vertex {vertex} is not finite")]
    VertexNotFinite {
        /// Name of the mesh.
        mesh: String,
        /// Index of the vertex.
        vertex: usize,
    },
    /// A permittivity below that of air, one that gains power, or a layer of no thickness.
    #[error("mesh `{mesh}`: material `{material}` needs ε′ ≥ 1, ε″ ≥ 0 and layers of positive thickness")]
    MaterialNotSound {
        /// Name of the mesh.
        mesh: String,
        /// Name of the material.
        material: String,
    },
    /// A wheel names a triangle that is not there.
    #[error("mesh `{mesh}`: a wheel names a triangle beyond its {triangles}")]
    WheelNotSound {
        /// Name of the mesh.
        mesh: String,
        /// Number of triangles.
        triangles: usize,
    },
    /// A triangle names a vertex that is not there.
    #[error("mesh `{mesh}`: triangle {triangle} names vertex {vertex} of {vertices}")]
    VertexOutOfRange {
        /// Name of the mesh.
        mesh: String,
        /// Index of the triangle.
        triangle: usize,
        /// Index of the vertex that it names.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A target names a mesh that is not there.
    #[error("target `{target}` names mesh {mesh} of {meshes}")]
    MeshOutOfRange {
        /// Id of the target.
        target: String,
        /// Index of the mesh that it names.
        mesh: u32,
        /// Number of meshes.
        meshes: usize,
    },
    /// A frame does not have one pose per target.
    #[error("frame {frame} has {poses} poses for {targets} targets")]
    PosesDoNotMatch {
        /// Index of the frame.
        frame: u32,
        /// Number of poses that the frame has.
        poses: usize,
        /// Number of poses that it needs.
        targets: usize,
    },
    /// A position, yaw or velocity is NaN or infinite.
    #[error("target `{target}`: its pose is not finite")]
    PoseNotFinite {
        /// Id of the target.
        target: String,
    },
    /// Facets are counted in 32 bits.
    #[error("{triangles} triangles in one scene; at most {most} can be counted")]
    TooManyTriangles {
        /// Triangles in all bodies.
        triangles: usize,
        /// Most triangles, 2³² − 1.
        most: usize,
    },
    /// A body is larger than the memory that it may take.
    #[error("{triangles} triangles are expected to take {} MiB; the limit is {} MiB", bytes >> 20, limit_bytes >> 20)]
    NeedsTooMuchMemory {
        /// Triangles in all bodies.
        triangles: usize,
        /// Bytes that are expected.
        bytes: u64,
        /// Bytes that are allowed.
        limit_bytes: u64,
    },
    /// A tree has grown beyond the memory that it may take.
    #[error(
        "{beams} beams at order {order} and what is joined from them take {} MiB; the memory limit leaves {} MiB for \
         them, beside what is held already and traced at the same time: fewer bounces, a coarser mesh, a looser \
         accuracy, fewer threads or a higher limit help",
        bytes >> 20,
        limit_bytes >> 20
    )]
    BeamsTakeTooMuchMemory {
        /// Order being traced.
        order: u8,
        /// Beams so far.
        beams: usize,
        /// Bytes with what will be joined.
        bytes: u64,
        /// Bytes that are allowed.
        limit_bytes: u64,
    },
    /// The pieces that a frame's polygons are cut into have grown beyond the memory that they may take.
    #[error(
        "cells and paths of a frame take {} MiB and more; the memory limit leaves {} MiB for them, beside what is held \
         already and traced at the same time: fewer bounces, a coarser mesh, a looser accuracy, fewer threads or a \
         higher limit help",
        bytes >> 20,
        limit_bytes >> 20
    )]
    CellsTakeTooMuchMemory {
        /// Bytes so far.
        bytes: u64,
        /// Bytes that are allowed.
        limit_bytes: u64,
    },
    /// Vertices of a tree are counted in 32 bits.
    #[error("the beam tree has {vertices} vertices; at most 2³² − 1 can be counted")]
    TreeTooLarge {
        /// Vertices so far.
        vertices: usize,
    },
    /// A road reflects what is above it.
    #[error("the radar stands {height_m} m above the road z = 0, which is not above it")]
    AntennaBelowRoad {
        /// Height of the radar's position.
        height_m: f64,
    },
    /// A road hides what is below it.
    #[error(
        "`{body}` lies wholly below the road z = 0, its highest point at {highest_m:.3} m: no wave comes there"
    )]
    BodyBelowRoad {
        /// Id of the target.
        body: String,
        /// Height of its highest point.
        highest_m: f64,
    },
    /// An antenna's own near field is no spherical wave.
    #[error(
        "an antenna stands {:.3} mm from a facet of `{body}`; nearer than a wavelength, {:.3} mm at the lowest frequency, its \
         field is no spherical wave (1/kr of it is not, −16 dB there) and physical optics says nothing: move it away",
        1e3 * distance_m,
        1e3 * least_m
    )]
    AntennaTooNear {
        /// Id of the target, or the name of the mesh.
        body: String,
        /// Distance to the nearest facet.
        distance_m: f64,
        /// Least distance that is allowed.
        least_m: f64,
    },
    /// An antenna stands inside a closed body: nothing comes back from there to a distance, and no order of
    /// bounces is the last.
    #[error(
        "an antenna stands inside a closed body: facets of {} take {:.4} % of all directions from it, so that no wave leaves \
         and no order of bounces is the last: move it out, or open the body",
        named(bodies),
        100.0 * share
    )]
    AntennaEnclosed {
        /// Ids of the targets, or the name of the mesh, that shut it in: those that take most come first.
        bodies: Vec<String>,
        /// Share of all directions that facets take.
        share: f64,
    },
    /// A node integral that would not end.
    #[error(
        "integrals over the lit facets of one aspect need more than {most} pieces at any accuracy, as an antenna stands so \
         near: move it away, or ask for fewer bounces or a lower frequency"
    )]
    TooManyPieces {
        /// Most pieces that are allowed.
        most: u64,
    },
    /// The antenna's place or direction is NaN, infinite or, for a direction, zero.
    #[error("the antenna's place or direction is not finite or is zero")]
    AntennaNotFinite,
    /// A path record holds a few facets only.
    #[error("{bounces} bounces asked for; a path record holds {most}")]
    TooManyBounces {
        /// Bounces asked for.
        bounces: u8,
        /// Most bounces that a record holds.
        most: u8,
    },
    /// A wave has a frequency.
    #[error("a frequency must be positive and finite, is {frequency_hz} Hz")]
    FrequencyNotPositive {
        /// Frequency asked for.
        frequency_hz: f64,
    },
    /// An antenna stands away from the origin, or infinitely far.
    #[error("a range must be positive, is {range_m} m")]
    RangeNotPositive {
        /// Range asked for.
        range_m: f64,
    },
}

/// Names of some bodies in words, the first ones of many.
fn named(bodies: &[String]) -> String {
    const TOLD: usize = 4;
    let told: Vec<String> = bodies.iter().take(TOLD).map(|body| format!("`{body}`")).collect();
    let more = if bodies.len() > TOLD { format!(" and {} more", bodies.len() - TOLD) } else { String::new() };
    told.join(", ") + &more
}
