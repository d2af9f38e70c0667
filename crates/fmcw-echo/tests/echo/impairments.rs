//! Tests of what is not ideal in a radar, and of other radars.

mod hardware;
mod phase_noise;
mod interferers;
mod real_sampling;
mod receiver_noise;
