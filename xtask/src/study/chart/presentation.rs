//! The chart as tables and page.

use crate::study::chart::Chart;
use crate::study::chart::answers::ChainResult;
use crate::study::chart::receiver::EstimateRow;
use crate::study::chart::rivals::RivalRow;
use crate::study::chart::row::SettingRow;
use crate::study::extent::Extent;
use crate::study::table::{self, csv};
use artifact::units::db_from_amplitude;

const HEAD: [&str; 10] = [
    "stage",
    "scene",
    "method",
    "setting",
    "seconds",
    "peak_mib",
    "error_db",
    "reference",
    "processor_s",
    "size",
];
const ESTIMATES: [&str; 9] =
    ["array", "snr_db", "method", "processor_ms", "found", "range_db", "velocity_db", "right_db", "up_db"];
const RIVALS: [&str; 6] = ["job", "work", "ours_s", "rival", "rival_s", "error_db"];
const ANSWERS: [&str; 10] = [
    "scene",
    "asked_db",
    "processor_s",
    "peak_mib",
    "found",
    "to_be_found",
    "range_m",
    "velocity_mps",
    "across_m",
    "probability",
];

/// Tables of docs/interface.md, by their names.
pub(in crate::study) fn tables(chart: &Chart) -> Vec<(&'static str, String)> {
    let (rows, answers) = (chart.rows.iter().map(fields), chart.answers.iter().map(answer_fields));
    let estimates = chart.estimates.iter().map(estimate_fields);
    let rivals = chart.rivals.iter().map(rival_fields);
    vec![
        ("chart", csv(&HEAD.join(","), rows)),
        ("chart-answers", csv(&ANSWERS.join(","), answers)),
        ("chart-estimates", csv(&ESTIMATES.join(","), estimates)),
        ("chart-outside", csv(&RIVALS.join(","), rivals)),
    ]
}

fn number_or_blank(value: Option<f64>, digits: usize) -> String {
    value.map_or(String::new(), |v| format!("{v:.digits$}"))
}

fn fields(row: &SettingRow) -> Vec<String> {
    let error = table::decibels(Some(row.error));
    let [seconds, processor_s] = [row.cost.seconds, row.cost.processor_s].map(|s| format!("{s:.3e}"));
    let peak = number_or_blank(row.cost.peak_mib, 0);
    let words = [&row.stage, &row.scene, &row.method, &row.setting, &seconds, &peak, &error, &row.reference];
    words.into_iter().chain([&processor_s, &row.size]).cloned().collect()
}

fn answer_fields(row: &ChainResult) -> Vec<String> {
    let error = |at: usize| number_or_blank(row.errors.map(|errors| errors[at]), 3);
    vec![
        row.scene.clone(),
        format!("{:.0}", row.asked_db),
        format!("{:.2}", row.processor_s),
        number_or_blank(row.peak_mib, 0),
        row.found.to_string(),
        row.to_be_found.to_string(),
        error(0),
        error(1),
        error(2),
        number_or_blank(row.probability, 2),
    ]
}

fn estimate_fields(row: &EstimateRow) -> Vec<String> {
    let head = [row.array.clone(), format!("{:.0}", row.snr_db), row.method.clone()];
    let figures = [format!("{:.3}", row.processor_ms), format!("{:.3}", row.found)];
    head.into_iter().chain(figures).chain(row.over_bound_db.map(|db| number_or_blank(db, 2))).collect()
}

fn rival_fields(row: &RivalRow) -> Vec<String> {
    let seconds = |s: f64| format!("{s:.2e}");
    vec![
        row.job.clone(),
        row.work.clone(),
        seconds(row.ours_s),
        row.rival.clone(),
        row.rival_s.map_or(String::new(), seconds),
        number_or_blank(row.error.map(db_from_amplitude), 0),
    ]
}

/// A table of a page with the columns of these indices.
fn shown(head: &[&str], columns: &[usize], rows: impl Iterator<Item = Vec<String>>) -> String {
    let pick = |words: Vec<String>| columns.iter().map(|column| words[*column].clone()).collect::<Vec<_>>();
    let head: Vec<&str> = columns.iter().map(|column| head[*column]).collect();
    table::markdown(&head, rows.map(pick))
}

/// The page; its text is that of `docs/chart.md` before the first table.
pub(in crate::study) fn page(chart: &Chart, extent: Extent) -> String {
    let command = match extent {
        Extent::Quick => "cargo xtask chart --quick",
        Extent::Full => "cargo xtask study chart",
    };
    let rows = |stage: &'static str| chart.rows.iter().filter(move |row| row.stage == stage).map(fields);
    let methods = [1, 2, 3, 8, 5, 6];
    PAGE.replace("{command}", command)
        .replace("{machine}", &machine())
        .replace(
            "{answers}",
            &shown(&ANSWERS, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9], chart.answers.iter().map(answer_fields)),
        )
        .replace("{frames}", &shown(&HEAD, &[1, 2, 3, 8, 5, 6, 9], rows("bart-rcs + fmcw-echo")))
        .replace("{references}", &references(chart))
        .replace("{scattering}", &shown(&HEAD, &methods, rows("bart-rcs")))
        .replace("{synthesis}", &shown(&HEAD, &methods, rows("fmcw-echo")))
        .replace(
            "{estimates}",
            &shown(&ESTIMATES, &[0, 1, 2, 3, 4, 5, 6, 7, 8], chart.estimates.iter().map(estimate_fields)),
        )
        .replace("{outside}", &shown(&RIVALS, &[0, 2, 3, 4, 5, 1], chart.rivals.iter().map(rival_fields)))
}

/// References of frames, scene by scene.
fn references(chart: &Chart) -> String {
    let mut lines: Vec<String> = vec![];
    for row in chart.rows.iter().filter(|row| row.stage == "bart-rcs + fmcw-echo") {
        let line = format!("- {}:\n  {}", row.scene, row.reference);
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines.join("\n")
}

const PAGE: &str = include_str!("page.md");

/// Cores and instruction set, on which times depend most.
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
