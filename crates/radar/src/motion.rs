//! Motion of a body with constant turn rate and acceleration (CTRA).

use artifact::scene::Pose;

/// Pose after `elapsed_s` (before, if negative); for a body that does not turn it is rounded once, to half a
/// unit in the last place.
pub fn pose_after(pose: &Pose, elapsed_s: f64) -> Pose {
    if pose.yaw_radps == 0.0 { straight_motion(pose, elapsed_s) } else { circular_motion(pose, elapsed_s) }
}

/// Acceleration at the moment of the pose, including the contribution of turning: a + ω × v.
pub fn total_acceleration_mps2(pose: &Pose) -> [f64; 3] {
    let ([ax, ay, az], [vx, vy, _]) = (pose.acceleration_mps2, pose.velocity_mps);
    [ax - pose.yaw_radps * vy, ay + pose.yaw_radps * vx, az]
}

fn straight_motion(pose: &Pose, elapsed_s: f64) -> Pose {
    let gained_mps = pose.acceleration_mps2.map(|acceleration_mps2| acceleration_mps2 * elapsed_s);
    // Fused: after an hour at 30 m/s the product alone would round by 1.5e-11 m, 4e-9 of a wavelength. It
    // costs nothing.
    let mean_mps = |axis: usize| pose.velocity_mps[axis] + 0.5 * gained_mps[axis];
    let along = |axis: usize| mean_mps(axis).mul_add(elapsed_s, pose.position_m[axis]);
    Pose {
        position_m: [along(0), along(1), along(2)],
        velocity_mps: [0, 1, 2].map(|axis| pose.velocity_mps[axis] + gained_mps[axis]),
        ..*pose
    }
}

/// Pose of a turning body after `t`: it moves by ∫R(ωs)(v + as)ds at the velocity R(ωt)(v + at); the vertical
/// components do not turn.
fn circular_motion(pose: &Pose, t: f64) -> Pose {
    let (angle_rad, straight) = (pose.yaw_radps * t, straight_motion(pose, t));
    let [of_velocity, of_acceleration] = [mean_cos_sin(angle_rad), mean_ramp_cos_sin(angle_rad)];
    let way = |axis: usize| {
        let by_velocity = rotated(pose.velocity_mps, of_velocity)[axis];
        let by_acceleration = rotated(pose.acceleration_mps2, of_acceleration)[axis];
        (by_velocity + by_acceleration * t).mul_add(t, pose.position_m[axis])
    };
    let now = |v: [f64; 3]| rotated(v, [angle_rad.cos(), angle_rad.sin()]);
    Pose {
        position_m: [way(0), way(1), straight.position_m[2]],
        yaw_rad: pose.yaw_rad + angle_rad,
        yaw_radps: pose.yaw_radps,
        velocity_mps: now(straight.velocity_mps),
        acceleration_mps2: now(pose.acceleration_mps2),
    }
}

/// Rotates a vector about the vertical by the angle with this cosine and sine.
fn rotated([x, y, z]: [f64; 3], [cos, sin]: [f64; 2]) -> [f64; 3] {
    [cos * x - sin * y, sin * x + cos * y, z]
}

/// Means of cosine and sine over angles from 0 to `angle`: sin θ/θ and (1 − cos θ)/θ.
fn mean_cos_sin(angle: f64) -> [f64; 2] {
    if angle == 0.0 {
        return [1.0, 0.0];
    }
    let half = (0.5 * angle).sin();
    [angle.sin() / angle, 2.0 * half * half / angle]
}

/// Integrals ∫s·cos and ∫s·sin of an angle growing linearly from 0, s from 0 to 1; by series where the closed
/// form would cancel.
fn mean_ramp_cos_sin(angle: f64) -> [f64; 2] {
    let square = angle * angle;
    if angle.abs() < 0.1 {
        let cosine = 0.5 - square * (1.0 / 8.0 - square * (1.0 / 144.0 - square / 5760.0));
        let sine = angle * (1.0 / 3.0 - square * (1.0 / 30.0 - square * (1.0 / 840.0 - square / 45360.0)));
        return [cosine, sine];
    }
    let (sin, cos) = angle.sin_cos();
    [(angle * sin + cos - 1.0) / square, (sin - angle * cos) / square]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(yaw_radps: f64) -> Pose {
        Pose {
            position_m: [3.0, 40.0, 0.5],
            yaw_rad: 0.7,
            yaw_radps,
            velocity_mps: [8.0, -3.0, 0.2],
            acceleration_mps2: [-2.0, 1.0, 0.1],
        }
    }

    /// Sums two hundred thousand steps by the midpoint rule.
    #[test]
    fn a_bend_is_the_sum_of_many_small_steps() {
        for yaw_radps in [0.001, 0.4, -3.0] {
            let (start, seconds, steps) = (pose(yaw_radps), 1.7, 200_000);
            let step_s = seconds / f64::from(steps);
            let (mut at_m, mut mps) = (start.position_m, start.velocity_mps);
            for step in 0..steps {
                let turn = |s: f64| [(yaw_radps * s).cos(), (yaw_radps * s).sin()];
                let middle_s = (f64::from(step) + 0.5) * step_s;
                let along = |axis: usize| start.velocity_mps[axis] + start.acceleration_mps2[axis] * middle_s;
                mps = rotated([along(0), along(1), along(2)], turn(middle_s));
                at_m = [0, 1, 2].map(|axis| at_m[axis] + step_s * mps[axis]);
            }
            let end = pose_after(&start, seconds);
            for axis in 0..3 {
                assert!((end.position_m[axis] - at_m[axis]).abs() < 1e-8, "{yaw_radps}: axis {axis}");
                assert!((end.velocity_mps[axis] - mps[axis]).abs() < 1e-4, "{yaw_radps}: axis {axis}");
            }
            assert!((end.yaw_rad - (0.7 + yaw_radps * seconds)).abs() < 1e-12);
        }
    }

    #[test]
    fn two_steps_lead_where_one_leads_and_the_derivative_of_velocity_is_the_whole_acceleration() {
        let start = pose(0.9);
        let [by_two, by_one] = [pose_after(&pose_after(&start, 0.4), 0.8), pose_after(&start, 1.2)];
        for axis in 0..3 {
            assert!((by_two.position_m[axis] - by_one.position_m[axis]).abs() < 1e-12);
            let near = [-1e-5, 1e-5].map(|s| pose_after(&start, s).velocity_mps[axis]);
            let slope_mps2 = (near[1] - near[0]) / 2e-5;
            assert!((slope_mps2 - total_acceleration_mps2(&start)[axis]).abs() < 1e-8);
        }
    }

    #[test]
    fn series_and_closed_form_meet() {
        let [below, above] = [0.1 - 1e-12, 0.1 + 1e-12].map(mean_ramp_cos_sin);
        assert!((below[0] - above[0]).abs() < 1e-13 && (below[1] - above[1]).abs() < 1e-12);
    }

    #[test]
    fn a_slow_turn_goes_over_into_the_straight_line() {
        let [straight, slow] = [0.0, 1e-12].map(|rate| pose_after(&pose(rate), 2.0));
        for axis in 0..3 {
            assert!((straight.position_m[axis] - slow.position_m[axis]).abs() < 1e-10);
        }
    }
}
