//! `[materials]`, its layers, and `[road]`.

use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Boolean, Choice, Number, Pair, Subtables, TableForm, Text};
use crate::wording::allowed_range::AllowedRange::{self, Above, Between};
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
pub(crate) const LAYERS_OF_ONE: AllowedRange = Between(1.0, 32.0);

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

pub(crate) const LAYERS: Key<Subtables> = Key::new(
    "layers",
    Subtables { form: TableForm::List(LAYERS_OF_ONE), table: &LAYER },
    "several layers, the outermost first, instead of the four keys above",
)
.allowed("{} layers");

pub(crate) const BACKING: Key<Choice<Backing>, DefaultValue<Backing>> = Key::new(
    "backing",
    Choice(|| vec![("air", Backing::Air), ("metal", Backing::Metal)]),
    "what is behind the last layer",
)
.with_default(Backing::Air);

pub(crate) const COHERENT: Key<Boolean, DefaultValue<bool>> =
    Key::new("coherent", Boolean, "false: thicknesses are known about only, powers are averaged over them")
        .with_default(true);

/// A table of the `layers` of an entry.
pub(crate) const LAYER: Table = Table {
    name: "materials.layers",
    heading: "layers of [materials]",
    about: "A plane layer.",
    keys: &[&LAYER_SUBSTANCE, &LAYER_PERMITTIVITY, &LAYER_OPENMATERIAL, &LAYER_THICKNESS],
};

pub(crate) const LAYER_SUBSTANCE: Key<Text> =
    Key::new("substance", SUBSTANCE.takes, "one of these three is required")
        .allowed("as above, but \"metal\"");

pub(crate) const LAYER_PERMITTIVITY: Key<Pair> =
    Key::new("permittivity", PERMITTIVITY.takes, "").allowed("as above");

pub(crate) const LAYER_OPENMATERIAL: Key<Text> =
    Key::new("openmaterial", OPENMATERIAL.takes, "").allowed("as above, but no conductor");

pub(crate) const LAYER_THICKNESS: Key<Number> = Key::new("thickness_mm", THICKNESS.takes, "mm").required();

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

pub(crate) const MIRROR: Key<Choice<Mirror>, DefaultValue<Mirror>> = Key::new(
    "mirror",
    Choice(|| vec![("on", Mirror::On), ("off", Mirror::Off)]),
    "\"off\": no ways by the road; then the next four are errors",
)
.with_default(Mirror::On);

pub(crate) const ROAD_SUBSTANCE: Key<Text, DefaultValue<&'static str>> =
    Key::new("substance", SUBSTANCE.takes, "what it consists of").with_default("asphalt");

pub(crate) const ROAD_PERMITTIVITY: Key<Pair> =
    Key::new("permittivity", PERMITTIVITY.takes, "[ε′, ε″] of ε′ − jε″ instead of a substance");

pub(crate) const ROAD_OPENMATERIAL: Key<Text> = Key::new(
    "openmaterial",
    OPENMATERIAL.takes,
    "a material of OpenMATERIAL 3D instead of a substance; where it has a roughness, this is the default of \
     `rms_height_mm`",
);

/// RMS height: 0.5 mm costs 0.1 to 0.9 dB at the grazing angles of 60 to 25 m (docs/physics.md §5).
pub(crate) const RMS_HEIGHT: Key<Number, DefaultValue<f64>> = Key::new(
    "rms_height_mm",
    Number(Between(0.0, 100.0)),
    "mm: root mean square of its height; the coherent reflection loses e^(−g²/2), g = 4πσ sinψ/λ",
)
.with_default(0.5);

pub(crate) const BACKSCATTER: Key<Choice<Ground>, DefaultValue<Ground>> = Key::new(
    "backscatter",
    Choice(|| vec![("off", Ground::Off), ("floor", Ground::Floor)]),
    "\"floor\": σ⁰ = γ·sin ψ, ψ the grazing angle, vv and hh alike",
)
.with_default(Ground::Off);

/// Backscatter γ; the default is usual for flat ground (docs/scenes.md).
pub(crate) const GAMMA: Key<Number, DefaultValue<f64>> =
    Key::new("backscatter_gamma_db", Number(Between(-100.0, 30.0)), "dB: γ, with \"floor\"")
        .with_default(-20.0);
