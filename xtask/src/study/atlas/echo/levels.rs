//! Levels at the limits of single precision, and converters with too small a range.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::documented;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::scenes::{cube_header, cube_of, detect, paths_of, scene_of, with_point};
use artifact::radar::Adc;
use artifact::scene::SceneHeader;
use wayside::host::failure::Failure;

/// Range of a single point with the strongest and the weakest echo that the keys allow.
pub(in crate::study::atlas) fn extremes(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MAP
        .trial("levels at the limits of the keys: range of a lone point", "power_dbm, gain_dbi, rcs_m2");
    let row = |(power_dbm, gain_dbi, rcs_m2): (f64, f64, f64)| {
        let words = format!(
            "[radar.array]\npreset = \"1x4\"\n[radar.link]\ntransmit_power_dbm = {power_dbm:?}\n\
             antenna_gain_dbi = {gain_dbi:?}\n"
        );
        let header = with_point(scene_of(&words)?, rcs_m2, [0.0, 30.0, 6.0], [0.0, -5.0, 0.0]);
        let name = format!("{power_dbm}, {gain_dbi}, {rcs_m2:e}");
        let points = match detect(&header) {
            Ok(found) => found.points,
            Err(refusal) => return Ok(trial.must_refuse::<(), _>(name, Err(refusal))),
        };
        let error = points.objects.first().map_or(1.0, |o| (o.range_m / 30.0 - 1.0).abs());
        Ok(trial.answered(name, error, ErrorStatement::Missing))
    };
    [(12.0, 10.0, 1.0), (200.0, 100.0, 1e12), (-200.0, -100.0, 1.0), (-200.0, -100.0, 1e-12)]
        .into_iter()
        .map(row)
        .collect()
}

fn with_converter(bits: u8, over_db: f64) -> Result<SceneHeader, Failure> {
    let header = scene_of("[radar.array]\npreset = \"1x1\"\n")?;
    let mut header = with_point(header, 10.0, [0.0, 30.0, 6.0], [0.0, -5.0, 0.0]);
    let cube = cube_of(&header, &paths_of(&header)?)?;
    let most = cube.samples.iter().map(|z| z.norm()).fold(0.0, f32::max);
    header.radar.hardware.adc =
        Some(Adc { bits, full_scale: f64::from(most) * 10_f64.powf(-over_db / 20.0) });
    Ok(header)
}

/// The strongest value of a scene's map.
fn peak(header: &SceneHeader) -> Result<f64, Failure> {
    let receiver = dsp::Receiver::new(&cube_header(header)).map_err(Failure::refused)?;
    let cube = cube_of(header, &paths_of(header)?)?;
    let map = receiver.range_doppler(&cube).map_err(Failure::refused)?;
    Ok(map.values.iter().map(|z| f64::from(z.norm())).fold(0.0, f64::max))
}

/// Level of a single echo within a converter's range, and beyond it.
pub(in crate::study::atlas) fn saturated(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::ADC.trial("level of an echo beyond the converter's full scale", "bits, dB beyond");
    let statement = documented("docs/scenes.md", "beyond it samples are clipped")?;
    let row = |(bits, over_db): (u8, f64)| {
        let header = with_converter(bits, over_db)?;
        let mut ideal = header.clone();
        ideal.radar.hardware.adc = None;
        let error = (peak(&header)? / peak(&ideal)? - 1.0).abs();
        Ok(trial.answered(format!("{bits}, {over_db}"), error, statement))
    };
    [(12, -6.0), (12, 0.0), (12, 3.0), (12, 20.0), (12, 60.0), (1, 0.0)].into_iter().map(row).collect()
}
