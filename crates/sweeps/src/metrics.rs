//! Metrics of a run in a study: shares, errors and costs, each a number or unknown.

use crate::statistics::interval::{Mean, ValueRange, known};
use artifact::radar::Radar;
use artifact::settings::Class;
use pipeline::outcome::summary::{Cause, Estimate, Predicted, Summary, TargetSummary};

/// Version of the metrics' definitions: kept runs with another version are repeated.
pub(crate) const VERSION: u32 = 2;

/// The better of two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Better {
    Lower,
    Higher,
}

impl Better {
    /// The value, negated if less is better.
    pub(crate) fn rising(self, value: f64) -> f64 {
        match self {
            Self::Lower => -value,
            Self::Higher => value,
        }
    }
}

/// Metrics of a study, in the order of its tables.
pub(crate) struct Metrics {
    all: Vec<Metric>,
}

struct Metric {
    name: String,
    better: Better,
    scale: ValueRange,
    of: MetricSource,
}

/// Source of a metric's value.
enum MetricSource {
    /// Summary of a run.
    Run(Box<RunMetric>),
    /// Radar of a design.
    Radar(fn(&Radar) -> f64),
}

/// Value of a metric in a run.
type RunMetric = dyn Fn(&Summary) -> Option<f64> + Send + Sync;

impl Metrics {
    /// The metrics, with detection rates in bands of range between these bounds, m.
    pub(crate) fn of(bounds_m: Vec<f64>) -> Self {
        let all = detection_rates()
            .chain(class_rates())
            .chain(range_band_rates(bounds_m))
            .chain(estimation_errors())
            .chain(false_detections());
        Self { all: all.chain(costs()).collect() }
    }

    /// Names of all metrics, in order.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.all.iter().map(|metric| metric.name.as_str())
    }

    /// Direction in which a metric is better, unless a study specifies it.
    pub(crate) fn better(&self, metric: usize) -> Better {
        self.all[metric].better
    }

    /// Possible values of a metric.
    pub(crate) fn scale(&self, metric: usize) -> ValueRange {
        self.all[metric].scale
    }

    /// Mean of a metric's known values, with its interval.
    pub(crate) fn mean(&self, metric: usize, values: &[Option<f64>], confidence: f64) -> Option<Mean> {
        Mean::on_scale(&known(values), self.scale(metric), confidence)
    }

    /// All values of a run of a radar.
    pub(crate) fn values(&self, radar: &Radar, summary: &Summary) -> Vec<Option<f64>> {
        let value = |metric: &Metric| match &metric.of {
            MetricSource::Run(of) => of(summary),
            MetricSource::Radar(of) => Some(of(radar)),
        };
        self.all.iter().map(|metric| value(metric).filter(|value| value.is_finite())).collect()
    }
}

fn run_metric(
    name: impl Into<String>,
    better: Better,
    of: impl Fn(&Summary) -> Option<f64> + Send + Sync + 'static,
) -> Metric {
    Metric { name: name.into(), better, scale: ValueRange::Any, of: MetricSource::Run(Box::new(of)) }
}

/// A share for which more is better.
fn rate(name: impl Into<String>, of: impl Fn(&Summary) -> Option<f64> + Send + Sync + 'static) -> Metric {
    Metric { scale: ValueRange::SHARE, ..run_metric(name, Better::Higher, of) }
}

fn detection_rates() -> impl Iterator<Item = Metric> {
    let is_found = |target: &TargetSummary| target.estimate.is_some();
    [
        rate("coverage", move |s| share(s, |_| true, is_found)),
        rate("lane_coverage", |s| share(s, |t| t.truth.lane.is_some(), lane_is_right)),
        rate("class_coverage", |s| share(s, |t| t.class.is_some(), class_is_right)),
        rate("detection_rate", move |s| share(s, |t| t.found.is_some(), is_found)),
    ]
    .into_iter()
}

fn class_rates() -> impl Iterator<Item = Metric> {
    Class::ALL.into_iter().map(|class| {
        let asked = move |target: &TargetSummary| target.found.is_some() && target.class == Some(class);
        let name = format!("detection_rate_{}", class.name());
        rate(name, move |s| share(s, asked, |t| t.estimate.is_some()))
    })
}

/// Detection rates below the first bound, between each two, and beyond the last.
fn range_band_rates(bounds_m: Vec<f64>) -> impl Iterator<Item = Metric> {
    let ends = bounds_m.iter().copied().chain([f64::INFINITY]);
    let bands: Vec<(f64, f64)> = std::iter::once(0.0).chain(bounds_m.iter().copied()).zip(ends).collect();
    bands.into_iter().map(|(near, far)| {
        let asked =
            move |t: &TargetSummary| t.found.is_some() && (near..far).contains(&t.truth.compared_range_m());
        let to = if far.is_finite() { far.to_string() } else { "beyond".into() };
        let name = format!("detection_rate_{near}_{to}_m");
        rate(name, move |s| share(s, asked, |t| t.estimate.is_some()))
    })
}

fn estimation_errors() -> impl Iterator<Item = Metric> {
    let range = |t: &TargetSummary, e: &Estimate| e.range_m - t.truth.compared_range_m();
    let velocity =
        |t: &TargetSummary, e: &Estimate| e.radial_velocity_mps - t.truth.compared_radial_velocity_mps();
    [
        rate("lane_rate", |s| s.metrics.objects.lane_rate),
        rate("class_accuracy", |s| share(s, |t| t.class.is_some() && t.estimate.is_some(), class_is_right)),
        run_metric("range_error_m", Better::Lower, move |s| rms(s, range)),
        run_metric("velocity_error_mps", Better::Lower, move |s| rms(s, velocity)),
        run_metric("gospa_m", Better::Lower, |s| s.metrics.objects.gospa_m),
        run_metric("track_gospa_m", Better::Lower, |s| s.metrics.tracks.gospa_m),
    ]
    .into_iter()
}

fn false_detections() -> impl Iterator<Item = Metric> {
    [
        run_metric("false_objects", Better::Lower, |s| per_frame(s, s.metrics.objects.false_ones)),
        run_metric("ghosts", Better::Lower, |s| {
            let false_ones = s.frames.iter().flat_map(|frame| &frame.false_objects);
            per_frame(s, false_ones.filter(|object| object.cause == Cause::Ghost).count())
        }),
        run_metric("identity_switches", Better::Lower, |s| Some(f64::from(s.metrics.identities.switches))),
    ]
    .into_iter()
}

/// Costs, which are independent of the situation.
fn costs() -> impl Iterator<Item = Metric> {
    let cost = |name: &str, of| Metric {
        name: name.to_owned(),
        better: Better::Lower,
        scale: ValueRange::Fixed,
        of: MetricSource::Radar(of),
    };
    [
        cost("channels", |radar| radar.virtual_channels() as f64),
        cost("values_per_frame", values_per_frame),
        cost("bandwidth_ghz", |radar| radar.waveform.bandwidth_hz().abs() * 1e-9),
    ]
    .into_iter()
}

/// Number of samples in the cubes of a frame, one cube for each sub-frame.
fn values_per_frame(radar: &Radar) -> f64 {
    let waveform = &radar.waveform;
    let cube = radar.cube_channels() as f64 * f64::from(waveform.chirps) * f64::from(waveform.samples);
    cube * f64::from(radar.schedule.sub_frames())
}

fn targets(summary: &Summary) -> impl Iterator<Item = &TargetSummary> {
    summary.frames.iter().flat_map(|frame| &frame.targets)
}

/// Share of the selected targets, over all frames; `None` if there are none.
fn share(
    summary: &Summary,
    is_asked: impl Fn(&TargetSummary) -> bool,
    is_right: impl Fn(&TargetSummary) -> bool,
) -> Option<f64> {
    let asked: Vec<&TargetSummary> = targets(summary).filter(|target| is_asked(target)).collect();
    let right = asked.iter().filter(|target| is_right(target)).count();
    (!asked.is_empty()).then(|| right as f64 / asked.len() as f64)
}

fn lane_is_right(target: &TargetSummary) -> bool {
    target.estimate.is_some_and(|estimate| estimate.lane == target.truth.lane)
}

fn class_is_right(target: &TargetSummary) -> bool {
    let told = match target.predicted_class {
        Some(Predicted::Class(class)) => Some(class),
        _ => None,
    };
    told.is_some() && told == target.class
}

/// Root mean square of an error over the targets found.
fn rms(summary: &Summary, error: impl Fn(&TargetSummary, &Estimate) -> f64) -> Option<f64> {
    let errors: Vec<f64> = targets(summary).filter_map(|t| Some(error(t, t.estimate.as_ref()?))).collect();
    let sum: f64 = errors.iter().map(|error| error * error).sum();
    (!errors.is_empty()).then(|| (sum / errors.len() as f64).sqrt())
}

fn per_frame(summary: &Summary, count: usize) -> Option<f64> {
    (!summary.frames.is_empty()).then(|| count as f64 / summary.frames.len() as f64)
}
