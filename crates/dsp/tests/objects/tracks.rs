//! Tracks of bodies that move as the filter believes: what it says of its own errors, identities, births and
//! deaths.

use crate::common::{elements_3x4, header};
use artifact::cube::CubeHeader;
use artifact::points::{Height, Object, Point, PointsFrame};
use artifact::seed::key;
use artifact::tracks::{Track, TrackState, TracksFrame};
use dsp::Estimate;
use dsp::Site;
use dsp::{DspError, ROAD_TRAFFIC, Tracker};
use glam::{DMat4, DVec2, DVec3, DVec4};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

const INTERVAL_S: f64 = 0.1;
const UP_M: f64 = 0.75;

/// Place and velocity on the road.
#[derive(Debug, Clone, Copy)]
struct Body {
    place_m: DVec2,
    velocity_mps: DVec2,
}

impl Body {
    fn after(self, seconds: f64) -> Self {
        Self { place_m: self.place_m + seconds * self.velocity_mps, ..self }
    }
}

fn body(x: f64, y: f64, vx: f64, vy: f64) -> Body {
    Body { place_m: DVec2::new(x, y), velocity_mps: DVec2::new(vx, vy) }
}

fn radar() -> CubeHeader {
    header(256, 128, elements_3x4())
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// The object that a body makes, with errors of the variances that a tracker takes for true.
fn object(header: &CubeHeader, body: Body, random: &mut ChaCha8Rng) -> Object {
    let away = (body.place_m - DVec2::ZERO).extend(UP_M - header.radar.position_m[2]);
    let exact = Object {
        range_m: away.length(),
        radial_velocity_mps: away.dot(body.velocity_mps.extend(0.0)) / away.length(),
        velocity_resolved: true,
        azimuth_rad: away.x.atan2(away.y),
        position_m: [body.place_m.x, body.place_m.y, UP_M],
        lane: None,
        snr_db: 15.0,
        points: 1,
        range_extent_m: [away.length(); 2],
        velocity_extent_mps: [0.0; 2],
        ghost_share: None,
        stationary: None,
        height: Height::Assumed,
    };
    let variance = Site::new(&header.radar).measurement(&exact, &ROAD_TRAFFIC).variance;
    let [range, azimuth, rate] = variance.map(|v| v.sqrt() * normal(random));
    let ground_m = DVec2::new(away.x, away.y).length();
    let place =
        DVec2::from_angle(std::f64::consts::FRAC_PI_2 - exact.azimuth_rad - azimuth) * (ground_m + range);
    Object {
        range_m: exact.range_m + range,
        radial_velocity_mps: exact.radial_velocity_mps + rate,
        azimuth_rad: exact.azimuth_rad + azimuth,
        position_m: [place.x, place.y, UP_M],
        range_extent_m: [exact.range_m + range; 2],
        ..exact
    }
}

fn point(object: &Object, index: u32) -> Point {
    Point {
        range_m: object.range_m,
        radial_velocity_mps: object.radial_velocity_mps,
        azimuth_rad: object.azimuth_rad,
        elevation_rad: 0.0,
        position_m: object.position_m,
        snr_db: object.snr_db,
        object: Some(index),
        target: None,
        label: None,
        two_ways_rad: None,
        stationary: None,
        height: Height::Assumed,
    }
}

fn frame(index: u32, objects: Vec<Object>) -> PointsFrame {
    let points = objects.iter().enumerate().map(|(i, o)| point(o, i as u32)).collect();
    PointsFrame { index, time_s: f64::from(index) * INTERVAL_S, points, objects }
}

fn tracker(header: &CubeHeader) -> Tracker {
    Tracker::new(header, ROAD_TRAFFIC).expect("the radar has cells")
}

/// Straight ways of bodies over frames; `seen` says whether one is an object in a frame.
fn follow(bodies: &[Body], frames: u32, seed: u64, seen: impl Fn(usize, u32) -> bool) -> Vec<TracksFrame> {
    let (header, mut random) = (radar(), ChaCha8Rng::from_seed(key(seed, "dsp/test-tracks", &[])));
    let mut tracker = tracker(&header);
    (0..frames)
        .map(|index| {
            let now = bodies.iter().map(|b| b.after(f64::from(index) * INTERVAL_S)).enumerate();
            let objects =
                now.filter(|(i, _)| seen(*i, index)).map(|(_, b)| object(&header, b, &mut random)).collect();
            tracker.step(&frame(index, objects)).expect("frames go forward")
        })
        .collect()
}

fn believed(frame: &TracksFrame) -> Vec<&Track> {
    frame.tracks.iter().filter(|t| t.state != TrackState::Tentative).collect()
}

fn nearest(frame: &TracksFrame, body: Body) -> &Track {
    let apart = |t: &&&Track| DVec2::from(t.position_m).distance(body.place_m);
    let tracks = believed(frame);
    tracks.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("a believed track")
}

/// Normalised error squared of a track: χ² of four degrees of freedom where the filter knows its errors.
fn error2(track: &Track, truth: Body) -> f64 {
    let [x, y] = track.position_m;
    let [vx, vy] = track.velocity_mps;
    let error = DVec4::new(x, y, vx, vy)
        - DVec4::new(truth.place_m.x, truth.place_m.y, truth.velocity_mps.x, truth.velocity_mps.y);
    let covariance = DMat4::from_cols_array_2d(&track.covariance);
    error.dot(covariance.inverse() * error)
}

/// Velocity and place moved by white noise of the filter's density (the two are correlated by √¾).
fn wander(body: Body, random: &mut ChaCha8Rng) -> Body {
    let (t, q) = (INTERVAL_S, ROAD_TRAFFIC.acceleration_density);
    let mut kick = || {
        let (a, b) = (normal(random), normal(random));
        ((q * t).sqrt() * a, (q * t * t * t / 3.0).sqrt() * (0.75_f64.sqrt() * a + 0.5 * b))
    };
    let ((vx, x), (vy, y)) = (kick(), kick());
    let moved = body.after(t);
    Body { place_m: moved.place_m + DVec2::new(x, y), velocity_mps: moved.velocity_mps + DVec2::new(vx, vy) }
}

#[test]
fn normalised_errors_are_chi_squared_of_four_degrees_of_freedom() {
    const RUNS: u64 = 250;
    const FRAMES: u32 = 40;
    let header = radar();
    let (mut sums, mut counts) = ([0.0; FRAMES as usize], [0_u32; FRAMES as usize]);
    for run in 0..RUNS {
        let mut random = ChaCha8Rng::from_seed(key(run, "dsp/test-nees", &[]));
        let along = -8.0 + 3.0 * normal(&mut random);
        let mut truth = body(4.0, 45.0, ROAD_TRAFFIC.tangential_mps * normal(&mut random), along);
        let mut tracker = tracker(&header);
        for index in 0..FRAMES {
            let tracks =
                tracker.step(&frame(index, vec![object(&header, truth, &mut random)])).unwrap().tracks;
            if tracks.len() > 1 {
                println!("run {run} frame {index}: the object is outside of the gate");
                break;
            }
            sums[index as usize] += error2(&tracks[0], truth);
            counts[index as usize] += 1;
            truth = wander(truth, &mut random);
        }
    }
    // The mean of 250 values of variance 8 errs by 0.18: four times that on either side.
    let means: Vec<f64> = sums.iter().zip(counts).map(|(s, n)| s / f64::from(n)).collect();
    println!("{means:.2?}");
    // 1e-5 of 10,000 objects lie outside of the gate; more than two have a chance of 2e-4.
    assert!(counts[FRAMES as usize - 1] + 2 >= RUNS as u32, "{counts:?}");
    for index in [3, 5, 10, 20, 39] {
        assert!(
            (means[index] - 4.0).abs() < 4.0 * (8.0 / RUNS as f64).sqrt(),
            "frame {index}: {}",
            means[index]
        );
    }
}

/// Spread of asin(u + n) over normal errors n of a direction cosine, by quadrature; beyond ±1 the nearest.
fn azimuth_spread_rad(azimuth_rad: f64, cosine_sd: f64) -> f64 {
    let steps = (-4000..=4000).map(|i| 1e-3 * f64::from(i));
    let weighed = steps.map(|n| {
        let azimuth = (azimuth_rad.sin() + cosine_sd * n).clamp(-1.0, 1.0).asin();
        ((-0.5 * n * n).exp(), (azimuth - azimuth_rad).powi(2))
    });
    let (sum, weights) =
        weighed.fold((0.0, 0.0), |(s, w), (weight, square)| (s + weight * square, w + weight));
    (sum / weights).sqrt()
}

#[test]
fn an_azimuth_beside_the_boresight_errs_by_more_as_the_sine_tells_it_less() {
    let mut header = radar();
    // Variance of a tone over N elements in a row, 6/(ρ·N·(N² − 1)), of 12 of 10 dB: u = ω/π.
    let cosine_sd = (6.0 / (10.0 * 12.0 * 143.0_f64)).sqrt() / std::f64::consts::PI;
    for boresight_deg in [0.0, 40.0_f64] {
        header.radar.boresight_az_rad = boresight_deg.to_radians();
        for beside_deg in [0.0, 30.0, -60.0, 75.0, 90.0_f64] {
            let azimuth_rad = (boresight_deg + beside_deg).to_radians();
            // So far away that a body has no width.
            let place_m = 1e5 * DVec2::new(azimuth_rad.sin(), azimuth_rad.cos());
            let seen = Body { place_m, velocity_mps: DVec2::ZERO };
            let exact = Object { snr_db: 10.0, ..object(&header, seen, &mut ChaCha8Rng::from_seed([0; 32])) };
            let exact = Object { azimuth_rad, ..exact };
            let told = Site::new(&header.radar).measurement(&exact, &ROAD_TRAFFIC).variance[1].sqrt();
            let true_rad = azimuth_spread_rad(beside_deg.to_radians(), cosine_sd);
            let ratio = told / true_rad;
            // Along the row half of all errors lie beyond it.
            assert!((0.9..1.35).contains(&ratio), "{beside_deg} beside {boresight_deg}: {told} {true_rad}");
        }
    }
}

#[test]
fn bodies_that_cross_keep_their_tracks() {
    // Overtaking in the next lane; crossing in front of each other; meeting head on in neighbouring lanes.
    let pairs = [
        [body(2.0, 55.0, 0.0, -12.0), body(5.75, 45.0, 0.0, -5.0)],
        [body(-14.0, 30.0, 9.0, 0.0), body(5.75, 48.0, 0.0, -9.0)],
        [body(2.0, 20.0, 0.0, 8.0), body(5.75, 52.0, 0.0, -8.0)],
    ];
    for (case, pair) in pairs.iter().enumerate() {
        for seed in 0..20 {
            let frames = follow(pair, 30, seed, |_, _| true);
            for (i, start) in pair.iter().enumerate() {
                let [early, late] = [5_u32, 29].map(|index| {
                    nearest(&frames[index as usize], start.after(f64::from(index) * INTERVAL_S)).id
                });
                assert_eq!(early, late, "case {case}, seed {seed}, body {i}");
            }
            assert_eq!(believed(&frames[29]).len(), 2, "case {case}, seed {seed}");
        }
    }
}

#[test]
fn a_body_missed_in_one_frame_of_four_stays_one_track_that_says_when_it_coasts() {
    for seed in 0..20 {
        // A fixed pattern that misses up to two frames in a row.
        let is_seen = |_: usize, index: u32| {
            index < 4 || !(index + seed as u32).wrapping_mul(2_654_435_761).is_multiple_of(4)
        };
        let frames = follow(&[body(5.75, 50.0, 0.0, -6.0)], 50, seed, is_seen);
        for f in &frames[3..] {
            assert_eq!(f.tracks.len(), 1, "seed {seed} frame {}", f.index);
            let (track, seen) = (&f.tracks[0], is_seen(0, f.index));
            assert_eq!(
                (track.id, track.state == TrackState::Coasting),
                (0, !seen),
                "seed {seed} frame {}",
                f.index
            );
        }
    }
}

#[test]
fn a_track_is_believed_with_its_third_object_and_outlives_its_last_by_a_quarter_of_the_time_it_was_seen() {
    let frames = follow(&[body(2.0, 40.0, 0.0, -5.0)], 40, 1, |_, index| (5..20).contains(&index));
    let counts: Vec<(usize, usize)> = frames.iter().map(|f| (f.tracks.len(), believed(f).len())).collect();
    assert_eq!((counts[4], counts[5], counts[6], counts[7]), ((0, 0), (1, 0), (1, 0), (1, 1)));
    // Objects in frames 5 to 19: 1.4 s after the first, a quarter is 0.35 s.
    assert_eq!((counts[22], counts[23]), ((1, 1), (0, 0)));
    let long = follow(&[body(2.0, 55.0, 0.0, -4.0)], 80, 1, |_, index| index < 60);
    // Last object in frame 59; coasting through ten intervals but one, however long it was seen.
    assert_eq!((long[68].tracks.len(), long[69].tracks.len()), (1, 0));
    assert_eq!(frames[8].tracks[0].age_frames, 4);
    let again =
        follow(&[body(2.0, 40.0, 0.0, -5.0)], 60, 1, |_, index| (5..20).contains(&index) || index > 35);
    assert_eq!(again[40].tracks[0].id, 1, "a body that comes back after its track's death is a new one");
}

#[test]
fn a_track_that_leaves_the_radars_range_ends_at_once() {
    let frames = follow(&[body(2.0, 57.0, 0.0, 10.0)], 20, 3, |_, index| index < 4);
    // Range limit 61.4 m: reached in the fifth frame.
    assert_eq!(frames[3].tracks.len(), 1);
    assert!(frames[6].tracks.is_empty(), "{:?}", frames[6]);
}

/// Objects anywhere, as noise makes them: 0.3 a frame.
#[test]
fn objects_of_noise_are_hardly_ever_believed() {
    let (header, mut random) = (radar(), ChaCha8Rng::from_seed(key(7, "dsp/test-noise-objects", &[])));
    let mut tracker = tracker(&header);
    let mut uniform = move || {
        use rand::Rng;
        f64::from(random.next_u32()) / 2f64.powi(32)
    };
    let mut ever = std::collections::BTreeSet::new();
    for index in 0..1000 {
        let is_there = uniform() < 0.3;
        let place = DVec2::new(60.0 * uniform() - 30.0, 60.0 * uniform());
        let rate = 30.0 * uniform() - 15.0;
        let range_m = place.length().max(8.0);
        let lone = Object {
            range_m,
            radial_velocity_mps: rate,
            velocity_resolved: false,
            azimuth_rad: place.x.atan2(place.y),
            position_m: [place.x, place.y, UP_M],
            lane: None,
            snr_db: 8.0,
            points: 2,
            range_extent_m: [range_m; 2],
            velocity_extent_mps: [rate; 2],
            ghost_share: None,
            stationary: None,
            height: Height::Assumed,
        };
        let tracks = tracker.step(&frame(index, if is_there { vec![lone] } else { vec![] })).unwrap();
        ever.extend(believed(&tracks).iter().map(|t| t.id));
    }
    println!("{} believed of 300 objects", ever.len());
    // A second object within a new track's gate (about 5 m × 5 m/s × 0.3 rad of 60 m × 30 m/s × 3 rad, in
    // four frames of 0.3 objects) follows 1e-3 of them, a third fewer still.
    assert!(ever.len() <= 1, "{ever:?}");
}

#[test]
fn an_aliased_velocity_is_told_by_the_range_after_some_frames_and_the_track_says_when() {
    let mut header = radar();
    header.radar.waveform.chirp_interval_s = 161e-6;
    let span_mps = 2.0 * header.radar.velocity_max_mps();
    for (seed, along_mps) in [-20.0, -10.0, -3.0, 4.0, 15.0, 25.0].into_iter().enumerate() {
        let mut random = ChaCha8Rng::from_seed(key(seed as u64, "dsp/test-folds", &[]));
        let start = body(2.0, if along_mps < 0.0 { 58.0 } else { 10.0 }, 0.0, along_mps);
        let mut tracker = tracker(&header);
        let tracks: Vec<Track> = (0..15)
            .map(|index| {
                let mut seen = object(&header, start.after(f64::from(index) * INTERVAL_S), &mut random);
                let exact_mps = seen.radial_velocity_mps;
                seen.radial_velocity_mps -= span_mps * (exact_mps / span_mps).round();
                // The map shows the range with the coupling of the true velocity, points with that of the
                // folded one.
                let w = &header.radar.waveform;
                let coupling = w.centre_frequency_hz() / w.slope_hz_per_s;
                seen.range_m += coupling * (exact_mps - seen.radial_velocity_mps);
                seen.velocity_resolved = false;
                tracker.step(&frame(index, vec![seen])).unwrap().tracks[0].clone()
            })
            .collect();
        let told = tracks.iter().position(|t| t.velocity_resolved).expect("resolved in 1.5 s");
        println!("{along_mps} m/s of a span of {span_mps:.1}: resolved in frame {told}");
        assert!(told > 0, "one frame cannot tell");
        for track in &tracks[told..] {
            assert!(
                (track.velocity_mps[1] - along_mps).abs() < 0.5 * span_mps,
                "{along_mps}: {:?}",
                track.velocity_mps
            );
        }
    }
}

#[test]
fn pieces_of_a_long_body_are_one_track_and_a_queue_is_many() {
    let (header, mut random) = (radar(), ChaCha8Rng::from_seed(key(2, "dsp/test-pieces", &[])));
    // A bus that is one object with points over 11 m, and every fourth frame two.
    let mut tracker = tracker(&header);
    let mut last = None;
    for index in 0..24 {
        let ends = [30.0, 41.0]
            .map(|y| object(&header, body(5.75, y, 0.0, -4.0).after(f64::from(index) * 0.1), &mut random));
        let seen = if index % 4 == 3 {
            frame(index, ends.to_vec())
        } else {
            let mut whole = frame(index, vec![ends[0]]);
            whole.points.push(point(&ends[1], 0));
            whole
        };
        last = Some(tracker.step(&seen).unwrap());
    }
    let tracks = last.unwrap();
    assert_eq!((tracks.tracks.len(), tracks.tracks[0].objects.len()), (1, 2), "{tracks:#?}");
    let queue: Vec<Body> = (0..4).map(|i| body(5.75, 25.0 + 7.0 * f64::from(i), 0.0, 0.0)).collect();
    let frames = follow(&queue, 20, 5, |_, _| true);
    assert_eq!(believed(&frames[19]).len(), 4);
}

#[test]
fn the_box_lies_along_the_way_and_reaches_over_the_points() {
    let (header, mut random) = (radar(), ChaCha8Rng::from_seed(key(3, "dsp/test-box", &[])));
    let mut tracker = tracker(&header);
    let mut last = None;
    for index in 0..20 {
        let now = body(5.75, 50.0, 0.0, -8.0).after(f64::from(index) * INTERVAL_S);
        let mut seen = frame(index, vec![object(&header, now, &mut random)]);
        let own = seen.points[0];
        for along in [-1.5, 0.0, 3.5] {
            seen.points.push(Point { position_m: [now.place_m.x, now.place_m.y + along, UP_M], ..own });
        }
        last = Some((now, tracker.step(&seen).unwrap()));
    }
    let (now, tracks) = last.unwrap();
    let track = &tracks.tracks[0];
    let cell_m = header.radar.waveform.range_resolution_m();
    println!("{:?}", track.footprint);
    assert!((track.footprint.heading_rad + std::f64::consts::FRAC_PI_2).abs() < 0.1);
    // Points reach over 5 m and stand a cell beyond the body at either end; the filter's own place errs by
    // 0.1 m, and an end comes back slowly.
    assert!((track.footprint.length_m - (5.0 - 2.0 * cell_m)).abs() < 0.4, "{:?}", track.footprint);
    let middle = DVec2::from(track.footprint.centre_m);
    assert!((middle.y - (now.place_m.y + 1.0)).abs() < 0.4, "{middle} {now:?}");
    assert_eq!(track.lane, Some(2));
}

/// A body too slow to have a heading of its own has the road's: ψ = 90° − azimuth away from the radar, the
/// opposite towards it, within half a turn of +x.
#[test]
fn a_new_tracks_heading_is_the_roads_whichever_way_the_road_runs() {
    for (azimuth_deg, along_mps) in [0.0, 45.0, 90.0, 135.0, 180.0, -45.0, -90.0, -135.0]
        .into_iter()
        .flat_map(|azimuth_deg| [(azimuth_deg, 0.8), (azimuth_deg, -0.8)])
    {
        let mut header = radar();
        header.radar.boresight_az_rad = f64::to_radians(azimuth_deg);
        header.dsp.road.azimuth_rad = f64::to_radians(azimuth_deg);
        let away = DVec2::new(f64::to_radians(azimuth_deg).sin(), f64::to_radians(azimuth_deg).cos());
        let receding = Body { place_m: 30.0 * away, velocity_mps: along_mps * away };
        let mut random = ChaCha8Rng::from_seed(key(1, "dsp/test-heading", &[]));
        let seen = frame(0, vec![object(&header, receding, &mut random)]);
        let heading_rad = tracker(&header).step(&seen).unwrap().tracks[0].footprint.heading_rad;
        let told = DVec2::from_angle(heading_rad);
        assert!(told.distance(away * along_mps.signum()) < 1e-12, "road {azimuth_deg}°: {told}");
        assert!(heading_rad.abs() <= std::f64::consts::PI, "road {azimuth_deg}°: {heading_rad}");
    }
}

/// One point of a car that comes along the line of sight: it is the front, and the car is behind it.
#[test]
fn what_of_a_car_is_not_seen_lies_behind_what_is() {
    let towards = body(0.0, 45.0, 0.0, -8.0);
    let frames = follow(&[towards], 20, 4, |_, _| true);
    let (now, footprint) = (towards.after(19.0 * INTERVAL_S), frames[19].tracks[0].footprint);
    println!("{footprint:?} of {now:?}");
    assert!((footprint.length_m - 4.0).abs() < 1e-12);
    // Half a car behind the point; the filter's own place errs by 0.1 m, and along by the cell that it takes
    // points to be spread.
    assert!((footprint.centre_m[1] - (now.place_m.y + 2.0)).abs() < 0.4);
}

#[test]
fn the_same_objects_give_the_same_tracks() {
    let bodies: Vec<Body> =
        (0..5).map(|i| body(2.0 + f64::from(i), 20.0 + 6.0 * f64::from(i), 0.0, -3.0)).collect();
    let run = || follow(&bodies, 25, 9, |i, index| !(i as u32 + index).is_multiple_of(5));
    assert_eq!(run(), run());
}

#[test]
fn frames_that_do_not_go_forward_and_objects_that_are_not_finite_are_refused() {
    let (header, mut random) = (radar(), ChaCha8Rng::from_seed(key(1, "dsp/test-bad", &[])));
    let good = object(&header, body(2.0, 30.0, 0.0, -3.0), &mut random);
    let mut tracker = tracker(&header);
    tracker.step(&frame(1, vec![good])).unwrap();
    assert!(matches!(tracker.step(&frame(1, vec![good])), Err(DspError::FrameTime { .. })));
    assert!(matches!(tracker.step(&frame(0, vec![])), Err(DspError::FrameTime { .. })));
    let bad = Object { azimuth_rad: f64::NAN, ..good };
    assert_eq!(tracker.step(&frame(2, vec![bad])), Err(DspError::ObjectNotFinite { quantity: "azimuth" }));
    let mut empty = header.clone();
    empty.radar.array.rx_m.clear();
    assert!(Tracker::new(&empty, ROAD_TRAFFIC).is_err());
}

fn any_object() -> impl Strategy<Value = Object> {
    let number = || prop_oneof![-100.0_f64..100.0, Just(0.0), Just(1e12), Just(-1e12), Just(1e-300)];
    (
        number(),
        number(),
        number(),
        [number(), number(), number()],
        number(),
        [number(), number()],
        any::<bool>(),
    )
        .prop_map(|(range_m, rate, azimuth_rad, position_m, snr_db, extent, velocity_resolved)| Object {
            range_m,
            radial_velocity_mps: rate,
            velocity_resolved,
            azimuth_rad,
            position_m,
            lane: None,
            snr_db,
            points: 0,
            range_extent_m: extent,
            velocity_extent_mps: [rate, extent[1]],
            ghost_share: None,
            stationary: None,
            height: Height::Assumed,
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn whatever_the_objects_tracks_are_finite_and_nothing_panics(
        frames in prop::collection::vec(prop::collection::vec(any_object(), 0..5), 1..12)
    ) {
        let header = radar();
        let mut tracker = tracker(&header);
        for (index, objects) in frames.into_iter().enumerate() {
            let tracks = tracker.step(&frame(index as u32, objects)).unwrap();
            for track in &tracks.tracks {
                let mut numbers = track.position_m.iter().chain(&track.velocity_mps);
                prop_assert!(numbers.all(|v| v.is_finite()), "{:?}", track);
            }
        }
    }
}

/// Derivatives of the extended filter are what differences say.
#[test]
fn an_exact_measurement_moves_the_state_to_the_truth() {
    let (header, truth) = (radar(), body(3.0, 35.0, 2.0, -9.0));
    let mut random = ChaCha8Rng::from_seed(key(4, "dsp/test-exact", &[]));
    let mut exact = object(&header, truth, &mut random);
    let away = DVec3::new(3.0, 35.0, UP_M - 6.0);
    exact.range_m = away.length();
    exact.azimuth_rad = away.x.atan2(away.y);
    exact.radial_velocity_mps = away.dot(DVec3::new(2.0, -9.0, 0.0)) / away.length();
    let mut measured = Site::new(&header.radar).measurement(&exact, &ROAD_TRAFFIC);
    measured.variance = [1e-18; 3];
    // A millimetre and a mm/s off: what is left is second order, 1e-6/35 m.
    let mean = DVec4::new(3.001, 34.999, 2.001, -9.001);
    let near = Estimate { mean, covariance: DMat4::from_diagonal(DVec4::splat(1e-6)) };
    let got = measured.updated(&near).estimate.mean;
    println!("{got}");
    assert!((got.x - 3.0).abs() < 1e-6 && (got.y - 35.0).abs() < 1e-6);
    let rate = away.dot(DVec3::new(got.z, got.w, 0.0)) / away.length();
    assert!((rate - exact.radial_velocity_mps).abs() < 1e-6, "{rate}");
}
