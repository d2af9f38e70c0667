//! Estimate against truth over all vehicles of a dataset, as a table.

use serde_json::Value;

/// Median and 90 % point say more than a mean here: an object that took a ghost along is far off.
const HEAD: &str = "| vehicles | number | detected | range error, m: bias, median, 90 % \
| velocity error, m/s: median, 90 % | lateral error, m: median, 90 % | lane right |\n|---|---|---|---|---|---|---|\n";

/// A row for each class, lane and range, and one for all; vehicles are taken in one after the other.
pub(super) struct DetectionTable(Vec<VehicleRow>);

/// Vehicles that a row counts.
enum Counted {
    OfClass(&'static str),
    InLane(u64),
    WithinM([f64; 2]),
    All,
}

/// Vehicles of a row, and the errors of those that were found.
struct VehicleRow {
    counted: Counted,
    vehicles: usize,
    found: usize,
    lane_right: usize,
    range: Vec<f64>,
    velocity: Vec<f64>,
    lateral: Vec<f64>,
}

impl DetectionTable {
    pub(super) fn new() -> Self {
        let classes = ["car", "bus", "truck", "motorcycle"].map(Counted::OfClass);
        let lanes = [1, 2, 3].map(Counted::InLane);
        let ranges = [[25.0, 35.0], [35.0, 45.0], [45.0, 60.0]].map(Counted::WithinM);
        let rows = classes.into_iter().chain(lanes).chain(ranges).chain([Counted::All]);
        Self(rows.map(VehicleRow::of).collect())
    }

    /// Takes a vehicle in.
    pub(super) fn add(&mut self, vehicle: &Value) {
        self.0.iter_mut().filter(|row| row.counted.has(vehicle)).for_each(|row| row.add(vehicle));
    }

    /// Number of vehicles that were found, and of all.
    pub(super) fn found_of_all(&self) -> (usize, usize) {
        self.0.last().map_or((0, 0), |all| (all.found, all.vehicles))
    }

    /// The table as Markdown.
    pub(super) fn markdown(&self) -> String {
        let rows: Vec<String> = self.0.iter().map(VehicleRow::markdown).collect();
        format!("{HEAD}{}", rows.concat())
    }
}

impl Counted {
    fn has(&self, vehicle: &Value) -> bool {
        match self {
            Self::OfClass(class) => vehicle["class"] == *class,
            Self::InLane(lane) => vehicle["lane"] == *lane,
            Self::WithinM([near, far]) => {
                vehicle["range_m"].as_f64().is_some_and(|range| (*near..*far).contains(&range))
            }
            Self::All => true,
        }
    }

    fn name(&self) -> String {
        match self {
            Self::OfClass(class) => (*class).to_owned(),
            Self::InLane(lane) => format!("lane {lane}"),
            Self::WithinM([near, far]) => format!("{near}–{far} m"),
            Self::All => "all".to_owned(),
        }
    }
}

impl VehicleRow {
    fn of(counted: Counted) -> Self {
        let (range, velocity, lateral) = (vec![], vec![], vec![]);
        Self { counted, vehicles: 0, found: 0, lane_right: 0, range, velocity, lateral }
    }

    fn add(&mut self, vehicle: &Value) {
        self.vehicles += 1;
        let estimate = &vehicle["estimate"];
        if estimate.is_null() {
            return;
        }
        self.found += 1;
        self.lane_right += usize::from(estimate["lane"] == vehicle["lane"]);
        self.range.extend(error(&estimate["range_m"], &vehicle["echo_range_m"]));
        self.velocity.extend(error(&estimate["velocity_mps"], &vehicle["echo_velocity_mps"]));
        self.lateral.extend(error(&estimate["x_m"], &vehicle["x_m"]));
    }

    fn markdown(&self) -> String {
        let bias = self.range.iter().sum::<f64>() / self.range.len().max(1) as f64;
        let share = |part: usize, of: usize| format!("{:.1} %", 100.0 * part as f64 / of.max(1) as f64);
        format!(
            "| {} | {} | {} | {bias:+.2}, {} | {} | {} | {} |\n",
            self.counted.name(),
            self.vehicles,
            share(self.found, self.vehicles),
            spread(&self.range),
            spread(&self.velocity),
            spread(&self.lateral),
            share(self.lane_right, self.found),
        )
    }
}

fn error(estimate: &Value, truth: &Value) -> Option<f64> {
    Some(estimate.as_f64()? - truth.as_f64()?)
}

/// Median and 90 % point of the absolute values.
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
        let mut detected = DetectionTable::new();
        [found, missed].iter().for_each(|line| detected.add(&serde_json::from_str(line).unwrap()));
        let table = detected.markdown();
        assert!(
            table.contains("| car | 2 | 50.0 % | +0.50, 0.50, 0.50 | 0.10, 0.10 | 0.50, 0.50 | 100.0 % |"),
            "{table}"
        );
        assert_eq!(detected.found_of_all(), (1, 2));
    }
}
