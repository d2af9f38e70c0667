//! Errors in pictures that are drawn or written.

use resvg::usvg;

/// Reason why a picture was not drawn or not written.
#[derive(Debug, thiserror::Error)]
pub enum PlottingError {
    /// A drawing of more pixels than a picture may have.
    #[error("the picture is too large")]
    TooLarge,
    /// The renderer refused the drawing's marks.
    #[error(transparent)]
    Marks(#[from] usvg::Error),
    /// A picture within the drawing is no PNG.
    #[error(transparent)]
    Image(#[from] png::DecodingError),
    /// Pixels do not make a PNG: their number is not that of the picture, or it has none.
    #[error(transparent)]
    Pixels(#[from] png::EncodingError),
}
