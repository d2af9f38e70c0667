//! Plots as SVG, drawn once and put onto a page as they are or onto disk as PNG: axes, lines, maps in
//! decibels, polar diagrams.
//!
//! A leaf: it knows numbers, words and colours, and no physics. A file of it uses only files that stand
//! before it in this list.

pub mod svg;
pub mod colours;
pub mod clip;
pub mod labels;
pub mod marks;
pub mod layout;
pub mod axes;
pub mod error;
pub mod raster;
pub mod heat_map;
pub mod lines;
pub mod polar;
