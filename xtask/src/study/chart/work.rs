//! Work that the methods are given to do, and how it is measured.

use crate::study::bodies::{self, Face};
use crate::study::extent::Extent;
use artifact::scene::Mesh;
use std::time::Instant;
use wayside::host::failure::Failure;
use wayside::host::memory;

/// The body that all look at.
pub(super) struct Subject {
    pub(super) name: String,
    pub(super) body: Mesh,
    pub(super) azimuth_deg: f64,
    pub(super) elevation_deg: f64,
    pub(super) range_m: f64,
    /// Samples and rays along a wavelength.
    pub(super) densities: &'static [f64],
    /// Samples of the reference of beams at first order, rays of that at higher orders, along a wavelength.
    pub(super) fine_samples: f64,
    pub(super) fine_rays: f64,
    /// Paths of the echo's two forms.
    pub(super) echo_paths: usize,
    /// Chirps between two tracings of the echo's reference.
    pub(super) retraced_chirps: u32,
}

impl Subject {
    pub(super) fn of(extent: Extent) -> Result<Self, Failure> {
        match extent {
            Extent::Quick => Ok(Self::corner()),
            Extent::Full => Self::car(),
        }
    }

    /// A trihedral of 0.1 m with a cube of 3 cm in it: shadows and three bounces.
    fn corner() -> Self {
        let cube = bodies::shifted(bodies::cube(0.03, &Face::ALL), [0.06, 0.05, 0.02]);
        Self {
            name: "trihedral 0.1 m with a cube of 3 cm, 30 m".into(),
            body: bodies::joined(bodies::square_trihedral(0.1), &cube),
            azimuth_deg: 40.0,
            elevation_deg: 30.0,
            range_m: 30.0,
            densities: &[1.0, 2.0, 4.0, 8.0],
            fine_samples: 20.0,
            fine_rays: 40.0,
            echo_paths: 300,
            retraced_chirps: 16,
        }
    }

    fn car() -> Result<Self, Failure> {
        let body = scene::vehicles::mesh("car-suv", 0);
        Ok(Self {
            name: "car-suv, 30 m".into(),
            body: body.ok_or_else(|| Failure::refused("`car-suv` is missing"))?,
            azimuth_deg: 23.0,
            elevation_deg: 9.0,
            range_m: 30.0,
            densities: &[1.0, 2.0, 4.0],
            fine_samples: 10.0,
            fine_rays: 16.0,
            echo_paths: 5000,
            retraced_chirps: 16,
        })
    }
}

/// A result with what it took.
pub(super) struct Measured<T> {
    pub(super) value: T,
    pub(super) seconds: f64,
    pub(super) peak_mib: Option<f64>,
}

/// Does the work once; the peak is that of the whole program while it lasts.
pub(super) fn measured<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<Measured<T>, Failure> {
    let is_fresh = forget_peak();
    let start = Instant::now();
    let value = work()?;
    let seconds = start.elapsed().as_secs_f64();
    Ok(Measured { value, seconds, peak_mib: if is_fresh { memory::peak_mib() } else { None } })
}

/// Lets the system count the largest resident size anew (`proc(5)`, clear_refs, 5); false where it cannot.
fn forget_peak() -> bool {
    std::fs::write("/proc/self/clear_refs", "5").is_ok()
}
