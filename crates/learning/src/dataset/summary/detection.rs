//! Estimates against truth over all vehicles of a dataset, as a table.

use crate::dataset::scene_line::VehicleLine;
use artifact::settings::Class;
use std::collections::BTreeMap;

/// Median and 90 % point are more informative than a mean here: an object that includes a ghost is far off.
const HEAD: &str = "| vehicles | number | detected | range error, m: bias, median, 90 % \
| velocity error, m/s: median, 90 % | lateral error, m: median, 90 % | lane right |\n|---|---|---|---|---|---|---|\n";

/// Bounds of the rows by range, m; vehicles nearer than the first or beyond the last have a row too.
const BOUNDS_M: [f64; 5] = [25.0, 35.0, 45.0, 60.0, 100.0];

/// A row for each class, lane and range with a vehicle, and one for all; vehicles are added one after the
/// other.
#[derive(Default)]
pub(super) struct DetectionTable(BTreeMap<VehicleGroup, VehicleRow>);

/// Group of vehicles in a row, in the order of the rows.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum VehicleGroup {
    /// The class of this index in [`Class::ALL`].
    OfClass(usize),
    InLane(u8),
    /// Vehicles beyond the given number of [`BOUNDS_M`].
    BeyondRange(usize),
    All,
}

/// Vehicles of a row, and the errors of the detected ones.
#[derive(Default)]
struct VehicleRow {
    vehicles: usize,
    found: usize,
    lane_right: usize,
    range_m: Vec<f64>,
    velocity_mps: Vec<f64>,
    lateral_m: Vec<f64>,
}

impl DetectionTable {
    /// Adds a vehicle.
    pub(super) fn add(&mut self, vehicle: &VehicleLine) {
        VehicleGroup::those_with(vehicle).for_each(|group| self.0.entry(group).or_default().add(vehicle));
    }

    /// Number of detected vehicles, and of all.
    pub(super) fn found_of_all(&self) -> (usize, usize) {
        self.0.get(&VehicleGroup::All).map_or((0, 0), |all| (all.found, all.vehicles))
    }

    /// The table as Markdown.
    pub(super) fn markdown(&self) -> String {
        let rows = self.0.iter().map(|(group, row)| row.markdown(&group.name()));
        format!("{HEAD}{}", rows.collect::<String>())
    }
}

impl VehicleGroup {
    /// Rows that count a vehicle.
    fn those_with(vehicle: &VehicleLine) -> impl Iterator<Item = Self> {
        let class = Class::ALL.iter().position(|class| vehicle.class == class.name());
        let beyond = |range_m: f64| BOUNDS_M.iter().filter(|bound_m| **bound_m <= range_m).count();
        let bound = vehicle.range_m.map(beyond);
        let rows = [class.map(Self::OfClass), vehicle.lane.map(Self::InLane), bound.map(Self::BeyondRange)];
        rows.into_iter().flatten().chain([Self::All])
    }

    fn name(self) -> String {
        match self {
            Self::OfClass(class) => Class::ALL[class].name().to_owned(),
            Self::InLane(lane) => format!("lane {lane}"),
            Self::BeyondRange(0) => format!("under {} m", BOUNDS_M[0]),
            Self::BeyondRange(bounds) => BOUNDS_M.get(bounds).map_or_else(
                || format!("from {} m", BOUNDS_M[bounds - 1]),
                |far_m| format!("{}–{far_m} m", BOUNDS_M[bounds - 1]),
            ),
            Self::All => "all".to_owned(),
        }
    }
}

impl VehicleRow {
    fn add(&mut self, vehicle: &VehicleLine) {
        self.vehicles += 1;
        let Some(estimate) = &vehicle.estimate else { return };
        self.found += 1;
        self.lane_right += usize::from(estimate.lane == vehicle.lane);
        self.range_m.extend(error(estimate.range_m, vehicle.echo_range_m));
        self.velocity_mps.extend(error(estimate.velocity_mps, vehicle.echo_velocity_mps));
        // Lines of earlier versions have no places across the lanes.
        let across_m = error(estimate.across_m, vehicle.across_m);
        self.lateral_m.extend(across_m.or(error(estimate.x_m, vehicle.x_m)));
    }

    fn markdown(&self, name: &str) -> String {
        format!(
            "| {name} | {} | {} | {}, {} | {} | {} | {} |\n",
            self.vehicles,
            share(self.found, self.vehicles),
            bias(&self.range_m),
            spread(&self.range_m),
            spread(&self.velocity_mps),
            spread(&self.lateral_m),
            share(self.lane_right, self.found),
        )
    }
}

/// Text of a share in per cent; a dash without any.
fn share(part: usize, of: usize) -> String {
    if of == 0 { "–".to_owned() } else { format!("{:.1} %", 100.0 * part as f64 / of as f64) }
}

/// Text of the mean error; a dash without any.
fn bias(errors: &[f64]) -> String {
    match errors.len() {
        0 => "–".to_owned(),
        count => format!("{:+.2}", errors.iter().sum::<f64>() / count as f64),
    }
}

fn error(estimate: Option<f64>, truth: Option<f64>) -> Option<f64> {
    Some(estimate? - truth?)
}

/// Text of the median and 90 % point of the absolute values.
fn spread(errors: &[f64]) -> String {
    let mut sizes: Vec<f64> = errors.iter().map(|e| e.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let at = |share: f64| sizes.get((share * (sizes.len().max(1) - 1) as f64).round() as usize).copied();
    let text = |value: Option<f64>| value.map_or("–".into(), |v| format!("{v:.2}"));
    format!("{}, {}", text(at(0.5)), text(at(0.9)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_without_an_estimate_counts_as_missed_and_not_as_an_error() {
        let found = r#"{"class":"car","lane":2,"range_m":40.0,"x_m":5.75,"echo_range_m":38.0,
            "echo_velocity_mps":-3.0,"estimate":{"range_m":38.5,"velocity_mps":-3.1,"x_m":5.25,"lane":2}}"#;
        let missed = r#"{"class":"car","lane":2,"range_m":41.0,"x_m":5.75,"estimate":null}"#;
        let mut detected = DetectionTable::default();
        [found, missed].iter().for_each(|line| detected.add(&serde_json::from_str(line).unwrap()));
        let table = detected.markdown();
        assert!(
            table.contains("| car | 2 | 50.0 % | +0.50, 0.50, 0.50 | 0.10, 0.10 | 0.50, 0.50 | 100.0 % |"),
            "{table}"
        );
        assert_eq!(detected.found_of_all(), (1, 2));
    }

    #[test]
    fn every_vehicle_has_its_rows_and_rows_of_nobody_are_not_there() {
        let far = r#"{"class":"truck","lane":4,"range_m":120.0,"x_m":13.25,"estimate":null}"#;
        let near = r#"{"class":"truck","lane":4,"range_m":12.0,"x_m":13.25,"estimate":null}"#;
        let mut detected = DetectionTable::default();
        [far, near].iter().for_each(|line| detected.add(&serde_json::from_str(line).unwrap()));
        let nothing = "–, –, – | –, – | –, – | – |";
        let row = |name: &str, count: usize| format!("| {name} | {count} | 0.0 % | {nothing}\n");
        let rows =
            [row("truck", 2), row("lane 4", 2), row("under 25 m", 1), row("from 100 m", 1), row("all", 2)];
        assert_eq!(detected.markdown(), format!("{HEAD}{}", rows.concat()));
    }

    #[test]
    fn the_lateral_error_is_that_across_the_lanes_wherever_they_lead() {
        // Of lanes towards +x, 2 m further along and half a metre aside.
        let found = r#"{"class":"bus","lane":2,"range_m":40.0,"x_m":40.0,"across_m":5.75,"echo_range_m":38.0,
            "echo_velocity_mps":-3.0,
            "estimate":{"range_m":38.5,"velocity_mps":-3.1,"x_m":42.0,"across_m":6.25,"lane":2}}"#;
        let mut detected = DetectionTable::default();
        detected.add(&serde_json::from_str(found).unwrap());
        let table = detected.markdown();
        assert!(
            table.contains("| bus | 1 | 100.0 % | +0.50, 0.50, 0.50 | 0.10, 0.10 | 0.50, 0.50 | 100.0 % |"),
            "{table}"
        );
    }
}
