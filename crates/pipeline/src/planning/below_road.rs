//! Bodies that reach below the road of their scene: the parts below it are traced as if there were no road.

use artifact::scene::{Mesh, Pose, SceneHeader};

/// Sentences about the bodies that are partly below the road z = 0 when they are first in view, one each;
/// none without a road. Bodies wholly below it are refused in tracing.
pub(crate) fn notes(header: &SceneHeader) -> Vec<String> {
    if header.road.is_none() {
        return vec![];
    }
    let least_m = header.radar.waveform.wavelength_m();
    let bodies = header.bodies().zip(header.first_poses());
    bodies.filter_map(|((id, kind), pose)| note(id, header.mesh_of(kind)?, pose?, least_m)).collect()
}

/// Sentence about one body, if more than `least_m` of it is below the road.
fn note(id: &str, mesh: &Mesh, pose: Pose, least_m: f64) -> Option<String> {
    let [low_m, high_m] = heights_m(mesh)?.map(|z| z + pose.position_m[2]);
    (low_m < -least_m && high_m > 0.0).then(|| {
        format!(
            "note: `{id}` reaches {:.3} m below the road z = 0, which does not hide that part: let it stand on the \
             road, by z of its position_m or of its mesh",
            -low_m
        )
    })
}

/// Heights of a mesh's lowest and highest vertex.
fn heights_m(mesh: &Mesh) -> Option<[f64; 2]> {
    let used = mesh.triangles.iter().flatten().filter_map(|vertex| mesh.vertices_m.get(*vertex as usize));
    used.map(|vertex| [vertex[2]; 2]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::material::{Material, Road};
    use artifact::scene::{Role, Target, TargetKind};

    /// A wall of 1 m whose foot is at this height, over a road.
    fn wall_at(z_m: f64) -> SceneHeader {
        let options = scene::ReadOptions::names_only();
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        let read = scene::read(&file, &options).unwrap();
        let start = Pose { position_m: [0.0, 20.0, z_m], ..read.targets[0].start };
        let kind = TargetKind::Mesh { class: None, model: "wall".into(), mesh: 0 };
        let wall = Mesh {
            vertices_m: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        SceneHeader {
            targets: vec![Target { id: "wall".into(), role: Role::Target, kind, start }],
            meshes: vec![wall].into(),
            road: Some(Road { material: Material::Conductor, rms_height_m: 0.0 }),
            ..read
        }
    }

    #[test]
    fn a_body_that_reaches_below_the_road_is_told_and_one_that_stands_on_it_is_not() {
        assert!(notes(&wall_at(0.0)).is_empty() && notes(&wall_at(-1e-3)).is_empty());
        let told = notes(&wall_at(-0.25));
        assert!(told.len() == 1 && told[0].contains("`wall` reaches 0.250 m below the road"), "{told:?}");
        assert!(notes(&SceneHeader { road: None, ..wall_at(-0.25) }).is_empty());
    }
}
