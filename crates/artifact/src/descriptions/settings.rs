//! Settings that a scene asks of the stages.

use crate::descriptions::goal::Goal;
use crate::quantities::accuracy::Accuracy;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// Receiver noise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Noise {
    /// No noise; the detector then takes a floor 60 dB below the map's peak, and says so.
    Absent,
    /// Thermal: k·T·F·f_s per complex sample.
    Figure {
        /// Noise figure F, dB.
        noise_figure_db: f64,
        /// Noise temperature T.
        temperature_k: f64,
    },
    /// Noise-free peak cell over mean noise power, one channel, windows as set, dB.
    SnrDb(f64),
}

/// Form in which scattering reaches the echo.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum EchoMode {
    /// Path by path, spherical waves.
    Paths,
    /// The paper's far-field table over aspect and frequency.
    RcsTable,
}

/// Level of detail: how much of a frame's paths the echo is made of
/// (`docs/decisions/levels-of-detail.md`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Detail {
    /// The cheapest of the next three that keeps the accuracy asked for.
    Auto,
    /// All paths that were traced.
    Paths,
    /// Paths whose phases stay together as one.
    Merged,
    /// Scattering centres, fitted.
    Centres,
    /// Points drawn like the body's own: another field of the same mean level.
    Statistical,
}

impl Detail {
    /// Name as people write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Paths => "paths",
            Self::Merged => "merged",
            Self::Centres => "centres",
            Self::Statistical => "statistical",
        }
    }
}

/// Diffraction by edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Edges {
    /// Diffraction is left out.
    Ignored,
    /// Fringe currents of open edges and wedges, first order (physical theory of diffraction).
    FirstOrder,
}

/// Surface that the facets stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Surface {
    /// The flat facets themselves.
    Flat,
    /// The curved skin that the vertex normals tell of.
    Smooth,
}

/// Sides from which a facet scatters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sides {
    /// Either side: the meshes that people have are open and their winding is unreliable.
    Two,
    /// The side alone from which the winding is counter-clockwise.
    One,
}

/// Whether ways are followed from one body to another.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum BetweenBodies {
    /// Ways from body to body are traced like those within a body.
    #[default]
    Traced,
    /// Bodies shade one another; what one reflects into another is left out, multipath ghosts by two vehicles
    /// with it.
    LeftOut,
}

/// Whether wheels of meshes turn as their vehicles roll.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Wheels {
    /// Wheels are part of the rigid body.
    #[default]
    Still,
    /// Wheels turn about their hubs as vehicles roll without slipping: micro-Doppler.
    Turning,
}

/// Rule for the facet of a multiple reflection on which the integral is taken
/// (`docs/decisions/node-rule.md`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum NodeRule {
    /// The middle of the sequence; even orders the symmetrised mean of both middles.
    Middle,
    /// The last facet, as shooting and bouncing rays do.
    Exit,
    /// Every node of a sequence, weighted by the share of its outline that is its facet's own edge.
    OwnEdge,
}

/// Accuracy asked of a run and the physics it shall hold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Fidelity {
    /// Relative amplitude error allowed.
    pub accuracy: Accuracy,
    /// Result whose need that accuracy is; `None` where the scene asks for an accuracy itself.
    pub goal: Option<Goal>,
    /// Highest bounce order.
    pub bounces: u8,
    /// Edge diffraction.
    pub edges: Edges,
    /// Surface that facets stand for.
    pub surface: Surface,
    /// Sides of a facet that scatter.
    pub sides: Sides,
    /// Node of multiple reflections.
    pub nodes: NodeRule,
    /// Paths or the paper's table.
    pub echo: EchoMode,
    /// Level of detail: how much of the paths the echo is made of.
    pub detail: Detail,
    /// Ways that meet several bodies.
    pub between_bodies: BetweenBodies,
    /// Wheels of meshes that tell of any.
    pub wheels: Wheels,
    /// The error of the paths is measured in every n-th frame
    /// ([`SceneHeader::measured_in`](crate::schemas::scene::SceneHeader)).
    pub measured_every: u32,
}

/// Taper of an FFT axis, periodic, of unit coherent gain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Window {
    /// No taper.
    Rect,
    /// Hann window.
    Hann,
    /// Hamming window.
    Hamming,
    /// Blackman window.
    Blackman,
    /// Dolph–Chebyshev with this sidelobe level below the peak, dB.
    Chebyshev(f64),
}

/// Detector of the range-Doppler map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Detector {
    /// Cell averaging: the mean of the training cells.
    CaCfar,
    /// Greatest of: the greater mean of the halves before and behind the cell.
    GoCfar,
    /// Smallest of: the smaller mean of the halves before and behind the cell.
    SoCfar,
    /// Ordered statistic: the training cell of rank ¾N.
    OsCfar,
}

/// Method by which directions are found in a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Angle {
    /// One echo a cell: the strongest beam, by FFT over the array.
    Fft,
    /// Up to three echoes a cell, nearer than a beam, by maximum likelihood.
    MaximumLikelihood,
}

/// Estimates that are made finer than the map's peaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Refine {
    /// No estimate: peaks are placed between cells.
    Off,
    /// Range, velocity and direction of peaks that stand alone, by maximum likelihood on the unwindowed
    /// samples.
    Isolated,
}

/// Treatment of echoes at rest, as the ground, kerbs and rails send them back, and vehicles that wait.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum StaticEchoes {
    /// Echoes at rest are points and objects like others, and nothing is told of it.
    Keep,
    /// Points and objects tell whether they are at rest, and are otherwise kept.
    Mark,
    /// Echoes at rest are no points, and no objects are formed of them.
    Remove,
}

impl StaticEchoes {
    /// Name as people write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Keep => "keep",
            Self::Mark => "mark",
            Self::Remove => "remove",
        }
    }
}

/// False alarms per tested cell for which there is a threshold. A radar that tests 10⁸ cells a second has one
/// of the smallest in 10¹⁴ years, and searches for thresholds still find it in f64; with more than the
/// largest a detection says nothing.
pub const FALSE_ALARM_RATES: std::ops::RangeInclusive<f64> = 1e-30..=0.5;

/// Signal processing of a radar cube.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DspSettings {
    /// Taper over samples.
    pub range_window: Window,
    /// Taper over chirps.
    pub doppler_window: Window,
    /// Detector of echoes in the map.
    pub detector: Detector,
    /// False alarms asked for per tested cell; within [`FALSE_ALARM_RATES`].
    pub false_alarm_rate: f64,
    /// Cells on each side that stay out of the noise estimate, [doppler, range].
    pub guard_cells: [u32; 2],
    /// Cells on each side beyond the guard that make the noise estimate, [doppler, range].
    pub training_cells: [u32; 2],
    /// Method by which directions are found.
    pub angle: Angle,
    /// Estimates that are made finer than by peaks.
    pub refine: Refine,
    /// Correction of each transmit–receive pair, tx·N_rx + rx: the factor of its values before directions
    /// are looked for, since its elements were measured to differ from ideal ones. Empty: all are taken as
    /// ideal.
    pub calibration: Vec<Complex64>,
    /// Treatment of echoes at rest.
    pub static_echoes: StaticEchoes,
    /// Range below which nothing is detected: what leaks from transmitters to receivers shows there.
    pub nearest_m: f64,
    /// Height given to points where the array has no elevation rows.
    pub assumed_height_m: f64,
    /// Detections closer than this join one object, m in range.
    pub cluster_range_m: f64,
    /// Detections closer than this join one object, m/s.
    pub cluster_velocity_mps: f64,
    /// Detections closer than this join one object, m across the lanes.
    pub cluster_cross_m: f64,
    /// The road that points and objects are told by.
    pub road: Lanes,
}

/// Lanes that points, objects and tracks are told by, none of them where a scene has none; and a straight
/// road in coordinates of its own: across it to the right, and along it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Lanes {
    /// Origin of the coordinates across and along, world x and y.
    pub origin_m: [f64; 2],
    /// Direction along the road, from world +y towards +x.
    pub azimuth_rad: f64,
    /// Straight lanes, side by side along the road.
    pub lanes: Vec<Lane>,
    /// Lanes of a network, each with a line of its own.
    pub courses: Vec<Course>,
}

/// A lane along a road.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lane {
    /// Number of the lane, counted from 1 at the radar.
    pub number: u8,
    /// Place of the lane's middle across the road.
    pub centre_m: f64,
    /// Width across the lane.
    pub width_m: f64,
}

/// A lane of a network.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// Number of the lane, counted from 1 in the order of the network.
    pub number: u8,
    /// Name of the lane in the network.
    pub name: String,
    /// Width across the lane.
    pub width_m: f64,
    /// Middle of the lane: world x and y of two places or more, in driving direction.
    pub line_m: Vec<[f64; 2]>,
}

impl Course {
    /// Distance of a place from the lane's middle; `None` before its beginning and behind its end.
    pub fn distance_m(&self, place_m: [f64; 2]) -> Option<f64> {
        let last = self.line_m.len().saturating_sub(2);
        let parts = self.line_m.windows(2).enumerate();
        let beside = parts.filter_map(|(part, ends)| {
            let (share, distance_m) = beside(place_m, [ends[0], ends[1]])?;
            let is_off = (part == 0 && share < 0.0) || (part == last && share > 1.0);
            (!is_off).then_some(distance_m)
        });
        beside.reduce(f64::min)
    }
}

/// Place on a straight part that is nearest to another, as a share of the part's length that may lie
/// beyond both ends, and the distance from the part itself; `None` of a part without length.
fn beside([x, y]: [f64; 2], [[ax, ay], [bx, by]]: [[f64; 2]; 2]) -> Option<(f64, f64)> {
    let (dx, dy) = (bx - ax, by - ay);
    let square = dx * dx + dy * dy;
    let share = ((x - ax) * dx + (y - ay) * dy) / square;
    let within = share.clamp(0.0, 1.0);
    (square > 0.0).then(|| (share, (x - ax - within * dx).hypot(y - ay - within * dy)))
}

impl Lanes {
    /// A place of the world, whatever its height, as [across, along].
    pub fn across_along_m(&self, position_m: [f64; 3]) -> [f64; 2] {
        let [right, ahead] = [0, 1].map(|axis: usize| position_m[axis] - self.origin_m[axis]);
        let (sin, cos) = self.azimuth_rad.sin_cos();
        [right * cos - ahead * sin, right * sin + ahead * cos]
    }

    /// The world's x and y of a place across and along the road.
    pub fn world_m(&self, [across_m, along_m]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.azimuth_rad.sin_cos();
        [self.origin_m[0] + across_m * cos + along_m * sin, self.origin_m[1] - across_m * sin + along_m * cos]
    }

    /// The lane that holds a place, if any; of a network's lanes that lie across one another the one whose
    /// middle is nearest.
    pub fn at(&self, position_m: [f64; 3]) -> Option<u8> {
        let [across_m, _] = self.across_along_m(position_m);
        let straight = self.lanes.iter().find(|l| (across_m - l.centre_m).abs() <= 0.5 * l.width_m);
        straight.map(|lane| lane.number).or_else(|| self.course_at([position_m[0], position_m[1]]))
    }

    fn course_at(&self, place_m: [f64; 2]) -> Option<u8> {
        let holds = |course: &Course| course.distance_m(place_m).filter(|m| *m <= 0.5 * course.width_m);
        let holding = self.courses.iter().filter_map(|course| Some((course.number, holds(course)?)));
        holding.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(number, _)| number)
    }
}

/// Kind of vehicle that the classifier tells apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Class {
    /// Passenger cars, SUVs, small vans.
    Car,
    /// City buses, coaches, minibuses.
    Bus,
    /// Goods vehicles.
    Truck,
    /// Two wheels.
    Motorcycle,
}

impl Class {
    /// All classes, in the order of every table and network output.
    pub const ALL: [Self; 4] = [Self::Car, Self::Bus, Self::Truck, Self::Motorcycle];

    /// Name as people write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Car => "car",
            Self::Bus => "bus",
            Self::Truck => "truck",
            Self::Motorcycle => "motorcycle",
        }
    }
}
