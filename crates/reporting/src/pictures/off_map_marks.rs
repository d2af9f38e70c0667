//! Marks of things beyond the edges of a drawing: an arrow at the nearest edge, with a number if there are
//! several.

use plotting::svg::Svg;

/// Kind of thing that can lie beyond the edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MarkKind {
    Radar,
    Body,
    Point,
    Object,
}

/// Things beyond a box of pixels.
#[derive(Debug, Clone)]
pub(super) struct OffMapMarks {
    frame: [f64; 4],
    things: Vec<(MarkKind, String, [f64; 2])>,
}

/// Least distance between arrows along an edge; closer things share one.
const STEP_PX: f64 = 32.0;

impl OffMapMarks {
    pub(super) fn of(frame: [f64; 4]) -> Self {
        Self { frame, things: vec![] }
    }

    /// Adds a thing at a pixel outside.
    pub(super) fn mark(&mut self, kind: MarkKind, colour: &str, at: [f64; 2]) {
        self.things.push((kind, colour.to_owned(), at));
    }

    /// Draws the arrows and returns their meaning; `None` if nothing is beyond.
    pub(super) fn draw(&self, sheet: &mut Svg) -> Option<String> {
        let mut arrows: Vec<([f64; 2], [f64; 2], &str, usize)> = vec![];
        for (_, colour, at) in &self.things {
            let (place, outwards) = self.edge(*at);
            let near = |a: &&mut ([f64; 2], [f64; 2], &str, usize)| {
                a.1 == outwards && (a.0[0] - place[0]).hypot(a.0[1] - place[1]) < STEP_PX
            };
            match arrows.iter_mut().find(near) {
                Some(arrow) => arrow.3 += 1,
                None => arrows.push((place, outwards, colour.as_str(), 1)),
            }
        }
        for (place, outwards, colour, count) in &arrows {
            arrow(sheet, *place, *outwards, colour, *count);
        }
        (!self.things.is_empty()).then(|| format!("beyond the drawing: {}", self.counted()))
    }

    /// The nearest place on the box, and the direction outwards.
    fn edge(&self, [x, y]: [f64; 2]) -> ([f64; 2], [f64; 2]) {
        let [left, top, right, bottom] = self.frame;
        let place = [x.clamp(left, right), y.clamp(top, bottom)];
        let (out_x, out_y) = (x - place[0], y - place[1]);
        let outwards = if out_x.abs() > out_y.abs() { [out_x.signum(), 0.0] } else { [0.0, out_y.signum()] };
        (place, outwards)
    }

    fn counted(&self) -> String {
        let kinds = [
            (MarkKind::Radar, "radar", "radars"),
            (MarkKind::Body, "body", "bodies"),
            (MarkKind::Point, "point", "points"),
            (MarkKind::Object, "object", "objects"),
        ];
        let counts = kinds.map(|(kind, one, many)| {
            let count = self.things.iter().filter(|(other, ..)| *other == kind).count();
            (count, if count == 1 { one } else { many })
        });
        counts
            .iter()
            .filter(|(n, _)| *n > 0)
            .map(|(n, name)| format!("{n} {name}"))
            .collect::<Vec<_>>()
            .join(", ")
    }
}

fn arrow(sheet: &mut Svg, [x, y]: [f64; 2], [dx, dy]: [f64; 2], colour: &str, count: usize) {
    // Tip on the edge, the rest inside.
    let corner = |back: f64, side: f64| [x - back * dx - side * dy, y - back * dy + side * dx];
    sheet.filled_polygon(colour, &[[x, y], corner(9.0, 5.0), corner(9.0, -5.0)]);
    if count > 1 {
        let inside = corner(18.0, 0.0);
        sheet.text_with_halo([inside[0], inside[1] + 4.0], "middle", &count.to_string(), ["", "halo"]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_beyond_is_counted_and_what_lies_close_shares_an_arrow() {
        let mut beyond = OffMapMarks::of([0.0, 0.0, 100.0, 50.0]);
        beyond.mark(MarkKind::Point, "found", [120.0, 20.0]);
        beyond.mark(MarkKind::Point, "found", [130.0, 22.0]);
        beyond.mark(MarkKind::Body, "car", [50.0, -30.0]);
        let mut sheet = Svg::new("", 100.0, 50.0);
        assert_eq!(beyond.draw(&mut sheet).unwrap(), "beyond the drawing: 1 body, 2 points");
        assert_eq!(sheet.inline().matches("<polygon").count(), 2);
    }
}
