//! True labels of detected points: the target, its class and the bounce order of the strongest echo in the
//! point's cell, from the paths of the echo. Only reports use them: no processing behind the radar cube does.
//!
//! A cell of the map, beamformed to the point's direction, holds Σ over paths of conj a/(L₁L₂)·e^{j2π(f_cτ −
//! ½μτ²)}, each weighted by the response of the two windows and the array (`docs/interface.md`, eq. of a
//! path, at the middle of frame and sweep). The sum is split by target and order and coherent within each:
//! cells of one surface cancel away from its mirror direction, so the powers of single paths would be
//! meaningless. A point whose paths are together below the noise is a false alarm and has no label.

use crate::beam::beam_response;
use crate::doppler_response::{DopplerResponse, REACH_CELLS, at, response};
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
    pub(crate) position: MapPosition,
    /// Unit vectors from the array to the apparent points of the transmitter's and the receiver's side.
    pub(crate) directions: [DVec3; 2],
}

impl PathOnMap {
    pub(crate) fn of(radar: &Radar, path: &Path) -> Self {
        let [there, back] = legs(radar, path);
        Self {
            group: EchoGroup::of(path),
            value: echo_value(radar, path),
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
        let (w, toward) = (&radar.waveform, direction(point));
        let position = MapPosition::of(w, point.range_m, point.radial_velocity_mps);
        let mut shares: BTreeMap<EchoGroup, Share> = BTreeMap::new();
        for (index, echo) in echoes.iter().enumerate() {
            let Some(tone) = self.response_to(w, echo, position) else { continue };
            let faster_mps = echo.position.radial_velocity_mps - point.radial_velocity_mps;
            let beam = beam_response(radar, echo.directions, toward, faster_mps);
            let value = tone.of(echo.value * beam);
            let share = shares.entry(echo.group).or_default();
            share.sum += value;
            if value.norm_sqr() >= share.largest {
                (share.strongest, share.largest) = (index, value.norm_sqr());
            }
        }
        shares
    }

    /// Part of an echo's amplitude in the point's cell; `None` beyond the reach of the windows, with
    /// staggered chirps of the range window alone. Tones a sample rate apart are the same, as are rows a turn
    /// per chirp apart: echoes from beyond the map fold into it, with real samples also the image.
    fn response_to(&self, w: &Waveform, echo: &PathOnMap, point: MapPosition) -> Option<ToneResponse> {
        let tone = |is_image: bool| {
            let sign = if is_image { -1.0 } else { 1.0 };
            let place = |position: MapPosition| position.radial_velocity_mps / self.cells[0];
            let columns = (sign * echo.position.range_m - point.range_m) / self.cells[1];
            let columns = folded(columns, f64::from(w.samples));
            if columns.abs() >= REACH_CELLS {
                return None;
            }
            let of_row = self.doppler.at(sign * place(echo.position), place(point), w.chirps)?;
            Some(ToneResponse { share: of_row * at(&self.range, columns), is_image })
        };
        tone(false).or_else(|| (w.sampling == Sampling::Real).then(|| tone(true)).flatten())
    }
}

/// Part of a tone's amplitude in a cell.
struct ToneResponse {
    share: Complex64,
    /// Whether it is the negative frequency of a real tone.
    is_image: bool,
}

impl ToneResponse {
    fn of(&self, value: Complex64) -> Complex64 {
        self.share * if self.is_image { value.conj() } else { value }
    }
}

/// Unit vector from the array to a point.
fn direction(point: &Point) -> DVec3 {
    let (sin, cos) = point.azimuth_rad.sin_cos();
    let (up, level) = point.elevation_rad.sin_cos();
    DVec3::new(sin * level, cos * level, up)
}
