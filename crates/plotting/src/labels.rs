//! Names beside what they name, none over another.

use crate::svg::{Svg, TEXT_PX, text_width_px};

/// Names that have found their place.
#[derive(Debug, Clone)]
pub struct Labels {
    frame: [f64; 4],
    /// Boxes, [left, top, right, bottom].
    occupied: Vec<[f64; 4]>,
    placed: Vec<([f64; 2], String)>,
}

impl Labels {
    /// Labels inside a box.
    pub fn within(frame: [f64; 4]) -> Self {
        Self { frame, occupied: vec![], placed: vec![] }
    }

    /// Labels, none yet, with no room where these stand.
    pub fn next_layer(&self) -> Self {
        Self { placed: vec![], ..self.clone() }
    }

    /// Puts a name above, below, right or left of a box, where there is room first; left out where there is
    /// none.
    pub fn place(&mut self, [left, top, right, bottom]: [f64; 4], words: &str) {
        let (wide, high) = (text_width_px(words), TEXT_PX);
        let (x, y) = (0.5 * (left + right), 0.5 * (top + bottom));
        let corners = [
            [x - 0.5 * wide, top - high - 3.0],
            [x - 0.5 * wide, bottom + 3.0],
            [right + 4.0, y - 0.5 * high],
            [left - wide - 4.0, y - 0.5 * high],
        ];
        let boxes = corners.map(|[x, y]| [x, y, x + wide, y + high]);
        let is_free =
            |of: &&[f64; 4]| self.is_inside(of) && !self.occupied.iter().any(|other| overlap(of, other));
        if let Some(free) = boxes.iter().find(is_free).copied() {
            self.occupied.push(free);
            self.placed.push(([0.5 * (free[0] + free[2]), free[3] - 2.0], words.to_owned()));
        }
    }

    fn is_inside(&self, [left, top, right, bottom]: &[f64; 4]) -> bool {
        let [x0, y0, x1, y1] = self.frame;
        *left >= x0 && *top >= y0 && *right <= x1 && *bottom <= y1
    }

    /// Writes the names over everything else.
    pub fn draw(&self, sheet: &mut Svg) {
        for (at, words) in &self.placed {
            sheet.text_with_halo(*at, "middle", words, ["", "halo"]);
        }
    }

    /// Draws as [`Labels::draw`] does, on a map of colours.
    pub fn draw_on_map(&self, sheet: &mut Svg, class: &str) {
        for (at, words) in &self.placed {
            sheet.text_with_halo(*at, "middle", words, [class, "shade"]);
        }
    }
}

fn overlap(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_lie_over_each_other_nor_beyond_the_frame() {
        let mut labels = Labels::within([0.0, 0.0, 200.0, 100.0]);
        (0..40).for_each(|i| labels.place([90.0, 40.0, 100.0, 60.0], &format!("body-{i}")));
        assert_eq!(labels.placed.len(), 4);
        for (i, a) in labels.occupied.iter().enumerate() {
            assert!(labels.is_inside(a) && labels.occupied[..i].iter().all(|b| !overlap(a, b)));
        }
    }
}
