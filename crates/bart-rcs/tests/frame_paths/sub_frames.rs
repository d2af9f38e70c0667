//! Frames of a radar that alternates between chirp intervals.

use crate::bodies::carts::cart;
use crate::frames::{pose, scene};
use artifact::settings::Detail;
use bart_rcs::{FrameContext, Tracer, reduce_detail};
use std::f64::consts::FRAC_PI_2;

/// The second sub-frame is four times as long as the first, so the cart moves on four times as far.
#[test]
fn a_level_of_detail_is_measured_over_the_sub_frame_of_its_frame() {
    let cart = (cart(0.1), pose([5.75, 30.0, 0.0], [0.0, -10.0, 0.0], -FRAC_PI_2));
    let (mut header, mut frame) = scene(&[cart], &[], -20.0, 1);
    header.fidelity.detail = Detail::Statistical;
    let interval_s = header.radar.waveform.chirp_interval_s;
    header.radar.schedule.sub_frame_intervals_s = vec![interval_s, 4.0 * interval_s];
    frame.index = 1;
    let tracer = Tracer::new(&header).unwrap();
    let all = tracer.all_paths(&header, &frame, &FrameContext::ALONE).unwrap();
    let made = tracer.paths(&header, &frame, &FrameContext::ALONE).unwrap();
    assert_eq!(made, reduce_detail(&header.in_frame(1), all.clone()));
    assert_ne!(
        made,
        reduce_detail(&header.in_frame(0), all),
        "the sub-frames give the same, so nothing is tested"
    );
}
