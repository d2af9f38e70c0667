//! Signal processing of radar cubes: range-Doppler maps, detections, located points, objects, and crops for a
//! classifier.
//!
//! Inputs are a [`CubeHeader`](artifact::cube::CubeHeader) (the radar and the settings of its processing) and
//! [`CubeFrame`](artifact::cube::CubeFrame)s (IF samples `[channel, chirp, sample]`, √W). Neither contains
//! truth, so the outputs contain none.
//!
//! A [`Receiver`] is constructed from a header, which it checks, and then processes frames:
//!
//! - [`Receiver::range_doppler`]: the map of every transmit–receive pair `[channel, doppler, range]`, zero
//!   velocity at N/2, and the cells tested and detected by the requested CFAR (CA, GO, SO or OS)
//!   ([`RdmFrame`](artifact::rdm::RdmFrame));
//! - [`Receiver::detect`], or [`Receiver::detect_refined`] if the samples are available: points with range,
//!   radial velocity, azimuth, elevation and world position, and the objects that they form
//!   ([`PointsFrame`](artifact::points::PointsFrame)); [`Receiver::process`] does both,
//!   [`Receiver::resolved`] resolves the velocities of a cycle's sub-frames from each other;
//! - [`Receiver::cropper`]: 24 m × 8 m/s around an object on the map beamformed to it, 451 × 451 grey levels
//!   in fixed decibels above the noise, as input of a classifier; [`Receiver::signatures`]: the object's echo
//!   along range;
//! - [`objects_of_points`]: objects from points located by another program or radar;
//! - [`Tracker`]: vehicles tracked over frames, with identity, velocity, box and lane
//!   ([`TracksFrame`](artifact::tracks::TracksFrame));
//! - [`power_map`], [`rdm_grayscale`], [`range_axis_m`], [`velocity_axis_mps`], [`noise_power`]: tools for
//!   drawing or measuring a map.
//!
//! Signs, axes and units are those of `docs/conventions.md`. A growing range is a positive velocity; a target
//! on the + side of the array has a positive direction cosine. Every fault of an input is a [`DspError`];
//! nothing panics.
//!
//! The modules are listed in reading order; each uses only those before it.
//!
//! ```
//! use artifact::cube::{CubeFrame, CubeHeader};
//! use artifact::settings::{DspSettings, Lane, Lanes, Noise};
//! use num_complex::Complex32;
//! use radar::{aperture::Preset, paper};
//!
//! let waveform = paper::waveform(256, 64);
//! let radar = paper::radar([0.0, 0.0, 6.0], waveform, Preset::OneByFour.elements());
//! let road = Lanes { lanes: vec![Lane { number: 2, centre_m: 5.75, width_m: 3.75 }], ..Lanes::default() };
//! let (noise, dsp) = (Noise::Absent, DspSettings { road, ..paper::processing() });
//! let header = CubeHeader { radar, noise, dsp, unit: Default::default() };
//!
//! // A point at 40 m in lane 2 (u = 5.75/40), approaching at 10 m/s: phases of eq. (13).
//! let (range_m, velocity_mps, u) = (40.0, -10.0, 5.75 / 40.0);
//! let cycles = |rx: i32, chirp: i32, sample: i32| {
//!     let time_s = f64::from(sample) / 5.12e6;
//!     let delay_s = 2.0 * (range_m + velocity_mps * (f64::from(chirp) * 60e-6 + time_s)) / 299_792_458.0;
//!     77e9 * delay_s + 12.5e12 * (time_s * delay_s - 0.5 * delay_s * delay_s) - 0.5 * f64::from(rx) * u
//! };
//! let phase_rad = |i: i32| std::f64::consts::TAU * cycles(i / 256 / 64, i / 256 % 64, i % 256).fract();
//! let samples = (0..4 * 64 * 256).map(|i| Complex32::from_polar(1e-6, phase_rad(i) as f32)).collect();
//! let frame = CubeFrame { index: 0, time_s: 0.0, samples, error: Default::default() };
//!
//! let receiver = dsp::Receiver::new(&header)?;
//! let (map, seen) = receiver.process(&frame)?;
//! let object = seen.objects[0];
//! assert_eq!((seen.objects.len(), object.lane), (1, Some(2)));
//! assert!((object.range_m - 40.0).abs() < 0.05 && (object.radial_velocity_mps + 10.0).abs() < 0.02);
//! let crop = receiver.cropper(&map, &dsp::PAPER_CROP)?.crop(&object)?;
//! assert_eq!(crop.pixels.len(), 451 * 451);
//! # Ok::<(), dsp::DspError>(())
//! ```

mod error; // errors of inputs
mod numerics; // mathematics independent of radar
mod spectrum; // samples to maps
mod detection; // cells that contain echoes
mod direction; // directions and positions
mod plan; // data shared by all frames of a radar
mod estimation; // isolated echoes, on the samples
mod ambiguity; // velocity folds
mod objects; // points and objects
mod tracking; // objects over frames
mod crops; // input of a classifier
mod receiver; // the stage: all of the above for one radar

pub use ambiguity::time_division_folds::least_loss;
pub use crops::crop::{Cropper, PAPER_CROP};
pub use crops::grayscale::rdm_grayscale;
pub use crops::signature::Signatures;
pub use detection::cfar;
pub use detection::range_doppler::has_noise;
pub use direction::angle;
pub use direction::calibration::mean_errors;
pub use direction::multipath_ghost::multipath_ghost;
pub use direction::point_sources::{Source, least_errors, sources};
pub use error::{Axis, DspError};
pub use estimation::cramer_rao::cramer_rao;
pub use numerics::incomplete_gamma::gamma_tail;
pub use objects::foreign_points::objects_of_points;
pub use objects::stationary::{FoldCertainty, is_at_rest, tolerance_mps};
pub use receiver::Receiver;
pub use spectrum::axes::{range_axis_m, velocity_axis_mps};
pub use spectrum::inverse_transform::InverseRangeDoppler;
pub use spectrum::map_transform::RangeDoppler;
pub use spectrum::noncoherent::{noise_power, power_map};
pub use spectrum::window;
pub use tracking::kalman::Estimate;
pub use tracking::measurement::Site;
pub use tracking::tracker_settings::ROAD_TRAFFIC;
pub use tracking::tracks::Tracker;
