//! Proportions of buses.

use crate::vehicles::dimensions::{ParameterSampler, SizeRange};
use crate::vehicles::drawing::curve::Curve;

/// Kind of bus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    City,
    Coach,
    Mini,
}

/// A bus's proportions, in a drawing with x = 0 half way along the body and z = 0 on the ground.
#[derive(Debug, Clone)]
pub(crate) struct Form {
    pub(crate) kind: Kind,
    pub(crate) size_m: [f64; 3],
    /// Front and rear end of the body; mirrors may reach beyond.
    pub(crate) ends_x: [f64; 2],
    pub(crate) half_width_m: f64,
    /// Middle of the roof, without equipment on it.
    pub(crate) roof_z: f64,
    pub(crate) clearance_m: f64,
    pub(crate) wheel_radius_m: f64,
    pub(crate) tyre_width_m: f64,
    pub(crate) front_axle_x: f64,
    pub(crate) rear_axle_x: f64,
    /// Lower and upper edge of the side panes.
    pub(crate) panes_z: [f64; 2],
    /// Lower and upper edge of the windscreen.
    pub(crate) windscreen_z: [f64; 2],
    /// Lean of the front above the bumper, metres back per metre up.
    pub(crate) lean: f64,
    pub(crate) pane_width_m: f64,
    /// Doors on the right, [rear, front] along x.
    pub(crate) doors_x: Vec<[f64; 2]>,
}

/// Overall length, width over mirrors, height. The body is 2.55 m wide (the limit of Directive 96/53/EC) in
/// city bus and coach. Ranges: city buses from 10.5 m midi to 12.2 m standard, 2.95 m (diesel) to 3.4 m (gas
/// or batteries on the roof), as Mercedes Citaro and MAN Lion's City; coaches from 10.5 m to 13.5 m (the
/// Directive's limit with two axles), 3.4 to 3.85 m high, as Setra's Comfort and Top Class; minibuses on the
/// vans Mercedes Sprinter, Iveco Daily: 5.9 to 7.4 m, 2.6 to 2.9 m high. Rounded to 5 cm.
pub(crate) fn size_range(model: &str) -> SizeRange {
    match model {
        "bus-city" => {
            SizeRange { nominal_m: [12.1, 2.95, 3.15], range_m: [[10.5, 12.3], [2.9, 3.05], [2.95, 3.4]] }
        }
        "bus-coach" => {
            SizeRange { nominal_m: [12.4, 2.95, 3.75], range_m: [[10.5, 13.5], [2.9, 3.05], [3.4, 3.85]] }
        }
        _ => SizeRange { nominal_m: [6.95, 2.4, 2.75], range_m: [[5.9, 7.4], [2.35, 2.5], [2.6, 2.9]] },
    }
}

impl Form {
    /// Form drawn for the model and seed, in the given size.
    pub(crate) fn of(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        match sampler.model {
            "bus-city" => Self::city(sampler, size_m),
            "bus-coach" => Self::coach(sampler, size_m),
            _ => Self::mini(sampler, size_m),
        }
    }

    fn city(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let front = 0.5 * size_m[0] - 0.1;
        let rear = -0.5 * size_m[0];
        let front_axle_x = front - sampler.value("front overhang", 2.70, 2.55..=2.8);
        let rear_axle_x = rear + sampler.value("rear overhang", 3.35, 3.0..=3.45);
        let middle = 0.5 * (front_axle_x + rear_axle_x) + 0.25;
        Self {
            kind: Kind::City,
            size_m,
            ends_x: [front, rear],
            half_width_m: 1.275,
            roof_z: size_m[2] - 0.22,
            clearance_m: sampler.value("clearance", 0.28, 0.25..=0.32),
            wheel_radius_m: 0.48,
            tyre_width_m: 0.275,
            front_axle_x,
            rear_axle_x,
            panes_z: [sampler.value("window sill", 1.18, 1.1..=1.3), size_m[2] - 0.62],
            windscreen_z: [1.0, size_m[2] - 0.72],
            lean: sampler.value("lean", 0.06, 0.03..=0.09),
            pane_width_m: sampler.value("pane", 1.45, 1.25..=1.6),
            doors_x: vec![
                [front - 1.62, front - 0.42],
                [middle - 0.65, middle + 0.65],
                [rear + 0.85, rear + 2.0],
            ],
        }
    }

    fn coach(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let front = 0.5 * size_m[0] - 0.3;
        let rear = -0.5 * size_m[0];
        let front_axle_x = front - sampler.value("front overhang", 2.80, 2.6..=2.9);
        Self {
            kind: Kind::Coach,
            size_m,
            ends_x: [front, rear],
            half_width_m: 1.275,
            roof_z: size_m[2] - 0.15,
            clearance_m: sampler.value("clearance", 0.32, 0.28..=0.36),
            wheel_radius_m: 0.52,
            tyre_width_m: 0.295,
            front_axle_x,
            rear_axle_x: rear + sampler.value("rear overhang", 3.30, 3.0..=3.4),
            panes_z: [size_m[2] - 2.0 + sampler.value("window sill", 0.0, -0.1..=0.1), size_m[2] - 0.72],
            windscreen_z: [1.20, size_m[2] - 0.75],
            lean: sampler.value("lean", 0.13, 0.08..=0.17),
            pane_width_m: sampler.value("pane", 1.65, 1.4..=1.9),
            doors_x: vec![[front - 1.72, front - 0.75]],
        }
    }

    fn mini(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let (front, rear) = (0.5 * size_m[0], -0.5 * size_m[0]);
        Self {
            kind: Kind::Mini,
            size_m,
            ends_x: [front, rear],
            half_width_m: 0.5 * size_m[1] - 0.19,
            roof_z: size_m[2],
            clearance_m: sampler.value("clearance", 0.24, 0.2..=0.28),
            wheel_radius_m: 0.345,
            tyre_width_m: 0.225,
            front_axle_x: front - sampler.value("front overhang", 1.0, 0.95..=1.05),
            rear_axle_x: rear + sampler.value("rear overhang", 1.62, 1.2..=1.65),
            panes_z: [1.25, size_m[2] - 0.62],
            windscreen_z: [1.36, size_m[2] - 0.60],
            lean: 0.0,
            pane_width_m: sampler.value("pane", 1.2, 1.0..=1.4),
            doors_x: vec![[front - 2.95, front - 2.0]],
        }
    }

    /// Radius of an arch, with room to steer and to spring.
    pub(crate) fn arch_radius_m(&self) -> f64 {
        self.wheel_radius_m + 0.07
    }

    /// Distance of an arch's inner side from the middle plane: twin tyres need twice the room.
    pub(crate) fn arch_inner_y(&self) -> f64 {
        self.half_width_m - 2.0 * self.tyre_width_m - 0.16
    }

    /// Silhouette in the middle plane.
    pub(crate) fn top_z(&self) -> Curve {
        let [front, rear] = self.ends_x;
        let roof = self.roof_z;
        if self.kind != Kind::Mini {
            return Curve::through(&[
                (rear, roof - 0.10),
                (rear + 0.5, roof),
                (front - 0.9, roof),
                (front, roof - 0.12),
            ]);
        }
        let [cowl_z, header_z] = self.windscreen_z;
        let (cowl_x, header_x) = (self.cowl_x(), self.header_x());
        let slope = (header_z - cowl_z) / (header_x - cowl_x);
        Curve::through(&[
            (front, 1.00),
            (front - 0.10, 1.06),
            (cowl_x + 0.12, cowl_z - 0.05),
            (cowl_x - 0.05, cowl_z - 0.05 * slope),
            (header_x + 0.06, header_z + 0.06 * slope),
            (header_x - 0.35, roof - 0.10),
            (header_x - 1.1, roof),
            (rear + 0.6, roof),
            (rear, roof - 0.09),
        ])
    }

    /// Foot of a minibus's windscreen.
    pub(crate) fn cowl_x(&self) -> f64 {
        self.ends_x[0] - 0.72
    }

    /// Top of a minibus's windscreen.
    pub(crate) fn header_x(&self) -> f64 {
        self.ends_x[0] - 1.52
    }
}
