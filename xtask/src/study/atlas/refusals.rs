//! Inputs without an answer must be refused, with a reason.

use crate::study::atlas::CaseRow;
use crate::study::atlas::methods;
use crate::study::atlas::verdict::{AtlasCase, Trial, atlas_cases};
use crate::study::bodies;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::{cube_header, cube_of, paths_of, scene_of, with_point};
use artifact::scene::{Mesh, SceneHeader};
use bart_rcs::RcsRequest;
use num_complex::Complex32;
use scene::MeshOptions;
use scene::mesh::{Format, mesh_from_bytes};
use std::path::Path;
use wayside::host::failure::Failure;

pub(super) const CASES: &[AtlasCase] = atlas_cases![meshes, scenes, antennas, echoes];

/// Mesh files, and meshes that reach the tracer in another way.
pub(in crate::study::atlas) fn meshes(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MESH.trial("meshes without an answer", "file");
    let file = |name: &str, text: &str| {
        let options = MeshOptions { unit_scale: None };
        trial
            .must_refuse(name, mesh_from_bytes(text.as_bytes(), Format::Obj, Path::new("body.obj"), &options))
    };
    let traced = Trial { stage: "bart-rcs", method: "bart", ..trial };
    let infinite = bodies::mesh(vec![[0.0; 3], [0.0, f64::INFINITY, 0.0], [0.0, 0.0, 1.0]], vec![[0, 1, 2]]);
    let unknown = bodies::mesh(vec![[0.0; 3]; 3], vec![[0, 1, 3]]);
    let trace = |body: &Mesh| rcs_solvers::trace_rcs(body, &rcs_solvers::first_order_request(0.0, 0.0));
    Ok(vec![
        file("a NaN coordinate", "v nan 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"),
        file("a vertex that is not there", "v 0 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 9\n"),
        file("10 km large", "v 0 0 0\nv 0 10000 0\nv 0 0 10000\nf 1 2 3\n"),
        file("no triangle", "v 0 0 0\n"),
        traced.must_refuse("an infinite coordinate", trace(&infinite)),
        traced.must_refuse("an index out of range", trace(&unknown)),
    ])
}

/// Scene files.
pub(in crate::study::atlas) fn scenes(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::READ.trial("scenes without an answer", "scene");
    let scene = |name: &str, words: &str| trial.must_refuse(name, scene_of(words));
    Ok(vec![
        scene("a key that is misspelt", "[radar]\npositon_m = [0.0, 0.0, 6.0]\n"),
        scene("no samples", "[radar.waveform]\nsamples = 0\n"),
        scene("a detector wider than the map", "[dsp]\ntraining_cells = [200, 10]\n"),
        scene(
            "a speed that is not finite",
            "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1.0\nposition_m = [0.0, 30.0, 0.0]\nvelocity_mps = [inf, 0.0, 0.0]\n",
        ),
    ])
}

/// Positions from which nothing can be seen.
pub(in crate::study::atlas) fn antennas(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BART.trial("requests without an answer", "request");
    let plate = bodies::plate(0.3);
    let ask = |change: &dyn Fn(&mut RcsRequest)| {
        let mut request = rcs_solvers::first_order_request(0.0, 0.0);
        change(&mut request);
        rcs_solvers::trace_rcs(&plate, &request)
    };
    Ok(vec![
        trial.must_refuse("range 0", ask(&|r| r.range_m = 0.0)),
        trial.must_refuse("frequency NaN", ask(&|r| r.frequency_hz = vec![f64::NAN])),
        trial.must_refuse("six bounces", ask(&|r| r.bounces = 6)),
        trial.must_refuse("azimuth NaN", ask(&|r| r.azimuth_rad = vec![f64::NAN])),
    ])
}

fn small_scene() -> Result<SceneHeader, Failure> {
    let header =
        scene_of("[radar.waveform]\nchirps = 32\n[radar.array]\npreset = \"1x1\"\n[noise]\nsnr_db = 20.0\n")?;
    Ok(with_point(header, 1.0, [0.0, 30.0, 6.0], [0.0; 3]))
}

/// Paths and samples.
pub(in crate::study::atlas) fn echoes(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let echo = methods::RECURRENCE.trial("paths without an echo", "path");
    let map = methods::MAP.trial("cubes without a map", "cube");
    let header = small_scene()?;
    let paths = paths_of(&header)?;
    let with = |position_m: [f64; 3]| {
        let mut changed = paths.clone();
        (changed.paths[0].apparent_tx_m, changed.paths[0].apparent_rx_m) = (position_m, position_m);
        cube_of(&header, &changed)
    };
    let receiver = dsp::Receiver::new(&cube_header(&header)).map_err(Failure::refused)?;
    let mut broken = cube_of(&header, &paths)?;
    broken.samples[7] = Complex32::new(f32::NAN, 0.0);
    let mut short = broken.clone();
    short.samples.truncate(100);
    Ok(vec![
        echo.must_refuse("at NaN", with([f64::NAN, 30.0, 6.0])),
        echo.must_refuse("in the antenna", with(header.radar.position_m)),
        map.must_refuse("a NaN sample", receiver.range_doppler(&broken)),
        map.must_refuse("samples missing", receiver.range_doppler(&short)),
    ])
}
