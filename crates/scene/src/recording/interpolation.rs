//! Recorded vehicles between the steps of a recording, so that position, velocity and yaw belong
//! together.
//!
//! SUMO moves a vehicle by x(t) = x(t − Δ) + Δ·v(t) (its default, Euler): between two steps the velocity is
//! constant and is the one told with the second. So for a moment t in (t₁, t₂], u = (t − t₁)/(t₂ − t₁):
//!
//! - the front bumper moves by v, the way p₂ − p₁ over t₂ − t₁, and is at p₂ − (t₂ − t)·v. Positions are
//!   rounded, by SUMO's default to 1 cm, so that the way of 0.1 s tells 0.1 m/s at best; where its length is
//!   the told speed's to [`ROUNDING_M`], that speed is taken, along the way or, where this is too short to
//!   have a direction, the heading; a velocity that OSI tells whole is taken where it leads as far from the
//!   way, and the way alone counts where none is told;
//! - the heading turns evenly, by the shorter way, and the body's origin, half a length behind the bumper,
//!   moves as both say: its velocity is the exact derivative of its position;
//! - a vehicle is there from its first step to its last, at its first with the speed told there;
//! - a lane change, which SUMO's default model makes within one step, is driven in [`LANE_CHANGE_S`]: the
//!   sideways part of the jump, told by [`SIDEWAYS_JUMP_M`] and by what a turn of the step explains, follows
//!   3s² − 2s³ from the step before the jump on. Yaw stays as recorded: the body slides across by up to
//!   1.5·3.75 m/4 s = 1.4 m/s, at 10 m/s 8° off its axis;
//! - a vehicle that would have to be faster than [`TELEPORT_MPS`], or to jump further aside than
//!   [`TELEPORT_ASIDE_M`], was put elsewhere by the simulation: it is not there between the two steps.

use crate::recording::fcd::{FcdStep, FcdVehicle, ToldVelocity};
use artifact::scene::Pose;
use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Duration of a lane change: the mean of 1790 observed ones is 4.6 s, their median near 4 (Toledo &
/// Zohar 2007).
pub const LANE_CHANGE_S: f64 = 4.0;

/// A step that leads further than this across the mean heading of its two ends, and further than half of its
/// turn explains, is a jump: half of what the narrowest lanes are apart (2.5 m). Along a circle the chord has
/// the mean heading; where lanes are drawn as few straight pieces the way is that of one of its ends.
pub const SIDEWAYS_JUMP_M: f64 = 1.2;

/// A jump further aside than one lane and a half is no lane change.
pub const TELEPORT_ASIDE_M: f64 = 6.0;

/// Jumps of [`SIDEWAYS_JUMP_M`] at [`TELEPORT_MPS`] and the steps of 0.1 s that people record are at most 40
/// in that time.
const SLIDES_AT_ONCE: usize = 64;

/// Part of a way that may be rounding: four coordinates of 5 mm, and the speed's 5 mm/s over a second.
pub const ROUNDING_M: f64 = 0.025;

/// Faster than any car on a road.
pub const TELEPORT_MPS: f64 = 100.0;

/// Two moments closer than this are one: SUMO writes milliseconds.
const SAME_MOMENT_S: f64 = 1e-6;

/// A recorded vehicle at a moment: the middle of its front bumper and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bumper {
    /// World metres.
    pub front_m: DVec3,
    /// Velocity of the front bumper.
    pub velocity_mps: DVec3,
    /// Direction of the body's x axis, from world +x towards +y.
    pub yaw_rad: f64,
    /// Rate of `yaw_rad`.
    pub yaw_radps: f64,
}

impl Bumper {
    /// Bumper of a vehicle as told with one step.
    fn as_told(vehicle: &FcdVehicle) -> Self {
        let yaw_rad = yaw_rad(vehicle.angle_deg);
        let velocity_mps = match vehicle.velocity {
            ToldVelocity::Whole { velocity_mps } => velocity_mps.into(),
            told => heading(yaw_rad).extend(0.0) * told.speed_mps(),
        };
        Self { front_m: vehicle.front_m.into(), velocity_mps, yaw_rad, yaw_radps: 0.0 }
    }

    /// Pose of a body whose origin lies `reach_m` behind its front.
    pub fn pose(&self, reach_m: f64) -> Pose {
        let ahead = heading(self.yaw_rad);
        let turning = ahead.perp() * self.yaw_radps;
        Pose {
            position_m: (self.front_m - (ahead * reach_m).extend(0.0)).into(),
            yaw_rad: self.yaw_rad,
            yaw_radps: self.yaw_radps,
            velocity_mps: (self.velocity_mps - (turning * reach_m).extend(0.0)).into(),
            // Between two steps the bumper's velocity does not turn with the body: −ω × v undoes that.
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

/// The last two steps of a recording, and what is still to be driven of lane changes.
#[derive(Default)]
pub struct Interval {
    before: Option<FcdStep>,
    after: FcdStep,
    /// Place in `before` by id.
    known: HashMap<String, usize>,
    slides: HashMap<String, Vec<Slide>>,
}

/// A jump that is being driven.
#[derive(Clone, Copy)]
struct Slide {
    start_s: f64,
    jump_m: DVec2,
}

impl Slide {
    /// Part of the jump that is still to come, and its rate.
    fn rest(&self, time_s: f64) -> (DVec2, DVec2) {
        let s = ((time_s - self.start_s) / LANE_CHANGE_S).clamp(0.0, 1.0);
        let (done, rate) = (s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / LANE_CHANGE_S);
        (self.jump_m * (1.0 - done), -self.jump_m * rate)
    }
}

impl Interval {
    /// Goes on by one step.
    pub fn advance(&mut self, step: FcdStep) {
        let before = std::mem::replace(&mut self.after, step);
        self.known = before.vehicles.iter().enumerate().map(|(i, v)| (v.id.clone(), i)).collect();
        let mut slides = std::mem::take(&mut self.slides);
        for vehicle in &self.after.vehicles {
            let Some(earlier) = self.known.get(&vehicle.id).map(|i| &before.vehicles[*i]) else { continue };
            let mut own = slides.remove(&vehicle.id).unwrap_or_default();
            own.retain(|slide| before.time_s < slide.start_s + LANE_CHANGE_S);
            match Step::between(earlier, vehicle, self.after.time_s - before.time_s) {
                Step::Way => {}
                Step::LaneChange { jump_m } => own.push(Slide { start_s: before.time_s, jump_m }),
                Step::Teleport => own.clear(),
            }
            // Of more than there can be the first are done.
            own.drain(..own.len().saturating_sub(SLIDES_AT_ONCE));
            if !own.is_empty() {
                self.slides.insert(vehicle.id.clone(), own);
            }
        }
        self.before = Some(before);
    }

    /// The moment up to which vehicles are known.
    pub fn end_s(&self) -> f64 {
        self.after.time_s
    }

    /// The line on which the later step begins.
    pub(crate) fn line(&self) -> u64 {
        self.after.line
    }

    /// Vehicles told with the later step.
    pub fn vehicles(&self) -> &[FcdVehicle] {
        &self.after.vehicles
    }

    /// Ways of all vehicles in this interval: by the speeds told with its later step, and by their places, m.
    pub(crate) fn ways_m(&self) -> [f64; 2] {
        let Some(before) = &self.before else { return [0.0; 2] };
        let step_s = self.after.time_s - before.time_s;
        let earlier = |vehicle: &FcdVehicle| Some(&before.vehicles[*self.known.get(&vehicle.id)?]);
        let ways = self.after.vehicles.iter().filter_map(|vehicle| {
            let way_m = DVec3::from(vehicle.front_m).distance(earlier(vehicle)?.front_m.into());
            Some([vehicle.velocity.speed_mps() * step_s, way_m])
        });
        ways.fold([0.0; 2], |sum, way| [sum[0] + way[0], sum[1] + way[1]])
    }

    /// Bumper of a vehicle of the later step at a moment after the earlier step and not after the later;
    /// `None` where the vehicle is not there.
    pub fn bumper(&self, vehicle: &FcdVehicle, time_s: f64) -> Option<Bumper> {
        let earlier = self.before.as_ref().zip(self.known.get(&vehicle.id));
        let Some((before, index)) = earlier else {
            let is_now = (time_s - self.after.time_s).abs() <= SAME_MOMENT_S;
            return is_now.then(|| Bumper::as_told(vehicle));
        };
        self.between(before.time_s, &before.vehicles[*index], vehicle, time_s)
    }

    fn between(&self, start_s: f64, a: &FcdVehicle, b: &FcdVehicle, time_s: f64) -> Option<Bumper> {
        let step_s = self.after.time_s - start_s;
        let u = ((time_s - start_s) / step_s).clamp(0.0, 1.0);
        let (from_m, to_m) = (DVec3::from(a.front_m), DVec3::from(b.front_m));
        if Step::between(a, b, step_s) == Step::Teleport {
            return (u == 1.0).then(|| Bumper::as_told(b));
        }
        let jump_m = own_jump(self.slides.get(&b.id), start_s);
        let velocity_mps = velocity(b, to_m - from_m - jump_m.extend(0.0), step_s);
        let turn_rad = turn_rad(a, b);
        let mut bumper = Bumper {
            front_m: to_m - velocity_mps * ((1.0 - u) * step_s),
            velocity_mps,
            yaw_rad: yaw_rad(a.angle_deg) + u * turn_rad,
            yaw_radps: turn_rad / step_s,
        };
        for slide in self.slides.get(&b.id).into_iter().flatten() {
            let (rest_m, rest_mps) = slide.rest(time_s);
            bumper.front_m -= rest_m.extend(0.0);
            bumper.velocity_mps -= rest_mps.extend(0.0);
        }
        Some(bumper)
    }
}

/// The jump that was made in the step that begins at `start_s`.
fn own_jump(slides: Option<&Vec<Slide>>, start_s: f64) -> DVec2 {
    let own = slides.into_iter().flatten().filter(|slide| slide.start_s == start_s);
    own.map(|slide| slide.jump_m).sum()
}

/// Velocity of a vehicle that came this way in a step, jumps left out.
fn velocity(vehicle: &FcdVehicle, way_m: DVec3, step_s: f64) -> DVec3 {
    // Below 30 roundings of 5 mm to a side a way's direction is known to no better than 2°.
    const SHORT_M: f64 = 0.15;
    let length_m = way_m.length();
    match vehicle.velocity {
        ToldVelocity::Ahead { speed_mps } if (length_m - speed_mps * step_s).abs() <= ROUNDING_M => {
            let ahead = heading(yaw_rad(vehicle.angle_deg)).extend(0.0);
            speed_mps * if length_m > SHORT_M { way_m / length_m } else { ahead }
        }
        ToldVelocity::Whole { velocity_mps }
            if way_m.distance(DVec3::from(velocity_mps) * step_s) <= ROUNDING_M =>
        {
            velocity_mps.into()
        }
        _ => way_m / step_s,
    }
}

/// Turn by the shorter way, counter-clockwise.
fn turn_rad(a: &FcdVehicle, b: &FcdVehicle) -> f64 {
    let turn = yaw_rad(b.angle_deg) - yaw_rad(a.angle_deg);
    turn - TAU * (turn / TAU).round()
}

/// Kinds of what a vehicle does in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// It drives.
    Way,
    /// It drives, and jumps to another lane.
    LaneChange {
        /// Part of the way that leads across the mean heading.
        jump_m: DVec2,
    },
    /// It is put elsewhere.
    Teleport,
}

impl Step {
    /// Kind of a step of this duration.
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
            Self::Way
        }
    }
}
