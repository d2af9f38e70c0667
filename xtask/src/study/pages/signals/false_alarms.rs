//! False alarms of all detectors, by zone of the map: counted, and by importance sampling down to 1e-6; and
//! with Doppler division.

use crate::study::extent::Extent;
use crate::study::pages::measures::signals::alarm_rates::{
    self, DETECTORS, Zones, counted, counted_in_bands, weighed,
};
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{SIGNALS, SourcePaths};
use artifact::cube::CubeHeader;
use artifact::radar::Sampling;
use artifact::settings::{Detector, Window};
use wayside::host::failure::Failure;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[SIGNALS, &["crates/dsp/tests/detection/alarm_rates.rs", file!()]];

/// Window, channels, maps for counting at 1e-2, 1e-3 and 1e-4, and maps for weighting.
type Setting = (Window, u32, [u64; 3], u64);

/// One channel down to 1e-4: 10⁴ alarms in the 240 cells of the corners.
const COMPLEX: [Setting; 6] = [
    (Window::Rect, 1, [10_000, 50_000, 420_000], 12_000),
    (Window::Hann, 1, [10_000, 50_000, 420_000], 12_000),
    (Window::Rect, 12, [2_000, 10_000, 0], 1_000),
    (Window::Hann, 12, [2_000, 10_000, 0], 1_500),
    (Window::Rect, 192, [0; 3], 100),
    (Window::Hann, 192, [0; 3], 200),
];

/// 10⁴ alarms in the 96 cells next to range 0 and to half the sample rate down to 1e-3, at 1e-4 in the 300 of
/// either edge.
const REAL: [Setting; 5] = [
    (Window::Rect, 1, [11_000, 105_000, 420_000], 8_000),
    (Window::Hann, 1, [11_000, 105_000, 420_000], 8_000),
    (Window::Rect, 12, [2_000, 10_000, 0], 1_500),
    (Window::Hann, 12, [2_000, 10_000, 0], 2_000),
    (Window::Hann, 192, [0; 3], 200),
];

/// False alarms of complex samples.
pub(crate) fn of_complex_samples(extent: Extent) -> Result<PageSection, Failure> {
    Ok(table_of(Sampling::Complex, &COMPLEX, extent))
}

/// False alarms of real samples.
pub(crate) fn of_real_samples(extent: Extent) -> Result<PageSection, Failure> {
    Ok(table_of(Sampling::Real, &REAL, extent))
}

/// Transmitters and chirps with Doppler division: bands of 16, 4, 4.6, 2.3, 4.9 and 1.2 rows.
const BANDS: [(u32, u32); 6] = [(3, 64), (3, 16), (6, 32), (6, 16), (12, 64), (12, 16)];
/// Number of rows in which alarms are counted.
const ROWS: u64 = 200_000;

/// False alarms with Doppler division.
pub(crate) fn of_narrow_bands(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    part.head(&["transmitters", "chirps", "asked", "ca-cfar", "go-cfar", "so-cfar", "os-cfar"]);
    for (transmitters, chirps) in BANDS {
        let header = alarm_rates::header_of_bands(transmitters, chirps);
        for rate in [1e-2, 1e-3] {
            let show = |(alarms, cells): (u64, u64)| {
                format!("{:.3} ({alarms})", alarms as f64 / (cells as f64 * rate))
            };
            let found = counted_in_bands(&header, rate, extent.case_count(ROWS)).into_iter().map(show);
            let found = found.collect::<Vec<_>>().join(" | ");
            part.line(format!("| {transmitters} | {chirps} | {rate:e} | {found} |"));
        }
    }
    Ok(part)
}

fn table_of(sampling: Sampling, settings: &[Setting], extent: Extent) -> PageSection {
    let mut part = PageSection::default();
    let columns = ["detector", "window", "channels", "asked", "how"];
    for (index, (window, channels, counted_maps, weighed_maps)) in settings.iter().enumerate() {
        let header = alarm_rates::noise_header(sampling, *window, *channels);
        if index == 0 {
            part.head(&[columns.as_slice(), &Zones::of(&header).names].concat());
        }
        let mut add = |name: &str, rate: f64, how: &str, shown: Vec<String>| {
            let setting = format!("{name} | {window:?} | {channels} | {rate:e} | {how}");
            part.line(format!("| {setting} | {} |", shown.join(" | ")));
        };
        by_counting(
            &header,
            counted_maps.map(|maps| if maps > 0 { extent.case_count(maps) } else { 0 }),
            &mut add,
        );
        by_weighing(&header, extent.case_count(*weighed_maps), &mut add);
    }
    part
}

/// Receives, for a detector, a rate and a method, the figures of every zone.
type Add<'a> = dyn FnMut(&str, f64, &str, Vec<String>) + 'a;

fn by_counting(header: &CubeHeader, maps: [u64; 3], add: &mut Add<'_>) {
    for (rate, maps) in [1e-2, 1e-3, 1e-4].into_iter().zip(maps).filter(|(_, maps)| *maps > 0) {
        for ((name, _), of_zones) in DETECTORS.iter().zip(counted(header, rate, maps)) {
            let show = |(alarms, cells): (u64, u64)| {
                format!("{:.3} ({alarms})", alarms as f64 / (cells as f64 * rate))
            };
            add(name, rate, "counted", of_zones.into_iter().map(show).collect());
        }
    }
}

fn by_weighing(header: &CubeHeader, maps: u64, add: &mut Add<'_>) {
    let rates = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
    for (name, detector) in DETECTORS {
        // The smaller mean of a thin half is occasionally very small, and few maps then make most of the
        // rate.
        let more = if detector == Detector::SoCfar && header.shape()[0] == 1 { 8 } else { 1 };
        for (rate, of_zones) in rates.iter().zip(weighed(header, detector, &rates, more * maps)) {
            let show = |(got, error): (f64, f64)| format!("{got:.3} ± {error:.3}");
            add(name, *rate, "weighed", of_zones.into_iter().map(show).collect());
        }
    }
}
