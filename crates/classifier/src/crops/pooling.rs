//! Area averaging of a square image to a smaller side, exact for any ratio.
//!
//! 451 to 128 is 3.52 pixels to one: an output pixel is the mean over its own square of the input, where
//! pixels on the border of two squares count by the part in each. The crop is resampled from cells of about
//! 0.2 m and 0.25 m/s, 24 m x 8 m/s in 451 x 451, so 128 pixels (0.19 m, 0.06 m/s) keep the map's resolution.

/// Averages grey levels `[side, side]`, row-major, to `[pooled_side, pooled_side]`, rounded to the nearest
/// level.
///
/// `pixels` must hold `side`² levels and `pooled_side` be at most `side`.
pub(crate) fn pool(pixels: &[u8], side: usize, pooled_side: usize) -> Vec<u8> {
    let shares = shares(side, pooled_side);
    let mut pooled = Vec::with_capacity(pooled_side * pooled_side);
    for rows in &shares {
        let line = mean_line(pixels, side, rows);
        pooled.extend(shares.iter().map(|columns| columns.mean(&line).round() as u8));
    }
    pooled
}

/// The input pixels under one output pixel along an axis, and the weight of each.
struct Share {
    first: usize,
    weights: Vec<f32>,
}

impl Share {
    fn mean(&self, line: &[f32]) -> f32 {
        self.weights.iter().zip(&line[self.first..]).map(|(w, v)| w * v).sum()
    }
}

fn shares(side: usize, pooled_side: usize) -> Vec<Share> {
    let ratio = side as f64 / pooled_side as f64;
    let share = |i: usize| {
        let (begin, end) = (i as f64 * ratio, (i + 1) as f64 * ratio);
        let (first, last) = (begin as usize, (end.ceil() as usize).min(side));
        let part = |p: usize| (end.min((p + 1) as f64) - begin.max(p as f64)).max(0.0) / ratio;
        Share { first, weights: (first..last).map(|p| part(p) as f32).collect() }
    };
    (0..pooled_side).map(share).collect()
}

/// One output row before averaging its columns: `[side]`.
fn mean_line(pixels: &[u8], side: usize, rows: &Share) -> Vec<f32> {
    let mut line = vec![0.0; side];
    for (row, weight) in pixels.chunks_exact(side).skip(rows.first).zip(&rows.weights) {
        for (sum, pixel) in line.iter_mut().zip(row) {
            *sum += weight * f32::from(*pixel);
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::pool;

    #[test]
    fn pooling_by_a_whole_number_is_the_mean_of_each_block() {
        let pixels = [0, 10, 100, 100, 20, 30, 100, 100, 7, 7, 0, 255, 7, 7, 255, 0];
        assert_eq!(pool(&pixels, 4, 2), [15, 100, 7, 128]); // 127.5 rounds up
    }

    #[test]
    fn pooling_to_the_same_side_changes_nothing() {
        let pixels: Vec<u8> = (0..49).map(|p| (p * 5) as u8).collect();
        assert_eq!(pool(&pixels, 7, 7), pixels);
    }

    #[test]
    fn pooling_keeps_the_mean_for_ratios_that_are_not_whole() {
        let pixels: Vec<u8> = (0..451 * 451).map(|p| ((p * 7919) % 251) as u8).collect();
        let mean = |p: &[u8]| p.iter().map(|v| f64::from(*v)).sum::<f64>() / p.len() as f64;
        let pooled = pool(&pixels, 451, 128);
        assert_eq!(pooled.len(), 128 * 128);
        // Rounding moves a pixel by at most half a level, independently: 0.29 / 128 levels of the mean, six
        // times that.
        assert!((mean(&pixels) - mean(&pooled)).abs() < 6.0 * 0.29 / 128.0);
    }
}
