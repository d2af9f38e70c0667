//! Plan of a frame's paths: the tracing parameters fixed by the scene's header.

use crate::beams::beam::TraceSettings;
use crate::bodies::body_gains::BodyGains;
use crate::edges::lit_edge::tree_order_with;
use crate::frame::array_positions::{ArrayRow, checked_from_m};
use crate::frame::path_sum::{PathView, Reception};
use crate::run_control::progress::Progress;
use crate::surface::skin::remaining_share;
use crate::table::order_joints::JointSettings;
use artifact::Waveform;
use artifact::paths::Amplitude;
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::settings::Fidelity;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Maximum number of nodes along one axis from which a frame of rigid bodies is blended (`frame/blends.rs`).
pub const MOMENTS_MAX: u32 = 33;

/// Number of moments of a frame assumed before it is known how few suffice.
pub(crate) const MOMENTS_USUAL: u32 = 9;

/// Number of paths of a frame from which no finer table is tried, of cells or of moments: 0.9 GB of them, in
/// three or four copies while they are measured.
pub(crate) const PATHS_MAX: usize = 2_000_000;

/// Whether a frame with these numbers of moments and paths may have had too many paths for a finer grid of
/// moments to be tried: if all of them were variable, they would exceed the limit.
pub fn paths_are_at_limit(moments: u32, paths: u64) -> bool {
    let finer = if moments == 1 { MOMENTS_USUAL } else { 2 * moments - 1 };
    moments < MOMENTS_MAX && paths / u64::from(moments) * u64::from(finer) > PATHS_MAX as u64
}

/// Maximum number of steps between moments of a frame with rotating wheels.
pub(crate) const WHEEL_STEPS: u32 = 96;

/// Plan of a frame's paths, from its header.
pub(crate) struct Plan<'a> {
    pub(crate) header: &'a SceneHeader,
    pub(crate) position_m: DVec3,
    pub(crate) band: SampledBand,
    pub(crate) trace: TraceSettings,
    /// Times after the frame's first sample at which paths are traced and checked.
    pub(crate) middle_s: f64,
    pub(crate) check_s: f64,
    /// Positions of the transmitter and the receiver of the check.
    pub(crate) check_ends_m: [DVec3; 2],
    /// Positions of a second pair, for a wide array, and its time.
    pub(crate) second_check: Option<([DVec3; 2], f64)>,
    /// Row along which the array's pairs of elements lie.
    pub(crate) row: ArrayRow,
    /// Gains towards the bodies: errors are those of the received echo.
    pub(crate) gains: BodyGains,
    /// Receiver of the frame's progress.
    pub(crate) progress: &'a dyn Progress,
}

impl<'a> Plan<'a> {
    pub(crate) fn of(header: &'a SceneHeader, frame: &SceneFrame, progress: &'a dyn Progress) -> Self {
        let band = SampledBand::of(&header.radar.waveform);
        let middle_s = header.radar.frame_middle_s();
        let fidelity = &header.fidelity;
        // Slivers below λ²/100·accuracy are dropped (physics.md §2), mirrors below a hundred times that are
        // not followed.
        let least_area_m2 = 1e-2 * band.wavelength_m().powi(2) * fidelity.accuracy.amplitude();
        let trace = TraceSettings {
            max_order: tree_order_with(fidelity.edges, fidelity.bounces, fidelity.nodes),
            sides: fidelity.sides,
            least_area_m2,
            least_mirror_area_m2: 100.0 * least_area_m2,
        };
        let check_offset_s = check_offset_s(header.radar.frame_duration_s());
        let check_s = middle_s + check_offset_s;
        let position_m = DVec3::from_array(header.radar.position_m);
        let (check_ends_m, second) = checked_from_m(&header.radar, &frame.poses, [middle_s, check_s]);
        let second_check = second.map(|ends_m| (ends_m, middle_s - check_offset_s));
        let row = ArrayRow::of(&header.radar);
        let gains = BodyGains::default();
        Self {
            header,
            position_m,
            band,
            trace,
            middle_s,
            check_s,
            check_ends_m,
            second_check,
            row,
            gains,
            progress,
        }
    }

    /// Plan of a radar with these gains towards the bodies.
    pub(crate) fn with_gains(self, gains: BodyGains) -> Self {
        Self { gains, ..self }
    }

    /// Relative amplitude error allowed for the frame's paths: what the approximation of a skin by facets
    /// leaves of the requested accuracy.
    pub(crate) fn allowed_error(&self) -> f64 {
        let Fidelity { accuracy, surface, .. } = self.header.fidelity;
        remaining_share(surface) * accuracy.amplitude()
    }

    /// Element of a 2 × 2 amplitude in the radar's polarization, to which errors refer.
    pub(crate) fn polarization_element(&self, amplitude: &Amplitude) -> Complex64 {
        let (receive, transmit) = self.header.radar.array.polarization.indices();
        amplitude[receive][transmit]
    }

    /// Part of paths that the radar receives.
    pub(crate) fn reception(&self) -> Reception<'_> {
        Reception { element: self.header.radar.array.polarization.indices(), gains: &self.gains }
    }

    /// Settings of the meetings: which parts of the bodies scatter.
    pub(crate) fn meetings(&self) -> JointSettings {
        let Fidelity { nodes, edges, .. } = self.header.fidelity;
        let wavenumber_per_m = TAU / self.band.wavelength_m();
        JointSettings { nodes, edges, least_area_m2: self.trace.least_area_m2, wavenumber_per_m }
    }

    /// Vector ĥ straight above and below the radar: to the left of its boresight.
    pub(crate) fn zenith_h(&self) -> DVec3 {
        let azimuth_rad = self.header.radar.boresight_az_rad;
        DVec3::new(-azimuth_rad.cos(), azimuth_rad.sin(), 0.0)
    }

    /// Position and time at which paths are summed; R_t and R_r are about 1 m, since only ratios matter.
    pub(crate) fn view(&self, seconds: f64) -> PathView {
        self.view_from([self.position_m; 2], seconds)
    }

    /// Pairs of elements whose mean power represents the array's. For flat plates the cross polarization
    /// consists only of the rotation of a wave from one element to another, which vanishes at the array's
    /// centre: there the pairs of both checks are used, whose distance from it is about the root mean square
    /// over all.
    pub(crate) fn pairs_of_array_m(&self) -> Vec<[DVec3; 2]> {
        match self.second_check {
            Some((second_m, _)) if self.is_cross_polarized() => vec![self.check_ends_m, second_m],
            _ => vec![[self.position_m; 2]],
        }
    }

    /// Whether the received polarization differs from the transmitted one.
    pub(crate) fn is_cross_polarized(&self) -> bool {
        self.header.radar.array.polarization.is_crossed()
    }

    /// Midpoint of the positions of the check.
    pub(crate) fn check_middle_m(&self) -> DVec3 {
        0.5 * (self.check_ends_m[0] + self.check_ends_m[1])
    }

    /// Moment and position of the check.
    pub(crate) fn check_view(&self) -> PathView {
        self.view_from(self.check_ends_m, self.check_s)
    }

    /// View from positions of the transmitter and the receiver at a time.
    pub(crate) fn view_from(&self, [transmitter_m, receiver_m]: [DVec3; 2], seconds: f64) -> PathView {
        PathView {
            transmitter_m,
            receiver_m,
            origin_m: self.position_m + DVec3::Y,
            seconds,
            centre_frequency_hz: self.band.centre_hz,
        }
    }
}

/// Sampled sweep: amplitudes are taken at the Chebyshev points of its band, where the linear fit errs least.
pub(crate) struct SampledBand {
    pub(crate) centre_hz: f64,
    pub(crate) bandwidth_hz: f64,
    /// Frequency offset from the centre to the outer points.
    offset_hz: f64,
}

impl SampledBand {
    pub(crate) fn of(waveform: &Waveform) -> Self {
        let half_hz = 0.5 * waveform.bandwidth_hz().abs();
        Self {
            centre_hz: waveform.centre_frequency_hz(),
            bandwidth_hz: 2.0 * half_hz,
            offset_hz: half_hz * 0.75_f64.sqrt(),
        }
    }

    pub(crate) fn wavelength_m(&self) -> f64 {
        SPEED_OF_LIGHT_MPS / self.centre_hz
    }

    pub(crate) fn wavenumbers_per_m(&self) -> [f64; 3] {
        [-1.0, 0.0, 1.0].map(|side| TAU * (self.centre_hz + side * self.offset_hz) / SPEED_OF_LIGHT_MPS)
    }

    /// Value at the centre and slope of the best line through three samples.
    pub(crate) fn line(&self, samples: &[Amplitude]) -> (Amplitude, Amplitude) {
        let of = |fit: &dyn Fn(usize, usize) -> Complex64| [0, 1].map(|p| [0, 1].map(|q| fit(p, q)));
        let value = of(&|p, q| samples.iter().map(|a| a[p][q]).sum::<Complex64>() / samples.len() as f64);
        let slope = of(&|p, q| match samples {
            [low, _, high] if self.offset_hz > 0.0 => (high[p][q] - low[p][q]) / (2.0 * self.offset_hz),
            _ => Complex64::ZERO,
        });
        (value, slope)
    }
}

/// Time after the frame's middle at which the error is the root mean square over the frame.
pub(crate) fn check_offset_s(frame_duration_s: f64) -> f64 {
    frame_duration_s / 12.0_f64.sqrt()
}
