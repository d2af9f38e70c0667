//! Simulation of the same room: a point at the place of each echo, with the measured signal-to-noise ratio.
//!
//! Places, velocities and levels over noise are inputs; the rows verify that they are recovered, with all
//! channels in phase, and the line below shows the difference between the room and a few points.

use crate::study::pages::page_section::PageSection;
use crate::study::pages::real_captures::room::{Echo, ProcessedFrame, cube_of_command};
use artifact::points::Point;
use std::fmt::Write;
use std::path::Path;
use wayside::host::failure::Failure;

/// Adds a row for each echo and a line with the required settings.
pub(super) fn rows(
    part: &mut PageSection,
    folder: &Path,
    measured: &ProcessedFrame,
    echoes: &[Echo],
) -> Result<(), Failure> {
    let seen: Vec<&Point> = echoes.iter().filter_map(|echo| measured.point(echo)).collect();
    let of_a_square_metre = levels(&simulated(folder, &seen, &vec![0.0; seen.len()])?, echoes)?;
    let needed: Vec<f64> = seen.iter().zip(&of_a_square_metre).map(|(point, db)| point.snr_db - db).collect();
    let room = simulated(folder, &seen, &needed)?;
    for echo in echoes {
        part.row(&room.row(&format!("simulated, {}", echo.name), echo)?);
    }
    let sections: Vec<String> = needed.iter().map(|dbsm| format!("{dbsm:.1}")).collect();
    part.line(format!(
        "\nSimulated, {} dBsm: {} cells above the threshold, {} points, {} objects.",
        sections.join(", "),
        room.map.detections,
        room.detections.points.len(),
        room.detections.objects.len()
    ));
    Ok(())
}

/// Level over noise of the strongest point at each echo.
fn levels(room: &ProcessedFrame, echoes: &[Echo]) -> Result<Vec<f64>, Failure> {
    let level = |echo: &Echo| room.point(echo).map(|point| point.snr_db);
    let all: Option<Vec<f64>> = echoes.iter().map(level).collect();
    all.ok_or_else(|| Failure::Refused("an echo of the simulated room has no point".into()))
}

/// A frame of points at the measured places, with these cross sections.
fn simulated(folder: &Path, points: &[&Point], sections_dbsm: &[f64]) -> Result<ProcessedFrame, Failure> {
    let scene = folder.join("room.toml");
    let radar = std::fs::read_to_string(&scene).map_err(|e| Failure::system(&scene, "read", e))?;
    let mut text = radar.replace("name = \"room\"", "name = \"room-simulated\"");
    for (number, (point, dbsm)) in points.iter().zip(sections_dbsm).enumerate() {
        text += &target(number, point, *dbsm);
    }
    let place = tempfile::tempdir().map_err(|e| Failure::System(format!("a folder for the scene: {e}")))?;
    let file = place.path().join("room-simulated.toml");
    std::fs::write(&file, text).map_err(|e| Failure::system(&file, "write", e))?;
    ProcessedFrame::of(&cube_of_command(&["echo".as_ref(), &file])?)
}

/// A point target at the radar's height.
fn target(number: usize, point: &Point, dbsm: f64) -> String {
    let (sin, cos) = point.azimuth_rad.sin_cos();
    let (range_m, speed_mps) = (point.range_m, point.radial_velocity_mps);
    let mut text = format!("\n[[target]]\nkind = \"point\"\nid = \"echo-{number}\"\n");
    let [x, y] = [range_m * sin, range_m * cos];
    let _ = writeln!(text, "position_m = [{x:.6}, {y:.6}, 0.75]");
    let _ = writeln!(text, "velocity_mps = [{:.6}, {:.6}, 0.0]", speed_mps * sin, speed_mps * cos);
    let _ = writeln!(text, "rcs_m2 = {:.9}", 10_f64.powf(0.1 * dbsm));
    text
}
