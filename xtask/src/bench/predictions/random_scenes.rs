//! Scenes drawn from a seed: typical tasks of a radar at a junction, from one car at rest to a queue below
//! the mast.

use crate::bench::predictions::timed_scene::{Text, TimedScene};
use crate::random_scenes::{SceneRng, clutter, radar, traffic};
use std::fmt::Write as _;
use std::path::Path;

/// Scene `number` of a seed; `root` holds `scenes` and `fixtures`.
pub(super) fn scene(seed: u64, number: u64, root: &Path) -> TimedScene {
    let mut rng = SceneRng::new(seed, "xtask/predictions", number);
    let name = format!("random-{seed}-{number:03}");
    let mut text = format!("name = \"{name}\"\nseed = {}\n", number + 1);
    if rng.chance(0.1) {
        traffic(&mut rng, root, "accuracy_db = -10.0\nbounces = 1\n", &mut text);
    } else {
        bodies(&mut rng, root, &mut text);
    }
    let threads = rng.chance(0.5).then_some(1);
    TimedScene { name, text: Text::Drawn(text), threads }
}

fn bodies(rng: &mut SceneRng, root: &Path, text: &mut String) {
    let count = rng.choose(&[1, 1, 1, 1, 1, 2, 2, 2, 3, 4, 6]);
    // Scenes with many vehicles have few frames and coarser accuracies.
    let frames = if count < 3 { rng.choose(&[1, 1, 1, 1, 1, 1, 2, 3, 5]) } else { rng.choose(&[1, 1, 1, 2]) };
    let _ = writeln!(text, "frames = {frames}");
    radar(rng, text);
    let bounces = if count < 4 { rng.choose(&[1, 1, 2, 3]) } else { rng.choose(&[1, 1, 2]) };
    let finest_db = [-30.0, -24.0, -18.0][(count - 1).min(2)];
    let accuracy_db =
        (10.0 * rng.between(finest_db, -10.0).max(rng.between(finest_db, -10.0))).round() / 10.0;
    let measured_every = rng.choose(&[1, 2, 5]);
    let _ = write!(
        text,
        "[fidelity]\naccuracy_db = {accuracy_db}\nbounces = {bounces}\nmeasured_every = {measured_every}\n"
    );
    variants(rng, root, text);
    let mut lanes_m = [0.0; 3];
    for number in 0..count {
        vehicle(rng, number, &mut lanes_m, text);
    }
    if rng.chance(0.2) {
        clutter(rng, text);
    }
}

/// Adds unusual settings, and the road.
fn variants(rng: &mut SceneRng, root: &Path, text: &mut String) {
    if rng.chance(0.15) {
        let _ = writeln!(text, "materials = {:?}", root.join("scenes/vehicles.materials.toml"));
    }
    if rng.chance(0.06) {
        text.push_str("edges = \"on\"\n");
    }
    if rng.chance(0.06) {
        text.push_str("surface = \"smooth\"\n");
    }
    // A table supports neither paths nor the road nor its floor.
    if rng.chance(0.05) {
        text.push_str("echo = \"rcs-table\"\n");
        return;
    }
    if rng.chance(0.06) {
        text.push_str("detail = \"auto\"\n");
    }
    match rng.below(20) {
        0 => text.push_str("[road]\n"),
        1..=3 => text.push_str("[road]\nmirror = \"off\"\nbackscatter = \"floor\"\n"),
        _ => {}
    }
}

/// Adds a vehicle in a lane, mostly 12 to 80 m away; occasionally directly below the mast. `lanes_m` holds
/// the place of each lane's first vehicle.
fn vehicle(rng: &mut SceneRng, number: usize, lanes_m: &mut [f64; 3], text: &mut String) {
    let (model, class) = rng.own_vehicle();
    let first_m = &mut lanes_m[number % 3];
    let y_m = match number {
        // At least 20 m before or behind the first of its lane.
        3.. if *first_m < 46.0 => rng.between(*first_m + 20.0, 80.0),
        3.. => rng.between(12.0, *first_m - 20.0),
        _ if rng.chance(0.05) => rng.between(-2.0, 8.0),
        _ => rng.between(12.0, 80.0),
    };
    *first_m = y_m;
    let velocity_mps = if rng.chance(0.25) { 0.0 } else { rng.between(-15.0, 5.0) };
    let _ = write!(
        text,
        "[[target]]\nkind = \"mesh\"\nid = \"body-{number}\"\nclass = \"{class}\"\nmodel = \"{model}\"\nlane = {}\n\
         y_m = {y_m:.2}\nvelocity_mps = [0.0, {velocity_mps:.2}, 0.0]\nyaw_deg = -90.0\n",
        number % 3 + 1
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::ReadOptions;

    #[test]
    fn scenes_drawn_are_scenes_that_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        for number in 0..60 {
            let drawn = scene(9, number, root);
            let file = folder.path().join("random.toml");
            let Text::Drawn(text) = &drawn.text else { panic!("{} is no file", drawn.name) };
            std::fs::write(&file, text).unwrap();
            let options = ReadOptions::names_only();
            let read = scene::read(&file, &options).unwrap_or_else(|e| panic!("{}: {e}\n{text}", drawn.name));
            assert_eq!(read.name, drawn.name);
        }
    }
}
