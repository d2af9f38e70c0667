//! Formulas of a radar that several stages compute alike, each once, with its closed-form tests. A leaf
//! beside `artifact`: stages see it, and it sees none of them.
//!
//! ```
//! use artifact::settings::Window;
//! let hann = radar::window::taper(Window::Hann, 64)?;
//! assert!((radar::window::noise_bandwidth_bins(&hann) - 1.5).abs() < 1e-12);
//! # Ok::<(), radar::window::Sidelobes>(())
//! ```

pub mod aperture; // axes, elements, mounting
pub mod assignment; // optimal association of rows and columns
pub mod beat; // phase of eq. (13), range–Doppler coupling
pub mod complex_vector; // fields with phase
pub mod doppler_ambiguity; // velocities that look alike
pub mod lattice; // grids of an array's directions
pub mod link; // link budget
pub mod motion; // of bodies
pub mod paper; // the radar of Table 2
pub mod path_kinematics; // legs of a path and their rates
pub mod path_echo; // IF value of a path
pub mod standpoint; // of an antenna around a body
pub mod window; // tapers of the FFT axes
pub mod cross_section; // of a detection, where the noise is known
