//! SVG to PNG, with the typeface that the program carries: a bare machine has none. Pictures within a drawing
//! are laid between its marks here, so that the renderer needs no readers of picture formats.

use crate::error::PlottingError;
use crate::svg::{Layer, Paper, Svg};
use resvg::tiny_skia::{FilterQuality, Paint, Pattern, Pixmap, PixmapMut, Rect, SpreadMode, Transform};
use resvg::usvg;
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
pub fn render_png(picture: &Svg) -> Result<Vec<u8>, PlottingError> {
    let options = usvg::Options { fontdb: FONTS.clone(), ..usvg::Options::default() };
    let (width, height) = ((picture.width as f32 * SCALE) as u32, (picture.height as f32 * SCALE) as u32);
    let mut pixels = Pixmap::new(width.max(1), height.max(1)).ok_or(PlottingError::TooLarge)?;
    let draw = |marks: &str, paper: Paper, pixels: &mut PixmapMut| {
        let tree = usvg::Tree::from_str(&picture.document_of_marks(marks, paper), &options)?;
        resvg::render(&tree, Transform::from_scale(SCALE, SCALE), pixels);
        Ok::<_, PlottingError>(())
    };
    let sheet = &mut pixels.as_mut();
    draw("", Paper::White, sheet)?;
    for layer in picture.layers() {
        match layer {
            Layer::Marks(marks) => draw(marks, Paper::None, sheet)?,
            Layer::Image { corner, size, png } => draw_image(sheet, *corner, *size, png)?,
        }
    }
    let size = [pixels.width() as usize, pixels.height() as usize];
    // On white paper every pixel is opaque.
    let colours: Vec<u8> =
        pixels.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    encode_png(Pixels::Rgb, size, &colours)
}

/// Stretches a PNG over a rectangle of the drawing.
fn draw_image(
    pixels: &mut PixmapMut,
    corner: [f64; 2],
    size: [f64; 2],
    png: &[u8],
) -> Result<(), PlottingError> {
    let image = Pixmap::decode_png(png)?;
    let ([x, y], [width, height]) = (corner.map(hundredths), size.map(hundredths));
    let (columns, rows) = (image.width() as f32, image.height() as f32);
    let Some(whole) = Rect::from_xywh(0.0, 0.0, columns, rows) else { return Ok(()) };
    let stretched = Transform::from_row(width / columns, 0.0, 0.0, height / rows, x, y);
    let shader =
        Pattern::new(image.as_ref(), SpreadMode::Pad, FilterQuality::Nearest, 1.0, Transform::identity());
    let paint = Paint { shader, ..Paint::default() };
    pixels.fill_rect(whole, &paint, Transform::from_scale(SCALE, SCALE).pre_concat(stretched), None);
    Ok(())
}

/// The value rounded to hundredths, as the drawing's text has it.
fn hundredths(value: f64) -> f32 {
    ((value * 100.0).round() / 100.0) as f32
}

/// Meaning of the values of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pixels {
    /// One grey level.
    Grey,
    /// Red, green, blue.
    Rgb,
    /// Red, green, blue, opacity.
    Rgba,
}

/// Deflate made for pictures: a run of many frames spent an eighth of its time on the usual effort of 6 and a
/// twentieth on 1, the least. Maps are a fifteenth larger than with 1 after a quarter of the time, drawings a
/// quarter to a half after a third to a half.
const DEFLATE: png::DeflateCompression = png::DeflateCompression::FdeflateUltraFast;

/// Keyword and text by which a PNG names the program that wrote it.
const SOFTWARE: [&str; 2] = ["Software", "Wayside"];

/// Whether the first kilobyte of a PNG names this program.
pub fn is_own_png(head: &[u8]) -> bool {
    let mark = SOFTWARE.join("\0");
    head.starts_with(b"\x89PNG") && head.windows(mark.len()).any(|bytes| bytes == mark.as_bytes())
}

/// Bytes of pixels, row by row from the top, as PNG.
pub fn encode_png(
    pixels: Pixels,
    [width, height]: [usize; 2],
    values: &[u8],
) -> Result<Vec<u8>, PlottingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_color(match pixels {
        Pixels::Grey => png::ColorType::Grayscale,
        Pixels::Rgb => png::ColorType::Rgb,
        Pixels::Rgba => png::ColorType::Rgba,
    });
    encoder.set_deflate_compression(DEFLATE);
    let [keyword, name] = SOFTWARE;
    encoder.add_text_chunk(keyword.into(), name.into())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(values)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_names_the_program_in_its_head() {
        let own = encode_png(Pixels::Grey, [1, 1], &[7]).unwrap();
        assert!(is_own_png(&own) && !is_own_png(&own[1..]) && !is_own_png(b"\x89PNG and more"));
    }

    /// Picture read by another library: white paper, one picture of two pixels, a line over it.
    #[test]
    fn a_picture_lies_between_the_marks_before_and_after_it() {
        let mut sheet = Svg::new("two pixels", 20.0, 10.0);
        let two = encode_png(Pixels::Rgb, [2, 1], &[255, 0, 0, 0, 0, 255]).unwrap();
        sheet.image([0.0, 0.0], [20.0, 10.0], &two);
        sheet.rectangle("paper", [8.0, 4.0], [4.0, 2.0]);
        let picture = image::load_from_memory(&render_png(&sheet).unwrap()).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), (30, 15));
        let colour = |x: u32, y: u32| picture.get_pixel(x, y).0;
        assert_eq!(
            [colour(2, 2), colour(27, 12), colour(15, 7)],
            [[255, 0, 0], [0, 0, 255], [255, 255, 255]]
        );
    }

    #[test]
    fn a_picture_that_is_too_large_or_holds_one_that_is_no_png_is_refused_with_its_reason() {
        let huge = render_png(&Svg::new("huge", 1e9, 1e9)).unwrap_err();
        assert_eq!(huge.to_string(), "the picture is too large");
        let mut sheet = Svg::new("no PNG", 20.0, 10.0);
        sheet.image([0.0, 0.0], [20.0, 10.0], b"no PNG");
        assert!(matches!(render_png(&sheet), Err(PlottingError::Image(_))));
        assert!(matches!(encode_png(Pixels::Grey, [2, 1], &[0]), Err(PlottingError::Pixels(_))));
    }
}
