//! `study`: pages of `docs/` with measured figures, each by its name. Three have pictures and commands of
//! their own: `chart`, `atlas` and `levels`.

mod sources;
mod page;
mod extent;
mod rcs_solvers;
mod bodies;
mod closed_forms;
pub(crate) mod scenes;
mod table;
mod chart;
mod atlas;
mod search;
mod levels;
pub(crate) mod plotted_studies;
mod pages;
mod catalogue;

pub(crate) use catalogue::{STUDIES, by_name, compare, run};
pub(crate) use page::Freshness;
