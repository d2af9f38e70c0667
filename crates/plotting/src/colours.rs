//! Colours that say the same to most eyes: classes of `light.css` and `dark.css`, on the palette of Okabe &
//! Ito (2008), darkened where it is too faint on white.

/// Colours of lines, told apart by most eyes.
const COLOURS: [&str; 10] = ["c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7", "c8", "c9"];

/// Colour of the n-th line of a plot.
pub fn line_colour(n: usize) -> &'static str {
    COLOURS[n % COLOURS.len()]
}

/// Whether the n-th line of a plot has the colour of an earlier one, and is told from it by its strokes.
pub(crate) fn is_repeated(n: usize) -> bool {
    n >= COLOURS.len()
}

/// Colour from dark to bright for 0 to 1: eight samples of matplotlib's `inferno`, linear between
/// (perceptually even).
pub fn inferno(level: f64) -> [u8; 3] {
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
