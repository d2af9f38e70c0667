//! Words of the settings of a table of S, which the command line and the Python package take and which its
//! description records.

use artifact::material::Transmission;
use artifact::radar::Polarization;
use artifact::settings::{Edges, NodeRule, Sides, SmallParts, Surface};

/// Polarizations by their words: the first letter receives, the second transmits.
pub const POLARIZATIONS: [(&str, Polarization); 4] =
    [("vv", Polarization::Vv), ("hh", Polarization::Hh), ("vh", Polarization::Vh), ("hv", Polarization::Hv)];
/// Diffraction by edges.
pub const EDGES: [(&str, Edges); 2] = [("on", Edges::FirstOrder), ("off", Edges::Ignored)];
/// Facets on which a multiple reflection is integrated.
pub const NODES: [(&str, NodeRule); 3] =
    [("middle", NodeRule::Middle), ("exit", NodeRule::Exit), ("own-edge", NodeRule::OwnEdge)];
/// Sources of small parts that a mesh lacks.
pub const SMALL_PARTS: [(&str, SmallParts); 2] = [
    (SmallParts::OfMesh.name(), SmallParts::OfMesh),
    (SmallParts::Statistical.name(), SmallParts::Statistical),
];
/// Surfaces that facets represent.
pub const SURFACES: [(&str, Surface); 2] = [("flat", Surface::Flat), ("smooth", Surface::Smooth)];
/// Sides of a facet that scatter.
pub const SIDES: [(&str, Sides); 2] = [("two", Sides::Two), ("one", Sides::One)];
/// Whether waves are followed through sheets.
pub const TRANSMISSION: [(&str, Transmission); 2] =
    [("on", Transmission::Followed), ("off", Transmission::Ignored)];

/// Word of a setting; empty if it has none.
pub(super) fn word_of<T: PartialEq>(words: &[(&'static str, T)], setting: T) -> &'static str {
    words.iter().find(|(_, other)| *other == setting).map_or("", |(word, _)| word)
}
