//! Objects from points located by another program or radar, grouped like this radar's own.
//!
//! The cells and channels of such points are unknown. A cloud may hold one point for each detected cell or
//! one for each body, so points within a main lobe of a stronger one follow it, and only the others, the
//! summits, are clustered, as peaks of a map are. Each group, even of a single point, is an object at the
//! power-weighted mean of its points, at rest if all of its points are marked so.

use crate::objects::cluster_point::ClusterPoint;
use crate::objects::clusters::clusters;
use crate::objects::points::extent;
use crate::objects::velocity_steps::DopplerAxis;
use artifact::cube::CubeHeader;
use artifact::points::{Object, Point};
use artifact::units::power_from_db;
use glam::DVec3;
use radar::doppler_ambiguity::{folded_mps, wrapped_mps};

/// Objects in the order of their strongest points; the points are sorted by strength and assigned the index
/// of their object. The header provides the radar's position, its velocity span and the clustering distances.
pub fn objects_of_points(header: &CubeHeader, points: &mut [Point]) -> Vec<Object> {
    points.sort_by(|a, b| b.snr_db.total_cmp(&a.snr_db));
    let span_mps = 2.0 * header.radar.velocity_max_mps();
    let axis = DopplerAxis { span_mps, cell_mps: header.radar.velocity_resolution_mps() };
    let members: Vec<ClusterPoint> = points.iter().map(|point| member(header, point, span_mps)).collect();
    let summits = summits(header, &members, axis);
    let own: Vec<usize> = (0..members.len()).filter(|index| summits[*index] == *index).collect();
    let peaks: Vec<ClusterPoint> = own.iter().map(|index| members[*index]).collect();
    let group_of = |peaks: Vec<usize>| -> Vec<usize> {
        let peaks: Vec<usize> = peaks.into_iter().map(|peak| own[peak]).collect();
        (0..members.len()).filter(|index| peaks.contains(&summits[*index])).collect()
    };
    let groups: Vec<Vec<usize>> = clusters(&peaks, &header.dsp, axis).into_iter().map(group_of).collect();
    for (number, group) in groups.iter().enumerate() {
        group.iter().for_each(|index| points[*index].object = Some(number as u32));
    }
    let object = |group: &Vec<usize>| {
        let own: Vec<&Point> = group.iter().map(|index| &points[*index]).collect();
        object(header, &own, span_mps)
    };
    groups.iter().map(object).collect()
}

/// Half a main lobe of a window like Hann's, cells.
const LOBE_CELLS: f64 = 2.0;

/// Index of the summit of each member, strongest first: the member itself, or the summit of the strongest one
/// within a main lobe of it in range and velocity and within the reach of a cluster across.
fn summits(header: &CubeHeader, members: &[ClusterPoint], axis: DopplerAxis) -> Vec<usize> {
    let lobe_m = LOBE_CELLS * header.radar.waveform.range_resolution_m();
    let lobe_mps = LOBE_CELLS * axis.cell_mps;
    let is_on_slope = |weak: &ClusterPoint, strong: &ClusterPoint| {
        let apart_mps = folded_mps(weak.radial_velocity_mps - strong.radial_velocity_mps, axis.span_mps);
        (weak.range_m - strong.range_m).abs() <= lobe_m
            && apart_mps.abs() <= lobe_mps
            && (weak.cross_m - strong.cross_m).abs() <= header.dsp.cluster_cross_m
    };
    let mut summits: Vec<usize> = Vec::with_capacity(members.len());
    for (index, member) in members.iter().enumerate() {
        let stronger = members[..index].iter().position(|other| is_on_slope(member, other));
        summits.push(stronger.map_or(index, |stronger| summits[stronger]));
    }
    summits
}

fn member(header: &CubeHeader, point: &Point, span_mps: f64) -> ClusterPoint {
    let [cross_m, _] = header.dsp.road.across_along_m(point.position_m);
    let away = DVec3::from(point.position_m) - DVec3::from(header.radar.position_m);
    ClusterPoint {
        range_m: point.range_m,
        radial_velocity_mps: wrapped_mps(point.radial_velocity_mps, span_mps),
        cross_m,
        cross_error_m: 0.0,
        power: power_from_db(point.snr_db),
        place_m: away.truncate(),
    }
}

/// Object of these points, sorted strongest first.
fn object(header: &CubeHeader, points: &[&Point], span_mps: f64) -> Object {
    let total: f64 = points.iter().map(|point| power_from_db(point.snr_db)).sum();
    let share = |point: &Point| power_from_db(point.snr_db) / total;
    let near = |velocity_mps: f64| {
        let strongest_mps = points[0].radial_velocity_mps;
        strongest_mps + folded_mps(velocity_mps - strongest_mps, span_mps)
    };
    let mean = |of: &dyn Fn(&Point) -> f64| points.iter().map(|point| share(point) * of(point)).sum();
    let place: [f64; 3] = std::array::from_fn(|axis| mean(&|point| point.position_m[axis]));
    let away = DVec3::from(place) - DVec3::from(header.radar.position_m);
    Object {
        range_m: mean(&|point| point.range_m),
        radial_velocity_mps: mean(&|point| near(point.radial_velocity_mps)),
        velocity_resolved: false,
        azimuth_rad: away.x.atan2(away.y),
        height: points[0].height,
        position_m: place,
        lane: header.dsp.road.at(place),
        snr_db: points[0].snr_db,
        points: points.len() as u32,
        range_extent_m: extent(points.iter().map(|point| point.range_m)),
        velocity_extent_mps: extent(points.iter().map(|point| near(point.radial_velocity_mps))),
        ghost_share: None,
        stationary: points.iter().try_fold(true, |all, point| Some(all && point.stationary?)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::points::Height;
    use artifact::settings::Noise;
    use radar::{aperture::Preset, paper};

    fn point(x_m: f64, y_m: f64, radial_velocity_mps: f64, snr_db: f64) -> Point {
        let range_m = x_m.hypot(y_m);
        Point {
            range_m,
            radial_velocity_mps,
            azimuth_rad: x_m.atan2(y_m),
            elevation_rad: 0.0,
            height: Height::Measured,
            position_m: [x_m, y_m, 0.0],
            snr_db,
            two_ways_rad: None,
            stationary: None,
            object: None,
            target: None,
            label: None,
        }
    }

    /// Every cell of a main lobe is a point, as a detector without a search for peaks gives them.
    #[test]
    fn all_cells_of_one_echo_are_one_object_and_an_echo_beside_it_is_another() {
        let radar = paper::radar([0.0; 3], paper::waveform(256, 32), Preset::ThreeByFour.elements());
        let header =
            CubeHeader { radar, noise: Noise::Absent, dsp: paper::processing(), unit: Default::default() };
        let (cell_m, cell_mps) =
            (header.radar.waveform.range_resolution_m(), header.radar.velocity_resolution_mps());
        let mut points = Vec::new();
        for (x_m, snr_db) in [(0.0, 40.0), (9.0, 37.0)] {
            for (i, j) in (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j))) {
                let down_db = 1.5 * f64::from(i * i + j * j);
                let (y_m, mps) = (30.0 + f64::from(i) * cell_m, f64::from(j) * cell_mps);
                points.push(point(x_m, y_m, mps, snr_db - down_db));
            }
        }
        let objects = objects_of_points(&header, &mut points);
        assert_eq!(objects.iter().map(|object| object.points).collect::<Vec<_>>(), [25, 25]);
        assert!(objects[0].position_m[0].abs() < 1e-9 && (objects[1].position_m[0] - 9.0).abs() < 1e-9);
    }

    #[test]
    fn points_of_one_place_and_speed_are_an_object_and_a_lone_one_is_one_too() {
        let radar = paper::radar([0.0; 3], paper::waveform(256, 128), Preset::ThreeByFour.elements());
        let header =
            CubeHeader { radar, noise: Noise::Absent, dsp: paper::processing(), unit: Default::default() };
        let mut points =
            vec![point(5.0, 60.0, 3.0, 10.0), point(2.0, 30.0, -10.0, 20.0), point(2.0, 31.0, -10.0, 20.0)];
        let objects = objects_of_points(&header, &mut points);
        assert_eq!(objects.len(), 2);
        assert_eq!(points.iter().map(|point| point.object).collect::<Vec<_>>(), [Some(0), Some(0), Some(1)]);
        assert!(
            (objects[0].position_m[1] - 30.5).abs() < 1e-9
                && (objects[0].radial_velocity_mps + 10.0).abs() < 1e-9
        );
        assert_eq!((objects[0].points, objects[1].points), (2, 1));
        assert_eq!(objects_of_points(&header, &mut []), []);
    }
}
