//! Kinds of work that take time in a run, and their counts.

/// Kinds of work, each with a rate of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WorkKind {
    /// The program's start and its classifier.
    Run,
    /// Triangles that are read and made into bodies.
    Triangles,
    /// Facets of the tracer that are placed and tested, by moment.
    Facets,
    /// Facets that may be in direct sight of the radar.
    InSight,
    /// Lit polygons.
    Beams,
    /// Mirrors through which beams are followed.
    Mirrors,
    /// Tiles of the paths' integrals.
    Tiles,
    /// Tiles of the paths' integrals at later moments.
    LaterTiles,
    /// Tiles of the finer integral that the paths' integrals are compared with, and is taken again where that
    /// errs.
    FineTiles,
    /// Tiles of the finer integral at later moments.
    LaterFineTiles,
    /// Finer tiles of long polygons, of which the other kinds count none: most of such a polygon is terms of
    /// its corners and sides, so that its integral is taken once, and its tiles share what a polygon takes.
    LongTiles,
    /// Cells that paths are made of, where errors are measured (several sizes are tried).
    MeasuredCells,
    /// Cells of frames that take errors over, and of the other places of a wide array.
    Cells,
    /// Measured cells times the distance in metres from the array's middle to its end: outlines of the lit
    /// parts differ from element to element, and finer cells are tried in vain against that.
    WideCells,
    /// Lit polygons of paths between bodies in relative motion, times the wavelengths by which they slide.
    SlidingBeams,
    /// Tiles of paths between bodies in relative motion, times the wavelengths by which they slide.
    SlidingTiles,
    /// Lit polygons of paths between bodies in relative motion, however far they slide.
    MovingBeams,
    /// Tiles of paths between bodies in relative motion, however far they slide.
    MovingTiles,
    /// Cells of paths between bodies in relative motion, however far they slide.
    MovingCells,
    /// Lit polygons over a reflecting road.
    RoadBeams,
    /// Lit polygons whose edges diffract.
    EdgeBeams,
    /// Tiles of all integrals, finer ones too, on bodies that are not conductors.
    LossyTiles,
    /// Tiles of all integrals, finer ones too, on smooth skins (bent facets).
    BentTiles,
    /// Tiles of far-field tables, each of many aspects and frequencies.
    TableTiles,
    /// Paths of bodies times channels.
    Echoes,
    /// Paths of the ground times channels.
    GroundEchoes,
    /// Samples of cubes.
    Samples,
    /// Cells of maps.
    MapCells,
    /// Bodies whose points are located and classified.
    Bodies,
    /// Bodies whose points are located and classified, with a search for several echoes in a cell.
    SeparatedBodies,
    /// Point targets, each of one echo that is located and classified.
    PointTargets,
    /// Frames that are drawn.
    Frames,
}

/// Number of kinds of work.
pub const ITEMS: usize = WorkKind::Frames as usize + 1;

/// Counts by kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkCounts(pub [f64; ITEMS]);

impl WorkCounts {
    pub(super) const NONE: Self = Self([0.0; ITEMS]);

    pub(super) fn add(&mut self, item: WorkKind, count: f64) {
        self.0[item as usize] += count;
    }
}
