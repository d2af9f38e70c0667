//! Panes, panels and wheel arches cut into a skin at plain places.

use crate::vehicles::drawing::stencil::{CutTreatment, cut, rounded_rectangle};
use crate::vehicles::drawing::surface::{Material, Surface};
use glam::DVec3;

/// A pane with its rubber seal, 8 mm behind the skin.
pub(crate) const PANE: CutTreatment = pane(0.008);

/// A pane with its rubber seal, at a depth behind the skin.
pub(crate) const fn pane(depth_m: f64) -> CutTreatment {
    inset(Material::Glass, Material::Plastic, depth_m)
}

/// A panel of another material, at a depth behind the skin; in the skin if the depth is below `FLUSH_M` or
/// negative.
pub(crate) const fn inset(material: Material, rim: Material, depth_m: f64) -> CutTreatment {
    if depth_m < FLUSH_M {
        CutTreatment::Recoloured(material)
    } else {
        CutTreatment::Inset { material, rim, depth_m }
    }
}

/// Depth below which a panel is flush: walls would have edges shorter than those of a skin.
const FLUSH_M: f64 = 0.006;

/// Side of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flank {
    Left,
    Right,
    Both,
}

/// End of a body, with its extent along x.
#[derive(Debug, Clone, Copy)]
pub(crate) enum End {
    Front { beyond_x: f64 },
    Rear { beyond_x: f64 },
}

/// Position of a panel in its own two coordinates (x or y, then z), and the radius of its corners.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Panel {
    pub(crate) along_m: [f64; 2],
    pub(crate) height_m: [f64; 2],
    pub(crate) radius_m: f64,
}

/// A panel from plain numbers.
pub(crate) fn panel(along_m: [f64; 2], height_m: [f64; 2], radius_m: f64) -> Panel {
    Panel { along_m, height_m, radius_m }
}

/// Cuts a panel into a flank; `along_m` is x. Only skin farther than 0.3 m from the middle plane is affected.
pub(crate) fn flank_panel(skin: Surface, flank: Flank, panel: Panel, inside: CutTreatment) -> Surface {
    let outline = |p: DVec3| {
        let out = match flank {
            Flank::Left => p.y,
            Flank::Right => -p.y,
            Flank::Both => p.y.abs(),
        };
        rounded_rectangle(p.x, p.z, panel.along_m, panel.height_m, panel.radius_m).min(out - 0.3)
    };
    cut(skin, outline, inside)
}

/// Cuts a panel into an end; `along_m` is y.
pub(crate) fn end_panel(skin: Surface, end: End, panel: Panel, inside: CutTreatment) -> Surface {
    cut(
        skin,
        |p| rounded_rectangle(p.y, p.z, panel.along_m, panel.height_m, panel.radius_m).min(end.reach(p)),
        inside,
    )
}

/// Cuts one panel on the left and one on the right of an end; `along_m` is |y|.
pub(crate) fn end_panel_pair(skin: Surface, end: End, panel: Panel, inside: CutTreatment) -> Surface {
    let outline = |p: DVec3| rounded_rectangle(p.y.abs(), p.z, panel.along_m, panel.height_m, panel.radius_m);
    cut(skin, |p| outline(p).min(end.reach(p)), inside)
}

impl End {
    fn reach(self, p: DVec3) -> f64 {
        match self {
            Self::Front { beyond_x } => p.x - beyond_x,
            Self::Rear { beyond_x } => beyond_x - p.x,
        }
    }
}

/// Cuts wheel arches on both flanks, open to `inner_y` from the middle plane.
pub(crate) fn wheel_arch(skin: Surface, [axle_x, axle_z]: [f64; 2], radius_m: f64, inner_y: f64) -> Surface {
    let circle = |p: DVec3| radius_m - (p.x - axle_x).hypot(p.z - axle_z);
    cut(skin, |p| circle(p).min(p.y.abs() - inner_y), CutTreatment::Opened { flange_m: 0.05 })
}
