//! `[fidelity]` and `[model]`.

use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Choice, Integer, Number, Text};
use crate::wording::allowed_range::AllowedRange::{Below, Between};
use artifact::goal::Goal;
use artifact::material::Transmission;
use artifact::paths::MAX_ORDER;
use artifact::settings::{
    BetweenBodies, Detail, EchoMode, Edges, NodeRule, Sides, SmallParts, Surface, Wheels,
};

pub(crate) const FIDELITY: Table = Table {
    name: "fidelity",
    heading: "[fidelity]",
    about: "Accuracy and physics asked for.",
    keys: &[
        &ACCURACY,
        &FOR,
        &PLAN,
        &BOUNCES,
        &EDGES,
        &SURFACE,
        &SIDES,
        &NODES,
        &ECHO,
        &DETAIL,
        &BETWEEN_BODIES,
        &WHEELS,
        &MEASURED_EVERY,
        &MATERIALS,
        &TRANSMISSION,
    ],
};

pub(crate) const MODEL: Table = Table {
    name: "model",
    heading: "[model]",
    about: "Parts of bodies that their meshes do not have.",
    keys: &[&SMALL_PARTS],
};

/// Least relative error of a scene's amplitude, dB.
pub const LEAST_ACCURACY_DB: f64 = -120.0;

pub(crate) const ACCURACY: Key<Number, DefaultValue<f64>> = Key::new(
    "accuracy_db",
    Number(Below(LEAST_ACCURACY_DB, 0.0)),
    "dB: relative error of the amplitude allowed against the same physics carried to convergence; -20 is \
     10 %",
)
.with_default(-20.0);

pub(crate) const FOR: Key<Choice<Goal>> = Key::new(
    "for",
    Choice(|| Goal::ALL.map(|goal| (goal.name(), goal)).to_vec()),
    "the result that the scene is run for, in place of `accuracy_db`: the accuracy is then the one that this \
     result was measured to need ([validation/sensitivity.md](validation/sensitivity.md))",
);

/// Party that chooses the modelled parts of the echo.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Planning {
    /// The scene, key by key, with the defaults of omitted keys.
    #[default]
    AsSpecified,
    /// The program, by the accuracy; the scene's own keys take precedence.
    ByAccuracy,
}

pub(crate) const PLAN: Key<Choice<Planning>, DefaultValue<Planning>> = Key::new(
    "plan",
    Choice(|| vec![("as-said", Planning::AsSpecified), ("accuracy", Planning::ByAccuracy)]),
    "who chooses what is modelled: the scene, key by key; or, by \"accuracy\", the program, from a coarse \
     look at what each part of the echo is to all of it, so that `accuracy_db` is met at least cost. Keys of \
     this table and [road] stay as they are said ([planning.md](planning.md))",
)
.with_default(Planning::AsSpecified);

pub(crate) const BOUNCES: Key<Integer, DefaultValue<u64>> =
    Key::new("bounces", Integer(Between(1.0, MAX_ORDER as f64)), "highest order of reflection")
        .with_default(3);

pub(crate) const EDGES: Key<Choice<Edges>, DefaultValue<Edges>> = Key::new(
    "edges",
    Choice(|| vec![("off", Edges::Ignored), ("on", Edges::FirstOrder)]),
    "diffraction by open edges and wedges, of conductors ([decisions/edges.md](decisions/edges.md))",
)
.with_default(Edges::Ignored);

pub(crate) const SURFACE: Key<Choice<Surface>, DefaultValue<Surface>> = Key::new(
    "surface",
    Choice(|| vec![("flat", Surface::Flat), ("smooth", Surface::Smooth)]),
    "facets as they are, or bent by the vertex normals (made from the mesh where it stores none) and cut \
     until they are as near to the curved skin as the accuracy asks",
)
.with_default(Surface::Flat);

pub(crate) const SIDES: Key<Choice<Sides>, DefaultValue<Sides>> = Key::new(
    "sides",
    Choice(|| vec![("two", Sides::Two), ("one", Sides::One)]),
    "a facet scatters from either side, or only where its winding is counter-clockwise",
)
.with_default(Sides::Two);

pub(crate) const NODES: Key<Choice<NodeRule>, DefaultValue<NodeRule>> = Key::new(
    "nodes",
    Choice(|| vec![("middle", NodeRule::Middle), ("exit", NodeRule::Exit), ("own-edge", NodeRule::OwnEdge)]),
    "the facet of a multiple reflection on which the integral is taken",
)
.with_default(NodeRule::OwnEdge);

pub(crate) const ECHO: Key<Choice<EchoMode>, DefaultValue<EchoMode>> = Key::new(
    "echo",
    Choice(|| vec![("paths", EchoMode::Paths), ("rcs-table", EchoMode::RcsTable)]),
    "path by path with spherical waves, or the paper's far-field table (wrong at these ranges: \
     [rcs-tables.md](rcs-tables.md)), one of each body alone: bodies neither hide nor light each other then, \
     and `detail`, `between_bodies` and `measured_every` mean nothing; refused with [road], turning `wheels` \
     and the small parts of [model]",
)
.with_default(EchoMode::Paths);

pub(crate) const DETAIL: Key<Choice<Detail>, DefaultValue<Detail>> = Key::new(
    "detail",
    Choice(|| {
        [Detail::Auto, Detail::Paths, Detail::Merged, Detail::Centres, Detail::Statistical]
            .map(|d| (d.name(), d))
            .to_vec()
    }),
    "how much of the paths the echo is made of: all; what is expected to be cheapest within the accuracy \
     (worth it where frames or elements are many: \
     [validation/levels-of-detail.md](validation/levels-of-detail.md)); those that turn alike as one, \
     fitted scattering centres, or points drawn with the seed \
     ([decisions/levels-of-detail.md](decisions/levels-of-detail.md))",
)
.with_default(Detail::Paths);

pub(crate) const BETWEEN_BODIES: Key<Choice<BetweenBodies>, DefaultValue<BetweenBodies>> = Key::new(
    "between_bodies",
    Choice(|| vec![("traced", BetweenBodies::Traced), ("left-out", BetweenBodies::LeftOut)]),
    "whether what one body reflects is followed to another. Left out, bodies still shade each other; the \
     multipath ghosts of two vehicles are gone, a queue of twelve takes a fraction of the time and \
     memory, and `model_error_db.between_bodies` tells what that leaves out \
     ([decisions/between-bodies.md](decisions/between-bodies.md))",
)
.with_default(BetweenBodies::Traced);

pub(crate) const WHEELS: Key<Choice<Wheels>, DefaultValue<Wheels>> = Key::new(
    "wheels",
    Choice(|| vec![("still", Wheels::Still), ("turning", Wheels::Turning)]),
    "whether wheels turn as vehicles roll (micro-Doppler). Wheels are what nodes, meshes or materials of a \
     model name so (`Wheel_FL`, `tyre`, `rim`), apart along and across the vehicle, round and on the \
     ground; the project's own vehicles have them. What looks the same however far it has turned, a tyre \
     without tread, stays ([decisions/wheels.md](decisions/wheels.md))",
)
.with_default(Wheels::Still);

pub(crate) const MEASURED_EVERY: Key<Integer, DefaultValue<u64>> = Key::new(
    "measured_every",
    Integer(Between(1.0, 1e6)),
    "frames: what the paths err by is measured in every n-th frame (and sub-frame), which takes three to \
     six times as long as the paths themselves; frames between are cut and integrated as finely and are \
     told with that frame's errors, `error_measured_in` of the summary. Good for about half a second of \
     traffic ([validation/traffic.md](validation/traffic.md))",
)
.with_default(1);

pub(crate) const MATERIALS: Key<Text> =
    Key::new("materials", Text("a file"), "a file with a [materials] table, instead of that table here");

pub(crate) const TRANSMISSION: Key<Choice<Transmission>, DefaultValue<Transmission>> = Key::new(
    "transmission",
    Choice(|| vec![("off", Transmission::Ignored), ("on", Transmission::Followed)]),
    "whether waves are followed through sheets (layers on air) to what is behind",
)
.with_default(Transmission::Ignored);

pub(crate) const SMALL_PARTS: Key<Choice<SmallParts>, DefaultValue<SmallParts>> = Key::new(
    "detail",
    Choice(|| SmallParts::ALL.map(|source| (source.name(), source)).to_vec()),
    "the meshes as they are; or with small scatterers besides, drawn with the seed on what both antennas see \
     of them, for the grilles, lamps, gaps and axles that a mesh of few triangles lacks. Their mean level is \
     the floor of 3GPP's model of a car, by area seen; `model_error_db.small_parts` tells their share of the \
     echo ([decisions/small-parts.md](decisions/small-parts.md))",
)
.with_default(SmallParts::OfMesh);
