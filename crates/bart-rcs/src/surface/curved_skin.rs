//! Curved skin described by a mesh's normals, as flat triangles small enough to represent it.
//!
//! Every edge becomes a curve determined by the normals at its ends ([`CurvedEdge`]); triangles are
//! subdivided where their edges bend ([`refined`]). Flat parts are unchanged, bit for bit. Reasons:
//! `docs/decisions/curved-skin.md`.

use crate::geometry::plane::Plane;
use crate::mesh::mesh_edges::{MeshEdge, MeshEdges, TriangleSide};
use crate::mesh::welding::Welding;
use crate::surface::bend::{Bend, ControlHeights};
use crate::surface::curved_edge::{Curve, CurvedEdge, rejected};
use crate::surface::estimated_normals::{Facets, estimate_normals};
use crate::surface::refinement::{BendLimits, BentSide, BentTriangle, EdgeDirection, count, refined};
use crate::surface::skin_triangles::{SkinTriangles, bent_area_m2};
use artifact::scene::Mesh;
use glam::DVec3;
use rayon::prelude::*;

/// Triangles of a mesh with curved sides.
pub(crate) struct CurvedSkin {
    /// Triangles with their curves; `None` for one without a plane.
    triangles: Vec<Option<BentTriangle>>,
}

/// Difference below which normals are one: a thousandth moves a skin by 1/8000 of an edge.
const SAME_NORMAL: f64 = 1e-3;
/// Maximum angle between a stored normal and its facet's; beyond it the normal is ignored.
const LEAN_MAX: f64 = 75.0 * std::f64::consts::PI / 180.0;
/// Angle below which two skins whose normals differ at an edge where no crease is possible are one skin with
/// inaccurate normals.
const CARELESS: f64 = 20.0 * std::f64::consts::PI / 180.0;

impl CurvedSkin {
    /// Skin of a mesh whose triangles have these corners.
    pub(crate) fn of(mesh: &Mesh, corners_m: &[[DVec3; 3]]) -> Self {
        let vertices_m: Vec<DVec3> = mesh.vertices_m.iter().map(|v| DVec3::from_array(*v)).collect();
        let place_of = Welding::of_rounded(&vertices_m).places(&vertices_m);
        let planes: Vec<Option<Plane>> = corners_m.par_iter().map(Plane::of_triangle).collect();
        let with_plane = planes.iter().zip(&mesh.triangles);
        let places: Vec<Option<[u32; 3]>> =
            with_plane.map(|(plane, t)| plane.map(|_| t.map(|v| place_of[v as usize]))).collect();
        let edges = MeshEdges::of(&places);
        let face_normals: Vec<DVec3> = planes.iter().map(|p| p.map_or(DVec3::ZERO, |p| p.normal)).collect();
        let facets = Facets { corners_m, normals: &face_normals, places: &places, edges: &edges };
        let normals = corner_normals(mesh, &facets);
        let at_m = |place: u32| vertices_m[place as usize];
        let curves: Vec<CurvedEdge> = (0..edges.len())
            .into_par_iter()
            .map(|edge| curved(&edges.edge(edge), at_m, &places, &normals))
            .collect();
        let bent = |triangle: usize| {
            let places = places[triangle]?;
            let side = |k: usize| {
                let own = TriangleSide { triangle: triangle as u32, side: k as u8 };
                let edge = curves[*edges.of_side(own).first()? as usize];
                let is_forth = places[k] < places[(k + 1) % 3];
                Some(BentSide {
                    edge,
                    walk: if is_forth { EdgeDirection::Forth } else { EdgeDirection::Back },
                })
            };
            let sides = [side(0)?, side(1)?, side(2)?];
            Some(BentTriangle { corners_m: places.map(at_m), normals: normals[triangle], sides })
        };
        Self { triangles: (0..corners_m.len()).into_par_iter().map(bent).collect() }
    }

    /// Number of facets produced by [`CurvedSkin::facets`].
    pub(crate) fn count(&self, limits: &BendLimits) -> usize {
        let of = |bent: &Option<BentTriangle>| bent.as_ref().map_or(1, |b| count(b, limits));
        self.triangles.par_iter().map(of).collect::<Vec<_>>().into_iter().sum()
    }

    /// Facets whose sides bend no more than the limits allow; triangles that need no subdivision keep their
    /// corners, bit for bit.
    pub(crate) fn facets(&self, corners_m: &[[DVec3; 3]], limits: &BendLimits) -> SkinTriangles {
        let of = |(bent, corners): (&Option<BentTriangle>, &[DVec3; 3])| {
            let Some(bent) = bent else { return vec![(*corners, [DVec3::ZERO; 3], [0.0; 6])] };
            let cut = refined(*bent, limits);
            let whole = cut.len() == 1;
            let facet = |t: &BentTriangle| {
                (if whole { *corners } else { t.corners_m }, t.normals, control_heights_m(t, limits))
            };
            cut.iter().map(facet).collect()
        };
        let parts: Vec<Vec<_>> = self.triangles.par_iter().zip(corners_m).map(of).collect();
        let mut all = SkinTriangles::default();
        for (triangle, part) in (0..).zip(parts) {
            for (corners_m, normals, heights_m) in part {
                all.triangles_m.push(corners_m);
                all.triangle_of.push(triangle);
                all.corner_normals.push(normals);
                all.heights_m.push(heights_m);
            }
        }
        SkinTriangles { bent_area_m2: bent_area_m2(&all.triangles_m, &all.heights_m), ..all }
    }
}

/// Slope over its facet above which a skin stands on a sliver: its height is that of the long sides, its
/// slope meaningless.
const STEEP: f64 = 1.0;
/// Bound on the slope above which a skin stands on a sliver as well; bounds of round skins are up to twice
/// their slopes.
const STEEP_BOUND: f64 = 2.0;

/// Control heights of the skin; if it rises by less than a hundredth of the allowed offset, or stands on a
/// sliver, the facet is flat.
fn control_heights_m(bent: &BentTriangle, limits: &BendLimits) -> ControlHeights {
    let heights_m = bent.control_heights_m();
    let [a, b, c] = bent.corners_m;
    let is_low = heights_m.iter().all(|h| h.abs() < 0.01 * limits.offset_m);
    let normal = (b - a).cross(c - a).try_normalize().filter(|_| !is_low);
    let is_bent = normal.is_some_and(|normal| {
        let bend = Bend::new(bent.corners_m, normal, &heights_m);
        bend.steepest() <= STEEP && bend.steepest_bound() <= STEEP_BOUND
    });
    if is_bent { heights_m } else { [0.0; 6] }
}

/// Unit normals at the corners of every triangle on the side of its winding: stored ones if there are any,
/// otherwise estimated.
fn corner_normals(mesh: &Mesh, facets: &Facets<'_>) -> Vec<[DVec3; 3]> {
    let stored = |triangle: usize, k: usize| {
        let vertex = mesh.triangles[triangle][k] as usize;
        let normal = DVec3::from_array(mesh.normals.get(vertex)?.map(f64::from)).try_normalize()?;
        let own = facets.normals[triangle];
        let normal = if normal.dot(own) < 0.0 { -normal } else { normal };
        (normal.angle_between(own) <= LEAN_MAX).then_some(normal)
    };
    let stored: Vec<[Option<DVec3>; 3]> =
        (0..mesh.triangles.len()).map(|t| [0, 1, 2].map(|k| stored(t, k))).collect();
    if stored.iter().flatten().all(Option::is_some) {
        return stored.into_iter().map(|corners| corners.map(|n| n.unwrap_or(DVec3::ZERO))).collect();
    }
    let made = estimate_normals(facets);
    let either =
        |(stored, made): (&[Option<DVec3>; 3], &[DVec3; 3])| [0, 1, 2].map(|k| stored[k].unwrap_or(made[k]));
    stored.iter().zip(&made).map(either).collect()
}

/// Curve of an edge from the normals of all triangles that share it.
fn curved(
    edge: &MeshEdge<'_>,
    at_m: impl Fn(u32) -> DVec3,
    places: &[Option<[u32; 3]>],
    normals: &[[DVec3; 3]],
) -> CurvedEdge {
    let ends_m = edge.ends.map(at_m);
    let is_forth = |side: &TriangleSide| {
        places[side.triangle as usize].is_some_and(|p| p[usize::from(side.side)] == edge.ends[0])
    };
    let of_side = |side: &TriangleSide| {
        let (t, k) = (side.triangle as usize, usize::from(side.side));
        let walked = [normals[t][k], normals[t][(k + 1) % 3]];
        if is_forth(side) { walked } else { [walked[1], walked[0]] }
    };
    let mut sides: Vec<[DVec3; 2]> = edge.sides.iter().map(of_side).collect();
    // Two triangles that traverse an edge in the same sense have opposite windings; of more, some lie on one
    // another.
    let first = sides[0][0];
    let is_turned = |i: usize, normals: &[DVec3; 2]| match edge.sides {
        [a, b] => is_forth(a) == is_forth(b),
        _ => normals[0].dot(first) < 0.0,
    } && i > 0;
    for (i, normals) in sides.iter_mut().enumerate() {
        if is_turned(i, normals) {
            *normals = normals.map(|n| -n);
        }
    }
    CurvedEdge { ends_m, curve: curve_between(ends_m[1] - ends_m[0], &sides), halvings: 0 }
}

/// Curve over a chord; `sides` are the normals at both ends, all on one side of the skin.
fn curve_between(chord: DVec3, sides: &[[DVec3; 2]]) -> Curve {
    let Some((&first, others)) = sides.split_first() else { return Curve::Straight };
    // Skins bend by less than a right angle between two vertices.
    if first[0].dot(first[1]) <= 0.0 {
        return Curve::Straight;
    }
    let apart = |end: usize| others.iter().map(|n| n[end].angle_between(first[end])).fold(0.0, f64::max);
    match (apart(0).max(apart(1)), others) {
        (most, _) if most <= SAME_NORMAL => Curve::OnSkin(first),
        (most, [second]) => crease(chord, &first, second).unwrap_or_else(|| match most {
            most if most <= CARELESS => Curve::OnSkin([0, 1].map(|end| mean(first[end], second[end]))),
            _ => Curve::Straight,
        }),
        _ => Curve::Straight,
    }
}

fn mean(a: DVec3, b: DVec3) -> DVec3 {
    (a + b).try_normalize().unwrap_or(a)
}

/// Crease where two skins meet: along the line in both tangent planes, or in the common one where they touch.
/// `None` if that line deviates from the chord by much more than the skins do.
fn crease(chord: DVec3, a: &[DVec3; 2], b: &[DVec3; 2]) -> Option<Curve> {
    let along = chord.try_normalize()?;
    let lean = |n: &[DVec3; 2]| n.map(|n| n.dot(along).abs().min(1.0).asin()).into_iter().fold(0.0, f64::max);
    let most = 2.0 * lean(a).max(lean(b)) + SAME_NORMAL;
    let tangent = |end: usize| {
        let both = a[end].cross(b[end]);
        let tangent = if both.length() > SAME_NORMAL { both } else { rejected(chord, a[end]) };
        let tangent = tangent.try_normalize()?;
        let tangent = if tangent.dot(along) < 0.0 { -tangent } else { tangent };
        (tangent.angle_between(along) <= most).then_some(tangent)
    };
    Some(Curve::Crease([tangent(0)?, tangent(1)?]))
}
