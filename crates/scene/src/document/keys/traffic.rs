//! `[traffic]` and its `models`.

use crate::document::keys::bodies;
use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Choice, Integer, Number, Subtables, TableForm, Text, Texts};
use crate::wording::allowed_range::AllowedRange::{Above, Between};
use artifact::settings::Class;

pub(crate) const TRAFFIC: Table = Table {
    name: "traffic",
    heading: "[traffic]",
    about: "Vehicles that move as SUMO recorded them, or as a ground truth of OSI tells.",
    keys: &[&FCD, &OSI, &NET, &BEGIN, &END, &MODELS, &VIEW_RANGE, &VIEW_NEAREST, &VIEW_HALF_ANGLE],
};

pub(crate) const FCD: Key<Text> = Key::new(
    "fcd",
    Text("a file"),
    "floating-car data as SUMO writes them (`--fcd-output`), plain or packed by gzip, told by its first \
     bytes; one of these two is required",
);

pub(crate) const OSI: Key<Text> = Key::new(
    "osi",
    Text("a file"),
    "a trace of `GroundTruth` or `SensorView` messages of ASAM OSI, `.osi` or MCAP, told by its first \
     bytes, in place of `fcd`; read by programs built with `--features interchange`",
);

pub(crate) const NET: Key<Text> = Key::new(
    "net",
    Text("a file"),
    "the network that was recorded (`.net.xml`, plain or packed by gzip): its lanes are those that \
     points, objects, tracks and truths are told by, in place of [intersection]. Read are the shapes and \
     widths of the lanes that come within `view_range_m` of the radar, 255 at most, numbered from 1 in \
     the order of the file (`lanes` of the summary has their names); not those inside junctions, \
     crossings and footpaths. Coordinates are those of the recording; a network without a lane in view is \
     refused",
);

pub(crate) const BEGIN: Key<Number> = Key::new(
    "begin_s",
    Number(Between(-1e11, 1e11)),
    "the recording's time at the first frame's first sample; left out: its first step",
);

pub(crate) const END: Key<Number> = Key::new(
    "end_s",
    Number(Between(-1e11, 1e11)),
    "of the last frame at most; left out: the recording's last step",
);

pub(crate) const MODELS: Key<Subtables> = Key::new(
    "models",
    Subtables { form: TableForm::NamedOrTexts, table: &MODEL_OF_TYPE },
    "for each vType its model: a name as a target's `model`, a list of which every vehicle takes one \
     (always the same for the same id), or a table as below",
);

pub(crate) const VIEW_RANGE: Key<Number> = Key::new(
    "view_range_m",
    Number(Above(0.0, 1e5)),
    "m on the ground: what is further away is not in view; left out: the range limit of the waveform, \
     beyond which beat frequencies fold",
);

pub(crate) const VIEW_NEAREST: Key<Number, DefaultValue<f64>> = Key::new(
    "view_nearest_m",
    Number(Between(0.0, 1e5)),
    "m on the ground: bodies that reach nearer to the radar's foot stand below its beam and are not in \
     view. A roof a metre or two below the antenna is larger than its distance, and takes hundreds of \
     thousands of paths",
)
.with_default(0.0);

pub(crate) const VIEW_HALF_ANGLE: Key<Number, DefaultValue<f64>> = Key::new(
    "view_half_angle_deg",
    Number(Above(0.0, 180.0)),
    "degrees off the boresight to either side; 90 is the half plane that the array faces",
)
.with_default(90.0);

/// Each entry of `models` in `[traffic]` that is a table.
pub(crate) const MODEL_OF_TYPE: Table = Table {
    name: "traffic.models",
    heading: "models of [traffic]",
    about: "The models that vehicles of one type may have.",
    keys: &[&MODEL, &CLASS, &VEHICLE_SEED, &UNIT_SCALE],
};

pub(crate) const MODEL: Key<Texts> =
    Key::new("model", Texts("a name or a list of names"), "as a target's").required();

pub(crate) const CLASS: Key<Choice<Class>> =
    Key::new("class", bodies::CLASS.takes, "truth for the classifier")
        .absent("the vehicle's")
        .allowed("as a target's");

pub(crate) const VEHICLE_SEED: Key<Integer, DefaultValue<u64>> =
    Key::new("vehicle_seed", bodies::VEHICLE_SEED.takes, "of the project's vehicles")
        .with_default(0)
        .allowed("as a target's");

pub(crate) const UNIT_SCALE: Key<Number> =
    Key::new("unit_scale", bodies::UNIT_SCALE.takes, "of files").allowed("as a target's");
