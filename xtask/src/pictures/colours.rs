//! Colours that say the same to most eyes.

use artifact::settings::Class;

/// Colour of a class; of no class, grey. Okabe & Ito's palette (2008), safe for colour-blind readers.
pub(crate) fn class_colour(class: Option<Class>) -> &'static str {
    match class {
        Some(Class::Car) => "#0072b2",
        Some(Class::Bus) => "#d55e00",
        Some(Class::Truck) => "#009e73",
        Some(Class::Motorcycle) => "#cc79a7",
        None => "#777777",
    }
}

/// Colour of the n-th line of a plot, of the same palette; darker ones follow where it ends.
pub(crate) fn line_colour(n: usize) -> &'static str {
    const COLOURS: [&str; 10] =
        ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#777777", "#000000", "#7a3b00", "#4b2e83"];
    COLOURS[n % COLOURS.len()]
}

/// Dark to bright for 0 to 1: eight samples of matplotlib's `inferno`, linear between (perceptually even).
pub(crate) fn heat(level: f64) -> [u8; 3] {
    const STOPS: [[f64; 3]; 8] = [
        [0.0, 0.0, 4.0],
        [40.0, 11.0, 84.0],
        [101.0, 21.0, 110.0],
        [159.0, 42.0, 99.0],
        [212.0, 72.0, 66.0],
        [245.0, 125.0, 21.0],
        [250.0, 193.0, 39.0],
        [252.0, 255.0, 164.0],
    ];
    let place = level.clamp(0.0, 1.0) * 7.0;
    let i = (place as usize).min(6);
    let share = place - i as f64;
    std::array::from_fn(|c| (STOPS[i][c] * (1.0 - share) + STOPS[i + 1][c] * share).round() as u8)
}
