//! Prediction of a frame's work from a sample of its beams, before it is traced.

use crate::beams::beam::TraceSettings;
use crate::beams::sampled_tree::{SampledTree, sample};
use crate::bodies::models::Models;
use crate::bodies::world::World;
use crate::frame::cells::critical_cells::is_large;
use crate::frame::cells::path_cells::cut_into_squares;
use crate::frame::integration_error::{FINER, first_accuracy};
use crate::frame::path_plan::Plan;
use crate::frame::path_table::largest_cell_of_world_m;
use crate::geometry::antenna::Antenna;
use crate::geometry::convex_intersection::bounds;
use crate::geometry::plane_frame::{PlaneFrame, area_m2};
use crate::integral::field::Field;
use crate::integral::physical_optics::for_each_tile;
use crate::joins::joint::Trees;
use crate::joins::scatterer::{PolygonPart, Scatterer, ZenithH, bracket_of};
use crate::run_control::error::BartError;
use crate::run_control::progress::NoProgress;
use artifact::scene::{SceneFrame, SceneHeader};
use glam::{DVec2, DVec3};

/// Expected counts that determine a frame's computing time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ExpectedWork {
    /// Number of facets of all bodies within antenna gain, including their images below a road.
    pub facets: f64,
    /// Number of facets that may be directly visible, before clipping.
    pub in_sight: f64,
    /// Numbers of lit polygons of the first order and of later ones.
    pub beams: [f64; 2],
    /// Number of mirrors whose view is traced.
    pub mirrors: f64,
    /// Numbers of tiles of the integrals of the first and of later orders, at the fineness tried first.
    pub tiles: [f64; 2],
    /// Numbers of tiles of the integrals four times as fine, used where the first err by too much.
    pub fine_tiles: [f64; 2],
    /// Number of lit polygons reached through sheets.
    pub beams_through_sheets: f64,
    /// Share of these tiles on polygons longer than 2 m: where large parts cancel, integrals are repeated at
    /// higher fineness.
    pub long_tiles: f64,
    /// Number of cells of all orders at the largest size tried.
    pub largest_cells: f64,
    /// Number of cells of all orders at a third of the largest size, which is about the smallest.
    pub smaller_cells: f64,
    /// Number of lit polygons on paths between bodies in relative motion, times the wavelengths by which
    /// these slide past each other during the frame.
    pub sliding_beams: f64,
    /// Number of tiles of such paths, times the same wavelengths.
    pub sliding_tiles: f64,
    /// Number of lit polygons on paths between bodies in relative motion, however far these slide.
    pub moving_beams: f64,
    /// Number of tiles on paths between bodies in relative motion, however far these slide.
    pub moving_tiles: f64,
    /// Number of smaller cells on paths between bodies in relative motion, however far these slide.
    pub moving_cells: f64,
}

/// Length from which polygons count as long: kerbs, rails and the like have them, vehicles only in their
/// largest panels.
const LONG_M: f64 = 2.0;

/// Wavelengths that bodies must slide past each other for a frame to be divided in time: an eighth out and
/// back is a quarter cycle.
const LEAST_SLIDE: f64 = 0.125;

/// Number of facets and mirrors sampled per order.
const SAMPLE: usize = 256;

/// [`crate::Tracer::expected_work`] for these models.
pub(crate) fn expected_work(
    models: &Models,
    header: &SceneHeader,
    frame: &SceneFrame,
) -> Result<ExpectedWork, BartError> {
    let plan = Plan::of(header, frame, &NoProgress);
    let world = World::posed(models, header, frame, plan.middle_s)?;
    let trace = TraceSettings { max_order: plan.trace.max_order.min(header.fidelity.bounces), ..plan.trace };
    let sampled = SampledTree::trace(&world, Antenna::Point(plan.position_m), &trace, SAMPLE)?;
    let h = plan.zenith_h();
    let scatterer = Scatterer::new(&world, Trees::Shared(&sampled.tree), ZenithH { transmit: h, receive: h });
    let mut work = ExpectedWork {
        facets: world.facets().len() as f64,
        in_sight: sampled.in_sight as f64,
        mirrors: sampled.mirrors.iter().sum(),
        ..ExpectedWork::default()
    };
    for order in 1..=trace.max_order {
        work.add_order(order, &sampled, &scatterer, &plan, largest_cell_of_world_m(&plan, &world));
    }
    Ok(work)
}

impl ExpectedWork {
    fn add_order(
        &mut self,
        order: u8,
        sampled: &SampledTree,
        scatterer: &Scatterer<'_>,
        plan: &Plan<'_>,
        cell_m: f64,
    ) {
        let beams = &sampled.tree.beams;
        let of_order: Vec<usize> = (0..beams.len()).filter(|beam| beams[*beam].order == order).collect();
        let place = usize::from(order > 1);
        self.beams[place] += of_order.iter().map(|beam| sampled.stands_for[*beam]).sum::<f64>();
        let through = of_order.iter().filter(|beam| sampled.tree.passed(&beams[**beam]) > 0);
        self.beams_through_sheets += through.map(|beam| sampled.stands_for[*beam]).sum::<f64>();
        let sizes: Vec<f64> =
            of_order.iter().map(|beam| beams[*beam].section * sampled.stands_for[*beam]).collect();
        for (index, each) in sample(&sizes, SAMPLE) {
            let (beam, each) = (of_order[index], each * sampled.stands_for[of_order[index]]);
            let polygon = SampledPolygon::new(scatterer, beam as u32, plan);
            let accuracy = first_accuracy(plan.allowed_error());
            let tiles = polygon.tiles(accuracy);
            self.tiles[place] += each * tiles;
            let fine = polygon.tiles(FINER * accuracy);
            self.fine_tiles[place] += each * fine;
            if polygon.extent_m.max_element() > LONG_M {
                self.long_tiles += each * fine;
            }
            self.largest_cells += each * polygon.cells(cell_m);
            let smaller_cells = polygon.cells((cell_m / 3.0).max(plan.band.wavelength_m()));
            self.smaller_cells += each * smaller_cells;
            let slide = slide_wavelengths(sampled, beam, scatterer.world, plan);
            self.sliding_beams += each * slide;
            self.sliding_tiles += each * slide * tiles;
            if slide > LEAST_SLIDE {
                self.moving_beams += each;
                self.moving_tiles += each * tiles;
                self.moving_cells += each * smaller_cells;
            }
        }
    }
}

/// Maximum distance by which the bodies on a beam's path slide past each other during the frame, in
/// wavelengths, and by which a wheel on it rotates; 0 within one body that is not a wheel.
fn slide_wavelengths(sampled: &SampledTree, beam: usize, world: &World, plan: &Plan<'_>) -> f64 {
    let tree = &sampled.tree;
    let mps = |facet: u32| world.motion(facet, world.facet(facet).corners_m[0]).velocity_mps;
    let own = mps(tree.beams[beam].facet);
    let met = tree.mirror_chain(&tree.beams[beam]).map(|mirror| mirror.facet);
    let past_mps = |facet: u32| own.distance(mps(facet)).max(world.turning_mps(facet));
    let fastest_mps = met.map(past_mps).fold(0.0, f64::max);
    fastest_mps * plan.header.radar.frame_duration_s() / plan.band.wavelength_m()
}

/// A lit polygon that represents others.
struct SampledPolygon<'a> {
    scatterer: &'a Scatterer<'a>,
    plan: &'a Plan<'a>,
    beam: u32,
    frame: PlaneFrame,
    /// Convex parts of at most a metre, in grid order.
    parts: Vec<Vec<DVec2>>,
    area_m2: f64,
    extent_m: DVec2,
}

/// Number of parts of a large polygon that are sampled.
const PARTS: usize = 6;

impl<'a> SampledPolygon<'a> {
    fn new(scatterer: &'a Scatterer<'a>, beam: u32, plan: &'a Plan<'a>) -> Self {
        let tree = scatterer.trees.transmit();
        let lit = &tree.beams[beam as usize];
        let corners_m = tree.polygon(lit);
        let frame = PlaneFrame::new(corners_m[0], lit.lit_normal);
        let on_plane: Vec<DVec2> = corners_m.iter().map(|c| frame.plane_from_world(*c)).collect();
        let [low, high] = bounds(&on_plane);
        let area_m2 = area_m2(&on_plane);
        let parts = cut_into_squares(on_plane, 1.0);
        Self { scatterer, plan, beam, frame, parts, area_m2, extent_m: high - low }
    }

    /// Number of tiles of the integral over it.
    fn tiles(&self, accuracy: f64) -> f64 {
        let step = self.parts.len().div_ceil(PARTS).max(1);
        let highest_per_m = self.plan.band.wavenumbers_per_m()[2];
        let of_part = |part: &Vec<DVec2>| {
            let corners_m: Vec<DVec3> = part.iter().map(|c| self.frame.to_world(*c)).collect();
            let mut count = 0;
            self.with_field(&corners_m, highest_per_m, accuracy, |field| {
                for_each_tile(field, highest_per_m, &mut |_, _| count += 1);
            });
            f64::from(count)
        };
        let looked_at = self.parts.iter().step_by(step);
        let count = looked_at.len().max(1) as f64;
        looked_at.map(of_part).sum::<f64>() * self.parts.len() as f64 / count
    }

    fn with_field<T>(
        &self,
        corners_m: &[DVec3],
        wavenumber_per_m: f64,
        accuracy: f64,
        of: impl FnOnce(&Field<'_>) -> T,
    ) -> T {
        let reference_m = corners_m.iter().sum::<DVec3>() / corners_m.len() as f64;
        let bracket = bracket_of(self.plan.header.fidelity.nodes);
        let part = PolygonPart { corners_m, reference_m, bracket };
        self.scatterer.with_field_of_beam(self.beam, &part, (&[wavenumber_per_m], accuracy), of)
    }

    /// Approximate number of its cells of this size.
    fn cells(&self, size_m: f64) -> f64 {
        let accuracy = first_accuracy(self.plan.allowed_error());
        if is_large(self.extent_m, size_m) {
            self.critical_cells(size_m, accuracy)
        } else {
            self.squares(size_m)
        }
    }

    /// Number of terms of its corners and sides, and of cells of the remainder.
    fn critical_cells(&self, size_m: f64, accuracy: f64) -> f64 {
        let wavenumber_per_m = self.plan.band.wavenumbers_per_m()[1];
        let corners_m = self.scatterer.trees.transmit();
        let corners_m = corners_m.polygon(&corners_m.beams[self.beam as usize]);
        self.with_field(corners_m, wavenumber_per_m, accuracy, |field| {
            let polygon: Vec<DVec2> = corners_m.iter().map(|c| field.frame.plane_from_world(*c)).collect();
            field.count_split(&polygon, size_m, wavenumber_per_m)
        })
    }

    /// Approximate number of pieces between the lines of a square grid.
    fn squares(&self, size_m: f64) -> f64 {
        let lines = (self.extent_m / size_m).ceil().max(DVec2::ONE);
        let full = (self.area_m2 / (self.extent_m.x * self.extent_m.y)).clamp(0.0, 1.0);
        // A polygon touches its share of a grid's cells plus those along its border.
        (lines.x * lines.y * full + 0.5 * (lines.x + lines.y)).min(lines.x * lines.y).max(1.0)
    }
}
