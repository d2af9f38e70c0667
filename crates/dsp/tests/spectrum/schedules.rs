//! Maps of chirps at changing intervals, and of sub-frames.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeFrame;
use artifact::radar::Multiplexing;
use dsp::RangeDoppler;
use dsp::{DspError, Receiver, velocity_axis_mps};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Intervals of 60 µs and 7, −2 and −5 µs.
const STAGGER_S: [f64; 3] = [0.0, 7e-6, 5e-6];

#[test]
fn rows_of_staggered_chirps_are_the_sums_at_their_own_times() {
    for chirps in [6, 7] {
        for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm] {
            let mut header = header(8, chirps, elements_3x4());
            header.radar.schedule.stagger_s = STAGGER_S[..2].to_vec();
            header.radar.array.multiplexing = multiplexing;
            let frame = cube(&header, &[target([0.0, 3.0, 6.0], [0.0, -9.0, 0.0], 1.0)], 1);
            let transform = RangeDoppler::<f64>::new(&header).unwrap();
            let doppler_taper = dsp::window::taper(header.dsp.doppler_window, chirps as usize).unwrap();
            let range_taper = dsp::window::taper(header.dsp.range_window, 8).unwrap();
            for (tx, channel) in [(0, 1), (2, 9)] {
                let samples = &frame.samples[channel * chirps as usize * 8..][..chirps as usize * 8];
                let got = transform.channel_of(tx, samples, 0.0);
                let scale = got.iter().map(|v| v.norm()).fold(0.0, f64::max);
                for (at, got) in got.iter().enumerate() {
                    // Row r is the velocity (r − N/2)/(N·T), column the beat frequency.
                    let doppler_hz = ((at / 8) as f64 - f64::from(chirps / 2))
                        / (f64::from(chirps) * header.radar.repetition_interval_s());
                    let mut sum = Complex64::ZERO;
                    for (i, x) in samples.iter().enumerate() {
                        let (chirp, n) = (i / 8, i % 8);
                        let later_s =
                            header.radar.chirp_start_s(tx, chirp) - header.radar.chirp_start_s(tx, 0);
                        let cycles = doppler_hz * later_s + (n * (at % 8)) as f64 / 8.0;
                        let weight = doppler_taper[chirp] * range_taper[n];
                        sum += Complex64::new(x.re.into(), x.im.into())
                            * weight
                            * Complex64::from_polar(1.0, -TAU * cycles);
                    }
                    // Rounding of 56 terms, 2e-16 each.
                    assert!(
                        (got - sum).norm() < 1e-13 * scale,
                        "{chirps} chirps, cell {at}: {got} against {sum}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_point_seen_by_staggered_chirps_is_placed_as_by_even_ones() {
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm] {
        let mut header = header(256, 128, elements_3x4());
        header.radar.schedule.stagger_s = STAGGER_S.to_vec();
        header.radar.array.multiplexing = multiplexing;
        let target = target([5.75, 40.0, 0.75], [0.0, -4.0, 0.0], 10.0);
        let points = Receiver::new(&header).unwrap().process(&cube(&header, &[target], 1)).unwrap().1;
        let (range_m, velocity_mps, at_m) = truth(&header, &target);
        let object = &points.objects[0];
        println!(
            "{multiplexing:?}: {} m, {} m/s against {range_m}, {velocity_mps}",
            object.range_m, object.radial_velocity_mps
        );
        // As in point_targets.rs, where chirps are even; the stagger's sidelobes lie where the main lobe does
        // not reach.
        assert!(
            (object.range_m - range_m).abs() < 0.02
                && (object.radial_velocity_mps - velocity_mps).abs() < 5e-3
        );
        assert!((object.position_m[0] - at_m[0]).abs() < 5e-3);
    }
}

#[test]
fn each_record_of_sub_frames_is_mapped_by_its_own_interval() {
    let mut header = header(256, 64, elements_1x1());
    header.radar.schedule.sub_frame_intervals_s = vec![60e-6, 85e-6];
    for index in [0, 1, 2] {
        let own = header.in_frame(index);
        let target = target([0.0, 40.0, 6.0], [0.0, -15.5, 0.0], 10.0);
        let frame = CubeFrame { index, ..cube(&own, &[target], 1) };
        let points = Receiver::new(&header).unwrap().process(&frame).unwrap().1;
        let half_mps = -velocity_axis_mps(&own)[0];
        let shown = points.objects[0].radial_velocity_mps;
        // −15.5 m/s is within ±16.16 of the first interval and folds by 2·11.40 of the second.
        let folded = if index % 2 == 0 { -15.5 } else { -15.5 + 2.0 * half_mps };
        assert!((shown - folded).abs() < 5e-3, "record {index}: {shown} against {folded}");
    }
}

#[test]
fn staggered_doppler_division_is_refused() {
    let mut header = header(16, 16, elements_3x4());
    header.radar.schedule.stagger_s = STAGGER_S.to_vec();
    header.radar.array.multiplexing = Multiplexing::Ddm;
    let frame = cube(&header, &[], 1);
    assert_eq!(mapped(&header, &frame), Err(DspError::StaggeredDivision));
}
