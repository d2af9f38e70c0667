//! `[materials]`, its layers, and `[road]`.

use crate::document::keys::key::{Key, Or, Table};
use crate::document::keys::kinds::{Below, Number, Pair, TableForm, Text, Truth, Words};
use crate::wording::allowed::Allowed::{self, Above, Between};
use artifact::material::Backing;

/// Whether the road reflects.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Mirror {
    On,
    Off,
}

/// Model of the road's own backscatter.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Ground {
    Off,
    Floor,
}

/// Number of layers: a windscreen has three, a painted bumper four.
pub(crate) const LAYERS_OF_ONE: Allowed = Between(1.0, 32.0);

/// Ranges of ε′ and ε″. Values below 1 are those of plasma, which no vehicle has.
const COMPLEX: Pair = Pair { any: Between(0.0, 1e6), each: [Between(1.0, 1e6), Between(0.0, 1e6)] };

/// Each entry of `[materials]`.
pub(crate) const MATERIAL: Table = Table {
    name: "materials",
    heading: "[materials]",
    about: "What a material's name in mesh files stands for.",
    keys: &[&SUBSTANCE, &PERMITTIVITY, &OPENMATERIAL, &THICKNESS, &LAYERS, &BACKING, &COHERENT],
};

pub(crate) const SUBSTANCE: Key<Text> = Key::new(
    "substance",
    Text("a name of the table in materials.md"),
    "what it consists of; \"metal\" is a perfect conductor",
);

pub(crate) const PERMITTIVITY: Key<Pair> =
    Key::new("permittivity", COMPLEX, "[ε′, ε″] of ε′ − jε″ instead of a substance");

pub(crate) const OPENMATERIAL: Key<Text> = Key::new(
    "openmaterial",
    Text("a `.xomp` file"),
    "a material of OpenMATERIAL 3D at the radar's centre frequency instead of a substance",
);

pub(crate) const THICKNESS: Key<Number> =
    Key::new("thickness_mm", Number(Above(0.0, 1e3)), "mm: a plane layer; left out: filled all the way");

pub(crate) const LAYERS: Key<Below> = Key::new(
    "layers",
    Below { form: TableForm::List(LAYERS_OF_ONE), table: &LAYER },
    "several layers, the outermost first, instead of the four keys above",
)
.allowed("{} layers");

pub(crate) const BACKING: Key<Words<Backing>, Or<Backing>> = Key::new(
    "backing",
    Words(|| vec![("air", Backing::Air), ("metal", Backing::Metal)]),
    "what is behind the last layer",
)
.or(Backing::Air);

pub(crate) const COHERENT: Key<Truth, Or<bool>> =
    Key::new("coherent", Truth, "false: thicknesses are known about only, powers are averaged over them")
        .or(true);

/// A table of the `layers` of an entry.
pub(crate) const LAYER: Table = Table {
    name: "materials.layers",
    heading: "layers of [materials]",
    about: "A plane layer.",
    keys: &[&OF_SUBSTANCE, &OF_PERMITTIVITY, &OF_OPENMATERIAL, &OF_THICKNESS],
};

pub(crate) const OF_SUBSTANCE: Key<Text> =
    Key::new("substance", SUBSTANCE.takes, "one of these three is required")
        .allowed("as above, but \"metal\"");

pub(crate) const OF_PERMITTIVITY: Key<Pair> =
    Key::new("permittivity", PERMITTIVITY.takes, "").allowed("as above");

pub(crate) const OF_OPENMATERIAL: Key<Text> =
    Key::new("openmaterial", OPENMATERIAL.takes, "").allowed("as above, but no conductor");

pub(crate) const OF_THICKNESS: Key<Number> = Key::new("thickness_mm", THICKNESS.takes, "mm").required();

pub(crate) const ROAD: Table = Table {
    name: "road",
    heading: "[road]",
    about: "The plane z = 0, as a mirror and as a rough surface.",
    keys: &[
        &MIRROR,
        &ROAD_SUBSTANCE,
        &ROAD_PERMITTIVITY,
        &ROAD_OPENMATERIAL,
        &RMS_HEIGHT,
        &BACKSCATTER,
        &GAMMA,
    ],
};

pub(crate) const MIRROR: Key<Words<Mirror>, Or<Mirror>> = Key::new(
    "mirror",
    Words(|| vec![("on", Mirror::On), ("off", Mirror::Off)]),
    "\"off\": no ways by the road; then the next four are errors",
)
.or(Mirror::On);

pub(crate) const ROAD_SUBSTANCE: Key<Text, Or<&'static str>> =
    Key::new("substance", SUBSTANCE.takes, "what it consists of").or("asphalt");

pub(crate) const ROAD_PERMITTIVITY: Key<Pair> =
    Key::new("permittivity", PERMITTIVITY.takes, "[ε′, ε″] of ε′ − jε″ instead of a substance");

pub(crate) const ROAD_OPENMATERIAL: Key<Text> = Key::new(
    "openmaterial",
    OPENMATERIAL.takes,
    "a material of OpenMATERIAL 3D instead of a substance; where it has a roughness, this is the default of \
     `rms_height_mm`",
);

/// RMS height: 0.5 mm costs 0.1 to 0.9 dB at the grazing angles of 60 to 25 m (docs/physics.md §5).
pub(crate) const RMS_HEIGHT: Key<Number, Or<f64>> = Key::new(
    "rms_height_mm",
    Number(Between(0.0, 100.0)),
    "mm: root mean square of its height; the coherent reflection loses e^(−g²/2), g = 4πσ sinψ/λ",
)
.or(0.5);

pub(crate) const BACKSCATTER: Key<Words<Ground>, Or<Ground>> = Key::new(
    "backscatter",
    Words(|| vec![("off", Ground::Off), ("floor", Ground::Floor)]),
    "\"floor\": σ⁰ = γ·sin ψ, ψ the grazing angle, vv and hh alike",
)
.or(Ground::Off);

/// Backscatter γ; the default is usual for flat ground (docs/scenes.md).
pub(crate) const GAMMA: Key<Number, Or<f64>> =
    Key::new("backscatter_gamma_db", Number(Between(-100.0, 30.0)), "dB: γ, with \"floor\"").or(-20.0);
