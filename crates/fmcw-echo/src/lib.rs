//! FMCW echoes of scattering paths on an antenna array.
//!
//! Input are the scattering paths of a frame ([`artifact::paths`]), output is the radar cube
//! ([`artifact::cube`]): one complex IF sample in √W for every channel, chirp and sample, receiver noise
//! included. A path has its own exact delay to every element at every instant while the body moves; its IF
//! value is eq. (13) of the paper with the amplitude of the radar equation applied once. Signs, axes and
//! units are those of `docs/conventions.md`.
//!
//! There are three implementations of the sum: [`mod@reference`] evaluates the formulas for each sample,
//! [`direct_sum`] advances the phase of a chirp by a quadratic recurrence, and [`fast_sum`] transforms all
//! tones at once to a requested accuracy, a hundred times faster, and is used by [`Synthesizer::frame`].
//! [`Synthesizer::frame_of_tables`] is the paper's alternative, far-field tables over aspect and frequency
//! ([`rcs_table`]).
//!
//! Reading order: [`multiplexing`] (transmissions that make a row of the cube), `radar::link` (radar
//! equation, pattern), [`mod@reference`], [`direct_sum`], [`fast_sum`], [`rcs_table`], [`ground`] (paths of
//! the road itself), [`oscillator`] and [`phase_noise`], then noise: [`noise`], [`snr_reference`];
//! [`interference`] and [`adc`] come last.
//!
//! The phase of a point target that recedes at 10 m/s turns by 4π·v·T_c/λ from chirp to chirp:
//!
//! ```
//! use artifact::cube::CubeHeader;
//! use artifact::paths::{Path, PathsFrame};
//! use artifact::settings::Noise;
//! use num_complex::Complex64;
//! use radar::{aperture::Preset, paper};
//!
//! let radar = paper::radar([0.0, 0.0, 6.0], paper::waveform(256, 4), Preset::OneByOne.elements());
//! let one = [[Complex64::ONE, Complex64::ZERO], [Complex64::ZERO, Complex64::ONE]];
//! let reflector = Path::of_point([0.0, 40.0, 6.0], [0.0, 10.0, 0.0], one);
//! let frame = PathsFrame { paths: vec![reflector], ..PathsFrame::default() };
//! let accuracy = artifact::Accuracy::from_db(-60.0);
//! let (noise, dsp) = (Noise::Absent, paper::processing());
//! let header = CubeHeader { radar, noise, dsp, unit: Default::default() };
//!
//! let cube = fmcw_echo::Synthesizer::new(&header, 1, accuracy, vec![])?.frame(&frame, &|_share_done| ())?;
//!
//! let middle_of_chirp = |chirp: usize| cube.samples[chirp * 256 + 128];
//! let turn_rad = (middle_of_chirp(1) * middle_of_chirp(0).conj()).arg();
//! assert!((turn_rad - 1.944).abs() < 1e-3);
//! // Measured against the reference form; most of it is storage in f32.
//! assert!(cube.error.synthesis < Some(1e-7));
//! # Ok::<(), fmcw_echo::EchoError>(())
//! ```

mod error; // refusals and their locations
mod links; // transmissions, levels
mod impairments; // noise, oscillators, elements, converters, other radars
mod sums; // three implementations of the sum over paths
mod sources; // tables, and the road
mod synthesis; // a frame of samples

pub use error::EchoError;
pub use impairments::{adc, element_errors, interference, noise, oscillator};
pub use links::{multiplexing, snr_reference};
pub use sources::{ground, rcs_table};
pub use sums::fast::fast_sum;
pub use sums::{direct_sum, reference};
pub use synthesis::phase_noise;
pub use synthesis::synthesizer::{Progress, Synthesizer, memory_estimate_bytes, sum_accuracy};
