//! `[fidelity]`.

use crate::document::keys::key::{Key, Or, Table};
use crate::document::keys::kinds::{Number, Text, Whole, Words};
use crate::wording::allowed::Allowed::{Below, Between};
use artifact::goal::Goal;
use artifact::material::Transmission;
use artifact::paths::MAX_ORDER;
use artifact::settings::{BetweenBodies, Detail, EchoMode, Edges, NodeRule, Sides, Surface, Wheels};

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

pub(crate) const ACCURACY: Key<Number, Or<f64>> = Key::new(
    "accuracy_db",
    Number(Below(-120.0, 0.0)),
    "dB: relative error of the amplitude allowed against the same physics carried to convergence; -20 is \
     10 %",
)
.or(-20.0);

pub(crate) const FOR: Key<Words<Goal>> = Key::new(
    "for",
    Words(|| Goal::ALL.map(|goal| (goal.name(), goal)).to_vec()),
    "the result that the scene is run for, in place of `accuracy_db`: the accuracy is then the one that this \
     result was measured to need ([validation/sensitivity.md](validation/sensitivity.md))",
);

/// Party that chooses the modelled parts of the echo.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Planning {
    /// The scene, key by key, with the defaults of omitted keys.
    #[default]
    AsSaid,
    /// The program, by the accuracy; the scene's own keys take precedence.
    ByAccuracy,
}

pub(crate) const PLAN: Key<Words<Planning>, Or<Planning>> = Key::new(
    "plan",
    Words(|| vec![("as-said", Planning::AsSaid), ("accuracy", Planning::ByAccuracy)]),
    "who chooses what is modelled: the scene, key by key; or, by \"accuracy\", the program, from a coarse \
     look at what each part of the echo is to all of it, so that `accuracy_db` is met at least cost. Keys of \
     this table and [road] stay as they are said ([planning.md](planning.md))",
)
.or(Planning::AsSaid);

pub(crate) const BOUNCES: Key<Whole, Or<u64>> =
    Key::new("bounces", Whole(Between(1.0, MAX_ORDER as f64)), "highest order of reflection").or(3);

pub(crate) const EDGES: Key<Words<Edges>, Or<Edges>> = Key::new(
    "edges",
    Words(|| vec![("off", Edges::Ignored), ("on", Edges::FirstOrder)]),
    "diffraction by open edges and wedges, of conductors ([decisions/edges.md](decisions/edges.md))",
)
.or(Edges::Ignored);

pub(crate) const SURFACE: Key<Words<Surface>, Or<Surface>> = Key::new(
    "surface",
    Words(|| vec![("flat", Surface::Flat), ("smooth", Surface::Smooth)]),
    "facets as they are, or bent by the vertex normals (made from the mesh where it stores none) and cut \
     until they are as near to the curved skin as the accuracy asks",
)
.or(Surface::Flat);

pub(crate) const SIDES: Key<Words<Sides>, Or<Sides>> = Key::new(
    "sides",
    Words(|| vec![("two", Sides::Two), ("one", Sides::One)]),
    "a facet scatters from either side, or only where its winding is counter-clockwise",
)
.or(Sides::Two);

pub(crate) const NODES: Key<Words<NodeRule>, Or<NodeRule>> = Key::new(
    "nodes",
    Words(|| vec![("middle", NodeRule::Middle), ("exit", NodeRule::Exit), ("own-edge", NodeRule::OwnEdge)]),
    "the facet of a multiple reflection on which the integral is taken",
)
.or(NodeRule::OwnEdge);

pub(crate) const ECHO: Key<Words<EchoMode>, Or<EchoMode>> = Key::new(
    "echo",
    Words(|| vec![("paths", EchoMode::Paths), ("rcs-table", EchoMode::RcsTable)]),
    "path by path with spherical waves, or the paper's far-field table (wrong at these ranges: \
     [rcs-tables.md](rcs-tables.md)), one of each body alone: bodies neither hide nor light each other then, \
     and `detail`, `between_bodies` and `measured_every` mean nothing",
)
.or(EchoMode::Paths);

pub(crate) const DETAIL: Key<Words<Detail>, Or<Detail>> = Key::new(
    "detail",
    Words(|| {
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
.or(Detail::Paths);

pub(crate) const BETWEEN_BODIES: Key<Words<BetweenBodies>, Or<BetweenBodies>> = Key::new(
    "between_bodies",
    Words(|| vec![("traced", BetweenBodies::Traced), ("left-out", BetweenBodies::LeftOut)]),
    "whether what one body reflects is followed to another. Left out, bodies still shade each other; the \
     multipath ghosts of two vehicles are gone, a queue of twelve takes a fraction of the time and \
     memory, and `model_error_db.between_bodies` tells what that leaves out \
     ([decisions/between-bodies.md](decisions/between-bodies.md))",
)
.or(BetweenBodies::Traced);

pub(crate) const WHEELS: Key<Words<Wheels>, Or<Wheels>> = Key::new(
    "wheels",
    Words(|| vec![("still", Wheels::Still), ("turning", Wheels::Turning)]),
    "whether wheels turn as vehicles roll (micro-Doppler). Wheels are what nodes, meshes or materials of a \
     model name so (`Wheel_FL`, `tyre`, `rim`), apart along and across the vehicle, round and on the \
     ground; the project's own vehicles have them. What looks the same however far it has turned, a tyre \
     without tread, stays ([decisions/wheels.md](decisions/wheels.md))",
)
.or(Wheels::Still);

pub(crate) const MEASURED_EVERY: Key<Whole, Or<u64>> = Key::new(
    "measured_every",
    Whole(Between(1.0, 1e6)),
    "frames: what the paths err by is measured in every n-th frame (and sub-frame), which takes three to \
     six times as long as the paths themselves; frames between are cut and integrated as finely and are \
     told with that frame's errors, `error_measured_in` of the summary. Good for about half a second of \
     traffic ([validation/traffic.md](validation/traffic.md))",
)
.or(1);

pub(crate) const MATERIALS: Key<Text> =
    Key::new("materials", Text("a file"), "a file with a [materials] table, instead of that table here");

pub(crate) const TRANSMISSION: Key<Words<Transmission>, Or<Transmission>> = Key::new(
    "transmission",
    Words(|| vec![("off", Transmission::Ignored), ("on", Transmission::Followed)]),
    "whether waves are followed through sheets (layers on air) to what is behind",
)
.or(Transmission::Ignored);
