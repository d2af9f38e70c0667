//! Signals as drawn and judged by tests of `dsp` and of scenes.

#[path = "../../../../../crates/dsp/tests/common/mod.rs"]
pub(crate) mod common;
#[path = "../../../../../crates/dsp/tests/detection/alarm_rates.rs"]
pub(crate) mod alarm_rates;
#[path = "../../../../../crates/dsp/tests/estimation/bound_trials.rs"]
pub(crate) mod bound_trials;
#[path = "../../../../../crates/dsp/tests/direction/erring_elements.rs"]
pub(crate) mod erring_elements;
#[path = "../../../../../crates/dsp/tests/estimation/fold_trials.rs"]
pub(crate) mod fold_trials;
#[path = "../../../../../crates/dsp/tests/direction/ghost_cells.rs"]
pub(crate) mod ghost_cells;
#[path = "../../../../../crates/wayside/tests/scenes/ghost_streets.rs"]
pub(crate) mod ghost_streets;
#[path = "../../../../../crates/dsp/tests/direction/pair_trials.rs"]
pub(crate) mod pair_trials;
