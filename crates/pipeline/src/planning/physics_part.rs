//! Parts of the physics that keys of a scene switch on or off.

use artifact::material::Transmission;
use artifact::scene::SceneHeader;
use artifact::settings::{BetweenBodies, Edges};

/// Part of the physics that is modelled or left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum PhysicsPart {
    /// Paths over several bodies.
    BetweenBodies,
    /// Paths by the road.
    Road,
    /// Diffraction by edges.
    Edges,
    /// Waves that pass sheets.
    Sheets,
}

impl PhysicsPart {
    /// All parts.
    pub(crate) const ALL: [Self; 4] = [Self::BetweenBodies, Self::Road, Self::Edges, Self::Sheets];

    /// Name in the lines of a plan.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::BetweenBodies => "ways between bodies",
            Self::Road => "ways by the road",
            Self::Edges => "diffraction by edges",
            Self::Sheets => "waves through sheets",
        }
    }

    /// Whether a scene models this part.
    pub(crate) fn is_in(self, header: &SceneHeader) -> bool {
        match self {
            Self::BetweenBodies => header.fidelity.between_bodies == BetweenBodies::Traced,
            Self::Road => header.road.is_some(),
            Self::Edges => header.fidelity.edges != Edges::Ignored,
            Self::Sheets => header.materials.transmission == Transmission::Followed,
        }
    }

    /// Models this part; an existing road stays as it is.
    pub(crate) fn model(self, header: &mut SceneHeader) {
        match self {
            Self::BetweenBodies => header.fidelity.between_bodies = BetweenBodies::Traced,
            Self::Road => header.road = header.road.take().or_else(bart_rcs::usual_road),
            Self::Edges => header.fidelity.edges = Edges::FirstOrder,
            Self::Sheets => transmit(header, Transmission::Followed),
        }
    }

    /// Leaves this part out.
    pub(crate) fn leave_out(self, header: &mut SceneHeader) {
        match self {
            Self::BetweenBodies => header.fidelity.between_bodies = BetweenBodies::LeftOut,
            Self::Road => header.road = None,
            Self::Edges => header.fidelity.edges = Edges::Ignored,
            Self::Sheets => transmit(header, Transmission::Ignored),
        }
    }
}

/// Sets in the scene and in its meshes whether waves pass sheets.
fn transmit(header: &mut SceneHeader, transmission: Transmission) {
    header.materials.transmission = transmission;
    header.meshes.iter_mut().for_each(|mesh| mesh.makeup.transmission = transmission);
}
