//! Trucks of the families: a cab, a chassis and a load; or one body that includes the cab.
//!
//! Lengths of the cab are shares of `cab_m` = [length, height of its roof]. `carries` defines the load: "box"
//! (a hull with slightly distorted panels), "tank", or "parts" if the table lists only solids.

use crate::vehicles::drawing::curve::Curve;
use crate::vehicles::drawing::mesh_builder::Assembly;
use crate::vehicles::drawing::shell::{Layout, Shell, even, spaced};
use crate::vehicles::drawing::solids::sharp_box;
use crate::vehicles::drawing::surface::Material;
use crate::vehicles::family::Parameters;
use crate::vehicles::loft::{self, Envelope, Form as Cab};
use crate::vehicles::parts;
use crate::vehicles::truck::chassis;
use crate::vehicles::truck::form::{Form, Kind};
use crate::vehicles::truck::load;
use glam::DVec3;

/// Makes a whole truck in its drawing's axes, in the given size.
pub(crate) fn draw(parameters: &Parameters<'_>, nominal_m: [f64; 3], size_m: [f64; 3]) -> Assembly {
    if parameters.has("unibody") {
        return loft::draw(parameters, nominal_m, size_m);
    }
    let form = form(parameters, size_m);
    let mut truck = Assembly::default();
    let [front, _] = form.ends_x;
    let envelope = Envelope {
        ends_x: [front, form.cab_rear_x()],
        roof_z: form.cab_roof_z,
        half_width_m: form.half_width_m - parameters.number("cab_in_m"),
        outer_y: 0.5 * size_m[1],
    };
    loft::add_body(parameters, &Cab::of(parameters, &envelope), &mut truck);
    chassis::add(&form, &mut truck);
    if parameters.has("skirts") {
        skirts(&form, &mut truck);
    }
    match parameters.word("carries") {
        "box" => hull(parameters, &form, &mut truck),
        "tank" => load::tank(&form, &mut truck),
        _ => {}
    }
    parts::add(parameters, DVec3::from_array(size_m) / DVec3::from_array(nominal_m), &mut truck);
    truck
}

/// Axles in metres from the front, or negative from the rear.
fn form(parameters: &Parameters<'_>, size_m: [f64; 3]) -> Form {
    let [front, rear] = [0.5 * size_m[0] - parameters.number_or("ahead_m", 0.0), -0.5 * size_m[0]];
    let [cab_length_m, cab_roof_z] = parameters.numbers("cab_m");
    let at = |x: f64| if x > 0.0 { front - x } else { rear - x };
    let axles = |key: &str| parameters.rows::<1>(key).into_iter().map(|[x]| at(x)).collect::<Vec<_>>();
    let kind = if parameters.has("semitrailer") { Kind::Semi } else { Kind::Box };
    let twin_axles_x = axles("twin_axles");
    let frame_rear = if kind == Kind::Semi { twin_axles_x[0] - 0.85 } else { rear + 0.12 };
    let [floor_z, top_m] = parameters.numbers("load_z");
    Form {
        kind,
        size_m,
        ends_x: [front, rear],
        half_width_m: 0.5 * size_m[1] - parameters.number("mirror_m"),
        cab_length_m,
        cab_roof_z,
        wheel_radius_m: parameters.number("wheel_radius_m"),
        wheel_sectors: parameters.number("wheel_sectors") as usize,
        front_axle_x: axles("axles").first().copied().unwrap_or(front),
        twin_axles_x,
        single_axles_x: axles("trailer_axles"),
        frame_z: parameters.number("frame_z_m"),
        frame_x: [front - 0.35, frame_rear],
        load_x: [at(parameters.number("load_from_m")), rear + 0.10],
        load_floor_z: floor_z,
        load_top_z: size_m[2] - top_m,
    }
}

/// A box whose walls bow and lean like panels of sheet or canvas.
fn hull(parameters: &Parameters<'_>, form: &Form, truck: &mut Assembly) {
    let [front, rear] = form.load_x;
    let (low, high, half) = (form.load_floor_z, form.load_top_z, form.half_width_m + 0.02);
    let [bow_m, lean_m, radius_m, crown_m] = parameters.numbers("hull");
    let flatness = if parameters.has("hull_flat") { 0.1 } else { 1.0 };
    let [bow_m, lean_m] = [bow_m, lean_m].map(|out_of_true| out_of_true * flatness);
    let shell = Shell {
        bottom_z: Curve::flat(low),
        waist_z: Curve::flat(0.5 * (low + high)),
        rail_z: Curve::flat(high - crown_m - 0.01),
        top_z: Curve::through(&[
            (rear, high),
            (front - 1.0, high),
            (front, high - parameters.number("hull_drop_m")),
        ]),
        sill_y: Curve::flat(half - 0.5 * bow_m),
        belly_y: Curve::flat(half),
        waist_y: Curve::flat(half),
        rail_y: Curve::flat(half - bow_m),
        upper_bow_m: 0.3 * bow_m,
        roof_exponent: 3.5,
        sill_radius_m: 0.02,
        end_radius_m: [radius_m, 0.03],
        ends_x: [front, rear],
    };
    let layout =
        Layout { stations_x: spaced(rear, front, 1.2), lower: even(3), upper: even(3), half_columns: 3 };
    let middle_z = 0.5 * (low + high);
    let bent = |p: DVec3| {
        let at_front = ((p.x - rear) / (front - rear)).clamp(0.0, 1.0).powi(8);
        let out =
            1.0 - (p.y / half).powi(2) * (1.0 - ((p.z - middle_z) / (high - middle_z)).powi(2)).max(0.0);
        let lean = (p.z - low) / (high - low) * lean_m;
        DVec3::new(p.x - at_front * (lean + bow_m * (1.0 - out)), p.y, p.z)
    };
    truck.add(shell.skin(&layout).map(bent));
    rails(parameters, form, half, truck);
    if !parameters.has("no_doors") {
        load::rear_doors(form, truck);
    }
}

/// Rails along the lower and the upper edge of a box's sides, and posts between them.
fn rails(parameters: &Parameters<'_>, form: &Form, half_m: f64, truck: &mut Assembly) {
    let [front, rear] = form.load_x;
    let [low, high] = [form.load_floor_z, form.load_top_z];
    let (length, middle, out_m) =
        (front - rear - 0.06, 0.5 * (front + rear), parameters.number("rail_out_m"));
    let rail = |size_m, at: DVec3| sharp_box(size_m, Material::Aluminium).moved(at.x, at.y, at.z);
    let y = half_m + 0.5 * out_m - 0.04;
    for (key, z, height_m) in [("low_rails", low + 0.06, 0.12), ("high_rails", high - 0.16, 0.10)] {
        if parameters.has(key) {
            truck.add_pair(rail([length, out_m + 0.08, height_m], DVec3::new(middle, y, z)));
        }
    }
    let posts = if parameters.has("posts") { (length / parameters.number("post_pitch_m")) as u32 } else { 0 };
    for k in 1..posts {
        let x = rear + 0.03 + length * f64::from(k) / f64::from(posts);
        truck.add_pair(rail([0.05, out_m + 0.08, 0.9 * (high - low)], DVec3::new(x, y, 0.5 * (low + high))));
    }
}

/// Smooth panels beside the frame, from behind the cab's wheels to the next axle.
fn skirts(form: &Form, truck: &mut Assembly) {
    let reach_m = form.wheel_radius_m + 0.12;
    let ahead = form.front_axle_x - reach_m;
    let axles = form.twin_axles_x.iter().chain(&form.single_axles_x);
    let behind = axles.copied().filter(|x| *x < ahead).fold(form.load_x[1], f64::max) + reach_m;
    let [low, high] = [0.6 * form.wheel_radius_m, form.frame_z];
    if ahead > behind {
        let panel = sharp_box([ahead - behind, 0.03, high - low], Material::Paint);
        truck.add_pair(panel.moved(0.5 * (ahead + behind), form.half_width_m - 0.01, 0.5 * (low + high)));
    }
}
