//! `[radar]`, `[radar.link]` and `[[radars]]`.

use crate::document::keys::array::ARRAY;
use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Name, Number, Subtables, Vector};
use crate::document::keys::lanes::RADAR_INTERSECTION;
use crate::document::keys::receiver::{INTERFERER, RECEIVER};
use crate::document::keys::waveform::WAVEFORM;
use crate::document::ranges::COORDINATES_M;
use crate::wording::allowed_range::AllowedRange::Between;

const THE_NEXT_TABLES: &str = "the next six tables";

pub(crate) const RADAR: Table = Table {
    name: "radar",
    heading: "[radar]",
    about: "Where the radar stands.",
    keys: &[
        &POSITION,
        &BORESIGHT_AZ,
        &BORESIGHT_EL,
        &WAVEFORM_KEY,
        &ARRAY_KEY,
        &LINK_KEY,
        &RECEIVER_KEY,
        &INTERFERER_KEY,
        &INTERSECTION_KEY,
    ],
};

pub(crate) const POSITION: Key<Vector<3>, DefaultValue<[f64; 3]>> = Key::new(
    "position_m",
    Vector(COORDINATES_M),
    "m, world: the mean of the transmit row and that of the receive row",
)
.with_default([0.0, 0.0, 6.0]);

pub(crate) const BORESIGHT_AZ: Key<Number, DefaultValue<f64>> = Key::new(
    "boresight_az_deg",
    Number(Between(-360.0, 360.0)),
    "degrees from +y towards +x; azimuths of points are measured the same way",
)
.with_default(0.0);

pub(crate) const BORESIGHT_EL: Key<Number, DefaultValue<f64>> =
    Key::new("boresight_el_deg", Number(Between(-90.0, 90.0)), "degrees above the horizon").with_default(0.0);

pub(crate) const WAVEFORM_KEY: Key<Subtables> =
    Key::new("waveform", Subtables::one(&WAVEFORM), THE_NEXT_TABLES);

pub(crate) const ARRAY_KEY: Key<Subtables> = Key::new("array", Subtables::one(&ARRAY), THE_NEXT_TABLES);

pub(crate) const LINK_KEY: Key<Subtables> = Key::new("link", Subtables::one(&LINK), THE_NEXT_TABLES);

pub(crate) const RECEIVER_KEY: Key<Subtables> =
    Key::new("receiver", Subtables::one(&RECEIVER), THE_NEXT_TABLES);

pub(crate) const INTERFERER_KEY: Key<Subtables> =
    Key::new("interferer", Subtables::several(&INTERFERER), THE_NEXT_TABLES);

pub(crate) const INTERSECTION_KEY: Key<Subtables> =
    Key::new("intersection", Subtables::one(&RADAR_INTERSECTION), THE_NEXT_TABLES);

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

pub(crate) const OWN_WAVEFORM: Key<Subtables> =
    Key::new("waveform", WAVEFORM_KEY.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_ARRAY: Key<Subtables> =
    Key::new("array", ARRAY_KEY.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_LINK: Key<Subtables> =
    Key::new("link", LINK_KEY.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_RECEIVER: Key<Subtables> =
    Key::new("receiver", RECEIVER_KEY.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_INTERFERER: Key<Subtables> =
    Key::new("interferer", INTERFERER_KEY.takes, "tables as those below [radar]").absent("those of [radar]");

pub(crate) const OWN_INTERSECTION: Key<Subtables> =
    Key::new("intersection", INTERSECTION_KEY.takes, "tables as those below [radar]")
        .absent("those of [radar]");

pub(crate) const LINK: Table = Table {
    name: "radar.link",
    heading: "[radar.link]",
    about: "Power and gain.",
    keys: &[&TRANSMIT_POWER, &ANTENNA_GAIN],
};

pub(crate) const TRANSMIT_POWER: Key<Number, DefaultValue<f64>> =
    Key::new("transmit_power_dbm", Number(Between(-200.0, 200.0)), "dBm of each transmitter")
        .with_default(12.0);

pub(crate) const ANTENNA_GAIN: Key<Number, DefaultValue<f64>> = Key::new(
    "antenna_gain_dbi",
    Number(Between(-100.0, 100.0)),
    "dBi of each transmit and each receive element at boresight",
)
.with_default(10.0);
