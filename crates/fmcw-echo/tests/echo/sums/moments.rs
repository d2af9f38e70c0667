//! Paths that stand for a part of the frame or of the array: all sums weigh them alike, and what is the same
//! at all nodes is one list of paths.

use crate::setting::*;
use ::radar::aperture::Preset;
use artifact::Accuracy;
use artifact::paths::{ArraySide, ArraySpan, Path, Span};
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

/// Each path from one of several places along the row of the array, or from none.
fn spread_over_array(radar: &Radar, places: u32, paths: Vec<Path>) -> Vec<Path> {
    let spread = |(i, path): (usize, Path)| match (i as u32) % (places + 1) {
        0 => path,
        part => at_place(radar, places, part - 1, path),
    };
    paths.into_iter().enumerate().map(spread).collect()
}

/// The array's row stands along x, a few centimetres about the radar's position.
fn at_place(radar: &Radar, places: u32, place: u32, mut path: Path) -> Path {
    const HALF_M: f64 = 0.012;
    let (transmit, receive) = ([0.7, 0.0, 0.0], [0.3, 0.0, 0.0]);
    let (first_m, step_m) = (radar.position_m[0] - HALF_M, 2.0 * HALF_M / f64::from(places - 1));
    path.curve.array_span = Some(ArraySpan { transmit, receive, first_m, step_m, places, place });
    path
}

/// Each path for pairs whose transmitter is farther along x than the receiver, for the others, or for all.
fn on_sides_of_array(paths: Vec<Path>) -> Vec<Path> {
    let (x, back) = ([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
    let on_side = |(i, mut path): (usize, Path)| {
        let side = [None, Some([x, back]), Some([back, x])][i % 3];
        path.curve.array_side = side.map(|[transmit, receive]| ArraySide { transmit, receive, from_m: 0.0 });
        path
    };
    paths.into_iter().enumerate().map(on_side).collect()
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
        let paths = || random_paths(31, 24);
        let on_sides = on_sides_of_array(spread_over_array(&radar, 5, paths()));
        for paths in [spread_over(&radar, 5, paths()), spread_over_array(&radar, 5, paths()), on_sides] {
            let [got, exact] = cubes(&radar, &paths);
            let db = error_db(&got, &exact);
            println!("{multiplexing:?}: {db:.1} dB");
            // As for paths that stand for the whole frame: −137 dB and cancellation of 20 of them.
            assert!(db < -125.0, "{multiplexing:?}: {db}");
        }
    }
}

#[test]
fn the_fast_sum_of_paths_of_moments_has_the_error_asked_for() {
    let short = artifact::Waveform { chirps: 32, ..experiment(1) };
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Bpm] {
        let radar = radar(short, &presets()[1], multiplexing);
        // Each moment has enough for transforms: 200 are asked for at most.
        let body = || body(5, 900, [5.75, 38.0, 0.7], [0.0, -10.0, 0.0]);
        let parts = [spread_over(&radar, 3, body()), spread_over_array(&radar, 3, body())];
        for paths in parts.into_iter().chain([on_sides_of_array(body())]) {
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
}

/// Of nine places along a row of 192 channels whole blocks of links hear nothing.
#[test]
fn links_far_from_a_place_hear_nothing_of_it() {
    let short = artifact::Waveform { chirps: 8, samples: 64, ..experiment(1) };
    let [tx, rx] = Preset::TwelveBySixteen.elements();
    let radar = radar(short, &Layout { name: "12x16", tx, rx }, Multiplexing::Simultaneous);
    let span = ArraySpan {
        transmit: [1.0, 0.0, 0.0],
        receive: [0.0; 3],
        first_m: radar.position_m[0] - 0.17,
        step_m: 0.34 / 8.0,
        places: 9,
        place: 0,
    };
    let of_place = |place: u32| {
        let paths = body(5 + u64::from(place), 250, [5.75, 38.0, 0.7], [0.0, -10.0, 0.0]).into_iter();
        paths.map(move |mut path| {
            path.curve.array_span = Some(ArraySpan { place, ..span });
            path
        })
    };
    let paths: Vec<Path> = [0, 4, 8].into_iter().flat_map(of_place).collect();
    let f_c = radar.waveform.centre_frequency_hz();
    let exact = DirectSum::new(&radar, f_c, &paths).cube();
    let db = error_db(&fast_sum::cube(&radar, f_c, &paths, Accuracy::from_db(-40.0)), &exact);
    println!("{db:.1} dB");
    assert!(db <= -40.0, "{db}");
}

#[test]
fn paths_that_are_the_same_at_all_moments_are_those_of_the_whole_frame() {
    let radar =
        radar(artifact::Waveform { chirps: 16, ..experiment(1) }, &presets()[1], Multiplexing::Simultaneous);
    let whole = random_paths(33, 20);
    for moments in [2, 3, 4, 9] {
        for of_node in [at_moment, at_place] {
            let copy =
                |node| whole.iter().map(|path| of_node(&radar, moments, node, *path)).collect::<Vec<_>>();
            let parts: Vec<Path> = (0..moments).flat_map(copy).collect();
            let f_c = radar.waveform.centre_frequency_hz();
            let [got, exact] = [&parts, &whole].map(|paths| DirectSum::new(&radar, f_c, paths).cube());
            let db = error_db(&got, &exact);
            // Shares of at most 1.1 that add up to 1 within a few roundings, and 20 sums: below −250 dB.
            assert!(db < -250.0, "{moments}: {db}");
        }
    }
}
