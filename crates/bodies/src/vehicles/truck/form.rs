//! Proportions of trucks.

use crate::vehicles::dimensions::{ParameterSampler, SizeRange};

/// Kind of truck.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Box,
    Tanker,
    Semi,
}

/// A truck's proportions, in a drawing with x = 0 half way along and z = 0 on the ground.
#[derive(Debug, Clone)]
pub(crate) struct Form {
    pub(crate) kind: Kind,
    pub(crate) size_m: [f64; 3],
    /// Front and rear end of the whole vehicle.
    pub(crate) ends_x: [f64; 2],
    /// Half width of cab and load.
    pub(crate) half_width_m: f64,
    pub(crate) cab_length_m: f64,
    pub(crate) cab_roof_z: f64,
    pub(crate) wheel_radius_m: f64,
    /// Number of sectors of the polygon for a tyre's circle.
    pub(crate) wheel_sectors: usize,
    pub(crate) front_axle_x: f64,
    /// Driven axles with twin wheels.
    pub(crate) twin_axles_x: Vec<f64>,
    /// Trailer's axles with single wheels.
    pub(crate) single_axles_x: Vec<f64>,
    /// Top of the ladder frame.
    pub(crate) frame_z: f64,
    /// Front and rear end of the truck's or tractor's own frame.
    pub(crate) frame_x: [f64; 2],
    /// Front and rear end of the load.
    pub(crate) load_x: [f64; 2],
    pub(crate) load_floor_z: f64,
    pub(crate) load_top_z: f64,
}

/// Overall length, width over mirrors, height. Body 2.5 m wide; the law's limits are 2.55 m (2.6 m
/// refrigerated), 4.0 m high, 12 m long, with semitrailer 16.5 m (Directive 96/53/EC). Ranges: box trucks of
/// 7.5 to 18 t from 7 to 9.5 m and 3.3 to 3.8 m high; three-axle fuel tankers 8.8 to 10 m and 3.1 to 3.5 m;
/// semitrailers 13.6 m long behind two-axle tractors, 15.9 to 16.5 m, 3.8 to 4.0 m high. Mirrors reach 0.2 to
/// 0.25 m beyond the cab. Rounded to 5 cm.
pub(crate) fn size_range(model: &str) -> SizeRange {
    match model {
        "truck-box" => {
            SizeRange { nominal_m: [8.5, 2.95, 3.6], range_m: [[7.0, 9.5], [2.9, 3.05], [3.3, 3.8]] }
        }
        "truck-tanker" => {
            SizeRange { nominal_m: [9.4, 2.95, 3.3], range_m: [[8.8, 10.0], [2.9, 3.05], [3.1, 3.5]] }
        }
        _ => SizeRange { nominal_m: [16.5, 2.95, 4.0], range_m: [[15.9, 16.5], [2.9, 3.05], [3.8, 4.0]] },
    }
}

impl Form {
    /// Form drawn for the model and seed, in the given size.
    pub(crate) fn of(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        match sampler.model {
            "truck-box" => Self::box_truck(sampler, size_m),
            "truck-tanker" => Self::tanker(sampler, size_m),
            _ => Self::semi(sampler, size_m),
        }
    }

    fn box_truck(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let (front, rear) = (0.5 * size_m[0], -0.5 * size_m[0]);
        let cab_length_m = sampler.value("cab", 1.75, 1.65..=2.1);
        let rear_axle_x = rear + sampler.value("rear overhang", 0.26, 0.22..=0.30) * size_m[0];
        Self {
            kind: Kind::Box,
            size_m,
            ends_x: [front, rear],
            half_width_m: 1.25,
            cab_length_m,
            cab_roof_z: sampler.value("cab roof", 2.72, 2.6..=2.9),
            wheel_radius_m: 0.46,
            wheel_sectors: 18,
            front_axle_x: front - sampler.value("front overhang", 1.32, 1.25..=1.4),
            twin_axles_x: vec![rear_axle_x],
            single_axles_x: vec![],
            frame_z: 0.92,
            frame_x: [front - 0.35, rear + 0.12],
            load_x: [front - cab_length_m - sampler.value("gap", 0.22, 0.15..=0.3), rear + 0.04],
            load_floor_z: 1.06,
            load_top_z: size_m[2],
        }
    }

    fn tanker(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let (front, rear) = (0.5 * size_m[0], -0.5 * size_m[0]);
        let cab_length_m = sampler.value("cab", 1.95, 1.8..=2.2);
        let tandem_x = rear + sampler.value("rear overhang", 2.15, 2.0..=2.3);
        Self {
            kind: Kind::Tanker,
            size_m,
            ends_x: [front, rear],
            half_width_m: 1.25,
            cab_length_m,
            cab_roof_z: sampler.value("cab roof", 2.95, 2.85..=3.0),
            wheel_radius_m: 0.50,
            wheel_sectors: 18,
            front_axle_x: front - sampler.value("front overhang", 1.40, 1.35..=1.45),
            twin_axles_x: vec![tandem_x + 0.68, tandem_x - 0.68],
            single_axles_x: vec![],
            frame_z: 1.02,
            frame_x: [front - 0.35, rear + 0.12],
            load_x: [front - cab_length_m - sampler.value("gap", 0.35, 0.25..=0.45), rear + 0.10],
            load_floor_z: 1.12,
            load_top_z: size_m[2] - 0.30,
        }
    }

    fn semi(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let (front, rear) = (0.5 * size_m[0], -0.5 * size_m[0]);
        let cab_length_m = sampler.value("cab", 2.25, 2.1..=2.3);
        let front_axle_x = front - sampler.value("front overhang", 1.42, 1.38..=1.45);
        let drive_x = front_axle_x - sampler.value("wheelbase", 3.70, 3.6..=3.8);
        let bogie_x = rear + sampler.value("bogie", 3.75, 3.5..=4.0);
        Self {
            kind: Kind::Semi,
            size_m,
            ends_x: [front, rear],
            half_width_m: 1.25,
            cab_length_m,
            cab_roof_z: sampler.value("cab roof", 3.45, 3.2..=3.65),
            wheel_radius_m: 0.50,
            wheel_sectors: 18,
            front_axle_x,
            twin_axles_x: vec![drive_x],
            single_axles_x: vec![bogie_x + 1.31, bogie_x, bogie_x - 1.31],
            frame_z: 0.98,
            frame_x: [front - 0.35, drive_x - 0.85],
            load_x: [rear + sampler.value("trailer", 13.6, 13.4..=13.62), rear + 0.03],
            load_floor_z: 1.18,
            load_top_z: size_m[2],
        }
    }

    /// Rear wall of the cab.
    pub(crate) fn cab_rear_x(&self) -> f64 {
        self.ends_x[0] - self.cab_length_m
    }
}
