//! `[intersection]` and `[radar.intersection]`.

use crate::document::keys::key::{DefaultValue, Key, Table};
use crate::document::keys::kinds::{Number, Numbers, Vector};
use crate::document::ranges::COORDINATES_M;
use crate::wording::allowed_range::AllowedRange::{Above, Between};

pub(crate) const INTERSECTION: Table = Table {
    name: "intersection",
    heading: "[intersection]",
    about: "The crossing and its lanes.",
    keys: &[&LANE_CENTRES, &LANE_WIDTH, &LANE_ORIGIN, &LANE_AZIMUTH, &CROSSING_WIDTH],
};

/// The default is the paper's Table 1.
pub(crate) const LANE_CENTRES: Key<Numbers, DefaultValue<&'static [f64]>> = Key::new(
    "lane_centres_m",
    Numbers { length: Between(0.0, 32.0), each: Between(-1e3, 1e3) },
    "m: each lane's middle to the right of the origin, looking along the lanes; lanes may touch, not overlap",
)
.with_default(&[2.0, 5.75, 9.5]);

pub(crate) const LANE_WIDTH: Key<Number, DefaultValue<f64>> =
    Key::new("lane_width_m", Number(Above(0.0, 100.0)), "m").with_default(3.75);

pub(crate) const LANE_ORIGIN: Key<Vector<2>, DefaultValue<[f64; 2]>> = Key::new(
    "lane_origin_m",
    Vector(COORDINATES_M),
    "m, world x and y: from where lanes are counted across, and `y_m` of targets along; without lanes by \
     default the radar",
)
.with_default([0.0, 0.0]);

pub(crate) const LANE_AZIMUTH: Key<Number, DefaultValue<f64>> = Key::new(
    "lane_azimuth_deg",
    Number(Between(-360.0, 360.0)),
    "degrees from +y towards +x: the way along the lanes; without lanes by default the boresight's",
)
.with_default(0.0);

pub(crate) const CROSSING_WIDTH: Key<Number, DefaultValue<f64>> = Key::new(
    "crossing_width_m",
    Number(Between(0.0, 1e3)),
    "m of the crossing road along y; with [traffic] and without this table 0",
)
.with_default(22.5);

/// The lanes that one radar uses.
pub(crate) const RADAR_INTERSECTION: Table = Table {
    name: "radar.intersection",
    heading: "[radar.intersection]",
    about: "The lanes that this radar tells by, where they are not those of [intersection].",
    keys: &[&OWN_LANE_CENTRES, &OWN_LANE_WIDTH, &OWN_LANE_ORIGIN, &OWN_LANE_AZIMUTH],
};

pub(crate) const OWN_LANE_CENTRES: Key<Numbers> =
    Key::new("lane_centres_m", LANE_CENTRES.takes, "as there").absent("those of [intersection]");

pub(crate) const OWN_LANE_WIDTH: Key<Number> =
    Key::new("lane_width_m", LANE_WIDTH.takes, "as there").absent("that of [intersection]");

pub(crate) const OWN_LANE_ORIGIN: Key<Vector<2>> =
    Key::new("lane_origin_m", LANE_ORIGIN.takes, "as there").absent("that of [intersection]");

pub(crate) const OWN_LANE_AZIMUTH: Key<Number> =
    Key::new("lane_azimuth_deg", LANE_AZIMUTH.takes, "as there").absent("that of [intersection]");
