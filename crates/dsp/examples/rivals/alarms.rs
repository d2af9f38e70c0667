//! False-alarm rates of our CA-CFAR and of mmwcore's, both asked for the same: `-- alarms`.
//!
//! mmwcore takes a factor instead of a rate: the textbook's α = N(P^(−1/N) − 1) of N training cells. It is
//! given powers.

use crate::mmwcore_way::alarms_of_map;
use crate::task::{GUARD, TRAINING, common, header};
use artifact::settings::Window;
use dsp::cfar::{Cfar, DETECTED};

const ZONES: [&str; 3] = ["interior", "range edges", "Doppler edges"];
const MAPS: u64 = 400;

pub(crate) fn print_table() {
    println!("| window | asked | zone | ours, of it | mmwcore 0.3.0, of it |\n|---|---|---|---|---|");
    for window in [Window::Rect, Window::Hann] {
        for rate in [1e-2, 1e-3] {
            let [ours, theirs, cells] = counted(window, rate);
            for zone in 0..3 {
                let of = |alarms: &[f64; 3]| told(alarms[zone] / cells[zone] / rate);
                println!("| {window:?} | {rate:.0e} | {} | {} | {} |", ZONES[zone], of(&ours), of(&theirs));
            }
        }
    }
}

/// Text of a rate over that asked for; a zone of thousands of cells without any alarm was not tested.
fn told(rate: f64) -> String {
    if rate > 0.0 { format!("{rate:.3}") } else { "untested".to_owned() }
}

/// Alarms of ours, of mmwcore, and cells, by zone.
fn counted(window: Window, rate: f64) -> [[f64; 3]; 3] {
    let mut header = header(common::elements_1x1(), 128, 256);
    (header.dsp.range_window, header.dsp.doppler_window) = (window, window);
    header.dsp.false_alarm_rate = rate;
    let cfar = Cfar::new(&header).unwrap();
    let (side, hole) = (f64::from(2 * (GUARD + TRAINING) + 1), f64::from(2 * GUARD + 1));
    let training = side * side - hole * hole;
    let factor = training * (rate.powf(-1.0 / training) - 1.0);
    let mut sums = [[0.0; 3]; 3];
    for seed in 0..MAPS {
        let map =
            dsp::Receiver::new(&header).unwrap().range_doppler(&common::cube(&header, &[], seed)).unwrap();
        let power: Vec<f64> = dsp::power_map(&header, &map).unwrap().into_raw_vec_and_offset().0;
        let ours = cfar.mask(&power, 0.0);
        (0..power.len()).for_each(|cell| sums[2][zone(cell)] += 1.0);
        (0..power.len()).filter(|&cell| ours[cell] == DETECTED).for_each(|cell| sums[0][zone(cell)] += 1.0);
        alarms_of_map(&power, [128, 256], factor as f32).for_each(|cell| sums[1][zone(cell)] += 1.0);
    }
    sums
}

fn zone(cell: usize) -> usize {
    let reach = (GUARD + TRAINING) as usize;
    let is_within = |at: usize, cells: usize| (reach..cells - reach).contains(&at);
    match (is_within(cell / 256, 128), is_within(cell % 256, 256)) {
        (_, false) => 1,
        (false, true) => 2,
        (true, true) => 0,
    }
}
