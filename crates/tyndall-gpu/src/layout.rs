//! Byte layouts of structs, as WGSL and as Rust see them, to be compared in tests.
//!
//! A renderer that fills a uniform or storage buffer from a Rust struct proves in a test that both sides agree:
//!
//! ```
//! use tyndall_gpu::{Gpu, Shader, rust_layout};
//!
//! #[repr(C)]
//! struct Sun {
//!     direction: [f32; 3],
//!     cos_radius: f32,
//! }
//!
//! # fn main() -> Result<(), tyndall_gpu::GpuError> {
//! let wgsl = "struct Sun { direction: vec3<f32>, cos_radius: f32 }
//!     @group(0) @binding(0) var<uniform> sun: Sun;";
//! let shader = Shader::from_source(&Gpu::noop()?, "sun.wgsl", wgsl)?;
//! assert_eq!(shader.struct_layout("Sun"), Some(rust_layout!(Sun { direction, cos_radius })));
//! # Ok(())
//! # }
//! ```

/// Names and byte offsets of a struct's members, and its size in bytes. Padding members are members like others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StructLayout {
    /// Name and byte offset of each member in order.
    pub members: Vec<(String, u32)>,
    /// Size in bytes with the padding at the end.
    pub size: u32,
}

impl StructLayout {
    /// Layout from names, offsets and size as [`rust_layout!`](crate::rust_layout) finds them.
    #[must_use]
    pub fn new(members: &[(&str, usize)], size: usize) -> Self {
        let narrow = |bytes: usize| u32::try_from(bytes).unwrap_or(u32::MAX);
        let members = members.iter().map(|(name, offset)| ((*name).to_owned(), narrow(*offset))).collect();
        Self { members, size: narrow(size) }
    }

    /// Layout of the WGSL struct of that name.
    pub(crate) fn of_wgsl(module: &naga::Module, name: &str) -> Option<Self> {
        module.types.iter().find_map(|(_, ty)| match &ty.inner {
            naga::TypeInner::Struct { members, span } if ty.name.as_deref() == Some(name) => {
                let members = members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect();
                Some(Self { members, size: *span })
            }
            _ => None,
        })
    }
}

/// The [`StructLayout`](crate::layout::StructLayout) of a Rust struct: `rust_layout!(Type { field, .. })`. The fields are
/// listed by hand; one left out makes the comparison fail.
#[macro_export]
macro_rules! rust_layout {
    ($type:ty { $($field:ident),+ $(,)? }) => {
        $crate::layout::StructLayout::new(
            &[$((stringify!($field), ::core::mem::offset_of!($type, $field))),+],
            ::core::mem::size_of::<$type>(),
        )
    };
}
