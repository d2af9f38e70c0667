//! Whole frames of every scene with both kinds of echo: path by path with a requested accuracy, and by the
//! paper's table.

use crate::study::chart::cost::{Cost, measured};
use crate::study::chart::row::SettingRow;
use crate::study::chart::scenes::Scene;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::{
    cube_header, cube_of, frame_of, paths_at, paths_of, scene_of, synthesizer, tables_at,
};
use artifact::Accuracy;
use artifact::cube::CubeFrame;
use artifact::paths::Path;
use artifact::rcs::RcsFrame;
use artifact::scene::SceneHeader;
use artifact::units::db_from_amplitude;
use num_complex::Complex64;
use wayside::host::failure::Failure;

/// Requested accuracies of paths, that of the table, and that of the reference.
const ASKED_DB: [f64; 4] = [-10.0, -15.0, -20.0, -25.0];
const QUICK_DB: [f64; 1] = [-20.0];
const TABLE_DB: f64 = -20.0;
const FINE_DB: f64 = -30.0;
/// Number of parts of the frame that the reference traces separately; half as many show its convergence.
const PARTS: u32 = 4;

/// Both kinds of echo of a scene whose bodies are in a folder; none if a third-party file is missing.
pub(super) fn rows(
    scene: &Scene,
    folder: &std::path::Path,
    extent: Extent,
) -> Result<Vec<SettingRow>, Failure> {
    let Some(targets) = scene.targets(folder) else { return Ok(vec![]) };
    let case = Case { name: scene.name, header: scene_of(&targets)? };
    let exact = case.reference()?;
    let asked = match extent {
        Extent::Quick => &QUICK_DB[..],
        Extent::Full => &ASKED_DB[..],
    };
    let mut rows = vec![];
    for asked_db in asked {
        rows.extend(case.by_paths(*asked_db, &exact)?);
    }
    rows.extend(case.by_tables(&exact)?);
    Ok(rows)
}

/// A frame of the radar of experiment 1: 3 × 4 elements, 128 chirps of 256 samples.
struct Case {
    name: &'static str,
    header: SceneHeader,
}

/// Cube taken as true, with its method.
struct Reference {
    cube: CubeFrame,
    name: String,
}

impl Case {
    fn header_at(&self, accuracy_db: f64) -> SceneHeader {
        let mut header = self.header.clone();
        header.fidelity.accuracy = Accuracy::from_db(accuracy_db);
        header
    }

    fn reference(&self) -> Result<Reference, Failure> {
        let (coarse, fine) = (self.traced_in_parts(PARTS / 2)?, self.traced_in_parts(PARTS)?);
        let apart_db = db_from_amplitude(rcs_solvers::relative_error(&wide(&coarse), &wide(&fine)));
        let name = format!(
            "paths traced anew {PARTS} times in the frame, {FINE_DB} dB asked; {} times differ from it by \
             {apart_db:.1} dB",
            PARTS / 2
        );
        Ok(Reference { cube: fine, name })
    }

    /// The cube with the bodies traced anew at the middle of each part of the frame.
    fn traced_in_parts(&self, count: u32) -> Result<CubeFrame, Failure> {
        let whole = self.header_at(FINE_DB);
        let mut part = whole.clone();
        part.radar.waveform.chirps = whole.radar.waveform.chirps / count;
        let mut parts = Vec::new();
        for number in 0..count {
            let mut frame = frame_of(&part);
            let begin_s = f64::from(number) * part.radar.frame_duration_s();
            frame.poses = frame.poses.iter().map(|pose| radar::motion::pose_after(pose, begin_s)).collect();
            parts.push(cube_of(&part, &paths_at(&part, &frame)?)?);
        }
        let of_channel = part.radar.waveform.chirps as usize * part.radar.waveform.samples as usize;
        let channels = 0..whole.radar.cube_channels();
        let rows = channels
            .flat_map(|channel| parts.iter().map(move |p| &p.samples[channel * of_channel..][..of_channel]));
        let samples = rows.flatten().copied().collect();
        Ok(CubeFrame { samples, ..parts[0].clone() })
    }

    fn by_paths(&self, asked_db: f64, exact: &Reference) -> Result<[SettingRow; 2], Failure> {
        let header = self.header_at(asked_db);
        let paths = measured(|| paths_of(&header))?;
        let cube = measured(|| cube_of(&header, &paths.value))?;
        let count = paths.value.paths.len();
        let size = format!("{count} paths, {} kB", count * size_of::<Path>() / 1000);
        let made =
            FrameCube { way: "paths", asked_db, size, cost: paths.cost.and(cube.cost), cube: &cube.value };
        self.error_rows(&made, exact)
    }

    fn by_tables(&self, exact: &Reference) -> Result<[SettingRow; 2], Failure> {
        let header = self.header_at(TABLE_DB);
        let frame = frame_of(&header);
        let tables = measured(|| tables_at(&header, &frame))?;
        let cube = measured(|| {
            synthesizer(&header, header.seed)?
                .frame_of_tables(&frame.poses, &tables.value, &|_| ())
                .map_err(Failure::refused)
        })?;
        let size = size_of_tables(&tables.value);
        let cost = tables.cost.and(cube.cost);
        self.error_rows(&FrameCube { way: "table", asked_db: TABLE_DB, size, cost, cube: &cube.value }, exact)
    }

    /// Two rows: for the whole cube, and for the levels of its map, without phases.
    fn error_rows(&self, made: &FrameCube<'_>, exact: &Reference) -> Result<[SettingRow; 2], Failure> {
        let row = |of: &str, error| SettingRow {
            stage: "bart-rcs + fmcw-echo".into(),
            scene: self.name.into(),
            method: format!("frame by {}, {of}", made.way),
            setting: format!("{} dB asked", made.asked_db),
            cost: made.cost,
            error,
            reference: exact.name.clone(),
            size: made.size.clone(),
        };
        let whole = rcs_solvers::relative_error(&wide(made.cube), &wide(&exact.cube));
        let levels = rcs_solvers::relative_error(&self.levels(made.cube)?, &self.levels(&exact.cube)?);
        Ok([row("cube", whole), row("levels", levels)])
    }

    /// |X| of every cell of the range-Doppler map of every channel.
    fn levels(&self, cube: &CubeFrame) -> Result<Vec<Complex64>, Failure> {
        let receiver = dsp::Receiver::new(&cube_header(&self.header)).map_err(Failure::refused)?;
        let map = receiver.range_doppler(cube).map_err(Failure::refused)?;
        Ok(map.values.iter().map(|z| Complex64::from(f64::from(z.norm()))).collect())
    }
}

/// A cube, with the method and the settings that made it.
struct FrameCube<'a> {
    way: &'static str,
    asked_db: f64,
    size: String,
    cost: Cost,
    cube: &'a CubeFrame,
}

fn size_of_tables(frame: &RcsFrame) -> String {
    let axes =
        |t: &artifact::rcs::RcsTable| [t.frequency_hz.len(), t.elevation_rad.len(), t.azimuth_rad.len()];
    let [f, el, az] = frame.tables.first().map_or([0; 3], axes);
    let values: usize = frame.tables.iter().map(|table| table.amplitude_m.len()).sum();
    format!("{f} × {el} × {az} values, {} kB", values * size_of::<Complex64>() / 1000)
}

fn wide(cube: &CubeFrame) -> Vec<Complex64> {
    cube.samples.iter().map(|z| Complex64::new(z.re.into(), z.im.into())).collect()
}
