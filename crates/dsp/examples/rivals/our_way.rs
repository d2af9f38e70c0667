//! This crate.

use crate::{CANDIDATES, Measurement, job, quickest_s};
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::settings::Detector;
use dsp::angle::VirtualArray;
use dsp::cfar::Cfar;
use dsp::range_doppler::{RangeDoppler, all_channels};

pub(crate) fn measured(header: &CubeHeader, frame: &CubeFrame) -> Vec<Measurement> {
    let transform = RangeDoppler::new(header).unwrap();
    let of = |what: &str, seconds: f64| Measurement { job: job(header, what), program: "ours".into(), seconds };
    let maps = quickest_s(|| all_channels(header, &transform, &frame.samples).unwrap());
    // Copies 16 bytes a value, as a transform must at least.
    let copy = quickest_s(|| frame.samples.clone());
    let map = dsp::range_doppler(header, frame).unwrap();
    let mut list = vec![of("range-Doppler", maps)];
    list.push(Measurement {
        job: job(header, "range-Doppler"),
        program: "a copy of the cube, one thread".into(),
        seconds: copy,
    });
    for (what, detector) in [("CA-CFAR", Detector::CaCfar), ("OS-CFAR", Detector::OsCfar)] {
        let mut header = header.clone();
        header.dsp.detector = detector;
        let cfar = Cfar::new(&header).unwrap();
        let power = dsp::power_map(&header, &map).unwrap().into_raw_vec_and_offset().0;
        list.push(of(what, quickest_s(|| cfar.mask(&power, 0.0))));
    }
    let array = VirtualArray::new(header);
    let columns = header.shape()[2];
    let angles = quickest_s(|| {
        let cell = |i: usize| [i / columns, i % columns];
        let angle = |i: usize| array.direction(&[array.snapshot(header, &map, cell(i), 0.0)], 40.0);
        (0..CANDIDATES).map(angle).collect::<Vec<_>>()
    });
    list.push(of("angles of 1000 cells", angles));
    list
}
