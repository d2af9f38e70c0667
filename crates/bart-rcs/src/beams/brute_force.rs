//! Slow, obvious reference of [`crate::beams::visibility`]: every facet is clipped against every other,
//! without hierarchy or lists.

use crate::beams::occlusion::lit_parts::LitParts;
use crate::beams::occlusion::shadow::{HiddenPart, Shadow};
use crate::beams::occlusion::view::View;
use crate::beams::visibility::{Buffers, Visibility};
use crate::geometry::border::Border;
use crate::geometry::clip::{Corner, Split, split};

/// Visibility by testing all pairs.
pub(crate) struct BruteForceVisibility;

impl Visibility for BruteForceVisibility {
    fn direct(view: &View) -> Vec<LitParts> {
        vec![parts_in(view)]
    }

    fn reflected(view: &View, _: &mut Buffers) -> LitParts {
        parts_in(view)
    }
}

fn parts_in(view: &View) -> LitParts {
    let facets = 0..view.world.facets().len() as u32;
    let shadows: Vec<Shadow> = facets.filter_map(|facet| Shadow::of(facet, view)).collect();
    let mut parts = LitParts::default();
    for target in &shadows {
        let mut corners = Vec::new();
        let Some(polygon) = view.clip(target, &mut corners, &mut Vec::new()) else { continue };
        let mut pieces = vec![corners[polygon].to_vec()];
        for occluder in shadows.iter().filter(|occluder| occluder.facet != target.facet) {
            let hides = occluder.hides(target, view);
            pieces = pieces
                .into_iter()
                .flat_map(|piece| outside(piece, occluder, hides, view.tolerance_m()))
                .collect();
        }
        pieces.iter().for_each(|piece| parts.push(target, view, piece));
    }
    parts
}

/// Parts of a piece outside one shadow.
fn outside(piece: Vec<Corner>, occluder: &Shadow, hides: HiddenPart, tolerance_m: f64) -> Vec<Vec<Corner>> {
    if hides == HiddenPart::Nothing {
        return vec![piece];
    }
    let (mut kept, mut rest) = (Vec::new(), piece.clone());
    for plane in occluder.planes(hides) {
        let mut corners = rest.clone();
        match split(&mut corners, 0..rest.len(), &plane, Border::Shadow, tolerance_m, &mut Vec::new()) {
            Split::Inside => {}
            Split::Outside => return vec![piece],
            Split::Cut { inside, outside } => {
                kept.push(corners[outside].to_vec());
                rest = corners[inside].to_vec();
            }
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::occlusion::lit_parts::LitParts;
    use crate::beams::occlusion::projection::ProjectedView;
    use crate::beams::occlusion::solid_cells::visible;
    use crate::beams::visibility::BvhVisibility;
    use crate::bodies::world::World;
    use crate::geometry::antenna::Antenna;
    use artifact::material::{Backing, Layer, Material, MeshMaterials, Thickness, Transmission};
    use artifact::scene::Mesh;
    use artifact::settings::Sides;
    use glam::DVec3;
    use num_complex::Complex64;

    const ROUND: u32 = 24;
    const DOWN: u32 = 16;
    const ANTENNAS: [Antenna; 2] =
        [Antenna::Point(DVec3::new(7.0, 2.0, 3.0)), Antenna::Direction(DVec3::new(0.36, 0.48, 0.8))];

    /// A ball of radius 1 m with triangles strewn around its centre, some through its skin; every
    /// `missing`-th of the ball's own is left out, and every third reversed.
    fn filled_ball(missing: usize) -> Mesh {
        let turn = |i: u32, n: u32| f64::from(i) / f64::from(n) * std::f64::consts::PI;
        let at = |i: u32, j: u32| {
            let (sin, cos) = turn(i, DOWN).sin_cos();
            let (y, x) = (2.0 * turn(j % ROUND, ROUND)).sin_cos();
            [sin * x, sin * y, cos]
        };
        let place = |i: u32, j: u32| if i == 0 || i == DOWN { i * ROUND } else { i * ROUND + j % ROUND };
        let quad = |i, j| {
            let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
            [[a, b, c], [a, c, d]]
        };
        let ball = (0..DOWN).flat_map(|i| (0..ROUND).flat_map(move |j| quad(i, j)));
        let is_left = |(index, t): &(usize, [u32; 3])| {
            index % missing != 7 && t[0] != t[1] && t[1] != t[2] && t[2] != t[0]
        };
        let turned =
            |(index, [a, b, c]): (usize, [u32; 3])| if index % 3 == 0 { [a, c, b] } else { [a, b, c] };
        let mut triangles: Vec<[u32; 3]> = ball.enumerate().filter(is_left).map(turned).collect();
        let mut vertices_m: Vec<[f64; 3]> =
            (0..=DOWN).flat_map(|i| (0..ROUND).map(move |j| at(i, j))).collect();
        let fraction = |i: usize, step: f64| ((i as f64 + 1.0) * step).fract() - 0.5;
        for i in 0..900 {
            let size_m = if i % 90 < 3 { 2.5 } else { 0.3 };
            let middle = [0.618_034, 0.414_214, 0.732_051].map(|step| fraction(i / 3, step));
            let corner = [0.236_068, 0.645_751, 0.316_625].map(|step| size_m * fraction(i, step));
            vertices_m.push([0, 1, 2].map(|k| middle[k] + corner[k]));
        }
        let first = vertices_m.len() as u32 - 900;
        triangles.extend((0..300).map(|t| [0, 1, 2].map(|k| first + 3 * t + k)));
        Mesh { vertices_m, triangles, ..Mesh::default() }
    }

    /// Lit area of every facet, m².
    fn lit_m2(parts: &[LitParts], facets: usize) -> Vec<f64> {
        let mut lit_m2 = vec![0.0; facets];
        parts
            .iter()
            .flat_map(|parts| &parts.parts)
            .for_each(|part| lit_m2[part.facet as usize] += part.area_m2);
        lit_m2
    }

    #[test]
    fn what_is_refused_is_dark_by_brute_force_and_the_rest_is_lit_as_ever() {
        for (missing, least_refused) in [(100_000, 500), (97, 100)] {
            let world = World::of_mesh(&filled_ball(missing)).unwrap();
            for antenna in ANTENNAS {
                let view = View::direct(&world, Sides::Two, antenna);
                let projected = ProjectedView::of_all(&view).unwrap();
                let left: Vec<u32> = visible(&projected, &view).iter().map(|facet| facet.facet).collect();
                let refused = projected.facets.len() - left.len();
                let asked = lit_m2(&BruteForceVisibility::direct(&view), world.facets().len());
                let got = lit_m2(&BvhVisibility::direct(&view), world.facets().len());
                println!("{refused} of {} refused, {least_refused} asked", projected.facets.len());
                assert!(refused >= least_refused);
                for (facet, (asked, got)) in asked.iter().zip(&got).enumerate() {
                    assert!((asked - got).abs() < 1e-12, "facet {facet}: {asked} asked, {got} got");
                    assert!(
                        *asked < 1e-12 || left.contains(&(facet as u32)),
                        "facet {facet} is lit and refused"
                    );
                }
            }
        }
    }

    #[test]
    fn a_ball_that_waves_pass_hides_nothing() {
        let layers = vec![Layer { thickness_m: 4e-3, permittivity: Complex64::new(6.0, -0.1) }];
        let glass = Material::Layers { layers, backing: Backing::Air, thickness: Thickness::Exact };
        let mesh = filled_ball(100_000);
        let ball = mesh.triangles.len() - 300;
        let inside = |transmission: Transmission| {
            let makeup = MeshMaterials { materials: vec![glass.clone(), Material::Conductor], transmission };
            let material_of_triangle = (0..mesh.triangles.len()).map(|t| u16::from(t >= ball)).collect();
            let materials = vec!["glass".to_owned(), "metal".to_owned()];
            let world =
                World::of_mesh(&Mesh { materials, material_of_triangle, makeup, ..mesh.clone() }).unwrap();
            let view = View::direct(&world, Sides::Two, ANTENNAS[0]);
            let facets = visible(&ProjectedView::of_all(&view).unwrap(), &view);
            let left: Vec<usize> =
                facets.iter().map(|facet| facet.facet as usize).filter(|f| *f >= ball).collect();
            let lit_m2 = lit_m2(&BruteForceVisibility::direct(&view), world.facets().len());
            let lit: Vec<usize> = (ball..lit_m2.len()).filter(|facet| lit_m2[*facet] > 1e-12).collect();
            assert!(lit.iter().all(|facet| left.contains(facet)), "{transmission:?}: lit and refused");
            [lit.len(), left.len()]
        };
        let [behind, through] = [inside(Transmission::Ignored), inside(Transmission::Followed)];
        println!("lit, left of 300: behind metal {behind:?}, behind glass {through:?}");
        assert!(through[0] > behind[1] + 20, "the ball hides these, and glass does not");
    }

    #[test]
    fn an_antenna_among_the_facets_has_no_prospect() {
        let world = World::of_mesh(&filled_ball(100_000)).unwrap();
        let view = View::direct(&world, Sides::Two, Antenna::Point(DVec3::splat(0.1)));
        assert!(ProjectedView::of_all(&view).is_none());
    }
}
