//! Height maps as `OpenEXR`: one channel of 32-bit floats.

use std::io::{Seek as _, SeekFrom};
use std::path::Path;

use exr::meta::attribute::Text;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder,
    WritableImage as _, read_first_flat_layer_from_file,
};

use crate::atomic::PartFile;
use crate::exr_order::sort_attributes;
use crate::exr_read::read_header;
use crate::exr_write::into_io_error;
use crate::{HeightMap, IoError};

/// Name of the channel that is written: programs show it as grey.
const CHANNEL: &str = "Y";
/// Channels that are read, the first one that is there.
const CHANNELS: [&str; 5] = [CHANNEL, "height", "Height", "R", "Z"];

/// Writes the heights (m), first row in the north.
pub(crate) fn write(file: &mut PartFile<'_>, map: &HeightMap) -> std::io::Result<()> {
    let rows = map.heights_m.chunks_exact(map.size_px[0] as usize).rev();
    let samples = FlatSamples::F32(rows.flatten().copied().collect());
    let encoding = Encoding {
        compression: exr::compression::Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let attributes = LayerAttributes { comments: Text::new_or_none("heights in metres"), ..LayerAttributes::default() };
    let channels = AnyChannels::sort([AnyChannel::new(CHANNEL, samples)].into_iter().collect());
    let size = (map.size_px[0] as usize, map.size_px[1] as usize);
    let image = Image::from_layer(Layer::new(size, attributes, encoding, channels));
    image.write().to_buffered(&mut *file).map_err(into_io_error)?;
    sort_attributes(file)?;
    file.seek(SeekFrom::End(0)).map(drop)
}

/// Reads the heights (m) of the first channel of [`CHANNELS`].
pub(crate) fn read(path: &Path, pixel_m: f64) -> Result<HeightMap, IoError> {
    // The size is looked at first: a damaged header must not make the decoder allocate terabytes.
    let (size_px, _) = read_header(path)?;
    let refused = |problem: String| IoError::Format { path: path.to_path_buf(), problem };
    let image =
        read_first_flat_layer_from_file(path).map_err(|error| refused(format!("not a readable EXR file ({error})")))?;
    let channels = &image.layer_data.channel_data.list;
    let channel = CHANNELS.iter().find_map(|name| channels.iter().find(|channel| channel.name.eq(name)));
    let Some(channel) = channel else {
        return Err(refused(format!("it has none of the channels {}", CHANNELS.join(", "))));
    };
    let samples: Vec<f32> = channel.sample_data.values_as_f32().collect();
    let heights_m = samples.chunks_exact(size_px[0] as usize).rev().flatten().copied().collect();
    Ok(HeightMap { size_px, pixel_m, heights_m })
}
