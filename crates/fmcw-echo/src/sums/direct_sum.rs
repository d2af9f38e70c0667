//! Direct evaluation of eq. (13) over all paths, with the phase advanced by a quadratic recurrence in f64.
//!
//! Within one chirp a path's phase is a parabola: the exact phase is computed at the first, middle and last
//! sample ([`Path`] with its own delay, elements and scattering time), and the parabola through these three
//! is evaluated with two complex multiplications per sample: z ← z·w, w ← w·q. The error is the third
//! difference. With τ = τ₀ + τ̇t + ½τ̈t² it is μ·½τ̈·t³ cycles, τ̈ ≤ 2v²/(cR): at 10 m/s, 25 m and 50 µs
//! 2.1e-8 cycles over the chirp, of which 0.048, 6e-9 rad, remains between the three points. The amplitude
//! conj a(f)/(L₁L₂) with both pattern gains is a parabola through the same three instants; it differs from a
//! straight line by the product of its slopes over the band and over the distance travelled (1e-5 at 10 m/s,
//! 25 m and a path that doubles over the band), from a parabola by 1e-9. For near and fast points a chirp is
//! divided into several parabolas, so that no path errs by more than 1e-7 (`chirp_segments.rs` has the
//! bound).
//!
//! Lanes hold paths, not samples, so that the set-up of a chirp (square roots, phasors) is vectorised like
//! the sum. Each row (channel, chirp) is summed by one thread in path order, so the result is the same for
//! any number of threads.

use crate::links::multiplexing::{Transmission, row};
use crate::sums::chirp_segments::samples_per_segment;
use crate::sums::reference::if_sample;
use crate::sums::simd_lanes::{Complex, MAX_LANES, Real, Vector};
use crate::sums::spans::{FrameSpan, by_span};
use artifact::Radar;
use artifact::paths::Path;
use artifact::radar::Pattern;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use pulp::{Arch, Simd, WithSimd};
use radar::aperture::axes;
use radar::link::link_amplitude;
use rayon::prelude::*;

/// Paths arranged for the sum over one frame.
pub struct DirectSum<'a> {
    radar: &'a Radar,
    centre_frequency_hz: f64,
    link_amplitude: f64,
    axes: [DVec3; 3],
    samples_per_segment: usize,
    columns: Columns,
    /// Points on rims: they are few, and parabolas do not fit them, so each of their samples is computed from
    /// the formulas.
    on_rims: Vec<Path>,
    /// Paths that represent a part of the frame or of the array, with one sum for each part.
    parts: Vec<(FrameSpan, Self)>,
}

impl<'a> DirectSum<'a> {
    /// Sum over `paths`; `centre_frequency_hz` is f_c of the amplitudes. Paths without amplitude in the
    /// array's polarization are left out, so that they do not affect the result.
    pub fn new(radar: &'a Radar, centre_frequency_hz: f64, paths: &[Path]) -> Self {
        let heard = paths.iter().filter(|path| is_received(radar, path));
        let (on_rims, steady): (Vec<&Path>, Vec<&Path>) = heard.partition(|path| path.curve.rim.is_some());
        let (steady, spanning): (Vec<&Path>, Vec<&Path>) =
            steady.into_iter().partition(|path| FrameSpan::of(path).is_whole());
        let of_part = |(part, paths): (FrameSpan, Vec<&Path>)| {
            (part, Self::of_steady(radar, centre_frequency_hz, &paths))
        };
        let parts = by_span(spanning).into_iter().map(of_part).collect();
        let on_rims = on_rims.into_iter().copied().collect();
        Self { on_rims, parts, ..Self::of_steady(radar, centre_frequency_hz, &steady) }
    }

    fn of_steady(radar: &'a Radar, centre_frequency_hz: f64, steady: &[&Path]) -> Self {
        let samples_per_segment = samples_per_segment(radar, steady);
        Self { samples_per_segment, ..Self::for_moments(radar, centre_frequency_hz, steady) }
    }

    /// Sum over paths in order, none silent and none on a rim, for use by [`Self::values`] alone, which
    /// ignores that a path may represent a part of the frame.
    pub(crate) fn for_moments(radar: &'a Radar, centre_frequency_hz: f64, heard: &[&Path]) -> Self {
        Self {
            radar,
            centre_frequency_hz,
            link_amplitude: link_amplitude(radar),
            axes: axes(radar),
            samples_per_segment: radar.waveform.samples as usize,
            columns: Columns::new(radar, heard),
            on_rims: vec![],
            parts: vec![],
        }
    }

    /// Samples of one row of the cube, √W, noise-free.
    pub fn row(&self, channel: usize, chirp: usize) -> Vec<Complex64> {
        let transmissions = row(self.radar, channel, chirp);
        let mut samples = Arch::new().dispatch(RowSum { sum: self, transmissions: &transmissions });
        for (transmission, path) in
            transmissions.iter().flat_map(|t| self.on_rims.iter().map(move |path| (t, path)))
        {
            for (n, sample) in samples.iter_mut().enumerate() {
                *sample += transmission.turn
                    * if_sample(self.radar, self.centre_frequency_hz, path, transmission, n);
            }
        }
        let parts = self.parts.iter();
        let parts = parts.flat_map(|(part, sum)| part.alike(&transmissions).map(move |t| (part, sum, t)));
        for (part, sum, transmissions) in parts {
            let shares = part.shares_of_row(self.radar, &transmissions[0]);
            if shares.iter().any(|share| *share != 0.0) {
                let values = Arch::new().dispatch(RowSum { sum, transmissions });
                samples
                    .iter_mut()
                    .zip(shares)
                    .zip(values)
                    .for_each(|((sum, share), value)| *sum += share * value);
            }
        }
        samples
    }

    /// IF values of every path at one instant, each with a phase removed: `cycles`, one per path in order; no
    /// path may be without amplitude.
    pub(crate) fn values(&self, transmission: &Transmission, sample: f64, cycles: &[f64]) -> Vec<Complex64> {
        let mut padded = cycles.to_vec();
        padded.resize(self.columns.amplitude_m[0].len(), 0.0);
        let mut values =
            Arch::new().dispatch(InstantSum { sum: self, transmission, sample, cycles: &padded });
        values.truncate(cycles.len());
        values
    }

    /// All rows of the cube in order, √W, noise-free, row-major `[channel, chirp, sample]`; single-threaded.
    pub fn cube(&self) -> Vec<Complex64> {
        let chirps = self.radar.waveform.chirps as usize;
        (0..self.radar.cube_channels() * chirps).flat_map(|r| self.row(r / chirps, r % chirps)).collect()
    }
}

/// Struct of arrays over paths, whose length is a multiple of every lane count.
struct Columns {
    /// Apparent points x_a at the frame's first sample.
    tx_m: [Vec<f64>; 3],
    /// Velocities of x_a.
    tx_mps: [Vec<f64>; 3],
    /// Apparent points x_b at the frame's first sample.
    rx_m: [Vec<f64>; 3],
    /// Velocities of x_b over c.
    rx_beta: [Vec<f64>; 3],
    /// Half the accelerations of x_a, and of x_b over c; `None` if all are zero.
    bends: Option<[[Vec<f64>; 3]; 2]>,
    /// Amplitudes a, real and imaginary.
    amplitude_m: [Vec<f64>; 2],
    /// Slopes a′, real and imaginary.
    slope_m_per_hz: [Vec<f64>; 2],
}

impl Columns {
    /// Arranges the paths; silent copies of the last one fill the remaining lanes.
    fn new(radar: &Radar, heard: &[&Path]) -> Self {
        let lanes = heard.len().next_multiple_of(MAX_LANES);
        let filled = |number: &(dyn Fn(&Path) -> f64 + Sync), fill: Option<f64>| {
            let mut column: Vec<f64> = heard.par_iter().map(|path| number(path)).collect();
            let last = column.last().copied().unwrap_or_default();
            column.resize(lanes, fill.unwrap_or(last));
            column
        };
        let column = |number: &(dyn Fn(&Path) -> f64 + Sync)| filled(number, None);
        let silent = |number: &(dyn Fn(&Path) -> f64 + Sync)| filled(number, Some(0.0));
        let amplitude = |p: &Path| amplitude_and_slope(radar, p).0;
        let slope = |p: &Path| amplitude_and_slope(radar, p).1;
        Self {
            tx_m: [0, 1, 2].map(|i| column(&|p| p.apparent_tx_m[i])),
            tx_mps: [0, 1, 2].map(|i| column(&|p| p.apparent_tx_mps[i])),
            rx_m: [0, 1, 2].map(|i| column(&|p| p.apparent_rx_m[i])),
            rx_beta: [0, 1, 2].map(|i| column(&|p| p.apparent_rx_mps[i] / SPEED_OF_LIGHT_MPS)),
            bends: heard.iter().any(|path| accelerates(path)).then(|| {
                [
                    [0, 1, 2].map(|i| column(&|p| 0.5 * p.curve.apparent_tx_mps2[i])),
                    [0, 1, 2].map(|i| column(&|p| 0.5 * p.curve.apparent_rx_mps2[i] / SPEED_OF_LIGHT_MPS)),
                ]
            }),
            amplitude_m: [silent(&|p| amplitude(p).re), silent(&|p| amplitude(p).im)],
            slope_m_per_hz: [silent(&|p| slope(p).re), silent(&|p| slope(p).im)],
        }
    }
}

fn accelerates(path: &Path) -> bool {
    path.curve.apparent_tx_mps2 != [0.0; 3] || path.curve.apparent_rx_mps2 != [0.0; 3]
}

/// Whether a path has an amplitude in the array's polarization.
pub(crate) fn is_received(radar: &Radar, path: &Path) -> bool {
    amplitude_and_slope(radar, path) != (Complex64::ZERO, Complex64::ZERO)
}

/// Amplitude a and slope a′ in the array's polarization.
fn amplitude_and_slope(radar: &Radar, path: &Path) -> (Complex64, Complex64) {
    let (receive, transmit) = radar.array.polarization.indices();
    (path.amplitude_m[receive][transmit], path.slope_m_per_hz[receive][transmit])
}

/// Sum of one row.
struct RowSum<'a> {
    sum: &'a DirectSum<'a>,
    transmissions: &'a [Transmission],
}

impl WithSimd for RowSum<'_> {
    type Output = Vec<Complex64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Complex64> {
        let zero = Real::splat(simd, 0.0);
        let mut totals = vec![Complex { re: zero, im: zero }; self.sum.radar.waveform.samples as usize];
        let groups = self.sum.columns.amplitude_m[0].len() / S::F64_LANES;
        for transmission in self.transmissions {
            let chirp = Chirp::new(simd, self.sum, transmission);
            for group in 0..groups {
                let mut first = 0;
                for segment in totals.chunks_mut(self.sum.samples_per_segment) {
                    accumulate(chirp.parabolas(group, first, segment.len()), segment);
                    first += segment.len();
                }
            }
        }
        let mut samples = Vec::with_capacity(totals.len());
        for total in &totals {
            samples.push(across_lanes(simd, *total));
        }
        samples
    }
}

/// All paths at one instant.
struct InstantSum<'a> {
    sum: &'a DirectSum<'a>,
    transmission: &'a Transmission,
    sample: f64,
    cycles: &'a [f64],
}

impl WithSimd for InstantSum<'_> {
    type Output = Vec<Complex64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Complex64> {
        let chirp = Chirp::new(simd, self.sum, self.transmission);
        let mut values = Vec::with_capacity(self.cycles.len());
        for (group, cycles) in S::as_simd_f64s(self.cycles).0.iter().enumerate() {
            let instant = chirp.instant(group, self.sample);
            let value = instant.amplitude * Complex::from_cycles(instant.cycles - Real::new(simd, *cycles));
            let (mut re, mut im) = ([0.0; MAX_LANES], [0.0; MAX_LANES]);
            simd.partial_store_f64s(&mut re[..S::F64_LANES], value.re.value);
            simd.partial_store_f64s(&mut im[..S::F64_LANES], value.im.value);
            for lane in 0..S::F64_LANES {
                values.push(Complex64::new(re[lane], im[lane]));
            }
        }
        values
    }
}

/// Adds a group of paths to all samples of the row.
#[inline(always)]
fn accumulate<S: Simd>(start: Parabolas<S>, totals: &mut [Complex<S>]) {
    let Parabolas { mut phasor, mut turn, turn_of_turn, mut amplitude, mut change, change_of_change } = start;
    for total in totals {
        total.re = amplitude.re.mul_add(phasor.re, amplitude.im.negate_mul_add(phasor.im, total.re));
        total.im = amplitude.re.mul_add(phasor.im, amplitude.im.mul_add(phasor.re, total.im));
        phasor = phasor * turn;
        turn = turn * turn_of_turn;
        amplitude = amplitude + change;
        change = change + change_of_change;
    }
}

/// Sum over a vector's lanes.
#[inline(always)]
fn across_lanes<S: Simd>(simd: S, total: Complex<S>) -> Complex64 {
    Complex64::new(simd.reduce_sum_f64s(total.re.value), simd.reduce_sum_f64s(total.im.value))
}

/// State of the two recurrences at a segment's first sample.
struct Parabolas<S: Simd> {
    phasor: Complex<S>,
    turn: Complex<S>,
    turn_of_turn: Complex<S>,
    amplitude: Complex<S>,
    change: Complex<S>,
    change_of_change: Complex<S>,
}

/// A group of paths at one sample.
#[derive(Clone, Copy)]
struct SampledGroup<S: Simd> {
    cycles: Real<S>,
    amplitude: Complex<S>,
}

/// One transmission, prepared for evaluation of any group of paths.
struct Chirp<'a, S: Simd> {
    simd: S,
    sum: &'a DirectSum<'a>,
    transmission: &'a Transmission,
    tx_m: [&'a [S::f64s]; 3],
    tx_mps: [&'a [S::f64s]; 3],
    rx_m: [&'a [S::f64s]; 3],
    rx_beta: [&'a [S::f64s]; 3],
    bends: Option<[[&'a [S::f64s]; 3]; 2]>,
    amplitude_m: [&'a [S::f64s]; 2],
    slope_m_per_hz: [&'a [S::f64s]; 2],
}

impl<'a, S: Simd> Chirp<'a, S> {
    fn new(simd: S, sum: &'a DirectSum<'a>, transmission: &'a Transmission) -> Self {
        let lanes = |column: &'a Vec<f64>| S::as_simd_f64s(column).0;
        let columns = &sum.columns;
        Self {
            simd,
            sum,
            transmission,
            tx_m: columns.tx_m.each_ref().map(lanes),
            tx_mps: columns.tx_mps.each_ref().map(lanes),
            rx_m: columns.rx_m.each_ref().map(lanes),
            rx_beta: columns.rx_beta.each_ref().map(lanes),
            bends: columns.bends.as_ref().map(|ends| ends.each_ref().map(|end| end.each_ref().map(lanes))),
            amplitude_m: columns.amplitude_m.each_ref().map(lanes),
            slope_m_per_hz: columns.slope_m_per_hz.each_ref().map(lanes),
        }
    }

    /// Parabolas of a segment with u from 0 to 1 over it, x(u) = x₀ + bu + cu², b = 3(x₁ − x₀) − (x₂ − x₁), c
    /// = 2(x₂ − x₁) − 2(x₁ − x₀); one sample is a step h in u, the first difference is bh + ch², the second
    /// 2ch².
    #[inline(always)]
    fn parabolas(&self, group: usize, first: usize, samples: usize) -> Parabolas<S> {
        // A single sample has no length: its parabola extends to the next.
        let (start, steps) = (first as f64, samples.max(2) as f64 - 1.0);
        let first = self.instant(group, start);
        let middle = self.instant(group, start + 0.5 * steps);
        let last = self.instant(group, start + steps);
        let h = 1.0 / steps;
        // Differences of the three values, small numbers, are taken first: the values are 2e4 cycles.
        let (rise, fall) = (middle.cycles - first.cycles, last.cycles - middle.cycles);
        let cycles_bend = (fall - rise).scale(2.0 * h * h);
        let cycles_slope = (rise.scale(3.0) - fall).scale(h);
        let (rise, fall) = (middle.amplitude - first.amplitude, last.amplitude - middle.amplitude);
        let bend = (fall - rise).scale(2.0 * h * h);
        let slope = (rise.scale(3.0) - fall).scale(h);
        Parabolas {
            phasor: Complex::from_cycles(first.cycles),
            turn: Complex::from_cycles(cycles_slope + cycles_bend),
            turn_of_turn: Complex::from_cycles(cycles_bend.scale(2.0)),
            amplitude: first.amplitude,
            change: slope + bend,
            change_of_change: bend.scale(2.0),
        }
    }

    /// Exact phase and amplitude at an integer or fractional sample.
    #[inline(always)]
    fn instant(&self, group: usize, sample: f64) -> SampledGroup<S> {
        let waveform = &self.sum.radar.waveform;
        let (f0, mu) = (waveform.start_frequency_hz, waveform.slope_hz_per_s);
        let t = sample / waveform.sample_rate_hz;
        let legs = self.legs(group, self.transmission.start_s + t - self.transmission.receiver_delay_s);
        let way_s = (legs.departing_length_m + legs.arriving_length_m).scale(1.0 / SPEED_OF_LIGHT_MPS);
        let tau = way_s + self.splat(self.transmission.line_delay_s);
        let cycles = tau * tau.mul_add(self.splat(-0.5 * mu), self.splat(f0 + mu * t));
        let offset_hz = self.splat(f0 + mu * t - self.sum.centre_frequency_hz) - tau.scale(mu);
        SampledGroup { cycles, amplitude: self.conjugate_amplitude(group, offset_hz, self.gain(&legs)) }
    }

    /// Both legs at the scattering time of the wave received at `time_s`.
    ///
    /// With d = x_b(T) − p_r and β = v_b/c, |d − βL₂| = L₂ is a quadratic equation in L₂: L₂ = (√((d·β)² + (1
    /// − β²)d²) − d·β)/(1 − β²). β is that at T: acceleration during the return moves a point by ½a(L₂/c)²,
    /// 1e-12 m at 100 m/s² and 40 m.
    #[inline(always)]
    fn legs(&self, group: usize, time_s: f64) -> GroupLegs<S> {
        let beta = self.vector(&self.rx_beta, group);
        let from_element = self.vector(&self.rx_m, group) - Vector::splat(self.simd, self.transmission.rx_m);
        let (beta, d) = match &self.bends {
            None => (beta, beta.mul_add(self.splat(SPEED_OF_LIGHT_MPS * time_s), from_element)),
            Some([_, rx]) => {
                let bend = self.vector(rx, group);
                let mean = bend.mul_add(self.splat(time_s), beta);
                let d = mean.mul_add(self.splat(SPEED_OF_LIGHT_MPS * time_s), from_element);
                (bend.mul_add(self.splat(time_s), mean), d)
            }
        };
        let (closing, shrink) = (d.dot(beta), self.splat(1.0) - beta.dot(beta));
        let root = closing.mul_add(closing, shrink * d.dot(d)).sqrt();
        let arriving_length_m = (root - closing) * shrink.recip();
        let scattering_time_s = self.splat(time_s) - arriving_length_m.scale(1.0 / SPEED_OF_LIGHT_MPS);
        let from_element = self.vector(&self.tx_m, group) - Vector::splat(self.simd, self.transmission.tx_m);
        let tx_mps = self.vector(&self.tx_mps, group);
        let mean_mps = match &self.bends {
            None => tx_mps,
            Some([tx, _]) => self.vector(tx, group).mul_add(scattering_time_s, tx_mps),
        };
        let departing_m = mean_mps.mul_add(scattering_time_s, from_element);
        GroupLegs {
            departing_m,
            departing_length_m: departing_m.dot(departing_m).sqrt(),
            arriving_m: beta.negate_mul_add(arriving_length_m, d),
            arriving_length_m,
        }
    }

    /// Link amplitude and both pattern gains over L₁L₂.
    #[inline(always)]
    fn gain(&self, legs: &GroupLegs<S>) -> Real<S> {
        let spreading =
            (legs.departing_length_m * legs.arriving_length_m).recip().scale(self.sum.link_amplitude);
        match &self.sum.radar.array.pattern {
            Pattern::Isotropic => spreading,
            pattern => {
                let departing = self.pattern_gain(pattern, legs.departing_m, legs.departing_length_m);
                spreading * departing * self.pattern_gain(pattern, legs.arriving_m, legs.arriving_length_m)
            }
        }
    }

    #[inline(always)]
    fn pattern_gain(&self, pattern: &Pattern, leg_m: Vector<S>, length_m: Real<S>) -> Real<S> {
        let shrink = length_m.recip();
        let [right, ahead, up] = self.sum.axes;
        let along = |axis: DVec3| leg_m.dot(Vector::splat(self.simd, axis)) * shrink;
        Real::map3([along(right), along(ahead), along(up)], |direction| pattern.amplitude(direction))
    }

    /// Conjugate amplitude turn·conj(a + (f − f_c)a′)·gain.
    #[inline(always)]
    fn conjugate_amplitude(&self, group: usize, offset_hz: Real<S>, gain: Real<S>) -> Complex<S> {
        let turn = self.transmission.turn;
        let re = self
            .load(self.slope_m_per_hz[0], group)
            .mul_add(offset_hz, self.load(self.amplitude_m[0], group));
        let im = self
            .load(self.slope_m_per_hz[1], group)
            .mul_add(offset_hz, self.load(self.amplitude_m[1], group));
        let (re, im) = (re * gain, im * gain);
        Complex { re: re.scale(turn.re) + im.scale(turn.im), im: re.scale(turn.im) - im.scale(turn.re) }
    }

    #[inline(always)]
    fn vector(&self, columns: &[&[S::f64s]; 3], group: usize) -> Vector<S> {
        Vector {
            x: self.load(columns[0], group),
            y: self.load(columns[1], group),
            z: self.load(columns[2], group),
        }
    }

    #[inline(always)]
    fn load(&self, column: &[S::f64s], group: usize) -> Real<S> {
        Real::new(self.simd, column[group])
    }

    #[inline(always)]
    fn splat(&self, value: f64) -> Real<S> {
        Real::splat(self.simd, value)
    }
}

/// A group of paths between the elements of a transmission.
struct GroupLegs<S: Simd> {
    /// Vectors x_a(t_s) − p_t.
    departing_m: Vector<S>,
    /// Lengths L₁ of the departing legs.
    departing_length_m: Real<S>,
    /// Vectors x_b(t_s) − p_r.
    arriving_m: Vector<S>,
    /// Lengths L₂ of the arriving legs.
    arriving_length_m: Real<S>,
}
