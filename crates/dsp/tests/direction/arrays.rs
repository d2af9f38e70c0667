//! Angles and velocity ambiguity: arrays with and without rows, time and Doppler division.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::points::{Height, Object};
use artifact::radar::Multiplexing;
use dsp::Receiver;
use dsp::angle::VirtualArray;
use glam::DVec3;

fn objects(header: &CubeHeader, targets: &[Target]) -> Vec<Object> {
    Receiver::new(header).unwrap().process(&cube(header, targets, 1)).unwrap().1.objects
}

/// The one object stands where the target stood in the middle of the frame.
fn assert_placed(what: &str, header: &CubeHeader, target: &Target, tolerance_m: [f64; 3]) {
    let found = objects(header, std::slice::from_ref(target));
    assert_eq!(found.len(), 1, "{what}: {found:?}");
    let (_, radial_mps, position_m) = truth(header, target);
    for i in 0..3 {
        let error = found[0].position_m[i] - position_m[i];
        assert!(error.abs() < tolerance_m[i], "{what}: axis {i} is off by {error} m");
    }
    let span = 2.0 * header.radar.velocity_max_mps();
    let folded = (found[0].radial_velocity_mps - radial_mps + 0.5 * span).rem_euclid(span) - 0.5 * span;
    assert!(folded.abs() < 5e-3, "{what}: velocity off by {folded}");
}

/// Tolerances of a row's points: u to 1e-4 (physics.md §8) at 40 m, range to 2 cm; height as assumed.
const FLAT: [f64; 3] = [5e-3, 0.02, 1e-9];

#[test]
fn s5_a_target_on_the_plus_side_reads_plus_u() {
    for x in [-12.0, -2.0, 2.0, 9.5] {
        let header = header(256, 64, elements_3x4());
        let found = objects(&header, &[target([x, 38.1, 0.75], [0.0, -2.0, 0.0], 10.0)]);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].azimuth_rad > 0.0, x > 0.0);
        assert_placed("3x4", &header, &target([x, 38.1, 0.75], [0.0, -2.0, 0.0], 10.0), FLAT);
    }
}

#[test]
fn s5_a_target_above_the_boresight_reads_plus_in_elevation() {
    for [x, z] in [[5.75, 0.3], [-8.0, 3.0], [2.0, 9.0]] {
        let header = header(256, 64, elements_6x8());
        // Both direction cosines to 1e-4 at 36 m, and what 2 cm of range carry along the line of sight.
        assert_placed("6x8", &header, &target([x, 35.3, z], [0.0, -2.0, 0.0], 10.0), [0.01, 0.02, 0.01]);
    }
}

/// The top of a beam may lie beyond the rim of what is before an array with rows, as that of noise does in
/// the corners of the square of cosines: no point is farther away than its range.
#[test]
fn points_at_the_rim_of_the_view_are_as_far_away_as_their_range() {
    let mut header = header(128, 64, elements_6x8());
    (header.noise, header.dsp.false_alarm_rate) = (NOISE_12_DB, 1e-3);
    let radar_m = DVec3::from(header.radar.position_m);
    for azimuth_deg in [75.0, 88.0, 89.5, -86.0] {
        let (sin, cos) = f64::to_radians(azimuth_deg).sin_cos();
        let target = target([20.0 * sin, 20.0 * cos, 12.0], [0.0; 3], 100.0);
        let found = Receiver::new(&header).unwrap().process(&cube(&header, &[target], 1)).unwrap().1;
        let points = found.points.iter().map(|p| (p.position_m, p.range_m));
        for (place_m, range_m) in points.chain(found.objects.iter().map(|o| (o.position_m, o.range_m))) {
            let away_m = (DVec3::from(place_m) - radar_m).length();
            assert!((away_m / range_m - 1.0).abs() < 1e-12, "{azimuth_deg}°: {away_m} of {range_m} m");
        }
    }
}

#[test]
fn a_turned_and_tilted_radar_still_answers_in_world_axes() {
    let mut flat = header(256, 64, elements_3x4());
    flat.radar.boresight_az_rad = 0.3;
    place_elements(&mut flat.radar);
    assert_placed("turned", &flat, &target([14.0, 33.0, 0.75], [0.0, -3.0, 0.0], 10.0), [0.015, 0.02, 1e-9]);
    let mut rows = header(256, 64, elements_6x8());
    rows.radar.boresight_az_rad = -0.2;
    rows.radar.boresight_el_rad = -0.15;
    place_elements(&mut rows.radar);
    assert_placed("tilted", &rows, &target([-4.0, 33.0, 1.5], [0.0, -3.0, 0.0], 10.0), [0.01, 0.02, 0.01]);
}

#[test]
fn a_wide_array_sees_the_wavefronts_curvature() {
    let header = header(256, 16, elements_12x16());
    let mut header = header;
    header.dsp.training_cells = [4, 8];
    // Lane 3 at 25 m: 0.9 rad per leg at the row's end, which a plane wave would turn into a blurred, shifted
    // lobe.
    let target = target([9.5, 23.0, 0.75], [0.0, -1.0, 0.0], 10.0);
    assert_placed("12x16", &header, &target, [5e-3, 0.02, 1e-9]);
    let receiver = Receiver::new(&header).unwrap();
    let map = receiver.range_doppler(&cube(&header, &[target], 1)).unwrap();
    let array = VirtualArray::new(&header);
    let (range_m, radial_mps, position_m) = truth(&header, &target);
    let object = receiver.detect(&map).unwrap().objects[0];
    let row = (16.0 / 2.0 + radial_mps / header.radar.velocity_resolution_mps()).round() as usize;
    let column = (range_m / header.radar.waveform.range_resolution_m()).round() as usize;
    let snapshot = array.snapshot(&map, [row, column], object.radial_velocity_mps);
    let direction = dsp::angle::Direction { right: position_m[0] / range_m, up: None };
    let gain = array.beam(&snapshot, &array.steering(direction, range_m)).norm();
    let all: f64 = snapshot.iter().map(|v| v.norm()).sum();
    // The range cell's response changes by the delays across the row (0.07 m of 0.24 m): below 0.1 dB in the
    // sum.
    assert!(gain > 0.99 * all, "the beam collects {} of the aperture", gain / all);
}

#[test]
fn elements_off_any_grid_are_no_obstacle() {
    let rx = [0.0, 1.07, 2.31, 3.02, 5.5, 6.13].map(|p| [p, 0.0]).to_vec();
    let header = header(256, 64, [vec![[0.0, 0.0]], rx]);
    assert_placed("odd", &header, &target([5.75, 38.1, 0.75], [0.0, -2.0, 0.0], 10.0), FLAT);
}

#[test]
fn time_division_turns_every_transmitter_back_before_the_angle() {
    for velocity in [-4.3, -1.0, 3.9] {
        let mut header = header(256, 64, elements_3x4());
        header.radar.array.multiplexing = Multiplexing::Tdm;
        assert!((header.radar.velocity_max_mps() - 5.3857).abs() < 1e-3);
        assert_placed("tdm", &header, &target([5.75, 38.1, 0.75], [0.0, velocity, 0.0], 10.0), FLAT);
    }
}

#[test]
fn doppler_division_keeps_the_full_velocity_span() {
    // 128 rows are whole bands of 32; 90 and 101 are not.
    for chirps in [128, 90, 101] {
        for velocity in [-14.0, -9.3, -2.0, 0.0, 7.7, 15.0] {
            let mut header = header(256, chirps, elements_3x4());
            header.radar.array.multiplexing = Multiplexing::Ddm;
            let target = target([5.75, 38.1, 0.75], [0.0, velocity, 0.0], 10.0);
            let found = objects(&header, &[target]);
            assert_eq!(found.len(), 1, "{chirps} chirps, {velocity} m/s: {found:?}");
            let error = found[0].radial_velocity_mps - truth(&header, &target).1;
            assert!(error.abs() < 5e-3, "{chirps} chirps, {velocity} m/s: off by {error}");
            assert_placed("ddm", &header, &target, FLAT);
        }
    }
}

#[test]
fn doppler_division_says_so_where_no_other_velocity_up_to_120_kmh_looks_alike() {
    // 128 samples, 29 µs from chirp to chirp: λ/2T is 67 m/s, and the next velocity like −30 is 37.
    let mut header = header(128, 128, elements_3x4());
    header.radar.waveform.chirp_interval_s = 29e-6;
    header.radar.array.multiplexing = Multiplexing::Ddm;
    for velocity in [-30.0, -9.3, 0.0, 21.0] {
        let target = target([5.75, 30.0, 0.75], [0.0, velocity, 0.0], 10.0);
        let found = objects(&header, &[target]);
        assert_eq!(found.len(), 1, "{velocity} m/s: {found:?}");
        assert!(found[0].velocity_resolved, "{found:?}");
        assert!(
            (found[0].radial_velocity_mps - truth(&header, &target).1).abs() < 5e-3,
            "{velocity}: {found:?}"
        );
    }
}

#[test]
fn doppler_division_does_not_tell_velocities_a_whole_span_apart() {
    // 60 µs: λ/2T is 32.3 m/s. 20 m/s looks like −12.3 in every band, and −12.3 like 20.
    let mut header = header(256, 128, elements_3x4());
    header.radar.array.multiplexing = Multiplexing::Ddm;
    let span_mps = 2.0 * header.radar.velocity_max_mps();
    for velocity in [-29.0, -20.0, 20.0, 29.0] {
        let target = target([0.0, 38.1, 6.0], [0.0, velocity, 0.0], 10.0);
        for seen in
            [target, Target { velocity_mps: [0.0, velocity - span_mps * velocity.signum(), 0.0], ..target }]
        {
            let found = objects(&header, &[seen]);
            assert_eq!(found.len(), 1, "{velocity} m/s: {found:?}");
            let shown = velocity - span_mps * velocity.signum();
            assert!((found[0].radial_velocity_mps - shown).abs() < 5e-3, "{velocity} m/s: {found:?}");
            assert!(!found[0].velocity_resolved, "{velocity} m/s: {found:?}");
        }
    }
}

#[test]
fn doppler_division_in_noise_finds_a_weak_target_once() {
    let mut header = header(256, 128, elements_3x4());
    header.radar.array.multiplexing = Multiplexing::Ddm;
    header.noise = NOISE_12_DB;
    let receiver = Receiver::new(&header).unwrap();
    for seed in 0..10 {
        let target = target([2.0, 55.0, 0.75], [0.0, -11.0, 0.0], 1.0);
        let map = receiver.range_doppler(&cube(&header, &[target], seed)).unwrap();
        let found = receiver.detect(&map).unwrap().objects;
        assert_eq!(found.len(), 1, "seed {seed}: {found:?}");
        assert!((found[0].radial_velocity_mps - truth(&header, &target).1).abs() < 0.1);
    }
}

#[test]
fn two_vehicles_in_one_range_cell_a_band_apart_are_flagged_as_unresolved() {
    let mut header = header(256, 128, elements_3x4());
    header.radar.array.multiplexing = Multiplexing::Ddm;
    let band = 2.0 * header.radar.velocity_max_mps() / 4.0;
    let pair = [1.0, 1.0 - band].map(|v| target([0.0, 40.0, 6.0], [0.0, v, 0.0], 10.0));
    assert!(objects(&header, &pair).iter().all(|object| !object.velocity_resolved));
}

#[test]
fn multiplexing_whose_folds_are_not_told_claims_no_resolved_velocity() {
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm] {
        let mut header = header(256, 64, elements_3x4());
        header.radar.array.multiplexing = multiplexing;
        assert!(!objects(&header, &[target([5.0, 30.0, 0.75], [0.0, -2.0, 0.0], 10.0)])[0].velocity_resolved);
    }
}

/// 6 m above the road, and nearer than the 5.25 m down to the assumed height: no ground range exists.
#[test]
fn a_point_nearer_than_its_height_tells_the_angle_of_the_cone_and_says_so() {
    let mut header = header(256, 64, elements_3x4());
    header.radar.waveform.slope_hz_per_s = 60e12;
    for (boresight_rad, x) in [(0.0, 0.5), (0.0, -1.2), (0.3, 0.5)] {
        header.radar.boresight_az_rad = boresight_rad;
        place_elements(&mut header.radar);
        // As high as the radar, 3 m before it: u = x/R, whatever the height.
        let [right, ahead, _] = radar::aperture::axes(&header.radar);
        let place = glam::DVec3::new(0.0, 0.0, 6.0) + x * right + 3.0 * ahead;
        let target = target(place.to_array(), [0.0, 0.0, 0.0], 1.0);
        let found = Receiver::new(&header).unwrap().process(&cube(&header, &[target], 1)).unwrap().1;
        let object = found.objects[0];
        let cone_rad = boresight_rad + (x / 3f64.hypot(x)).asin();
        // u to 1e-4, as in FLAT, and what curvature of the wavefront over the row is left of it at 3 m.
        assert!((object.azimuth_rad - cone_rad).abs() < 2e-3, "{} for {cone_rad}", object.azimuth_rad);
        assert_eq!(object.height, Height::None);
        assert!(found.points.iter().all(|point| point.height == Height::None));
        assert_eq!(found.points_without_height(), found.points.len());
        for point in &found.points {
            let away = glam::DVec3::from(point.position_m) - glam::DVec3::new(0.0, 0.0, 6.0);
            // A place is as far away as its range says: 5.25 m down would be farther.
            assert!(
                (away.length() - point.range_m).abs() < 1e-9,
                "{} m for {}",
                away.length(),
                point.range_m
            );
        }
    }
}

#[test]
fn points_beyond_the_assumed_height_and_those_of_rows_say_what_their_height_stands_on() {
    let target = target([2.0, 38.1, 0.75], [0.0, -2.0, 0.0], 10.0);
    for (elements, height) in [(elements_3x4(), Height::Assumed), (elements_6x8(), Height::Measured)] {
        let header = header(256, 64, elements);
        let found = objects(&header, std::slice::from_ref(&target));
        assert!(!found.is_empty() && found.iter().all(|object| object.height == height));
    }
}

/// Two transmitters a diagonal apart, three receivers: 6 channels however far it goes, half wavelengths.
fn diagonal(apart: f64) -> [Vec<[f64; 2]>; 2] {
    [vec![[0.0, 0.0], [apart, apart]], vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]]
}

#[test]
fn an_array_of_too_many_directions_is_refused_before_a_frame_and_a_smaller_one_is_searched() {
    let error = Receiver::new(&header(64, 16, diagonal(2000.0))).err().unwrap();
    let told = "8192 × 8192 directions (right × up); the limit is 4194304";
    assert!(error.to_string().ends_with(told), "{error}");
    let mut header = header(256, 64, diagonal(250.0));
    header.dsp.training_cells = [4, 8];
    assert!(dsp::angle::search_bytes(&header.radar) <= 12 << 20, "12 bytes a direction");
    let found = objects(&header, &[target([2.0, 35.3, 3.0], [0.0, -2.0, 0.0], 10.0)]);
    assert_eq!(found.len(), 1, "{found:?}");
}
