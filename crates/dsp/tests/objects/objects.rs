//! Vehicles become objects: one each, not fewer, not more.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::points::PointsFrame;
use artifact::radar::{Multiplexing, Sampling};
use artifact::settings::Window;
use dsp::Receiver;

fn seen(header: &CubeHeader, targets: &[Target], seed: u64) -> PointsFrame {
    Receiver::new(header).unwrap().process(&cube(header, targets, seed)).unwrap().1
}

fn noisy(samples: u32) -> CubeHeader {
    let mut header = header(samples, 128, elements_3x4());
    header.noise = NOISE_12_DB;
    header
}

/// Points of a moving body stand nearer than their cells by what a moving echo is shown farther: none is told
/// nearer than asked, wherever the bound lies among the cells.
#[test]
fn no_point_is_nearer_than_the_scene_asks() {
    let mut header = header(64, 128, elements_3x4());
    let cell_m = header.radar.waveform.range_resolution_m();
    let target = target([0.0, 24.0, 0.75], [0.0, 25.0, 0.0], 10.0);
    for tenth in -25..5 {
        header.dsp.nearest_m = 24.4 + 0.1 * f64::from(tenth) * cell_m;
        let points = seen(&header, std::slice::from_ref(&target), 1).points;
        let nearest_m = points.iter().map(|p| p.range_m).fold(f64::INFINITY, f64::min);
        assert!(nearest_m >= header.dsp.nearest_m, "{nearest_m} m, asked {} m", header.dsp.nearest_m);
    }
}

#[test]
fn two_targets_in_neighbouring_lanes_are_two_objects_in_their_lanes() {
    let header = noisy(256);
    // 1.5 m apart in range and 3.75 m across: nearer than the clusters' reach in range.
    let pair = [
        target([2.0, 38.0, 0.75], [0.0, -8.0, 0.0], 10.0),
        target([5.75, 39.2, 0.75], [0.0, -8.2, 0.0], 10.0),
    ];
    let points = seen(&header, &pair, 3);
    let mut lanes: Vec<_> = points.objects.iter().map(|o| o.lane).collect();
    lanes.sort();
    assert_eq!(lanes, [Some(1), Some(2)], "{:#?}", points.objects);
}

#[test]
fn fronts_at_rest_before_a_stop_line_are_an_object_each_though_one_maximum_covers_them() {
    let header = noisy(256);
    // Within 0.7 m in range, three cells; lanes are 0.8 beams apart.
    let fronts = [(2.0, 27.0, 10.0), (5.75, 26.9, 2.0), (9.5, 26.2, 1.0)]
        .map(|(x, y, rcs_m2)| target([x, y, 0.75], [0.0; 3], rcs_m2));
    for count in [2, 3] {
        let points = seen(&header, &fronts[..count], 5);
        let mut lanes: Vec<_> = points.objects.iter().map(|o| o.lane).collect();
        lanes.sort();
        assert_eq!(lanes, [Some(1), Some(2), Some(3)][..count], "{:#?}", points.objects);
    }
}

#[test]
fn a_car_of_sixty_points_over_five_metres_is_one_object() {
    for seed in 0..6 {
        let header = noisy([256, 384, 512][seed as usize % 3]);
        let x = [2.0, 5.75, 9.5][seed as usize % 3];
        let car = vehicle([x, 26.0 + 5.0 * seed as f64], [5.0, 2.0, 1.8], -7.0, seed);
        assert_eq!(car.len(), 60);
        let points = seen(&header, &car, seed);
        println!(
            "seed {seed}: {} points {:?}",
            points.points.len(),
            points.objects.iter().map(|o| (o.points, o.lane, o.snr_db)).collect::<Vec<_>>()
        );
        assert_eq!(points.objects.len(), 1, "seed {seed}: {:#?}", points.objects);
        let object = &points.objects[0];
        assert!(object.range_extent_m[1] - object.range_extent_m[0] > 2.0);
        assert!(points.points.iter().all(|p| p.target.is_none()));
        assert_eq!(points.points.iter().filter(|p| p.object == Some(0)).count(), object.points as usize);
    }
}

#[test]
fn a_bus_of_twelve_metres_is_one_object() {
    for seed in 0..3 {
        let bus = vehicle([5.75, 30.0 + 9.0 * seed as f64], [12.0, 2.5, 3.0], -5.0, seed);
        let points = seen(&noisy(256), &bus, seed);
        println!(
            "seed {seed}: {} points {:?}",
            points.points.len(),
            points.objects.iter().map(|o| (o.points, o.lane, o.snr_db)).collect::<Vec<_>>()
        );
        assert_eq!(points.objects.len(), 1, "seed {seed}: {:#?}", points.objects);
    }
}

#[test]
fn cars_abreast_in_three_lanes_at_their_own_speeds_are_three_objects() {
    for seed in 0..3 {
        let y = 28.0 + 6.0 * seed as f64;
        let lanes = [(2.0, y, -9.0), (5.75, y + 1.0, -6.0), (9.5, y - 1.0, -3.0)];
        let cars: Vec<Target> = lanes
            .iter()
            .enumerate()
            .flat_map(|(i, (x, y, v))| vehicle([*x, *y], [5.0, 2.0, 1.8], *v, 100 * seed + i as u64))
            .collect();
        let points = seen(&noisy(256), &cars, seed);
        println!(
            "seed {seed}: {:?}",
            points.objects.iter().map(|o| (o.points, o.lane, o.snr_db)).collect::<Vec<_>>()
        );
        assert_eq!(points.objects.len(), 3, "seed {seed}: {:#?}", points.objects);
        assert_eq!(
            points.objects.iter().filter_map(|o| o.lane).collect::<std::collections::BTreeSet<_>>().len(),
            3
        );
    }
}

#[test]
fn cars_behind_each_other_in_one_lane_are_two_objects() {
    let queue: Vec<Target> =
        [26.0, 41.0].iter().flat_map(|y| vehicle([5.75, *y], [5.0, 2.0, 1.8], -4.0, *y as u64)).collect();
    assert_eq!(seen(&noisy(256), &queue, 1).objects.len(), 2);
}

#[test]
fn sidelobes_of_a_very_strong_target_become_no_objects() {
    for window in [Window::Rect, Window::Hann, Window::Hamming, Window::Blackman, Window::Chebyshev(80.0)] {
        let mut header = noisy(256);
        header.dsp.range_window = window;
        header.dsp.doppler_window = window;
        // 50 dBsm: 90 dB over the noise, far above every window's sidelobes. Off the bins' centres.
        let points = seen(&header, &[target([2.03, 31.37, 0.75], [0.0, -6.1, 0.0], 1e5)], 2);
        assert_eq!(points.objects.len(), 1, "{window:?}: {} points", points.points.len());
    }
}

/// Objects that are not the strong target's, whose place is off the bins' centres, over some of its levels.
fn false_objects(header: &CubeHeader, position_m: [f64; 3], levels_m2: &[f64]) -> usize {
    let of = |(seed, rcs_m2): (u64, &f64)| {
        let mut cube = cube(header, &[target(position_m, [0.0, -6.1, 0.0], *rcs_m2)], seed);
        if header.radar.waveform.sampling == Sampling::Real {
            cube.samples.iter_mut().for_each(|sample| sample.im = 0.0);
        }
        let (_, points) = Receiver::new(header).unwrap().process(&cube).unwrap();
        points.objects.len().saturating_sub(1)
    };
    (0..).zip(levels_m2).map(of).sum()
}

#[test]
fn sidelobes_of_the_conjugate_of_real_samples_become_no_objects() {
    for window in [Window::Rect, Window::Hann, Window::Hamming, Window::Chebyshev(60.0)] {
        let mut header = noisy(512);
        header.radar.waveform.sampling = Sampling::Real;
        (header.dsp.range_window, header.dsp.doppler_window) = (window, Window::Hann);
        assert_eq!(false_objects(&header, [2.03, 31.37, 0.75], &[1e4, 1e5, 1e6]), 0, "{window:?}");
    }
}

#[test]
fn sidelobes_of_transmitters_in_other_bands_become_no_objects() {
    let mut header = header(128, 256, elements_3x4());
    header.noise = NOISE_12_DB;
    header.radar.array.multiplexing = Multiplexing::Ddm;
    (header.dsp.range_window, header.dsp.doppler_window) = (Window::Blackman, Window::Chebyshev(60.0));
    // Straight ahead all transmitters are in phase.
    assert_eq!(false_objects(&header, [0.0, 26.37, 0.75], &[1e4, 1e5, 1e6]), 0);
}

/// Under a rectangular Doppler window the other folds of an echo have sidelobes of all transmitters and,
/// between rows, more power than the true one.
#[test]
fn a_lone_target_is_found_in_its_fold_though_its_doppler_window_is_rectangular() {
    let mut header = header(128, 64, elements_6x8());
    header.noise = NOISE_12_DB;
    header.radar.array.multiplexing = Multiplexing::Ddm;
    header.dsp.doppler_window = Window::Rect;
    for velocity_mps in [-13.44, -10.87, 1.28, 13.46] {
        let lone = target([2.0, 20.0, 0.75], [0.0, velocity_mps * 1.037, 0.0], 10.0);
        let (_, radial_mps, _) = truth(&header, &lone);
        let points = seen(&header, &[lone], 1);
        let [object] = &points.objects[..] else { panic!("{velocity_mps} m/s: {:#?}", points.objects) };
        assert!((object.radial_velocity_mps - radial_mps).abs() < 0.05, "{radial_mps}: {object:?}");
        // The main lobe has two rows, the first sidelobe one beside each.
        let is_near = |mps: f64| (mps - radial_mps).abs() < 2.0 * header.radar.velocity_resolution_mps();
        assert!(points.points.iter().all(|p| is_near(p.radial_velocity_mps)), "{:#?}", points.points);
    }
}

/// Between two cells the sidelobes of a rectangular window fall as steadily as a slope. An alarm of the noise
/// lies far off the point and belongs to no object.
#[test]
fn cells_on_sidelobes_of_a_lone_point_are_no_points() {
    let mut header = noisy(256);
    // The first zero of the main lobe is one cell away under a rectangular window, two under Hann's.
    for (window, first_zero) in [(Window::Rect, 1.0), (Window::Hann, 2.0)] {
        (header.dsp.range_window, header.dsp.doppler_window) = (window, window);
        let cell_m = header.radar.waveform.range_resolution_m();
        for part in [0.0, 0.25, 0.5] {
            let points = seen(&header, &[target([0.0, (100.0 + part) * cell_m, 6.0], [0.0; 3], 10.0)], 1);
            let own = points.points.iter().filter(|p| p.object.is_some());
            let apart = |range_m: f64| (range_m / cell_m - 100.0 - part).abs();
            let farthest = own.map(|p| apart(p.range_m)).fold(0.0, f64::max);
            assert!(farthest < first_zero + 0.1, "{window:?} {part}: {farthest} cells");
            assert_eq!(points.objects.len(), 1, "{window:?} {part}");
        }
    }
}

#[test]
fn level_sidelobes_in_the_noise_become_no_objects() {
    let mut header = noisy(256);
    for sidelobes_db in [40.0, 60.0] {
        header.dsp.range_window = Window::Chebyshev(sidelobes_db);
        let at_noise_m2 = 10_f64.powf((sidelobes_db - 28.0) / 10.0);
        let levels = [-4, -2, 0, 2, 4, 6].map(|db| at_noise_m2 * 10_f64.powf(f64::from(db) / 10.0));
        assert_eq!(false_objects(&header, [2.03, 20.0, 0.75], &levels), 0, "{sidelobes_db} dB");
    }
}

#[test]
fn a_weak_target_well_beside_a_strong_ones_sidelobes_is_kept() {
    let header = noisy(256);
    let pair =
        [target([2.0, 30.0, 0.75], [0.0, -6.0, 0.0], 1e4), target([5.75, 45.0, 0.75], [0.0, 3.0, 0.0], 1.0)];
    assert_eq!(seen(&header, &pair, 2).objects.len(), 2);
}

#[test]
fn noise_alone_makes_hardly_any_object() {
    // 1e-5 of 32 768 cells: 0.33 lone detections a map; two neighbours above threshold are far rarer.
    let header = noisy(256);
    let found: usize = (0..20).map(|seed| seen(&header, &[], seed).objects.len()).sum();
    assert!(found <= 2, "{found} objects in 20 maps of noise");
}

#[test]
fn targets_at_the_velocity_axis_seam_are_one_object() {
    let header = noisy(256);
    let seam = header.radar.velocity_max_mps();
    let pair = [0.1, -0.15].map(|dv| target([0.0, 30.0 + dv, 6.0], [0.0, seam + dv, 0.0], 10.0));
    let objects = seen(&header, &pair, 1).objects;
    assert_eq!(objects.len(), 1, "{objects:#?}");
    assert!(objects[0].radial_velocity_mps.abs() > seam - 0.3);
}

#[test]
fn a_weak_tail_behind_a_strong_front_is_the_same_vehicle_and_an_equal_follower_is_not() {
    let header = noisy(256);
    let at = |y, rcs_m2| target([9.5, y, 1.0], [0.0, -0.5, 0.0], rcs_m2);
    assert_eq!(seen(&header, &[at(30.0, 40.0), at(35.8, 1.0)], 1).objects.len(), 1);
    assert_eq!(seen(&header, &[at(30.0, 40.0), at(35.8, 10.0)], 1).objects.len(), 2);
    // Ahead of the strong one, or at another speed, it is no tail.
    assert_eq!(seen(&header, &[at(30.0, 1.0), at(35.8, 80.0)], 1).objects.len(), 2);
    let overtaking = target([9.5, 35.8, 1.0], [0.0, -4.0, 0.0], 1.0);
    assert_eq!(seen(&header, &[at(30.0, 40.0), overtaking], 1).objects.len(), 2);
}
