//! The chart as CSV and page.

use crate::study::chart::Chart;
use crate::study::chart::answers::Answers;
use crate::study::chart::row::SettingRow;
use crate::study::extent::Extent;
use crate::study::table;

/// Columns of interface.md.
pub(in crate::study) fn csv(rows: &[SettingRow]) -> String {
    table::csv("stage,scene,method,setting,seconds,peak_mib,error_db,reference", rows.iter().map(fields))
}

fn fields(row: &SettingRow) -> Vec<String> {
    let peak = row.peak_mib.map_or(String::new(), |m| format!("{m:.0}"));
    let (seconds, error) = (format!("{:.3e}", row.seconds), table::decibels(Some(row.error)));
    let words = [row.stage, &row.scene, row.method, &row.setting, &seconds, &peak, &error, &row.reference];
    words.map(str::to_owned).to_vec()
}

/// Columns of interface.md.
pub(in crate::study) fn answers_csv(rows: &[Answers]) -> String {
    let head =
        "scene,asked_db,processor_s,peak_mib,found,to_be_found,range_m,velocity_mps,across_m,probability";
    table::csv(head, rows.iter().map(answer_fields))
}

fn answer_fields(row: &Answers) -> Vec<String> {
    let told = |value: Option<f64>, digits: usize| value.map_or(String::new(), |v| format!("{v:.digits$}"));
    let error = |at: usize| told(row.errors.map(|errors| errors[at]), 3);
    vec![
        row.scene.into(),
        format!("{:.0}", row.asked_db),
        format!("{:.2}", row.processor_s),
        told(row.peak_mib, 0),
        row.found.to_string(),
        row.to_be_found.to_string(),
        error(0),
        error(1),
        error(2),
        told(row.probability, 2),
    ]
}

const ANSWERS: [&str; 10] = [
    "scene",
    "asked, dB",
    "processor seconds",
    "peak, MiB",
    "found",
    "of",
    "range, m",
    "velocity, m/s",
    "across, m",
    "probability of the true class",
];

pub(in crate::study) fn page(Chart { rows, answers }: &Chart, extent: Extent) -> String {
    let header = ["stage", "scene", "method", "setting", "seconds", "peak, MiB", "error, dB", "reference"];
    let command = match extent {
        Extent::Quick => "cargo xtask chart --quick --docs",
        Extent::Full => "cargo xtask study chart",
    };
    format!(
        "# Chart: speed against accuracy\n\n\
         Made by `{command}` on {}. Seconds are those of one run, all threads, building of hierarchies included. The peak is \
         the largest resident size of the whole program while a row ran (empty where the system does not count it). Errors \
         are complex amplitude errors as in `conventions.md`, against another method, carried to convergence as far as it goes; \
         never against a method's own next setting. Beams use the exit node here, because rays do.\n\n\
         \"frame by …\" are whole frames of vehicles in lane 2, path by path and by the paper's table (`echo = \"rcs-table\"`): the \
         cube's complex error, and that of the magnitudes of its range-Doppler maps; seconds are of tracing + echo. \
         The table errs by as much as there is to see at any range of a road ([why](rcs-tables.md)).\n\n\
         ![seconds against error of each method](pictures/chart.svg)\n\n\
         Better is lower and further left, in both pictures; [chart.csv](pictures/chart.csv) is their table. Whole frames, each a line from its paths to its table:\n\n\
         ![seconds against error of whole frames](pictures/chart-frames.svg)\n\n\
         The whole chain, from the scene to place and class, by the accuracy that is asked; errors are root mean squares over \
         the bodies found, against the truth ([chart-answers.csv](pictures/chart-answers.csv)):\n\n\
         ![seconds against error of place](pictures/chart-answers.svg)\n\n{}\n{}",
        machine(),
        table::markdown(&ANSWERS, answers.iter().map(answer_fields)),
        table::markdown(&header, rows.iter().map(fields))
    )
}

/// Cores and instructions: what times depend on most.
fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    format!("{cores} cores, {}", instructions())
}

#[cfg(target_arch = "x86_64")]
fn instructions() -> &'static str {
    if std::arch::is_x86_feature_detected!("avx512f") {
        "x86-64 with AVX-512"
    } else if std::arch::is_x86_feature_detected!("avx2") {
        "x86-64 with AVX2"
    } else {
        "x86-64"
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn instructions() -> &'static str {
    std::env::consts::ARCH
}
