//! Faults of a body or an antenna.

/// Reason that a scene cannot be traced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BartError {
    /// Whoever asked for the work called it off.
    #[error("called off")]
    Cancelled,
    /// An option of the interface that this version lacks.
    #[error("{choice} is not built yet; docs/interface.md says what is")]
    NotBuilt {
        /// Option as written by the user.
        choice: &'static str,
    },
    /// A NaN or infinite coordinate.
    #[error("mesh `{mesh}`: vertex {vertex} is not finite")]
    VertexNotFinite {
        /// Name of the mesh.
        mesh: String,
        /// Index of the vertex.
        vertex: usize,
    },
    /// A permittivity below that of air or with gain, or a layer without thickness.
    #[error("mesh `{mesh}`: material `{material}` needs ε′ ≥ 1, ε″ ≥ 0 and layers of positive thickness")]
    MaterialNotSound {
        /// Name of the mesh.
        mesh: String,
        /// Name of the material.
        material: String,
    },
    /// A wheel with a triangle index out of range.
    #[error("mesh `{mesh}`: a wheel names a triangle beyond its {triangles}")]
    WheelNotSound {
        /// Name of the mesh.
        mesh: String,
        /// Number of triangles.
        triangles: usize,
    },
    /// A triangle with a vertex index out of range.
    #[error("mesh `{mesh}`: triangle {triangle} names vertex {vertex} of {vertices}")]
    VertexOutOfRange {
        /// Name of the mesh.
        mesh: String,
        /// Index of the triangle.
        triangle: usize,
        /// Vertex index used by it.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A target with a mesh index out of range.
    #[error("target `{target}` names mesh {mesh} of {meshes}")]
    MeshOutOfRange {
        /// Id of the target.
        target: String,
        /// Mesh index used by it.
        mesh: u32,
        /// Number of meshes.
        meshes: usize,
    },
    /// A frame whose number of poses is not that of its targets.
    #[error("frame {frame} has {poses} poses for {targets} targets")]
    PosesDoNotMatch {
        /// Index of the frame.
        frame: u32,
        /// Number of poses in the frame.
        poses: usize,
        /// Number of poses required.
        targets: usize,
    },
    /// A NaN or infinite position, yaw or velocity.
    #[error("target `{target}`: its pose is not finite")]
    PoseNotFinite {
        /// Id of the target.
        target: String,
    },
    /// More triangles than 32 bits can count.
    #[error("{triangles} triangles in one scene; at most {most} can be counted")]
    TooManyTriangles {
        /// Number of triangles in all bodies.
        triangles: usize,
        /// Maximum number of triangles, 2³² − 1.
        most: usize,
    },
    /// A body that exceeds its memory limit.
    #[error(
        "{triangles} triangles are expected to take {} MiB; the limit is {} MiB",
        bytes >> 20,
        limit_bytes >> 20
    )]
    NeedsTooMuchMemory {
        /// Number of triangles in all bodies.
        triangles: usize,
        /// Expected memory, bytes.
        bytes: u64,
        /// Memory limit, bytes.
        limit_bytes: u64,
    },
    /// A tree that has exceeded its memory limit.
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
        /// Number of beams so far.
        beams: usize,
        /// Memory including joints, bytes.
        bytes: u64,
        /// Memory limit, bytes.
        limit_bytes: u64,
    },
    /// Pieces of a frame's polygons that have exceeded their memory limit.
    #[error(
        "cells and paths of a frame take {} MiB and more; the memory limit leaves {} MiB for them, beside what is held \
         already and traced at the same time: fewer bounces, a coarser mesh, a looser accuracy, fewer threads or a \
         higher limit help",
        bytes >> 20,
        limit_bytes >> 20
    )]
    CellsTakeTooMuchMemory {
        /// Memory so far, bytes.
        bytes: u64,
        /// Memory limit, bytes.
        limit_bytes: u64,
    },
    /// More vertices of a tree than 32 bits can count.
    #[error("the beam tree has {vertices} vertices; at most 2³² − 1 can be counted")]
    TreeTooLarge {
        /// Number of vertices so far.
        vertices: usize,
    },
    /// An antenna below the road, which only reflects what is above it.
    #[error("the radar's lowest element stands {height_m} m above the road z = 0, which is not above it")]
    AntennaBelowRoad {
        /// Height of the lowest of the radar's position and its elements.
        height_m: f64,
    },
    /// A body below the road, which hides it.
    #[error(
        "`{body}` lies wholly below the road z = 0, its highest point at {highest_m:.3} m: no wave comes there"
    )]
    BodyBelowRoad {
        /// Id of the target.
        body: String,
        /// Height of its highest point.
        highest_m: f64,
    },
    /// An antenna so close to a facet that its own near field is not a spherical wave.
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
        /// Smallest allowed distance from a facet, a wavelength.
        least_m: f64,
    },
    /// An antenna inside a closed body, from where nothing returns from a distance, and no order of bounces
    /// is the last.
    #[error(
        "an antenna stands inside a closed body: facets of {} take {:.4} % of all directions from it, so that no wave leaves \
         and no order of bounces is the last: move it out, or open the body",
        named(bodies),
        100.0 * share
    )]
    AntennaEnclosed {
        /// Ids of the enclosing targets, or the name of the mesh; those with the largest solid angles first.
        bodies: Vec<String>,
        /// Share of all directions covered by facets.
        share: f64,
    },
    /// A node integral that would not terminate.
    #[error(
        "integrals over the lit facets of one aspect need more than {most} pieces at any accuracy, as an antenna stands so \
         near: move it away, or ask for fewer bounces or a lower frequency"
    )]
    TooManyPieces {
        /// Largest number of pieces of an integral.
        most: u64,
    },
    /// A NaN or infinite antenna position or direction, or a zero direction.
    #[error("the antenna's place or direction is not finite or is zero")]
    AntennaNotFinite,
    /// More bounces than a path record can hold.
    #[error("{bounces} bounces asked for; a path record holds {most}")]
    TooManyBounces {
        /// Number of bounces that are asked for.
        bounces: u8,
        /// Maximum number of bounces in a record.
        most: u8,
    },
    /// A result that is no number, by input that no rule refuses, or by an error of the program.
    #[error("{place}: the scattering amplitude is not finite, so nothing of it can be used")]
    AmplitudeNotFinite {
        /// Frame and target, or aspect.
        place: String,
    },
    /// A frequency that is not positive.
    #[error("a frequency must be positive and finite, is {frequency_hz} Hz")]
    FrequencyNotPositive {
        /// Frequency that is asked for.
        frequency_hz: f64,
    },
    /// A range that is not positive.
    #[error("a range must be positive, is {range_m} m")]
    RangeNotPositive {
        /// Range that is asked for.
        range_m: f64,
    },
}

/// Names of bodies in words; only the first if there are many.
fn named(bodies: &[String]) -> String {
    const TOLD: usize = 4;
    let told: Vec<String> = bodies.iter().take(TOLD).map(|body| format!("`{body}`")).collect();
    let more = if bodies.len() > TOLD { format!(" and {} more", bodies.len() - TOLD) } else { String::new() };
    told.join(", ") + &more
}
