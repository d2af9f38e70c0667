//! What several stages compute of a radar alike, each formula once, with its closed-form tests. A leaf beside
//! `artifact`: stages see it, and it sees none of them.
//!
//! ```
//! use artifact::settings::Window;
//! let hann = radar::window::taper(Window::Hann, 64)?;
//! assert!((radar::window::noise_bandwidth_bins(&hann) - 1.5).abs() < 1e-12);
//! # Ok::<(), radar::window::Sidelobes>(())
//! ```

pub mod window; // tapers of the FFT axes
