//! Paths that stand for a part of the frame: all sums weigh them alike, and what is the same at all moments
//! is one list of paths.

use crate::setting::*;
use artifact::Accuracy;
use artifact::paths::{Path, Span};
use artifact::radar::{Multiplexing, Radar};
use fmcw_echo::{direct_sum::DirectSum, fast_sum, reference};
use num_complex::Complex64;

/// Each path at one of several moments of the frame, or at none.
fn spread_over(radar: &Radar, moments: u32, paths: Vec<Path>) -> Vec<Path> {
    let spread = |(i, path): (usize, Path)| match (i as u32) % (moments + 1) {
        0 => path,
        part => at_moment(radar, moments, part - 1, path),
    };
    paths.into_iter().enumerate().map(spread).collect()
}

fn at_moment(radar: &Radar, moments: u32, moment: u32, mut path: Path) -> Path {
    let step_s = radar.frame_duration_s() / f64::from(moments - 1);
    path.curve.span = Some(Span { first_s: 0.0, step_s, moments, moment });
    path
}

fn cubes(radar: &Radar, paths: &[Path]) -> [Vec<Complex64>; 2] {
    let f_c = radar.waveform.centre_frequency_hz();
    [DirectSum::new(radar, f_c, paths).cube(), reference::cube(radar, f_c, paths)]
}

#[test]
fn the_direct_sum_weighs_paths_of_moments_as_the_formula_does() {
    let short = artifact::Waveform { chirps: 7, ..experiment(1) };
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm]
    {
        let mut radar = radar(short, &presets()[1], multiplexing);
        radar.schedule.stagger_s = vec![0.0, 2e-6, 5e-6];
        let paths = spread_over(&radar, 5, random_paths(31, 24));
        let [got, exact] = cubes(&radar, &paths);
        let db = error_db(&got, &exact);
        println!("{multiplexing:?}: {db:.1} dB");
        // As for paths that stand for the whole frame: −137 dB and cancellation of 20 of them.
        assert!(db < -125.0, "{multiplexing:?}: {db}");
    }
}

#[test]
fn the_fast_sum_of_paths_of_moments_has_the_error_asked_for() {
    let short = artifact::Waveform { chirps: 32, ..experiment(1) };
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Bpm] {
        let radar = radar(short, &presets()[1], multiplexing);
        // Each moment has enough for transforms: 200 are asked for at most.
        let paths = spread_over(&radar, 3, body(5, 900, [5.75, 38.0, 0.7], [0.0, -10.0, 0.0]));
        let f_c = radar.waveform.centre_frequency_hz();
        let exact = DirectSum::new(&radar, f_c, &paths).cube();
        for asked_db in [-20.0, -40.0, -60.0, -80.0, -100.0] {
            let got = fast_sum::cube(&radar, f_c, &paths, Accuracy::from_db(asked_db));
            let db = error_db(&got, &exact);
            println!("{multiplexing:?}: asked {asked_db} dB, got {db:.1} dB");
            assert!(db <= asked_db, "{multiplexing:?}: asked {asked_db}, got {db}");
        }
    }
}

#[test]
fn paths_that_are_the_same_at_all_moments_are_those_of_the_whole_frame() {
    let radar =
        radar(artifact::Waveform { chirps: 16, ..experiment(1) }, &presets()[1], Multiplexing::Simultaneous);
    let whole = random_paths(33, 20);
    for moments in [2, 3, 4, 9] {
        let copy =
            |moment| whole.iter().map(|path| at_moment(&radar, moments, moment, *path)).collect::<Vec<_>>();
        let parts: Vec<Path> = (0..moments).flat_map(copy).collect();
        let f_c = radar.waveform.centre_frequency_hz();
        let [got, exact] = [&parts, &whole].map(|paths| DirectSum::new(&radar, f_c, paths).cube());
        let db = error_db(&got, &exact);
        // Shares of at most 1.1 that add up to 1 within a few roundings, and 20 sums: below −250 dB.
        assert!(db < -250.0, "{moments}: {db}");
    }
}
