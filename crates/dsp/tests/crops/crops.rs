//! Crops and grayscale pictures.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::dataset::Crop;
use artifact::rdm::RdmFrame;
use dsp::{DspError, PAPER_CROP, Receiver, noise_power, rdm_grayscale};

fn seen(header: &CubeHeader, targets: &[Target]) -> (RdmFrame, Crop) {
    let receiver = Receiver::new(header).unwrap();
    let map = receiver.range_doppler(&cube(header, targets, 1)).unwrap();
    let objects = receiver.detect(&map).unwrap().objects;
    assert_eq!(objects.len(), 1, "{objects:?}");
    let crop = cropped(header, &map, &objects[0], &PAPER_CROP).unwrap();
    (map, crop)
}

#[test]
fn a_stronger_neighbour_is_left_out_of_a_crop_and_the_rest_of_it_stays() {
    let header = noisy();
    let weak = target([5.75, 38.3, 0.75], [0.0, -6.1, 0.0], 10.0);
    let strong = target([2.0, 42.0, 0.75], [0.0, -8.5, 0.0], 1000.0);
    let (_, alone) = seen(&header, &[weak]);
    let receiver = Receiver::new(&header).unwrap();
    let map = receiver.range_doppler(&cube(&header, &[weak, strong], 1)).unwrap();
    let points = receiver.detect(&map).unwrap();
    assert_eq!(points.objects.len(), 2);
    let own = points
        .objects
        .iter()
        .position(|o| o.snr_db == points.objects.iter().map(|o| o.snr_db).fold(f64::MAX, f64::min));
    let own = own.unwrap() as u32;
    let cropper = receiver.cropper(&map, &PAPER_CROP).unwrap();
    let with_it = cropper.crop(&points.objects[own as usize]).unwrap();
    let among = cropper.crop_among(&points, own).unwrap();
    let [(row, column, level), (other_row, _, other), (own_row, own_column, own_level)] =
        [&alone, &with_it, &among].map(brightest);
    assert!(
        other > level + 20 && (other_row - row).abs() > 60.0,
        "the neighbour is not seen: {other} {level}"
    );
    assert!(
        (own_row - row).abs() <= 1.0 && (own_column - column).abs() <= 1.0 && own_level.abs_diff(level) <= 1
    );
    // A velocity resolution and a half is 20 rows here: so far around its own peak the crop is as it was.
    let near =
        |i: &usize| ((i / 451) as f64 - own_row).abs() < 20.0 && ((i % 451) as f64 - own_column).abs() < 8.0;
    assert!((0..451 * 451).filter(near).all(|i| among.pixels[i] == with_it.pixels[i]));
    assert_eq!(cropper.crop_among(&points, 2), Err(DspError::NoSuchObject { object: 2 }));
}

fn noisy() -> CubeHeader {
    let mut header = header(256, 128, elements_3x4());
    header.noise = NOISE_12_DB;
    header
}

/// Row, column and level of the brightest pixel, the mean place of all that share it.
fn brightest(crop: &Crop) -> (f64, f64, u8) {
    let top = *crop.pixels.iter().max().unwrap();
    let places: Vec<usize> = (0..crop.pixels.len()).filter(|i| crop.pixels[*i] == top).collect();
    let mean = |f: fn(usize) -> usize| places.iter().map(|i| f(*i) as f64).sum::<f64>() / places.len() as f64;
    (mean(|i| i / 451), mean(|i| i % 451), top)
}

#[test]
fn a_point_stands_in_the_middle_of_its_crop_at_its_level_over_the_noise() {
    let header = noisy();
    let target = target([5.75, 38.3, 0.75], [0.0, -6.1, 0.0], 10.0);
    let (_, crop) = seen(&header, &[target]);
    assert_eq!(crop.pixels.len(), 451 * 451);
    let (row, column, level) = brightest(&crop);
    // Interpolated between cells: half a cell is 7 rows (0.2525 m/s of 8) and 2.3 columns (0.24 m of 24).
    assert!((row - 225.0).abs() < 8.0 && (column - 225.0).abs() < 3.0, "{row}, {column}");
    // S6: 36.7 dB at 40 m less 3.5 dB of windows plus 10.8 dB of twelve channels; scalloping up to 2.8 dB,
    // 0.27 dB a grey level.
    let level_db = f64::from(level) * 70.0 / 255.0;
    assert!((40.5..45.0).contains(&level_db), "{level_db}");
    assert!((crop.range_m - truth(&header, &target).0).abs() < 0.02);
    assert!((crop.radial_velocity_mps - truth(&header, &target).1).abs() < 5e-3);
}

#[test]
fn a_tenfold_echo_is_ten_db_brighter() {
    let header = noisy();
    let level = |rcs_m2| {
        f64::from(brightest(&seen(&header, &[target([5.75, 30.3, 0.75], [0.0, -6.1, 0.0], rcs_m2)]).1).2)
    };
    // Two roundings to a grey level.
    assert!((level(100.0) - level(10.0) - 10.0 * 255.0 / 70.0).abs() <= 1.0);
}

#[test]
fn farther_is_to_the_right_and_receding_is_down() {
    let header = noisy();
    let pair = [
        target([5.75, 30.0, 0.75], [0.0, -6.0, 0.0], 100.0),
        target([5.75, 32.0, 0.75], [0.0, -5.3, 0.0], 10.0),
    ];
    let (_, crop) = seen(&header, &pair);
    // The stronger stands in the middle, so the weaker stands in the quarter down and right of it, 38 columns
    // and 39 rows away, and the quarter up and left holds noise alone beyond the main lobe (2 cells: 9
    // columns, 29 rows).
    let brightest = |rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
        rows.flat_map(|row| crop.pixels[row * 451..][columns.clone()].iter().copied()).max().unwrap()
    };
    let (weaker, noise) = (brightest(255..290, 250..275), brightest(160..195, 175..200));
    // 6 dB of the 45 dB between them would do to tell a mirrored crop.
    assert!(weaker > noise + 22, "{weaker} against {noise}");
}

#[test]
fn crops_at_the_maps_edges_are_black_outside_and_wrap_in_velocity() {
    let header = noisy();
    let seam = header.radar.velocity_max_mps();
    let (_, crop) = seen(&header, &[target([0.0, 5.0, 6.0], [0.0, seam - 0.1, 0.0], 1.0)]);
    // 7 m of the 12 m on the left lie before range 0, 131 columns; half a cell may still be interpolated.
    assert!((0..451).all(|row| crop.pixels[row * 451..][..125].iter().all(|p| *p == 0)));
    // 4 m/s below the middle is beyond the seam; a white noise floor has pixels above its mean there too.
    let beyond = (300..451)
        .map(|row| crop.pixels[row * 451 + 150..][..300].iter().filter(|p| **p > 0).count())
        .sum::<usize>();
    assert!(beyond > 10_000, "{beyond} grey pixels beyond the seam");
    let (row, column, _) = brightest(&crop);
    assert!((row - 225.0).abs() < 8.0 && (column - 225.0).abs() < 3.0, "{row}, {column}");
}

#[test]
fn a_crop_wider_than_the_velocity_axis_repeats_it() {
    let mut header = noisy();
    header.radar.waveform.chirp_interval_s = 600e-6;
    assert!(4.0 * header.radar.velocity_max_mps() < PAPER_CROP.velocity_span_mps);
    let (_, crop) = seen(&header, &[target([0.0, 30.0, 6.0], [0.0, 0.0, 0.0], 10.0)]);
    let period = (451.0 * 2.0 * header.radar.velocity_max_mps() / 8.0).round() as usize;
    assert!(crop.pixels[(225 - period) * 451 + 225].abs_diff(crop.pixels[225 * 451 + 225]) < 20);
}

#[test]
fn formats_and_objects_that_make_no_picture_are_refused() {
    let header = noisy();
    let map = Receiver::new(&header)
        .unwrap()
        .range_doppler(&cube(&header, &[target([0.0, 30.0, 6.0], [0.0, 0.0, 0.0], 10.0)], 1))
        .unwrap();
    let receiver = Receiver::new(&header).unwrap();
    let mut object = receiver.detect(&map).unwrap().objects[0];
    let mut formats = [PAPER_CROP; 7];
    formats[0].side = 0;
    formats[1].range_span_m = -1.0;
    formats[2].velocity_span_mps = f64::NAN;
    formats[3].ceiling_db = formats[3].floor_db;
    formats[4].side = u32::MAX;
    formats[5].velocity_span_mps = 1e9;
    formats[6].velocity_span_mps = 1e300;
    for format in formats {
        assert_eq!(cropped(&header, &map, &object, &format), Err(DspError::CropFormat));
    }
    object.range_m = f64::NAN;
    assert_eq!(
        cropped(&header, &map, &object, &PAPER_CROP),
        Err(DspError::ObjectNotFinite { quantity: "range_m" })
    );
}

#[test]
fn an_object_far_outside_the_map_gives_a_black_crop() {
    let header = noisy();
    let map = Receiver::new(&header)
        .unwrap()
        .range_doppler(&cube(&header, &[target([0.0, 30.0, 6.0], [0.0, 0.0, 0.0], 10.0)], 1))
        .unwrap();
    let receiver = Receiver::new(&header).unwrap();
    let mut object = receiver.detect(&map).unwrap().objects[0];
    for range_m in [-1e9, 1e3, 1e300] {
        object.range_m = range_m;
        assert!(cropped(&header, &map, &object, &PAPER_CROP).unwrap().pixels.iter().all(|p| *p == 0));
    }
}

#[test]
fn the_grayscale_map_is_451_square_with_zero_velocity_in_the_middle() {
    let header = noisy();
    let map = Receiver::new(&header)
        .unwrap()
        .range_doppler(&cube(&header, &[target([0.0, 30.0, 6.0], [0.0, 0.0, 0.0], 10.0)], 1))
        .unwrap();
    let picture = rdm_grayscale(&header, &map).unwrap();
    assert_eq!(picture.len(), 451 * 451);
    let peak = (0..picture.len()).max_by_key(|i| picture[*i]).unwrap();
    // Cell 64 of 128, 30/0.24 = 125 of 256; a cell is 3.5 × 1.8 pixels.
    assert!((peak / 451).abs_diff(451 * 129 / 256) <= 3 && (peak % 451).abs_diff(451 * 251 / 512) <= 2);
    let level_db = f64::from(picture[peak]) * 70.0 / 255.0;
    let noise = noise_power(&header, &map).unwrap();
    assert!(noise > 0.0 && (30.0..45.0).contains(&level_db), "{level_db}");
}
