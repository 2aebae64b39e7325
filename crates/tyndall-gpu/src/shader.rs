//! A WGSL file, composed, validated and reflected.

use std::error::Error;

use tyndall_shaders::{Composed, compose, compose_snippet};

use crate::layout::StructLayout;
use crate::{Gpu, GpuError};

/// A valid WGSL module on the device and what is known about it.
#[derive(Debug)]
pub struct Shader {
    name: String,
    pub(crate) module: naga::Module,
    pub(crate) info: naga::valid::ModuleInfo,
    pub(crate) raw: wgpu::ShaderModule,
}

impl Shader {
    /// Composes a file of [`tyndall_shaders::FILES`] and gives it to the device.
    ///
    /// # Errors
    /// When the file or an import is missing, or the text is not valid WGSL; with the original file, line and column.
    pub fn load(gpu: &Gpu, file: &str) -> Result<Self, GpuError> {
        Self::new(gpu, file, &compose(file)?)
    }

    /// A shader from a text that is no file; it may import those of [`tyndall_shaders::FILES`].
    ///
    /// # Errors
    /// As [`Shader::load`]; lines of the text itself are those of `name`.
    pub fn from_source(gpu: &Gpu, name: &str, source: &str) -> Result<Self, GpuError> {
        Self::new(gpu, name, &compose_snippet(name, source)?)
    }

    fn new(gpu: &Gpu, name: &str, composed: &Composed) -> Result<Self, GpuError> {
        let (module, info) = parse(composed)?;
        let desc = wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Wgsl(composed.source.as_str().into()),
        };
        let raw = gpu.validated(&format!("shader {name}"), |device| device.create_shader_module(desc))?;
        Ok(Self { name: name.to_owned(), module, info, raw })
    }

    /// The file, or the name it was made with.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Byte layout of the WGSL struct of that name, if the module or an import has it.
    #[must_use]
    pub fn struct_layout(&self, name: &str) -> Option<StructLayout> {
        StructLayout::of_wgsl(&self.module, name)
    }
}

/// Parses and validates without any optional capability: what passes runs wherever wgpu's default limits hold.
fn parse(composed: &Composed) -> Result<(naga::Module, naga::valid::ModuleInfo), GpuError> {
    let source = composed.source.as_str();
    let module = naga::front::wgsl::parse_str(source).map_err(|error| {
        let details = error.labels().map(|(_, text)| text).filter(|text| !text.is_empty());
        let parts = [error.message()].into_iter().chain(details).chain(error.notes());
        shader_error(composed, error.location(source), &joined(parts))
    })?;
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    let info = validator.validate(&module).map_err(|error| {
        let causes = with_causes(error.as_inner());
        // The spans go from the whole function down to the expression; the shortest is the place.
        let spans = error.spans().map(|(span, _)| span).filter(|span| span.is_defined());
        let place = spans.map(|span| span.location(source)).min_by_key(|place| place.length);
        shader_error(composed, place, &joined(causes.iter().map(String::as_str)))
    })?;
    Ok((module, info))
}

/// The error and what caused it, outermost first.
fn with_causes(error: &dyn Error) -> Vec<String> {
    let mut texts = vec![error.to_string()];
    let mut cause = error.source();
    while let Some(error) = cause {
        texts.push(error.to_string());
        cause = error.source();
    }
    texts
}

fn joined<'a>(parts: impl Iterator<Item = &'a str>) -> String {
    parts.collect::<Vec<_>>().join(": ")
}

/// An error at its original place, with the line and a caret below the text.
fn shader_error(composed: &Composed, at: Option<naga::SourceLocation>, message: &str) -> GpuError {
    let at = at.unwrap_or(naga::SourceLocation { line_number: 1, line_position: 1, offset: 0, length: 0 });
    let (file, line) = composed.locate(at.line_number);
    let text = composed.source.lines().nth(at.line_number.saturating_sub(1) as usize).unwrap_or_default();
    let before = text.get(..at.line_position.saturating_sub(1) as usize).unwrap_or_default();
    let pad: String = before.chars().map(|letter| if letter == '\t' { '\t' } else { ' ' }).collect();
    GpuError::Shader {
        file: file.to_owned(),
        line,
        column: at.line_position,
        message: format!("{message}\n{text}\n{pad}^"),
    }
}
