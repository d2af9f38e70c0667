//! Road wheels of a mesh: groups triangles with names of wheels by their hubs.
//!
//! A group that is separate along and across the vehicle is a wheel if it is round about y and touches the
//! ground, unlike a spare wheel or a steering wheel. Tyres, rings and discs that are bodies of revolution
//! look the same at any rotation and stay with the body: their facets would flash when rotating, which no
//! tyre does.

use crate::revolution::are_of_revolution;
use artifact::scene::{Mesh, RoadWheel};
use glam::{DMat4, DVec3, DVec4};

/// Largest difference of a wheel's length and height, relative to its height.
const ROUND: f64 = 0.1;

/// Largest height of a wheel's lowest point above the mesh's, relative to its height.
const ON_GROUND: f64 = 0.25;

/// Words in names of nodes, meshes and materials that indicate a road wheel.
const WORDS: [&str; 5] = ["wheel", "tyre", "tire", "felge", "radkappe"];

/// Largest number of triangles examined: a car's wheels have some ten thousand, and a file with millions of
/// them is not a vehicle.
const TRIANGLES_MAX: usize = 1 << 20;

/// Bytes of the longest name examined.
const NAME_BYTES_MAX: usize = 256;

/// Words that exclude a road wheel.
const OTHERS: [&str; 10] =
    ["steering", "arch", "well", "house", "housing", "spare", "fender", "cover", "base", "wheeler"];

/// Whether a name indicates a road wheel: `Wheel_FL`, `tyre_rubber`, `wheel_rim`, `rim`; not
/// `steering_wheel`, `WheelArch` or `wheelbase`, nor a name longer than any person gives, which a file may
/// repeat for millions of parts.
pub fn names_a_wheel(name: &str) -> bool {
    if name.len() > NAME_BYTES_MAX {
        return false;
    }
    let name = name.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    let is_rim = name.split(|c: char| !c.is_ascii_alphabetic()).any(|word| word == "rim" || word == "rims");
    (has(&WORDS) || is_rim) && !has(&OTHERS)
}

/// Wheels of a mesh in body axes, from the triangles with names of wheels.
pub fn road_wheels(mesh: &Mesh, is_named: &[bool]) -> Vec<RoadWheel> {
    let ground_m = mesh.bounds_m()[0][2];
    groups(mesh, is_named).iter().filter_map(|group| wheel(mesh, group, ground_m)).collect()
}

/// Triangles of each wheel of a mesh in body axes, ascending, including those of bodies of revolution; from
/// front to rear, from left to right.
pub(crate) fn triangles_of_wheels(mesh: &Mesh, is_named: &[bool]) -> Vec<Vec<u32>> {
    let triangles = |group: Vec<Extent>| {
        let mut triangles: Vec<u32> = group.into_iter().map(|extent| extent.triangle).collect();
        triangles.sort_unstable();
        triangles
    };
    groups(mesh, is_named).into_iter().rev().map(triangles).collect()
}

/// Named triangles in groups that are separate along or across the vehicle; none if there are too many.
fn groups(mesh: &Mesh, is_named: &[bool]) -> Vec<Vec<Extent>> {
    let named = (0..).zip(is_named).filter(|(_, is_named)| **is_named);
    if named.clone().count() > TRIANGLES_MAX {
        return vec![];
    }
    let extents: Vec<Extent> = named.map(|(triangle, _)| Extent::of(mesh, triangle)).collect();
    let along = split_at_gaps(extents, 0);
    along.into_iter().flat_map(|group| split_at_gaps(group, 1)).collect()
}

/// A triangle with its bounding box.
struct Extent {
    triangle: u32,
    low_m: DVec3,
    high_m: DVec3,
}

impl Extent {
    fn of(mesh: &Mesh, triangle: u32) -> Self {
        let [a, b, c] = corners_m(mesh, triangle);
        Self { triangle, low_m: a.min(b).min(c), high_m: a.max(b).max(c) }
    }
}

fn corners_m(mesh: &Mesh, triangle: u32) -> [DVec3; 3] {
    mesh.triangles[triangle as usize].map(|corner| DVec3::from_array(mesh.vertices_m[corner as usize]))
}

/// Splits groups at gaps along an axis.
fn split_at_gaps(mut extents: Vec<Extent>, axis: usize) -> Vec<Vec<Extent>> {
    extents.sort_by(|a, b| a.low_m[axis].total_cmp(&b.low_m[axis]).then(a.triangle.cmp(&b.triangle)));
    let mut groups: Vec<Vec<Extent>> = vec![];
    let mut reached_m = f64::NEG_INFINITY;
    for extent in extents {
        if extent.low_m[axis] > reached_m {
            groups.push(vec![]);
        }
        reached_m = reached_m.max(extent.high_m[axis]);
        if let Some(group) = groups.last_mut() {
            group.push(extent);
        }
    }
    groups
}

/// The wheel of a group; `None` if it is not round or too high above the ground, or if no rotation of it is
/// visible.
fn wheel(mesh: &Mesh, group: &[Extent], ground_m: f64) -> Option<RoadWheel> {
    let low_m = group.iter().fold(DVec3::INFINITY, |low, extent| low.min(extent.low_m));
    let high_m = group.iter().fold(DVec3::NEG_INFINITY, |high, extent| high.max(extent.high_m));
    let size_m = high_m - low_m;
    let is_round = (size_m.x - size_m.z).abs() <= ROUND * size_m.z;
    if !is_round || low_m.z - ground_m > ON_GROUND * size_m.z {
        return None;
    }
    let corners: Vec<[DVec3; 3]> = group.iter().map(|extent| corners_m(mesh, extent.triangle)).collect();
    let WheelOutline { hub_m, height_to_length } = outline(&corners, 0.5 * (low_m + high_m), size_m.z)?;
    let rounder = DVec3::new(height_to_length, 1.0, 1.0);
    let from_hub: Vec<[DVec3; 3]> =
        corners.iter().map(|triangle| triangle.map(|corner| rounder * (corner - hub_m))).collect();
    let radius_m = from_hub.iter().flatten().map(|p| p.x.hypot(p.z)).fold(0.0, f64::max);
    let is_round = are_of_revolution(&from_hub);
    let turning = group.iter().zip(is_round).filter(|(_, is_round)| !is_round);
    let mut triangles: Vec<u32> = turning.map(|(extent, _)| extent.triangle).collect();
    triangles.sort_unstable();
    (!triangles.is_empty()).then(|| RoadWheel { hub_m: hub_m.to_array(), radius_m, triangles })
}

/// A wheel's outline: the middle of the axle, and the ratio of height to length.
struct WheelOutline {
    hub_m: DVec3,
    height_to_length: f64,
}

/// Least-squares ellipse with axes along x and z through the corners of the wheel's convex hull: a vehicle
/// scaled to its size has wheels slightly higher than long, and an odd number of sectors has its hub off the
/// middle of the box. `None` if there is no such ellipse.
fn outline(corners_m: &[[DVec3; 3]], middle_m: DVec3, height_m: f64) -> Option<WheelOutline> {
    let places: Vec<DVec3> =
        corners_m.iter().flatten().map(|corner| (*corner - middle_m) / (0.5 * height_m)).collect();
    let (centre, height_to_length) = ellipse(&convex_hull(places))?;
    Some(WheelOutline { hub_m: middle_m + 0.5 * height_m * centre, height_to_length })
}

/// Corners of the convex hull in the plane of x and z (A. M. Andrew, Information Processing Letters 9, 1979,
/// pp. 216–219), counterclockwise seen along y.
fn convex_hull(mut places: Vec<DVec3>) -> Vec<DVec3> {
    places.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.z.total_cmp(&b.z)));
    let mut hull = convex_chain(places.iter());
    hull.extend(convex_chain(places.iter().rev()));
    hull
}

/// Half of a convex hull, without its last corner, which is the first one of the other half.
fn convex_chain<'p>(places: impl Iterator<Item = &'p DVec3>) -> Vec<DVec3> {
    let mut chain: Vec<DVec3> = vec![];
    for p in places {
        while let [.., a, b] = &chain[..]
            && !protrudes(*b, *a, *p)
        {
            chain.pop();
        }
        chain.push(*p);
    }
    chain.pop();
    chain
}

/// Whether a corner lies outside the line between two others, by more than the rounding of a file.
fn protrudes(corner: DVec3, before: DVec3, after: DVec3) -> bool {
    const LEAST: f64 = 1e-4;
    let (side, chord) = (corner - before, after - before);
    side.x * chord.z - side.z * chord.x > LEAST * chord.x.hypot(chord.z)
}

/// Centre and ratio of height to length of A·x² + C·z² + D·x + E·z = 1 through corners; `None` if fewer than
/// five leave it open, or if it is far from the circle in the box.
fn ellipse(corners: &[DVec3]) -> Option<(DVec3, f64)> {
    if corners.len() < 5 {
        return None;
    }
    let (mut normal, mut right) = (DMat4::ZERO, DVec4::ZERO);
    for p in corners {
        let row = DVec4::new(p.x * p.x, p.z * p.z, p.x, p.z);
        normal += DMat4::from_cols(row * row.x, row * row.y, row * row.z, row * row.w);
        right += row;
    }
    let [a, c, d, e] = (normal.inverse() * right).to_array();
    let (centre, height_to_length) = (DVec3::new(-0.5 * d / a, 0.0, -0.5 * e / c), (a / c).sqrt());
    let is_near = centre.length() < ROUND && (height_to_length - 1.0).abs() < ROUND;
    is_near.then_some((centre, height_to_length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A tube about y at a hub, of so many sectors, open at its ends.
    fn tube(hub_m: [f64; 3], radius_m: f64, half_m: f64, sectors: usize) -> Mesh {
        let at = |k: usize, y: f64| {
            let (sin, cos) = (TAU * k as f64 / sectors as f64).sin_cos();
            [hub_m[0] + radius_m * cos, hub_m[1] + y, hub_m[2] + radius_m * sin]
        };
        let vertices_m = (0..sectors).flat_map(|k| [at(k, -half_m), at(k, half_m)]).collect();
        let n = 2 * sectors as u32;
        let quad =
            |k: u32| [[2 * k, 2 * k + 1, (2 * k + 2) % n], [2 * k + 1, (2 * k + 3) % n, (2 * k + 2) % n]];
        Mesh { vertices_m, triangles: (0..sectors as u32).flat_map(quad).collect(), ..Mesh::default() }
    }

    /// Flat blades from the axle outwards, a gap between each and the next.
    fn star(hub_m: [f64; 3], radius_m: f64, blades: usize) -> Mesh {
        let at = |radius: f64, angle: f64| {
            [hub_m[0] + radius * angle.cos(), hub_m[1], hub_m[2] + radius * angle.sin()]
        };
        let step = TAU / blades as f64;
        let blade = |k: usize| {
            let angle = step * k as f64;
            [at(0.1 * radius_m, angle), at(radius_m, angle - 0.2 * step), at(radius_m, angle + 0.2 * step)]
        };
        let triangles = (0..blades as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        Mesh { vertices_m: (0..blades).flat_map(blade).collect(), triangles, ..Mesh::default() }
    }

    fn joined(parts: &[Mesh]) -> Mesh {
        let mut all = Mesh::default();
        for part in parts {
            let first = all.vertices_m.len() as u32;
            all.vertices_m.extend(&part.vertices_m);
            all.triangles.extend(part.triangles.iter().map(|triangle| triangle.map(|i| first + i)));
        }
        all
    }

    #[test]
    fn names_tell_road_wheels_from_others() {
        for name in ["Wheel_FL", "tyre_rubber", "wheel_rim", "rim", "Wheels3", "Front Tire.001"] {
            assert!(names_a_wheel(name), "{name}");
        }
        for name in
            ["steering_wheel", "WheelArch", "wheelbase", "18-wheeler", "trim", "primer", "wheel well", ""]
        {
            assert!(!names_a_wheel(name), "{name}");
        }
        assert!(!names_a_wheel(&"wheel ".repeat(100)));
    }

    #[test]
    fn tubes_of_any_number_of_sectors_do_not_turn() {
        for sectors in [8, 9, 24, 31, 64] {
            let tyre = tube([1.3, 0.7, 0.33], 0.33, 0.1, sectors);
            assert_eq!(road_wheels(&tyre, &vec![true; tyre.triangles.len()]), [], "{sectors}");
        }
    }

    /// A mesh, rotated about an axle.
    fn rotated(mut mesh: Mesh, hub_m: [f64; 3], angle_rad: f64) -> Mesh {
        let (sin, cos) = angle_rad.sin_cos();
        for v in &mut mesh.vertices_m {
            let (x, z) = (v[0] - hub_m[0], v[2] - hub_m[2]);
            (v[0], v[2]) = (hub_m[0] + cos * x - sin * z, hub_m[2] + sin * x + cos * z);
        }
        mesh
    }

    #[test]
    fn hubs_of_wheels_of_any_number_of_sectors_in_any_position_are_found() {
        let hub_m = [1.3, 0.7, 0.33];
        for (sectors, quarter) in (7..=32).flat_map(|sectors| (0..4).map(move |quarter| (sectors, quarter))) {
            let step_rad = TAU / sectors as f64;
            // The shoulders of the tread are a little lower than its middle.
            let tyre = joined(&[tube(hub_m, 0.33, 0.1, sectors), tube(hub_m, 0.325, 0.12, sectors)]);
            let tyre = rotated(tyre, hub_m, 0.25 * step_rad * f64::from(quarter));
            let first_blade = tyre.triangles.len() as u32;
            let mut mesh = joined(&[tyre, star(hub_m, 0.25, 5)]);
            mesh.vertices_m.iter_mut().for_each(|v| v[0] *= 0.97);
            let found = road_wheels(&mesh, &vec![true; mesh.triangles.len()]);
            let [wheel] = &found[..] else { panic!("{sectors} sectors, {quarter}: {found:?}") };
            let expected = DVec3::new(0.97 * hub_m[0], hub_m[1], hub_m[2]);
            assert!((DVec3::from_array(wheel.hub_m) - expected).length() < 1e-9, "{sectors}: {wheel:?}");
            // Seven sectors are no body of revolution yet.
            let blades: Vec<u32> = (first_blade..first_blade + 5).collect();
            assert_eq!(&wheel.triangles[wheel.triangles.len() - 5..], blades, "{sectors}");
            assert_eq!(wheel.triangles.len() == 5, sectors >= 8, "{sectors}: {wheel:?}");
        }
    }

    #[test]
    fn blades_turn_and_the_tyre_about_them_does_not() {
        for blades in [3, 5, 10, 36] {
            let hub_m = [1.3, 0.7, 0.33];
            let mesh = joined(&[tube(hub_m, 0.33, 0.1, 24), star(hub_m, 0.25, blades)]);
            let found = road_wheels(&mesh, &vec![true; mesh.triangles.len()]);
            let [wheel] = &found[..] else { panic!("{blades} blades: {found:?}") };
            assert_eq!(wheel.triangles, (48..48 + blades as u32).collect::<Vec<_>>());
            assert!((DVec3::from_array(wheel.hub_m) - DVec3::from_array(hub_m)).length() < 1e-9);
            assert!((wheel.radius_m - 0.33).abs() < 1e-9);
        }
    }

    #[test]
    fn wheels_apart_are_wheels_of_their_own_and_a_spare_one_is_none() {
        let at = |x: f64, y: f64, z: f64| joined(&[tube([x, y, z], 0.3, 0.1, 24), star([x, y, z], 0.2, 5)]);
        let places =
            [[1.2, 0.7, 0.3], [1.2, -0.7, 0.3], [-1.2, 0.7, 0.3], [-1.2, -0.7, 0.3], [-2.2, 0.0, 0.9]];
        let mesh = joined(&places.map(|[x, y, z]| at(x, y, z)));
        let found = road_wheels(&mesh, &vec![true; mesh.triangles.len()]);
        let mut hubs: Vec<[i64; 3]> =
            found.iter().map(|wheel| wheel.hub_m.map(|x| (10.0 * x).round() as i64)).collect();
        hubs.sort_unstable();
        assert_eq!(hubs, [[-12, -7, 3], [-12, 7, 3], [12, -7, 3], [12, 7, 3]]);
        assert!(road_wheels(&mesh, &vec![false; mesh.triangles.len()]).is_empty());
    }

    #[test]
    fn a_tyre_that_was_stretched_a_little_does_not_turn() {
        let mut tyre = tube([0.0, 0.0, 0.3], 0.3, 0.1, 24);
        tyre.vertices_m.iter_mut().for_each(|v| v[0] *= 1.03);
        assert_eq!(road_wheels(&tyre, &[true; 48]), []);
    }

    #[test]
    fn what_is_not_round_is_no_wheel() {
        let mut mesh = star([0.0, 0.0, 0.3], 0.3, 5);
        mesh.vertices_m.iter_mut().for_each(|v| v[0] *= 1.5);
        assert!(road_wheels(&mesh, &[true; 5]).is_empty());
        let hub_m = [0.0, 0.0, 0.3];
        let square = rotated(tube(hub_m, 0.3, 0.1, 4), hub_m, TAU / 8.0);
        assert!(road_wheels(&square, &[true; 8]).is_empty(), "as long as high, with four corners");
    }
}
