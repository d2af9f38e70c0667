//! Cache keys: all inputs of a stage's frame, part by part, so that a plan can say which part changed.

use crate::chain::stages::Stage;
use artifact::cube::{CubeHeader, SampleUnit};
use artifact::envelope::fingerprint;
use artifact::radar::Hardware;
use artifact::scene::{SceneFrame, SceneHeader, TargetKind};
use artifact::settings::{Detail, EchoMode, Fidelity, Noise, SmallParts};

/// All inputs of one frame of one stage.
#[derive(Debug, Clone, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct Key {
    /// Name and fingerprint of each part.
    pub(crate) parts: Vec<(String, String)>,
}

impl Key {
    pub(crate) fn of(stage: Stage, parts: Vec<(&str, String)>) -> Self {
        let sources = std::iter::once(("sources", stage.sources().to_owned()));
        Self { parts: sources.chain(parts).map(|(name, hash)| (name.to_owned(), hash)).collect() }
    }

    /// Name of the cached frame.
    pub fn id(&self) -> String {
        fingerprint(&self.parts)
    }

    /// Names of the parts that differ from `other`.
    pub(crate) fn changed_since(&self, other: &Self) -> Vec<&str> {
        self.parts.iter().filter(|part| !other.parts.contains(part)).map(|(name, _)| name.as_str()).collect()
    }
}

/// Key of the scene stage; `files` are the scene file and the models it reads, as name and content hash.
pub(crate) fn scene(files: &[(String, String)], overrides: &impl serde::Serialize) -> Key {
    Key::of(Stage::Scene, vec![("files", fingerprint(&files)), ("options", fingerprint(overrides))])
}

/// Fingerprints of the inputs that all frames of a scene share, computed once because meshes are large.
pub(crate) struct SceneParts {
    bodies: String,
    meshes: Vec<String>,
    radar: String,
    fidelity: String,
}

impl SceneParts {
    pub(crate) fn of(header: &SceneHeader) -> Self {
        Self {
            bodies: fingerprint(&(&header.targets, &header.materials, &header.road)),
            meshes: header.meshes.iter().map(fingerprint).collect(),
            radar: fingerprint(&header.radar),
            fidelity: fingerprint(&(of_paths(header.fidelity), seed_of_points(header))),
        }
    }
}

/// Settings that paths depend on: an accuracy is the same whichever result it is requested for.
fn of_paths(fidelity: Fidelity) -> Fidelity {
    Fidelity { goal: None, ..fidelity }
}

impl SceneParts {
    /// Parts of a scene whose errors were measured in another one; `other` is the hash of that measurement's
    /// inputs.
    pub(crate) fn measured_in(self, other: &str) -> Self {
        Self { fidelity: fingerprint(&(self.fidelity, other)), ..self }
    }
}

/// Seed, where points are drawn with it; nothing else in a frame's paths is random.
fn seed_of_points(header: &SceneHeader) -> Option<u64> {
    let Fidelity { detail, small_parts, .. } = header.fidelity;
    (detail == Detail::Statistical || small_parts == SmallParts::Statistical).then_some(header.seed)
}

/// Keys of one frame along the chain.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameKeys {
    /// Key of the scattering.
    pub bart_rcs: Key,
    pub(crate) fmcw_echo: Key,
    pub(crate) dsp: Key,
    /// Key of the classes; `None` without a model.
    pub(crate) classifier: Option<Key>,
}

impl FrameKeys {
    pub(crate) fn of(
        header: &SceneHeader,
        parts: &SceneParts,
        frame: &SceneFrame,
        model: Option<&str>,
    ) -> Self {
        let bart_rcs = measured_or_like(header, parts, frame);
        let fmcw_echo = fmcw_echo(header, parts, &bart_rcs, frame);
        let dsp =
            Key::of(Stage::Dsp, vec![("echo", fmcw_echo.id()), ("dsp settings", fingerprint(&header.dsp))]);
        let of_model =
            |model: &str| Key::of(Stage::Classifier, vec![("maps", dsp.id()), ("model", model.to_owned())]);
        let classifier = model.map(of_model);
        Self { bart_rcs, fmcw_echo, dsp, classifier }
    }

    pub(crate) fn get(&self, stage: Stage) -> Option<&Key> {
        match stage {
            Stage::Scene => None,
            Stage::BartRcs => Some(&self.bart_rcs),
            Stage::FmcwEcho => Some(&self.fmcw_echo),
            Stage::Dsp => Some(&self.dsp),
            Stage::Classifier => self.classifier.as_ref(),
        }
    }
}

/// Key of a frame's scattering; that of a frame that takes over measured errors includes the measured frame,
/// or equals its key where nothing moved in between.
fn measured_or_like(header: &SceneHeader, parts: &SceneParts, frame: &SceneFrame) -> Key {
    let own = bart_rcs(header, parts, frame);
    let measured_in = header.measured_in(frame.index);
    if measured_in == frame.index || header.fidelity.echo == EchoMode::RcsTable {
        return own;
    }
    let measured = bart_rcs(header, parts, &scene::snapshot(header, measured_in));
    if measured == own {
        return own;
    }
    let also = ("measured frame".to_owned(), measured.id());
    Key { parts: own.parts.into_iter().chain([also]).collect() }
}

/// Key of a frame's scattering, without the frame's number and time: bodies at rest scatter the same in every
/// frame. It includes only those recorded vehicles that are in view: a longer recording leaves the keys of
/// its earlier frames unchanged.
fn bart_rcs(header: &SceneHeader, parts: &SceneParts, frame: &SceneFrame) -> Key {
    let poses = fingerprint(&frame.poses);
    let vehicles = scene::vehicles_in_view(header, frame.index);
    let kinds =
        header.targets.iter().map(|target| &target.kind).chain(vehicles.iter().map(|vehicle| &vehicle.kind));
    let meshes: Vec<_> = kinds.map(|kind| mesh_of(parts, kind)).collect();
    let (vehicles, meshes) = (fingerprint(&vehicles), fingerprint(&meshes));
    let all = [
        ("bodies", &parts.bodies),
        ("vehicles", &vehicles),
        ("meshes", &meshes),
        ("radar", &parts.radar),
        ("fidelity", &parts.fidelity),
        ("poses", &poses),
    ];
    Key::of(Stage::BartRcs, all.map(|(name, hash)| (name, hash.clone())).to_vec())
}

fn mesh_of<'a>(parts: &'a SceneParts, kind: &TargetKind) -> Option<&'a str> {
    parts.meshes.get(kind.mesh()? as usize).map(String::as_str)
}

fn fmcw_echo(header: &SceneHeader, parts: &SceneParts, scattering: &Key, frame: &SceneFrame) -> Key {
    // Windows matter only where the noise is specified as a ratio in the windowed map.
    let windows = match header.noise {
        Noise::SnrDb(_) => fingerprint(&(header.dsp.range_window, header.dsp.doppler_window)),
        Noise::Absent | Noise::Figure { .. } => String::new(),
    };
    let noise = fingerprint(&(header.noise, header.seed, windows));
    let number = fingerprint(&(frame.index, frame.time_s));
    Key::of(
        Stage::FmcwEcho,
        vec![
            ("scattering", scattering.id()),
            ("radar", parts.radar.clone()),
            ("noise and seed", noise),
            ("backscatter", fingerprint(&header.backscatter)),
            ("frame and time", number),
        ],
    )
}

/// Header of a cube with the scene properties that a detector may know: without the errors of its radar.
pub fn cube_header(header: &SceneHeader) -> CubeHeader {
    let mut known = echo_header(header);
    known.radar.hardware = Hardware::default();
    known
}

/// Header of a cube with all that its echo depends on, the errors of the radar included.
pub(crate) fn echo_header(header: &SceneHeader) -> CubeHeader {
    CubeHeader {
        radar: header.radar.clone(),
        noise: header.noise,
        dsp: header.dsp.clone(),
        unit: SampleUnit::RootWatts,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::goal::Goal;
    use artifact::material::{
        Backing, Layer, Material, MaterialMap, MeshMaterials, Road, Thickness, Transmission,
    };
    use artifact::radar::{
        Adc, ElementError, ElementSpread, Interferer, Pattern, PatternTable, PhaseNoise, Schedule,
    };
    use artifact::scene::{Backscatter, Mesh, RoadWheel, Traffic, Vehicle, VehiclePose, Wheel};
    use artifact::settings::NetworkLane;
    use num_complex::Complex64;
    use serde_json::Value;

    /// A scene in which nothing that could be told is left out.
    fn full_scene() -> SceneHeader {
        let options = scene::ReadOptions::names_only();
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        let mut header = scene::read(&file, &options).unwrap();
        // Drawn parts would make the seed count.
        header.fidelity.small_parts = SmallParts::OfMesh;
        let glass = Layer { thickness_m: 4e-3, permittivity: Complex64::new(6.5, -0.15) };
        let pane =
            Material::Layers { layers: vec![glass], backing: Backing::Air, thickness: Thickness::Exact };
        let asphalt = Material::HalfSpace { permittivity: Complex64::new(5.0, -0.3) };
        let materials = vec![pane.clone(), asphalt.clone()];
        header.meshes = vec![Mesh {
            name: "car".into(),
            vertices_m: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 3],
            triangles: vec![[0, 1, 2]],
            material_of_triangle: vec![0],
            materials: vec!["glass".into(), "floor".into()],
            makeup: MeshMaterials { materials, transmission: Transmission::Ignored },
            wheels: vec![RoadWheel { hub_m: [0.5, 0.5, 0.3], radius_m: 0.3, triangles: vec![0] }],
            ..Mesh::default()
        }]
        .into();
        let by_name = vec![("glass".to_owned(), pane), ("floor".to_owned(), asphalt.clone())];
        header.materials = MaterialMap { by_name, transmission: Transmission::Ignored };
        header.road = Some(Road { material: asphalt, rms_height_m: 1e-3 });
        header.backscatter = Some(Backscatter { gamma: 0.01 });
        header.fidelity.goal = Some(Goal::Cube);
        header.noise = Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 };
        let (azimuth_rad, elevation_rad) = (vec![-1.0, 0.0, 1.0], vec![0.0]);
        let table = PatternTable { azimuth_rad, elevation_rad, amplitude: vec![0.1, 1.0, 0.1] };
        header.radar.array.pattern = Pattern::Table(table);
        header.radar.schedule =
            Schedule { sub_frame_intervals_s: vec![60e-6, 85e-6], stagger_s: vec![0.0, 1e-6] };
        let error = ElementError { gain_db: 1.0, phase_rad: 0.1, delay_s: 1e-12 };
        let adc = Some(Adc { bits: 12, full_scale: 1e-3 });
        let (place, hz) = ([0.0, 80.0, 1.0], 77e9);
        let other = Interferer {
            position_m: place,
            velocity_mps: [0.0; 3],
            eirp_w: 1.0,
            start_frequency_hz: hz,
            slope_hz_per_s: 1e12,
            sweep_s: 5e-5,
            chirp_interval_s: 6e-5,
            offset_s: 0.0,
        };
        let spread = ElementSpread { gain_db: 1.0, phase_rad: 0.1 };
        let (name, line_m) = ("n_in_0".into(), vec![[1.0, 2.0], [3.0, 4.0]]);
        header.dsp.road.courses = vec![NetworkLane { number: 4, name, width_m: 3.0, line_m }];
        header.dsp.calibration = vec![Complex64::new(1.0, 0.1)];
        let phase_noise = vec![PhaseNoise { offset_hz: 1e6, dbc_per_hz: -95.0 }];
        header.radar.hardware = Hardware {
            tx: vec![error; 3],
            rx: vec![error; 4],
            spread,
            adc,
            phase_noise,
            interferers: vec![other],
        };
        header.targets.truncate(2);
        header.targets[1].kind =
            TargetKind::Point { rcs_m2: 1.0, wheel: Some(Wheel { radius_m: 0.3, angle_rad: 0.0 }) };
        let wheel = Some(Wheel { radius_m: 0.4, angle_rad: 0.1 });
        let kind = TargetKind::Point { rcs_m2: 2.0, wheel };
        let vehicles = ["flow.0", "flow.1"].map(|id| Vehicle { id: id.into(), kind: kind.clone() }).to_vec();
        let placed = VehiclePose { vehicle: 0, pose: header.targets[0].start };
        header.traffic = Some(Traffic { vehicles, frames: vec![vec![placed]; 2] });
        header
    }

    /// JSON pointers of all values that hold no others.
    fn leaves(value: &Value, at: &str, found: &mut Vec<String>) {
        let mut inner = |key: &str, value: &Value| leaves(value, &format!("{at}/{key}"), found);
        match value {
            Value::Object(map) if !map.is_empty() => map.iter().for_each(|(key, value)| inner(key, value)),
            Value::Array(list) if !list.is_empty() => {
                list.iter().enumerate().for_each(|(i, value)| inner(&i.to_string(), value));
            }
            Value::Object(_) | Value::Array(_) | Value::Null => panic!("{at} is empty: tell something of it"),
            Value::Bool(_) | Value::Number(_) | Value::String(_) => found.push(at.to_owned()),
        }
    }

    /// A copy of `whole` with another value at a leaf; `None` where it can have one value only.
    fn changed<T: serde::Serialize + serde::de::DeserializeOwned + PartialEq>(
        whole: &T,
        leaf: &str,
    ) -> Option<T> {
        let json = serde_json::to_value(whole).unwrap();
        let with = |value: Value| {
            let mut other = json.clone();
            *other.pointer_mut(leaf).unwrap() = value;
            serde_json::from_value::<T>(other)
        };
        let candidates = match json.pointer(leaf).unwrap() {
            Value::Bool(told) => vec![Value::from(!told)],
            Value::Number(told) if told.is_f64() => vec![Value::from(1.25 * told.as_f64().unwrap() + 0.5)],
            Value::Number(told) => vec![Value::from(told.as_i64().unwrap() + 1)],
            // A name, or the name of a case: the error tells the other cases.
            Value::String(told) => match with(Value::from(format!("{told}x"))) {
                Ok(_) => vec![Value::from(format!("{told}x"))],
                Err(error) => error.to_string().split('`').skip(1).step_by(2).map(Value::from).collect(),
            },
            Value::Null | Value::Array(_) | Value::Object(_) => vec![],
        };
        candidates.into_iter().filter_map(|value| with(value).ok()).find(|other| other != whole)
    }

    /// The first stage whose frames depend on a value of the header; `None` where what it does to a frame is
    /// told by the frame itself, or it is for the report alone.
    fn first_stage(leaf: &str) -> Option<Stage> {
        match leaf.split('/').nth(1)? {
            "name" | "frames" | "frame_interval_s" | "intersection" => None,
            "fidelity" if leaf.ends_with("/goal") => None,
            // What is not in view of the frame, and poses: those are the frame's.
            "traffic" if ["/vehicles/1/", "/frames/1/", "/pose/"].iter().any(|part| leaf.contains(part)) => {
                None
            }
            "seed" | "noise" | "backscatter" => Some(Stage::FmcwEcho),
            "dsp" => Some(Stage::Dsp),
            _ => Some(Stage::BartRcs),
        }
    }

    fn keys(header: &SceneHeader, frame: &SceneFrame) -> FrameKeys {
        FrameKeys::of(header, &SceneParts::of(header), frame, Some("model"))
    }

    #[test]
    fn every_value_of_a_scene_changes_the_key_of_the_first_stage_that_knows_it() {
        let header = full_scene();
        let frame = scene::snapshot(&header, 0);
        let asked = keys(&header, &frame);
        let mut all = Vec::new();
        leaves(&serde_json::to_value(&header).unwrap(), "", &mut all);
        for leaf in &all {
            let other = changed(&header, leaf).unwrap();
            let got = keys(&other, &frame);
            let differs = |stage: &Stage| asked.get(*stage).map(Key::id) != got.get(*stage).map(Key::id);
            let first = Stage::ALL.into_iter().find(differs);
            assert_eq!(
                first,
                first_stage(leaf),
                "{leaf} changes the keys from this stage on, asked is the other"
            );
        }
        let must_be_there = ["/fidelity/edges", "/fidelity/surface", "/fidelity/nodes", "/road/rms_height_m"];
        assert!(must_be_there.iter().all(|leaf| all.iter().any(|found| found == leaf)));
        println!("{} values", all.len());
    }

    #[test]
    fn the_seed_changes_paths_where_they_are_drawn_with_it() {
        for (detail, small_parts) in
            [(Detail::Statistical, SmallParts::OfMesh), (Detail::Paths, SmallParts::Statistical)]
        {
            let mut header = full_scene();
            (header.fidelity.detail, header.fidelity.small_parts) = (detail, small_parts);
            let other = SceneHeader { seed: header.seed + 1, ..header.clone() };
            let frame = scene::snapshot(&header, 0);
            assert_ne!(keys(&header, &frame).bart_rcs.id(), keys(&other, &frame).bart_rcs.id());
        }
    }

    /// A frame's number and time change the key of its echo alone: bodies that stand still scatter the same
    /// in every frame.
    #[test]
    fn every_value_of_a_frame_changes_the_key_of_its_paths() {
        let header = full_scene();
        let frame = scene::snapshot(&header, 0);
        let mut all = Vec::new();
        leaves(&serde_json::to_value(&frame).unwrap(), "", &mut all);
        for leaf in &all {
            let other = changed(&frame, leaf).unwrap();
            let [asked, got] = [&frame, &other].map(|frame| keys(&header, frame));
            let is_of_paths = !matches!(leaf.as_str(), "/index" | "/time_s");
            assert_eq!(asked.bart_rcs.id() != got.bart_rcs.id(), is_of_paths, "{leaf}");
            assert_ne!(asked.fmcw_echo.id(), got.fmcw_echo.id(), "{leaf}");
        }
    }
}
