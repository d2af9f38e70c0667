//! Lanes of a SUMO network (`.net.xml`, plain or packed by gzip): their courses, widths and names.
//!
//! Schema: `net_file.xsd` of SUMO (<https://sumo.dlr.de/docs/Networks/SUMO_Road_Networks.html>): `<net>`
//! holds `<edge>`, which hold `<lane id shape width …>`; the shape is a list of places x,y along the lane's
//! middle. Coordinates are those of the recording, and thus the scene's. Ignored are lanes within junctions
//! and crossings (`function` of the edge), which overlap, and those for pedestrians only.

use crate::recording::field_of_view::FieldOfView;
use crate::recording::xml::{self, Element, XmlFault, XmlReader};
use crate::wording::excerpt::excerpt;
use artifact::settings::NetworkLane;
use quick_xml::events::BytesStart;
use std::path::{Path, PathBuf};

/// Fault of a network, and its place.
#[derive(Debug, thiserror::Error)]
#[error("{}:{line}: {rule}", file.display())]
pub struct NetError {
    /// File of the network.
    pub file: PathBuf,
    /// Line of the unpacked text, from 1.
    pub line: u64,
    /// Rule that the network breaks.
    pub rule: NetRule,
}

impl NetError {
    /// Whether the system is at fault, not the content of the file.
    pub fn is_system(&self) -> bool {
        matches!(self.rule, NetRule::Text(XmlFault::Unreadable(_)))
    }
}

/// Broken rules of a network.
#[derive(Debug, thiserror::Error)]
pub enum NetRule {
    /// The file cannot be read, or is not XML.
    #[error("{0}")]
    Text(#[source] XmlFault),
    /// XML of another kind.
    #[error("the first element is <{0}>; networks begin with <net>")]
    NotANetwork(String),
    /// No element at all, or an end too early.
    #[error("the file ends before </net>: it was cut off, or holds no network")]
    CutOff,
    /// The file has more text than any town's network.
    #[error("more than {0} bytes of text")]
    TooLong(u64),
    /// A lane without a position.
    #[error("<lane{}>: attribute `{attribute}` is missing", named(.id))]
    Missing {
        /// Id of the lane, if known.
        id: Option<String>,
        /// Name of the attribute.
        attribute: &'static str,
    },
    /// An attribute with a wrong value.
    #[error("<lane{}>: `{attribute}` is `{found}`; it must be {allowed}", named(.id))]
    Wrong {
        /// Id of the lane, if known.
        id: Option<String>,
        /// Name of the attribute.
        attribute: &'static str,
        /// Value in the file.
        found: String,
        /// Values that the attribute may have, in words.
        allowed: &'static str,
    },
    /// The network has more lanes than can be counted.
    #[error("more than {0} lanes are in view: see less far by `view_range_m`")]
    TooMany(usize),
    /// Lanes of another place, or none.
    #[error(
        "none of its {lanes} lanes comes within {range_m:.1} m of the radar's foot: the origin of both is the same?"
    )]
    NoneInView {
        /// Number of lanes for vehicles.
        lanes: usize,
        /// Range of view, `view_range_m`.
        range_m: f64,
    },
}

fn named(id: &Option<String>) -> String {
    id.as_ref().map_or(String::new(), |id| format!(" id=\"{id}\""))
}

/// Largest network in bytes: that of a large town has some hundred megabytes.
const LIMIT_BYTES: u64 = 1 << 30;
/// Largest number of lanes: they are numbered by a byte, from 1.
const LANE_LIMIT: usize = 255;
/// SUMO's default width of a lane.
const DEFAULT_WIDTH_M: f64 = 3.2;
const COORDINATE_LIMIT_M: f64 = 1e5;
const NAME_LIMIT_BYTES: usize = 256;

/// Lanes with a part within the range of view, on any side, numbered from 1 in the order of the file.
pub(crate) fn read_net(file: &Path, view: &FieldOfView) -> Result<Vec<NetworkLane>, NetError> {
    let error = |line, rule| NetError { file: file.to_owned(), line, rule };
    let mut text = XmlReader::open(file).map_err(|fault| error(1, NetRule::Text(fault)))?;
    let mut net = Net { view, place: NetPlace::Before, is_passed_over: false, lanes: 0, courses: vec![] };
    loop {
        let read = net.advance(&mut text);
        match read.map_err(|rule| error(text.line(), rule))? {
            Progress::Goes if text.bytes() > LIMIT_BYTES => {
                return Err(error(text.line(), NetRule::TooLong(LIMIT_BYTES)));
            }
            Progress::Goes => {}
            Progress::IsDone if net.courses.is_empty() => {
                return Err(error(
                    text.line(),
                    NetRule::NoneInView { lanes: net.lanes, range_m: view.range_m() },
                ));
            }
            Progress::IsDone => return Ok(net.courses),
        }
    }
}

/// Place of the reader in the document.
#[derive(Clone, Copy, PartialEq)]
enum NetPlace {
    Before,
    Inside,
    Behind,
}

enum Progress {
    Goes,
    IsDone,
}

struct Net<'v> {
    view: &'v FieldOfView,
    place: NetPlace,
    /// Whether the open edge is ignored.
    is_passed_over: bool,
    /// Number of lanes for vehicles, in view or not.
    lanes: usize,
    courses: Vec<NetworkLane>,
}

impl Net<'_> {
    /// Reads one element.
    fn advance(&mut self, text: &mut XmlReader) -> Result<Progress, NetRule> {
        let (element, _) = text.next_element().map_err(NetRule::Text)?;
        match element {
            Element::Opens(tag) => self.open(&tag, NetPlace::Inside)?,
            Element::Empty(tag) => self.open(&tag, NetPlace::Behind)?,
            Element::Closes(tag) if tag.name().as_ref() == "net" => self.place = NetPlace::Behind,
            Element::FileEnds if self.place == NetPlace::Behind => return Ok(Progress::IsDone),
            Element::FileEnds => return Err(NetRule::CutOff),
            Element::Closes(_) | Element::Other => {}
        }
        Ok(Progress::Goes)
    }

    /// Handles an opening element; `within` is the reader's place after the first one.
    fn open(&mut self, tag: &BytesStart<'_>, within: NetPlace) -> Result<(), NetRule> {
        match (tag.name().as_ref(), self.place) {
            ("net", NetPlace::Before) => self.place = within,
            (other, NetPlace::Before) => return Err(NetRule::NotANetwork(excerpt(other))),
            ("edge", _) => {
                let attributes = xml::attributes(tag).map_err(NetRule::Text)?;
                let function = find(&attributes, "function").unwrap_or("normal");
                self.is_passed_over = !matches!(function, "normal" | "connector");
            }
            ("lane", _) if !self.is_passed_over => self.add(&xml::attributes(tag).map_err(NetRule::Text)?)?,
            _ => {}
        }
        Ok(())
    }

    fn add(&mut self, attributes: &[(String, String)]) -> Result<(), NetRule> {
        if find(attributes, "allow").is_some_and(|allowed| allowed.trim() == "pedestrian") {
            return Ok(());
        }
        let (line_m, width_m) = (shape(attributes)?, width(attributes)?);
        let name = text(attributes, "id")?;
        if name.len() > NAME_LIMIT_BYTES {
            return Err(wrong(attributes, "id", name, "of at most 256 bytes"));
        }
        self.lanes += 1;
        if !line_m.windows(2).any(|ends| self.view.reaches(ends[0].into(), ends[1].into())) {
            return Ok(());
        }
        if self.courses.len() == LANE_LIMIT {
            return Err(NetRule::TooMany(LANE_LIMIT));
        }
        let number = (self.courses.len() + 1) as u8;
        self.courses.push(NetworkLane { number, name: name.to_owned(), width_m, line_m });
        Ok(())
    }
}

fn find<'a>(attributes: &'a [(String, String)], name: &str) -> Option<&'a str> {
    attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
}

fn text<'a>(attributes: &'a [(String, String)], attribute: &'static str) -> Result<&'a str, NetRule> {
    let missing = || NetRule::Missing { id: find(attributes, "id").map(excerpt), attribute };
    find(attributes, attribute).filter(|text| !text.is_empty()).ok_or_else(missing)
}

fn wrong(
    attributes: &[(String, String)],
    attribute: &'static str,
    found: &str,
    allowed: &'static str,
) -> NetRule {
    NetRule::Wrong { id: find(attributes, "id").map(excerpt), attribute, found: excerpt(found), allowed }
}

fn width(attributes: &[(String, String)]) -> Result<f64, NetRule> {
    let Some(found) = find(attributes, "width") else { return Ok(DEFAULT_WIDTH_M) };
    let width_m = found.trim().parse().ok().filter(|width_m: &f64| *width_m > 0.0 && *width_m <= 100.0);
    width_m.ok_or_else(|| wrong(attributes, "width", found, "m above 0, to 100"))
}

/// Places along a lane's middle, at least two; a third coordinate, the height, is ignored.
fn shape(attributes: &[(String, String)]) -> Result<Vec<[f64; 2]>, NetRule> {
    let found = text(attributes, "shape")?;
    let places: Option<Vec<[f64; 2]>> = found.split_whitespace().map(place).collect();
    let places = places.map(|mut places| {
        places.dedup();
        places
    });
    let places = places.filter(|places| places.len() >= 2);
    places.ok_or_else(|| wrong(attributes, "shape", found, "two places x,y or more, m within ±1e5"))
}

fn place(text: &str) -> Option<[f64; 2]> {
    let coordinates: Vec<f64> = text.split(',').map(|part| part.parse().ok()).collect::<Option<_>>()?;
    match coordinates[..] {
        [x, y] | [x, y, _] if [x, y].iter().all(|c| c.abs() <= COORDINATE_LIMIT_M) => Some([x, y]),
        _ => None,
    }
}
