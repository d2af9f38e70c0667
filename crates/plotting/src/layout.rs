//! Layouts of a picture, for a page and for a telephone: words stay as large, so the drawing is laid out
//! anew.

use crate::svg::Svg;

/// Room that a picture is drawn for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// A page.
    Wide,
    /// A telephone.
    Narrow,
}

impl Layout {
    /// Width of a sheet.
    pub fn width_px(self) -> f64 {
        match self {
            Self::Wide => 760.0,
            Self::Narrow => 352.0,
        }
    }

    /// Left and right end of what has axes, with numbers on its left.
    pub fn sides_px(self) -> [f64; 2] {
        match self {
            Self::Wide => [60.0, 744.0],
            Self::Narrow => [54.0, 342.0],
        }
    }
}

/// A picture in both layouts.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Drawing for a page.
    pub wide: Svg,
    /// Drawing for a telephone.
    pub narrow: Svg,
}

impl Figure {
    /// Draws both.
    pub fn draw(draw: impl Fn(Layout) -> Svg) -> Self {
        Self { wide: draw(Layout::Wide), narrow: draw(Layout::Narrow) }
    }

    /// Draws both, if it can.
    pub fn try_draw<E>(draw: impl Fn(Layout) -> Result<Svg, E>) -> Result<Self, E> {
        Ok(Self { wide: draw(Layout::Wide)?, narrow: draw(Layout::Narrow)? })
    }
}
