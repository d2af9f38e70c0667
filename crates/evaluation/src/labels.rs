//! True labels of detected points: the target, its class and the bounce order of the strongest echo in the
//! point's cell, from the paths of the echo. Only reports use them: no processing behind the radar cube does.
//!
//! A cell of the map, beamformed to the point's direction, holds Σ over paths of conj a/(L₁L₂)·e^{j2π(f_cτ −
//! ½μτ²)}, each weighted by the response of the two windows and the array (`docs/interface.md`, eq. of a
//! path, at the middle of frame and sweep). The sum is split by target and order and coherent within each:
//! cells of one surface cancel away from its mirror direction, so the powers of single paths would be
//! meaningless. A point whose paths are together below the noise is a false alarm and has no label.
//!
//! The map of real samples holds the conjugate of each echo too, at the opposite range and velocity: an echo
//! from beyond the map folds into it as its own image, with the phases of all channels and slots reversed.

use crate::beam::beam_response;
use crate::doppler_response::{DopplerResponse, at, response};
use artifact::Waveform;
use artifact::cube::CubeHeader;
use artifact::paths::{Path, PathsFrame};
use artifact::points::{Label, Point};
use artifact::radar::{Radar, Sampling};
use glam::DVec3;
use num_complex::Complex64;
use radar::beat::coupling_m;
use radar::doppler_ambiguity::folded;
use radar::path_echo::echo_value;
use radar::path_kinematics::legs;
use radar::window::{Sidelobes, taper};
use std::collections::{BTreeMap, BTreeSet};

/// True origin of a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// Echoes of bodies: the strongest kind of them, and the bodies on its strongest path.
    Echo {
        /// Target, bounce order and share of the strongest kind.
        label: Label,
        /// Bodies on its strongest path.
        bodies: BTreeSet<u32>,
    },
    /// The road's own backscatter.
    Ground,
    /// Noise: the paths together are below it there.
    Noise,
}

impl Origin {
    /// The label of an echo.
    pub fn label(&self) -> Option<Label> {
        match self {
            Self::Echo { label, .. } => Some(*label),
            Self::Ground | Self::Noise => None,
        }
    }
}

/// Origins of points from paths; `noise_power` is that of one cell of one channel of the map, in its units.
pub fn origins(
    header: &CubeHeader,
    paths: &PathsFrame,
    noise_power: f64,
    points: &[Point],
) -> Result<Vec<Origin>, Sidelobes> {
    let map = MapResponse::new(header)?;
    let echoes: Vec<PathOnMap> = paths.paths.iter().map(|path| PathOnMap::of(&header.radar, path)).collect();
    // The beam averages over channels, and so over their noise.
    let floor = noise_power / header.radar.virtual_channels() as f64 / map.gain.powi(2);
    let origin = |point: &Point| {
        let shares = map.shares(&header.radar, &echoes, point);
        let Some(label) = strongest(&shares, floor) else { return Origin::Noise };
        let group = EchoGroup { target: label.target, order: label.order, bodies: label.bodies };
        match shares.get(&group).map(|share| share.strongest) {
            // If the road itself is strongest, the point belongs to no target.
            _ if label.target == artifact::paths::GROUND => Origin::Ground,
            Some(way) => Origin::Echo { label, bodies: bodies_on_path(&paths.paths[way]) },
            None => Origin::Noise,
        }
    };
    Ok(points.iter().map(origin).collect())
}

/// Coherent sum of a group's echoes in a cell, √W.
#[derive(Debug, Clone, Copy, Default)]
struct Share {
    sum: Complex64,
    /// Index and power of its strongest path.
    strongest: usize,
    largest: f64,
}

impl Share {
    fn power(&self) -> f64 {
        self.sum.norm_sqr()
    }
}

/// The strongest group, if all groups together reach the noise.
fn strongest(shares: &BTreeMap<EchoGroup, Share>, noise: f64) -> Option<Label> {
    let sum: f64 = shares.values().map(Share::power).sum();
    let best = shares.iter().map(|(group, share)| (group, share.power())).fold(
        None,
        |best: Option<(&EchoGroup, f64)>, new| match best {
            Some(best) if best.1 >= new.1 => Some(best),
            _ => Some(new),
        },
    );
    let (group, power) = best.filter(|_| sum > 0.0 && sum >= noise)?;
    Some(Label { target: group.target, order: group.order, bodies: group.bodies, share: power / sum })
}

/// Bodies on a path.
fn bodies_on_path(path: &Path) -> BTreeSet<u32> {
    match path.sequence() {
        [] => BTreeSet::from([path.target]),
        facets => facets.iter().map(|facet| facet.body).collect(),
    }
}

/// Common properties of paths whose echoes are added: the first target, the number of bounces, and the number
/// of different targets on the path. A path and its reverse are one echo: its target is the one of the two
/// ends that comes first in the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct EchoGroup {
    /// Index of the target.
    pub target: u32,
    /// Bounces; 0 for a point target.
    pub order: u8,
    /// Number of different targets on the path.
    pub bodies: u8,
}

impl EchoGroup {
    fn of(path: &Path) -> Self {
        let target = path.sequence().last().map_or(path.target, |last| path.target.min(last.body));
        Self { target, order: path.order, bodies: bodies_on_path(path).len() as u8 }
    }
}

/// A path at the frame's middle, as seen in a map.
pub(crate) struct PathOnMap {
    pub(crate) group: EchoGroup,
    /// √W, with its phase in the middle of the sweep.
    pub(crate) value: Complex64,
    /// |value|.
    size: f64,
    pub(crate) position: MapPosition,
    /// Unit vectors from the array to the apparent points of the transmitter's and the receiver's side.
    pub(crate) directions: [DVec3; 2],
}

impl PathOnMap {
    pub(crate) fn of(radar: &Radar, path: &Path) -> Self {
        let [there, back] = legs(radar, path);
        let value = echo_value(radar, path);
        Self {
            group: EchoGroup::of(path),
            value,
            size: value.norm(),
            position: MapPosition::of(
                &radar.waveform,
                0.5 * (there.length_m + back.length_m),
                0.5 * (there.rate_mps + back.rate_mps),
            ),
            directions: [there.direction, back.direction],
        }
    }
}

/// Place on an unbounded map: a moving echo is shifted by f_c/μ metres for each m/s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MapPosition {
    pub(crate) range_m: f64,
    pub(crate) radial_velocity_mps: f64,
}

impl MapPosition {
    fn of(waveform: &Waveform, range_m: f64, radial_velocity_mps: f64) -> Self {
        Self { range_m: range_m + coupling_m(waveform, radial_velocity_mps), radial_velocity_mps }
    }
}

/// Response of the map to a tone near a cell, by its two windows and the chirps' times.
pub(crate) struct MapResponse {
    pub(crate) doppler: DopplerResponse,
    /// Amplitudes along the range axis from the centre on.
    pub(crate) range: Vec<f64>,
    pub(crate) cells: [f64; 2],
    /// Value of a cell for a tone of unit amplitude at its centre.
    pub(crate) gain: f64,
}

/// Share of a tone's amplitude in the line shown in maps: 1, or ½ for real samples, which have another line
/// at the image frequency.
fn line_share(header: &CubeHeader) -> f64 {
    match header.radar.waveform.sampling {
        Sampling::Complex => 1.0,
        Sampling::Real => 0.5,
    }
}

impl MapResponse {
    pub(crate) fn new(header: &CubeHeader) -> Result<Self, Sidelobes> {
        let waveform = &header.radar.waveform;
        let doppler = taper(header.dsp.doppler_window, waveform.chirps as usize)?;
        let range = taper(header.dsp.range_window, waveform.samples as usize)?;
        Ok(Self {
            doppler: DopplerResponse::of(&header.radar, &doppler),
            range: response(&range),
            cells: [header.radar.velocity_resolution_mps(), waveform.range_resolution_m()],
            gain: line_share(header) * (doppler.len() * range.len()) as f64,
        })
    }

    /// Finds the sum of each group in the cell of a point, beamformed to the point's direction, √W.
    fn shares(&self, radar: &Radar, echoes: &[PathOnMap], point: &Point) -> BTreeMap<EchoGroup, Share> {
        let mut shares: BTreeMap<EchoGroup, Share> = BTreeMap::new();
        for Tone { echo: index, line, share, .. } in self.tones(&radar.waveform, echoes, point) {
            let echo = &echoes[index];
            let value = share * echo.in_beam(radar, line, point);
            let share = shares.entry(echo.group).or_default();
            share.sum += value;
            if value.norm_sqr() >= share.largest {
                (share.strongest, share.largest) = (index, value.norm_sqr());
            }
        }
        shares
    }

    /// Tones of the echoes that count in the point's cell. Tones a sample rate apart are the same, as are
    /// rows a turn per chirp apart: echoes from beyond the map fold into it, with real samples also their
    /// conjugates.
    fn tones(&self, w: &Waveform, echoes: &[PathOnMap], point: &Point) -> Vec<Tone> {
        let at_point = MapPosition::of(w, point.range_m, point.radial_velocity_mps);
        let place = |position: MapPosition| position.radial_velocity_mps / self.cells[0];
        let (row, mut tones, mut largest) = (place(at_point), vec![], 0.0_f64);
        for (index, echo) in echoes.iter().enumerate() {
            for line in Line::of(w.sampling) {
                let columns = (line.sign() * echo.position.range_m - at_point.range_m) / self.cells[1];
                let along = at(&self.range, folded(columns, f64::from(w.samples)));
                if echo.size * along.abs() < LEAST_SIZE * largest {
                    continue;
                }
                let share = along * self.doppler.at(line.sign() * place(echo.position), row, w.chirps);
                let size = echo.size * share.norm();
                largest = largest.max(size);
                tones.push(Tone { echo: index, line: *line, share, size });
            }
        }
        tones.retain(|tone| tone.size > 0.0 && tone.size >= LEAST_SIZE * largest);
        tones
    }
}

/// Amplitude over that of the largest tone in a cell below which a tone does not count there: a hundred of
/// them in phase are a tenth of it.
const LEAST_SIZE: f64 = 1e-3;

/// A line of an echo in a cell.
struct Tone {
    /// Index of the echo.
    echo: usize,
    line: Line,
    /// Part of the echo's amplitude, and the amplitude, √W.
    share: Complex64,
    size: f64,
}

/// Line of an echo in the spectrum of samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Line {
    /// The echo's own.
    Echo,
    /// The negative frequency of a real tone.
    Conjugate,
}

impl Line {
    /// Lines of an echo.
    fn of(sampling: Sampling) -> &'static [Self] {
        match sampling {
            Sampling::Complex => &[Self::Echo],
            Sampling::Real => &[Self::Echo, Self::Conjugate],
        }
    }

    /// Sign of range and velocity.
    fn sign(self) -> f64 {
        match self {
            Self::Echo => 1.0,
            Self::Conjugate => -1.0,
        }
    }
}

impl PathOnMap {
    /// Value of one of its lines in the beam towards a point, with the phases of slots removed as for the
    /// point's velocity.
    fn in_beam(&self, radar: &Radar, line: Line, point: &Point) -> Complex64 {
        let faster_mps = line.sign() * self.position.radial_velocity_mps - point.radial_velocity_mps;
        // Conjugate values of all channels are those of an echo from the opposite directions.
        let directions = self.directions.map(|direction| line.sign() * direction);
        let beam = beam_response(radar, directions, direction(point), faster_mps);
        beam * if line == Line::Conjugate { self.value.conj() } else { self.value }
    }
}

/// Unit vector from the array to a point.
fn direction(point: &Point) -> DVec3 {
    let (sin, cos) = point.azimuth_rad.sin_cos();
    let (up, level) = point.elevation_rad.sin_cos();
    DVec3::new(sin * level, cos * level, up)
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::cube::SampleUnit;
    use artifact::points::Height;
    use artifact::radar::Multiplexing;
    use artifact::settings::{Noise, Window};
    use radar::aperture::{Elements, Preset};
    use radar::paper;

    fn header(elements: [Elements; 2], multiplexing: Multiplexing) -> CubeHeader {
        let mut radar = paper::radar([0.0; 3], paper::waveform(128, 64), elements);
        radar.array.multiplexing = multiplexing;
        let (noise, dsp) = (Noise::Absent, paper::processing());
        CubeHeader { radar, noise, dsp, unit: SampleUnit::RootWatts }
    }

    /// An echo of body 3 at a direction cosine, level with the radar, in the frame's middle.
    fn path(header: &CubeHeader, range_m: f64, velocity_mps: f64, right: f64) -> Path {
        let way_m = range_m - velocity_mps * header.radar.frame_middle_s();
        let ahead = (1.0 - right * right).sqrt();
        let [at_m, mps] = [way_m, velocity_mps].map(|along| [along * right, along * ahead, 0.0]);
        Path {
            target: 3,
            apparent_tx_m: at_m,
            apparent_rx_m: at_m,
            apparent_tx_mps: mps,
            apparent_rx_mps: mps,
            amplitude_m: [[Complex64::ONE; 2]; 2],
            ..Path::default()
        }
    }

    fn point(range_m: f64, radial_velocity_mps: f64, right: f64) -> Point {
        Point {
            range_m,
            radial_velocity_mps,
            azimuth_rad: right.asin(),
            elevation_rad: 0.0,
            height: Height::Assumed,
            position_m: [0.0; 3],
            snr_db: 30.0,
            two_ways_rad: None,
            stationary: None,
            object: None,
            target: None,
            label: None,
        }
    }

    /// Target of a point's label, with one path of this signal-to-noise ratio in a cell of one channel.
    fn target(header: &CubeHeader, path: Path, snr_db: f64, point: Point) -> Option<u32> {
        let value = echo_value(&header.radar, &path) * MapResponse::new(header).unwrap().gain;
        let noise = value.norm_sqr() * 10_f64.powf(-0.1 * snr_db);
        let paths = PathsFrame { paths: vec![path], ..PathsFrame::default() };
        origins(header, &paths, noise, &[point]).unwrap()[0].label().map(|label| label.target)
    }

    /// Real samples reach to 30.7 m; from 33 m an echo folds to 28.4 m, approaching where it recedes, on the
    /// other side of the boresight.
    #[test]
    fn the_image_of_an_echo_beyond_the_map_is_the_echo_s_in_every_direction() {
        use Multiplexing::{Bpm, Simultaneous, Tdm};
        let arrays = [Preset::OneByFour, Preset::ThreeByFour].map(|preset| preset.elements());
        for (elements, multiplexing) in [(0, Simultaneous), (1, Simultaneous), (1, Tdm), (1, Bpm)] {
            let mut header = header(arrays[elements].clone(), multiplexing);
            header.radar.waveform.sampling = Sampling::Real;
            let folded_m = 128.0 * header.radar.waveform.range_resolution_m() - 33.0;
            for right in [-0.5, -0.25, 0.0, 0.1, 0.25, 0.5] {
                let path = path(&header, 33.0, -2.5, right);
                let seen = |right: f64| target(&header, path, 10.0, point(folded_m, 2.5, right));
                assert_eq!(seen(-right), Some(3), "{multiplexing:?} at {right}");
                // A quarter of the direction cosines away lies a null of four elements.
                assert_eq!(seen(0.5 - right), None, "{multiplexing:?} at {right}");
            }
        }
    }

    #[test]
    fn cells_on_the_sidelobes_of_an_echo_are_the_echo_s_as_far_as_they_leave_the_noise() {
        let mut header = header(Preset::OneByFour.elements(), Multiplexing::Simultaneous);
        header.dsp.range_window = Window::Rect;
        let cell_m = header.radar.waveform.range_resolution_m();
        let path = path(&header, 40.5 * cell_m, 0.0, 0.0);
        // sinc(9.5) is −29.5 dB.
        for (snr_db, label) in [(34.5, Some(3)), (20.0, None)] {
            assert_eq!(target(&header, path, snr_db, point(50.0 * cell_m, 0.0, 0.0)), label, "{snr_db} dB");
        }
        // Hann's window leaves sinc(4.5)/(1 − 4.5²), −48.6 dB.
        header.dsp.range_window = Window::Hann;
        for (snr_db, label) in [(50.0, Some(3)), (40.0, None)] {
            assert_eq!(target(&header, path, snr_db, point(45.0 * cell_m, 0.0, 0.0)), label, "{snr_db} dB");
        }
    }
}
