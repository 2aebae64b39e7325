//! Size of the picture.

use tyndall_core::params;

params! {
    /// Size of the picture file.
    pub struct ImageParams {
        /// Columns of the picture.
        width_px: u32 = 1280, ["px", 1..=16384, Log], "pixels";
        /// Rows of the picture.
        height_px: u32 = 720, ["px", 1..=16384, Log], "pixels";
    }
}
