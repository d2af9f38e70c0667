//! Tests of what the waveform and the array make of an echo.

mod waveform_table;
mod point_target;
mod multiplexing;
mod schedules;
mod chirp_phases;
mod large_arrays;
mod pattern_tables;
