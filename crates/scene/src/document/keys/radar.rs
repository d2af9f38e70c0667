//! `[radar]`, `[radar.link]` and `[[radars]]`.

use crate::document::keys::array::ARRAY;
use crate::document::keys::key::{Key, Or, Table};
use crate::document::keys::kinds::{Below, Name, Number, Vector};
use crate::document::keys::lanes::RADAR_INTERSECTION;
use crate::document::keys::receiver::{INTERFERER, RECEIVER};
use crate::document::keys::waveform::WAVEFORM;
use crate::document::ranges::COORDINATES_M;
use crate::wording::allowed::Allowed::Between;

const THE_NEXT_TABLES: &str = "the next six tables";

pub(crate) const RADAR: Table = Table {
    name: "radar",
    heading: "[radar]",
    about: "Where the radar stands.",
    keys: &[
        &POSITION,
        &BORESIGHT_AZ,
        &BORESIGHT_EL,
        &OF_WAVEFORM,
        &OF_ARRAY,
        &OF_LINK,
        &OF_RECEIVER,
        &OF_INTERFERER,
        &OF_INTERSECTION,
    ],
};

pub(crate) const POSITION: Key<Vector<3>, Or<[f64; 3]>> = Key::new(
    "position_m",
    Vector(COORDINATES_M),
    "m, world: the mean of the transmit row and that of the receive row",
)
.or([0.0, 0.0, 6.0]);

pub(crate) const BORESIGHT_AZ: Key<Number, Or<f64>> = Key::new(
    "boresight_az_deg",
    Number(Between(-360.0, 360.0)),
    "degrees from +y towards +x; azimuths of points are measured the same way",
)
.or(0.0);

pub(crate) const BORESIGHT_EL: Key<Number, Or<f64>> =
    Key::new("boresight_el_deg", Number(Between(-90.0, 90.0)), "degrees above the horizon").or(0.0);

pub(crate) const OF_WAVEFORM: Key<Below> = Key::new("waveform", Below::one(&WAVEFORM), THE_NEXT_TABLES);

pub(crate) const OF_ARRAY: Key<Below> = Key::new("array", Below::one(&ARRAY), THE_NEXT_TABLES);

pub(crate) const OF_LINK: Key<Below> = Key::new("link", Below::one(&LINK), THE_NEXT_TABLES);

pub(crate) const OF_RECEIVER: Key<Below> = Key::new("receiver", Below::one(&RECEIVER), THE_NEXT_TABLES);

pub(crate) const OF_INTERFERER: Key<Below> =
    Key::new("interferer", Below::several(&INTERFERER), THE_NEXT_TABLES);

pub(crate) const OF_INTERSECTION: Key<Below> =
    Key::new("intersection", Below::one(&RADAR_INTERSECTION), THE_NEXT_TABLES);

/// An entry of `[[radars]]`.
pub(crate) const RADARS: Table = Table {
    name: "radars",
    heading: "[[radars]]",
    about: "One of several radars: what of [radar] is otherwise with it.",
    keys: &[
        &ID,
        &OWN_POSITION,
        &OWN_BORESIGHT_AZ,
        &OWN_BORESIGHT_EL,
        &OWN_WAVEFORM,
        &OWN_ARRAY,
        &OWN_LINK,
        &OWN_RECEIVER,
        &OWN_INTERFERER,
        &OWN_INTERSECTION,
    ],
};

pub(crate) const ID: Key<Name> = Key::new("id", Name, "names the radar and the folder of its results")
    .required()
    .allowed("as `name`, unique");

pub(crate) const OWN_POSITION: Key<Vector<3>> =
    Key::new("position_m", POSITION.takes, "as there").absent("those of [radar]").allowed("");

pub(crate) const OWN_BORESIGHT_AZ: Key<Number> =
    Key::new("boresight_az_deg", BORESIGHT_AZ.takes, "as there").absent("those of [radar]").allowed("");

pub(crate) const OWN_BORESIGHT_EL: Key<Number> =
    Key::new("boresight_el_deg", BORESIGHT_EL.takes, "as there").absent("those of [radar]").allowed("");

pub(crate) const OWN_WAVEFORM: Key<Below> =
    Key::new("waveform", OF_WAVEFORM.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_ARRAY: Key<Below> =
    Key::new("array", OF_ARRAY.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_LINK: Key<Below> =
    Key::new("link", OF_LINK.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_RECEIVER: Key<Below> =
    Key::new("receiver", OF_RECEIVER.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_INTERFERER: Key<Below> =
    Key::new("interferer", OF_INTERFERER.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_INTERSECTION: Key<Below> =
    Key::new("intersection", OF_INTERSECTION.takes, "tables as those below [radar]")
        .absent("those of [radar]");

pub(crate) const LINK: Table = Table {
    name: "radar.link",
    heading: "[radar.link]",
    about: "Power and gain.",
    keys: &[&TRANSMIT_POWER, &ANTENNA_GAIN],
};

pub(crate) const TRANSMIT_POWER: Key<Number, Or<f64>> =
    Key::new("transmit_power_dbm", Number(Between(-200.0, 200.0)), "dBm of each transmitter").or(12.0);

pub(crate) const ANTENNA_GAIN: Key<Number, Or<f64>> = Key::new(
    "antenna_gain_dbi",
    Number(Between(-100.0, 100.0)),
    "dBi of each transmit and each receive element at boresight",
)
.or(10.0);
