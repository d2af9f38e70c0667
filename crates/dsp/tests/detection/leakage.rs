//! What leaks from transmitters to receivers: a gate in range keeps it out of the points.

use crate::common::*;
use dsp::cfar::UNTESTED;
use dsp::{Receiver, range_axis_m};

/// A leak in the first cells, 40 dB over a body at 20 m.
#[test]
fn nothing_nearer_than_the_gate_is_detected_and_what_is_farther_stays() {
    let header = header(256, 64, elements_1x4());
    let leak = target([0.0, 0.3, 6.0], [0.0, 0.0, 0.0], 1e-6);
    let body = target([0.0, 20.0, 6.0], [0.0, -3.0, 0.0], 10.0);
    let frame = cube(&header, &[leak, body], 1);
    let open = Receiver::new(&header).unwrap().process(&frame).unwrap();
    let near =
        |points: &artifact::points::PointsFrame| points.points.iter().filter(|p| p.range_m < 5.0).count();
    assert!(near(&open.1) > 0, "the leak is there to be left out");
    let mut gated = header.clone();
    gated.dsp.nearest_m = 5.0;
    let (map, points) = Receiver::new(&gated).unwrap().process(&frame).unwrap();
    assert_eq!(near(&points), 0);
    assert!(points.objects.iter().any(|object| (object.range_m - 20.0).abs() < 0.1), "{:?}", points.objects);
    assert_eq!(map.values, open.0.values, "the map stays as it is");
    let axis_m = range_axis_m(&gated);
    for (cell, state) in map.mask.iter().enumerate() {
        assert_eq!(*state == UNTESTED, axis_m[cell % axis_m.len()] < 5.0, "{cell}");
    }
    // Behind the gate thresholds are those of before: the noise of the cells before it is still noise.
    let behind = |mask: &[u8]| -> Vec<u8> {
        mask.iter().enumerate().filter(|(c, _)| axis_m[c % axis_m.len()] >= 5.0).map(|(_, s)| *s).collect()
    };
    assert_eq!(behind(&map.mask), behind(&open.0.mask));
}
