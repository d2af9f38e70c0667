//! Studies of designs: what their files may say, what comes of them, and that neither threads, parts nor
//! interruptions change it.

#[path = "../common/mod.rs"]
mod common;

mod refusals;
mod results;
