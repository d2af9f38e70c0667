//! Radar formulas shared by several stages, each implemented once and tested against closed forms. A leaf
//! crate beside `artifact`: the stages depend on it, not vice versa.
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
pub mod complex_vector; // complex field vectors
pub mod doppler_ambiguity; // indistinguishable velocities
pub mod lattice; // grids of an array's directions
pub mod link; // link budget
pub mod motion; // motion of bodies
pub mod paper; // the radar of Table 2
pub mod path_kinematics; // legs of a path and their rates
pub mod path_echo; // IF value of a path
pub mod standpoint; // position of an antenna relative to a body
pub mod window; // tapers of the FFT axes
pub mod cross_section; // RCS of a detection with known noise
