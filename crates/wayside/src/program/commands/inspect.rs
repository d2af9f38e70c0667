//! `inspect`: header, provenance, shape, units and a sanity line of any artifact.

use crate::program::cli::InspectArguments;
use crate::program::terminal::{cancellation, line};
use artifact::classes::Classes;
use artifact::cube::{Cube, CubeHeader};
use artifact::dataset::Dataset;
use artifact::model::{BoostedTrees, Learner, Model, ProfileNetwork, ProfileNetworks, ProfileShape, Weights};
use artifact::paths::{Paths, TargetDetail};
use artifact::points::Points;
use artifact::rcs::Rcs;
use artifact::rdm::Rdm;
use artifact::scene::{Scene, SceneHeader};
use artifact::tracks::{TrackState, Tracks};
use artifact::units::{db_from_amplitude, db_from_power, power};
use artifact::{Preamble, Radar, Reader, Schema, read_preamble};
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use radar::lattice::resolves_azimuth;
use reporting::console_lines::{WITHOUT_AZIMUTH, WITHOUT_NOISE, without_height};
use std::path::Path;

/// Words for invalid and for valid content.
const SANITY: [&str; 2] = ["NOT complete and finite", "complete and finite"];

pub(crate) fn run(arguments: &InspectArguments) -> Result<(), Failure> {
    let file = &arguments.file;
    let preamble = read_preamble(file)?;
    provenance(&preamble);
    match preamble.schema.as_str() {
        Scene::NAME => scene(Reader::open(file)?),
        Paths::NAME => paths(Reader::open(file)?),
        Rcs::NAME => rcs(Reader::open(file)?),
        Cube::NAME => cube(Reader::open(file)?),
        Rdm::NAME => rdm(Reader::open(file)?),
        Points::NAME => points(Reader::open(file)?),
        Tracks::NAME => tracks(Reader::open(file)?),
        Dataset::NAME => dataset(Reader::open(file)?),
        Model::NAME => model(Reader::open(file)?),
        Classes::NAME => classes(Reader::open(file)?),
        other => Err(unknown(file, other)),
    }
}

/// Frames of an artifact, as long as what is said of them can be printed.
fn frames<S: Schema>(reader: Reader<S>) -> impl Iterator<Item = Result<S::Frame, Failure>> {
    let cancellation = cancellation();
    progress::frames(reader).map(move |frame| cancellation.check().and_then(|()| Ok(frame?)))
}

/// Prints the line of a frame: its number and time, its content, and whether that is valid.
fn of_frame((index, time_s): (u32, f64), content: std::fmt::Arguments, sanity: &str) {
    line(format_args!("frame {index:<6} {time_s:.6} s, {content}, {sanity}"));
}

/// An artifact whose kind this program does not know.
pub(crate) fn unknown(file: &Path, schema: &str) -> Failure {
    Failure::Refused(format!("{}: `{schema}` is no kind of artifact that this program knows", file.display()))
}

fn provenance(preamble: &Preamble) {
    let Preamble { schema, version, provenance } = preamble;
    line(format!("kind         {schema}, version {version}"));
    line(format!(
        "written by   {} {}, seed {}",
        provenance.stage, provenance.program_version, provenance.seed
    ));
    for (name, hash) in &provenance.inputs {
        line(format!("input        {name} {hash}"));
    }
    if !provenance.settings.is_empty() {
        line(format!("settings     {}", provenance.settings));
    }
}

fn directions(radar: &Radar) {
    if !resolves_azimuth(radar) {
        line(format!("directions   {WITHOUT_AZIMUTH}"));
    }
}

fn radar(radar: &Radar) {
    let sub_frames = radar.schedule.sub_frames();
    for index in (0..sub_frames).filter(|_| sub_frames > 1) {
        let (of_one, start_s) = (radar.in_frame(index), radar.sub_frame_start_s(index));
        let (interval_us, velocity_mps) = (of_one.waveform.chirp_interval_s * 1e6, of_one.velocity_max_mps());
        line(format!(
            "sub-frame    {index}: from {:.4} ms, a chirp every {interval_us:.3} µs, ±{velocity_mps:.3} m/s",
            start_s * 1e3
        ));
    }
    let w = &radar.waveform;
    line(format!(
        "radar        {:.4} GHz centre, {:.4} MHz bandwidth, {} samples, {} chirps every {:.3} µs",
        w.centre_frequency_hz() / 1e9,
        w.bandwidth_hz() / 1e6,
        w.samples,
        w.chirps,
        radar.repetition_interval_s() * 1e6
    ));
    line(format!(
        "cells        {:.4} m to {:.2} m, {:.4} m/s to ±{:.3} m/s",
        w.range_resolution_m(),
        w.range_max_m(),
        radar.velocity_resolution_mps(),
        radar.velocity_max_mps()
    ));
}

fn scene(reader: Reader<Scene>) -> Result<(), Failure> {
    let SceneHeader { name, seed, meshes, targets, traffic, radar: r, .. } = reader.header();
    line(format!("scene        {name}, seed {seed}, {} targets, {} meshes", targets.len(), meshes.len()));
    if let Some(traffic) = traffic {
        let (vehicles, frames) = (traffic.vehicles.len(), traffic.frames.len());
        let placed: usize = traffic.frames.iter().map(Vec::len).sum();
        line(format!("traffic      {vehicles} vehicles in {frames} frames, {placed} times in view"));
    }
    radar(r);
    for mesh in meshes.iter() {
        let s = mesh.statistics;
        let (kept, dropped, open) = (mesh.triangles.len(), s.degenerate, s.open_edges);
        let [length_m, width_m, height_m] = mesh.size_m();
        line(format!(
            "mesh         {}: {kept} triangles, {dropped} degenerate dropped, {open} open edges, {length_m:.3} m \
             long, {width_m:.3} m wide, {height_m:.3} m high",
            mesh.name
        ));
    }
    for frame in frames(reader) {
        let frame = frame?;
        let finite =
            frame.poses.iter().all(|p| p.position_m.iter().chain(&p.velocity_mps).all(|v| v.is_finite()));
        of_frame(
            (frame.index, frame.time_s),
            format_args!("{} poses", frame.poses.len()),
            SANITY[usize::from(finite)],
        );
    }
    Ok(())
}

fn paths(reader: Reader<Paths>) -> Result<(), Failure> {
    let header = reader.header();
    line(format!(
        "f_c          {:.6} GHz; positions m, velocities m/s, amplitudes m",
        header.centre_frequency_hz / 1e9
    ));
    line(format!("targets      {}", header.targets.join(", ")));
    for frame in frames(reader) {
        let frame = frame?;
        let power: f64 = frame.paths.iter().map(|p| p.amplitude_m[0][0].norm_sqr()).sum();
        let (count, by_order, level_dbsm) = (frame.paths.len(), frame.trace.paths, db_from_power(power));
        let content = format_args!("{count} paths (by order {by_order:?}), Σ|a|² vv {level_dbsm:.2} dBsm");
        of_frame((frame.index, frame.time_s), content, SANITY[usize::from(power.is_finite())]);
        frame.trace.detail.iter().enumerate().for_each(|(target, detail)| line(of_detail(target, detail)));
    }
    Ok(())
}

fn of_detail(target: usize, detail: &TargetDetail) -> String {
    let error = detail.error.map_or(String::new(), |e| format!(", {:.1} dB", db_from_amplitude(e)));
    format!("  target {target:<4} {}: {} of {} paths{error}", detail.level.name(), detail.kept, detail.traced)
}

fn rcs(reader: Reader<Rcs>) -> Result<(), Failure> {
    let targets = reader.header().targets.clone();
    for frame in frames(reader) {
        let frame = frame?;
        for table in &frame.tables {
            let shape = [table.frequency_hz.len(), table.elevation_rad.len(), table.azimuth_rad.len()];
            let peak = table.amplitude_m.iter().map(|s| s.norm_sqr()).fold(0.0, f64::max);
            let complete = table.amplitude_m.len() == shape.iter().product::<usize>() && peak.is_finite();
            let name = targets.get(table.target as usize).map_or("?", String::as_str);
            line(format!(
                "frame {:<6} {name}: S in m, [frequency, elevation, azimuth] = {shape:?}, peak {:.2} dBsm, {}",
                frame.index,
                db_from_power(peak),
                SANITY[usize::from(complete)]
            ));
        }
    }
    Ok(())
}

fn cube(reader: Reader<Cube>) -> Result<(), Failure> {
    let header = reader.header().clone();
    radar(&header.radar);
    let shape = header.shape();
    line(format!("shape        [channel, chirp, sample] = {shape:?}, {}", header.unit.words()));
    for frame in frames(reader) {
        let frame = frame?;
        let level_db = header.unit.level_db(mean_power(&frame.samples));
        samples((frame.index, frame.time_s), &frame.samples, shape, (level_db, header.unit.level_unit()));
    }
    Ok(())
}

fn rdm(reader: Reader<Rdm>) -> Result<(), Failure> {
    let header: CubeHeader = reader.header().clone();
    radar(&header.radar);
    if !dsp::has_noise(&header) {
        line(format!("noise        {WITHOUT_NOISE}"));
    }
    let shape = artifact::rdm::shape(&header);
    line(format!("shape        [channel, doppler, range] = {shape:?}, {}", header.unit.words()));
    for frame in frames(reader) {
        let frame = frame?;
        let level_db = header.map_level_db(mean_power(&frame.values), 1);
        samples((frame.index, frame.time_s), &frame.values, shape, (level_db, header.unit.level_unit()));
        line(format!(
            "detector     {} of {} tested cells above the threshold",
            frame.detections, frame.cells
        ));
    }
    Ok(())
}

/// Prints the mean power of samples, or of the cells of a map, and whether they are complete.
fn samples((index, time_s): (u32, f64), values: &[Complex32], shape: [usize; 3], level: (f64, &str)) {
    let complete = values.len() == shape.iter().product::<usize>() && level.0.is_finite();
    of_frame(
        (index, time_s),
        format_args!("mean power {:.2} {}", level.0, level.1),
        SANITY[usize::from(complete)],
    );
}

fn mean_power(values: &[Complex32]) -> f64 {
    values.iter().copied().map(power).sum::<f64>() / values.len().max(1) as f64
}

fn points(reader: Reader<Points>) -> Result<(), Failure> {
    if let Some(cube) = &reader.header().cube {
        radar(&cube.radar);
        directions(&cube.radar);
    }
    line("units        m, m/s, rad, dB; world axes");
    for frame in frames(reader) {
        let frame = frame?;
        let finite = frame.points.iter().all(|p| p.position_m.iter().all(|x| x.is_finite()));
        let (points, objects) = (frame.points.len(), frame.objects.len());
        let content = format_args!("{points} points, {objects} objects");
        of_frame((frame.index, frame.time_s), content, SANITY[usize::from(finite)]);
        if let Some(text) = without_height([frame.points_without_height(), points]) {
            line(format!("             {text}"));
        }
    }
    Ok(())
}

fn tracks(reader: Reader<Tracks>) -> Result<(), Failure> {
    if let Some(cube) = &reader.header().cube {
        radar(&cube.radar);
        directions(&cube.radar);
    }
    line("units        m, m/s, rad; world axes");
    for frame in frames(reader) {
        let frame = frame?;
        let finite =
            frame.tracks.iter().all(|t| t.position_m.iter().chain(&t.velocity_mps).all(|v| v.is_finite()));
        let count = |state: TrackState| frame.tracks.iter().filter(|t| t.state == state).count();
        let [confirmed, coasting, tentative] =
            [TrackState::Confirmed, TrackState::Coasting, TrackState::Tentative].map(count);
        let content = format_args!("{confirmed} confirmed, {coasting} coasting, {tentative} tentative");
        of_frame((frame.index, frame.time_s), content, SANITY[usize::from(finite)]);
    }
    Ok(())
}

fn dataset(reader: Reader<Dataset>) -> Result<(), Failure> {
    let f = *reader.header();
    line(format!(
        "crops        {0} × {0} pixels, {1} m × {2} m/s, {3} … {4} dB over noise",
        f.side, f.range_span_m, f.velocity_span_mps, f.floor_db, f.ceiling_db
    ));
    let mut counts = std::collections::BTreeMap::new();
    let mut complete = true;
    for sample in frames(reader) {
        let sample = sample?;
        complete &= sample.crop.is_none_or(|crop| crop.pixels.len() == (f.side as usize).pow(2));
        *counts.entry((sample.split, sample.class)).or_insert(0_u64) += 1;
    }
    for ((split, class), count) in counts {
        line(format!("samples      {count:>6} {split:?} {}", class.map_or("unlabelled", |c| c.name())));
    }
    line(format!("sanity       {}", SANITY[usize::from(complete)]));
    Ok(())
}

fn classes(reader: Reader<Classes>) -> Result<(), Failure> {
    let names: Vec<_> = reader.header().classes.iter().map(|class| class.name()).collect();
    line(format!("classes      {}", names.join(", ")));
    for frame in frames(reader) {
        let probabilities = frame?.probabilities;
        let sound = probabilities.iter().flatten().all(|p| (0.0..=1.0).contains(p));
        line(format!("objects      {}, {}", probabilities.len(), SANITY[usize::from(sound)]));
    }
    Ok(())
}

fn model(mut reader: Reader<Model>) -> Result<(), Failure> {
    let header = reader.header().clone();
    let classes: Vec<_> = header.classes.iter().map(|c| c.name()).collect();
    line(match &header.learner {
        Learner::CropNetwork(n) => {
            format!(
                "network      {}, channels {:?}, crops pooled to {}",
                n.architecture, n.channels, n.input_side
            )
        }
        Learner::BoostedTrees { features } => {
            format!("trees        of {} features of signatures", features.len())
        }
        Learner::ProfileNetworks(shape) => of_shape(shape),
        Learner::TreesAndNetworks { features, shape } => {
            format!("{}, and trees of {} features", of_shape(shape), features.len())
        }
    });
    line(format!("classes      {}", classes.join(", ")));
    let (told, sound) = reader.next_frame()?.map_or(("none".into(), false), |weights| of_weights(&weights));
    line(format!("weights      {told}, {}", SANITY[usize::from(sound)]));
    line(format!("unknown      below a probability of {:.2}", header.least_probability));
    header.attributions.iter().for_each(|whose| line(format!("learned from {whose}")));
    Ok(())
}

/// Inputs of networks over range cells.
fn of_shape(shape: &ProfileShape) -> String {
    let (cells, of_cells, of_object) = (shape.cells, shape.of_cells.len(), shape.of_object.len());
    format!(
        "networks     over {cells} range cells of signatures, {of_cells} quantities of each, {of_object} of the whole"
    )
}

/// Number of the parameters in words, and whether they are sound.
fn of_weights(weights: &Weights) -> (String, bool) {
    match weights {
        Weights::Network { safetensors } => {
            (format!("{} bytes of safetensors", safetensors.len()), !safetensors.is_empty())
        }
        Weights::Trees(trees) => of_trees(trees),
        Weights::Profile(networks) => of_networks(networks),
        Weights::Both { trees, networks } => {
            let ((trees, are_sound), (networks, fit)) = (of_trees(trees), of_networks(networks));
            (format!("{networks}, {trees}"), are_sound && fit)
        }
    }
}

fn is_divisor(temperature: f32) -> bool {
    temperature.is_finite() && temperature > 0.0
}

fn of_trees(trees: &BoostedTrees) -> (String, bool) {
    (format!("{} trees", trees.trees.len()), is_divisor(trees.temperature))
}

fn of_networks(networks: &ProfileNetworks) -> (String, bool) {
    let (of, values) = (networks.members.len(), || networks.members.iter().flat_map(values_of));
    let sound = of > 0 && is_divisor(networks.temperature) && values().all(f32::is_finite);
    (format!("{} in {of} networks", values().count()), sound)
}

/// Weights and biases of a network over range cells, layer by layer.
fn values_of(network: &ProfileNetwork) -> impl Iterator<Item = f32> {
    let convolutions = network.convolutions.iter().flat_map(|layer| layer.weights.iter().chain(&layer.bias));
    let dense = [&network.hidden, &network.output];
    let dense = dense.into_iter().flat_map(|layer| layer.weights.iter().chain(&layer.bias));
    convolutions.chain(dense).copied()
}
