//! Paths as the table of `docs/interface.md`: positions at the frame's first sample, one row per
//! polarization.

use crate::export::delays::delay_at_middle;
use crate::sidecar;
use artifact::paths::{ArraySide, ArraySpan, Curve, Path as Record, Paths, PathsHeader, Span};
use artifact::{Radar, Reader};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use pipeline::host::safe_text::in_csv;
use serde_json::json;
use std::io::{Error, Write};
use std::path::Path;

const COLUMNS: &str = "frame,target,order,pol,re_m,im_m,dre_m_per_ghz,dim_m_per_ghz,ax_m,ay_m,az_m,bx_m,by_m,bz_m,\
avx_mps,avy_mps,avz_mps,bvx_mps,bvy_mps,bvz_mps,delay_s,delay_rate,facets,\
span_first_s,span_step_s,span_moments,span_moment,\
array_span_tx,array_span_rx,array_span_first_m,array_span_step_m,array_span_places,array_span_place,\
array_side_tx,array_side_rx,array_side_from_m";
const POLARIZATIONS: [(&str, usize, usize); 4] = [("vv", 0, 0), ("hh", 1, 1), ("vh", 0, 1), ("hv", 1, 0)];

/// Writes a row for each path of each frame.
pub fn csv(reader: Reader<Paths>, out: &Path) -> Result<(), Failure> {
    sidecar::claim(out)?;
    let header = reader.header().clone();
    files::write_with(out, |stream| {
        writeln!(stream, "{COLUMNS}")?;
        for frame in progress::frames(reader) {
            let frame = frame.map_err(Error::other)?;
            let radar = header.radar.in_frame(frame.index);
            frame.paths.iter().try_for_each(|path| rows(stream, (&header, &radar), frame.index, path))?;
        }
        sidecar::remove_outdated(out)
    })?;
    let axes = json!({ "f_c_hz": header.centre_frequency_hz, "positions_at": "the frame's first sample",
        "delay_at": "the frame's middle, from the array's centre",
        "facets": "body:triangle in the order of travel",
        "left_out": "accelerations, but for delay and rate; the turning of a wheel, whose hub is told (export to json has them)" });
    sidecar::write(out, &axes)
}

/// Rows of a path, one per polarization; `radar` is that of the frame's own sub-frame.
fn rows(
    sink: &mut dyn Write,
    (header, radar): (&PathsHeader, &Radar),
    frame: u32,
    path: &Record,
) -> std::io::Result<()> {
    let target = in_csv(header.targets.get(path.target as usize).map_or("", String::as_str));
    let (delay_s, rate) = delay_at_middle(radar, path);
    let geometry: Vec<String> =
        [path.apparent_tx_m, path.apparent_rx_m, path.apparent_tx_mps, path.apparent_rx_mps]
            .concat()
            .iter()
            .map(f64::to_string)
            .collect();
    let facets: Vec<String> = path.sequence().iter().map(|f| format!("{}:{}", f.body, f.triangle)).collect();
    let (geometry, facets, order, span) = (geometry.join(","), facets.join(" "), path.order, span(path));
    for (name, receive, transmit) in POLARIZATIONS {
        let (a, slope) = (path.amplitude_m[receive][transmit], path.slope_m_per_hz[receive][transmit] * 1e9);
        let amplitude = format!("{},{},{},{}", a.re, a.im, slope.re, slope.im);
        writeln!(
            sink,
            "{frame},{target},{order},{name},{amplitude},{geometry},{delay_s},{rate},{facets},{span}"
        )?;
    }
    Ok(())
}

/// The part of the frame and of the array that a path represents; empty if it is all of them.
fn span(path: &Record) -> String {
    let of_time = |span: Span| format!("{},{},{},{}", span.first_s, span.step_s, span.moments, span.moment);
    let vector = |[x, y, z]: [f64; 3]| format!("{x} {y} {z}");
    let of_array = |span: ArraySpan| {
        let ArraySpan { transmit, receive, first_m, step_m, places, place } = span;
        format!("{},{},{first_m},{step_m},{places},{place}", vector(transmit), vector(receive))
    };
    let of_side =
        |side: ArraySide| format!("{},{},{}", vector(side.transmit), vector(side.receive), side.from_m);
    let Curve { span, array_span, array_side, .. } = path.curve;
    let of_span = span.map_or(",,,".into(), of_time);
    let of_place = array_span.map_or(",,,,,".into(), of_array);
    format!("{of_span},{of_place},{}", array_side.map_or(",,".into(), of_side))
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::paths::PathsFrame;
    use artifact::units::SPEED_OF_LIGHT_MPS;
    use artifact::{Provenance, Writer};
    use radar::aperture::Preset;
    use radar::paper;

    /// A point 30 m ahead that comes nearer at 20 m/s.
    fn record() -> Record {
        Record::of_point([0.0, 30.0, 0.0], [0.0, -20.0, 0.0], Default::default())
    }

    fn frame(index: u32) -> PathsFrame {
        PathsFrame {
            index,
            time_s: 0.1 * f64::from(index),
            paths: vec![record()],
            nearest_range_m: vec![None],
            ..PathsFrame::default()
        }
    }

    #[test]
    fn delays_are_those_of_the_middle_of_their_own_sub_frame() {
        let mut radar = paper::radar([0.0; 3], paper::waveform(64, 32), Preset::OneByOne.elements());
        radar.schedule.sub_frame_intervals_s = vec![20e-6, 60e-6];
        let centre_frequency_hz = radar.waveform.centre_frequency_hz();
        let header = PathsHeader { radar, centre_frequency_hz, targets: vec!["p".to_owned()] };
        let folder = tempfile::tempdir().unwrap();
        let [file, table] = ["f.paths", "f.csv"].map(|name| folder.path().join(name));
        let mut writer = Writer::<Paths>::create(&file, &Provenance::default(), &header).unwrap();
        for index in 0..4 {
            writer.write(&frame(index)).unwrap();
        }
        writer.finish().unwrap();
        csv(Reader::open(&file).unwrap(), &table).unwrap();
        let text = std::fs::read_to_string(&table).unwrap();
        let column = COLUMNS.split(',').position(|name| name == "delay_s").unwrap();
        let delays = text.lines().filter(|line| line.contains(",vv,"));
        let delays: Vec<f64> =
            delays.map(|line| line.split(',').nth(column).unwrap().parse().unwrap()).collect();
        assert_eq!(delays.len(), 4);
        for (delay_s, interval_s) in delays.into_iter().zip([20e-6, 60e-6, 20e-6, 60e-6]) {
            let range_m = 30.0 - 20.0 * 16.0 * interval_s;
            let error_m = 0.5 * delay_s * SPEED_OF_LIGHT_MPS - range_m;
            assert!(error_m.abs() < 1e-9, "{interval_s}: {error_m}");
        }
    }
}
