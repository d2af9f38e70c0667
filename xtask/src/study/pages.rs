//! Studies with rows in a part of a page between prose: they measure many cases of what tests of the crates
//! assert for few, or run whole scenes.

pub(super) mod deployment;
pub(super) mod force;
pub(super) mod fuzz;
pub(super) mod row_cache;
pub(super) mod measures;
mod page_section;
pub(super) mod planner;
pub(super) mod real_captures;
mod real_vehicles;
pub(super) mod same_bytes;
pub(super) mod scattering;
pub(super) mod sensitivity;
pub(super) mod signals;
pub(super) mod whole_runs;

pub(super) use page_section::PageSection;
