//! Samples of a real radar (`fixtures/captures`): our maps and points compared with NumPy's, the array's
//! coherence, the noise; and a simulation of the room, in which three points are known.

mod room;
mod simulated;

use crate::project::project_root;
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::pages::real_captures::room::{Echo, ProcessedFrame, cube_of_command};
use crate::study::sources::{SIGNALS, SourcePaths};
use artifact::cube::{CubeFrame, CubeHeader};
use std::path::Path;
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    SIGNALS,
    &[
        "fixtures/captures",
        "crates/formats/src/raw_data",
        "crates/formats/src/raw_data.rs",
        "xtask/src/study/pages/real_captures",
        "xtask/src/study/pages/real_captures.rs",
    ],
];

/// Makes the part; there is one frame, whatever the extent.
pub(crate) fn section(_: Extent) -> Result<PageSection, Failure> {
    let folder = project_root().join("fixtures/captures");
    let ours = ProcessedFrame::of(&imported(&folder)?)?;
    let echoes = echoes(&folder.join("room.numpy.csv"))?;
    let mut part = PageSection::default();
    table_of_echoes(&mut part, &ours, &echoes)?;
    simulated::rows(&mut part, &folder, &ours, &echoes)?;
    table_of_map(&mut part, &ours, &levels(&folder.join("room.numpy.npy"))?)?;
    let ProcessedFrame { header, map, detections, .. } = &ours;
    let near = detections.points.iter().filter(|p| p.range_m < header.dsp.nearest_m).count();
    part.line(format!(
        "\n{} cells above the threshold of {} tested, {} points ({near} nearer than `nearest_m`), {} objects.",
        map.detections,
        map.cells,
        detections.points.len(),
        detections.objects.len()
    ));
    Ok(part)
}

/// The recording as read by `import`.
fn imported(folder: &Path) -> Result<(CubeHeader, CubeFrame), Failure> {
    cube_of_command(&[
        "import".as_ref(),
        &folder.join("room.bin"),
        "--scene".as_ref(),
        &folder.join("room.toml"),
    ])
}

fn echoes(file: &Path) -> Result<Vec<Echo>, Failure> {
    let text = std::fs::read_to_string(file).map_err(|e| Failure::system(file, "read", e))?;
    let echo = |line: &str| {
        let (name, numbers) = line.split_once(',')?;
        let numbers: Vec<f64> = numbers.split(',').map(|n| n.parse().ok()).collect::<Option<_>>()?;
        let [range_m, velocity_mps, azimuth_deg, level_dbfs, coherence] = numbers.try_into().ok()?;
        Some(Echo { name: name.to_owned(), range_m, velocity_mps, azimuth_deg, level_dbfs, coherence })
    };
    Ok(text.lines().filter_map(echo).collect())
}

/// Levels of NumPy's map, `[doppler, range]`: the numbers after the head of a `.npy` of float32.
fn levels(file: &Path) -> Result<Vec<f64>, Failure> {
    let bytes = std::fs::read(file).map_err(|e| Failure::system(file, "read", e))?;
    let behind = bytes.iter().position(|byte| *byte == b'\n').map_or(bytes.len(), |end| end + 1);
    Ok(bytes[behind..].as_chunks::<4>().0.iter().map(|b| f64::from(f32::from_le_bytes(*b))).collect())
}

fn table_of_echoes(part: &mut PageSection, ours: &ProcessedFrame, echoes: &[Echo]) -> Result<(), Failure> {
    part.head(&[
        "echo",
        "",
        "range, m",
        "velocity, m/s",
        "azimuth, °",
        "cell, dBFS",
        "over noise, dB",
        "coherence",
    ]);
    for echo in echoes {
        part.row(&[
            echo.name.clone(),
            "NumPy, cell".into(),
            format!("{:.3}", echo.range_m),
            format!("{:.3}", echo.velocity_mps),
            format!("{:.2}", echo.azimuth_deg),
            format!("{:.2}", echo.level_dbfs),
            "–".into(),
            format!("{:.3}", echo.coherence),
        ]);
        part.row(&ours.row("ours, point", echo)?);
        if ours.point(echo).is_none() {
            part.complain(format!("{} has no point", echo.name));
        }
    }
    Ok(())
}

/// Largest difference: cells of our map differ by the single-precision rounding of the strongest, 1e-4 dB for
/// a cell within 60 dB of it, and NumPy's levels are stored to 8e-6 dB.
const WORST_DB: f64 = 1e-3;
const WITHIN_DB: f64 = 60.0;

fn table_of_map(part: &mut PageSection, ours: &ProcessedFrame, numpys: &[f64]) -> Result<(), Failure> {
    let (header, channels) = (&ours.header, ours.header.radar.map_channels());
    let power = dsp::power_map(header, &ours.map).map_err(Failure::refused)?;
    let levels: Vec<f64> = power.iter().map(|power| header.map_level_db(*power, channels)).collect();
    let strongest = numpys.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let compared: Vec<f64> = levels
        .iter()
        .zip(numpys)
        .filter(|(_, numpy)| **numpy > strongest - WITHIN_DB)
        .map(|(a, b)| (a - b).abs())
        .collect();
    let worst = compared.iter().copied().fold(0.0, f64::max);
    let noise = dsp::noise_power(header, &ours.map).map_err(Failure::refused)?;
    let floor_dbfs = header.map_level_db(noise, 1);
    // Each part of a sample is rounded to a step: a twelfth of its square, twice; a Hann window's noise
    // bandwidth is 1.5 cells.
    let gain = f64::from(header.radar.waveform.chirps) * f64::from(header.radar.waveform.samples);
    let rounding = 2.0 / 12.0 * 1.5 * 1.5 * gain;
    let rounding_dbfs = header.map_level_db(rounding, 1);
    part.line("");
    part.head(&["map", "figure"]);
    part.row(&[
        "cells compared, within 60 dB of the strongest".into(),
        format!("{} of {}", compared.len(), numpys.len()),
    ]);
    part.row(&["largest difference of a cell's level, dB".into(), format!("{worst:.1e}")]);
    part.row(&["noise of a cell, dBFS".into(), format!("{floor_dbfs:.1}")]);
    part.row(&["of rounding to 16 bits alone, dBFS".into(), format!("{rounding_dbfs:.1}")]);
    part.row(&["noise of a sample, steps".into(), format!("{:.2}", (noise / (1.5 * 1.5 * gain)).sqrt())]);
    part.row(&["strongest cell over noise, dB".into(), format!("{:.1}", strongest - floor_dbfs)]);
    if compared.len() < 100 || levels.len() != numpys.len() || worst > WORST_DB {
        part.complain(format!("a cell differs by {worst:.1e} dB from NumPy's, more than {WORST_DB:.0e}"));
    }
    Ok(())
}
