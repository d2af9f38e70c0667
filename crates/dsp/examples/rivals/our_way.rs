//! This crate.

use crate::task::{CANDIDATES, Measurement, job, quickest_s};
use artifact::cube::{CubeFrame, CubeHeader};
use artifact::settings::Detector;
use dsp::RangeDoppler;
use dsp::angle::VirtualArray;
use dsp::cfar::Cfar;
use rayon::prelude::*;

pub(crate) fn measured(header: &CubeHeader, frame: &CubeFrame) -> Vec<Measurement> {
    let transform = RangeDoppler::new(header).unwrap();
    let of =
        |what: &str, seconds: f64| Measurement { job: job(header, what), program: "ours".into(), seconds };
    let maps = quickest_s(|| transform.all_channels(frame).unwrap());
    // Copies 16 bytes a value, as a transform must at least.
    let copy = quickest_s(|| frame.samples.clone());
    let map = dsp::Receiver::new(header).unwrap().range_doppler(frame).unwrap();
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
    let cells = (0..CANDIDATES).into_par_iter().with_min_len(CANDIDATES / 16);
    let snapshot = |i: usize| [array.snapshot(&map, [i / columns, i % columns], 0.0)];
    let fft =
        quickest_s(|| cells.clone().map(|i| array.fft_direction(&snapshot(i), 40.0)).collect::<Vec<_>>());
    let beams = quickest_s(|| cells.clone().map(|i| array.direction(&snapshot(i), 40.0)).collect::<Vec<_>>());
    list.push(of("angle FFT of 1000 cells", fft));
    list.push(Measurement {
        job: job(header, "angle FFT of 1000 cells"),
        program: "ours, climbed on the exact spherical beam".into(),
        seconds: beams,
    });
    list
}
