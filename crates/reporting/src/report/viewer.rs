//! View to walk around in, on the report's page: its numbers as compact arrays, and the script that draws
//! them (`docs/report.md`). Where scripts do not run, and on paper, the page's drawings stand for it.

pub(in crate::report) mod packed; // numbers in few bytes
pub(in crate::report) mod page_script; // numbers and scripts in a page
mod page_budget; // how much of a run the view holds
mod path_geometry; // the places that a path passes
mod strongest_paths; // what is shown of a frame's paths
mod map_cells; // a frame's map and whose echoes are in it
pub(in crate::report) mod body_view; // a body where it stands
pub(in crate::report) mod surroundings; // radar, road and meshes
mod viewed_frame; // all of one frame
mod section; // the part of the page

pub(crate) use section::{STYLE, section};
pub(crate) use viewed_frame::Viewed;
