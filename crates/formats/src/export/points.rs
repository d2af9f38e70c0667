//! Points as tables and clouds.

use artifact::Reader;
use artifact::points::{Height, Label, Point, Points, PointsFrame, PointsHeader};
use artifact::settings::Class;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use pipeline::host::safe_text::in_csv;
use std::io::{Error, Write};
use std::path::Path;

const COLUMNS: &str = "frame,time_s,range_m,radial_velocity_mps,az_deg,el_deg,x_m,y_m,z_m,snr_db,object,target,\
true_target,true_class,true_order,true_share,two_ways_az_deg,true_bodies,ghost_share,stationary,height";

/// Writes a row for each point of each frame.
pub fn csv(reader: Reader<Points>, out: &Path) -> Result<(), Failure> {
    let header = reader.header().clone();
    files::write_with(out, |stream| {
        writeln!(stream, "{COLUMNS}")?;
        for frame in progress::frames(reader) {
            write_csv(stream, &frame.map_err(Error::other)?, &header)?;
        }
        Ok(())
    })
}

/// Rows of one frame.
pub(crate) fn write_csv(
    sink: &mut dyn Write,
    frame: &PointsFrame,
    header: &PointsHeader,
) -> std::io::Result<()> {
    for p in &frame.points {
        let object = p.object.map_or_else(String::new, |o| o.to_string());
        let of_object = p.object.and_then(|object| frame.objects.get(object as usize));
        let ghost = of_object.and_then(|object| object.ghost_share);
        let ghost = ghost.map_or_else(String::new, |share| format!("{share:.4}"));
        let target = p.target.and_then(|t| header.targets.get(t as usize)).map_or("", String::as_str);
        let target = in_csv(target);
        let label = p.label.map_or_else(|| ",,,".into(), |label| label_text(&label, header));
        let [x, y, z] = p.position_m;
        let (az, el) = (p.azimuth_rad.to_degrees(), p.elevation_rad.to_degrees());
        let (frame, time, range, velocity) = (frame.index, frame.time_s, p.range_m, p.radial_velocity_mps);
        let snr = p.snr_db;
        let ways = p
            .two_ways_rad
            .map_or_else(String::new, |[a, b]| format!("{} {}", a.to_degrees(), b.to_degrees()));
        let bodies = p.label.map_or_else(String::new, |label| label.bodies.to_string());
        let rest = p.stationary.map_or("", |rest| if rest { "yes" } else { "no" });
        let height = p.height.name();
        writeln!(
            sink,
            "{frame},{time},{range},{velocity},{az},{el},{x},{y},{z},{snr},{object},{target},{label},{ways},{bodies},{ghost},{rest},{height}"
        )?;
    }
    Ok(())
}

/// Target, class, order and share.
fn label_text(label: &Label, header: &PointsHeader) -> String {
    let at = label.target as usize;
    let target = in_csv(header.targets.get(at).map_or("", String::as_str));
    let class = header.classes.get(at).copied().flatten().map_or("", Class::name);
    format!("{target},{class},{},{:.4}", label.order, label.share)
}

/// Point Cloud Data file, version 0.7, ASCII, all frames.
pub fn pcd(reader: Reader<Points>, out: &Path) -> Result<(), Failure> {
    let rows = rows(reader)?;
    let n = rows.len();
    files::write_with(out, |s| {
        writeln!(
            s,
            "VERSION .7\nFIELDS x y z velocity snr frame object height_measured\nSIZE 4 4 4 4 4 4 4 1"
        )?;
        writeln!(s, "TYPE F F F F F U I U\nCOUNT 1 1 1 1 1 1 1 1\nWIDTH {n}\nHEIGHT 1")?;
        writeln!(s, "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {n}\nDATA ascii")?;
        rows.iter().try_for_each(|row| writeln!(s, "{row}"))
    })
}

/// Stanford polygon file, ASCII, all frames.
pub fn ply(reader: Reader<Points>, out: &Path) -> Result<(), Failure> {
    let rows = rows(reader)?;
    files::write_with(out, |s| {
        writeln!(s, "ply\nformat ascii 1.0\nelement vertex {}", rows.len())?;
        writeln!(s, "property float x\nproperty float y\nproperty float z\nproperty float velocity")?;
        writeln!(s, "property float snr\nproperty uint frame\nproperty int object")?;
        writeln!(s, "property uchar height_measured\nend_header")?;
        rows.iter().try_for_each(|row| writeln!(s, "{row}"))
    })
}

fn rows(reader: Reader<Points>) -> Result<Vec<String>, Failure> {
    let mut rows = Vec::new();
    for frame in progress::frames(reader) {
        let frame = frame?;
        rows.extend(frame.points.iter().map(|p| row(frame.index, p)));
    }
    Ok(rows)
}

/// Row of a point; the last number is 1 if z is measured, 0 if it is assumed or the radar's own.
fn row(frame: u32, p: &Point) -> String {
    let [x, y, z] = p.position_m;
    let object = p.object.map_or(-1, i64::from);
    let (velocity, snr, measured) = (p.radial_velocity_mps, p.snr_db, u8::from(p.height == Height::Measured));
    format!("{x:.4} {y:.4} {z:.4} {velocity:.4} {snr:.2} {frame} {object} {measured}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ids of recorded traffic are anybody's words.
    #[test]
    fn an_id_with_a_comma_stays_one_cell() {
        let header = PointsHeader { targets: vec!["east,\"7\"".to_owned()], ..PointsHeader::default() };
        let label = Label { target: 0, order: 1, bodies: 1, share: 1.0 };
        assert_eq!(label_text(&label, &header), "\"east,\"\"7\"\"\",,1,1.0000");
        let place = [0.0, 30.0, 0.0];
        let point = Point {
            range_m: 30.0,
            radial_velocity_mps: 0.0,
            azimuth_rad: 0.0,
            elevation_rad: 0.0,
            height: Height::Measured,
            position_m: place,
            snr_db: 20.0,
            two_ways_rad: None,
            stationary: None,
            object: None,
            target: Some(0),
            label: Some(label),
        };
        let frame = PointsFrame { index: 0, time_s: 0.0, points: vec![point], objects: vec![] };
        let mut row = vec![];
        write_csv(&mut row, &frame, &header).unwrap();
        let row = String::from_utf8(row).unwrap();
        let cells = row.replace("\"east,\"\"7\"\"\"", "id");
        assert_eq!(cells.split(',').count(), COLUMNS.split(',').count(), "{row}");
        assert_eq!(cells.split(',').filter(|cell| *cell == "id").count(), 2, "{row}");
    }
}
