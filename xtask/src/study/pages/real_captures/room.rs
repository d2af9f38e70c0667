//! A frame of the room: the places of its echoes, and this project's results for it.

use crate::project::this_program;
use artifact::Reader;
use artifact::cube::{Cube, CubeFrame, CubeHeader, SampleUnit};
use artifact::points::{Point, PointsFrame};
use artifact::rdm::RdmFrame;
use dsp::Receiver;
use dsp::angle::VirtualArray;
use std::path::Path;
use std::process::{Command, Stdio};
use wayside::host::failure::Failure;

/// The first frame of the cube made by a command of this program.
pub(super) fn cube_of_command(words: &[&Path]) -> Result<(CubeHeader, CubeFrame), Failure> {
    let place = tempfile::tempdir().map_err(|e| Failure::System(format!("a folder for the cube: {e}")))?;
    let cube = place.path().join("room.cube");
    let this = this_program()?;
    let mut command = Command::new(this);
    command.args(words).arg("--out").arg(&cube).arg("--quiet").stdin(Stdio::null()).stdout(Stdio::null());
    let status = command.status().map_err(|e| Failure::System(format!("{words:?}: {e}")))?;
    if !status.success() {
        return Err(Failure::Refused(format!("{words:?}: {status}")));
    }
    let mut reader = Reader::<Cube>::open(&cube)?;
    let header = reader.header().clone();
    let frame = reader.next_frame()?.ok_or_else(|| Failure::Refused("the cube holds no frame".into()))?;
    Ok((header, frame))
}

/// An echo at NumPy's strongest cell.
pub(super) struct Echo {
    pub(super) name: String,
    pub(super) range_m: f64,
    pub(super) velocity_mps: f64,
    pub(super) azimuth_deg: f64,
    pub(super) level_dbfs: f64,
    pub(super) coherence: f64,
}

/// This project's results for the frame.
pub(super) struct ProcessedFrame {
    pub(super) header: CubeHeader,
    pub(super) map: RdmFrame,
    array: VirtualArray,
    pub(super) detections: PointsFrame,
}

impl ProcessedFrame {
    /// Map and points of a frame.
    pub(super) fn of((header, frame): &(CubeHeader, CubeFrame)) -> Result<Self, Failure> {
        let receiver = Receiver::new(header).map_err(Failure::refused)?;
        let (map, detections) = receiver.process(frame).map_err(Failure::refused)?;
        Ok(Self { header: header.clone(), map, array: VirtualArray::new(header), detections })
    }

    /// Row and column of the cell in which an echo is strongest.
    pub(super) fn cell(&self, echo: &Echo) -> [usize; 2] {
        let nearest = |axis: &[f64], at: f64| {
            let apart = |i: &usize| (axis[*i] - at).abs();
            (0..axis.len()).min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(0)
        };
        let velocities = dsp::velocity_axis_mps(&self.header);
        [nearest(&velocities, echo.velocity_mps), nearest(&dsp::range_axis_m(&self.header), echo.range_m)]
    }

    /// Level of a cell, dBFS.
    pub(super) fn level_dbfs(&self, [row, column]: [usize; 2]) -> Result<f64, Failure> {
        let power = dsp::power_map(&self.header, &self.map).map_err(Failure::refused)?[[row, column]];
        Ok(self.header.map_level_db(power, self.header.radar.map_channels()))
    }

    /// Text of the level of an echo's cell, dBFS, if the samples are a converter's.
    pub(super) fn level_text(&self, echo: &Echo) -> Result<String, Failure> {
        match self.header.unit {
            SampleUnit::FullScale(_) => Ok(format!("{:.2}", self.level_dbfs(self.cell(echo))?)),
            SampleUnit::RootWatts | SampleUnit::Steps => Ok("–".into()),
        }
    }

    /// Power of the strongest beam relative to that of all channels in phase.
    pub(super) fn coherence(&self, echo: &Echo) -> f64 {
        let snapshot = self.array.snapshot(&self.map, self.cell(echo), echo.velocity_mps);
        let direction = self.array.direction(std::slice::from_ref(&snapshot), echo.range_m);
        let steering = self.array.steering(direction, echo.range_m);
        let sum: f64 = snapshot.iter().map(|value| value.norm_sqr()).sum();
        self.array.beam(&snapshot, &steering).norm_sqr() / (snapshot.len() as f64 * sum)
    }

    /// The strongest point within a cell of an echo.
    pub(super) fn point(&self, echo: &Echo) -> Option<&Point> {
        let radar = &self.header.radar;
        let cells = [radar.waveform.range_resolution_m(), radar.velocity_resolution_mps()];
        let is_near = |p: &&Point| {
            (p.range_m - echo.range_m).abs() < cells[0]
                && (p.radial_velocity_mps - echo.velocity_mps).abs() < cells[1]
        };
        self.detections.points.iter().filter(is_near).max_by(|a, b| a.snr_db.total_cmp(&b.snr_db))
    }

    /// Row of the table of echoes: the point, its cell and its coherence.
    pub(super) fn row(&self, of: &str, echo: &Echo) -> Result<[String; 8], Failure> {
        let point = self.point(echo);
        let told = |of: fn(&Point) -> f64, digits: usize| {
            point.map_or_else(|| "–".to_owned(), |point| format!("{:.digits$}", of(point)))
        };
        Ok([
            String::new(),
            of.to_owned(),
            told(|p| p.range_m, 3),
            told(|p| p.radial_velocity_mps, 3),
            told(|p| p.azimuth_rad.to_degrees(), 2),
            self.level_text(echo)?,
            told(|p| p.snr_db, 1),
            format!("{:.3}", self.coherence(echo)),
        ])
    }
}
