//! Range-Doppler map as OpenEXR.

use ::exr::image::{Blocks, Encoding};
use ::exr::prelude::{
    AnyChannel, AnyChannels, Compression, FlatSamples, Image, ImageAttributes, Layer, LayerAttributes,
    LineOrder, SmallVec, WritableImage,
};
use artifact::cube::CubeHeader;
use artifact::rdm::RdmFrame;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use std::path::Path;

/// Run-length encoding of lines: a sixth larger than deflate, for a tenth of the time, which was a fortieth
/// of a run of many frames.
const ENCODING: Encoding =
    Encoding { compression: Compression::RLE, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };

/// First bytes of an OpenEXR file.
pub(super) const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
/// Name of the layer of a map.
pub(super) const LAYER: &str = "range-doppler";

/// Floating-point layer with channels `power` (W, summed over channels), `re`/`im` of channel 0 and `mask`;
/// rows are Doppler cells, columns range cells.
pub fn rdm_exr(header: &CubeHeader, frame: &RdmFrame, out: &Path) -> Result<(), Failure> {
    let [_, doppler, range] = artifact::rdm::shape(header);
    let cells = doppler * range;
    let power: Vec<f32> =
        dsp::power_map(header, frame).map_err(Failure::refused)?.iter().map(|p| *p as f32).collect();
    let first = &frame.values[..cells];
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::from_vec(vec![
        AnyChannel::new("im", FlatSamples::F32(first.iter().map(|v| v.im).collect())),
        AnyChannel::new("mask", FlatSamples::F32(frame.mask.iter().map(|m| f32::from(*m)).collect())),
        AnyChannel::new("power", FlatSamples::F32(power)),
        AnyChannel::new("re", FlatSamples::F32(first.iter().map(|v| v.re).collect())),
    ]);
    let attributes = LayerAttributes::named(LAYER);
    let layer = Layer::new((range, doppler), attributes, ENCODING, AnyChannels::sort(channels));
    let size = ::exr::math::Vec2(range, doppler);
    let image = Image::empty(ImageAttributes::with_size(size)).with_layer(layer);
    let mut bytes = std::io::Cursor::new(Vec::new());
    // Separate threads for each map would cost more than the map.
    image.write().non_parallel().to_buffered(&mut bytes).map_err(|e| Failure::system(out, "encode", e))?;
    files::write_file(out, bytes.get_ref())
}
