//! Settings of a scene for the stages.

use crate::descriptions::goal::Goal;
use crate::quantities::accuracy::Accuracy;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// Receiver noise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Noise {
    /// No noise; the detector then assumes a floor 60 dB below the map's peak, and reports it.
    Absent,
    /// Thermal noise, k·T·F·f_s per complex sample.
    Figure {
        /// Noise figure F, dB.
        noise_figure_db: f64,
        /// Noise temperature T.
        temperature_k: f64,
    },
    /// Noise-free peak cell over mean noise power, for one channel with the windows as set, dB.
    SnrDb(f64),
}

/// Form in which scattering is passed to the echo.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum EchoMode {
    /// Individual paths with spherical waves.
    Paths,
    /// The paper's far-field table over aspect and frequency.
    RcsTable,
}

/// Level of detail: how many of a frame's paths the echo is made of (`docs/decisions/levels-of-detail.md`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Detail {
    /// The cheapest of the next three that meets the requested accuracy.
    Auto,
    /// All traced paths.
    Paths,
    /// Paths whose phases stay together, merged into one.
    Merged,
    /// Fitted scattering centres.
    Centres,
    /// Points drawn from the body's own statistics: another field of the same mean level.
    Statistical,
}

impl Detail {
    /// Name in scene files and messages.
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

/// Source of the parts of a body that are smaller than its mesh resolves: grilles, lamps, gaps, under-body.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SmallParts {
    /// The mesh alone: parts that it lacks do not scatter.
    #[default]
    OfMesh,
    /// The mesh, and random small scatterers on its lit surface with a published mean level.
    Statistical,
}

impl SmallParts {
    /// All of them, the default first.
    pub const ALL: [Self; 2] = [Self::OfMesh, Self::Statistical];

    /// Name in scene files, on the command line and in the lines of datasets.
    pub const fn name(self) -> &'static str {
        match self {
            Self::OfMesh => "mesh",
            Self::Statistical => "statistical",
        }
    }
}

/// Diffraction by edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Edges {
    /// No diffraction.
    Ignored,
    /// Fringe currents of open edges and wedges, first order (physical theory of diffraction).
    FirstOrder,
}

/// Surface that the facets stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Surface {
    /// The flat facets themselves.
    Flat,
    /// The curved skin that the vertex normals describe.
    Smooth,
}

/// Sides from which a facet scatters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sides {
    /// Either side: real meshes are often open and their winding is unreliable.
    Two,
    /// Only the side from which the winding is counter-clockwise.
    One,
}

/// Whether paths from one body to another are traced.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum BetweenBodies {
    /// Paths between bodies are traced like those within a body.
    #[default]
    Traced,
    /// Bodies shadow one another, but reflections from one into another are omitted, and with them multipath
    /// ghosts between vehicles.
    LeftOut,
}

/// Whether wheels of meshes rotate as their vehicles roll.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Wheels {
    /// Wheels are part of the rigid body.
    #[default]
    Still,
    /// Wheels rotate about their hubs as vehicles roll without slipping: micro-Doppler.
    Turning,
}

/// Rule that selects the facet of a multiple reflection on which the integral is taken
/// (`docs/decisions/node-rule.md`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum NodeRule {
    /// The middle of the sequence; for even orders the symmetrised mean of both middles.
    Middle,
    /// The last facet, as shooting and bouncing rays do.
    Exit,
    /// Every node of a sequence, weighted by the share of its outline that is its facet's own edge.
    OwnEdge,
}

/// Accuracy requested of a run and the physics that it models.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Fidelity {
    /// Relative amplitude error allowed.
    pub accuracy: Accuracy,
    /// Goal that sets the accuracy; `None` where the scene requests an accuracy itself.
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
    /// Source of the parts that are smaller than meshes resolve.
    pub small_parts: SmallParts,
    /// Paths over several bodies.
    pub between_bodies: BetweenBodies,
    /// Wheels of meshes that declare any.
    pub wheels: Wheels,
    /// Interval n: the error of the paths is measured in every n-th frame
    /// ([`SceneHeader::measured_in`](crate::schemas::scene::SceneHeader)).
    pub measured_every: u32,
}

/// Taper of an FFT axis, periodic, with unit coherent gain.
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
    /// Dolph–Chebyshev window with this sidelobe level below the peak, dB.
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

/// Direction-finding method for a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Angle {
    /// One echo per cell: the strongest beam, by FFT over the array.
    Fft,
    /// Up to three echoes per cell, closer than a beamwidth, by maximum likelihood.
    MaximumLikelihood,
}

/// Estimates that are refined beyond the map's peaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Refine {
    /// No refinement: peaks are interpolated between cells.
    Off,
    /// Range, velocity and direction of isolated peaks, by maximum likelihood on the unwindowed samples.
    Isolated,
}

/// Treatment of echoes at rest: ground, kerbs, rails and waiting vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum StaticEchoes {
    /// Echoes at rest are points and objects like others, and are not marked.
    Keep,
    /// Points and objects are marked as at rest or not, and otherwise kept.
    Mark,
    /// Echoes at rest yield no points and no objects.
    Remove,
}

impl StaticEchoes {
    /// Name in scene files and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Keep => "keep",
            Self::Mark => "mark",
            Self::Remove => "remove",
        }
    }
}

/// Valid false-alarm rates per tested cell. At the smallest, a radar that tests 10⁸ cells a second has one
/// false alarm in 10¹⁴ years, and threshold searches still converge in f64; above the largest a detection is
/// meaningless.
pub const FALSE_ALARM_RATES: std::ops::RangeInclusive<f64> = 1e-30..=0.5;

/// Signal processing of a radar cube.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DspSettings {
    /// Taper over the samples of a chirp.
    pub range_window: Window,
    /// Taper over chirps.
    pub doppler_window: Window,
    /// Detector of echoes in the map.
    pub detector: Detector,
    /// Requested false alarms per tested cell, within [`FALSE_ALARM_RATES`].
    pub false_alarm_rate: f64,
    /// Cells on each side excluded from the noise estimate, [doppler, range].
    pub guard_cells: [u32; 2],
    /// Cells on each side beyond the guard cells that form the noise estimate, [doppler, range].
    pub training_cells: [u32; 2],
    /// Direction-finding method.
    pub angle: Angle,
    /// Estimates that are refined beyond the map's peaks.
    pub refine: Refine,
    /// Calibration of each transmit–receive pair, tx·N_rx + rx: the factor applied to its values before
    /// directions are estimated, from the measured errors of its elements. If empty, all elements are taken
    /// as ideal.
    pub calibration: Vec<Complex64>,
    /// Treatment of echoes at rest.
    pub static_echoes: StaticEchoes,
    /// Range below which nothing is detected, since leakage from transmitters to receivers appears there.
    pub nearest_m: f64,
    /// Height assigned to points where the array has no elevation rows.
    pub assumed_height_m: f64,
    /// Range distance below which detections join one object, m.
    pub cluster_range_m: f64,
    /// Velocity difference below which detections join one object, m/s.
    pub cluster_velocity_mps: f64,
    /// Distance across the lanes below which detections join one object, m.
    pub cluster_cross_m: f64,
    /// Road to which points and objects are assigned.
    pub road: Lanes,
}

/// Lanes to which points, objects and tracks are assigned (none if the scene has none), and a straight road
/// with its own coordinates: across it to the right, and along it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Lanes {
    /// Origin of the coordinates across and along, world x and y.
    pub origin_m: [f64; 2],
    /// Direction along the road, from world +y towards +x.
    pub azimuth_rad: f64,
    /// Straight lanes, side by side along the road.
    pub lanes: Vec<Lane>,
    /// Lanes of a network, each with its own centreline.
    pub courses: Vec<NetworkLane>,
}

/// A lane along a road.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lane {
    /// Number of the lane, counted from 1 nearest the radar.
    pub number: u8,
    /// Position of the centreline across the road.
    pub centre_m: f64,
    /// Width across the lane.
    pub width_m: f64,
}

/// A lane of a network.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NetworkLane {
    /// Number of the lane, counted from 1 in the order of the network.
    pub number: u8,
    /// Name of the lane in the network.
    pub name: String,
    /// Width across the lane.
    pub width_m: f64,
    /// Centreline: world x and y of two or more points, in driving direction.
    pub line_m: Vec<[f64; 2]>,
}

impl NetworkLane {
    /// Distance of a position from the centreline; `None` where its nearest part is the first, which begins
    /// beyond it, or the last, which has ended.
    pub fn distance_m(&self, place_m: [f64; 2]) -> Option<f64> {
        let parts = self.line_m.windows(2).filter_map(|ends| beside(place_m, [ends[0], ends[1]]));
        let parts: Vec<(f64, f64)> = parts.collect();
        let (nearest, (share, distance_m)) =
            parts.iter().enumerate().min_by(|(_, a), (_, b)| a.1.total_cmp(&b.1))?;
        let is_off = (nearest == 0 && *share < 0.0) || (nearest + 1 == parts.len() && *share > 1.0);
        (!is_off).then_some(*distance_m)
    }
}

/// Nearest point of the line through a straight segment, as a fraction of its length (which may lie beyond
/// both ends), and the distance from the segment itself; `None` for a segment without length.
fn beside([x, y]: [f64; 2], [[ax, ay], [bx, by]]: [[f64; 2]; 2]) -> Option<(f64, f64)> {
    let (dx, dy) = (bx - ax, by - ay);
    let square = dx * dx + dy * dy;
    let share = ((x - ax) * dx + (y - ay) * dy) / square;
    let within = share.clamp(0.0, 1.0);
    (square > 0.0).then(|| (share, (x - ax - within * dx).hypot(y - ay - within * dy)))
}

impl Lanes {
    /// A world position, regardless of its height, as [across, along].
    pub fn across_along_m(&self, position_m: [f64; 3]) -> [f64; 2] {
        let [right, ahead] = [0, 1].map(|axis: usize| position_m[axis] - self.origin_m[axis]);
        let (sin, cos) = self.azimuth_rad.sin_cos();
        [right * cos - ahead * sin, right * sin + ahead * cos]
    }

    /// World x and y of a position across and along the road.
    pub fn world_m(&self, [across_m, along_m]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.azimuth_rad.sin_cos();
        [self.origin_m[0] + across_m * cos + along_m * sin, self.origin_m[1] - across_m * sin + along_m * cos]
    }

    /// The lane that contains a position, if any; where lanes of a network cross, the one whose centreline is
    /// nearest.
    pub fn at(&self, position_m: [f64; 3]) -> Option<u8> {
        let [across_m, _] = self.across_along_m(position_m);
        let straight = self.lanes.iter().find(|l| (across_m - l.centre_m).abs() <= 0.5 * l.width_m);
        straight.map(|lane| lane.number).or_else(|| self.network_lane_at([position_m[0], position_m[1]]))
    }

    fn network_lane_at(&self, place_m: [f64; 2]) -> Option<u8> {
        let holds = |course: &NetworkLane| course.distance_m(place_m).filter(|m| *m <= 0.5 * course.width_m);
        let holding = self.courses.iter().filter_map(|course| Some((course.number, holds(course)?)));
        holding.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(number, _)| number)
    }
}

/// Vehicle class distinguished by the classifier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Class {
    /// Passenger cars, SUVs, small vans.
    Car,
    /// City buses, coaches, minibuses.
    Bus,
    /// Goods vehicles.
    Truck,
    /// Two-wheelers.
    Motorcycle,
}

impl Class {
    /// All classes, in the order of every table and network output.
    pub const ALL: [Self; 4] = [Self::Car, Self::Bus, Self::Truck, Self::Motorcycle];

    /// Name in scene files and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Car => "car",
            Self::Bus => "bus",
            Self::Truck => "truck",
            Self::Motorcycle => "motorcycle",
        }
    }
}
