//! `dsp`: range-Doppler maps and points of any radar cube, from the cube alone.

use crate::program::cli::DspArguments;
use crate::program::terminal;
use crate::run::leftovers;
use artifact::cube::{Cube, CubeHeader};
use artifact::points::{Points, PointsFrame, PointsHeader};
use artifact::rdm::{Rdm, RdmFrame};
use artifact::settings::{DspSettings, Noise};
use artifact::tracks::{Tracks, TracksFrame, TracksHeader};
use artifact::{Provenance, Reader, Writer};
use dsp::{ROAD_TRAFFIC, Receiver, Tracker, has_noise};
use pipeline::chain::loading;
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use radar::lattice::resolves_azimuth;
use reporting::console_lines::{WITHOUT_AZIMUTH, WITHOUT_NOISE, without_height};
use reporting::pictures;
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &DspArguments) -> Result<(), Failure> {
    let reader = Reader::<Cube>::open(&arguments.cube)?;
    let mut header = reader.header().clone();
    let of_scene = arguments.scene.as_deref().map(|file| settings_of(file, arguments.radar.as_deref()));
    let mut inputs = reader.preamble().provenance.inputs.clone();
    if let Some(SettingsOfScene { settings, noise, hashed }) = of_scene.transpose()? {
        header.dsp = settings;
        remark_on_noise(arguments, noise, header.noise);
        inputs.extend(hashed.into_iter().filter(|file| !reader.preamble().provenance.inputs.contains(file)));
    }
    let from = provenance_of(&reader, &header, inputs);
    let place = |kind: &str| place_of(arguments, kind);
    let frames = reader.frames();
    let earlier = earlier_results(arguments, ["rdm", "points", "tracks"].map(place), frames)?;
    let cloud_header = PointsHeader { cube: Some(header.clone()), targets: vec![], classes: vec![] };
    let followed_header = TracksHeader { cube: Some(header.clone()) };
    let receiver = Receiver::new(&header).map_err(|e| refused(&arguments.cube, &e))?;
    let mut products = DspProducts {
        header: &header,
        receiver: &receiver,
        pictures: arguments.pictures.then(|| arguments.out.join("pictures")),
        earlier,
        maps: Writer::create(&place("rdm"), &from, &header)?,
        clouds: Writer::create(&place("points"), &from, &cloud_header)?,
        followed: Writer::create(&place("tracks"), &from, &followed_header)?,
        tracker: Tracker::new(&header, ROAD_TRAFFIC).map_err(|e| refused(&arguments.cube, &e))?,
    };
    let mut cycle = Vec::new();
    for cube in progress::frames(reader) {
        let cube = cube?;
        cycle.push(receiver.process(&cube).map_err(|e| refused(&arguments.cube, &e))?);
        if cycle.len() == receiver.frames_in_cycle() {
            products.write(std::mem::take(&mut cycle))?;
        }
    }
    // A recording may end within a cycle.
    products.write(cycle)?;
    if !has_noise(&header) {
        terminal::line(WITHOUT_NOISE);
    }
    if !resolves_azimuth(&header.radar) {
        terminal::line(WITHOUT_AZIMUTH);
    }
    products.finish()?;
    // Views from above are pictures of a run, and never of this command.
    leftovers::remark_on_pictures(&arguments.out, |kind, number| {
        kind == "scene" || (arguments.pictures && u64::from(number) < frames)
    });
    Ok(())
}

/// Place of a result, which is named after the cube.
fn place_of(arguments: &DspArguments, kind: &str) -> PathBuf {
    let mut name = arguments.cube.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{kind}"));
    arguments.out.join(name)
}

/// Places of all results, named after the cube, and of existing pictures, named after their frames, which
/// this command replaces. Refuses to replace files of others.
fn earlier_results(
    arguments: &DspArguments,
    results: [PathBuf; 3],
    frames: u64,
) -> Result<Vec<PathBuf>, Failure> {
    results.iter().try_for_each(|place| files::refuse_no_artifact(place))?;
    let frames = if arguments.pictures { frames } else { 0 };
    let folder = arguments.out.join("pictures");
    let of_frame = |index: u64| pictures::names_of_map(index as u32).map(|name| folder.join(name));
    let drawn: Vec<PathBuf> = (0..frames).flat_map(of_frame).filter(|place| place.is_file()).collect();
    drawn.iter().try_for_each(|place| files::refuse_foreign_head(place, pictures::is_own))?;
    let [map, ..] = &results;
    if let (Some(first), false) = (drawn.first(), map.exists()) {
        progress::note(format!(
            "note: {}: pictures of another run or cube are replaced; with another --out they are kept",
            first.display()
        ));
    }
    Ok(results.into_iter().chain(drawn).collect())
}

/// Outputs of the processing of a cube: writers of maps, points and tracks, and the tracker between frames.
struct DspProducts<'a> {
    header: &'a CubeHeader,
    receiver: &'a Receiver,
    pictures: Option<PathBuf>,
    /// Files that are removed before the first cycle is written.
    earlier: Vec<PathBuf>,
    maps: Writer<Rdm>,
    clouds: Writer<Points>,
    followed: Writer<Tracks>,
    tracker: Tracker,
}

impl DspProducts<'_> {
    /// Writes the records of a cycle, whose points resolve each other's velocities.
    fn write(&mut self, cycle: Vec<(RdmFrame, PointsFrame)>) -> Result<(), Failure> {
        files::remove_outdated(std::mem::take(&mut self.earlier))?;
        let (rdms, points): (Vec<_>, Vec<_>) = cycle.into_iter().unzip();
        for (rdm, points) in rdms.iter().zip(self.receiver.resolved(points)) {
            let tracks = self.tracker.step(&points).map_err(Failure::refused)?;
            tell(rdm, &points, &tracks);
            terminal::cancellation().check()?;
            if let Some(folder) = &self.pictures {
                pictures::of_map(self.header, rdm, &points, folder)?;
            }
            self.maps.write(rdm)?;
            self.clouds.write(&points)?;
            self.followed.write(&tracks)?;
        }
        Ok(())
    }

    fn finish(self) -> Result<(), Failure> {
        self.followed.finish()?;
        self.maps.finish()?;
        Ok(self.clouds.finish()?)
    }
}

fn tell(rdm: &RdmFrame, points: &PointsFrame, tracks: &TracksFrame) {
    terminal::line(format!(
        "frame {}: {} cells above the threshold, {} points, {} objects, {} tracks",
        rdm.index,
        rdm.detections,
        points.points.len(),
        points.objects.len(),
        tracks.tracks.len()
    ));
    if let Some(text) = without_height([points.points_without_height(), points.points.len()]) {
        terminal::line(format!("  {text}"));
    }
}

fn refused(file: &Path, error: &dyn std::fmt::Display) -> Failure {
    Failure::Refused(format!("{}: {error}", file.display()))
}

/// Settings of a scene for a cube that was made from another one.
struct SettingsOfScene {
    settings: DspSettings,
    noise: Noise,
    /// Names and hashes of the files of these settings.
    hashed: Vec<(String, String)>,
}

fn settings_of(file: &Path, radar: Option<&str>) -> Result<SettingsOfScene, Failure> {
    let files = scene::inputs_without_models(file, &[], radar).map_err(loading::scene_failure)?;
    let (scene, hashed) = loading::read_hashed(&files, || loading::radar_only(file, radar))?;
    Ok(SettingsOfScene { settings: scene.dsp, noise: scene.noise, hashed })
}

/// Notes if the noise of the scene differs from that of the cube, which counts.
fn remark_on_noise(arguments: &DspArguments, said: Noise, of_cube: Noise) {
    if let (Some(file), true) = (&arguments.scene, said != Noise::Absent && said != of_cube) {
        progress::note(format!(
            "note: {}: [noise] is passed over: a cube has that of the scene which it was made or imported by",
            file.display()
        ));
    }
}

fn provenance_of(reader: &Reader<Cube>, header: &CubeHeader, inputs: Vec<(String, String)>) -> Provenance {
    Provenance {
        stage: Stage::Dsp.name().into(),
        program_version: env!("CARGO_PKG_VERSION").into(),
        inputs,
        settings: serde_json::to_string(&header.dsp).unwrap_or_default(),
        seed: reader.preamble().provenance.seed,
    }
}
