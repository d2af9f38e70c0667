//! Sound scenes: defaults, arrays, positions and motion are what `docs/scenes.md` says.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use artifact::goal::Goal;
use artifact::radar::{Multiplexing, Pattern, Polarization};
use artifact::scene::{Pose, Role, SceneHeader, Target, TargetKind};
use artifact::settings::{Class, EchoMode, NodeRule, Noise, Sides, Wheels, Window};
use radar::motion::pose_after;
use scene::{ReadOptions, snapshot};
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::{Path, PathBuf};

const WHOLE: ReadOptions = ReadOptions::whole();
const NAMES_ONLY: ReadOptions = ReadOptions::names_only();

fn read_text(text: &str) -> SceneHeader {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, format!("name = \"test\"\n{text}")).unwrap();
    std::fs::write(folder.path().join("sheet.obj"), SHEET).unwrap();
    scene::read(&file, &WHOLE).unwrap_or_else(|errors| panic!("{errors}"))
}

/// 4 m ahead, 2 m across, its lower edge 1 m below the file's origin.
const SHEET: &str = "v 10 0 -1\nv 14 0 0\nv 14 2 0\nv 10 2 -1\nf 1 2 3 4\n";

/// Two numbers that differ by roundings only.
fn assert_close(got: f64, expected: f64, scale: f64) {
    assert!((got - expected).abs() <= 4.0 * f64::EPSILON * scale, "{got} for {expected}");
}

#[test]
fn a_scene_of_a_name_alone_takes_the_documented_defaults() {
    let scene = read_text("");
    assert_eq!((scene.name.as_str(), scene.seed, scene.frames, scene.frame_interval_s), ("test", 1, 1, 0.1));
    let radar = &scene.radar;
    assert_eq!(
        (radar.position_m, radar.boresight_az_rad, radar.boresight_el_rad),
        ([0.0, 0.0, 6.0], 0.0, 0.0)
    );
    let waveform = radar.waveform;
    assert_eq!(
        (waveform.start_frequency_hz, waveform.slope_hz_per_s, waveform.sample_rate_hz),
        (77e9, 12.5e12, 5.12e6)
    );
    assert_eq!((waveform.samples, waveform.chirps, waveform.chirp_interval_s), (256, 128, 60e-6));
    assert_eq!(
        (radar.array.multiplexing, radar.array.polarization),
        (Multiplexing::Simultaneous, Polarization::Vv)
    );
    assert_eq!((&radar.array.pattern, radar.virtual_channels()), (&Pattern::Isotropic, 12));
    assert_close(radar.link.transmit_power_w, 10_f64.powf(-1.8), 0.02);
    assert_eq!(radar.link.antenna_gain_db, 10.0);
    assert_eq!(scene.noise, Noise::Absent);
    let dsp = &scene.dsp;
    assert_eq!(
        (dsp.range_window, dsp.doppler_window, dsp.false_alarm_rate),
        (Window::Hann, Window::Hann, 1e-5)
    );
    assert_eq!((dsp.guard_cells, dsp.training_cells, dsp.assumed_height_m), ([2, 2], [4, 8], 0.75));
    let lanes: Vec<_> =
        dsp.road.lanes.iter().map(|lane| (lane.number, lane.centre_m, lane.width_m)).collect();
    assert_eq!(lanes, [(1, 2.0, 3.75), (2, 5.75, 3.75), (3, 9.5, 3.75)]);
    assert_eq!(scene.intersection.width_m, 22.5);
    let fidelity = scene.fidelity;
    assert_close(fidelity.accuracy.amplitude(), 0.1, 0.1);
    assert_eq!((fidelity.bounces, fidelity.sides, fidelity.nodes), (3, Sides::Two, NodeRule::OwnEdge));
    assert_eq!((fidelity.echo, fidelity.wheels), (EchoMode::Paths, Wheels::Still));
    assert!(scene.targets.is_empty() && scene.meshes.is_empty());
}

#[test]
fn every_setting_is_taken_from_its_key() {
    let scene = read_text(
        "seed = 9\nframes = 3\nframe_interval_s = 0.5\n\
         [radar]\nposition_m = [1, 2, 3]\nboresight_az_deg = 90\nboresight_el_deg = -10\n\
         [radar.waveform]\nstart_frequency_ghz = 76\nslope_mhz_per_us = 30\nsample_rate_msps = 10\nsamples = 300\nidle_us = 5\nchirps = 64\n\
         [radar.array]\npreset = \"1x4\"\nmultiplexing = \"tdm\"\npolarization = \"hv\"\npattern = \"cosine\"\ncosine_exponent = 1.5\n\
         [radar.link]\ntransmit_power_dbm = 30\nantenna_gain_dbi = 3\n\
         [noise]\nsnr_db = 25\n\
         [dsp]\nrange_window = \"chebyshev-60\"\ndoppler_window = \"rect\"\nfalse_alarm_rate = 1e-3\nguard_cells = [1, 3]\ntraining_cells = [5, 6]\n\
         assumed_height_m = 1\nnearest_m = 0.5\ncluster_range_m = 4\ncluster_velocity_mps = 2\ncluster_cross_m = 3\n\
         [fidelity]\naccuracy_db = -40\nbounces = 2\nsides = \"one\"\nnodes = \"exit\"\necho = \"rcs-table\"\nedges = \"off\"\nsurface = \"flat\"\n\
         [intersection]\nlane_centres_m = [3.5]\nlane_width_m = 3.5\ncrossing_width_m = 10\n",
    );
    assert_eq!((scene.seed, scene.frames, scene.frame_interval_s), (9, 3, 0.5));
    assert_eq!(scene.radar.position_m, [1.0, 2.0, 3.0]);
    assert_eq!((scene.radar.boresight_az_rad, scene.radar.boresight_el_rad), (FRAC_PI_2, -PI / 18.0));
    let waveform = scene.radar.waveform;
    assert_eq!(
        (waveform.start_frequency_hz, waveform.slope_hz_per_s, waveform.sample_rate_hz),
        (76e9, 30e12, 10e6)
    );
    assert_eq!((waveform.samples, waveform.chirps, waveform.chirp_interval_s), (300, 64, 35e-6));
    let array = &scene.radar.array;
    assert_eq!((array.tx_m.len(), array.rx_m.len()), (1, 4));
    assert_eq!((array.multiplexing, array.polarization), (Multiplexing::Tdm, Polarization::Hv));
    assert_eq!(array.pattern, Pattern::Cosine { exponent: 1.5 });
    assert_eq!((scene.radar.link.transmit_power_w, scene.radar.link.antenna_gain_db), (1.0, 3.0));
    assert_eq!(scene.noise, Noise::SnrDb(25.0));
    let dsp = &scene.dsp;
    assert_eq!((dsp.range_window, dsp.doppler_window), (Window::Chebyshev(60.0), Window::Rect));
    assert_eq!((dsp.false_alarm_rate, dsp.guard_cells, dsp.training_cells), (1e-3, [1, 3], [5, 6]));
    assert_eq!((dsp.cluster_range_m, dsp.cluster_velocity_mps, dsp.cluster_cross_m), (4.0, 2.0, 3.0));
    assert_eq!((dsp.assumed_height_m, dsp.road.lanes.len(), scene.intersection.width_m), (1.0, 1, 10.0));
    assert_eq!(dsp.nearest_m, 0.5);
    assert_close(scene.fidelity.accuracy.amplitude(), 0.01, 0.01);
    assert_eq!((scene.fidelity.bounces, scene.fidelity.sides), (2, Sides::One));
    assert_eq!((scene.fidelity.nodes, scene.fidelity.echo), (NodeRule::Exit, EchoMode::RcsTable));
    let figure = read_text("[noise]\nnoise_figure_db = 12\n");
    assert_eq!(figure.noise, Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 });
}

#[test]
fn a_result_in_place_of_an_accuracy_asks_for_what_that_result_needs() {
    for goal in Goal::ALL {
        let fidelity = read_text(&format!("[fidelity]\nfor = \"{}\"\n", goal.name())).fidelity;
        assert_eq!((fidelity.goal, fidelity.accuracy), (Some(goal), goal.accuracy()));
    }
    let [unsaid, cube] = ["", "[fidelity]\nfor = \"cube\"\n"].map(|text| read_text(text).fidelity);
    assert_eq!((unsaid.goal, unsaid.accuracy), (None, cube.accuracy));
}

#[test]
fn sub_frames_are_records_of_their_own_one_after_the_other() {
    let scene = read_text(
        "frames = 3\nframe_interval_s = 0.05\n[radar.waveform]\nchirps = 64\nsub_frame_idle_us = [10, 35]\n\
         [radar.array]\nmultiplexing = \"tdm\"\n",
    );
    assert_eq!(scene.frames, 6);
    let intervals_s: Vec<f64> =
        (0..4).map(|index| scene.radar.in_frame(index).waveform.chirp_interval_s).collect();
    assert_eq!(intervals_s, [60e-6, 85e-6, 60e-6, 85e-6]);
    // Three transmitters take turns, so that the first sub-frame lasts 192 chirps.
    assert_eq!(scene::snapshot(&scene, 5).time_s, 2.0 * 0.05 + 192.0 * 60e-6);
    assert_close(scene.radar.cycle_duration_s(), 192.0 * 145e-6, 192.0 * 145e-6);
}

#[test]
fn an_accelerated_point_and_a_rolling_wheel_are_read_and_moved() {
    let scene = read_text(
        "frames = 2\n[[target]]\nkind = \"point\"\nid = \"rim\"\nrcs_m2 = 1\nposition_m = [2, 30, 0.3]\nvelocity_mps = [0, -10, 0]\n\
         acceleration_mps2 = [0, 5, 0]\nwheel_radius_m = 0.3\nwheel_angle_deg = 90\n\
         [radar.waveform]\nslope_mhz_per_us = -12.5\n",
    );
    let wheel = Some(artifact::scene::Wheel { radius_m: 0.3, angle_rad: FRAC_PI_2 });
    assert_eq!(scene.targets[0].kind, TargetKind::Point { rcs_m2: 1.0, wheel });
    assert_eq!(scene.targets[0].start.acceleration_mps2, [0.0, 5.0, 0.0]);
    let pose = scene::snapshot(&scene, 1).poses[0];
    // After 0.1 s: 30 − 1 + 0.025 m at −9.5 m/s.
    assert_close(pose.position_m[1], 29.025, 30.0);
    assert_close(pose.velocity_mps[1], -9.5, 10.0);
    assert_eq!(scene.radar.waveform.slope_hz_per_s, -12.5e12);
}

#[test]
fn errors_of_elements_and_the_converter_are_read() {
    let scene = read_text(
        "[radar.array]\npreset = \"1x4\"\nrx_gain_errors_db = [0, 1, -1, 0.5]\nrx_delays_ps = [0, 10, 20, 30]\n\
         [radar.receiver]\nadc_bits = 12\nfull_scale_dbm = -60\n",
    );
    let hardware = scene.radar.hardware;
    assert_eq!((hardware.tx.len(), hardware.rx.len()), (0, 4));
    assert_eq!((hardware.rx[1].gain_db, hardware.rx[1].phase_rad), (1.0, 0.0));
    assert_close(hardware.rx[3].delay_s, 30e-12, 30e-12);
    let adc = hardware.adc.unwrap();
    assert_eq!(adc.bits, 12);
    assert_close(adc.full_scale, 10_f64.powf(-4.5), 1e-3); // √(1 nW)
}

#[test]
fn a_stagger_is_told_as_delays_after_the_mean_interval() {
    let schedule = read_text("[radar.waveform]\nstagger_us = [9, 0, 0]\n").radar;
    assert_close(schedule.waveform.chirp_interval_s, 63e-6, 1e-4);
    for (chirp, start_s) in [0.0, 69e-6, 129e-6, 189e-6, 258e-6].into_iter().enumerate() {
        assert_close(schedule.chirp_start_s(0, chirp), start_s, 1e-3);
    }
}

#[test]
fn people_form_objects_within_shorter_distances_unless_a_scene_sets_its_own() {
    let reach = |keys: &str| {
        let dsp = read_text(&format!("[dsp]\n{keys}")).dsp;
        [dsp.cluster_range_m, dsp.cluster_velocity_mps, dsp.cluster_cross_m]
    };
    assert_eq!(reach("cluster = \"vehicles\"\n"), [2.5, 1.0, 2.5]);
    assert_eq!(reach("cluster = \"people\"\n"), [0.6, 1.0, 0.8]);
    assert_eq!(reach("cluster = \"people\"\ncluster_range_m = 1.2\n"), [1.2, 1.0, 0.8]);
    assert_eq!(reach("cluster_cross_m = 3\ncluster = \"people\"\n"), [0.6, 1.0, 3.0]);
}

#[test]
fn default_cfar_windows_shrink_to_a_small_map_and_given_ones_stay() {
    let small = read_text("[radar.waveform]\nsamples = 16\nchirps = 4\n");
    assert_eq!((small.dsp.guard_cells, small.dsp.training_cells), ([1, 2], [0, 5]));
    let given = read_text("[radar.waveform]\nsamples = 16\nchirps = 4\n[dsp]\nguard_cells = [0, 1]\n");
    assert_eq!((given.dsp.guard_cells, given.dsp.training_cells), ([0, 1], [1, 6]));
    let least = read_text("[radar.waveform]\nsamples = 8\nchirps = 1\n");
    assert_eq!((least.dsp.guard_cells, least.dsp.training_cells), ([0, 2], [0, 1]));
    // Maps that hold the guard alone give one of its cells to the noise.
    let real = "[radar.receiver]\nsampling = \"real\"\n[radar.waveform]\n";
    for (samples, chirps, window) in [
        (8, 1, ([0, 0], [0, 1])),
        (9, 2, ([0, 1], [0, 1])),
        (12, 5, ([2, 1], [0, 1])),
        (13, 4, ([1, 2], [0, 1])),
    ] {
        let small = read_text(&format!("{real}samples = {samples}\nchirps = {chirps}\n")).dsp;
        assert_eq!((small.guard_cells, small.training_cells), window, "{samples} samples, {chirps} chirps");
    }
}

/// Every sum of a transmit and a receive offset, in half wavelengths.
fn virtual_elements(scene: &SceneHeader) -> Vec<[i64; 2]> {
    let array = &scene.radar.array;
    let sum = |t: &[f64; 2], r: &[f64; 2]| [(t[0] + r[0]) as i64, (t[1] + r[1]) as i64];
    let mut sums: Vec<_> = array
        .tx_half_wavelengths
        .iter()
        .flat_map(|t| array.rx_half_wavelengths.iter().map(move |r| sum(t, r)))
        .collect();
    sums.sort_unstable();
    sums
}

#[test]
fn presets_make_the_virtual_arrays_of_the_table() {
    let row = |count: i64| (0..count).map(|i| [i, 0]).collect::<Vec<_>>();
    for (preset, elements) in [("1x1", row(1)), ("1x4", row(4)), ("3x4", row(12)), ("12x16", row(192))] {
        let scene = read_text(&format!("[radar.array]\npreset = \"{preset}\"\n"));
        assert_eq!(virtual_elements(&scene), elements, "{preset}");
    }
    let rows = read_text("[radar.array]\npreset = \"6x8\"\n");
    let grid: Vec<_> = (0..12).flat_map(|i| [0, 1, 4, 6].map(|up| [i, up])).collect();
    assert_eq!(virtual_elements(&rows), grid);
    let offsets: std::collections::BTreeSet<i64> =
        [0_i64, 1, 4, 6].iter().flat_map(|a| [0, 1, 4, 6].map(|b: i64| (a - b).abs())).collect();
    assert_eq!(offsets, (0..=6).collect(), "a Golomb ruler");
}

#[test]
fn elements_lie_half_centre_wavelengths_apart_around_the_radar() {
    let scene = read_text("");
    // λ = c/(77 GHz + 0.3125 GHz), 3.878 mm (physics of Table 2).
    let half_wavelength_m = 0.5 * 299_792_458.0 / 77.3125e9;
    for (elements, offsets) in [
        (&scene.radar.array.tx_m, vec![-4.0, 0.0, 4.0]),
        (&scene.radar.array.rx_m, vec![-1.5, -0.5, 0.5, 1.5]),
    ] {
        for (element, offset) in elements.iter().zip(offsets) {
            assert_close(element[0], offset * half_wavelength_m, half_wavelength_m);
            assert_eq!((element[1], element[2]), (0.0, 6.0));
        }
    }
}

#[test]
fn right_and_up_turn_with_the_boresight() {
    let lists = "[radar.array]\ntx_half_wavelengths = [[0, 0], [2, 0], [0, 2], [2, 2]]\nrx_half_wavelengths = [[5, 7]]\n";
    let element_pair = |turn: &str| {
        let scene = read_text(&format!("[radar]\nposition_m = [1, 2, 3]\n{turn}{lists}"));
        let centre = glam::DVec3::new(1.0, 2.0, 3.0);
        assert!(
            (glam::DVec3::from(scene.radar.array.rx_m[0]) - centre).length() < 1e-15,
            "one element is its own centre"
        );
        let tx = |i: usize| glam::DVec3::from(scene.radar.array.tx_m[i]);
        let spacing_m = scene.radar.waveform.wavelength_m();
        assert!((tx(0) + tx(3) - 2.0 * centre).length() < 1e-14);
        ((tx(1) - tx(0)) / spacing_m, (tx(2) - tx(0)) / spacing_m)
    };
    let (s, c) = (10_f64.to_radians().sin(), 10_f64.to_radians().cos());
    let cases = [
        ("", [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        // Towards +x right is −y; tilted 10° down, up leans forward.
        ("boresight_az_deg = 90\n", [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]),
        ("boresight_el_deg = -10\n", [1.0, 0.0, 0.0], [0.0, s, c]),
        ("boresight_az_deg = 90\nboresight_el_deg = 10\n", [0.0, -1.0, 0.0], [-s, 0.0, c]),
    ];
    for (turn, right, up) in cases {
        let (got_right, got_up) = element_pair(turn);
        // Coordinates of 3 m carry roundings of 4e-16 m, a spacing of 3.9 mm divides them.
        assert!((got_right - glam::DVec3::from(right)).length() < 1e-12, "{turn} {got_right}");
        assert!((got_up - glam::DVec3::from(up)).length() < 1e-12, "{turn} {got_up}");
    }
}

fn target(keys: &str) -> Pose {
    read_text(&format!("[[target]]\nid = \"t\"\n{keys}")).targets[0].start
}

#[test]
fn a_body_faces_along_its_velocity_and_down_the_lane_at_rest() {
    let yaw = |keys: &str| {
        target(&format!("kind = \"mesh\"\nmodel = \"sheet.obj\"\nposition_m = [0, 40, 0]\n{keys}")).yaw_rad
    };
    assert_eq!(yaw(""), -FRAC_PI_2);
    assert_eq!(yaw("velocity_mps = [0, 0, 1]\n"), -FRAC_PI_2);
    assert_eq!(yaw("velocity_mps = [0, -10, 0]\n"), -FRAC_PI_2);
    assert_eq!(yaw("velocity_mps = [0, 10, 0]\n"), FRAC_PI_2);
    assert_eq!(yaw("velocity_mps = [-3, 0, 0]\n"), PI);
    assert_eq!(yaw("velocity_mps = [0, -10, 0]\nyaw_deg = 30\n"), 30_f64.to_radians());
}

#[test]
fn a_lane_stands_for_its_middle_on_the_ground() {
    let position_m = target("kind = \"point\"\nrcs_m2 = 1\nlane = 3\ny_m = 25.5\n").position_m;
    assert_eq!(position_m, [9.5, 25.5, 0.0]);
}

#[test]
fn targets_keep_the_order_of_the_file_and_share_meshes() {
    let mesh = |id: &str, rest: &str| {
        format!(
            "[[target]]\nkind = \"mesh\"\nid = \"{id}\"\nposition_m = [2, 30, 0]\nmodel = \"sheet.obj\"\n{rest}"
        )
    };
    let point = "[[target]]\nkind = \"point\"\nid = \"p\"\nposition_m = [2, 30, 1]\nrcs_m2 = 0.5\n";
    let text =
        [mesh("a", "class = \"truck\"\n"), point.to_owned(), mesh("b", ""), mesh("c", "unit_scale = 0.5\n")]
            .concat();
    let scene = read_text(&text);
    let of_mesh = |class, mesh| TargetKind::Mesh { class, model: "sheet.obj".to_owned(), mesh };
    let kinds: Vec<_> =
        scene.targets.iter().map(|target| (target.id.as_str(), target.kind.clone())).collect();
    let expected = [
        ("a", of_mesh(Some(Class::Truck), 0)),
        ("p", TargetKind::Point { rcs_m2: 0.5, wheel: None }),
        ("b", of_mesh(None, 0)),
        ("c", of_mesh(None, 1)),
    ];
    assert_eq!(kinds, expected);
    assert_eq!(scene.meshes.len(), 2);
    // The centre of the bounding box, on the ground, is the origin.
    let corners: Vec<_> = scene.meshes.iter().map(|mesh| mesh.vertices_m.clone()).collect();
    assert_eq!(corners[0], [[-2.0, -1.0, 0.0], [2.0, -1.0, 1.0], [2.0, 1.0, 1.0], [-2.0, 1.0, 0.0]]);
    assert_eq!(corners[1], [[-1.0, -0.5, 0.0], [1.0, -0.5, 0.5], [1.0, 0.5, 0.5], [-1.0, 0.5, 0.0]]);
}

#[test]
fn clutter_follows_the_targets_stands_still_and_shares_meshes_of_one_size() {
    let piece =
        |id: &str, rest: &str| format!("[[clutter]]\nid = \"{id}\"\nposition_m = [12, 30, 0]\n{rest}");
    let pole = "model = \"pole\"\nheight_m = 4\n";
    let point = "[[target]]\nkind = \"point\"\nid = \"q\"\nposition_m = [2, 30, 1]\nrcs_m2 = 0.5\n";
    let kerb = "model = \"kerb\"\nlength_m = 30\nyaw_deg = 90\n";
    let text = [
        piece("a", pole),
        piece("b", kerb),
        piece("c", pole),
        piece("d", "model = \"sheet.obj\"\n"),
        point.into(),
    ];
    let scene = read_text(&text.concat());
    let of_mesh = |target: &Target| match &target.kind {
        TargetKind::Mesh { class: None, model, mesh } => Some((model.clone(), *mesh)),
        _ => None,
    };
    let told: Vec<_> = scene.targets.iter().map(|t| (t.id.as_str(), t.role, of_mesh(t))).collect();
    let mesh = |model: &str, mesh| Some((model.to_owned(), mesh));
    assert_eq!(told[0], ("q", Role::Target, None));
    assert_eq!(told[1], ("a", Role::Clutter, mesh("pole", 0)));
    assert_eq!(told[2], ("b", Role::Clutter, mesh("kerb", 1)));
    assert_eq!(told[3], ("c", Role::Clutter, mesh("pole", 0)));
    assert_eq!(told[4], ("d", Role::Clutter, mesh("sheet.obj", 2)));
    let (down, up) = (-std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2);
    let yaws: Vec<f64> = scene.targets[1..].iter().map(|t| t.start.yaw_rad).collect();
    assert_eq!(yaws, [down, up, down, down]);
    assert!(scene.targets[1..].iter().all(|t| t.start.velocity_mps == [0.0; 3]));
}

#[test]
fn a_vehicle_brings_its_class_and_a_scene_may_tell_another() {
    let mesh = |rest: &str| {
        format!(
            "[[target]]\nkind = \"mesh\"\nid = \"a\"\nposition_m = [2, 30, 0]\nmodel = \"car-suv\"\n{rest}"
        )
    };
    let class = |rest: &str| match &read_text(&mesh(rest)).targets[0].kind {
        TargetKind::Mesh { class, .. } => *class,
        TargetKind::Point { .. } => None,
    };
    assert_eq!(class(""), Some(Class::Car));
    assert_eq!(class("class = \"bus\"\n"), Some(Class::Bus));
}

#[test]
fn an_option_replaces_the_model_of_every_mesh_target() {
    let folder = tempfile::tempdir().unwrap();
    let (file, sheet) = (folder.path().join("scene.toml"), folder.path().join("sheet.obj"));
    std::fs::write(&sheet, SHEET).unwrap();
    let mesh = |id: &str| {
        format!(
            "[[target]]\nkind = \"mesh\"\nid = \"{id}\"\nposition_m = [2, 30, 0]\nmodel = \"absent-{id}.glb\"\nunit_scale = 3\n"
        )
    };
    std::fs::write(&file, format!("name = \"test\"\n{}{}", mesh("a"), mesh("b"))).unwrap();
    let options = ReadOptions { model: Some(sheet.clone()), ..ReadOptions::whole() };
    let scene = scene::read(&file, &options).unwrap();
    assert_eq!(scene.meshes.len(), 1);
    assert_eq!(
        scene.meshes[0].vertices_m[1],
        [2.0, -1.0, 1.0],
        "the scale belonged to the model that was replaced"
    );
    assert_eq!(scene::inputs(&file, &options).unwrap(), [file.clone(), sheet]);
    let absent = ["absent-a.glb", "absent-b.glb"].map(|name| folder.path().join(name));
    assert_eq!(
        scene::inputs(&file, &NAMES_ONLY).unwrap(),
        [&[file][..], &absent].concat(),
        "names are not looked up"
    );
}

#[test]
fn names_only_reads_no_model() {
    let text = "name = \"test\"\n[[target]]\nkind = \"mesh\"\nid = \"a\"\nposition_m = [2, 30, 0]\nmodel = \"absent.glb\"\n";
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, text).unwrap();
    assert!(scene::read(&file, &WHOLE).is_err());
    let scene = scene::read(&file, &NAMES_ONLY).unwrap();
    assert_eq!((scene.meshes[0].name.as_str(), scene.meshes[0].triangles.len()), ("absent.glb", 0));
}

#[test]
fn inputs_name_the_buffers_of_a_gltf() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    std::fs::write(file("car.bin"), [0]).unwrap();
    std::fs::write(
        file("car.gltf"),
        r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":1,"uri":"car.bin"}]}"#,
    )
    .unwrap();
    let target = "[[target]]\nkind = \"mesh\"\nid = \"a\"\nposition_m = [2, 30, 0]\nmodel = \"car.gltf\"\n";
    std::fs::write(file("scene.toml"), format!("name = \"test\"\n{target}")).unwrap();
    let inputs = scene::inputs(&file("scene.toml"), &WHOLE).unwrap();
    assert_eq!(inputs, ["scene.toml", "car.gltf", "car.bin"].map(file));
}

#[test]
fn inputs_report_a_missing_model_at_its_key_and_a_broken_rule_beside_a_broken_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let target = "[[target]]\nkind = \"mesh\"\nid = \"a\"\nposition_m = [2, 30, 0]\nmodel = \"a.obj\"\n";
    std::fs::write(&file, format!("name = \"test\"\n{target}")).unwrap();
    let missing = scene::inputs(&file, &WHOLE).unwrap_err();
    assert!(missing.is_system() && missing.to_string().contains(":6:9: target `a`: "), "{missing}");
    std::fs::write(folder.path().join("a.obj"), "nothing\n").unwrap();
    std::fs::write(&file, format!("name = \"test\"\nframes = 0\n{target}")).unwrap();
    assert_eq!(scene::inputs(&file, &WHOLE).unwrap_err().0.len(), 2);
}

#[test]
fn frames_follow_one_another_at_constant_velocity_and_yaw() {
    let scene = read_text(
        "frames = 4\nframe_interval_s = 0.25\n\
         [[target]]\nkind = \"point\"\nid = \"p\"\nposition_m = [2, 30, 1]\nrcs_m2 = 1\nvelocity_mps = [0, -8, 0.5]\n",
    );
    for index in 0..4 {
        let frame = snapshot(&scene, index);
        let time_s = 0.25 * f64::from(index);
        assert_eq!((frame.index, frame.time_s), (index, time_s));
        assert_eq!(frame.poses[0].position_m, [2.0, 30.0 - 8.0 * time_s, 1.0 + 0.5 * time_s]);
        assert_eq!(frame.poses[0].yaw_rad, -FRAC_PI_2);
    }
}

#[test]
fn a_pose_is_exact_to_half_a_unit_in_the_last_place_at_any_time() {
    let pose = Pose {
        position_m: [0.1, 40.0, 0.0],
        yaw_rad: 0.0,
        yaw_radps: 0.0,
        velocity_mps: [1.1, -10.3, 0.0],
        acceleration_mps2: [0.0; 3],
    };
    for time_s in [1e-9, 1.25e-7, 0.1, 0.3, 7.7, 3600.1, 1e6] {
        let got = pose_after(&pose, time_s).position_m;
        let exact = [0, 1, 2].map(|axis| exactly(pose.velocity_mps[axis], time_s, pose.position_m[axis]));
        assert_eq!(got, exact, "{time_s}");
    }
}

/// Computes a·b + c rounded once, by splitting the product into two halves that are exact (Dekker 1971) and
/// sorting the sum's rounding error out (Knuth's two-sum).
fn exactly(a: f64, b: f64, c: f64) -> f64 {
    let split = |x: f64| {
        let high = 134_217_729.0 * x - (134_217_729.0 * x - x);
        (high, x - high)
    };
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    let product = a * b;
    let product_error = ((ah * bh - product) + ah * bl + al * bh) + al * bl;
    let sum = product + c;
    let back = sum - product;
    let sum_error = (product - (sum - back)) + (c - back);
    sum + (sum_error + product_error)
}

fn scenes_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

#[test]
fn the_experiments_have_the_waveforms_of_table_2() {
    let rows = [
        ("experiment-1", 256, 0.625e9, 0.23983, 16.1570),
        ("experiment-2", 384, 0.9375e9, 0.15989, 11.3819),
        ("experiment-3", 512, 1.25e9, 0.11992, 8.7774),
    ];
    for (name, samples, bandwidth_hz, resolution_m, velocity_mps) in rows {
        let scene = scene::read(&scenes_folder().join(format!("{name}.toml")), &NAMES_ONLY).unwrap();
        let radar = &scene.radar;
        assert_eq!(
            (scene.name.as_str(), radar.waveform.samples, radar.waveform.bandwidth_hz()),
            (name, samples, bandwidth_hz)
        );
        // Half of the last digit of X1.
        assert!((radar.waveform.range_resolution_m() - resolution_m).abs() <= 0.5e-5, "{name}");
        assert!((radar.velocity_max_mps() - velocity_mps).abs() <= 0.5e-4, "{name}");
        assert!((radar.waveform.range_max_m() - 61.397).abs() <= 0.5e-3, "{name}");
        let car = &scene.targets[0];
        assert_eq!((car.start.position_m, car.start.velocity_mps), ([5.75, 40.0, 0.0], [0.0, -10.0, 0.0]));
        assert_eq!(scene.dsp.road.at(car.start.position_m), Some(2));
    }
}

#[test]
fn the_intersection_holds_one_vehicle_of_each_class_in_its_lanes() {
    let scene = scene::read(&scenes_folder().join("intersection.toml"), &NAMES_ONLY).unwrap();
    let classes: std::collections::BTreeSet<Class> = scene
        .targets
        .iter()
        .filter_map(|target| if let TargetKind::Mesh { class, .. } = target.kind { class } else { None })
        .collect();
    assert_eq!(classes, Class::ALL.into());
    assert_eq!(scene.targets.len(), 4);
    let mut lanes = std::collections::BTreeSet::new();
    for target in &scene.targets {
        let Pose { position_m, velocity_mps: [_, vy_mps, _], .. } = target.start;
        let [_, y_m, z_m] = position_m;
        lanes.insert(scene.dsp.road.at(position_m).unwrap());
        assert!((25.0..=55.0).contains(&y_m) && z_m == 0.0, "{}", target.id);
        assert!((-10.0..=-0.5).contains(&vy_mps), "{} approaches", target.id);
    }
    assert_eq!(lanes, [1, 2, 3].into());
}

#[test]
fn the_projects_scenes_read_whole() {
    for name in ["experiment-1", "experiment-2", "experiment-3", "intersection", "four-directions", "traffic"]
    {
        let file = scenes_folder().join(format!("{name}.toml"));
        let radars = scene::radars(&file).unwrap().into_iter().map(Some);
        for radar in radars.chain([None]).take_while(|radar| name != "four-directions" || radar.is_some()) {
            let scene = scene::read(&file, &ReadOptions { radar, ..WHOLE });
            let scene = scene.unwrap_or_else(|errors| panic!("{errors}"));
            assert!(scene.meshes.iter().all(|mesh| !mesh.triangles.is_empty()), "{name}");
        }
    }
}

#[test]
fn damaged_scenes_are_read_or_refused_without_panic() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let whole = std::fs::read(scenes_folder().join("intersection.toml")).unwrap();
    // Letters, digits and signs of TOML, and bytes that are no text.
    let strange = b"[]{}=.,\"'#\n\t -+_e09axn\\\xff\x00\xc3";
    let mut state = 1_u64;
    let mut below = |end: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % end
    };
    for i in 0..500 {
        let mut bytes = whole.clone();
        for _ in 0..=below(4) {
            let at = below(bytes.len());
            match below(3) {
                0 => bytes[at] = strange[below(strange.len())],
                1 => bytes.insert(at, strange[below(strange.len())]),
                _ => drop(bytes.remove(at)),
            }
        }
        std::fs::write(&file, &bytes).unwrap();
        if let Err(errors) = scene::read(&file, &NAMES_ONLY) {
            assert!(!errors.0.is_empty() && !errors.is_system(), "file {i}: {errors}");
        }
    }
}
