//! BART against the crate's two references as these converge: complex error and seconds by bounce order.
//!
//! The tests take the project's own vehicles at 10 GHz, where a wavelength of 3 cm keeps dense rays
//! affordable; geometry and formulas are those of 77 GHz. `cargo test --release -p wayside --test
//! bart_against_references -- --ignored` makes the table of `docs/validation/bart-against-references.md` at
//! 77 GHz and prints it (an hour of one core).
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

mod methods;
#[path = "../reference_gates/bodies.rs"]
#[expect(dead_code, reason = "only the polygons are wanted here")]
mod bodies;
mod continuity;
#[path = "../../../bart-rcs/examples/profile/processor_time.rs"]
mod processor_time;
mod random_cases;
mod road_cases;

use artifact::scene::Mesh;
use bart_rcs::Standpoint;
use methods::{Run, bart, decibels, error, po, sbr};

fn own(name: &str) -> Mesh {
    scene::vehicles::mesh(name, 1).unwrap()
}

fn standpoint(az_deg: f64, el_deg: f64, range_m: f64) -> Standpoint {
    Standpoint { azimuth_rad: az_deg.to_radians(), elevation_rad: el_deg.to_radians(), range_m }
}

const LOW_HZ: [f64; 2] = [10.0e9, 10.15e9];

#[test]
fn first_order_of_bart_is_what_dense_sampling_converges_to() {
    let (mesh, place) = (own("motorcycle-street"), standpoint(35.0, 12.0, 30.0));
    let exact = bart(&mesh, place, &LOW_HZ, 1, -60.0);
    let errors = [(1.0, 0), (2.0, 4), (2.0, 8)].map(|(density, levels)| {
        decibels(error(&po(&mesh, place, &LOW_HZ, density, levels).orders[0], &exact.orders[0]))
    });
    // The border of shadows is wrong by (cell edge)^1.5; edges at the border are 1, 1/8 and 1/32 of a
    // wavelength: 27 and 45 dB smaller. A third of that is asked, for the coarse errors are not yet in that
    // regime.
    println!("{errors:?}");
    assert!(errors[1] < errors[0] - 9.0 && errors[2] < errors[0] - 15.0, "{errors:?}");
}

/// Boxes on a plate, two of them an inner corner that looks at azimuth 25°: walls in front of walls, corners
/// of two and of three planes, gaps.
fn boxes_on_a_plate() -> Mesh {
    let plate = vec![[-0.8, -0.7, 0.0], [0.8, -0.7, 0.0], [0.8, 0.7, 0.0], [-0.8, 0.7, 0.0]];
    let boxes = [
        walls([0.4, 0.35], [0.30, 0.15, 0.25], 11.0),
        walls([-0.235, 0.046], [0.08, 0.60, 0.50], -20.0),
        walls([-0.032, -0.391], [0.60, 0.08, 0.50], -20.0),
    ];
    bodies::mesh_of(&[vec![plate], boxes.concat()].concat())
}

/// Sides and roof of a box on the plane z = 0.
fn walls(at: [f64; 2], [length, width, height]: [f64; 3], yaw_deg: f64) -> Vec<Vec<[f64; 3]>> {
    let (sin, cos) = f64::to_radians(yaw_deg).sin_cos();
    let corner = |i: usize, z: f64| {
        let (x, y) = [(0.5, -0.5), (0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5)][i % 4];
        let (x, y) = (x * length, y * width);
        [at[0] + cos * x - sin * y, at[1] + sin * x + cos * y, z]
    };
    let side = |i| vec![corner(i, 0.0), corner(i + 1, 0.0), corner(i + 1, height), corner(i, height)];
    (0..4).map(side).chain([(0..4).map(|i| corner(i, height)).collect()]).collect()
}

#[test]
fn every_order_of_bart_is_what_shooting_and_bouncing_rays_converge_to() {
    let (mesh, place) = (boxes_on_a_plate(), standpoint(25.0, 20.0, 30.0));
    let exact = bart(&mesh, place, &LOW_HZ, 3, -60.0);
    let runs = [2.0, 16.0].map(|density| sbr(&mesh, place, &LOW_HZ, density, 3));
    for order in 0..3 {
        let [coarse, fine] =
            [&runs[0], &runs[1]].map(|run| decibels(error(&run.orders[order], &exact.orders[order])));
        println!("order {}: {coarse:.1} dB, then {fine:.1} dB", order + 1);
        // (spacing)^1.5 makes 27 dB; half of it is asked of one random draw of borders.
        assert!(fine < coarse - 13.5, "order {}: {coarse:.1} dB, then {fine:.1} dB", order + 1);
    }
}

#[test]
fn the_printed_error_of_random_cases_covers_the_true_one() {
    let meshes = [("boxes on a plate", boxes_on_a_plate())];
    let found: Vec<_> = (0..20).map(|case| random_cases::try_case(case, &meshes, [9.0e9, 11.0e9])).collect();
    let outside: Vec<_> = found.iter().filter(|case| case.true_db > case.printed_db).collect();
    found.iter().for_each(|case| println!("{case}"));
    // 95 of 100 are asked.
    assert!(outside.len() <= 1, "{outside:?}");
}

/// The densities of the page's table.
fn page_runs(mesh: &Mesh, place: Standpoint, frequencies_hz: &[f64]) -> Vec<Run> {
    let mut runs: Vec<Run> = [-20.0, -40.0].map(|db| bart(mesh, place, frequencies_hz, 3, db)).into();
    runs.extend(
        [(1.0, 0), (1.0, 4)].map(|(density, levels)| po(mesh, place, frequencies_hz, density, levels)),
    );
    runs.extend([0.5, 1.0, 2.0, 4.0].map(|density| sbr(mesh, place, frequencies_hz, density, 3)));
    runs
}

#[test]
#[ignore = "prints the table of docs/validation/bart-against-references.md: an hour"]
fn the_table_is_made() {
    let (mesh, place) = (own("car-suv"), standpoint(25.0, 10.0, 30.0));
    let frequencies_hz = [77.3125e9, 77.9375e9];
    let exact = bart(&mesh, place, &frequencies_hz, 3, -60.0);
    println!("| method | seconds | order 1 | order 2 | order 3 |\n|---|---|---|---|---|");
    for run in page_runs(&mesh, place, &frequencies_hz) {
        let errors: Vec<String> = run
            .orders
            .iter()
            .zip(&exact.orders)
            .map(|(got, exact)| format!("{:.1} dB", decibels(error(got, exact))))
            .collect();
        println!("| {} | {:.1} | {} |", run.name, run.seconds, errors.join(" | "));
    }
}

/// Both references as they grow denser, against BART and rays against rays; `WAYSIDE_CARS=NAME,NAME`, and
/// `WAYSIDE_AZIMUTHS=DEG,DEG` for some of the four.
#[test]
#[ignore = "prints the table of real cars of docs/validation/bart-against-references.md: an hour"]
fn real_cars_are_compared_at_four_aspects() {
    let names = std::env::var("WAYSIDE_CARS").unwrap_or("gazebo_prius,modern_hatchback".into());
    let azimuths = std::env::var("WAYSIDE_AZIMUTHS").unwrap_or("0,30,90,180".into());
    let azimuths_deg: Vec<f64> = azimuths.split(',').map(|deg| deg.parse().unwrap()).collect();
    let meshes = vehicles();
    let frequencies_hz = [76.5e9, 76.83e9, 77.17e9, 77.5e9];
    println!("| car | azimuth | method | processor seconds | order 1 | order 2 | order 3 | orders 2 and 3 |");
    println!("|---|---|---|---|---|---|---|---|");
    for (name, mesh) in meshes.iter().filter(|(name, _)| names.split(',').any(|asked| asked == name)) {
        for &az_deg in &azimuths_deg {
            let place = standpoint(az_deg, 8.0, 30.0);
            let exact = bart(mesh, place, &frequencies_hz, 3, -60.0);
            let of_field = |order: &[num_complex::Complex64]| decibels(size(order) / size(&exact.orders[0]));
            let levels: Vec<String> = exact.orders.iter().map(|o| format!("{:.1} dB", of_field(o))).collect();
            println!("| {name} | {az_deg}° | level over order 1 | | {} | |", levels.join(" | "));
            let row = |run: &Run, reference: &Run, method: &str| {
                println!(
                    "| {name} | {az_deg}° | {method} | {:.1} | {} |",
                    run.seconds,
                    columns(run, reference)
                );
            };
            row(&bart(mesh, place, &frequencies_hz, 3, -20.0), &exact, "BART, −20 dB asked");
            for (density, levels) in [(1.0, 0), (1.0, 6), (2.0, 6)] {
                let run = po(mesh, place, &frequencies_hz, density, levels);
                row(&run, &exact, &run.name);
            }
            let mut before: Option<Run> = None;
            for density in [2.0, 4.0, 8.0, 16.0] {
                let run = sbr(mesh, place, &frequencies_hz, density, 3);
                row(&run, &exact, &run.name);
                if let Some(coarser) = before.replace(run) {
                    before
                        .iter()
                        .for_each(|finer| row(&coarser, finer, "the line before the last against the last"));
                }
            }
        }
    }
}

fn size(s: &[num_complex::Complex64]) -> f64 {
    s.iter().map(|s| s.norm_sqr()).sum::<f64>().sqrt()
}

/// Errors of orders 1, 2, 3 for themselves, and of orders 2 and 3 together.
fn columns(run: &Run, reference: &Run) -> String {
    let of = |order: usize| {
        run.orders
            .get(order)
            .map_or("–".into(), |s| format!("{:.1} dB", decibels(error(s, &reference.orders[order]))))
    };
    let both = |run: &Run| run.orders[1].iter().zip(&run.orders[2]).map(|(a, b)| a + b).collect::<Vec<_>>();
    let together = if run.orders.len() < 3 {
        "–".into()
    } else {
        format!("{:.1} dB", decibels(error(&both(run), &both(reference))))
    };
    [of(0), of(1), of(2), together].join(" | ")
}

fn own_vehicles() -> Vec<(String, Mesh)> {
    scene::vehicles::NAMES.map(|name| (name.to_owned(), own(name))).into()
}

/// The header that random frames fill with one vehicle.
fn experiment_1() -> artifact::scene::SceneHeader {
    let place = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/experiment-1.toml");
    let options = scene::ReadOptions { model: None, radar: None, meshes: scene::Meshes::NamesOnly };
    scene::read(std::path::Path::new(place), &options).unwrap()
}

/// Own vehicles, and the real ones where they are there.
fn vehicles() -> Vec<(String, Mesh)> {
    let mut meshes = own_vehicles();
    let folder =
        std::env::var("WAYSIDE_SHARED").unwrap_or(format!("{}/../../../shared", env!("CARGO_MANIFEST_DIR")));
    let Ok(files) = std::fs::read_dir(format!("{folder}/vehicles")) else {
        println!("skipped: {folder}/vehicles is not here; own vehicles only");
        return meshes;
    };
    let mut files: Vec<_> =
        files.map(|f| f.unwrap().path()).filter(|p| p.extension() == Some("glb".as_ref())).collect();
    files.sort();
    let options = scene::MeshOptions { unit_scale: None };
    let named = |p: &std::path::PathBuf| p.file_stem().unwrap().to_string_lossy().into_owned();
    meshes.extend(files.iter().map(|p| (named(p), scene::read_mesh(p, &options).unwrap())));
    meshes
}

fn named(meshes: &[(String, Mesh)]) -> Vec<(&str, Mesh)> {
    meshes.iter().map(|(name, mesh)| (name.as_str(), mesh.clone())).collect()
}

/// Cases that a run tries: `WAYSIDE_CASES=FROM:TO`, all hundred where it is not set.
fn cases() -> std::ops::Range<u64> {
    let given = std::env::var("WAYSIDE_CASES").unwrap_or("0:100".into());
    let (from, to) = given.split_once(':').unwrap();
    from.parse().unwrap()..to.parse().unwrap()
}

fn judge(printed_and_true_db: &[(f64, f64)]) {
    let (inside, median) = told(printed_and_true_db);
    assert!(100 * inside >= 95 * printed_and_true_db.len() && median <= 10.0);
}

/// How many true errors are below the printed ones, and the median excess in dB.
fn told(printed_and_true_db: &[(f64, f64)]) -> (usize, f64) {
    let inside = printed_and_true_db.iter().filter(|(printed, truth)| truth <= printed).count();
    let mut excess: Vec<f64> = printed_and_true_db.iter().map(|(printed, truth)| printed - truth).collect();
    excess.sort_by(f64::total_cmp);
    let median = excess[excess.len() / 2];
    println!("inside: {inside} of {}; median excess {median:.1} dB", excess.len());
    (inside, median)
}

#[test]
#[ignore = "prints the first table of docs/validation/error-estimates.md: many minutes"]
fn a_hundred_random_cases_are_tried() {
    let meshes = vehicles();
    let try_one = |case| {
        let found = random_cases::try_case(case, &named(&meshes), [76e9, 81e9]);
        println!("{found}");
        (found.printed_db, found.true_db)
    };
    judge(&cases().map(try_one).collect::<Vec<_>>());
}

#[test]
#[ignore = "prints the second table of docs/validation/error-estimates.md: many minutes"]
fn a_hundred_random_frames_are_tried() {
    let meshes = vehicles();
    let header = experiment_1();
    let try_one = |case| {
        let found = random_cases::try_frame(case, &named(&meshes), &header);
        println!("{found}");
        (found.printed_db, found.true_db)
    };
    judge(&cases().map(try_one).collect::<Vec<_>>());
}

#[test]
#[ignore = "prints the third table of docs/validation/error-estimates.md: many minutes"]
fn random_roads_are_left_out() {
    let meshes = own_vehicles();
    let header = experiment_1();
    let try_one = |case| {
        let found = road_cases::try_road(case, &named(&meshes), &header);
        println!("{found}");
        (found.printed_db, found.true_db)
    };
    // The figure is of dry asphalt, and the roads are not: how many it covers is found, not promised.
    told(&cases().map(try_one).collect::<Vec<_>>());
}

/// The rows of docs/validation/continuity.md: name, increment error in rad against BART 60 dB below the field
/// with as many bounces, spectral floor in dB.
fn continuity_rows(
    slide: &continuity::Slide<'_>,
    methods: &[(&str, u8, Box<Method<'_>>)],
) -> Vec<(String, f64, f64)> {
    let fine =
        |bounces: u8| continuity::echoes(slide, &|mesh, place, f| bart(mesh, place, f, bounces, -60.0));
    let references = [fine(1), fine(3)];
    let row = |(name, bounces, method): &(&str, u8, Box<Method<'_>>)| {
        let found = continuity::echoes(slide, method);
        let reference = &references[usize::from(*bounces > 1)];
        (
            name.to_string(),
            continuity::increment_error_rad(&found, reference),
            continuity::spectral_floor_db(&found),
        )
    };
    let mut rows: Vec<_> = methods.iter().map(row).collect();
    let names =
        ["BART, one bounce, −60 dB asked (reference)", "BART, three bounces, −60 dB asked (reference)"];
    rows.extend(
        names.iter().zip(&references).map(|(n, s)| (n.to_string(), 0.0, continuity::spectral_floor_db(s))),
    );
    rows.iter()
        .for_each(|(name, error_rad, floor_db)| println!("| {name} | {error_rad:.1e} | {floor_db:.1} |"));
    rows
}

type Method<'a> = dyn Fn(&Mesh, Standpoint, &[f64]) -> Run + 'a;

#[test]
fn the_field_of_beams_runs_on_from_chirp_to_chirp_where_rays_jump() {
    let mesh = boxes_on_a_plate();
    let slide = continuity::Slide {
        mesh: &mesh,
        antenna_m: glam::DVec3::new(26.0, 12.0, 10.0),
        velocity_mps: glam::DVec3::new(10.0, 0.0, 0.0),
        frequency_hz: 10e9,
        chirp_interval_s: 60e-6,
        chirps: 32,
    };
    let methods: [(&str, u8, Box<Method<'_>>); 2] = [
        ("BART, −30 dB asked", 3, Box::new(|m, p, f| bart(m, p, f, 3, -30.0))),
        ("sbr, three bounces, 4 rays per λ", 3, Box::new(|m, p, f| sbr(m, p, f, 4.0, 3))),
    ];
    let rows = continuity_rows(&slide, &methods);
    assert!(rows[0].1 < 0.3 * rows[1].1, "{rows:?}");
    assert!(rows[0].2 < rows[1].2 - 10.0, "{rows:?}");
}

#[test]
#[ignore = "prints the table of docs/validation/continuity.md: many minutes"]
fn the_continuity_of_a_moving_car_is_measured() {
    let mesh = own("car-suv");
    let slide = continuity::Slide {
        mesh: &mesh,
        antenna_m: glam::DVec3::new(27.0, 12.0, 5.0),
        velocity_mps: glam::DVec3::new(10.0, 0.0, 0.0),
        frequency_hz: 10e9,
        chirp_interval_s: 60e-6,
        chirps: 32,
    };
    let methods: [(&str, u8, Box<Method<'_>>); 6] = [
        ("BART, three bounces, −20 dB asked", 3, Box::new(|m, p, f| bart(m, p, f, 3, -20.0))),
        ("BART, three bounces, −40 dB asked", 3, Box::new(|m, p, f| bart(m, p, f, 3, -40.0))),
        ("po, one bounce, 2 cells per λ, borders not halved", 1, Box::new(|m, p, f| po(m, p, f, 2.0, 0))),
        ("po, one bounce, 2 cells per λ, borders halved 3 times", 1, Box::new(|m, p, f| po(m, p, f, 2.0, 3))),
        ("sbr, three bounces, 1 ray per λ", 3, Box::new(|m, p, f| sbr(m, p, f, 1.0, 3))),
        ("sbr, three bounces, 4 rays per λ", 3, Box::new(|m, p, f| sbr(m, p, f, 4.0, 3))),
    ];
    continuity_rows(&slide, &methods);
}
