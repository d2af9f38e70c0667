//! Tracks as a table: one row per live track in a frame.

use artifact::Reader;
use artifact::tracks::{Track, Tracks};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use std::io::{Error, Write};
use std::path::Path;

const COLUMNS: &str = "frame,time_s,track,state,age_frames,missed_frames,x_m,y_m,vx_mps,vy_mps,sd_x_m,sd_y_m,sd_vx_mps,\
sd_vy_mps,velocity_resolved,lane,box_x_m,box_y_m,box_length_m,box_width_m,box_heading_deg,objects";

/// Writes a row for each track of each frame.
pub fn csv(reader: Reader<Tracks>, out: &Path) -> Result<(), Failure> {
    files::write_with(out, |stream| {
        writeln!(stream, "{COLUMNS}")?;
        for frame in progress::frames(reader) {
            let frame = frame.map_err(Error::other)?;
            for track in &frame.tracks {
                writeln!(stream, "{},{},{}", frame.index, frame.time_s, row(track))?;
            }
        }
        Ok(())
    })
}

fn row(track: &Track) -> String {
    let ([x, y], [vx, vy]) = (track.position_m, track.velocity_mps);
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| track.covariance[i][i].max(0.0).sqrt());
    let lane = track.lane.map_or_else(String::new, |lane| lane.to_string());
    let footprint = &track.footprint;
    let ([box_x, box_y], heading) = (footprint.centre_m, footprint.heading_rad.to_degrees());
    let objects: Vec<String> = track.objects.iter().map(u32::to_string).collect();
    format!(
        "{},{},{},{},{x},{y},{vx},{vy},{a},{b},{c},{d},{},{lane},{box_x},{box_y},{},{},{heading},{}",
        track.id,
        track.state.name(),
        track.age_frames,
        track.missed_frames,
        track.velocity_resolved,
        footprint.length_m,
        footprint.width_m,
        objects.join(" ")
    )
}
