//! `[traffic]`: vehicles that move as recorded by SUMO, or in a ground truth of OSI.
//!
//! The recording is read once, step by step ([`fcd`], and messages of OSI alike); of every step only the
//! vehicles in the radar's view at a frame's first sample are kept, placed between the steps by
//! [`interpolation`]. So memory grows with the vehicles in view in the requested frames, not with the
//! recording.

mod osi_types; // stand-ins for objects of OSI
mod source; // SUMO's recordings and OSI's traces

pub use crate::recording::{fcd, interpolation, net};

use crate::document::entries::{ModelChoice, model_choices};
use crate::document::errors::Rule;
use crate::document::keys::scene::{FRAMES, INTERSECTION_KEY};
use crate::document::keys::traffic::{
    BEGIN, CLASS, END, FCD, MODEL, NET, OSI, TRAFFIC, VIEW_HALF_ANGLE, VIEW_NEAREST, VIEW_RANGE,
};
use crate::document::section::Section;
use crate::models::library::{ChosenModel, Models};
use crate::models::nearest_in_size::nearest_in_size;
use crate::recording::fcd::{FcdError, FcdRule, FcdVehicle, UnknownType};
use crate::recording::field_of_view::FieldOfView;
use crate::recording::frame_clock::{FrameClock, FrameTimes};
use crate::recording::interpolation::Interval;
use crate::recording::net::read_net;
use crate::recording::odometer::Odometer;
use crate::recording::trace::type_names;
use crate::wording::similarity::nearest;
use artifact::radar::Radar;
use artifact::scene::{Target, TargetKind, Traffic, Vehicle, VehiclePose};
use artifact::seed;
use artifact::settings::{Class, NetworkLane};
use glam::DVec2;
use osi_types::{StandIn, stand_in_of, types_with_stand_in};
use radar::aperture::horizontal;
use source::{Source, StepReader};
use std::collections::{BTreeSet, HashMap, HashSet};

/// Models of SUMO's vTypes and vehicle classes without an entry in `models`: those of the project of about
/// that length.
const DEFAULT_MODELS: [(&str, &str); 11] = [
    ("car", "car-sedan"),
    ("passenger", "car-sedan"),
    ("DEFAULT_VEHTYPE", "car-sedan"),
    ("taxi", "car-sedan"),
    ("bus", "bus-city"),
    ("coach", "bus-coach"),
    ("truck", "truck-box"),
    ("delivery", "truck-box"),
    ("trailer", "truck-semi"),
    ("motorcycle", "motorcycle-street"),
    ("moped", "motorcycle-scooter"),
];

/// Recorded traffic as `[traffic]` describes it.
pub(crate) struct Recording<'d> {
    section: Section<'d>,
    source: Source,
    /// Models by type.
    models: HashMap<String, Vec<PlacedModel>>,
    /// The project's own vehicles that were chosen by size.
    by_size: HashMap<&'static str, PlacedModel>,
    unknown: Vec<UnknownType>,
    /// Types of the recording that are named in `models`.
    used_types: HashSet<String>,
    /// Types without an entry in `models` that use their default model, each with its first vehicle.
    by_default: Vec<UnknownType>,
    times: FrameTimes,
    view: FieldOfView,
}

/// Largest number of reported unknown types; in a recording with more, none is known.
const MOST_UNKNOWN_TYPES: usize = 100;

/// Largest number of poses in view: three gibibytes.
const POSE_LIMIT: usize = 1 << 25;

/// A model with its placement: its origin is the centre of its bounding box.
#[derive(Clone)]
struct PlacedModel {
    kind: TargetKind,
    /// Distance from the origin to the front bumper.
    reach_m: f64,
    /// Distance from the origin to the farthest corner, seen from above.
    radius_m: f64,
}

/// Reads `[traffic]` of a scene and its models, without opening its recording; `None` without the table, or
/// if no recording is named.
pub(crate) fn read_traffic<'d>(
    root: &Section<'d>,
    radar: &Radar,
    interval_s: f64,
    models: &mut Models,
) -> Option<Recording<'d>> {
    let section = root.section(&TRAFFIC);
    if !section.exists() {
        return None;
    }
    let source = read_source(&section, models);
    let times = read_times(root, &section, interval_s);
    let view = read_view(&section, radar);
    let of_types = models_of_types(&section, source.as_ref(), models);
    Some(Recording {
        section,
        source: source?,
        models: of_types,
        by_size: HashMap::new(),
        unknown: vec![],
        used_types: HashSet::new(),
        by_default: vec![],
        times,
        view,
    })
}

/// The recording named by one of two keys.
fn read_source(section: &Section<'_>, models: &mut Models) -> Option<Source> {
    if section.has(OSI.name) && section.has(FCD.name) {
        section.note(OSI.name, Rule::Contradiction { key: OSI.name, other: FCD.name });
        return None;
    }
    if let Some(written) = section.read(&OSI) {
        return Some(Source::Osi(models.add_recording(written)));
    }
    if !section.has(OSI.name) {
        section.require(FCD.name);
    }
    section.read(&FCD).map(|written| Source::Fcd(models.add_recording(written)))
}

/// Reads the radar's view; the default is the range up to which a complex beat frequency does not fold, and
/// the half plane before the array.
fn read_view(section: &Section<'_>, radar: &Radar) -> FieldOfView {
    FieldOfView {
        foot_m: DVec2::new(radar.position_m[0], radar.position_m[1]),
        boresight: horizontal(radar.boresight_az_rad).into(),
        nearest_m: section.or_default(&VIEW_NEAREST),
        range_m: section.read(&VIEW_RANGE).unwrap_or(radar.waveform.range_max_m()),
        half_angle_rad: section.or_default(&VIEW_HALF_ANGLE).to_radians(),
    }
}

fn read_times(root: &Section<'_>, section: &Section<'_>, interval_s: f64) -> FrameTimes {
    let (begin_s, end_s) = (section.read(&BEGIN), section.read(&END));
    if let (Some(begin_s), Some(end_s)) = (begin_s, end_s)
        && end_s < begin_s
    {
        section.note(END.name, Rule::EndsBeforeItBegins { begin_s, end_s });
    }
    let frames = root.has(FRAMES.name).then(|| root.or_default(&FRAMES) as u32);
    FrameTimes { frames, interval_s, begin_s, end_s }
}

/// Models by the recording's names of types.
fn models_of_types(
    section: &Section<'_>,
    source: Option<&Source>,
    models: &mut Models,
) -> HashMap<String, Vec<PlacedModel>> {
    let mut of_types = HashMap::new();
    for choice in model_choices(section) {
        let found = choice.kind.to_owned();
        let placed = models_of_type(&choice, models);
        let told = source.map_or_else(|| Some(found.clone()), |source| source.canonical_type_name(&found));
        let Some(told) = told else {
            let known: Vec<&'static str> = type_names().collect();
            let rule = Rule::UnknownObjectType { nearest: nearest(&found, &known), found };
            choice.section.note(MODEL.name, rule);
            continue;
        };
        if of_types.insert(told.clone(), placed).is_some() {
            choice.section.note(MODEL.name, Rule::SameObjectType { found, told });
        }
    }
    of_types
}

/// The possible models of vehicles of a vType.
fn models_of_type(choice: &ModelChoice<'_>, models: &mut Models) -> Vec<PlacedModel> {
    let class = choice.section.read(&CLASS);
    let chosen = choice.names.iter().filter_map(|name| models.choose_written(&choice.section, name));
    let chosen: Vec<ChosenModel> = chosen.collect();
    chosen.into_iter().map(|chosen| PlacedModel::of(chosen, class, models)).collect()
}

impl PlacedModel {
    fn of(chosen: ChosenModel, class: Option<Class>, models: &Models) -> Self {
        let ChosenModel { name, mesh, class: own } = chosen;
        let vertices = || models.meshes().get(mesh as usize).into_iter().flat_map(|mesh| &mesh.vertices_m);
        Self {
            kind: TargetKind::Mesh { class: class.or(own), model: name, mesh },
            reach_m: vertices().map(|v| v[0]).fold(0.0, f64::max),
            radius_m: vertices().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max),
        }
    }
}

impl Recording<'_> {
    /// Reads the lanes of the network named by `net`; faults are noted. `roads`: tables that may specify
    /// lanes themselves.
    pub(crate) fn lanes(&self, roads: [&Section<'_>; 2], models: &mut Models) -> Vec<NetworkLane> {
        let Some(written) = self.section.read(&NET) else { return vec![] };
        let file = models.add_input(written);
        if roads.iter().any(|table| table.has(INTERSECTION_KEY.name)) {
            self.section.note(NET.name, Rule::Contradiction { key: NET.name, other: "[intersection]" });
        }
        read_net(&file, &self.view).unwrap_or_else(|error| {
            self.section.note(NET.name, Rule::Net(error));
            vec![]
        })
    }

    /// Reads the frames of the recording with the vehicles in view in each; faults are noted.
    pub(crate) fn frames(mut self, models: &mut Models, targets: &[Target]) -> Traffic {
        self.read(models, targets).unwrap_or_else(|error| {
            let key = match (&self.source, error.rule.as_ref()) {
                (_, FcdRule::EndsBeforeRecording { .. }) => END.name,
                (Source::Osi(_), _) => OSI.name,
                (Source::Fcd(_), _) => FCD.name,
            };
            self.section.note(key, Rule::Traffic(error));
            Traffic::default()
        })
    }

    fn read(&mut self, models: &mut Models, targets: &[Target]) -> Result<Traffic, FcdError> {
        let mut reader = self.source.open()?;
        let (mut visible, mut interval, mut clock) =
            (VisibleVehicles::new(targets), Interval::default(), None);
        let mut odometer = Odometer::default();
        while let Some(step) = reader.next_step()? {
            let clock = clock.get_or_insert_with(|| FrameClock::of(self.times, step.time_s));
            let line = step.line;
            interval.advance(step);
            odometer.add(&interval);
            while let Some(time_s) =
                clock.frame_until(interval.end_s()).map_err(|rule| reader.error_at(line, rule))?
            {
                let kept = self.keep_frame(&mut visible, models, (&reader, &interval), time_s);
                kept.map_err(|(line, rule)| reader.error_at(line, rule))?;
            }
            if clock.is_complete() {
                break;
            }
        }
        if let Some(first) = self.unknown.first() {
            return Err(reader.error_at(first.line, self.unknown_types()));
        }
        if let Some((found, name)) = misspelt(&self.by_default, self.models.keys(), &self.used_types) {
            let (found, name) = (found.clone(), name.to_owned());
            return Err(reader.error_at(found.line, FcdRule::Misspelt { found, name }));
        }
        odometer.checked().map_err(|rule| reader.error_at(1, rule))?;
        let clock = clock.ok_or_else(|| reader.without_steps())?;
        clock.checked(interval.end_s()).map_err(|rule| reader.error_at(1, rule))?;
        Ok(visible.traffic)
    }

    /// Keeps the vehicles in view at a time; an error has the line of the vehicle concerned.
    fn keep_frame(
        &mut self,
        visible: &mut VisibleVehicles<'_>,
        models: &mut Models,
        (reader, interval): (&StepReader, &Interval),
        time_s: f64,
    ) -> Result<(), (u64, FcdRule)> {
        let mut placed = vec![];
        for vehicle in interval.vehicles() {
            let Some(bumper) = interval.bumper(vehicle, time_s) else { continue };
            let known = visible.model_of(vehicle).cloned();
            let drawn = || self.model_of(vehicle, reader.size_m(&vehicle.id), models);
            let Some(model) = known.or_else(drawn) else { continue };
            let pose = bumper.pose(self.reach_m(&model));
            let [x, y, _] = pose.position_m;
            if self.view.touches(DVec2::new(x, y), model.radius_m) {
                let vehicle = visible.place_of(vehicle, &model).map_err(|rule| (vehicle.line, rule))?;
                placed.push(VehiclePose { vehicle, pose });
            }
        }
        visible.poses += placed.len();
        if visible.poses > POSE_LIMIT {
            return Err((interval.line(), FcdRule::TooManyPoses(POSE_LIMIT)));
        }
        visible.traffic.frames.push(placed);
        Ok(())
    }

    /// One of the models of its type, always the same for the same id; records a type without models and
    /// returns `None`.
    fn model_of(
        &mut self,
        vehicle: &FcdVehicle,
        size_m: Option<[f64; 3]>,
        models: &mut Models,
    ) -> Option<PlacedModel> {
        // SUMO renames the vType of a changed vehicle, such as `car@flow.3`.
        let before_at = vehicle.kind.split('@').next().unwrap_or_default();
        let is_named = self.models.contains_key(&vehicle.kind);
        let name = if is_named { &vehicle.kind } else { before_at };
        // A vehicle without a class has no known type either.
        let is_unknown = name == "TYPE_VEHICLE" && !is_named && self.models.contains_key("TYPE_UNKNOWN");
        let name = if is_unknown { "TYPE_UNKNOWN" } else { name };
        if !self.models.contains_key(name) {
            match self.source {
                Source::Fcd(_) => self.add_default(name, vehicle, models),
                Source::Osi(_) => return self.model_by_size(vehicle, size_m, models),
            }
        }
        if !self.used_types.contains(name) {
            self.used_types.insert(name.to_owned());
        }
        let Some(models) = self.models.get(name).filter(|models| !models.is_empty()) else {
            self.keep_unknown(vehicle);
            return None;
        };
        let draw = seed::number(0, &format!("scene/model of {}", vehicle.id), &[]);
        Some(models[(draw % models.len() as u64) as usize].clone())
    }

    /// Distance from a model's origin to the recorded point of a vehicle: SUMO's is the front bumper, OSI's
    /// the centre.
    fn reach_m(&self, model: &PlacedModel) -> f64 {
        if matches!(self.source, Source::Osi(_)) { 0.0 } else { model.reach_m }
    }

    /// The project's own vehicle that replaces an object of OSI; `None` if there is none.
    fn model_by_size(
        &mut self,
        vehicle: &FcdVehicle,
        size_m: Option<[f64; 3]>,
        models: &mut Models,
    ) -> Option<PlacedModel> {
        let name = match stand_in_of(&vehicle.kind) {
            Some(StandIn::NearestOf(classes, name)) => {
                size_m.and_then(|size_m| nearest_in_size(classes, size_m)).unwrap_or(name)
            }
            Some(StandIn::Ignored) => return None,
            None => {
                self.keep_unknown(vehicle);
                return None;
            }
        };
        if !self.by_size.contains_key(name) {
            let chosen = models.choose_written(&self.section, name)?;
            self.by_size.insert(name, PlacedModel::of(chosen, None, models));
        }
        self.by_size.get(name).cloned()
    }

    /// Loads a default model when the first vehicle needs it.
    fn add_default(&mut self, name: &str, vehicle: &FcdVehicle, models: &mut Models) {
        let Some((_, model)) = DEFAULT_MODELS.iter().find(|(known, _)| *known == name) else { return };
        // `Car` was probably meant as the recording's `car`, which is an error instead of the default.
        if self.models.keys().any(|own| own.eq_ignore_ascii_case(name)) {
            return;
        }
        let chosen = models.choose_written(&self.section, model);
        let of_type = chosen.into_iter().map(|chosen| PlacedModel::of(chosen, None, models)).collect();
        self.models.insert(name.to_owned(), of_type);
        self.by_default.push(UnknownType { kind: name.to_owned(), ..unknown(vehicle) });
    }

    fn keep_unknown(&mut self, vehicle: &FcdVehicle) {
        let is_kept = self.unknown.iter().any(|unknown| unknown.kind == vehicle.kind);
        if self.unknown.len() < MOST_UNKNOWN_TYPES && !is_kept {
            self.unknown.push(unknown(vehicle));
        }
    }

    fn unknown_types(&mut self) -> FcdRule {
        let own = self.models.keys().map(String::as_str);
        let known: BTreeSet<&str> = match self.source {
            Source::Fcd(_) => own.chain(DEFAULT_MODELS.map(|(name, _)| name)).collect(),
            Source::Osi(_) => own.chain(types_with_stand_in()).collect(),
        };
        let known = known.into_iter().map(str::to_owned).collect();
        FcdRule::UnknownTypes { found: std::mem::take(&mut self.unknown), known }
    }
}

fn unknown(vehicle: &FcdVehicle) -> UnknownType {
    UnknownType { kind: vehicle.kind.clone(), id: vehicle.id.clone(), line: vehicle.line }
}

/// A type with its default model, and a name in `models` without vehicles that was probably meant for it:
/// four or more letters, with one wrong, missing or additional letter, or two exchanged.
fn misspelt<'n>(
    by_default: &'n [UnknownType],
    names: impl Iterator<Item = &'n String>,
    used_types: &HashSet<String>,
) -> Option<(&'n UnknownType, &'n str)> {
    let idle: BTreeSet<&String> =
        names.filter(|name| name.len() >= 4 && !used_types.contains(*name)).collect();
    let letters = |text: &str| text.chars().filter(|c| !c.is_ascii_digit()).collect::<String>();
    let is_meant =
        |kind: &str, name: &str| strsim::osa_distance(name, kind) == 1 && letters(name) != letters(kind);
    by_default.iter().find_map(|found| {
        let name = idle.iter().find(|name| is_meant(&found.kind, name))?;
        Some((found, name.as_str()))
    })
}

/// Vehicles that came into view.
struct VisibleVehicles<'a> {
    /// Index and model by id: a vehicle whose type changes later keeps its model.
    known: HashMap<String, (u32, PlacedModel)>,
    ids_of_targets: HashSet<&'a str>,
    /// Number of stored poses.
    poses: usize,
    traffic: Traffic,
}

impl<'a> VisibleVehicles<'a> {
    fn new(targets: &'a [Target]) -> Self {
        let ids_of_targets = targets.iter().map(|target| target.id.as_str()).collect();
        Self { known: HashMap::new(), ids_of_targets, poses: 0, traffic: Traffic::default() }
    }

    /// Index of a vehicle, new or known.
    fn place_of(&mut self, vehicle: &FcdVehicle, model: &PlacedModel) -> Result<u32, FcdRule> {
        if let Some(known) = self.known.get(&vehicle.id) {
            return Ok(known.0);
        }
        // Ids are written side by side in tables of results.
        if vehicle.id.chars().any(|c| c.is_control() || ",\"'".contains(c)) {
            return Err(FcdRule::BadId(vehicle.id.clone()));
        }
        if self.ids_of_targets.contains(vehicle.id.as_str()) {
            return Err(FcdRule::IdOfTarget(vehicle.id.clone()));
        }
        let index = self.traffic.vehicles.len() as u32;
        self.traffic.vehicles.push(Vehicle { id: vehicle.id.clone(), kind: model.kind.clone() });
        self.known.insert(vehicle.id.clone(), (index, model.clone()));
        Ok(index)
    }

    /// Model of a vehicle that came into view.
    fn model_of(&self, vehicle: &FcdVehicle) -> Option<&PlacedModel> {
        self.known.get(&vehicle.id).map(|(_, model)| model)
    }
}
