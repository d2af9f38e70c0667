//! The same picture for a page and for a telephone: words stay as large, so the drawing is laid out anew.

use super::svg::Svg;

/// Room that a picture is drawn for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// A page.
    Wide,
    /// A telephone.
    Narrow,
}

impl Form {
    /// Width of a sheet.
    pub(crate) fn width_px(self) -> f64 {
        match self {
            Self::Wide => 760.0,
            Self::Narrow => 352.0,
        }
    }

    /// Left and right end of what has axes, with numbers on its left.
    pub(crate) fn sides_px(self) -> [f64; 2] {
        match self {
            Self::Wide => [60.0, 744.0],
            Self::Narrow => [54.0, 342.0],
        }
    }
}

/// A picture in both forms.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    pub(crate) wide: Svg,
    pub(crate) narrow: Svg,
}

impl Figure {
    /// Draws both.
    pub(crate) fn of(draw: impl Fn(Form) -> Svg) -> Self {
        Self { wide: draw(Form::Wide), narrow: draw(Form::Narrow) }
    }

    /// Draws both, if it can.
    pub(crate) fn try_of<E>(draw: impl Fn(Form) -> Result<Svg, E>) -> Result<Self, E> {
        Ok(Self { wide: draw(Form::Wide)?, narrow: draw(Form::Narrow)? })
    }
}
