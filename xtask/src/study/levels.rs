//! Levels of detail: the cost and error of each, and the choice for a requested accuracy.

mod row;
mod presentation;

pub(super) use presentation::{COLUMNS, csv, page, picture};

use crate::project::project_root;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::{cube_header, paths_of, scene_of, with_body};
use artifact::paths::{Path, PathsFrame};
use artifact::scene::SceneHeader;
use artifact::settings::{Detail, Noise};
use artifact::{Accuracy, ErrorBudget};
use num_complex::Complex64;
use row::LevelRow;
use scene::ReadOptions;
use std::time::Instant;
use wayside::host::failure::Failure;
use wayside::host::processor_time;
use wayside::host::progress::Work;

/// A scene with the finest accuracy of its tracing: beyond it only the reduction is made finer.
struct LevelCase {
    name: &'static str,
    header: SceneHeader,
    traced_db: f64,
}

fn cases(extent: Extent) -> Result<Vec<LevelCase>, Failure> {
    let case = |name, header, traced_db| LevelCase { name, header, traced_db };
    let car = || vehicle("car-suv", 10.0, APPROACHING_DEG);
    if extent == Extent::Quick {
        return Ok(vec![case("car-suv, 40 m", car()?, -20.0)]);
    }
    Ok(vec![
        case("car-suv, 40 m", car()?, -30.0),
        case("bus-city, 40 m", vehicle("bus-city", 8.0, APPROACHING_DEG)?, -30.0),
        case("intersection", intersection()?, -20.0),
        case("car-suv, 40 m, 12 × 16 elements", wide(car()?)?, -20.0),
        case("car-suv, turned by 30°", vehicle("car-suv", 10.0, APPROACHING_DEG + 30.0)?, -20.0),
        case("car-suv, turned by 90°", vehicle("car-suv", 10.0, APPROACHING_DEG + 90.0)?, -20.0),
        case("car-sedan, turned by 180°", vehicle("car-sedan", 10.0, APPROACHING_DEG + 180.0)?, -20.0),
        case(
            "motorcycle-street, turned by 10°",
            vehicle("motorcycle-street", 10.0, APPROACHING_DEG + 10.0)?,
            -20.0,
        ),
    ])
}

/// Heading towards −y, degrees.
const APPROACHING_DEG: f64 = -90.0;

/// A scene with a vehicle in lane 2, 40 m ahead, moving down the lane.
fn vehicle(name: &str, speed_mps: f64, yaw_deg: f64) -> Result<SceneHeader, Failure> {
    let body =
        scene::vehicles::mesh(name, 0).ok_or_else(|| Failure::refused(format!("`{name}` is missing")))?;
    let mut header = with_body(scene_of("")?, &body, [5.75, 40.0, 0.0], [0.0, -speed_mps, 0.0]);
    header.targets.iter_mut().for_each(|target| target.start.yaw_rad = yaw_deg.to_radians());
    Ok(header)
}

/// The scene with a radar of 192 channels.
fn wide(header: SceneHeader) -> Result<SceneHeader, Failure> {
    let radar = scene_of("[radar.array]\npreset = \"12x16\"\n")?.radar;
    Ok(SceneHeader { radar, ..header })
}

fn intersection() -> Result<SceneHeader, Failure> {
    let file = project_root().join("scenes/intersection.toml");
    let header = scene::read(&file, &ReadOptions::whole()).map_err(Failure::refused)?;
    Ok(SceneHeader { noise: Noise::Absent, ..header })
}

/// Every level of every frame.
pub(super) fn rows(extent: Extent) -> Result<Vec<LevelRow>, Failure> {
    let work = Work::begin("levels");
    let cases = cases(extent)?;
    let mut all = Vec::new();
    for (number, case) in cases.iter().enumerate() {
        work.at(number, cases.len());
        all.extend(of_case(case)?);
    }
    Ok(all)
}

/// Rows of a case for each requested accuracy, which also applies to the tracing down to the case's limit.
fn of_case(case: &LevelCase) -> Result<Vec<LevelRow>, Failure> {
    const ASKED_DB: [f64; 5] = [-10.0, -20.0, -30.0, -40.0, -50.0];
    let mut header = case.header.clone();
    let mut rows = Vec::new();
    let mut traced = None;
    for asked_db in ASKED_DB {
        header.fidelity.accuracy = Accuracy::from_db(asked_db);
        let of_frame = match traced.take() {
            Some((frame, seconds)) if asked_db < case.traced_db => {
                (PathsFrame { error: ErrorBudget::default(), ..frame }, seconds)
            }
            _ => timed(|| paths_of(&header))?,
        };
        rows.extend(of_levels(case.name, asked_db, &header, &of_frame)?);
        traced = Some(of_frame);
    }
    Ok(rows)
}

fn of_levels(
    scene: &'static str,
    asked_db: f64,
    header: &SceneHeader,
    (traced, trace_s): &(PathsFrame, f64),
) -> Result<Vec<LevelRow>, Failure> {
    let (mut header, trace_s) = (header.clone(), *trace_s);
    let (exact, all_s) = timed(|| Ok(cube(&header, &traced.paths)))?;
    let mut rows = vec![LevelRow {
        scene,
        asked_db,
        level: Detail::Paths,
        chosen: String::new(),
        paths: traced.paths.len(),
        told: None,
        error: None,
        total: traced.error.total(),
        seconds: [trace_s, 0.0, all_s],
    }];
    for level in [Detail::Merged, Detail::Centres, Detail::Statistical, Detail::Auto] {
        header.fidelity.detail = level;
        let frame = traced.clone();
        let (reduced, reduce_s) = timed(|| Ok(bart_rcs::reduce_detail(&header, frame)))?;
        let (got, echo_s) = timed(|| Ok(cube(&header, &reduced.paths)))?;
        rows.push(LevelRow {
            scene,
            asked_db,
            level,
            chosen: chosen(&reduced),
            paths: reduced.paths.len(),
            told: reduced.error.detail,
            error: reduced.error.detail.map(|_| rcs_solvers::relative_error(&got, &exact)),
            total: reduced.error.total(),
            seconds: [trace_s, reduce_s, echo_s],
        });
    }
    Ok(rows)
}

fn cube(header: &SceneHeader, paths: &[Path]) -> Vec<Complex64> {
    let radar = &cube_header(header).radar;
    let accuracy = fmcw_echo::sum_accuracy(header.fidelity.accuracy);
    fmcw_echo::fast_sum::cube(radar, radar.waveform.centre_frequency_hz(), paths, accuracy)
}

/// Each target's level, in the order of the targets.
fn chosen(frame: &PathsFrame) -> String {
    let of = |detail: &artifact::paths::TargetDetail| {
        format!("{} {}→{}", detail.level.name(), detail.traced, detail.kept)
    };
    frame.trace.detail.iter().map(of).collect::<Vec<_>>().join(", ")
}

/// Does work and returns its result with its processor seconds.
fn timed<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<(T, f64), Failure> {
    let (start, begin) = (Instant::now(), processor_time::of_living_threads());
    let value = work()?;
    let both = processor_time::of_living_threads().zip(begin);
    let seconds = both.map_or_else(|| start.elapsed().as_secs_f64(), |(end, begin)| end - begin);
    Ok((value, seconds))
}
