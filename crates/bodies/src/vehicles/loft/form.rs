//! Proportions of a lofted body and the lines that follow from them.

use crate::vehicles::drawing::curve::{Curve, smooth_step};
use crate::vehicles::drawing::shell::{Shell, spaced};
use crate::vehicles::family::Parameters;

/// The space of a body, in a drawing with x = 0 half way along the vehicle and z = 0 on the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Envelope {
    /// Front and rear end.
    pub(crate) ends_x: [f64; 2],
    /// Top of the roof.
    pub(crate) roof_z: f64,
    /// Half width without mirrors.
    pub(crate) half_width_m: f64,
    /// Half the width including mirrors.
    pub(crate) outer_y: f64,
}

impl Envelope {
    /// Space of the whole size except parts on the roof, behind the tail and beside the doors.
    pub(crate) fn of_size(parameters: &Parameters<'_>, size_m: [f64; 3]) -> Self {
        let [ahead, behind] = ["ahead_m", "behind_m"].map(|key| parameters.number_or(key, 0.0));
        Self {
            ends_x: [0.5 * size_m[0] - ahead, -0.5 * size_m[0] + behind],
            roof_z: size_m[2] - parameters.number_or("on_roof_m", 0.0),
            half_width_m: 0.5 * size_m[1] - parameters.number("mirror_m"),
            outer_y: 0.5 * size_m[1],
        }
    }
}

/// Form of one end face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Face {
    /// Lean inwards above the bumper, metres per metre up, and its growth with height, per metre.
    pub(crate) lean: f64,
    pub(crate) curve_per_m: f64,
    /// Lean inwards below the bumper, metres per metre down.
    pub(crate) chin: f64,
    /// Distance of the middle in front of the corners.
    pub(crate) bow_m: f64,
    /// Distance of the bumper in front of the panel above it.
    pub(crate) bumper_m: f64,
    /// Reduction of the half width towards the end.
    pub(crate) taper_m: f64,
    /// Rounding of the edges around the face.
    pub(crate) radius_m: f64,
    /// Whether the face reaches up to the roof.
    pub(crate) upright: bool,
}

/// A body's proportions; points of the silhouette are (x, z) in metres.
#[derive(Debug, Clone)]
pub(crate) struct Form {
    pub(crate) envelope: Envelope,
    pub(crate) half_width_m: f64,
    pub(crate) axles_x: Vec<f64>,
    pub(crate) wheel_radius_m: f64,
    pub(crate) tyre_width_m: f64,
    pub(crate) twin: bool,
    pub(crate) clearance_m: f64,
    pub(crate) bumper_z: f64,
    pub(crate) nose_z: f64,
    pub(crate) cowl: (f64, f64),
    pub(crate) header: (f64, f64),
    pub(crate) roof_end: (f64, f64),
    pub(crate) deck: (f64, f64),
    pub(crate) tail_z: f64,
    pub(crate) waist: [f64; 2],
    pub(crate) roof_y: f64,
    pub(crate) rail_drop_m: f64,
    pub(crate) belly_m: f64,
    pub(crate) front: Face,
    pub(crate) rear: Face,
}

fn face(parameters: &Parameters<'_>, end: &str) -> Face {
    let number = |what: &str| parameters.number(&format!("{end}_{what}"));
    Face {
        lean: number("rake_deg").to_radians().tan(),
        curve_per_m: number("curve_per_m"),
        chin: number("chin_deg").to_radians().tan(),
        bow_m: number("bow_m"),
        bumper_m: number("bumper_m"),
        taper_m: number("taper_m"),
        radius_m: number("radius_m"),
        upright: parameters.has(&format!("{end}_upright")),
    }
}

impl Form {
    /// Form drawn into the given space.
    pub(crate) fn of(parameters: &Parameters<'_>, envelope: &Envelope) -> Self {
        let [front_x, rear_x] = envelope.ends_x;
        let (length, roof) = (front_x - rear_x, envelope.roof_z);
        let point = |key: &str| {
            let [along, up] = parameters.numbers(key);
            (front_x - along * length, up * roof)
        };
        let share = |key: &str| parameters.number(key) * roof;
        let waist = parameters.numbers::<2>("waist").map(|up| up * roof);
        let lean_in = parameters.number("tumblehome_deg").to_radians().tan();
        let axles_x = parameters
            .rows::<1>("axles")
            .into_iter()
            .map(|[x]| if x > 0.0 { front_x - x } else { rear_x - x });
        Self {
            envelope: *envelope,
            half_width_m: envelope.half_width_m,
            axles_x: axles_x.collect(),
            wheel_radius_m: parameters.number("wheel_radius_m"),
            tyre_width_m: parameters.number("tyre_width_m"),
            twin: parameters.has("twin"),
            clearance_m: parameters.number("clearance_m"),
            bumper_z: parameters.number("clearance_m") + parameters.number("bumper_height_m"),
            nose_z: share("nose"),
            cowl: point("cowl"),
            header: point("header"),
            roof_end: point("roof_end"),
            deck: point("deck"),
            tail_z: share("tail"),
            waist,
            roof_y: envelope.half_width_m - 0.02 - lean_in * (roof - 0.5 * (waist[0] + waist[1])),
            rail_drop_m: parameters.number("crown_m"),
            belly_m: parameters.number("belly_m"),
            front: face(parameters, "front"),
            rear: face(parameters, "rear"),
        }
    }

    /// Radius of an arch, with room to steer and to spring.
    pub(crate) fn arch_radius_m(&self) -> f64 {
        1.08 * self.wheel_radius_m + 0.03
    }

    /// Distance of an arch's inner side from the middle plane; twin tyres need twice the room.
    pub(crate) fn arch_inner_y(&self) -> f64 {
        let tyres = if self.twin { 2.0 * self.tyre_width_m + 0.06 } else { self.tyre_width_m };
        self.half_width_m - tyres - 0.10
    }

    /// Silhouette in the middle plane, from the front to the rear.
    fn top_z(&self) -> Curve {
        let mut points = self.top_front();
        points.extend(self.top_rear());
        Curve::through(&points)
    }

    fn top_front(&self) -> Vec<(f64, f64)> {
        let [front, _] = self.envelope.ends_x;
        let roof = self.envelope.roof_z;
        if self.front.upright {
            return vec![
                (front, self.nose_z),
                (front - 0.35, 0.3 * self.nose_z + 0.7 * roof),
                (front - 0.9, roof),
            ];
        }
        let ((cx, cz), (hx, hz)) = (self.cowl, self.header);
        let slope = (hz - cz) / (hx - cx);
        let run = (front - cx).min(1.0);
        let mut points =
            vec![(front, self.nose_z), (front - 0.12 * run, self.nose_z + 0.3 * (cz - self.nose_z))];
        points.extend([
            (0.5 * (front + cx), 0.3 * self.nose_z + 0.7 * cz),
            (cx + 0.10 * run, cz - 0.012),
            (cx - 0.05, cz - 0.05 * slope),
            (hx + 0.08, hz + 0.08 * slope),
            (hx - 0.12, hz + 0.5 * (roof - hz)),
            (hx - 0.45, roof - 0.1 * (roof - hz)),
        ]);
        points
    }

    fn top_rear(&self) -> Vec<(f64, f64)> {
        let [_, rear] = self.envelope.ends_x;
        let roof = self.envelope.roof_z;
        if self.rear.upright {
            return vec![
                (rear + 0.7, roof - 0.005),
                (rear + 0.25, roof - 0.25 * (roof - self.tail_z)),
                (rear, self.tail_z),
            ];
        }
        let ((rx, rz), (dx, dz)) = (self.roof_end, self.deck);
        let slope = (rz - dz) / (rx - dx);
        let mut points = vec![
            (0.7 * rx + 0.3 * self.header.0, roof),
            (rx + 0.10, rz + 0.014),
            (rx - 0.04, rz - 0.04 * slope),
            (dx + 0.04, dz + 0.04 * slope),
        ];
        if dx - rear > 0.25 {
            points.extend([(dx - 0.08, dz - 0.012), (rear + 0.06, self.tail_z + 0.02)]);
        }
        points.push((rear, self.tail_z));
        points
    }

    /// Share of the cabin: 1 within it, 0 over bonnet and boot.
    fn cabin(&self, x: f64) -> f64 {
        let front = if self.front.upright { 1.0 } else { smooth_step(self.cowl.0 + 0.05, self.header.0, x) };
        let rear = if self.rear.upright { 1.0 } else { smooth_step(self.deck.0 - 0.05, self.roof_end.0, x) };
        front.min(rear)
    }

    /// The lines, sampled wherever the silhouette may bend.
    pub(crate) fn shell(&self) -> Shell {
        let [front, rear] = self.envelope.ends_x;
        let half = self.half_width_m;
        let top_z = self.top_z();
        let over_x = |y: &dyn Fn(f64) -> f64| {
            Curve::through(&spaced(rear, front, 0.08).into_iter().map(|x| (x, y(x))).collect::<Vec<_>>())
        };
        let plan = Curve::through(&[
            (rear, half - self.rear.taper_m),
            (rear + 0.6, half - 0.15 * self.rear.taper_m),
            (0.5 * (front + rear), half),
            (front - 0.8, half - 0.1 * self.front.taper_m),
            (front, half - self.front.taper_m),
        ]);
        let waist = Curve::through(&[(rear, self.waist[1]), (front, self.waist[0])]);
        let gap = if self.rail_drop_m > 0.1 { self.rail_drop_m + 0.06 } else { 0.12 };
        let lift =
            |x: f64| 0.07 * smooth_step(front - 0.75, front, x) + 0.09 * smooth_step(rear + 0.9, rear, x);
        let rail = |x: f64| {
            let bonnet = plan.at(x) - 0.07;
            bonnet + (self.roof_y - bonnet) * self.cabin(x)
        };
        Shell {
            bottom_z: over_x(&|x| self.clearance_m + lift(x)),
            waist_z: over_x(&|x| waist.at(x).min(top_z.at(x) - gap)),
            rail_z: over_x(&|x| top_z.at(x) - self.rail_drop_m * (0.65 + 0.35 * self.cabin(x))),
            sill_y: over_x(&|x| plan.at(x) - 0.6 * self.belly_m - 0.01),
            belly_y: plan.clone(),
            waist_y: over_x(&|x| plan.at(x) - self.belly_m),
            rail_y: over_x(&rail),
            top_z: top_z.clone(),
            upper_bow_m: 0.4 * self.belly_m,
            roof_exponent: 2.7,
            sill_radius_m: 0.06,
            end_radius_m: [self.front.radius_m, self.rear.radius_m],
            ends_x: self.envelope.ends_x,
        }
    }
}
