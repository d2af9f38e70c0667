//! The paper's network by the paper's protocol, and by two that keep all copies of a map in one split.

use crate::protocols::settings::ProtocolSettings;
use crate::training::{PAPER_ITERATIONS, network, one_dataset_of_paper};
use artifact::settings::Class;
use pipeline::host::dataset_folders::DatasetFolder;
use pipeline::host::failure::Failure;
use pipeline::host::progress::Work;
use pipeline::host::safe_text::markdown_table;
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;

/// Name, the training program's name, and the unit of the split.
const PROTOCOLS: [(&str, &str, &str); 3] = [
    ("P", "images", "images, after maps were augmented (the paper's)"),
    ("P′", "maps", "maps, each augmented on its side"),
    ("P″", "vehicles", "vehicles, with all of their maps"),
];

/// The paper's own results: its "test set" of 320 images, its "validation set" of 200, and by class in the
/// order of this project (section IV-C: buses and trucks "about 96 %", cars "about 93.5 %", motorcycles 98.16
/// %).
const PAPER: [&str; 8] =
    ["the paper", "images, after augmentation", "92.23 %", "90.81 %", "93.5 %", "96 %", "96 %", "98.16 %"];

/// Number of points of a curve in the table.
const POINTS: usize = 8;

/// Trains each protocol with every seed and tabulates the results.
pub(super) fn page(settings: &ProtocolSettings, datasets: &[DatasetFolder]) -> Result<String, Failure> {
    if !settings.test.is_empty() || settings.curves {
        return Err(Failure::refused(
            "--test and --curves are for --learner trees, profile and both; the paper's protocols have neither",
        ));
    }
    one_dataset_of_paper(datasets)?;
    let iterations = settings.iterations.unwrap_or(PAPER_ITERATIONS);
    let shards: Vec<PathBuf> = datasets.iter().flat_map(|dataset| dataset.shards.clone()).collect();
    let program = network::build_program()?;
    let work = Work::begin("training");
    let mut rows = vec![PAPER.map(str::to_owned)];
    let mut curves = Vec::new();
    for (name, deal, parted) in PROTOCOLS {
        let mut told = Vec::new();
        for seed in 1..=settings.seeds {
            let mut command = Command::new(&program);
            command.args(["--deal", deal, "--seed", &seed.to_string()]);
            command.args(["--iterations", &iterations.to_string()]);
            told.push(network::run_program(command, &shards, &work, settings.tell)?);
        }
        rows.push(row(name, parted, &told));
        curves.push((name, told[0]["curves"].clone()));
    }
    let [a, b, c, d] = Class::ALL.map(Class::name);
    let columns = ["protocol", "parted are", "watched (320 of 1120)", "unused (200 of 1120)", a, b, c, d];
    Ok(format!(
        "Means over {} trainings of {iterations} iterations; in brackets the least and the most.\n\n{}{}",
        settings.seeds,
        markdown_table(&columns, rows),
        curves_table(&curves)
    ))
}

fn row(name: &str, parted: &str, told: &[Value]) -> [String; 8] {
    let of = |split: &str, class: Option<usize>| {
        let share = |one: &Value| {
            let part = &one["metrics"]["splits"][split];
            class.map_or(&part["accuracy"], |class| &part["class_accuracy"][class]).as_f64()
        };
        spread(&told.iter().filter_map(share).collect::<Vec<f64>>())
    };
    let [a, b, c, d] = [0, 1, 2, 3].map(|class| of("test", Some(class)));
    [name.to_owned(), parted.to_owned(), of("validation", None), of("test", None), a, b, c, d]
}

/// Text of mean, minimum and maximum, in percent; a dash for a class without images.
fn spread(shares: &[f64]) -> String {
    if shares.is_empty() {
        return "–".into();
    }
    let percent = |share: f64| 100.0 * share;
    let mean = percent(shares.iter().sum::<f64>() / shares.len() as f64);
    let [low, high] =
        [shares.iter().copied().fold(1.0, f64::min), shares.iter().copied().fold(0.0, f64::max)];
    format!("{mean:.1} % ({:.0} … {:.0})", percent(low), percent(high))
}

/// Accuracy during the first seed's training, on the training and the monitored data.
fn curves_table(curves: &[(&str, Value)]) -> String {
    let mut rows = Vec::new();
    for (name, points) in curves {
        let points = points.as_array().map_or(&[][..], Vec::as_slice);
        for point in points.iter().rev().step_by(points.len().div_ceil(POINTS).max(1)).rev() {
            let share = |key: &str| format!("{:.1} %", 100.0 * point[key].as_f64().unwrap_or(f64::NAN));
            let (training, watched) = (share("train_accuracy"), share("validation_accuracy"));
            rows.push([(*name).to_owned(), point["iteration"].to_string(), training, watched]);
        }
    }
    let table = markdown_table(&["protocol", "iteration", "training", "watched"], rows);
    format!("\nRight while training, seed 1:\n\n{table}")
}
