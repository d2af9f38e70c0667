//! `[[target]]` and `[[clutter]]`.

use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Choice, Either, Integer, Name, Number, Text, Vector};
use crate::document::ranges::{COORDINATES_M, SEEDS, VELOCITIES_MPS};
use crate::mesh::UNIT_SCALES;
use crate::wording::allowed_range::AllowedRange::Between;
use artifact::settings::Class;

/// Kind of a target.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Body {
    Mesh,
    Point,
}

/// Height of a lamp's column; the range covers a cane to a gantry's leg.
pub(crate) const POLE_HEIGHT: Key<Number, DefaultValue<f64>> =
    Key::new("height_m", Number(Between(0.1, 100.0)), "of a pole").with_default(6.0);

/// Height of a sign; by default the plate's lower edge is 2.25 m over a footway.
pub(crate) const SIGN_HEIGHT: Key<Number, DefaultValue<f64>> =
    Key::new("height_m", Number(Between(0.7, 20.0)), "of a sign").with_default(2.85);

pub(crate) const TARGET: Table = Table {
    name: "target",
    heading: "[[target]]",
    about: "A vehicle or a point, where it is and how it moves.",
    keys: &[
        &KIND,
        &ID,
        &POSITION,
        &LANE,
        &Y,
        &VELOCITY,
        &ACCELERATION,
        &WHEEL_RADIUS,
        &WHEEL_ANGLE,
        &YAW,
        &YAW_RATE,
        &MODEL,
        &CLASS,
        &VEHICLE_SEED,
        &UNIT_SCALE,
        &RCS,
    ],
};

pub(crate) const KIND: Key<Choice<Body>> = Key::new(
    "kind",
    Choice(|| vec![("mesh", Body::Mesh), ("point", Body::Point)]),
    "a body, or a point that scatters alike in every direction",
)
.required();

pub(crate) const ID: Key<Name> =
    Key::new("id", Name, "names the target in results").required().allowed("as `name`; unique");

/// Required without `lane` and `y_m`.
pub(crate) const POSITION: Key<Vector<3>> = Key::new(
    "position_m",
    Vector(COORDINATES_M),
    "m, world: of the point (a wavelength or more from the radar's elements), or of the body's origin, \
     which is the centre of its bounding box, on the ground",
)
.absent("required");

pub(crate) const LANE: Key<Integer> = Key::new(
    "lane",
    Integer(Between(1.0, 255.0)),
    "with `y_m` instead of `position_m`: the middle of that lane, on the ground",
)
.allowed("a lane's number");

pub(crate) const Y: Key<Number> = Key::new(
    "y_m",
    Number(COORDINATES_M),
    "m along the lanes from their origin: world y where they run along it",
);

pub(crate) const VELOCITY: Key<Vector<3>, DefaultValue<[f64; 3]>> = Key::new(
    "velocity_mps",
    Vector(VELOCITIES_MPS),
    "m/s, world; with `acceleration_mps2` that at the first sample",
)
.with_default([0.0; 3]);

/// Acceleration up to ten times that of braking and falling.
pub(crate) const ACCELERATION: Key<Vector<3>, DefaultValue<[f64; 3]>> = Key::new(
    "acceleration_mps2",
    Vector(Between(-100.0, 100.0)),
    "m/s², world, constant from the first frame's first sample on, within frames too; where the body turns \
     (`yaw_rate_dps`) it turns with it",
)
.with_default([0.0; 3]);

pub(crate) const WHEEL_RADIUS: Key<Number> = Key::new(
    "wheel_radius_m",
    Number(Between(0.01, 10.0)),
    "point only: the point is on the rim of a wheel of this radius, whose hub is at `position_m` and \
     which rolls along `yaw_deg` (left out: along the velocity) without slipping; not with `echo = \
     \"rcs-table\"`",
);

pub(crate) const WHEEL_ANGLE: Key<Number, DefaultValue<f64>> = Key::new(
    "wheel_angle_deg",
    Number(Between(-360.0, 360.0)),
    "with `wheel_radius_m`: where on the rim at the first sample, from forward towards up",
)
.with_default(0.0);

pub(crate) const YAW: Key<Number> = Key::new(
    "yaw_deg",
    Number(Between(-360.0, 360.0)),
    "mesh, or point on a wheel: degrees of the body's x axis (forward) from world +x towards +y; left \
     out: along the velocity, and -90 (down the lane, towards the radar) at rest",
);

/// Yaw rate: a vehicle at walking pace within its turning circle turns by 20°/s, a thrown one at a few turns
/// per second.
pub(crate) const YAW_RATE: Key<Number, DefaultValue<f64>> = Key::new(
    "yaw_rate_dps",
    Number(Between(-720.0, 720.0)),
    "mesh only: degrees a second by which the body turns about the vertical through its origin, from world \
     +x towards +y; velocity and acceleration turn with it, so that it drives a bend",
)
.with_default(0.0);

pub(crate) const MODEL: Key<Text> = Key::new(
    "model",
    Text("a file or a vehicle's name"),
    "a `.glb`, `.gltf`, `.stl`, `.obj` or `.xoma` file, or one of the project's vehicles; `--model FILE` \
     replaces it for one run",
)
.absent("required for a mesh");

pub(crate) const CLASS: Key<Choice<Class>> =
    Key::new("class", Choice::CLASSES, "mesh only: truth for the classifier; unknown for a file without it")
        .absent("the vehicle's");

pub(crate) const VEHICLE_SEED: Key<Integer, DefaultValue<u64>> = Key::new(
    "vehicle_seed",
    Integer(SEEDS),
    "mesh only: which of the project's vehicles of that name: 0 has the nominal dimensions, every other \
     seed its own within real ranges",
)
.with_default(0);

pub(crate) const UNIT_SCALE: Key<Number> = Key::new(
    "unit_scale",
    Number(UNIT_SCALES),
    "mesh file only: metres in one unit of the file; left out: metres, and a model below a millimetre or \
     above a kilometre is refused",
);

/// RCS up to 60 dB beyond the largest ship; zero scatters nothing and is allowed.
pub(crate) const RCS: Key<Number> =
    Key::new("rcs_m2", Number(Between(0.0, 1e12)), "m²: the scattering amplitude is +√σ")
        .absent("required for a point");

pub(crate) const CLUTTER: Table = Table {
    name: "clutter",
    heading: "[[clutter]]",
    about: "A piece of what stands about in a street.",
    keys: &[
        &CLUTTER_ID,
        &CLUTTER_MODEL,
        &CLUTTER_POSITION,
        &CLUTTER_YAW,
        &LENGTH,
        &HEIGHT,
        &DIAMETER,
        &CLUTTER_UNIT_SCALE,
    ],
};

pub(crate) const CLUTTER_ID: Key<Name> =
    Key::new("id", Name, "names the piece in results").required().allowed("as a target's; unique among both");

pub(crate) const CLUTTER_MODEL: Key<Text> =
    Key::new("model", Text("a name below or a file"), "what it is; `--model` does not replace it").required();

pub(crate) const CLUTTER_POSITION: Key<Vector<3>> = Key::new(
    "position_m",
    Vector(COORDINATES_M),
    "m, world: of the centre of its bounding box, on the ground",
)
.required();

pub(crate) const CLUTTER_YAW: Key<Number, DefaultValue<f64>> =
    Key::new("yaw_deg", Number(Between(-360.0, 360.0)), "degrees of its x axis from world +x towards +y")
        .with_default(-90.0);

pub(crate) const LENGTH: Key<Number> =
    Key::new("length_m", Number(Between(0.2, 1000.0)), "m along x: required for \"guard-rail\" and \"kerb\"");

pub(crate) const HEIGHT: Key<Either> = Key::new(
    "height_m",
    Either([POLE_HEIGHT.takes, SIGN_HEIGHT.takes]),
    "m: of a \"pole\"; of a \"sign\" up to its upper edge",
)
.absent("6.0, 2.85");

pub(crate) const DIAMETER: Key<Number, DefaultValue<f64>> =
    Key::new("diameter_m", Number(Between(0.01, 5.0)), "m: of a \"pole\"").with_default(0.1143);

pub(crate) const CLUTTER_UNIT_SCALE: Key<Number> =
    Key::new("unit_scale", UNIT_SCALE.takes, "of a file").allowed("as a target's");
