//! Interactive view on the report's page: its numbers as compact arrays, and the script that draws them
//! (`docs/report.md`). Without scripts, and on paper, the page's drawings replace it.

pub(in crate::report) mod packed; // numbers in few bytes
pub(in crate::report) mod page_script; // numbers and scripts in a page
mod page_budget; // the part of a run in the view
mod path_geometry; // the places on a path
mod strongest_paths; // the shown paths of a frame
mod map_cells; // a frame's map with the origins of its cells
pub(in crate::report) mod body_view; // a body at its pose
pub(in crate::report) mod surroundings; // radar, road and meshes
mod viewed_frame; // all of one frame
mod section; // the part of the page

pub(crate) use section::{STYLE, section};
pub(crate) use viewed_frame::ViewerData;
