//! Interpolation of recorded vehicles between steps, with consistent position, velocity and yaw.
//!
//! SUMO moves a vehicle by x(t) = x(t − Δ) + Δ·v(t) (its default, Euler): between two steps the velocity is
//! constant and equals that recorded with the second. So for a time t in (t₁, t₂], u = (t − t₁)/(t₂ − t₁):
//!
//! - the front bumper moves by v, the displacement p₂ − p₁ over t₂ − t₁, and is at p₂ − (t₂ − t)·v. Positions
//!   are rounded, by SUMO's default to 1 cm, so that the displacement in 0.1 s gives 0.1 m/s at best; if its
//!   length agrees with the recorded speed to [`ROUNDING_M`], that speed is used, along the displacement or,
//!   if this is too short to have a direction, along the heading; a full velocity vector of OSI is used if it
//!   agrees with the displacement as well; without a recorded velocity only the displacement counts;
//! - the heading turns at a constant rate, by the shorter way, and the body's origin, half a length behind
//!   the bumper, follows from both: its velocity is the exact derivative of its position;
//! - a vehicle exists from its first step to its last, at its first with the speed recorded there;
//! - a lane change, which SUMO's default model makes within one step, takes [`LANE_CHANGE_S`]: the lateral
//!   part of the jump, detected by [`SIDEWAYS_JUMP_M`] and by the part that the step's turn explains, follows
//!   3s² − 2s³ from the step before the jump on. Yaw stays as recorded: the body slides sideways at up to
//!   1.5·3.75 m/4 s = 1.4 m/s, at 10 m/s 8° off its axis;
//! - a vehicle that would have to be faster than [`TELEPORT_MPS`], or to jump further sideways than
//!   [`TELEPORT_ASIDE_M`], was moved by the simulation: it does not exist between the two steps.

use crate::recording::fcd::{FcdStep, FcdVehicle, RecordedVelocity};
use artifact::scene::Pose;
use glam::{DVec2, DVec3};
use radar::doppler_ambiguity::folded;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Duration of a lane change: the mean of 1790 observed ones is 4.6 s, their median near 4 (Toledo &
/// Zohar 2007).
pub const LANE_CHANGE_S: f64 = 4.0;

/// Least lateral jump: a step is a jump if it leads further than this across the mean heading of its two
/// ends, and further than half of its turn explains. This is half of the distance between the narrowest lanes
/// (2.5 m). Along a circle the chord has the mean heading; if lanes consist of few straight pieces, the
/// displacement has the heading of one of its ends.
pub const SIDEWAYS_JUMP_M: f64 = 1.2;

/// Largest lateral jump of a lane change: one lane and a half.
pub const TELEPORT_ASIDE_M: f64 = 6.0;

/// Largest number of lane changes at once: jumps of [`SIDEWAYS_JUMP_M`] at [`TELEPORT_MPS`] with the usual
/// steps of 0.1 s are at most 40 in that time.
const CONCURRENT_LANE_CHANGES: usize = 64;

/// Rounding error of a displacement: four coordinates of 5 mm, and the speed's 5 mm/s over a second.
pub const ROUNDING_M: f64 = 0.025;

/// Speed above that of any car on a road.
pub const TELEPORT_MPS: f64 = 100.0;

/// Times closer than this are equal: SUMO writes milliseconds.
const SAME_MOMENT_S: f64 = 1e-6;

/// A recorded vehicle at a time: the middle of its front bumper and its motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bumper {
    /// Position in world metres.
    pub front_m: DVec3,
    /// Velocity of the front bumper.
    pub velocity_mps: DVec3,
    /// Direction of the body's x axis, from world +x towards +y.
    pub yaw_rad: f64,
    /// Rate of `yaw_rad`.
    pub yaw_radps: f64,
}

impl Bumper {
    /// Bumper of a vehicle as recorded with one step.
    fn as_recorded(vehicle: &FcdVehicle) -> Self {
        let yaw_rad = yaw_rad(vehicle.angle_deg);
        let velocity_mps = match vehicle.velocity {
            RecordedVelocity::Vector { velocity_mps } => velocity_mps.into(),
            told => heading(yaw_rad).extend(0.0) * told.speed_mps(),
        };
        Self { front_m: vehicle.front_m.into(), velocity_mps, yaw_rad, yaw_radps: 0.0 }
    }

    /// Pose of a body whose origin is `reach_m` behind its front.
    pub fn pose(&self, reach_m: f64) -> Pose {
        let ahead = heading(self.yaw_rad);
        let turning = ahead.perp() * self.yaw_radps;
        Pose {
            position_m: (self.front_m - (ahead * reach_m).extend(0.0)).into(),
            yaw_rad: self.yaw_rad,
            yaw_radps: self.yaw_radps,
            velocity_mps: (self.velocity_mps - (turning * reach_m).extend(0.0)).into(),
            // Between two steps the bumper's velocity does not turn with the body: −ω × v compensates that.
            acceleration_mps2: (self.velocity_mps.truncate().perp() * -self.yaw_radps).extend(0.0).into(),
        }
    }
}

/// Yaw ψ = 90° − angle.
fn yaw_rad(angle_deg: f64) -> f64 {
    (90.0 - angle_deg).to_radians()
}

fn heading(yaw_rad: f64) -> DVec2 {
    DVec2::from_angle(yaw_rad)
}

/// The last two steps of a recording, and the remaining lane changes.
#[derive(Default)]
pub struct Interval {
    before: Option<FcdStep>,
    after: FcdStep,
    /// Index in `before` by id.
    known: HashMap<String, usize>,
    lane_changes: HashMap<String, Vec<LaneChange>>,
}

/// A lane change under way.
#[derive(Clone, Copy)]
struct LaneChange {
    start_s: f64,
    jump_m: DVec2,
}

impl LaneChange {
    /// Remaining part of the jump, and its rate.
    fn rest(&self, time_s: f64) -> (DVec2, DVec2) {
        let s = ((time_s - self.start_s) / LANE_CHANGE_S).clamp(0.0, 1.0);
        let (done, rate) = (s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / LANE_CHANGE_S);
        (self.jump_m * (1.0 - done), -self.jump_m * rate)
    }
}

impl Interval {
    /// Advances by one step.
    pub fn advance(&mut self, step: FcdStep) {
        let before = std::mem::replace(&mut self.after, step);
        self.known = before.vehicles.iter().enumerate().map(|(i, v)| (v.id.clone(), i)).collect();
        let mut lane_changes = std::mem::take(&mut self.lane_changes);
        for vehicle in &self.after.vehicles {
            let Some(earlier) = self.known.get(&vehicle.id).map(|i| &before.vehicles[*i]) else { continue };
            let mut own = lane_changes.remove(&vehicle.id).unwrap_or_default();
            own.retain(|change| before.time_s < change.start_s + LANE_CHANGE_S);
            match StepKind::between(earlier, vehicle, self.after.time_s - before.time_s) {
                StepKind::Driving => {}
                StepKind::LaneChange { jump_m } => own.push(LaneChange { start_s: before.time_s, jump_m }),
                StepKind::Teleport => own.clear(),
            }
            // When there are more than the limit, the earliest are complete.
            own.drain(..own.len().saturating_sub(CONCURRENT_LANE_CHANGES));
            if !own.is_empty() {
                self.lane_changes.insert(vehicle.id.clone(), own);
            }
        }
        self.before = Some(before);
    }

    /// The time up to which vehicles are known.
    pub fn end_s(&self) -> f64 {
        self.after.time_s
    }

    /// The line on which the later step begins.
    pub(crate) fn line(&self) -> u64 {
        self.after.line
    }

    /// Vehicles of the later step.
    pub fn vehicles(&self) -> &[FcdVehicle] {
        &self.after.vehicles
    }

    /// Distances driven by all vehicles in this interval, by the speeds of its later step and by their
    /// positions, m.
    pub(crate) fn driven_m(&self) -> [f64; 2] {
        let Some(before) = &self.before else { return [0.0; 2] };
        let step_s = self.after.time_s - before.time_s;
        let earlier = |vehicle: &FcdVehicle| Some(&before.vehicles[*self.known.get(&vehicle.id)?]);
        let ways = self.after.vehicles.iter().filter_map(|vehicle| {
            let way_m = DVec3::from(vehicle.front_m).distance(earlier(vehicle)?.front_m.into());
            Some([vehicle.velocity.speed_mps() * step_s, way_m])
        });
        ways.fold([0.0; 2], |sum, way| [sum[0] + way[0], sum[1] + way[1]])
    }

    /// Bumper of a vehicle of the later step at a time after the earlier step and not after the later; `None`
    /// if the vehicle does not exist then.
    pub fn bumper(&self, vehicle: &FcdVehicle, time_s: f64) -> Option<Bumper> {
        let earlier = self.before.as_ref().zip(self.known.get(&vehicle.id));
        let Some((before, index)) = earlier else {
            return self.is_now(time_s).then(|| Bumper::as_recorded(vehicle));
        };
        self.between(before.time_s, &before.vehicles[*index], vehicle, time_s)
    }

    /// Whether a time is that of the later step, by rounding.
    fn is_now(&self, time_s: f64) -> bool {
        (time_s - self.after.time_s).abs() <= SAME_MOMENT_S
    }

    fn between(&self, start_s: f64, a: &FcdVehicle, b: &FcdVehicle, time_s: f64) -> Option<Bumper> {
        let step_s = self.after.time_s - start_s;
        let u = ((time_s - start_s) / step_s).clamp(0.0, 1.0);
        let (from_m, to_m) = (DVec3::from(a.front_m), DVec3::from(b.front_m));
        if StepKind::between(a, b, step_s) == StepKind::Teleport {
            return self.is_now(time_s).then(|| Bumper::as_recorded(b));
        }
        let jump_m = own_jump(self.lane_changes.get(&b.id), start_s);
        let velocity_mps = velocity(b, to_m - from_m - jump_m.extend(0.0), step_s);
        let turn_rad = turn_rad(a, b);
        let mut bumper = Bumper {
            front_m: to_m - velocity_mps * ((1.0 - u) * step_s),
            velocity_mps,
            yaw_rad: yaw_rad(a.angle_deg) + u * turn_rad,
            yaw_radps: turn_rad / step_s,
        };
        for change in self.lane_changes.get(&b.id).into_iter().flatten() {
            let (rest_m, rest_mps) = change.rest(time_s);
            bumper.front_m -= rest_m.extend(0.0);
            bumper.velocity_mps -= rest_mps.extend(0.0);
        }
        Some(bumper)
    }
}

/// The jump in the step that begins at `start_s`.
fn own_jump(lane_changes: Option<&Vec<LaneChange>>, start_s: f64) -> DVec2 {
    let own = lane_changes.into_iter().flatten().filter(|change| change.start_s == start_s);
    own.map(|change| change.jump_m).sum()
}

/// Velocity of a vehicle with this displacement in a step, without jumps.
fn velocity(vehicle: &FcdVehicle, way_m: DVec3, step_s: f64) -> DVec3 {
    // Below 30 roundings of 5 mm per coordinate the direction of a displacement is known to no better than
    // 2°.
    const SHORT_M: f64 = 0.15;
    let length_m = way_m.length();
    match vehicle.velocity {
        RecordedVelocity::AlongHeading { speed_mps }
            if (length_m - speed_mps * step_s).abs() <= ROUNDING_M =>
        {
            let ahead = heading(yaw_rad(vehicle.angle_deg)).extend(0.0);
            speed_mps * if length_m > SHORT_M { way_m / length_m } else { ahead }
        }
        RecordedVelocity::Vector { velocity_mps }
            if way_m.distance(DVec3::from(velocity_mps) * step_s) <= ROUNDING_M =>
        {
            velocity_mps.into()
        }
        _ => way_m / step_s,
    }
}

/// Turn in the shorter direction, counter-clockwise positive.
fn turn_rad(a: &FcdVehicle, b: &FcdVehicle) -> f64 {
    folded(yaw_rad(b.angle_deg) - yaw_rad(a.angle_deg), TAU)
}

/// Kinds of a vehicle's step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepKind {
    /// Ordinary driving.
    Driving,
    /// Driving with a jump to another lane.
    LaneChange {
        /// Part of the displacement across the mean heading.
        jump_m: DVec2,
    },
    /// A move by the simulation.
    Teleport,
}

impl StepKind {
    /// Kind of a step of the given duration.
    pub fn between(a: &FcdVehicle, b: &FcdVehicle, step_s: f64) -> Self {
        let way = DVec3::from(b.front_m) - DVec3::from(a.front_m);
        let turn_rad = turn_rad(a, b);
        let across = heading(yaw_rad(a.angle_deg) + 0.5 * turn_rad).perp();
        let aside_m = way.truncate().dot(across);
        let jump_m = aside_m.abs() - way.length() * (0.5 * turn_rad).abs().sin();
        if way.length() > TELEPORT_MPS * step_s || jump_m > TELEPORT_ASIDE_M {
            Self::Teleport
        } else if jump_m > SIDEWAYS_JUMP_M {
            Self::LaneChange { jump_m: across * aside_m }
        } else {
            Self::Driving
        }
    }
}
