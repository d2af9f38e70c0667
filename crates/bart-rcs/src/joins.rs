//! Joins of beams from both ends on a facet.

pub(crate) mod outline; // outline of the overlap of two beams
pub(crate) mod shadow_sides; // borders along lines that cut out shadows
pub(crate) mod specular_separation; // separation of a double reflection from its specular
pub(crate) mod joint; // parts of a facet lit from both ends
pub(crate) mod own_edge; // weights of a sequence's nodes
pub(crate) mod join; // joins of beams from both ends
pub(crate) mod group; // contributions of similar length
pub(crate) mod scatterer; // joints with their legs
pub(crate) mod small_parts; // parts that meshes lack, as random scatterers
pub(crate) mod affordable_accuracy; // affordable accuracy of their integrals
pub(crate) mod band; // many frequencies from few
