//! Pictures to and from files: `OpenEXR` with metadata, PNG with 8 and 16 bits, atomic writes.
//!
//! - [`write_exr`], [`read_exr`]: scene-linear light with depth, camera, place, unit, primaries and scene hash.
//! - [`write_png8`], [`write_png16`]: display-referred sRGB with the scene hash in a text chunk.
//! - [`write_height_map`], [`read_height_map`]: terrain as PNG with 16 bits, EXR, R16 and R32; [`write_glb`] as a mesh;
//!   [`write_vector_map`], [`write_grey_map`]: normals and masks.
//! - [`read_picture_header`], [`is_finished`]: what a file says about itself, without decoding its pixels.
//! - [`TableFolder`]: tables kept between runs, in the user's cache.
//! - [`write_npz`], [`read_npz`], [`write_npy`], [`read_npy`]: arrays by name, as `NumPy` has them.
//! - [`write_vdb`]: volumes as sparse `OpenVDB` grids.
//! - [`atomic`]: a file appears under its name complete or not at all.
//!
//! Nothing here knows a GPU; a simulation's user has the writers without one. Not done: tiles, several parts, deep
//! data, reading the pixels of PNG.

pub mod atomic;
mod destination;
mod error;
mod exr_attributes;
mod exr_height;
mod exr_order;
mod exr_read;
mod exr_write;
mod glb;
mod header;
mod height_map;
mod npy;
mod npz;
mod picture;
mod png_map;
mod png_write;
mod table_folder;
mod vdb;

pub use destination::Destination;
pub use error::IoError;
pub use exr_read::read_exr;
pub use exr_write::{Channels, Compression, ExrOptions, Precision, SKY_DEPTH_M, WriteReport, write_exr};
pub use glb::write_glb;
pub use header::{PictureFormat, PictureHeader, is_finished, read_picture_header};
pub use height_map::{HeightFormat, HeightMap, HeightScale, read_height_map, write_height_map, write_height_map_in};
pub use npz::{read_npy, read_npz, write_npy, write_npz};
pub use picture::{MAX_PIXELS, MAX_SIDE_PX, Picture, PictureMetadata, Projection, check_size};
pub use png_map::{write_grey_map, write_vector_map};
pub use png_write::{write_png8, write_png16};
pub use table_folder::{CACHE_VARIABLE, TableFolder};
pub use vdb::{VdbGrid, VdbOptions, VdbPacking, VdbReport, write_vdb};
