//! The same bytes on any number of threads, and an error that is measured.

use crate::setting::*;
use artifact::cube::CubeFrame;
use artifact::radar::Multiplexing;
use artifact::settings::Noise;
use fmcw_echo::{Synthesizer, memory_estimate_bytes, reference};
use std::sync::Mutex;

fn cube_on(threads: usize, multiplexing: Multiplexing, noise: Noise) -> CubeFrame {
    let radar = radar(artifact::Waveform { chirps: 8, ..experiment(1) }, &presets()[2], multiplexing);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        synthesized(
            &header(radar, noise),
            4,
            &frame([random_paths(41, 99), body(42, 700, [2.0, 30.0, 0.7], [0.0, -9.0, 0.0])].concat()),
        )
        .unwrap()
    })
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_1_2_and_7_threads() {
    let figure = Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 };
    for (multiplexing, noise) in
        [(Multiplexing::Ddm, figure), (Multiplexing::Tdm, Noise::SnrDb(20.0)), (Multiplexing::Bpm, figure)]
    {
        let one = cube_on(1, multiplexing, noise);
        assert!(one == cube_on(2, multiplexing, noise));
        assert!(one == cube_on(7, multiplexing, noise));
    }
}

#[test]
fn the_synthesis_error_printed_is_the_error_made() {
    let radar =
        radar(artifact::Waveform { chirps: 4, ..experiment(1) }, &presets()[1], Multiplexing::Simultaneous);
    let f_c = radar.waveform.centre_frequency_hz();
    let paths = random_paths(42, 33);
    let cube = synthesized(&header(radar.clone(), Noise::Absent), 1, &frame(paths.clone())).unwrap();
    let printed_db = 20.0 * cube.error.synthesis.unwrap().log10();
    let true_db = error_db(&widened(&cube.samples), &reference::cube(&radar, f_c, &paths));
    // 48 probes of 4096 samples: ±20 % of the rms at two standard errors, and the heaviest sample may be
    // among them.
    assert!((printed_db - true_db).abs() < 3.0, "{printed_db} against {true_db}");
}

#[test]
fn a_silent_frame_has_no_synthesis_error_to_tell() {
    let radar = single_channel(artifact::Waveform { chirps: 2, ..experiment(1) });
    let cube = synthesized(&header(radar, Noise::Absent), 1, &frame(vec![])).unwrap();
    assert_eq!(cube.error.synthesis, None);
    assert!(cube.samples.iter().all(|x| x.norm_sqr() == 0.0));
}

#[test]
fn progress_ends_at_one() {
    let radar = single_channel(artifact::Waveform { chirps: 16, ..experiment(1) });
    let shares = Mutex::new(vec![]);
    let paths = frame(random_paths(43, 3));
    let synthesizer = Synthesizer::new(&header(radar, Noise::Absent), 1, asked(), vec![]).unwrap();
    synthesizer.frame(&paths, &|share| shares.lock().unwrap().push(share)).unwrap();
    let mut shares = shares.into_inner().unwrap();
    shares.sort_by(f64::total_cmp);
    assert_eq!(shares.last(), Some(&1.0));
}

#[test]
fn memory_is_at_least_the_cube_itself() {
    let header = header(radar(experiment(1), &presets()[4], Multiplexing::Tdm), Noise::Absent);
    let cube_bytes = 192 * 128 * 256 * 8;
    let estimate = memory_estimate_bytes(&header, asked());
    // And a grid of 16 sets for each thread.
    let beside = (24 << 20) * rayon::current_num_threads() as u64;
    assert!(estimate > cube_bytes && estimate < cube_bytes + beside, "{estimate}");
}
