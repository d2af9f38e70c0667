//! A body and a radar that the tests of this folder share.

use crate::training_sets::truth_boxes::TruthBox;
use artifact::cube::CubeHeader;
use artifact::settings::Class;
use glam::DVec3;
use pipeline::chain::keys::cube_header;
use scene::ReadOptions;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

/// A bus of 12 m × 2.5 m × 3 m that drives towards the origin along −y.
pub(crate) fn bus() -> TruthBox {
    TruthBox {
        number: 3,
        id: "bus-1".into(),
        class: Class::Bus,
        foot_m: DVec3::new(2.0, 50.0, 0.0),
        size_m: [12.0, 2.5, 3.0],
        yaw_rad: -FRAC_PI_2,
        velocity_mps: DVec3::new(0.0, -10.0, 0.0),
    }
}

/// Header of the cubes of a radar whose two sub-frames have chirps every 20 and every 40 µs.
pub(crate) fn sub_framed() -> CubeHeader {
    let text = "name = \"s\"\n[radar.waveform]\nsamples = 64\nchirps = 32\nsub_frame_idle_us = [7.5, 27.5]\n";
    let options = ReadOptions::names_only();
    cube_header(&scene::read_text(Path::new("s.toml"), text, &options).unwrap())
}

#[test]
fn corners_are_those_of_the_turned_box_and_the_nearest_place_is_on_its_front() {
    let corners = bus().corners_m();
    let extreme = |pick: fn(DVec3, DVec3) -> DVec3| corners.into_iter().reduce(pick).unwrap();
    assert!((extreme(DVec3::min) - DVec3::new(0.75, 44.0, 0.0)).length() < 1e-12);
    assert!((extreme(DVec3::max) - DVec3::new(3.25, 56.0, 3.0)).length() < 1e-12);
    let nearest = bus().nearest_m(DVec3::new(0.0, 0.0, 6.0));
    assert!((nearest - DVec3::new(0.75, 44.0, 3.0)).length() < 1e-12, "{nearest}");
    let inside = DVec3::new(2.0, 47.0, 1.0);
    assert!((bus().nearest_m(inside) - inside).length() < 1e-12);
}
