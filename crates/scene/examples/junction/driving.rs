//! A junction of two roads with six lanes each, told by a car-following model: queues build up before a red
//! light and dissolve at green. Lanes lie where the paper's Table 1 has them (x = 2, 5.75, 9.5 m towards the
//! radar); the lane at x = 2 m turns right, all others go straight on.
//!
//! Each vehicle follows the intelligent driver model (Treiber, Hennecke and Helbing 2000, eq. 2–3):
//! acceleration a·[1 − (v/v₀)⁴ − (s*/s)²] with s* = s₀ + vT + vΔv/(2√(ab)), s the gap to the vehicle ahead or
//! to the stop line of a red light. Steps are Euler's, as SUMO's are: v(t) = v(t − Δ) + aΔ, x(t) = x(t − Δ) +
//! v(t)Δ. Equal seeds give equal text.

use std::fmt::Write;

/// Simulated before the recording begins, so that queues stand.
const WARM_UP_S: f64 = 80.0;
const RECORDED_S: f64 = 60.0;
const STEP_S: f64 = 0.1;
/// Green for one road, yellow, then the same for the other; within a road's 30 s, 3 are yellow.
const CYCLE_S: f64 = 60.0;
const GREEN_S: f64 = 27.0;
/// Length of each arm before the junction and behind it.
const ARM_M: f64 = 75.0;

struct Kind {
    name: &'static str,
    /// Number of vehicles of this kind among a hundred.
    share: u64,
    length_m: f64,
    /// Maximum acceleration a, m/s².
    acceleration: f64,
    /// Desired speed v₀, m/s.
    speed_mps: f64,
}

/// Lengths are those of the vehicles that stand for them in `scenes/traffic.toml`.
const KINDS: [Kind; 4] = [
    Kind { name: "car", share: 64, length_m: 4.7, acceleration: 1.8, speed_mps: 13.9 },
    Kind { name: "bus", share: 9, length_m: 12.0, acceleration: 1.1, speed_mps: 11.5 },
    Kind { name: "truck", share: 14, length_m: 8.0, acceleration: 1.0, speed_mps: 11.5 },
    Kind { name: "motorcycle", share: 13, length_m: 2.1, acceleration: 2.4, speed_mps: 13.9 },
];
/// Comfortable deceleration b in m/s²; below it the model's time headway T and standstill gap s₀.
const BRAKING: f64 = 2.5;
const HEADWAY_S: f64 = 1.2;
const GAP_M: f64 = 2.0;

/// The way of one lane through the junction: a straight, or a straight, a quarter circle to the right and a
/// straight.
struct Lane {
    name: String,
    start_m: [f64; 2],
    /// Compass degrees at the start.
    angle_deg: f64,
    /// Distance at which a right turn begins, and its radius.
    turn: Option<(f64, f64)>,
    stop_m: f64,
    end_m: f64,
    /// Whether it has green in the first half of a cycle.
    is_first: bool,
    /// Mean time between arrivals.
    arrival_s: f64,
}

struct Vehicle {
    number: u32,
    kind: usize,
    /// Place of the front bumper, m along the lane.
    front_m: f64,
    speed_mps: f64,
}

/// Vehicles on a lane, and its arrivals.
struct Road {
    /// The foremost first.
    vehicles: Vec<Vehicle>,
    /// Time at which the next vehicle arrives.
    next_s: f64,
    /// Number of vehicles that have arrived.
    count: u32,
}

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform random number from 0 up to, not including, 1.
    fn share(&mut self) -> f64 {
        (self.roll() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The recording of a seed.
pub(crate) fn floating_car_data(seed: u64) -> String {
    let lanes = lanes();
    let mut dice = Dice(seed);
    let road = |lane: &Lane| Road { vehicles: vec![], next_s: lane.arrival_s * dice.share(), count: 0 };
    let mut roads: Vec<Road> = lanes.iter().map(road).collect();
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\n<fcd-export>\n");
    let steps = ((WARM_UP_S + RECORDED_S) / STEP_S).round() as u32;
    for step in 0..steps {
        let time_s = f64::from(step) * STEP_S;
        for (lane, road) in lanes.iter().zip(&mut roads) {
            arrive(lane, road, time_s, &mut dice);
            drive(lane, &mut road.vehicles, time_s);
        }
        if time_s >= WARM_UP_S - 0.5 * STEP_S {
            tell(&lanes, &roads, time_s - WARM_UP_S, &mut text);
        }
    }
    text + "</fcd-export>\n"
}

fn lanes() -> Vec<Lane> {
    let mut lanes = vec![];
    for index in 0..3 {
        let across = 3.75 * f64::from(index);
        // South along the lanes of Table 1, north beside them, east and west on the crossing road (y = 0 …
        // 22.5 m).
        for (name, start_m, angle_deg, stop_m) in [
            ("n", [2.0 + across, 26.5 + ARM_M], 180.0, ARM_M),
            ("s", [20.75 - across, -4.0 - ARM_M], 0.0, ARM_M),
            ("w", [-2.0 - ARM_M, 1.875 + across], 90.0, ARM_M),
            ("e", [24.75 + ARM_M, 20.625 - across], 270.0, ARM_M),
        ] {
            let is_first = start_m[0] > 0.0 && start_m[0] < 24.0;
            // From x = 2 m into the lane at y = 20.625 m by 5 m: it begins 26.5 − 25.625 m behind the stop
            // line.
            let turn = (name == "n" && index == 0).then_some((ARM_M + 0.875, 5.0));
            let end_m = if turn.is_some() { 2.0 * ARM_M } else { 2.0 * ARM_M + 30.5 };
            let name = format!("{name}_in_{index}");
            lanes.push(Lane { name, start_m, angle_deg, turn, stop_m, end_m, is_first, arrival_s: 8.0 });
        }
    }
    lanes
}

impl Lane {
    /// Place at a distance along the lane.
    fn place_m(&self, along_m: f64) -> [f64; 2] {
        let (sin, cos) = self.angle_deg.to_radians().sin_cos();
        // Ahead is (sin, cos), right (cos, −sin).
        let at = |ahead: f64, right: f64| {
            [self.start_m[0] + ahead * sin + right * cos, self.start_m[1] + ahead * cos - right * sin]
        };
        match self.turn {
            Some((begin_m, radius_m)) if along_m > begin_m => {
                let quarter = 0.5 * std::f64::consts::PI;
                let angle = ((along_m - begin_m) / radius_m).min(quarter);
                let straight_m = along_m - begin_m - radius_m * angle;
                at(begin_m + radius_m * angle.sin(), radius_m * (1.0 - angle.cos()) + straight_m)
            }
            _ => at(along_m, 0.0),
        }
    }

    /// Compass degrees of a body whose front and rear are on the lane.
    fn angle_deg(&self, front_m: f64, length_m: f64) -> f64 {
        let ([x, y], [rear_x, rear_y]) = (self.place_m(front_m), self.place_m(front_m - length_m));
        (x - rear_x).atan2(y - rear_y).to_degrees().rem_euclid(360.0)
    }

    /// Whether a vehicle may pass the stop line.
    fn is_open(&self, time_s: f64) -> bool {
        let phase_s = (time_s + if self.is_first { 0.0 } else { 0.5 * CYCLE_S }).rem_euclid(CYCLE_S);
        phase_s < GREEN_S
    }

    /// Turning is slower: 0.3 g to the side.
    fn speed_limit_mps(&self, front_m: f64, speed_mps: f64) -> f64 {
        match self.turn {
            Some((begin_m, radius_m)) if front_m > begin_m - 15.0 && front_m < begin_m + 2.0 * radius_m => {
                speed_mps.min((3.0 * radius_m).sqrt())
            }
            _ => speed_mps,
        }
    }
}

/// A new vehicle where its time has come and there is room.
fn arrive(lane: &Lane, road: &mut Road, time_s: f64, dice: &mut Dice) {
    let room_m = road.vehicles.last().map_or(f64::INFINITY, |last| last.front_m - KINDS[last.kind].length_m);
    if time_s < road.next_s || room_m < 12.0 {
        return;
    }
    let mut draw = dice.roll() % 100;
    let mut kind = 0;
    while draw >= KINDS[kind].share {
        draw -= KINDS[kind].share;
        kind += 1;
    }
    road.vehicles.push(Vehicle {
        number: road.count,
        kind,
        front_m: 0.0,
        speed_mps: 0.7 * KINDS[kind].speed_mps,
    });
    // At least 2 s, else exponential.
    road.count += 1;
    road.next_s = time_s + 2.0 - (lane.arrival_s - 2.0) * (1.0 - dice.share()).ln();
}

/// One step of every vehicle of a lane, the foremost first.
fn drive(lane: &Lane, road: &mut Vec<Vehicle>, time_s: f64) {
    let mut ahead: Option<(f64, f64)> = None;
    for vehicle in road.iter_mut() {
        let kind = &KINDS[vehicle.kind];
        let to_line_m = lane.stop_m - vehicle.front_m;
        // Who could only stop by more than twice the comfortable braking drives on.
        let can_stop = vehicle.speed_mps.powi(2) <= 4.0 * BRAKING * to_line_m;
        let line = (!lane.is_open(time_s) && to_line_m > 0.0 && can_stop)
            .then_some((lane.stop_m + GAP_M - 0.5, 0.0));
        let (gap_m, other_mps) =
            [ahead, line].into_iter().flatten().fold((f64::INFINITY, 0.0), |nearest, next| {
                if next.0 - vehicle.front_m < nearest.0 {
                    (next.0 - vehicle.front_m, next.1)
                } else {
                    nearest
                }
            });
        let wanted_mps = lane.speed_limit_mps(vehicle.front_m, kind.speed_mps);
        let v = vehicle.speed_mps;
        let wish_m =
            GAP_M + v * HEADWAY_S + v * (v - other_mps) / (2.0 * (kind.acceleration * BRAKING).sqrt());
        let rate = 1.0 - (v / wanted_mps).powi(4) - (wish_m.max(0.0) / gap_m.max(0.1)).powi(2);
        vehicle.speed_mps = (v + STEP_S * (kind.acceleration * rate).max(-8.0)).max(0.0);
        vehicle.front_m += STEP_S * vehicle.speed_mps;
        ahead = Some((vehicle.front_m - kind.length_m, vehicle.speed_mps));
    }
    road.retain(|vehicle| vehicle.front_m < lane.end_m);
}

/// One `<timestep>`, with the attributes and the digits that SUMO writes.
fn tell(lanes: &[Lane], roads: &[Road], time_s: f64, text: &mut String) {
    let _ = writeln!(text, "    <timestep time=\"{time_s:.2}\">");
    for (lane, road) in lanes.iter().zip(roads) {
        for vehicle in &road.vehicles {
            let kind = &KINDS[vehicle.kind];
            let [x, y] = lane.place_m(vehicle.front_m);
            let angle = lane.angle_deg(vehicle.front_m, kind.length_m);
            let _ = writeln!(
                text,
                "        <vehicle id=\"{}.{}\" x=\"{x:.2}\" y=\"{y:.2}\" angle=\"{angle:.2}\" type=\"{}\" speed=\"{:.2}\" \
                 pos=\"{:.2}\" lane=\"{}\" slope=\"0.00\"/>",
                lane.name, vehicle.number, kind.name, vehicle.speed_mps, vehicle.front_m, lane.name
            );
        }
    }
    text.push_str("    </timestep>\n");
}
