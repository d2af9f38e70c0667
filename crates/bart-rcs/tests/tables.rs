//! Tables over aspect: made in one run or in several, and what they are not good for.
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

mod bodies;

use artifact::Accuracy;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::Edges;
use bart_rcs::{
    BartError, CancellationCheck, CheckpointKey, CheckpointStore, MemoryLimit, NoCheckpoint, NoProgress,
    RcsContext, RcsRequest, RcsResult, RcsSeconds, rcs, rcs_within,
};
use bodies::{car, cuboid};
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Mutex;

/// `count` azimuths over the circle, far away, three bounces.
fn request(count: usize, accuracy_db: f64) -> RcsRequest {
    RcsRequest {
        accuracy: Accuracy::from_db(accuracy_db),
        ..RcsRequest::over(
            vec![76.5e9, 77e9, 77.5e9],
            vec![0.1],
            (0..count).map(|i| TAU * i as f64 / count as f64).collect(),
        )
    }
}

/// Aspects that a checkpoint loads, and those that it stores.
#[derive(Default)]
struct Memory {
    found: BTreeMap<CheckpointKey, Vec<u8>>,
    made: Mutex<BTreeMap<CheckpointKey, Vec<u8>>>,
}

impl CheckpointStore for Memory {
    fn load(&self, key: CheckpointKey) -> Option<&[u8]> {
        self.found.get(&key).map(Vec::as_slice)
    }

    fn store(&self, key: CheckpointKey, bytes: &[u8]) {
        self.made.lock().unwrap().insert(key, bytes.to_vec());
    }
}

fn kept_by<'a>(checkpoint: &'a dyn CheckpointStore, cancellation: CancellationCheck<'a>) -> RcsContext<'a> {
    let memory_limit = MemoryLimit::NONE;
    RcsContext { memory_limit, checkpoint, progress: &NoProgress, clock_s: &|| 0.0, cancellation }
}

fn made_with(mesh: &Mesh, request: &RcsRequest, checkpoint: &dyn CheckpointStore) -> RcsResult {
    let context = kept_by(checkpoint, CancellationCheck::NEVER);
    RcsResult { seconds: RcsSeconds::default(), ..rcs_within(mesh, request, &context).unwrap() }
}

/// Runs once, then again from some of its pieces.
fn resumed(mesh: &Mesh, request: &RcsRequest) -> BTreeMap<CheckpointKey, Vec<u8>> {
    let first = Memory::default();
    let whole = made_with(mesh, request, &first);
    assert_eq!(whole, made_with(mesh, request, &NoCheckpoint), "keeping changes something");
    let all = first.made.into_inner().unwrap();
    let parts: [fn(usize) -> bool; 4] = [|i| i < 1, |i| i % 3 == 1, |i| i != 5, |_| true];
    for (number, part) in parts.into_iter().enumerate() {
        let found: BTreeMap<_, _> =
            all.clone().into_iter().enumerate().filter(|(i, _)| part(*i)).map(|(_, entry)| entry).collect();
        let (there, of) = (found.len(), all.len());
        let checkpoint = Memory { found, made: Mutex::default() };
        assert_eq!(made_with(mesh, request, &checkpoint), whole, "part {number}");
        let made = checkpoint.made.into_inner().unwrap().len();
        println!("{there} of {of} pieces were there, {made} made");
        assert_eq!(made, of - there);
    }
    all
}

#[test]
fn a_table_that_goes_on_from_some_of_its_aspects_is_the_same_to_the_bit() {
    let far = request(48, -20.0);
    assert_eq!(resumed(&car(12).mesh(), &far).len(), 48);
    // Near by, the errors of the integrals are part of what is kept: of all aspects, or of those that are
    // drawn of more than eight, in pieces of their own.
    let near = |aspects| RcsRequest { range_m: 5.0, bounces: 2, ..request(aspects, -20.0) };
    assert_eq!(resumed(&car(6).mesh(), &near(6)).len(), 6);
    let pieces = resumed(&car(6).mesh(), &near(12)).len();
    assert!((15..=18).contains(&pieces), "{pieces}");
}

#[test]
fn a_table_that_is_called_off_ends_with_the_aspect_under_way() {
    let (mesh, checkpoint) = (car(6).mesh(), Memory::default());
    let is_cancelled = || checkpoint.made.lock().unwrap().len() >= 2;
    let ended = |request: &RcsRequest| {
        rcs_within(&mesh, request, &kept_by(&checkpoint, CancellationCheck::by(&is_cancelled))).err()
    };
    // Of one thread one aspect is under way at a time.
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one_thread.install(|| ended(&request(48, -20.0))), Some(BartError::Cancelled));
    assert_eq!(checkpoint.made.lock().unwrap().len(), 2);
}

/// Power of edges left out over that of S, both over all aspects: of a table in parts that are small enough
/// to be measured everywhere.
fn edges_left_out_everywhere(mesh: &Mesh, request: &RcsRequest) -> f64 {
    let powers = request.azimuth_rad.chunks(48).map(|azimuth_rad| {
        let part = RcsRequest { azimuth_rad: azimuth_rad.to_vec(), ..request.clone() };
        let found = rcs(mesh, &part, &|_, _| ()).unwrap();
        let power = found.amplitude_m.iter().map(|s| s.norm_sqr()).sum::<f64>();
        [found.model_error.edges.unwrap().powi(2) * power, power]
    });
    let [edges, all] = powers.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
    (edges / all).sqrt()
}

#[test]
fn the_error_told_of_edges_left_out_is_that_of_all_aspects_though_a_box_flashes_at_every_right_angle() {
    // A step of 2.5°: 0, 90, 180, 270 and 360° are among every third of 145 aspects.
    let azimuth_rad = (0..145).map(|i| TAU * f64::from(i) / 144.0).collect();
    let request = RcsRequest {
        bounces: 1,
        accuracy: Accuracy::from_db(-20.0),
        ..RcsRequest::over(vec![10e9], vec![0.0], azimuth_rad)
    };
    let body = cuboid(DVec3::new(-0.3, -0.2, 0.0), DVec3::new(0.3, 0.2, 0.3)).mesh();
    let told = rcs(&body, &request, &|_, _| ()).unwrap().model_error.edges.unwrap();
    let all = edges_left_out_everywhere(&body, &request);
    let over_db = 20.0 * (told / all).log10();
    println!("told {told:.2e}, of all aspects {all:.2e}: {over_db:+.1} dB");
    // Of 49 independent powers the mean is right to 1/√49, 0.6 dB; thrice that.
    assert!(over_db.abs() < 1.8);
}

#[test]
fn damaged_bytes_of_a_keeper_are_made_anew() {
    let (mesh, request) = (car(6).mesh(), request(3, -20.0));
    let first = Memory::default();
    let whole = made_with(&mesh, &request, &first);
    let cut = |bytes: Vec<u8>| bytes[..bytes.len() - 8].to_vec();
    let found = first.made.into_inner().unwrap().into_iter().map(|(key, bytes)| (key, cut(bytes))).collect();
    let checkpoint = Memory { found, made: Mutex::default() };
    assert_eq!(made_with(&mesh, &request, &checkpoint), whole);
    assert_eq!(checkpoint.made.into_inner().unwrap().len(), 3);
}

#[test]
fn aspects_of_another_shape_are_made_anew() {
    let mesh = car(6).mesh();
    // Near by, errors of the integrals and of the model are measured at all of six aspects.
    let asked = RcsRequest { range_m: 5.0, bounces: 2, ..request(6, -20.0) };
    let whole = made_with(&mesh, &asked, &NoCheckpoint);
    let others = [
        RcsRequest { bounces: 1, ..asked.clone() },
        RcsRequest { bounces: 3, ..asked.clone() },
        RcsRequest { frequency_hz: vec![77e9], ..asked.clone() },
        RcsRequest { frequency_hz: vec![77e9; 4], ..asked.clone() },
        RcsRequest { range_m: f64::INFINITY, ..asked.clone() },
    ];
    for other in others {
        let first = Memory::default();
        made_with(&mesh, &other, &first);
        let checkpoint = Memory { found: first.made.into_inner().unwrap(), made: Mutex::default() };
        let found = made_with(&mesh, &asked, &checkpoint);
        let made = checkpoint.made.into_inner().unwrap().len();
        println!("{} bounces, {} frequencies: {made} made", other.bounces, other.frequency_hz.len());
        match other.range_m.is_finite() {
            true => assert_eq!((found, made), (whole.clone(), 6)),
            // Far away nothing of the integrals is measured.
            false => assert_eq!((found, made), (whole.clone(), 6)),
        }
    }
}

/// The plate of docs/physics.md §0, 1.5 m seen square: 66.23 dBsm far away, 31.59 at 25 m, 37.35 at 40 m.
#[test]
fn a_far_field_table_says_what_it_errs_by_near_by() {
    let plate = Mesh {
        vertices_m: vec![[0.0, -0.75, -0.75], [0.0, 0.75, -0.75], [0.0, 0.75, 0.75], [0.0, -0.75, 0.75]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    };
    // 41 aspects within a hundredth of the lobe's width λ/2D.
    let square = RcsRequest {
        frequency_hz: vec![77e9],
        elevation_rad: vec![0.0],
        azimuth_rad: (0..41).map(|i| 1e-5 * f64::from(i - 20) / 20.0).collect(),
        bounces: 1,
        ..request(1, -40.0)
    };
    let of = |request: &RcsRequest| rcs(&plate, request, &|_, _| ()).unwrap().far_field;
    let found = of(&square).unwrap();
    for (range_m, level_db) in [(25.0, 66.23 - 31.59), (40.0, 66.23 - 37.35)] {
        let at = found.range_m.iter().position(|r| *r == range_m).unwrap();
        let (level, complex) = (found.level_db[at].median, 20.0 * found.complex[at].median.log10());
        println!("{range_m} m: asked {level_db:.2} dB, got {level:.2}; complex {complex:.2} dB");
        // Closed forms to two digits, and the spherical wave integrated to 1 %: 0.09 dB.
        assert!((level - level_db).abs() < 0.1);
        // |far − near| is |far| to the share of near, −29 dB: 0.3 dB.
        assert!((complex - level_db).abs() < 0.1 + 0.32);
    }
    assert_eq!((found.aspects, found.frequencies), (1, 1));
    assert_eq!(of(&RcsRequest { range_m: 30.0, ..square.clone() }), None, "it is right at its range");
    assert_eq!(of(&RcsRequest { azimuth_rad: vec![0.0; 39], ..square }), None, "too small to bear the cost");
}

/// A floor of 900 plates of 2 mm before a wall of 0.5 m.
fn small_mirrors_before_a_wall() -> Mesh {
    let mut mesh = Mesh::default();
    let mut face = |corners: [[f64; 3]; 4]| {
        let first = mesh.vertices_m.len() as u32;
        mesh.vertices_m.extend_from_slice(&corners);
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    };
    for i in 0..900 {
        let (x, y) = (4e-3 * f64::from(i % 30), 4e-3 * f64::from(i / 30));
        face([[x, y, 0.0], [x + 2e-3, y, 0.0], [x + 2e-3, y + 2e-3, 0.0], [x, y + 2e-3, 0.0]]);
    }
    face([[-0.02, -0.2, 0.0], [-0.02, 0.3, 0.0], [-0.02, 0.3, 0.3], [-0.02, -0.2, 0.3]]);
    mesh
}

/// The plates are all below the least mirror area for −10 dB, λ²·accuracy, and nearly all of S goes over
/// them. One reflection of a conductor back to where the wave came from keeps its polarization: nothing is
/// left that an error could be relative to. Edges and second reflections change it.
#[test]
fn what_vanishes_by_symmetry_is_said_to_and_has_no_error() {
    let mesh = car(6).mesh();
    let asked = RcsRequest { polarization: Polarization::Vh, bounces: 1, ..request(3, -20.0) };
    for range_m in [f64::INFINITY, 30.0] {
        let found = rcs(&mesh, &RcsRequest { range_m, ..asked.clone() }, &|_, _| {}).unwrap();
        assert!(found.vanishes && found.error.total().is_none(), "{range_m}: {:?}", found.error);
        assert_eq!(found.mirrors.traced_again, 0);
    }
    let edges = RcsRequest { edges: Edges::FirstOrder, ..asked.clone() };
    for other in [edges, RcsRequest { bounces: 2, ..asked.clone() }] {
        let found = rcs(&mesh, &other, &|_, _| {}).unwrap();
        assert!(!found.vanishes && found.error.total().is_some());
    }
    let co_polarized = RcsRequest { polarization: Polarization::Hh, ..asked };
    assert!(!rcs(&mesh, &co_polarized, &|_, _| {}).unwrap().vanishes);
}

#[test]
fn what_drops_more_than_was_asked_is_traced_again_with_smaller_mirrors() {
    let mesh = small_mirrors_before_a_wall();
    // The first looks at the inner side, the others along the floor's and the wall's backs.
    let azimuths = vec![0.45, 2.5, 3.5];
    let at = |db: f64| {
        made_with(
            &mesh,
            &RcsRequest { azimuth_rad: azimuths.clone(), elevation_rad: vec![0.6], ..request(1, db) },
            &NoCheckpoint,
        )
    };
    let (got, exact) = (at(-10.0), at(-60.0));
    let norm = |s: &mut dyn Iterator<Item = f64>| s.sum::<f64>().sqrt();
    let missed = norm(&mut got.amplitude_m.iter().zip(&exact.amplitude_m).map(|(a, b)| (a - b).norm_sqr()));
    let truth = missed / norm(&mut exact.amplitude_m.iter().map(|s| s.norm_sqr()));
    let dropped = got.error.dropped.unwrap();
    println!("asked 0.316, dropped {dropped:.3}, true {truth:.3}, {:?}", got.mirrors);
    assert!(dropped <= Accuracy::from_db(-10.0).amplitude() && truth <= dropped);
    assert!(got.mirrors.traced_again == 1 && got.mirrors.least_area_m2 < 1e-6);
    let resumed = resumed(
        &mesh,
        &RcsRequest { azimuth_rad: azimuths.clone(), elevation_rad: vec![0.6], ..request(1, -10.0) },
    );
    assert_eq!(
        resumed.keys().map(|key| (key.pass, key.aspect)).collect::<Vec<_>>(),
        [(0, 0), (0, 1), (0, 2), (1, 0)]
    );
}
