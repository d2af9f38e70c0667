//! Proportions of passenger cars and the lines that follow from them.

use crate::vehicles::dimensions::{ParameterSampler, SizeRange};
use crate::vehicles::drawing::curve::{Curve, smooth_step};

/// Kind of body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BodyStyle {
    SportUtility,
    Saloon,
    Hatchback,
}

/// A car's proportions, in a drawing with x = 0 half way along and z = 0 on the ground.
#[derive(Debug, Clone)]
pub(crate) struct Form {
    pub(crate) body: BodyStyle,
    pub(crate) size_m: [f64; 3],
    /// Half width of the body without mirrors.
    pub(crate) half_width_m: f64,
    pub(crate) wheel_radius_m: f64,
    pub(crate) tyre_width_m: f64,
    pub(crate) spokes: u32,
    pub(crate) front_axle_x: f64,
    pub(crate) rear_axle_x: f64,
    pub(crate) clearance_m: f64,
    /// Bottom and top of the windscreen in the car's middle.
    pub(crate) cowl: (f64, f64),
    pub(crate) header: (f64, f64),
    /// Top and bottom of the rear window.
    pub(crate) roof_end: (f64, f64),
    pub(crate) deck: (f64, f64),
    pub(crate) nose_z: f64,
    pub(crate) tail_z: f64,
    pub(crate) waist_front_z: f64,
    pub(crate) waist_rear_z: f64,
    /// Half width of the roof at its rail.
    pub(crate) roof_y: f64,
}

/// Overall length, width over mirrors, height. Ranges: published figures of cars sold in Europe in the 2010s
/// and 2020s, rounded to 5 cm. Sport utility: from Kia Sportage (4.5 × 2.1 × 1.65) to Toyota Land Cruiser
/// (5.0 × 2.2 × 1.95); nominal the 5 × 2 × 1.8 m of the paper's car. Saloon: Toyota Corolla (4.65 × 2.0 ×
/// 1.45) to BMW 5 (4.95 × 2.15 × 1.5). Hatchback: VW Polo (4.05 × 1.95 × 1.45) to VW Golf (4.3 × 2.05 × 1.5).
pub(crate) fn size_range(model: &str) -> SizeRange {
    match model {
        "car-suv" => {
            SizeRange { nominal_m: [5.0, 2.0, 1.8], range_m: [[4.5, 5.05], [2.0, 2.2], [1.65, 1.95]] }
        }
        "car-sedan" => {
            SizeRange { nominal_m: [4.8, 2.05, 1.46], range_m: [[4.6, 4.95], [2.0, 2.15], [1.43, 1.5]] }
        }
        _ => SizeRange { nominal_m: [4.2, 2.0, 1.48], range_m: [[3.95, 4.35], [1.9, 2.05], [1.44, 1.55]] },
    }
}

/// Distance by which a mirror projects from the body.
const MIRROR_OVERHANG_M: f64 = 0.09;

impl Form {
    /// Form drawn for the model and seed, in the given size.
    pub(crate) fn of(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        match sampler.model {
            "car-suv" => Self::sport_utility(sampler, size_m),
            "car-sedan" => Self::saloon(sampler, size_m),
            _ => Self::hatchback(sampler, size_m),
        }
    }

    fn sport_utility(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let [length, width, height] = size_m;
        let (front, roof) = (0.5 * length, height - 0.045);
        Self {
            body: BodyStyle::SportUtility,
            size_m,
            half_width_m: 0.5 * width - MIRROR_OVERHANG_M,
            wheel_radius_m: sampler.value("wheel radius", 0.39, 0.35..=0.41),
            tyre_width_m: sampler.value("tyre width", 0.255, 0.225..=0.285),
            spokes: sampler.value("spokes", 5.0, 5.0..=7.9) as u32,
            front_axle_x: front - sampler.value("front overhang", 0.92, 0.85..=0.95),
            rear_axle_x: -front + sampler.value("rear overhang", 1.04, 0.92..=1.06),
            clearance_m: sampler.value("clearance", 0.24, 0.19..=0.26),
            cowl: (0.205 * length, roof - 0.555),
            header: (0.205 * length - sampler.value("windscreen", 0.70, 0.62..=0.80), roof - 0.055),
            roof_end: (-0.437 * length, roof - 0.07),
            deck: (-0.437 * length - 0.17, roof - 0.58),
            nose_z: roof - 0.68,
            tail_z: roof - 0.66,
            waist_front_z: roof - 0.63,
            waist_rear_z: roof - 0.57,
            roof_y: 0.5 * width - MIRROR_OVERHANG_M - sampler.value("tumblehome", 0.27, 0.22..=0.30),
        }
    }

    fn saloon(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let [length, width, height] = size_m;
        let front = 0.5 * length;
        let deck_x = -front + sampler.value("boot", 0.62, 0.5..=0.7);
        Self {
            body: BodyStyle::Saloon,
            size_m,
            half_width_m: 0.5 * width - MIRROR_OVERHANG_M - 0.02,
            wheel_radius_m: sampler.value("wheel radius", 0.33, 0.31..=0.345),
            tyre_width_m: sampler.value("tyre width", 0.225, 0.205..=0.255),
            spokes: sampler.value("spokes", 7.0, 5.0..=9.9) as u32,
            front_axle_x: front - sampler.value("front overhang", 0.90, 0.82..=0.95),
            rear_axle_x: -front + sampler.value("rear overhang", 1.08, 1.0..=1.12),
            clearance_m: sampler.value("clearance", 0.16, 0.14..=0.18),
            cowl: (0.205 * length, height - 0.48),
            header: (0.205 * length - sampler.value("windscreen", 0.84, 0.78..=0.92), height - 0.04),
            roof_end: (deck_x + sampler.value("rear window", 0.78, 0.7..=0.85), height - 0.055),
            deck: (deck_x, height - 0.41),
            nose_z: height - 0.66,
            tail_z: height - 0.46,
            waist_front_z: height - 0.58,
            waist_rear_z: height - 0.51,
            roof_y: 0.5 * width - MIRROR_OVERHANG_M - sampler.value("tumblehome", 0.33, 0.3..=0.36),
        }
    }

    fn hatchback(sampler: &ParameterSampler, size_m: [f64; 3]) -> Self {
        let [length, width, height] = size_m;
        let front = 0.5 * length;
        let roof_end_x = -front + sampler.value("tailgate", 0.56, 0.48..=0.62);
        Self {
            body: BodyStyle::Hatchback,
            size_m,
            half_width_m: 0.5 * width - MIRROR_OVERHANG_M - 0.02,
            wheel_radius_m: sampler.value("wheel radius", 0.315, 0.295..=0.335),
            tyre_width_m: sampler.value("tyre width", 0.205, 0.185..=0.225),
            spokes: sampler.value("spokes", 5.0, 5.0..=8.9) as u32,
            front_axle_x: front - sampler.value("front overhang", 0.84, 0.78..=0.88),
            rear_axle_x: -front + sampler.value("rear overhang", 0.74, 0.66..=0.82),
            clearance_m: sampler.value("clearance", 0.16, 0.14..=0.18),
            cowl: (0.235 * length, height - 0.47),
            header: (0.235 * length - sampler.value("windscreen", 0.88, 0.8..=0.95), height - 0.045),
            roof_end: (roof_end_x, height - 0.08),
            deck: (roof_end_x - 0.46, height - 0.53),
            nose_z: height - 0.69,
            tail_z: height - 0.64,
            waist_front_z: height - 0.58,
            waist_rear_z: height - 0.51,
            roof_y: 0.5 * width - MIRROR_OVERHANG_M - sampler.value("tumblehome", 0.31, 0.28..=0.34),
        }
    }

    /// Front and rear axle.
    pub(crate) fn axles_x(&self) -> [f64; 2] {
        [self.front_axle_x, self.rear_axle_x]
    }

    /// Radius of an arch: tyres need room to steer and to spring.
    pub(crate) fn arch_radius_m(&self) -> f64 {
        self.wheel_radius_m + 0.055
    }

    /// Post between the front and the rear door.
    pub(crate) fn door_post_x(&self) -> f64 {
        self.front_axle_x - 0.355 * self.size_m[0]
    }

    /// Distance of an arch's inner side from the middle plane.
    pub(crate) fn arch_inner_y(&self) -> f64 {
        self.half_width_m - self.tyre_width_m - 0.10
    }

    /// Front and rear end of the body.
    pub(crate) fn ends_x(&self) -> [f64; 2] {
        [0.5 * self.size_m[0], -0.5 * self.size_m[0]]
    }

    /// Silhouette in the middle plane: bonnet, windscreen, roof, rear window, boot.
    pub(crate) fn top_z(&self) -> Curve {
        let [front, rear] = self.ends_x();
        let roof = self.header.1 + if self.body == BodyStyle::SportUtility { 0.055 } else { 0.042 };
        let ((cx, cz), (hx, hz)) = (self.cowl, self.header);
        let ((rx, rz), (dx, dz)) = (self.roof_end, self.deck);
        let (up, down) = ((hz - cz) / (hx - cx), (rz - dz) / (rx - dx));
        let mut points = vec![
            (front, self.nose_z),
            (front - 0.12, self.nose_z + 0.04),
            (0.5 * (front + cx), 0.35 * self.nose_z + 0.65 * cz - 0.01),
            (cx + 0.10, cz - 0.012),
            (cx - 0.05, cz + 0.05 * -up),
            (hx + 0.10, hz + 0.10 * up),
            (hx - 0.12, hz + 0.025),
            (0.55 * hx + 0.45 * rx, roof),
            (rx + 0.10, rz + 0.014),
            (rx - 0.04, rz - 0.04 * down),
            (dx + 0.04, dz + 0.04 * down),
        ];
        if self.body == BodyStyle::Saloon {
            points.extend([(dx - 0.08, dz - 0.012), (rear + 0.06, self.tail_z + 0.02)]);
        }
        points.push((rear, self.tail_z));
        Curve::through(&points)
    }

    /// Share of the cabin: 1 within it, 0 over bonnet and boot.
    pub(crate) fn cabin(&self, x: f64) -> f64 {
        let front = smooth_step(self.cowl.0 + 0.05, self.header.0, x);
        let rear = smooth_step(self.deck.0 - 0.05, self.roof_end.0, x);
        front.min(rear)
    }
}
