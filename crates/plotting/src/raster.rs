//! SVG to PNG, with the typeface that the program carries: a bare machine has none.

use crate::svg::Svg;
use image::{DynamicImage, ImageFormat};
use resvg::{tiny_skia, usvg};
use std::io::Cursor;
use std::sync::{Arc, LazyLock};

/// Pixels per unit of the drawing: sharp on dense screens.
const SCALE: f32 = 1.5;

static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    let name = fonts.faces().next().and_then(|f| f.families.first().map(|(name, _)| name.clone()));
    fonts.set_sans_serif_family(name.unwrap_or_default());
    Arc::new(fonts)
});

/// The picture as PNG.
pub fn png(picture: &Svg) -> Result<Vec<u8>, String> {
    let options = usvg::Options { fontdb: FONTS.clone(), ..usvg::Options::default() };
    let tree = usvg::Tree::from_str(&picture.on_white(), &options).map_err(|e| e.to_string())?;
    let (width, height) = ((picture.width as f32 * SCALE) as u32, (picture.height as f32 * SCALE) as u32);
    let mut pixels = tiny_skia::Pixmap::new(width.max(1), height.max(1)).ok_or("the picture is too large")?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|e| e.to_string())
}

/// An image as PNG.
pub fn encode(image: DynamicImage) -> Result<Vec<u8>, String> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png).map_err(|e| e.to_string())?;
    Ok(bytes.into_inner())
}
